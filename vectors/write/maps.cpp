// Makes maps with exact, rounded and random control points.
#include "maps.h"

#include <reference/rounding.h>

#include <algorithm>
#include <cmath>

namespace evalcts::vectors {

int bits_of(Type type) { return type == Type::kSingle ? 24 : 53; }

double rounded(const Rational& x, Type type) {
  return type == Type::kSingle ? reference::round_to_float(x) : reference::round_to_double(x);
}

Ends rounded(const Ends& ends, Type type) { return {rounded(ends.first, type), rounded(ends.second, type)}; }

double between(double a, double b, const Rational& part, Type type) {
  return rounded(Rational(a) + part * (Rational(b) - Rational(a)), type);
}

double next_after(double x, double towards, Type type) {
  if (type == Type::kReal) return std::nextafter(x, towards);
  return std::nextafter(static_cast<float>(x), static_cast<float>(towards));
}

Map curve(GLenum target, const Direction& u, const std::function<double(int, int)>& value) {
  Map map{target, u, {}, {}};
  for (int i = 0; i < u.order; ++i)
    for (int c = 0; c < map.components(); ++c) map.points.push_back(value(i, c));
  return map;
}

Map surface(GLenum target, const Direction& u, const Direction& v, const ValueOf& value) {
  Map map{target, u, v, {}};
  for (int i = 0; i < u.order; ++i)
    for (int j = 0; j < v.order; ++j)
      for (int c = 0; c < map.components(); ++c) map.points.push_back(value(i, j, c));
  return map;
}

Map index_curve(double u1, double u2, const Values& values) {
  return {GL_MAP1_INDEX, {static_cast<int>(values.size()), u1, u2}, {}, values};
}

Map index_surface(const Direction& u, const Direction& v, const Values& values) {
  return {GL_MAP2_INDEX, u, v, values};
}

double simple(Dice& dice) { return static_cast<double>(dice.between(-128, 128)) / 16; }

double full(Dice& dice, Type type) { return dice.scaled(bits_of(type), -3, 3); }

double of_magnitude(Dice& dice, Type type, int least, int most) {
  const int exponent = dice.between(least, most);
  const int lowest = type == Type::kSingle ? -149 : -1074;
  const int bits = std::max(2, std::min(bits_of(type), exponent - lowest + 1));
  const double value = std::ldexp(dice.significand(bits), exponent);
  return exponent == lowest ? std::copysign(std::ldexp(1.0, lowest), value) : value;
}

std::vector<Rational> with_roots(const std::vector<Rational>& roots) {
  // The factor t - r is -r * (1-t) + (1-r) * t, so that the product stays in the basis t^i * (1-t)^(n-i).
  std::vector<Rational> scaled{1};
  for (const Rational& root : roots) {
    std::vector<Rational> product(scaled.size() + 1);
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      product[i] -= scaled[i] * root;
      product[i + 1] += scaled[i] * (1 - root);
    }
    scaled = std::move(product);
  }
  Rational binomial = 1;
  const auto n = static_cast<int>(roots.size());
  for (int i = 0; i <= n; ++i) {
    scaled[static_cast<std::size_t>(i)] /= binomial;
    binomial = binomial * (n - i) / (i + 1);
  }
  return scaled;
}

}  // namespace evalcts::vectors
