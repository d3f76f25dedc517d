// Computes the end of a grid from its other end in floating-point arithmetic, and draws random grids for
// which this is not exact.
#include "exact_ends.h"

namespace evalcts::vectors {
namespace {

// Width of the narrow probes, relative to the end.
constexpr double kNarrow = 1e-5;

bool misses(int segments, double from, double to, Type type) {
  return counted_end(segments, from, to, type, false) != to &&
         counted_end(segments, from, to, type, true) != to;
}

}  // namespace

double counted_end(int segments, double from, double to, Type type, bool fused) {
  const Rational step = rounded(Rational(rounded(Rational(to) - from, type)) / segments, type);
  const Rational way = step * segments;
  return rounded((fused ? way : Rational(rounded(way, type))) + from, type);
}

GridEnds missed_end(Dice& dice, bool last, Type type, int most_segments) {
  for (;;) {
    const int segments = dice.between(1, most_segments);
    const double a = dice.scaled(24, -4, 1);
    const double b = dice.scaled(24, -4, 1);
    const double from = last ? a : b, to = last ? b : a;
    if (a == b || !misses(segments, from, to, Type::kSingle)) continue;
    if (type == Type::kSingle || misses(segments, from, to, Type::kReal)) return {segments, a, b};
  }
}

Probe wide_probe(Dice& dice, int order, double end) {
  return {{order, end, rounded(Rational(end) + (dice.one_in(2) ? 1 : -1), Type::kSingle)}, true};
}

Probe narrow_probe(int order, double end) {
  return {{order, end, rounded(Rational(end) * (1 + Rational(kNarrow)), Type::kSingle)}, true};
}

Probe probe_up_to(int order, double end) {
  return {{order, rounded(Rational(end) * (1 - Rational(kNarrow)), Type::kSingle), end}, false};
}

}  // namespace evalcts::vectors
