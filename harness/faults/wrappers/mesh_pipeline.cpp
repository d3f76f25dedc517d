// Faults against sections 15 and 16 of the requirements, later stages of the pipeline: stippling, faces,
// polygon modes.
#include "grid_steps.h"

namespace evalcts::faults::mesh_pipeline {
namespace {

constexpr std::string_view kImplementation = "osmesa";

// Index halfway between i1 and i2.
const Value kMiddle = kI1 + (kI2 - kI1 - (kI2 - kI1) % 2) / 2;

Value set_two_sides(Value on) {
  return [=](Call& c) {
    const auto value = static_cast<GLfloat>(on(c));
    unmodified.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, &value);
  };
}

FAULT(CurveMeshOfSeparateLines, "EV-MESH1-STIPPLE",
      "EvalMesh1 with LINE draws separate lines: the stipple restarts at each",
      instead(EvalMesh1, kMode == GL_LINE,
              loop(kColumn, kI1, kI2 - 1, curve(GL_LINE, kColumn, kColumn + 1))));
FAULT(CurveMeshInTwoStrips, "EV-MESH1-STIPPLE", "EvalMesh1 with LINE draws a second strip from the middle on",
      instead(EvalMesh1, kMode == GL_LINE && kI2 - kI1 >= 2,
              {curve(GL_LINE, kI1, kMiddle), curve(GL_LINE, kMiddle, kI2)}));
FAULT(RowsInTwoStrips, "EV-MESH2-STIPPLE", "strips along u of EvalMesh2 are drawn in two halves",
      instead(EvalMesh2, kMode == GL_LINE && kI2 - kI1 >= 2,
              {loop(kRow, kJ1, kJ2,
                    {surface(GL_LINE, kI1, kMiddle, kRow, kRow), surface(GL_LINE, kMiddle, kI2, kRow, kRow)}),
               kColumns}));
FAULT(SurfaceMeshOfSeparateLines, "EV-MESH2-STIPPLE", "strips along v of EvalMesh2 are separate lines",
      instead(EvalMesh2, kMode == GL_LINE,
              {kRows, loop(kColumn, kI1, kI2,
                           loop(kRow, kJ1, kJ2 - 1, surface(GL_LINE, kColumn, kColumn, kRow, kRow + 1)))}));
FAULT(StripsOfMeshesClockwise, "EV-MESH2-WINDING EV-MESH2-TWOSIDE", "FILL turns its quads the other way",
      instead(EvalMesh2, kMode == GL_FILL, draw_strips(GL_QUAD_STRIP, 1)));
FAULT(MeshesHaveFrontsOnly, "EV-MESH2-TWOSIDE", "EvalMesh2 with AUTO_NORMAL lights the front alone",
      around(EvalMesh2, true,
             {set(kNumber, state(GL_LIGHT_MODEL_TWO_SIDE)), when(enabled(GL_AUTO_NORMAL), set_two_sides(0))},
             set_two_sides(kNumber)));
FAULT(LineMeshesFollowPolygonMode, "EV-MESH2-NOPOLYMODE", "LINE meshes are points in polygon mode POINT",
      before(EvalMesh2, kMode == GL_LINE && state(GL_POLYGON_MODE) == GL_POINT, set(kMode, GL_POINT)));
FAULT(FilledMeshesNeverCulled, "EV-MESH2-NOPOLYMODE", "EvalMesh2 with FILL is not culled",
      without(EvalMesh2, true, GL_CULL_FACE));
QUALITY_FAULT(HalfOfEachQuad, "EV-MESH2-PLANAR", "EvalMesh2 with FILL draws three corners of each quad",
              instead(EvalMesh2, kMode == GL_FILL, draw_quads(GL_TRIANGLES, {0, 1, 3})));

namespace on_dropin {
constexpr std::string_view kImplementation = "dropin";
FAULT(FilledMeshesOfTriangleStrips, "EV-MESH2-ISQUADS EV-MESH2-FLAT", "FILL draws triangle strips",
      instead(EvalMesh2, kMode == GL_FILL, draw_strips(GL_TRIANGLE_STRIP)));
FAULT(FlatColorOfAnotherCorner, "EV-MESH2-FLAT", "FILL draws quads whose last vertex is (i,j+1)",
      instead(EvalMesh2, kMode == GL_FILL, draw_quads(GL_QUADS, {2, 3, 0, 1})));
FAULT(FlatColorByFirstVertexOfAnotherCorner, "EV-MESH2-FLAT-FIRST",
      "by the first vertex convention quads of EvalMesh2 begin at (i,j+1) and end at (i,j)",
      instead(EvalMesh2, kMode == GL_FILL && state(GL_PROVOKING_VERTEX) == GL_FIRST_VERTEX_CONVENTION,
              draw_quads(GL_QUADS, {1, 2, 3, 0})));
}  // namespace on_dropin

}  // namespace
}  // namespace evalcts::faults::mesh_pipeline
