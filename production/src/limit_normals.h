// Automatic normals on the edges of a patch that are a single point, such as the poles of a surface of
// revolution.
//
// If all control points of the edge v = v1 are equal, p_u is zero there and so is m = p_u x p_v. Near the
// edge m is (v - v1) (p_uv x p_v) + O((v - v1)^2). With the differences Q_i of the control points next to the
// edge and those of the edge, p_v is Q(u) and p_uv its derivative, up to positive factors: n is the unit
// vector along Q' x Q. It is the opposite one at v2, and Q x Q' at u1. Homogeneous points take p and w along
// as in normal.h.
#pragma once

#include <array>

#include "bernstein.h"
#include "parameter.h"
#include "target.h"

namespace glev {

class LimitNormals {
 public:
  // points: without padding, v fastest, of 3 or 4 components. They are not needed after that.
  LimitNormals(const double* points, int components, std::array<int, 2> order,
               const std::array<Domain, 2>& domain);

  // True if an edge is a single point.
  bool has_edges() const { return has_edges_; }
  // The unit vector at arguments on such an edge, in double rounded to float. (0,0,0) elsewhere, and if the
  // limit is not determined by derivatives of this order.
  std::array<float, 3> normal_at(const GridArgument& u, const GridArgument& v) const;

 private:
  // Q and Q', as curves along the edge.
  struct Edge {
    bool is_point = false;
    std::array<double, 4> point{};
    std::array<double, kMaxOrder * 4> across, slope;
    Curve across_curve, slope_curve;
  };
  void set(Edge& edge, const double* points, int components, std::array<int, 2> order, int direction,
           bool is_last);

  std::array<Domain, 2> domain_;
  bool has_edges_ = false;
  std::array<std::array<Edge, 2>, 2> edges_;  // of the directions u and v: first and last
};

}  // namespace glev
