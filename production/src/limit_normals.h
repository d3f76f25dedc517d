// Automatic normals on the edges of a patch that are a single point, such as the poles of a surface of
// revolution.
//
// If all control points of the edge v = v1 are equal, p_u is zero there and so is m = p_u x p_v. Near the
// edge, m is (v - v1) (p_uv x p_v) + O((v - v1)^2). Let Q_i be the differences of the control points next to
// the edge and those of the edge. Up to positive factors, p_v is Q(u) and p_uv its derivative, so n is the
// unit vector along Q' x Q. At v2 it has the opposite sign; at u1 it is along Q x Q'. Homogeneous points use
// p and w as in normal.h.
//
// In double, with u = 2^-53, the degree n of the edge and c = (13 n + 11) u, the errors of Q and Q' are at
// most c max|Q_i| and 2 c max|Q_i|. The units of c are 13 n + 4 of the evaluation (bernstein.h), 4 of the
// binomials and 3 of the differences. As in normal.h, the components of the product have an error of
// (2 c + 6 u) M for a majorant M, with 2 u for each of the differences of products. For n <= 63 this is below
// 2^-42 M, so before rounding to float the error of the unit vector is at most 2^-30 if
// |Q' x Q| >= 2^-12 |M|.
#pragma once

#include <array>

#include "bernstein.h"
#include "parameter.h"
#include "target.h"

namespace glev {

class LimitNormals {
 public:
  // `points`: control points without padding, v fastest, of 3 or 4 components. They are used only during the
  // call.
  LimitNormals(const double* points, int components, std::array<int, 2> order,
               const std::array<Domain, 2>& domain);

  // Returns true if an edge is a single point.
  bool has_edges() const { return has_edges_; }
  // Returns the limit of the unit normal at arguments on such an edge, computed in double and rounded to
  // float. Returns (0,0,0) at other arguments, and if derivatives of second order do not determine the limit.
  std::array<float, 3> normal_at(const GridArgument& u, const GridArgument& v) const;

 private:
  // An edge, with Q and Q' as curves along it.
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
  std::array<std::array<Edge, 2>, 2> edges_;  // first and last edge in the directions u and v
};

}  // namespace glev
