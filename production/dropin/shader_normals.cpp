// Automatic normals with a vertex shader: m = q_u x q_v is not normalised (GL 2.0 section 5.1,
// ARB_vertex_program issue 92).
#include <cmath>

#include "context.h"

namespace glev::dropin {

bool Context::is_vertex_shader_active() {
  if (vertex_programs && gl_below().IsEnabled(GL_VERTEX_PROGRAM_ARB)) return true;
  if (version < 20) return false;
  const auto program = static_cast<GLuint>(get_integer(GL_CURRENT_PROGRAM, 0));
  if (program == 0) {
    const auto pipeline =
        static_cast<GLuint>(version >= 41 ? get_integer(GL_PROGRAM_PIPELINE_BINDING, 0) : 0);
    GLint shader = 0;
    if (pipeline != 0) gl_below().GetProgramPipelineiv(pipeline, GL_VERTEX_SHADER, &shader);
    return shader != 0;
  }
  GLuint shaders[16];
  GLsizei count = 0;
  gl_below().GetAttachedShaders(program, 16, &count, shaders);
  for (GLsizei i = 0; i < count; ++i) {
    GLint type = 0;
    gl_below().GetShaderiv(shaders[i], GL_SHADER_TYPE, &type);
    if (type == GL_VERTEX_SHADER) return true;
  }
  return count == 0;  // shaders may be detached after linking; assumes a vertex shader
}

// Returns the length of m at one point, whose arguments are in the batch or the mesh.
double Context::length_of_normal(const glev_batch* batch, const glev_mesh* mesh) {
  const glev_plan_info info = {sizeof info, 2};
  glev_plan* plan = nullptr;
  if (glevCreatePlan(evaluators, &info, &plan) != GLEV_SUCCESS) return 1;
  double p[4] = {0, 0, 0, 1}, p_u[4] = {}, p_v[4] = {};
  const auto output = [](double* values) {
    return glev_output{
        sizeof(glev_output), values, 4 * sizeof(double), 4 * sizeof(double), 4, GLEV_DOUBLE, 0, 0};
  };
  const glev_output vertex = output(p), tangent_u = output(p_u), tangent_v = output(p_v);
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &vertex},
                                           {GLEV_ATTRIBUTE_TANGENT_U, &tangent_u},
                                           {GLEV_ATTRIBUTE_TANGENT_V, &tangent_v}};
  glev_result result;
  if (batch != nullptr) {
    glev_batch request = *batch;
    request.outputs = outputs;
    request.output_count = std::size(outputs);
    result = glevEvaluate(plan, &request);
  } else {
    glev_mesh request = *mesh;
    request.outputs = outputs;
    request.output_count = std::size(outputs);
    request.scratch_size = glevGetMeshScratchSize(plan, &request);
    request.scratch = request.scratch_size > 0 ? std::malloc(request.scratch_size) : nullptr;
    result = glevEvaluateMesh(plan, &request);
    std::free(request.scratch);
  }
  glevReleasePlan(plan);
  if (result != GLEV_SUCCESS) return 1;
  // q = p / w. For three components, w is 1 and its derivatives are 0.
  double a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = (p_u[k] * p[3] - p[k] * p_u[3]) / (p[3] * p[3]);
    b[k] = (p_v[k] * p[3] - p[k] * p_v[3]) / (p[3] * p[3]);
  }
  return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

}  // namespace glev::dropin
