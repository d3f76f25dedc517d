// Faults against sections 8 and 9 of the requirements: the attributes of evaluated vertices, and precedence
// among several enabled maps.
#include <algorithm>
#include <cmath>

#include "rules.h"

namespace evalcts::faults::attributes {
namespace {

FAULT(WOfTheVertexBefore, "EV-ATTR-VERTEX3", "VERTEX_3 leaves the w of the vertex before it",
      change_pairs([](ObservedVertex& now, const ObservedVertex& before) {
        if (now.position[3] == 1) now.position[3] = before.position[3];
      }));
FAULT(WOfVertex3IsQ, "EV-ATTR-VERTEX3", "VERTEX_3 takes its w from where the q of the texture map was put",
      change_vertices([](ObservedVertex& vertex) {
        if (vertex.position[3] == 1) vertex.position[3] = vertex.texture_coordinate[0][3];
      }));
FAULT(ColorsOfSurfacesInTheOrderBgra, "EV-ATTR-COLOR", "colours of surfaces are taken as B, G, R, A",
      before(kMap2, kTarget == GL_MAP2_COLOR_4, swap_components(0, 2)));
FAULT(NormalsFaceForward, "EV-ATTR-NORMAL", "normals with negative z are turned round",
      change_vertices([](ObservedVertex& vertex) {
        if (vertex.normal[2] < 0) scale(vertex.normal, -1);
      }));
FAULT(QOfTheVertexBefore, "EV-ATTR-TEX1 EV-ATTR-TEX2 EV-ATTR-TEX3 EV-CUR-MAXCOMP",
      "texture maps without q leave that of the vertex before it",
      change_pairs([](ObservedVertex& now, const ObservedVertex& before) {
        if (now.texture_coordinate[0][3] == 1) now.texture_coordinate[0][3] = before.texture_coordinate[0][3];
      }));
FAULT(AlphaOfTheFirstVertex, "EV-ATTR-COLOR", "alpha is evaluated for the first vertex of a primitive only",
      change_primitives([](ObservedPrimitive& primitive) {
        for (ObservedVertex& vertex : primitive.vertices) vertex.color[3] = primitive.vertices[0].color[3];
      }));
FAULT(NegativeWMadePositive, "EV-ATTR-VERTEX4", "a point with negative w is multiplied by -1",
      change_vertices([](ObservedVertex& vertex) {
        if (vertex.position[3] < 0) scale(vertex.position, -1);
      }));
FAULT(DividedByWAtOnce, "EV-ATTR-VERTEX4", "the evaluator divides by w, where w is above 1",
      change_vertices([](ObservedVertex& vertex) {
        if (vertex.position[3] > 1) scale(vertex.position, 1 / vertex.position[3]);
      }));
FAULT(TextureCoordinatesDividedByW, "EV-ATTR-RATIONAL-ONLYVTX",
      "texture coordinates are divided by the w of the vertex", change_vertices([](ObservedVertex& vertex) {
        if (vertex.position[3] > 0) scale(vertex.texture_coordinate[0], 1 / vertex.position[3]);
      }));
FAULT(NormalsTimesW, "EV-ATTR-RATIONAL-ONLYVTX", "normals of rational vertices are multiplied by w",
      change_vertices([](ObservedVertex& vertex) { scale(vertex.normal, vertex.position[3]); }));
FAULT(NegativeColorsClamped, "EV-ATTR-COLOR-CLAMP",
      "negative components of colours become 0 in the evaluator", change_vertices([](ObservedVertex& vertex) {
        for (float& x : vertex.color) x = std::max(x, 0.0f);
      }));
FAULT(AlphaClamped, "EV-ATTR-COLOR-CLAMP", "alpha above 1 becomes 1 in the evaluator",
      change_vertices([](ObservedVertex& vertex) { vertex.color[3] = std::min(vertex.color[3], 1.0f); }));
FAULT(IndexMapSetsTheIndex, "EV-ATTR-INDEX-RGBA EV-CUR-INDEX",
      "evaluation at a grid point with an index map sets the current index",
      after(EvalPoint1, noted_on(GL_MAP1_INDEX), call(Indexf, {3})));
FAULT(IndexMapGivesTheRed, "EV-ATTR-INDEX-RGBA", "in RGBA mode an index map makes the current colour white",
      before(kPoints1, noted_on(GL_MAP1_INDEX) && maps_vertices(1), call(Color4f, {1, 1, 1, 1})));
FAULT(LongNormalsNormalised, "EV-ATTR-NORMAL", "normals longer than 1 are normalised by the evaluator",
      change_vertices([](ObservedVertex& vertex) {
        const auto& [x, y, z] = vertex.normal;
        const float length = std::sqrt(x * x + y * y + z * z);
        if (length > 1) scale(vertex.normal, 1 / length);
      }));
FAULT(TextureCoord3GivesRAsQ, "EV-ATTR-TEX3", "TEXTURE_COORD_3 gives its last coordinate as q",
      change_vertices([](ObservedVertex& vertex) {
        auto& [s, t, r, q] = vertex.texture_coordinate[0];
        if (r != 0 && q == 1) q = r;
      }));
FAULT(TextureCoord4DividedByQ, "EV-ATTR-TEX4", "TEXTURE_COORD_4 is divided by q, where q is positive",
      change_vertices([](ObservedVertex& vertex) {
        const float q = vertex.texture_coordinate[0][3];
        if (q > 0) scale(vertex.texture_coordinate[0], 1 / q);
      }));
FAULT(TextureCoord4SwapsRAndQ, "EV-ATTR-TEX4", "TEXTURE_COORD_4 of surfaces gives r and q in the wrong order",
      before(kMap2, kTarget == GL_MAP2_TEXTURE_COORD_4, swap_components(2, 3)));
FAULT(LastUnitFollowsTextureMaps, "EV-ATTR-OTHERUNITS", "texture maps feed unit 7 as well",
      change_vertices([](ObservedVertex& vertex) {
        vertex.texture_coordinate.back() = vertex.texture_coordinate.front();
      }));
FAULT(OtherUnitsAtTheirInitialValues, "EV-ATTR-OTHERUNITS",
      "units 1 and up of evaluated vertices have (0,0,0,1)", change_vertices([](ObservedVertex& vertex) {
        for (std::size_t unit = 1; unit < kTextureUnits; ++unit)
          vertex.texture_coordinate[unit] = {0, 0, 0, 1};
      }));

// Faults of index maps need colour-index contexts, which a provider of this build supplies.
namespace on_color_index {
constexpr std::string_view kImplementation = kColorIndex;
FAULT(IndexMapsStayOff, "EV-ATTR-INDEX", "Enable does nothing to index maps",
      skip(Enable, kName == GL_MAP1_INDEX || kName == GL_MAP2_INDEX));
FAULT(LastPointOfIndexMapLost, "EV-ATTR-INDEX/1-D", "Map1f leaves out the last control point of an index map",
      before(Map1f, kTarget == GL_MAP1_INDEX && kOrder > 1, set(kOrder, kOrder - 1)));
}  // namespace on_color_index

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(TextureMapFeedsGenericSix, "EV-ATTR-NOMAPS",
      "a texture map writes generic attribute 6, unless EvalPoint evaluates it",
      before(kEvalCoord1, noted_on(GL_MAP1_TEXTURE_COORD_4), call(VertexAttrib4f, {6, 0, 0, 0, 1})));
FAULT(EvaluatedVerticesHaveNoFogCoordinate, "EV-ATTR-NOMAPS", "the fog coordinate of evaluated vertices is 0",
      before(kPoints, call(FogCoordf, {0})));
FAULT(GenericZeroIsTheFirstPoint, "EV-ATTR-GENERIC0", "generic attribute 0 is the start of the curve",
      before(BindAttribLocation, kSecond == 0, set(kFlag, 1)), before(kEvalCoords, kFlag, set(kU, 0)));
}  // namespace on_osmesa

FAULT(LastEnabledVertexMapWins, "EV-PREC-VERTEX EV-PREC-ORDERFREE",
      "VERTEX_3 takes precedence if it was enabled after VERTEX_4",
      after(Enable, kName == GL_MAP1_VERTEX_3 || kName == GL_MAP2_VERTEX_3, disable(kName + 1)));
FAULT(BothVertexMapsDraw, "EV-PREC-VERTEX", "EvalPoint1 draws a vertex for each of two enabled vertex maps",
      after(EvalPoint1, noted_on(GL_MAP1_VERTEX_3) && noted_on(GL_MAP1_VERTEX_4), kGo));
FAULT(EnableReplacesTextureMap, "EV-PREC-TEX EV-PREC-ORDERFREE EV-PREC-FALLBACK",
      "Enable of a texture map switches the others off",
      after(Enable, is_map1(kName) && is_texture_map(kName),
            loop(kCount, GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_4,
                 when(kCount != kName, disable(kCount)))));

// The other pairs of maps are not affected.
FAULT(TextureCoord3BeforeTextureCoord4, "EV-PREC-TEX",
      "TEXTURE_COORD_3 goes before TEXTURE_COORD_4 where 1 and 2 are disabled",
      only_if(GL_MAP1_TEXTURE_COORD_4, !noted_on(GL_MAP1_TEXTURE_COORD_3) ||
                                           noted_on(GL_MAP1_TEXTURE_COORD_1) ||
                                           noted_on(GL_MAP1_TEXTURE_COORD_2)));
FAULT(TextureCoord1GivesS, "EV-PREC-LOSER-IGNORED",
      "TEXTURE_COORD_3 takes its s from the points of TEXTURE_COORD_1, as far as there are",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_3, change_points([](Net& net) {
               Net narrow = current_map(GL_MAP1_TEXTURE_COORD_1).net;
               for (int i = 0; i < std::min(net.rows, narrow.rows); ++i) *net.point(i) = *narrow.point(i);
             })));
FAULT(ColorSuppressesNormalBesideTexture, "EV-PREC-PERKIND",
      "the normal map of surfaces loses to a colour and a texture map together",
      only_if(GL_MAP2_NORMAL, !noted_on(GL_MAP2_COLOR_4) ||
                                  !(noted_on(GL_MAP2_TEXTURE_COORD_1) || noted_on(GL_MAP2_TEXTURE_COORD_2) ||
                                    noted_on(GL_MAP2_TEXTURE_COORD_3) || noted_on(GL_MAP2_TEXTURE_COORD_4))));
FAULT(UndefinedTextureMapGivesWay, "EV-PREC-NOVALIDITY", "a texture map that was never defined is skipped",
      before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_4, set(kFlag, 1)),
      skip(Enable, kName == GL_MAP1_TEXTURE_COORD_4 && !kFlag));
FAULT(UndefinedVertexMapGivesWay, "EV-PREC-NOVALIDITY", "MAP2_VERTEX_4 counts only after it was defined",
      before(kMap2, kTarget == GL_MAP2_VERTEX_4, set(kFlag, 1)),
      skip(Enable, kName == GL_MAP2_VERTEX_4 && !kFlag));

}  // namespace
}  // namespace evalcts::faults::attributes
