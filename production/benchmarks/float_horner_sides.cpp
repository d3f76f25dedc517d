// The loops of "float Horner", in another file than the functions that they call, so that nothing is inlined.
#include <cmath>

#include "float_horner.h"
#include "side.h"

namespace evalcts::bench {
namespace {

void point_with_normal(const Mesh& mesh, float u, float v, float* result) {
  float along_u[4], along_v[4];
  de_casteljau_surface(mesh.points.data(), mesh.order, mesh.order, mesh.components, u, v, result, along_u,
                       along_v);
  float* const normal = result + mesh.components;
  normal[0] = along_u[1] * along_v[2] - along_u[2] * along_v[1];
  normal[1] = along_u[2] * along_v[0] - along_u[0] * along_v[2];
  normal[2] = along_u[0] * along_v[1] - along_u[1] * along_v[0];
  const float length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (length > 0) {
    for (int k = 0; k < 3; ++k) normal[k] /= length;
  }
}

[[maybe_unused]] const bool kRegistered = [] {
  const auto add_curve = [](const Curve& curve) {
    add(curve, "float_Horner",
        [&curve]() -> CurveSide { return [&curve](float* results) { horner_points(curve, results); }; });
  };
  for (const Curve& curve : curves()) add_curve(curve);
  for (const Curve& curve : hard_curves()) add_curve(curve);
  for (const Mesh& mesh : meshes()) {
    add(mesh, "float_Horner", Unit::kStrip, [&mesh]() -> MeshSide {
      return [&mesh](int row, int rows, float* results) { horner_rows(mesh, row, rows, results); };
    });
  }
  return true;
}();

}  // namespace

void horner_points(const Curve& curve, float* results) {
  for (const float u : curve.u) {
    horner_curve(curve.points.data(), curve.order, curve.components, u, results);
    results += curve.components;
  }
}

void horner_rows(const Mesh& mesh, int row, int rows, float* results) {
  const float du = mesh.u(1);
  for (int j = row; j < row + rows; ++j) {
    const float v = mesh.v(j);
    for (int i = 0; i < mesh.columns; ++i, results += mesh.values()) {
      const float u = static_cast<float>(i) * du;
      if (mesh.normals) {
        point_with_normal(mesh, u, v, results);
      } else {
        horner_surface(mesh.points.data(), mesh.order, mesh.order, mesh.components, u, v, results);
      }
    }
  }
}

}  // namespace evalcts::bench
