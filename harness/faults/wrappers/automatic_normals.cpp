// Faults against section 10 of the requirements: normals that AUTO_NORMAL generates.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rules.h"

namespace evalcts::faults::automatic_normals {
namespace {

// Change the primitives, or their vertices, if AUTO_NORMAL has been enabled and the condition holds.
Rules with_auto_normal(std::function<void(ObservedPrimitive& primitive)> change, Value condition = true) {
  return {after(Enable, kName == GL_AUTO_NORMAL, set(kFlag, 1)),
          change_output(kFlag && condition, [=](Primitives& all) { std::ranges::for_each(all, change); })};
}
Rules change_normals(void (*change)(ObservedVertex& vertex), Value condition = true) {
  return with_auto_normal(
      [=](ObservedPrimitive& primitive) { std::ranges::for_each(primitive.vertices, change); }, condition);
}

bool has_no_normal(const ObservedVertex& vertex) { return vertex.normal == std::array<float, 3>{0, 0, 0}; }

void turn(ObservedVertex& vertex) { scale(vertex.normal, -1); }

// Reverses the normals of the primitives that begin while the latest Map2 of a vertex map meets the
// condition.
Rules turned_if(Value condition) {
  return {before(kMap2, kTarget >= GL_MAP2_VERTEX_3, set(kCount, std::move(condition))),
          before(Begin, [](Call& call) { remembered_list().push_back(kCount(call)); }),
          change_output(true, [](Primitives& all) {
            const std::vector<double> turned = std::exchange(remembered_list(), {});
            if (!tracked().enabled[GL_AUTO_NORMAL]) return;
            for (std::size_t i = 0; i < std::min(all.size(), turned.size()); ++i)
              if (turned[i] != 0) std::ranges::for_each(all[i].vertices, turn);
          })};
}

// Rounds the components of a normal to multiples of 1/steps.
void round_normal(ObservedVertex& vertex, float steps) {
  for (float& x : vertex.normal)
    if (std::abs(x) <= 1) x = std::round(x * steps) / steps;
}

FAULT(NormalMapEnabledLastWins, "EV-AUTON-OVERRIDE", "a normal map that is enabled later takes precedence",
      after(Enable, kName == GL_MAP2_NORMAL && noted_on(GL_AUTO_NORMAL), disable(GL_AUTO_NORMAL)));
FAULT(AutoNormalBeforeVertexMapLost, "EV-AUTON-USED",
      "Enable of AUTO_NORMAL before that of a vertex map of surfaces has no effect",
      skip(Enable, kName == GL_AUTO_NORMAL && !maps_vertices(2)));
FAULT(AutoNormalSuppressesNormalMapOfCurves, "EV-AUTON-1D", "AUTO_NORMAL suppresses the normal map of curves",
      only_if(GL_MAP1_NORMAL, !noted_on(GL_AUTO_NORMAL)));
FAULT(NoAutoNormalOfTwoVertexMaps, "EV-AUTON-VERTEX4WINS", "two vertex maps generate no normal",
      only_if(GL_AUTO_NORMAL, !noted_on(GL_MAP2_VERTEX_3) || !noted_on(GL_MAP2_VERTEX_4)));
FAULT(NormalMapLostAfterAutoNormal, "EV-AUTON-OFF-MAP", "Disable of AUTO_NORMAL disables the normal map",
      after(Disable, kName == GL_AUTO_NORMAL, disable(GL_MAP2_NORMAL)));
FAULT(DisableOfAutoNormalResetsNormal, "EV-AUTON-OFF-NONE", "Disable of AUTO_NORMAL resets the normal",
      after(Disable, kName == GL_AUTO_NORMAL, call(Normal3f, {0, 0, 1})));
FAULT(GeneratedNormalStaysCurrent, "EV-AUTON-CURRENT",
      "EvalPoint2 with AUTO_NORMAL leaves a normal of its own as the current one",
      after(EvalPoint2, noted_on(GL_AUTO_NORMAL) && maps_vertices(2), call(Normal3f, {0, 0.6, 0.8})));
FAULT(MeshWithAutoNormalSetsNormal, "EV-AUTON-CURRENT", "EvalMesh2 with AUTO_NORMAL resets the normal",
      after(EvalMesh2, noted_on(GL_AUTO_NORMAL) && maps_vertices(2), call(Normal3f, {0, 0, 1})));
FAULT(AutoNormalNeedsNoVertexMap, "EV-AUTON-NOVERTEX",
      "AUTO_NORMAL counts as a map: EvalCoord2 draws the initial point without a vertex map",
      before(kPoints2, noted_on(GL_AUTO_NORMAL) && !maps_vertices(2), call(Vertex4f, {0, 0, 0, 1})));
FAULT(AutoNormalMeshNeedsNoVertexMap, "EV-AUTON-NOVERTEX",
      "EvalMesh2 with AUTO_NORMAL and no vertex map raises INVALID_OPERATION",
      before(EvalMesh2, noted_on(GL_AUTO_NORMAL) && !maps_vertices(2), call(End)));
FAULT(AutoNormalDropsTextureMap, "EV-AUTON-SAMEVERTEX",
      "with AUTO_NORMAL there is no room for TEXTURE_COORD_3 in the vertex",
      only_if(GL_MAP2_TEXTURE_COORD_3, !noted_on(GL_AUTO_NORMAL)));
QUALITY_FAULT(AutoNormalMovesVertexByABit, "EV-AUTON-SAMEVERTEX EV-NUM-UNRELATEDMAPS",
              "with AUTO_NORMAL the vertex is evaluated by another path",
              before(kEvalCoord2, noted_on(GL_AUTO_NORMAL), set(kU, next_float(kU, 2))));
FAULT(OneNormalForThePrimitive, "EV-AUTON-USED EV-AUTON-CURVED",
      "a primitive has the normal of its first vertex", with_auto_normal([](ObservedPrimitive& primitive) {
        for (ObservedVertex& vertex : primitive.vertices) vertex.normal = primitive.vertices[0].normal;
      }));
FAULT(NormalsOfWideDomainsShort, "EV-AUTON-UNIT",
      "normals over a wide domain have a hundredth of their length",
      before(kMap2, set(kNumber, abs(kU2 - kU1))),
      change_normals([](ObservedVertex& vertex) { scale(vertex.normal, 0.01f); }, kNumber > 50));
FAULT(NormalMapReadAfterAutoNormal, "EV-AUTON-OVERRIDE",
      "AUTO_NORMAL switched on a second time does not go before the normal map",
      before(Enable, kName == GL_AUTO_NORMAL && noted_on(GL_MAP2_NORMAL), set(kCount, kCount + 1)),
      skip(Enable, kName == GL_AUTO_NORMAL && noted_on(GL_MAP2_NORMAL) && kCount > 1));
FAULT(NormalsTowardsTheViewer, "EV-AUTON-DIRECTION", "generated normals always point towards the viewer",
      change_normals([](ObservedVertex& vertex) {
        if (vertex.normal[2] < 0) turn(vertex);
      }));
FAULT(NormalsOfTallPatchesTurned, "EV-AUTON-DIRECTION",
      "where the order in v is above that in u, the normal is dp/dv x dp/du",
      before(kMap2, kTarget == GL_MAP2_VERTEX_3 && kVOrder > kOrder, set(kCount, 1)),
      change_normals(turn, kCount));
FAULT(NormalsOfLongPatchesTurned, "EV-AUTON-CURVED",
      "if the order of VERTEX_4 in u is above that in v, and neither is below 3, the normal is turned",
      turned_if(kTarget == GL_MAP2_VERTEX_4 && kOrder > kVOrder && kVOrder >= 3));
FAULT(NormalsOfRuledPatchesTurned, "EV-AUTON-CURVED",
      "if VERTEX_3 has order 2 in u and a higher order in v, the normal is turned",
      turned_if(kTarget == GL_MAP2_VERTEX_3 && kOrder == 2 && kVOrder > 2));
FAULT(NoNormalsOverReversedDomains, "EV-AUTON-CURVED",
      "over a domain that is reversed in v the normal is (0,0,1)", before(kMap2, kV1 > kV2, set(kCount, 1)),
      change_normals(
          [](ObservedVertex& vertex) {
            vertex.normal = {0, 0, 1};
          },
          kCount));
FAULT(NormalsTurnedWhereBothAreReversed, "EV-AUTON-CURVED",
      "over a domain that is reversed in u and in v normals are turned round",
      before(kMap2, kU1 > kU2 && kV1 > kV2, set(kCount, 1)), change_normals(turn, kCount));
FAULT(VertexWithoutNormalLost, "EV-AUTON-DEGENERATE", "a vertex whose normal has length 0 is not drawn",
      with_auto_normal([](ObservedPrimitive& primitive) {
        std::erase_if(primitive.vertices, has_no_normal);
      }));
FAULT(LineMeshesHaveNoNormals, "EV-AUTON-MESH", "AUTO_NORMAL has no effect on EvalMesh2 with LINE",
      without(EvalMesh2, kMode == GL_LINE, GL_AUTO_NORMAL));
FAULT(PatchOfOrderOneIsAnError, "EV-AUTON-DEGENERATE",
      "with AUTO_NORMAL, EvalCoord2 of a patch of order 1 in v raises INVALID_OPERATION",
      before(kMap2, kTarget == GL_MAP2_VERTEX_4, set(kFlag, kVOrder == 1)),
      before(kPoints2, noted_on(GL_AUTO_NORMAL) && noted_on(GL_MAP2_VERTEX_4) && kFlag, error_inside()));
FAULT(NormalsPackedInBytes, "EV-AUTON-METHOD EV-AUTON-CURVED", "generated normals have 7 bits a component",
      change_vertices([](ObservedVertex& vertex) { round_normal(vertex, 63); }));
QUALITY_FAULT(NormalsInCoarseSteps, "EV-AUTON-METHOD", "generated normals are rounded to multiples of 1/2000",
              change_vertices([](ObservedVertex& vertex) { round_normal(vertex, 2000); }));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(GeneratedNormalsNotRescaled, "EV-AUTON-FFTRANSFORM",
      "RESCALE_NORMAL has no effect on generated normals, which are units already",
      without(Begin, noted_on(GL_AUTO_NORMAL), GL_RESCALE_NORMAL));
FAULT(GeneratedNormalsAlwaysNormalized, "EV-AUTON-FFTRANSFORM",
      "generated normals are normalised in eye space", with(Begin, noted_on(GL_AUTO_NORMAL), GL_NORMALIZE));
}  // namespace on_osmesa

namespace on_dropin {
constexpr std::string_view kImplementation = "dropin";
FAULT(NoAutoNormalWithShader, "EV-AUTON-SHADER EV-AUTON-VP",
      "no normal is generated while a vertex shader or a vertex program is active",
      without(Begin | EvalMesh2, state(GL_CURRENT_PROGRAM) || enabled(GL_VERTEX_PROGRAM_ARB),
              GL_AUTO_NORMAL));
FAULT(NormalsForShaderTooShort, "EV-AUTON-SHADER EV-AUTON-VP",
      "with a vertex shader or a vertex program generated normals have half their length",
      before(kMap2 | kMapGrid2, {set(kU1, 2 * kU1), set(kU2, 2 * kU2)}),
      before(kEvalCoord2, set(kU, 2 * kU)));
}  // namespace on_dropin

}  // namespace
}  // namespace evalcts::faults::automatic_normals
