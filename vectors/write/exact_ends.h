// Grids with an end that an evaluator misses if it computes the end from the other one (EV-POINT-EXACT-0,
// EV-POINT-EXACT-N), and maps whose values show this.
#pragma once

#include "maps.h"

namespace evalcts::vectors {

struct GridEnds {
  int segments;
  double first, last;
};

// Returns N * du + from with du = (to - from)/N and N = `segments`, with each operation rounded to the type;
// if `fused`, the product is not rounded.
double counted_end(int segments, double from, double to, Type type, bool fused);

// Returns a grid of random single-precision ends whose last (or first) end differs from counted_end() from
// the other end, fused or not, in single precision and, for Type::kReal, in double precision as well.
GridEnds missed_end(Dice& dice, bool last, Type type, int most_segments = 200);

// A direction of a map whose values show an argument that misses the end. The control points at the end have
// to be 0: the first ones if `zero_first`, otherwise the last ones.
struct Probe {
  Direction direction;
  bool zero_first;
};
// Return probes whose domain begins at the end and has the width 1; begins at the end and has the width 1e-5
// of the end's magnitude; or has the latter width and stops at the end, which shows errors of single
// precision only.
Probe wide_probe(Dice& dice, int order, double end);
Probe narrow_probe(int order, double end);
Probe probe_up_to(int order, double end);

}  // namespace evalcts::vectors
