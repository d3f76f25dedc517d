// Meshes in the sequences of state.json whose vertices show at which argument each point is evaluated.
#include <evalcts/gl/tokens.h>
#include "exact_ends.h"
#include "state.h"

namespace evalcts::vectors::states {
namespace {

// The grid under test in u or v, with a step of [0, 1] in the other direction.
void grid_along(gl::Case& c, Type type, bool two, bool along_v, const GridEnds& grid) {
  if (!two)
    grid1(c, type, grid.segments, grid.first, grid.last);
  else if (along_v)
    grid2(c, type, 1, 0, 1, grid.segments, grid.first, grid.last);
  else
    grid2(c, type, grid.segments, grid.first, grid.last, 1, 0, 1);
}

void point_along(gl::Case& c, bool two, bool along_v, int index) {
  if (!two)
    c.EvalPoint1(index);
  else
    c.EvalPoint2(along_v ? 1 : index, along_v ? index : 1);
}

void mesh_along(gl::Case& c, GLenum mode, bool two, bool along_v, int from, int to) {
  if (!two)
    c.EvalMesh1(mode, from, to);
  else if (along_v)
    c.EvalMesh2(mode, 0, 1, from, to);
  else
    c.EvalMesh2(mode, from, to, 0, 1);
}

struct Along {
  bool two, v;
};
constexpr Along kAlong[] = {{false, false}, {true, false}, {true, true}};

// A map whose x and z are 0 at `end` in the direction of the probe.
Map probing_map(const Along& along, const Probe& probe) {
  const Direction across{2, 0, 1};
  const int zero = probe.zero_first ? 0 : probe.direction.order - 1;
  const auto value = [&](int i, int c) { return i == zero ? 0.0 : (c == 1 ? -1.0 : 1.0) * (2 + i + c); };
  if (!along.two) return curve(GL_MAP1_VERTEX_3, probe.direction, value);
  return surface(GL_MAP2_VERTEX_3, along.v ? across : probe.direction, along.v ? probe.direction : across,
                 [&](int i, int j, int c) { return value(along.v ? j : i, c); });
}

}  // namespace

void exact_ends(Document& document) {
  Theme theme(
      document, "exact-ends",
      "points and meshes at ends of grids that N*du + u1, or u2 - N*du, misses in the precision of the "
      "type: the position is 0 there, and no other argument is accepted",
      {});
  for (const bool last : {false, true})
    for (const Along& along : kAlong)
      for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
        if (!along.two && mode == GL_FILL) continue;
        for (int turn = 0; turn < 3; ++turn) {
          Dice& dice = theme.dice();
          const Type type = turn == 1 ? Type::real : Type::single;
          GridEnds grid = missed_end(dice, last, type);
          if (turn == 2 && last) grid = {43, 0x1.99999ap-4, 0x1.ccccccp-1};
          const double end = last ? grid.last : grid.first;
          const Probe probe = turn == 0 ? probe_up_to(2, end) : wide_probe(dice, 2 + turn, end);
          const int index = last ? grid.segments : 0;
          add(theme, kPositions,
              [&](gl::Case& c) {
                const Map map = probing_map(along, probe);
                define(c, type, map);
                c.Enable(map.target);
                grid_along(c, type, along.two, along.v, grid);
                c.Begin(GL_POINTS);
                point_along(c, along.two, along.v, index);
                c.End();
                mesh_along(c, mode, along.two, along.v, index - 1, index);
                mesh_along(c, mode, along.two, along.v, index, index + 1);
              },
              {last ? "EV-POINT-EXACT-N" : "EV-POINT-EXACT-0", along.two ? "EV-MESH2-EXACT"
                                                               : last    ? "EV-MESH1-EXACT-N"
                                                                         : "EV-MESH1-EXACT-0"});
        }
      }
}

}  // namespace evalcts::vectors::states
