// Curves and surfaces of huge and tiny numbers.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "eval.h"

namespace evalcts::vectors {
namespace {

constexpr double kFloatMost = std::numeric_limits<float>::max();
constexpr double kFloatLeast = std::numeric_limits<float>::denorm_min();
constexpr double kFloatLeastNormal = std::numeric_limits<float>::min();
constexpr double kDoubleMost = std::numeric_limits<double>::max();
constexpr double kDoubleLeast = std::numeric_limits<double>::denorm_min();

struct Magnitude {
  const char *name, *meaning;
  Type type;
  int least, most;  // exponents of two of the control values
  Names requirements;
};
const std::vector<Magnitude>& magnitude_kinds() {
  static const std::vector<Magnitude> kAll = {
      {"huge", "control values up to the largest binary32", Type::kSingle, 90, 127, {"EV-NUM-RANGE-POS"}},
      {"promised-range",
       "control values up to 2^32, which every implementation can hold",
       Type::kSingle,
       24,
       31,
       {"EV-NUM-RANGE-POS", "EV-NUM-RANGE-COLOR"}},
      {"tiny",
       "control values down to the least normal binary32",
       Type::kSingle,
       -126,
       -100,
       {"EV-NUM-DENORMAL"}},
      {"subnormal",
       "control values that are subnormal in binary32",
       Type::kSingle,
       -149,
       -127,
       {"EV-NUM-DENORMAL"}},
      {"wide", "huge and tiny control values side by side", Type::kSingle, -120, 120, {"EV-NUM-ACCURACY"}},
      {"huge-double",
       "control values beyond the range of binary32",
       Type::kReal,
       128,
       1023,
       {"EV-NUM-SPECIAL-SAFE"}},
      {"tiny-double",
       "control values below the range of binary32",
       Type::kReal,
       -1074,
       -150,
       {"EV-NUM-DENORMAL"}}};
  return kAll;
}

// Makes the last control value huge or tiny if all have similar magnitudes. A map with one control value gets
// a second one.
void widen(Map& map) {
  const auto size = [](double x) { return std::abs(x); };
  const auto [least, most] = std::ranges::minmax(map.points, {}, size);
  if (std::abs(most) >= std::ldexp(std::abs(least), 16)) return;
  if (map.points.size() == 1) {
    map.u.order = 2;
    map.points.push_back(0);
  }
  map.points.back() = std::ldexp(map.points.front(), std::abs(map.points.front()) < 1 ? 90 : -90);
}

}  // namespace

namespace curves {

void magnitudes(Document& document) {
  for (const Magnitude& kind : magnitude_kinds()) {
    Theme theme(document, kind.name, kind.meaning, kind.requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      const Direction u = along(dice.between(1, 5));
      const GLenum target = gl::kMap1Targets[static_cast<std::size_t>(i) % 9];
      Map map =
          curve(target, u, [&](int, int) { return of_magnitude(dice, kind.type, kind.least, kind.most); });
      if (kind.name == std::string_view("wide")) widen(map);
      theme.add(value_case({map, kind.type, at(static_cast<double>(dice.below(17)) / 16)}));
    }
  }
}

void overflow(Document& document) {
  Theme theme(
      document, "overflow",
      "the value rounds to infinity, or to the largest number just below (the rule does not judge it)",
      {"EV-NUM-SPECIAL-SAFE"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    const double most = type == Type::kSingle ? kFloatMost : kDoubleMost;
    const int order = dice.between(2, 4);
    const double sign = dice.sign();
    // The first two of six cases are constant, with exactly the largest number as the value. In the others
    // the value is beyond it, because the weight of the smaller control value, which has the other sign, is
    // negative outside the domain.
    Values values(static_cast<std::size_t>(order), sign * most);
    if (i % 6 >= 2) values[order == 3 ? 1 : 0] = -sign * std::ldexp(most, -dice.between(1, 40));
    constexpr double kArguments[] = {0.5, 1, 1.25, 2, 1 + 0x1p-20, 1 + 0x1p-23};
    theme.add(value_case({index_curve(0, 1, values), type, at(kArguments[i % 6])}));
  }
  // The midpoint of the largest number and the power of two above it, 2^128 - 2^103, and a number just below.
  for (const double sign : {1.0, -1.0}) {
    for (const double step : {0.0, 0x1p75}) {
      const double beyond = 0x1p128 - 0x1p103 - step;
      theme.add(value_case({index_curve(0, 1, {sign * beyond, sign * beyond}), Type::kReal, at(0.5)}));
    }
    const double step = 0x1p104;
    theme.add(value_case(
        {index_curve(0, 1, {sign * (kFloatMost - step), sign * kFloatMost}), Type::kSingle, at(1.5)}));
    theme.add(value_case(
        {index_curve(0, 1, {sign * (kFloatMost - step), sign * kFloatMost}), Type::kSingle, at(1.25)}));
  }
}

void underflow(Document& document) {
  Theme theme(document, "underflow",
              "the value is below the least normal binary32: subnormal, or rounded to zero, with its sign",
              {"EV-NUM-DENORMAL"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    const int degree = dice.between(1, 6);
    // Only the last control value is not zero, so that the value is R * u^n.
    const int exponent = -dice.between(126, degree == 1 ? 144 : 160) / degree;
    double u = std::abs(std::ldexp(dice.significand(6), exponent));
    Values values(static_cast<std::size_t>(degree) + 1, 0.0);
    values.back() = dice.significand(8);
    while (std::abs(values.back()) * std::pow(u, degree) >= kFloatLeastNormal) u /= 2;
    theme.add(value_case({index_curve(0, 1, values), type, at(u)}));
  }
  // Half the least subnormal number, which rounds to 0, and values around it.
  for (const double least : {kFloatLeast, kDoubleLeast}) {
    const Type type = least == kFloatLeast ? Type::kSingle : Type::kReal;
    for (const double u : {0.5, 0.5 + 0x1p-20, 0.5 - 0x1p-20, 0.25, 0.75})
      for (const double sign : {1.0, -1.0})
        theme.add(value_case({index_curve(0, 1, {0, sign * least}), type, at(u)}));
  }
}

void extreme_arguments(Document& document) {
  Theme theme(document, "far-away", "arguments that are huge or tiny compared with the domain",
              {"EV-MAP1-EXTRAPOLATE"});
  constexpr double kArguments[] = {0x1p60,    -0x1p31,  0x1p15,   1e6, 0x1p-100,
                                   -0x1p-126, 0x1p-149, -0x1p-60, 1e30};
  Dice& dice = theme.dice();
  for (const double u : kArguments)
    for (const Type type : kTypes)
      for (int order = 2; order <= 4; ++order)
        theme.add(
            value_case({some_curve(dice, small_target(order), along(order)), type, at(rounded(u, type))}));
}

}  // namespace curves

namespace surfaces {

void magnitudes(Document& document) {
  for (const Magnitude& kind : magnitude_kinds()) {
    Theme theme(document, kind.name, kind.meaning, kind.requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 20; ++i) {
      const Direction u = along(dice.between(1, 3)), v = along(dice.between(1, 3));
      Map map = surface(small_target(i), u, v,
                        [&](int, int, int) { return of_magnitude(dice, kind.type, kind.least, kind.most); });
      if (kind.name == std::string_view("wide")) widen(map);
      theme.add(inside_case(dice, map, kind.type));
    }
  }

  Theme overflow(document, "overflow", "the value rounds to infinity (the rule does not judge it)",
                 {"EV-NUM-SPECIAL-SAFE"});
  Theme underflow(
      document, "underflow",
      "the value is below the least normal binary32: subnormal, or rounded to zero, with its sign",
      {"EV-NUM-DENORMAL"});
  for (int i = 0; i < 16; ++i) {
    const double sign = i % 4 < 2 ? 1 : -1;
    const double most = i % 2 == 0 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    const double outside = 1 + std::ldexp(1.0, -i);
    overflow.add(value_case({index_surface(along(2), along(2), {-sign * most, 1, 1, sign * most}),
                             kTypes[i % 2], at(outside), at(outside)}));
    const double small = std::ldexp(5.0, -65 - std::max(i, 1));
    underflow.add(value_case(
        {index_surface(along(2), along(2), {0, 0, 0, sign * 1.5}), kTypes[i % 2], at(small), at(small)}));
  }
}

}  // namespace surfaces

}  // namespace evalcts::vectors
