// Faults against section 11 of the requirements: state that evaluation must not change. Some appear only in
// primitives that are longer than a vertex buffer.
#include <algorithm>

#include "rules.h"

namespace evalcts::faults::current_values {
namespace {

FAULT(MeshLeavesWhite, "EV-CUR-COLOR", "EvalMesh1 with a colour map resets the current colour",
      after(EvalMesh1, noted_on(GL_MAP1_COLOR_4), call(Color4f, {1, 1, 1, 1})));

// Imitates an implementation that flushes in the middle of a primitive, so that only long primitives
// show the mistake.
FAULT(ColorLostInLongPrimitives, "EV-CUR-COLOR",
      "the 257th evaluated vertex of a primitive sets the current colour", before(Begin, set(kCount, 0)),
      after(kPoints1, {set(kCount, kCount + 1), when(kCount == 257 && noted_on(GL_MAP1_COLOR_4),
                                                     call(Color4f, {0.5, 0.25, 0.5, 1}))}));
FAULT(VertexAfterEvaluationHasInitialNormal, "EV-CUR-NEXTVERTEX EV-COORD-MIX",
      "a Vertex right after an evaluation with a normal map has the normal (0,0,1)",
      before(kPoints, set(kFlag, noted_on(GL_MAP1_NORMAL) || noted_on(GL_MAP2_NORMAL))),
      before(Vertex3f, kFlag, {set(kFlag, 0), call(Normal3f, {0, 0, 1})}));
FAULT(NormalLostAfterMeshes, "EV-CUR-NORMAL", "EvalMesh2 with a normal map sets the current normal",
      after(EvalMesh2, noted_on(GL_MAP2_NORMAL), call(Normal3f, {0.6, 0, 0.8})));
FAULT(MeshCompletesTexCoord, "EV-CUR-TEX",
      "EvalMesh1 with a texture map leaves r = 0 and q = 1 in the current texture coordinates",
      after(EvalMesh1,
            noted_on(GL_MAP1_TEXTURE_COORD_1) || noted_on(GL_MAP1_TEXTURE_COORD_2) ||
                noted_on(GL_MAP1_TEXTURE_COORD_3) || noted_on(GL_MAP1_TEXTURE_COORD_4),
            call(TexCoord4f,
                 {real_state(GL_CURRENT_TEXTURE_COORDS), real_state(GL_CURRENT_TEXTURE_COORDS, 1), 0, 1})));
FAULT(MeshSetsIndex, "EV-CUR-INDEX", "EvalMesh2 with an index map leaves its index as the current one",
      after(EvalMesh2, noted_on(GL_MAP2_INDEX), call(Indexf, {4.5})));
FAULT(EvaluationResetsTheActiveUnit, "EV-CUR-OTHERUNITS",
      "evaluation with a texture map resets the texture coordinates of the active unit, but for unit 0",
      after(kPoints1, noted_on(GL_MAP1_TEXTURE_COORD_2) && kUnit > GL_TEXTURE0,
            call(MultiTexCoord4f, {kUnit, 0, 0, 0, 1})));
FAULT(MeshCopiesUnit0ToLastUnit, "EV-CUR-OTHERUNITS",
      "EvalMesh2 leaves the texture coordinates of unit 7 as those of unit 0",
      after(EvalMesh2, noted_on(GL_MAP2_TEXTURE_COORD_2), call(MultiTexCoord4f, {GL_TEXTURE7, 0, 0, 0, 1})));
FAULT(EvalPointSetsEdgeFlag, "EV-CUR-EDGEFLAG", "EvalPoint leaves the edge flag TRUE",
      after(EvalPoint1, call(EdgeFlag, {GL_TRUE})));
FAULT(FillMeshSetsEdgeFlag, "EV-CUR-EDGEFLAG", "EvalMesh2 with FILL leaves the edge flag TRUE",
      after(EvalMesh2, kMode == GL_FILL, call(EdgeFlag, {GL_TRUE})));
FAULT(EvaluationDisablesIndexMap, "EV-CUR-GRIDMAPS", "evaluation in RGBA mode switches index maps off",
      before(kPoints, set(kFlag, 1)), after(End, kFlag, {set(kFlag, 0), disable(GL_MAP2_INDEX)}));
FAULT(MeshNormalisesItsMap, "EV-CUR-GRIDMAPS", "EvalMesh2 with FILL leaves the colour map over [0,1] x [0,1]",
      after(EvalMesh2, kMode == GL_FILL,
            redefine(GL_MAP2_COLOR_4, [](Map& map, Call&) { map = {map.target, 0, 1, 0, 1, map.net}; })));
FAULT(RAndQOfTheVertexBefore, "EV-CUR-MAXCOMP EV-ATTR-TEX1 EV-ATTR-TEX2",
      "where a texture map gives no r and q, those of the vertex before it stay",
      change_pairs([](ObservedVertex& now, const ObservedVertex& before) {
        auto& [s, t, r, q] = now.texture_coordinate[0];
        if (r == 0 && q == 1) std::copy_n(&before.texture_coordinate[0][2], 2, &r);
      }));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(MeshMovesRasterPosition, "EV-CUR-RASTERPOS", "evaluation moves the raster position to the last vertex",
      before(kPoints, set(kFlag, 1)), after(End, kFlag, {set(kFlag, 0), call(RasterPos3f, {0, 0, 0})}),
      after(kMeshes, call(RasterPos3f, {0, 0, 0})));
FAULT(RasterPosTakesEvaluatedColor, "EV-CUR-RASTERPOS",
      "RasterPos after an evaluation takes the evaluated colour", before(kPoints | kMeshes, set(kFlag, 1)),
      keeping(RasterPos3f, kFlag, current(Color4d, GL_CURRENT_COLOR), call(Color4f, {0, 1, 0, 1})));
}  // namespace on_osmesa

FAULT(NormalLostEvery4096Vertices, "EV-CUR-NORMAL",
      "every 4096th evaluated vertex of a primitive sets the current normal", before(Begin, set(kCount, 0)),
      after(kPoints, {set(kCount, kCount + 1), when(kCount % 4096 == 0, call(Normal3f, {0, 0, 1}))}));
FAULT(TexCoordLostEvery4096Vertices, "EV-CUR-NEXTVERTEX EV-COORD-MIX",
      "the first Vertex after 4096 evaluated vertices of a primitive has the texture coordinates (0,0,0,1)",
      before(Begin, set(kCount, 0)), before(kPoints, set(kCount, kCount + 1)),
      before(Vertex3f, kCount > 4096, {set(kCount, 0), call(TexCoord4f, {0, 0, 0, 1})}));

// Gives the first vertex of each further buffer of `buffer` vertices the colour of the
// primitive's first vertex.
void take_color_of_the_first(ObservedPrimitive& primitive, std::size_t buffer) {
  for (std::size_t i = buffer; i < primitive.vertices.size(); i += buffer)
    primitive.vertices[i].color = primitive.vertices[0].color;
}
FAULT(ColorOfTheFirstEvery32768Vertices, "EV-COORD-PRIMS EV-COORD-ASIF",
      "every 32768th vertex of a primitive has the colour of the first one",
      change_primitives([](ObservedPrimitive& primitive) { take_color_of_the_first(primitive, 32768); }));
FAULT(NormalDroppedBeyond16384Vertices, "EV-MESH1-LINE EV-MESH2-LINE EV-MESH2-FILL",
      "vertices of a mesh have the normal (0,0,1) from the 16384th on", before(kMeshes, set(kFlag, 1)),
      before(Begin, set(kFlag, 0)), change_output(kFlag, [](Primitives& primitives) {
        for (ObservedPrimitive& primitive : primitives)
          for (std::size_t i = 16384; i < primitive.vertices.size(); ++i)
            primitive.vertices[i].normal = {0, 0, 1};
      }));

}  // namespace
}  // namespace evalcts::faults::current_values
