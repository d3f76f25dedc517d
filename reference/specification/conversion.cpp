// Conversions between the types of commands, state and queries.
#include "conversion.h"

#include <reference/rational.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evalcts::reference {
namespace {

GLint saturate(const Integer& value) {
  using Limits = std::numeric_limits<GLint>;
  if (value < Limits::min()) return Limits::min();
  if (value > Limits::max()) return Limits::max();
  return static_cast<GLint>(value);
}

// Appends the integers that are nearest to a value, unless they are there already.
void append_nearest(const Rational& value, std::vector<GLint>& integers) {
  const Rational half = Rational(1) / 2;
  const Integer nearest = round_to_integer(value);
  std::vector<Integer> all = {nearest};
  if (value - Rational(nearest) == half) all.push_back(nearest + 1);
  if (Rational(nearest) - value == half) all.push_back(nearest - 1);
  for (const Integer& integer : all)
    if (std::ranges::count(integers, saturate(integer)) == 0) integers.push_back(saturate(integer));
}

}  // namespace

GLfloat to_single(GLdouble value) {
  if (std::isnan(value)) return std::numeric_limits<GLfloat>::quiet_NaN();
  if (std::isinf(value) || value == 0) return static_cast<GLfloat>(value);  // keeps the sign of zero
  return round_to_float(value);
}

GLboolean to_boolean(GLdouble value) { return value == 0 ? GL_FALSE : GL_TRUE; }

GLfloat to_float(GLdouble value) {
  const GLfloat single = to_single(value);
  if (std::isinf(single) && !std::isinf(value)) {
    return std::copysign(std::numeric_limits<GLfloat>::max(), single);
  }
  return single;
}

GLint to_integer(GLdouble value) {
  if (std::isnan(value)) return 0;
  if (std::isinf(value))
    return value < 0 ? std::numeric_limits<GLint>::min() : std::numeric_limits<GLint>::max();
  return saturate(round_to_integer(value));
}

GLint normalized_to_integer(GLdouble value) {
  if (!std::isfinite(value)) return to_integer(value);
  const Rational scale = Rational::power_of_two(32) - 1;
  return saturate(round_to_integer((scale * value - 1) / 2));
}

std::vector<GLint> permitted_integers(GLdouble value) {
  if (!std::isfinite(value)) return {to_integer(value)};
  std::vector<GLint> integers;
  append_nearest(value, integers);
  return integers;
}

std::vector<GLint> permitted_normalized_integers(GLdouble value) {
  std::vector<GLint> integers = {normalized_to_integer(value)};
  if (!std::isfinite(value) || value == 0) return integers;
  append_nearest(((Rational::power_of_two(32) - 1) * value - 1) / 2, integers);
  append_nearest((Rational::power_of_two(31) - 1) * value, integers);
  return integers;
}

}  // namespace evalcts::reference
