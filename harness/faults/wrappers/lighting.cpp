// Faults against section 12 of the requirements: evaluated colours in the lighting equation.
#include "rules.h"

namespace evalcts::faults::lighting {
namespace {

constexpr std::string_view kImplementation = "osmesa";

const Value kTracked = state(GL_COLOR_MATERIAL_PARAMETER), kTrackedFace = state(GL_COLOR_MATERIAL_FACE);
State color_material() { return setting(ColorMaterial, {kTrackedFace, kTracked}); }

// Makes primitives track colours on `face` if the condition holds.
Rules track_on(GLenum face, Value condition) {
  return keeping(Begin, enabled(GL_COLOR_MATERIAL) && condition, color_material(),
                 call(ColorMaterial, {face, kTracked}));
}

Value has_only_colors(GLenum map) { return enabled(map) && enabled(GL_COLOR_MATERIAL) && !evaluates(); }

// Sets kFlag in primitives that track evaluated colours, and kCount to the number of their vertices.
Rules note_tracking() {
  return {before(Begin, {set(kFlag, enabled(GL_COLOR_MATERIAL) && enabled(GL_MAP1_COLOR_4) && evaluates()),
                         set(kCount, 0)}),
          before(kEvalCoord1, kFlag, set(kCount, kCount + 1))};
}

FAULT(ArraysTakeMaps, "EV-BE-OTHERS", "EnableClientState of COLOR_ARRAY disables the maps of colours",
      after(EnableClientState, kFirst == GL_COLOR_ARRAY,
            {disable(GL_MAP1_COLOR_4), disable(GL_MAP2_COLOR_4)}));
FAULT(MaterialLosesMaps, "EV-BE-OTHERS",
      "after Material between Begin and End, the maps of colours are disabled",
      before(Materialfv, kInside, set(kFlag, 1)),
      after(End, kFlag, {set(kFlag, 0), disable(GL_MAP1_COLOR_4), disable(GL_MAP2_COLOR_4)}));
FAULT(SurfaceTracksCurrentColor, "EV-CMAT-EFFECT/2-D", "EvalCoord2 gives no colour while DIFFUSE is tracked",
      without(Begin, enabled(GL_COLOR_MATERIAL) && kTracked == GL_DIFFUSE, GL_MAP2_COLOR_4));
FAULT(FirstVertexTracksCurrentColor, "EV-CMAT-EFFECT",
      "the first EvalCoord1 of a lit primitive is lit with the current colour",
      before(Begin,
             {set(kFlag, enabled(GL_COLOR_MATERIAL) && enabled(GL_LIGHTING) && enabled(GL_MAP1_COLOR_4)),
              keep_state(GL_CURRENT_COLOR)}),
      instead(kEvalCoord1, kFlag,
              {set(kFlag, 0), call(Color4d, kept_values(4)), call(Vertex3f, {kU, 0, 0})}));
FAULT(EvaluatedColorOnOtherFace, "EV-CMAT-FACES", "evaluated colours that BACK tracks go to the front",
      track_on(GL_FRONT, evaluates() && kTrackedFace == GL_BACK));
FAULT(SurfaceColorOnBothFaces, "EV-CMAT-FACES/2-D",
      "evaluated colours of surfaces are tracked on both faces though ColorMaterial names one",
      track_on(GL_FRONT_AND_BACK, enabled(GL_MAP2_VERTEX_3)));
FAULT(EvaluatedColorAlwaysEmitted, "EV-CMAT-OFF",
      "evaluated colours are the emission of lit primitives though COLOR_MATERIAL is off",
      around(Begin, evaluates() && enabled(GL_LIGHTING) && !enabled(GL_COLOR_MATERIAL),
             {call(ColorMaterial, {GL_FRONT_AND_BACK, GL_EMISSION}), enable(GL_COLOR_MATERIAL)},
             disable(GL_COLOR_MATERIAL)));
FAULT(UnlitPrimitiveColorGoesToMaterial, "EV-CMAT-UNLIT",
      "with COLOR_MATERIAL on EvalCoord gives the vertex no colour, lit or not",
      without(Begin, enabled(GL_COLOR_MATERIAL) && !enabled(GL_LIGHTING), GL_MAP1_COLOR_4));
FAULT(SurfaceMeshAlwaysTracksColors, "EV-CMAT-OFF/2-D",
      "EvalMesh2 is lit with evaluated colours though COLOR_MATERIAL is off",
      with(EvalMesh2, enabled(GL_LIGHTING), GL_COLOR_MATERIAL));
FAULT(UnlitSurfaceMeshHasCurrentColor, "EV-CMAT-UNLIT/2-D",
      "an unlit EvalMesh2 with COLOR_MATERIAL on has the current colour",
      without(EvalMesh2, enabled(GL_COLOR_MATERIAL) && !enabled(GL_LIGHTING), GL_MAP2_COLOR_4));
FAULT(SurfaceMeshWithoutVerticesTracks, "EV-CMAT-NOVERTEX/2-D",
      "EvalMesh2 without a vertex map leaves its first colour in the tracked material",
      before(EvalMesh2, has_only_colors(GL_MAP2_COLOR_4),
             [](Call&) { unmodified.Color4dv(current_map(GL_MAP2_COLOR_4).net.point(0)); }));
FAULT(EvalCoordWithoutVerticesTracks, "EV-CMAT-NOVERTEX",
      "EvalCoord1 without a vertex map makes its colour the tracked one",
      before(Begin,
             {set(kFlag, has_only_colors(GL_MAP1_COLOR_4)),
              when(kFlag, [](Call&) { remembered_list() = current_map(GL_MAP1_COLOR_4).net.values; })}),
      before(kEvalCoord1, kFlag, [](Call&) { unmodified.Color4dv(remembered_list().data()); }));

namespace on_dropin {
constexpr std::string_view kImplementation = "dropin";
FAULT(EvaluatedColorStaysInMaterial, "EV-CMAT-NOSTATE",
      "after EvalCoord1 with COLOR_MATERIAL the tracked material is another one", note_tracking(),
      after(GetMaterialfv, kCount && (kSecond == GL_EMISSION || kSecond == GL_DIFFUSE),
            put(0, element(0) + 0.0625)));
FAULT(EvaluatedColorStaysCurrent, "EV-CMAT-NOCURRENT", "EvalCoord1 with COLOR_MATERIAL changes the colour",
      note_tracking(), after(End, kCount, call(Color4f, {0.125, 0.25, 0.375, 1})));
FAULT(NextVertexTracksEvaluatedColor, "EV-CMAT-NEXT",
      "a Vertex behind EvalCoord1 is lit with another colour than the current one", note_tracking(),
      keeping(Begin, kFlag, current(Color4d, GL_CURRENT_COLOR)),
      after(kEvalCoord1, kFlag, call(Color4f, {1, 0.125, 0, 1})));
}  // namespace on_dropin

}  // namespace
}  // namespace evalcts::faults::lighting
