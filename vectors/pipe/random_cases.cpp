// Draws random maps and arguments, for a given seed the same on every machine.
#include "random_cases.h"

#include <fmt/format.h>

#include <cmath>

#include <evalcts/gl/tokens.h>

namespace evalcts::vectors {
namespace {

// Rounds to the type in hardware, which gives the same result on every machine.
double to_type(double x, Type type) { return type == Type::kSingle ? static_cast<float>(x) : x; }

// Returns a multiple of 1/16 of magnitude up to 8.
double simple(Dice& dice) { return static_cast<double>(dice.between(-128, 128)) / 16; }

// Returns a number with all significant bits of the type and a magnitude from 2^-3 to 2^4.
double full(Dice& dice, Type type) { return dice.scaled(bits_of(type), -3, 3); }

}  // namespace

RandomCases::RandomCases(const std::string& kind, std::uint64_t seed)
    : prefix_(fmt::format("{}.random-{}.", kind, seed)),
      is_normal_(kind == "auto_normal"),
      is_grid_(kind == "grid"),
      is_curve_(kind == "map1_eval"),
      dice_(prefix_),
      problem_{{}, Type::kSingle, Argument::coordinate(0)} {}

Direction RandomCases::direction(int low_orders, int high_orders) {
  Direction u;
  // Order 1 in a direction makes the normal undefined.
  const int least = is_normal_ && !dice_.one_in(16) ? 2 : 1;
  u.order = dice_.between(least, dice_.one_in(16) ? high_orders : low_orders);
  if (dice_.one_in(2)) return u;
  const int bits = bits_of(problem_.type);
  const double first = dice_.scaled(bits, -3, 6);
  const double last = to_type(first + dice_.scaled(bits, -6, 6), problem_.type);
  // The accuracy rule does not apply if the ends are equal in single precision.
  if (static_cast<float>(first) == static_cast<float>(last)) return u;
  u.first = first;
  u.last = last;
  return u;
}

// Returns a number inside the domain; in one of ten cases an end, and in another one possibly a number
// outside.
double RandomCases::coordinate(const Direction& u) {
  const std::int64_t place = dice_.below(10);
  if (place == 0) return dice_.one_in(2) ? u.first : u.last;
  double part = std::abs(dice_.real(bits_of(problem_.type)));
  if (place == 1) part = 3 * part - 1;
  return to_type(std::fma(part, u.last - u.first, u.first), problem_.type);
}

Argument RandomCases::argument(const Direction& u) {
  if (!is_grid_) return Argument::coordinate(coordinate(u));
  constexpr int kMost[] = {10, 10, 1000, 1 << 20};
  const int segments = dice_.between(1, dice_.pick(kMost));
  const bool is_domain = dice_.one_in(2);
  const double first = is_domain ? u.first : coordinate(u);
  const double last = is_domain ? u.last : coordinate(u);
  const std::int64_t place = dice_.below(10);
  const std::int64_t index = place == 0   ? 0
                             : place == 1 ? segments
                             : place == 2 ? segments + dice_.below(3)
                                          : dice_.below(std::int64_t{segments} + 1);
  return Argument::grid(index, segments, first, last);
}

double RandomCases::control_value(int style, int place) {
  switch (style) {
    case 0:
      return simple(dice_);
    case 1:
      return full(dice_, problem_.type);
    case 2:
      return dice_.scaled(bits_of(problem_.type), -20, 20);
    default:
      return to_type((place % 2 == 0 ? 1 : -1) * (1 + dice_.real(20) / 64), problem_.type);
  }
}

// Makes a vertex map whose points lie near (i, j), so that it has a normal.
void RandomCases::fill_surface() {
  Map& map = problem_.map;
  const int k = map.components();
  for (int i = 0; i < map.u.order; ++i)
    for (int j = 0; j < map.v.order; ++j)
      for (int c = 0; c < k; ++c) {
        const double noise = dice_.real(12) / 4;
        map.points.push_back(c == 0 ? i + noise : c == 1 ? j + noise : c == 2 ? 4 * noise : 1 + noise);
      }
}

void RandomCases::draw() {
  id_ = prefix_ + std::to_string(++number_);
  problem_.type = dice_.below(2) == 0 ? Type::kSingle : Type::kReal;
  const bool two = !is_curve_ && (!is_grid_ || dice_.one_in(2));
  Map& map = problem_.map;
  map.points.clear();
  map.target = is_normal_ ? (dice_.one_in(2) ? GL_MAP2_VERTEX_3 : GL_MAP2_VERTEX_4)
               : two      ? dice_.pick(gl::kMap2Targets)
                          : dice_.pick(gl::kMap1Targets);
  map.u = two ? direction(4, 12) : direction(6, 30);
  map.v = two ? direction(4, 12) : Direction{};
  if (is_normal_) {
    fill_surface();
  } else {
    const auto style = static_cast<int>(dice_.below(4));
    const int points = map.u.order * map.v.order, k = map.components();
    for (int i = 0; i < points; ++i)
      for (int c = 0; c < k; ++c) map.points.push_back(control_value(style, i));
  }
  problem_.u = argument(map.u);
  problem_.v.reset();
  if (two) problem_.v = argument(map.v);
}

}  // namespace evalcts::vectors
