// A fast, correctly rounded evaluation of lines, and of other polynomials at arguments near zero, where they
// are nearly lines. Most data with many ties is of this kind, and without this class each tie takes the exact
// route.
#pragma once

#include <optional>
#include <vector>

namespace evalcts::accuracy {

// The line R_0 + u * n (R_1 - R_0), and a rest that is so small that only its sign matters.
class ExactLine {
 public:
  // Returns the line of a curve over [0,1] with these control points. Returns nothing if the slope has too
  // many bits, if the line is zero but the polynomial is not, or if the rest is too large at every float u.
  static std::optional<ExactLine> of(const std::vector<double>& points);

  // Returns the largest |u| for which to_float() is correctly rounded; infinity for a line.
  double reach() const { return reach_; }
  // Returns the value at u, correctly rounded to float. u must be finite, with |u| <= reach().
  float to_float(float u) const;

 private:
  double first_ = 0, slope_ = 0;
  double reach_ = 0;
  // Sign of the rest for u > 0 and for u < 0; 0 if the rest is zero.
  int side_[2] = {0, 0};
};

}  // namespace evalcts::accuracy
