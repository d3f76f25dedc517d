// Faults against section 19 of the requirements: commands between Begin and End, and their order.
#include "grid_steps.h"

namespace evalcts::faults::ordering {
namespace {

// The command ends the primitive that it is called in.
Rules end_early(const Entries& command) {
  return {after(command, kInside && !kFlag, {call(End), set(kFlag, 1)}), before(Begin, set(kFlag, 0)),
          instead(End, kFlag, set(kFlag, 0))};
}

// Executes a delayed LoadMatrixf.
void load_late_matrix(Call&) {
  const std::vector<double> matrix = std::exchange(remembered_list(), {});
  if (!matrix.empty()) unmodified.LoadMatrixf(std::vector<GLfloat>(matrix.begin(), matrix.end()).data());
}

FAULT(EvalCoord1dvRefusedOnceInPrimitive, "EV-BE-ALLOWED",
      "the fourth EvalCoord1dv of a TRIANGLE_FAN raises INVALID_OPERATION", before(Begin, set(kCount, 0)),
      after(EvalCoord1dv, kOpenMode == GL_TRIANGLE_FAN,
            {set(kCount, kCount + 1), when(kCount == 4, error(GL_INVALID_OPERATION))}));
FAULT(MeshIgnoredInPrimitives, "EV-BE-ALLOWED", "EvalMesh1 in a primitive does nothing and raises nothing",
      skip(EvalMesh1, kInside));
FAULT(Map2SplitsPrimitive, "EV-BE-IGNORED/2-D",
      "Map2f in a primitive raises its error and begins a new primitive of the mode",
      after(Map2f, kInside, {call(End), call(Begin, {kOpenMode})}));
FAULT(MeshDrawnIntoPrimitive, "EV-BE-IGNORED/1-D",
      "EvalMesh1 of points in a primitive raises its error and adds its vertices",
      after(EvalMesh1, kMode == GL_POINT && kInside, loop(kColumn, kI1, kI2, call(EvalPoint1, {kColumn}))));
FAULT(RefusedMapSwallowsNextVertex, "EV-BE-IGNORED/1-D",
      "the EvalCoord1f that follows a Map1d in a primitive is lost", before(Map1d, set(kFlag, kInside)),
      instead(EvalCoord1f, kFlag, set(kFlag, 0)));
FAULT(RefusedQueryEndsPrimitive, "EV-BE-IGNORED",
      "GetMapdv in a primitive raises its error and ends the primitive", end_early(GetMapdv));
FAULT(RefusedEnableRestartsStrip, "EV-BE-IGNORED",
      "Disable of a map of two dimensions in a primitive raises its error and forgets the last vertex",
      after(Disable, is_map2(kName) && kInside, set(kFlag, 1)), change_output(kFlag, [](Primitives& all) {
        if (!all.empty() && all.front().vertices.size() > 1)
          all.front().vertices.erase(all.front().vertices.begin());
      }));
FAULT(BadMeshModeLeavesPrimitiveOpen, "EV-BE-MESHNOTINSIDE",
      "EvalMesh2 with a bad mode raises its error inside a primitive that it never ends",
      after(EvalMesh2, !kIsMode2, call(Begin, {GL_POINTS})));
FAULT(EmptyLineMeshLeavesStripOpen, "EV-BE-MESHNOTINSIDE",
      "EvalMesh1 LINE with an empty range begins a strip and returns",
      after(EvalMesh1, kMode == GL_LINE && kI1 > kI2, call(Begin, {GL_LINE_STRIP})));
FAULT(MeshWithoutMapsLeavesPrimitiveOpen, "EV-BE-MESHNOTINSIDE",
      "EvalMesh2 FILL without a vertex map begins a strip and returns",
      after(EvalMesh2, kMode == GL_FILL && !enabled(GL_MAP2_VERTEX_3) && !enabled(GL_MAP2_VERTEX_4),
            call(Begin, {GL_QUAD_STRIP})));
FAULT(MeshInPrimitiveEndsIt, "EV-BE-IGNORED/2-D",
      "EvalMesh2 in a primitive raises its error and leaves the GL outside it", end_early(EvalMesh2));
FAULT(GridWaitsForMesh, "EV-BE-ORDER", "MapGrid1f after a mesh takes effect after the next mesh",
      instead(MapGrid1f, kFlag, {drop(), hold()}), after(EvalMesh1, {set(kFlag, 1), release()}));
FAULT(ColorWaitsForEnd, "EV-BE-ORDER", "Color4f outside of primitives takes effect after the next primitive",
      instead(Color4f, !kInside, {drop(), hold()}), after(End, release()));
FAULT(DisableWaitsForBegin, "EV-BE-ORDER", "Disable of MAP1_NORMAL is seen by the primitive after the next",
      instead(Disable, kName == GL_MAP1_NORMAL, set(kFlag, 1)),
      before(Enable, kName == GL_MAP1_NORMAL, set(kFlag, 0)),
      after(End, kFlag, {set(kFlag, 0), disable(GL_MAP1_NORMAL)}));

// --- Faults that need matrices and materials

FAULT(MeshOfOnePointLeavesStripOpen, "EV-BE-MESHNOTINSIDE",
      "EvalMesh2 LINE of a single row and column begins a strip and returns",
      after(EvalMesh2, kMode == GL_LINE && kI1 == kI2 && kJ1 == kJ2, call(Begin, {GL_LINE_STRIP})));

namespace on_osmesa {

constexpr std::string_view kImplementation = "osmesa";

FAULT(MatrixWaitsForMesh, "EV-BE-ORDER/2-D",
      "LoadMatrixf is carried out after the mesh of two dimensions that follows it",
      instead(LoadMatrixf,
              [](Call& c) {
                for (std::size_t i = 0; i < 16; ++i) remembered_list().push_back(c.read(i));
              }),
      before(Begin | EvalMesh1, load_late_matrix), after(EvalMesh2, load_late_matrix));
FAULT(MeshTakesLaterColor, "EV-BE-ORDER/1-D",
      "EvalMesh1 is carried out with the next command that draws, and takes the current colour from there",
      instead(EvalMesh1, {release(), hold()}),
      before(kMap1 | kMapGrid1 | kSwitches | LoadMatrixf | Materialfv | Begin | RenderMode | GetError,
             release()));

}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::ordering
