// The subject of a sweep: a map of any target over [0,1] or [0,1] x [0,1], and one of its arguments.
#pragma once

#include <reference/bernstein_form.h>
#include <reference/filter.h>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/exact_line.h>
#include <evalcts/accuracy/samples.h>

namespace evalcts::accuracy {

struct SweptMap {
  std::string target = "texture_coord_1";
  bool two_dimensional = false;
  Map map{1, 1, 1, true, {0, 1, 0, 1}, {}};
  // For surfaces: true if v is swept, otherwise u; and the value of the argument that is not swept.
  bool along_v = false;
  float other = 0;

  SweptMap() = default;
  // A curve of one component over [0,1].
  SweptMap(std::vector<double> points);  // NOLINT(google-explicit-constructor): most maps are such curves
  SweptMap(std::initializer_list<double> points) : SweptMap(std::vector<double>(points)) {}
  bool is_plain_curve() const { return !two_dimensional && target == "texture_coord_1"; }
};

// One component of a swept map, prepared for many values of the swept argument. Const member functions may be
// called from several threads at once.
class SweptPolynomial {
 public:
  SweptPolynomial(const SweptMap& map, int component);

  // Computes the correctly rounded values. `u` must be in increasing order, and `rights` must have the same
  // size. Returns the number of values that took the exact route.
  std::size_t to_float(const std::vector<double>& u, std::vector<float>& rights) const;
  void enclose(const std::vector<double>& u, std::vector<reference::Enclosure>& enclosures) const;
  reference::Evaluation exactly(float u) const;
  // Returns SUM |B_i| |R_i| in double, with a small relative error if the terms are in the range of double.
  double magnitude(double u) const;

 private:
  bool along_v_;
  float other_;
  bool reduced_;  // to a curve whose control points are doubles
  reference::BernsteinForm exact_;
  std::optional<reference::CorrectlyRounded> right_;
  std::optional<reference::Filter> filter_;
  std::optional<ExactLine> line_;
  std::vector<double> magnitudes_;  // magnitudes of the control points of the curve along the swept argument
};

}  // namespace evalcts::accuracy
