// Grids whose end comes out as another number where an evaluator computes it from the other end
// (EV-POINT-EXACT-0, EV-POINT-EXACT-N), and maps that show it.
#pragma once

#include "maps.h"

namespace evalcts::vectors {

struct GridEnds {
  int segments;
  double first, last;
};

// The point with index N of a grid, counted from the end `from`, in the arithmetic of the type: N * du +
// from, du = (to - from)/N, each operation rounded; `fused`: the product is not.
double counted_end(int segments, double from, double to, Type type, bool fused);

// A grid of random single-precision ends whose last (or first) end is missed by counted_end() from the other
// end in single precision, fused or not, and for Type::kReal in double precision, too.
GridEnds missed_end(Dice& dice, bool last, Type type, int most_segments = 200);

// A direction of a map on which an argument that misses `end` shows: the control points at the end (0 in the
// first row, or in the last) have to be zero.
struct Probe {
  Direction direction;
  bool zero_first;
};
// Probes that begin at the end and are as wide as 1, narrow ones (1e-5 of the end), and narrow ones that stop
// at the end, which show what single precision misses only.
Probe wide_probe(Dice& dice, int order, double end);
Probe narrow_probe(int order, double end);
Probe probe_up_to(int order, double end);

}  // namespace evalcts::vectors
