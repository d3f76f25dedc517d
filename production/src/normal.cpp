#include "production/src/normal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "production/src/fault.h"

namespace glev {
namespace {

// If products of the components could leave the range of double: multiplies by the power of two that brings
// the largest magnitude to [1/2, 1) (subnormal ones: near it), which changes no digit. Zero and what is not
// finite stays.
template <std::size_t kCount>
void Scale(std::array<double, kCount>& v) {
  double largest = 0;
  for (const double x : v) largest = std::max(largest, std::fabs(x));
  const bool harmless = largest > 0x1p-100 && largest < 0x1p100;
  if (harmless || largest == 0 || !std::isfinite(largest)) return;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double factor = std::ldexp(1.0, std::min(-exponent, 1023));
  for (double& x : v) x *= factor;
}

using Vector = std::array<double, 3>;

// w^2 times the derivative of (x, y, z) / w.
Vector OfQuotient(const std::array<double, 4>& p, const std::array<double, 4>& derivative) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = p[3] * derivative[k] - derivative[3] * p[k];
  return result;
}

}  // namespace

Vector UnitNormal(std::array<double, 4> p, std::array<double, 4> p_u, std::array<double, 4> p_v) {
  Scale(p);
  Scale(p_u);
  Scale(p_v);
  Vector a = OfQuotient(p, p_u), b = OfQuotient(p, p_v);
  if (GLEV_FAULTY(WForgottenInV)) b = {p_v[0], p_v[1], p_v[2]};
  if (GLEV_FAULTY(NormalTurnedByNegativeW) && p[3] < 0) a = {-a[0], -a[1], -a[2]};
  Scale(a);
  Scale(b);
  Vector m = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  Scale(m);
  const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  if (GLEV_FAULTY(ShortNormalsStay) && length < 0x1p-28) return m;
  for (double& x : m) x /= length;
  return m;
}

}  // namespace glev
