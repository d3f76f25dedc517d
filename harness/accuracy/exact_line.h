// Polynomials that are lines, however high their order: most of what is full of ties, which take the exact
// route each, is of this kind.
#pragma once

#include <optional>
#include <vector>

namespace evalcts::accuracy {

// R_0 + u * (R_n - R_0), correctly rounded to float for every float u that is not infinite or NaN.
class ExactLine {
 public:
  // None where the control points, which are floats, do not lie on a line exactly, or where their difference
  // is too long a number.
  static std::optional<ExactLine> of(const std::vector<double>& points);

  float to_float(float u) const;

 private:
  ExactLine(double first, double difference) : first_(first), difference_(difference) {}
  double first_, difference_;
};

}  // namespace evalcts::accuracy
