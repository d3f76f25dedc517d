// Faults against section 19 of the requirements: commands between Begin and End, and their order.
#include "grid_steps.h"

namespace evalcts::faults::ordering {
namespace {

FAULT(MeshIgnoredInPrimitives, "EV-BE-ALLOWED", "EvalMesh1 in a primitive does nothing and raises nothing",
      skip(EvalMesh1, kInside));
FAULT(Map2SplitsPrimitive, "EV-BE-IGNORED/2-D",
      "Map2f in a primitive raises its error and begins a new primitive of the mode",
      after(Map2f, kInside, {call(End), call(Begin, {kOpenMode})}));
FAULT(RefusedMapSwallowsNextVertex, "EV-BE-IGNORED/1-D", "an EvalCoord1f after a rejected Map1d is lost",
      before(Map1d, set(kFlag, kInside)), instead(EvalCoord1f, kFlag, set(kFlag, 0)));
FAULT(BadMeshModeLeavesPrimitiveOpen, "EV-BE-MESHNOTINSIDE",
      "EvalMesh2 with a bad mode raises its error inside a primitive that it never ends",
      after(EvalMesh2, !kIsMode2, call(Begin, {GL_POINTS})));
FAULT(EmptyLineMeshLeavesStripOpen, "EV-BE-MESHNOTINSIDE", "an empty LINE of EvalMesh1 leaves its strip open",
      after(EvalMesh1, kMode == GL_LINE && kI1 > kI2, call(Begin, {GL_LINE_STRIP})));
FAULT(ColorWaitsForEnd, "EV-BE-ORDER",
      "if curves are enabled, Color4f outside of primitives takes effect after the next primitive",
      instead(Color4f, !kInside && maps_vertices(1), {drop(), hold()}), after(End, release()));
FAULT(GridWaitsForMesh, "EV-BE-ORDER/2-D", "MapGrid2f after a mesh takes effect after the next mesh",
      instead(MapGrid2f, kFlag, {drop(), hold()}), after(EvalMesh2, {set(kFlag, 1), release()}));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(MeshTakesLaterColor, "EV-BE-ORDER/1-D",
      "EvalMesh1 is carried out with the next command that draws, and takes the current colour from there",
      instead(EvalMesh1, {release(), hold()}),
      before(kMap1 | kMapGrid1 | kSwitches | LoadMatrixf | Materialfv | Begin | RenderMode | GetError,
             release()));
}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::ordering
