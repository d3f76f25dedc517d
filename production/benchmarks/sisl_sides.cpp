// Benchmarks SISL: points of curves one by one, and whole grids. It computes in double.
#include <sisl.h>

#include <memory>
#include <stdexcept>

#include "side.h"

namespace evalcts::bench {
namespace {

constexpr int kBezier = 3, kCopy = 1;

std::vector<double> knots(int order) {
  std::vector<double> result(2 * static_cast<std::size_t>(order));
  for (int i = 0; i < order; ++i) result[order + i] = 1;
  return result;
}

CurveSide points_one_by_one(const Curve& curve) {
  std::vector<double> points(curve.points.begin(), curve.points.end()), knot = knots(curve.order);
  const std::shared_ptr<SISLCurve> made(
      newCurve(curve.order, curve.order, knot.data(), points.data(), kBezier, curve.components, kCopy),
      freeCurve);
  return [&curve, made](float* results) {
    int left = 0, status = 0;
    double point[4];
    for (const float u : curve.u) {
      s1221(made.get(), 0, u, &left, point, &status);
      for (int k = 0; k < curve.components; ++k) *results++ = static_cast<float>(point[k]);
    }
  };
}

MeshSide grid(const Mesh& mesh) {
  std::vector<double> points(mesh.points.begin(), mesh.points.end()), knot = knots(mesh.order);
  const std::shared_ptr<SISLSurf> made(newSurf(mesh.order, mesh.order, mesh.order, mesh.order, knot.data(),
                                               knot.data(), points.data(), kBezier, mesh.components, kCopy),
                                       freeSurf);
  std::vector<double> u(mesh.columns), v(mesh.rows);
  for (int i = 0; i < mesh.columns; ++i) u[i] = static_cast<double>(i) / (mesh.columns - 1);
  for (int j = 0; j < mesh.rows; ++j) v[j] = static_cast<double>(j) / (mesh.rows - 1);
  const int derivatives = mesh.normals ? 1 : 0;
  const std::size_t kinds = mesh.normals ? 3 : 1;  // positions and both derivatives
  const std::size_t count = static_cast<std::size_t>(mesh.columns) * mesh.ring;
  const auto values = std::make_shared<std::vector<double>>(count * kinds * mesh.components);
  const auto normals = std::make_shared<std::vector<double>>(count * 3);
  return [&mesh, made, u, v, derivatives, kinds, values, normals](int row, int rows, float* results) mutable {
    int status = 0;
    s1506(made.get(), derivatives, mesh.columns, u.data(), rows, v.data() + row, values->data(),
          normals->data(), &status);
    if (status < 0) throw std::runtime_error("s1506 fails");
    const double* from = values->data();
    const double* normal = normals->data();
    const std::size_t total = static_cast<std::size_t>(mesh.columns) * rows;
    for (std::size_t i = 0; i < total; ++i, from += kinds * mesh.components) {
      for (int k = 0; k < mesh.components; ++k) *results++ = static_cast<float>(from[k]);
      for (int k = 0; k < (mesh.normals ? 3 : 0); ++k) *results++ = static_cast<float>(*normal++);
    }
  };
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Curve& curve : curves()) add(curve, "SISL", [&curve] { return points_one_by_one(curve); });
  for (const Mesh& mesh : meshes()) {
    if (mesh.ring != mesh.rows) add(mesh, "SISL", Unit::kMesh, [&mesh] { return grid(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
