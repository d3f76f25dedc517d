// Vertex maps for the tests of normals, and a slow second method for them.
#pragma once

#include <reference/normal.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "random_data.h"
#include "second_route.h"

namespace evalcts::reference {

inline Argument at(double u) { return Argument::coordinate(u); }

// Control points of three or four components, R_ij at points[(i * vorder + j) * size].
struct Patch {
  int size, uorder, vorder;
  std::vector<double> points;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;

  std::vector<Surface> surface() const {
    std::vector<Surface> components;
    for (int c = 0; c < size; ++c) {
      components.push_back({&points[c], {vorder * size, uorder, u1, u2}, {size, vorder, v1, v2}});
    }
    return components;
  }
  double& at(int i, int j, int c) { return points[(i * vorder + j) * size + c]; }
  double at(int i, int j, int c) const { return points[(i * vorder + j) * size + c]; }
};

// Returns the patch with R_ij = point(i, j).
template <std::size_t kSize>
Patch make_patch(int uorder, int vorder, const std::function<std::array<double, kSize>(int, int)>& point) {
  Patch patch{static_cast<int>(kSize), uorder, vorder, {}};
  for (int i = 0; i < uorder; ++i) {
    for (int j = 0; j < vorder; ++j) {
      for (const double x : point(i, j)) patch.points.push_back(x);
    }
  }
  return patch;
}

inline Patch random_patch(std::mt19937_64& generator, Data kind, int size, int uorder, int vorder) {
  return {size, uorder, vorder,
          control_values(generator, kind, static_cast<std::size_t>(size) * uorder * vorder)};
}

// Value and derivatives by de Casteljau's construction in reduced fractions.
struct SecondJet {
  Fraction value, u, v;
};

inline Fraction second_parameter(const Argument& u, double u1, double u2) {
  Fraction value = fraction(u.first());
  if (u.is_grid()) value += Fraction(u.index()) * (fraction(u.last()) - fraction(u.first())) / u.segments();
  return (value - fraction(u1)) / (fraction(u2) - fraction(u1));
}

inline SecondJet second_jet(const Patch& patch, int c, const Argument& u, const Argument& v) {
  const Fraction t = second_parameter(u, patch.u1, patch.u2), s = second_parameter(v, patch.v1, patch.v2);
  std::vector<Fraction> along_v, slopes;
  for (int i = 0; i < patch.uorder; ++i) {
    std::vector<Fraction> row;
    for (int j = 0; j < patch.vorder; ++j) row.push_back(fraction(patch.at(i, j, c)));
    along_v.push_back(de_casteljau(row, s));
    slopes.push_back(de_casteljau_derivative(row, s));
  }
  return {de_casteljau(along_v, t), de_casteljau_derivative(along_v, t), de_casteljau(slopes, t)};
}

using SecondVector = std::array<Fraction, 3>;

// Returns q_u or q_v, the derivative of p/w by the quotient rule.
inline SecondVector second_tangent(const Patch& patch, const Argument& u, const Argument& v,
                                   Fraction SecondJet::*derivative) {
  SecondVector result;
  for (int c = 0; c < 3; ++c) {
    const SecondJet p = second_jet(patch, c, u, v);
    if (patch.size == 3) {
      result[c] = p.*derivative;
    } else {
      const SecondJet w = second_jet(patch, 3, u, v);
      result[c] = (p.*derivative - p.value / w.value * (w.*derivative)) / w.value;
    }
  }
  return result;
}

inline SecondVector second_normal(const Patch& patch, const Argument& u, const Argument& v) {
  const SecondVector a = second_tangent(patch, u, v, &SecondJet::u);
  const SecondVector b = second_tangent(patch, u, v, &SecondJet::v);
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline SecondVector fractions(const Vector& m) { return {fraction(m[0]), fraction(m[1]), fraction(m[2])}; }

}  // namespace evalcts::reference
