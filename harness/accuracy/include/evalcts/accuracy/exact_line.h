// Polynomials that are lines, and others where they are nearly lines, at arguments near zero: there most of
// what is full of ties is, each of which takes the exact route.
#pragma once

#include <optional>
#include <vector>

namespace evalcts::accuracy {

// R_0 + u * n (R_1 - R_0) and a rest that is too small to say more than on which side of it the value lies.
class ExactLine {
 public:
  // None where the slope is too long a number, or nothing of the polynomial is left near zero but its rest.
  // The control points are of a curve over [0,1].
  static std::optional<ExactLine> of(const std::vector<double>& points);

  // The largest |u| for which to_float() is right; infinite for a line.
  double reach() const { return reach_; }
  // The value at u, correctly rounded to float, for every float u, |u| <= reach(), that is finite.
  float to_float(float u) const;

 private:
  double first_ = 0, slope_ = 0;
  double reach_ = 0;
  // Sign of the rest for u > 0 and u < 0; 0: there is none.
  int side_[2] = {0, 0};
};

}  // namespace evalcts::accuracy
