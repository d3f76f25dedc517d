// Benchmarks OpenCASCADE: its geometry classes, and its adaptors, which cache the polynomial of the last
// span. It supports three components and degrees up to 25.
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <cmath>
#include <memory>

#include "side.h"

namespace evalcts::bench {
namespace {

gp_Pnt point(const float* p) { return {p[0], p[1], p[2]}; }

float* store(const gp_XYZ& p, float* results) {
  for (int k = 1; k <= 3; ++k) *results++ = static_cast<float>(p.Coord(k));
  return results;
}

opencascade::handle<Geom_BezierCurve> geometry(const Curve& curve) {
  TColgp_Array1OfPnt points(1, curve.order);
  for (int i = 0; i < curve.order; ++i) points.SetValue(i + 1, point(&curve.points[3 * i]));
  return new Geom_BezierCurve(points);
}

opencascade::handle<Geom_BezierSurface> geometry(const Mesh& mesh) {
  TColgp_Array2OfPnt points(1, mesh.order, 1, mesh.order);
  for (int j = 0; j < mesh.order; ++j) {
    for (int i = 0; i < mesh.order; ++i)
      points.SetValue(i + 1, j + 1, point(&mesh.points[3 * (j * mesh.order + i)]));
  }
  return new Geom_BezierSurface(points);
}

// `evaluator`: a pointer to a curve or surface, or to an adaptor.
template <class Evaluator>
CurveSide points_of(const Curve& curve, const Evaluator& evaluator) {
  return [&curve, evaluator](float* results) {
    gp_Pnt p;
    for (const float u : curve.u) {
      evaluator->D0(u, p);
      results = store(p.XYZ(), results);
    }
  };
}

template <class Evaluator>
MeshSide points_of(const Mesh& mesh, const Evaluator& evaluator) {
  return [&mesh, evaluator](int row, int rows, float* results) {
    gp_Pnt p;
    gp_Vec along_u, along_v;
    for (int j = row; j < row + rows; ++j) {
      for (int i = 0; i < mesh.columns; ++i) {
        if (mesh.normals) {
          evaluator->D1(mesh.u(i), mesh.v(j), p, along_u, along_v);
          results = store(p.XYZ(), results);
          const gp_Vec normal = along_u.Crossed(along_v);
          results = store((normal / normal.Magnitude()).XYZ(), results);
        } else {
          evaluator->D0(mesh.u(i), mesh.v(j), p);
          results = store(p.XYZ(), results);
        }
      }
    }
  };
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Curve& curve : curves()) {
    if (curve.components != 3 || curve.order > Geom_BezierCurve::MaxDegree() + 1) continue;
    add(curve, "OpenCASCADE", [&curve] { return points_of(curve, geometry(curve)); });
    add(curve, "OpenCASCADE_adaptor",
        [&curve] { return points_of(curve, std::make_shared<GeomAdaptor_Curve>(geometry(curve))); });
  }
  for (const Mesh& mesh : meshes()) {
    if (mesh.components != 3 || mesh.ring == mesh.rows) continue;
    add(mesh, "OpenCASCADE", Unit::kStrip, [&mesh] { return points_of(mesh, geometry(mesh)); });
    add(mesh, "OpenCASCADE_adaptor", Unit::kStrip,
        [&mesh] { return points_of(mesh, std::make_shared<GeomAdaptor_Surface>(geometry(mesh))); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
