// Benchmarks the NURBS evaluator of GLU, which passes its vertices to callbacks in an order that it chooses.
// In meshes, it delivers the vertices that strips share twice; curves are sampled at equal steps. The time is
// that of one delivered vertex.
#include <GL/glu.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

#include "float_horner.h"
#include "shared_object.h"
#include "side.h"

namespace evalcts::bench {
namespace {

constexpr int kMaxOrder = 24;
constexpr int kMeshRows = 16;
constexpr std::size_t kPlaces = 4096;  // number of results, used round-robin

#define EVALCTS_GLU(name) decltype(&::name) name = library.find<decltype(&::name)>(#name)
struct Glu {
  SharedObject library{"libGLU.so.1"};
  EVALCTS_GLU(gluNewNurbsRenderer);
  EVALCTS_GLU(gluNurbsProperty);
  EVALCTS_GLU(gluNurbsCallback);
  EVALCTS_GLU(gluNurbsCallbackData);
  EVALCTS_GLU(gluLoadSamplingMatrices);
  EVALCTS_GLU(gluBeginCurve);
  EVALCTS_GLU(gluNurbsCurve);
  EVALCTS_GLU(gluEndCurve);
  EVALCTS_GLU(gluBeginSurface);
  EVALCTS_GLU(gluNurbsSurface);
  EVALCTS_GLU(gluEndSurface);
};
#undef EVALCTS_GLU

const Glu& glu() {
  static const Glu kFunctions;
  return kFunctions;
}

// The state of the callbacks that receive the vertices.
struct Delivery {
  std::size_t components, vertices = 0;
};

void GLAPIENTRY deliver(GLfloat* vertex, void* data) {
  auto& delivery = *static_cast<Delivery*>(data);
  std::memcpy(results() + delivery.vertices % kPlaces * delivery.components, vertex,
              delivery.components * sizeof(float));
  ++delivery.vertices;
}

GLUnurbs* renderer(float u_steps, float v_steps, Delivery& delivery) {
  GLUnurbs* const nurbs = glu().gluNewNurbsRenderer();
  const auto set = [nurbs](GLenum property, float value) { glu().gluNurbsProperty(nurbs, property, value); };
  set(GLU_NURBS_MODE, GLU_NURBS_TESSELLATOR);
  set(GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE);
  set(GLU_U_STEP, u_steps);
  set(GLU_V_STEP, v_steps);
  // There is no GL whose matrices GLU could load.
  set(GLU_AUTO_LOAD_MATRIX, GL_FALSE);
  const GLfloat identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const GLint viewport[4] = {0, 0, 1024, 1024};
  glu().gluLoadSamplingMatrices(nurbs, identity, identity, viewport);
  glu().gluNurbsCallback(nurbs, GLU_NURBS_VERTEX_DATA, reinterpret_cast<_GLUfuncptr>(deliver));
  glu().gluNurbsCallbackData(nurbs, &delivery);
  return nurbs;
}

std::vector<float> knots(int order) {
  std::vector<float> result(2 * static_cast<std::size_t>(order));
  for (int i = 0; i < order; ++i) result[order + i] = 1;
  return result;
}

// Checks the vertices of one run. The first component of the control points (for meshes: the first two) is
// the argument. The third and fourth component must be those of float Horner at this argument.
template <class Workload, class Expected>
void check(const Workload& workload, std::size_t vertices, std::size_t at_least, const Expected& expected) {
  if (vertices < at_least) throw std::runtime_error("GLU delivers too few vertices");
  const std::size_t components = workload.components;
  std::vector<float> wanted(components);
  for (std::size_t i = 0; i < std::min(vertices, kPlaces); ++i) {
    const float* const vertex = results() + i * components;
    expected(vertex, wanted.data());
    check_agreement({vertex + 2, components - 2}, {wanted.data() + 2, components - 2},
                    tolerance_for(workload.order, workload.points));
  }
}

Measured curve_side(const Curve& curve) {
  const auto delivery = std::make_shared<Delivery>(Delivery{static_cast<std::size_t>(curve.components)});
  GLUnurbs* const nurbs = renderer(static_cast<float>(curve.u.size() - 1), 1, *delivery);
  const auto draw = [&curve, nurbs, knot = knots(curve.order)](const std::vector<float>& points) {
    std::vector<float> k = knot, p = points;  // GLU needs non-const arrays
    glu().gluBeginCurve(nurbs);
    glu().gluNurbsCurve(nurbs, 2 * curve.order, k.data(), curve.components, p.data(), curve.order,
                        curve.components == 3 ? GL_MAP1_VERTEX_3 : GL_MAP1_VERTEX_4);
    glu().gluEndCurve(nurbs);
  };
  std::vector<float> own = curve.points;
  for (int i = 0; i < curve.order; ++i)
    own[i * curve.components] = static_cast<float>(i) / static_cast<float>(curve.order - 1);
  draw(own);
  check(curve, delivery->vertices, curve.u.size(), [&curve](const float* at, float* expected) {
    horner_curve(curve.points.data(), curve.order, curve.components, at[0], expected);
  });
  return {[&curve, draw, delivery] { draw(curve.points); }, static_cast<std::int64_t>(delivery->vertices)};
}

Measured mesh_side(const Mesh& mesh) {
  const auto delivery = std::make_shared<Delivery>(Delivery{static_cast<std::size_t>(mesh.components)});
  GLUnurbs* const nurbs = renderer(static_cast<float>(mesh.columns - 1), kMeshRows - 1, *delivery);
  const auto draw = [&mesh, nurbs, knot = knots(mesh.order)](const std::vector<float>& points) {
    std::vector<float> u = knot, v = knot, p = points;
    glu().gluBeginSurface(nurbs);
    glu().gluNurbsSurface(nurbs, 2 * mesh.order, u.data(), 2 * mesh.order, v.data(), mesh.components,
                          mesh.order * mesh.components, p.data(), mesh.order, mesh.order, GL_MAP2_VERTEX_3);
    glu().gluEndSurface(nurbs);
  };
  std::vector<float> own = mesh.points;
  for (int j = 0; j < mesh.order; ++j) {
    for (int i = 0; i < mesh.order; ++i) {
      float* const point = &own[(j * mesh.order + i) * mesh.components];
      point[0] = static_cast<float>(i) / static_cast<float>(mesh.order - 1);
      point[1] = static_cast<float>(j) / static_cast<float>(mesh.order - 1);
    }
  }
  draw(own);
  check(mesh, delivery->vertices, static_cast<std::size_t>(mesh.columns) * kMeshRows,
        [&mesh](const float* at, float* expected) {
          horner_surface(mesh.points.data(), mesh.order, mesh.order, mesh.components, at[0], at[1], expected);
        });
  return {[&mesh, draw, delivery] { draw(mesh.points); }, static_cast<std::int64_t>(delivery->vertices)};
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Curve& curve : curves()) {
    if (curve.order <= kMaxOrder) add(curve.name + "/GLU", [&curve] { return curve_side(curve); });
  }
  for (const Mesh& mesh : meshes()) {
    // Meshes of four components are omitted, because GLU divides by the last one.
    if (mesh.order <= kMaxOrder && mesh.components == 3 && mesh.ring != mesh.rows && !mesh.normals)
      add(mesh.name + "/GLU", [&mesh] { return mesh_side(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
