// Faults against section 24.2 of the requirements: maps of vertex attributes, in a provider of this build
// that stands in for an implementation with NV_vertex_program (harness/tests/drills/nv_vertex_program.cpp).
#include "rules.h"

namespace evalcts::faults::nv_vertex_program {
namespace {

constexpr std::string_view kImplementation = kNvVertexProgram;

constexpr GLenum kCurveMap = 0x8660, kSurfaceMap = 0x8670;  // the maps of attribute 0
constexpr GLenum kNormal = 2, kColor = 3, kLast = 15;

const Value kInProgramMode = enabled(GL_VERTEX_PROGRAM_NV);
Value is_attribute_map(Value target) { return target >= kCurveMap && target <= kSurfaceMap + kLast; }

// Defines and enables the conventional map `target` with the control points of the map of an attribute, over
// (0, 1).
Value stand_in(GLenum target, GLenum attribute_map) {
  return [=](Call&) {
    GLint order[2] = {1, 1};
    GLfloat points[64];
    unmodified.GetMapiv(attribute_map, GL_ORDER, order);
    unmodified.GetMapfv(attribute_map, GL_COEFF, points);
    if (attribute_map >= kSurfaceMap)
      unmodified.Map2f(target, 0, 1, 4 * order[1], order[0], 0, 1, 4, order[1], points);
    else
      unmodified.Map1f(target, 0, 1, 4, order[0], points);
    unmodified.Enable(target);
  };
}

Restore enables_of_attribute_maps() {
  std::vector<Restore> all;
  for (GLenum cap = kCurveMap; cap <= kSurfaceMap + kLast; ++cap) all.push_back(enable_of(cap)());
  return [all] {
    for (const Restore& restore : all) restore();
  };
}

FAULT(FifteenAttributeMaps, "EV-EXT-NVVP-TOKENS", "Map2f does not know the map of attribute 15",
      before(Map2f, kTarget == kSurfaceMap + kLast, set(kTarget, 0)));
FAULT(AttributeMapsNotInGet, "EV-EXT-NVVP-TOKENS", "GetIntegerv tells FALSE of any map of an attribute",
      after(GetIntegerv, is_attribute_map(kName), put(0, GL_FALSE)));
FAULT(NormalAttributeHasThreeComponents, "EV-EXT-NVVP-K", "k is 3 for the map of attribute 2, as for normals",
      instead(Map1f, kTarget == kCurveMap + kNormal && kStride == 3 && kOrder >= 1, [](Call& c) {
        std::vector<double> points;
        for (std::size_t i = 0; i < static_cast<std::size_t>(c.argument('o')); ++i)
          points.insert(points.end(), {c.read(3 * i), c.read(3 * i + 1), c.read(3 * i + 2), 1});
        unmodified.Map1d(c.target(), c.argument('a'), c.argument('b'), 4, c.integer('o'), points.data());
      }));
FAULT(SmallVStrideOfAttributeMap, "EV-EXT-NVVP-K", "vstride is not checked for maps of attributes",
      before(Map2f, is_attribute_map(kTarget), set(kVStride, max(kVStride, 4))));
FAULT(FirstAttributeMapInitiallyOn, "EV-EXT-NVVP-INIT",
      "the map of attribute 0 is on from the start, as in NV_evaluators", initially(enable(kCurveMap)));
FAULT(AttributeMapsInitiallyZero, "EV-EXT-NVVP-INIT", "surfaces of attributes begin with (0, 0, 0, 0)",
      before(kMap2, set(remembered(kTarget), 1)),
      after(GetMapfv,
            kQuery == GL_COEFF && kTarget >= kSurfaceMap && is_attribute_map(kTarget) && !remembered(kTarget),
            put(3, 0)));
FAULT(ColorAttributeWithoutProgram, "EV-EXT-NVVP-MODE", "attribute 3 gives the colour without program mode",
      before(Begin, !kInProgramMode,
             {when(enabled(kCurveMap + kColor), stand_in(GL_MAP1_COLOR_4, kCurveMap + kColor)),
              when(enabled(kSurfaceMap + kColor), stand_in(GL_MAP2_COLOR_4, kSurfaceMap + kColor))}));
FAULT(VertexAttributeWithoutProgram, "EV-EXT-NVVP-MODE",
      "the map of attribute 0 gives vertices without program mode where no other does",
      before(Begin, !kInProgramMode,
             {when(!evaluates() && enabled(kCurveMap), stand_in(GL_MAP1_VERTEX_4, kCurveMap)),
              when(!evaluates() && enabled(kSurfaceMap), stand_in(GL_MAP2_VERTEX_4, kSurfaceMap))}));
FAULT(ConventionalColorWins, "EV-EXT-NVVP-PRIORITY", "COLOR_4 goes before the map of attribute 3 in curves",
      without(Begin, kInProgramMode != 0 && enabled(GL_MAP1_COLOR_4), kCurveMap + kColor));
FAULT(DisabledAttributeMapShadows, "EV-EXT-NVVP-PRIORITY",
      "in program mode surfaces have no conventional colours, whether attribute 3 has a map or not",
      without(Begin, kInProgramMode && !enabled(kSurfaceMap + kColor), GL_MAP2_COLOR_4));
FAULT(VertexAttributeDrawsNothing, "EV-EXT-NVVP-VERTEX",
      "the map of attribute 0 is not a vertex map of curves", without(Begin, kInProgramMode, kCurveMap));
FAULT(VertexAttributeWithoutOtherMaps, "EV-EXT-NVVP-VERTEX",
      "with the map of attribute 0 alone for a vertex map conventional maps do nothing",
      without(Begin, kInProgramMode != 0 && enabled(kSurfaceMap) && !evaluates(), GL_MAP2_COLOR_4));
FAULT(AutoNormalOffInProgramMode, "EV-EXT-NVVP-AUTON", "AUTO_NORMAL does nothing in program mode",
      without(Begin, kInProgramMode, GL_AUTO_NORMAL));
FAULT(AutoNormalOfUnitLength, "EV-EXT-NVVP-AUTON",
      "in program mode AUTO_NORMAL gives unit normals",  // The normal of any patch in the plane of x and y.
      before(Begin, kInProgramMode != 0 && enabled(GL_AUTO_NORMAL), call(Normal3f, {0, 0, 1})),
      without(Begin, kInProgramMode, GL_AUTO_NORMAL));
FAULT(EvaluatedNormalStays, "EV-EXT-NVVP-CURRENT", "the current normal is that of the last evaluation",
      after(End, enabled(kCurveMap + kNormal) || enabled(kSurfaceMap + kNormal), call(Normal3f, {0, 0, 1})));
FAULT(EvaluatedColorStays, "EV-EXT-NVVP-CURRENT", "the surface of attribute 3 sets the current colour",
      after(End, enabled(kSurfaceMap + kColor), call(Color4f, {0.5, 0.25, 0.125, 0.75})));
FAULT(AttributeMapsNotInEnableBit, "EV-EXT-NVVP-STACK", "ENABLE_BIT does not restore maps of attributes",
      not_restored(enables_of_attribute_maps, kLevelMask == GL_ENABLE_BIT));
FAULT(LastAttributeMapNotInEvalBit, "EV-EXT-NVVP-STACK",
      "EVAL_BIT does not restore the enable of the curve of attribute 15",
      not_restored(enable_of(kCurveMap + kLast), kLevelMask == GL_EVAL_BIT));

}  // namespace
}  // namespace evalcts::faults::nv_vertex_program
