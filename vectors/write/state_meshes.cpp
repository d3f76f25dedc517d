// The themes of meshes in state.json whose vertices show the arguments at which points are evaluated.
#include <evalcts/gl/tokens.h>
#include "exact_ends.h"
#include "state.h"

namespace evalcts::vectors::states {
namespace {

// Sets the grid under test in u or v, with one segment over [0, 1] in the other direction.
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

// Returns a map whose position is 0 at the end of the probe.
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
          const Type type = turn == 1 ? Type::kReal : Type::kSingle;
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

namespace {

// Returns a curve or surface of degree 3 (in v 2) whose values are near 1.
Map smooth_map(Dice& dice, bool two, const std::pair<double, double>& u, const std::pair<double, double>& v) {
  const auto value = [&] { return 1 + simple(dice) / 16; };
  const Direction along_u{4, u.first, u.second};
  if (!two) return curve(GL_MAP1_VERTEX_3, along_u, [&](int, int) { return value(); });
  return surface(GL_MAP2_VERTEX_3, along_u, {3, v.first, v.second}, [&](int, int, int) { return value(); });
}

// Returns a map with x falling from 1000 to 0 with all derivatives except the last, y rising in the same way,
// and z equal to 0 at both ends. The errors of forward differences where values are large are much more than
// is accepted where values are small.
Map falling_map(bool two, bool along_v, int order) {
  const auto value = [=](int i, int c) {
    if (c == 2) return i == 0 || i == order - 1 ? 0.0 : 1000.0 / order;
    return i == (c == 0 ? 0 : order - 1) ? 1000.0 : 0.0;
  };
  const Direction falling{order, 0, 1}, constant{1, 0, 1};
  if (!two) return curve(GL_MAP1_VERTEX_3, falling, value);
  return surface(GL_MAP2_VERTEX_3, along_v ? constant : falling, along_v ? falling : constant,
                 [&](int i, int j, int c) { return value(along_v ? j : i, c); });
}

}  // namespace

void long_meshes(Document& document) {
  Theme one(
      document, "long-mesh1",
      "EvalMesh1 with 10^3 and 10^4 points on grids far from zero compared with their steps: arguments or "
      "differences that are added up step by step leave the accepted interval",
      {"EV-MESH1-NOACCUM", "EV-MESH1-COORDS", "EV-MESH1-SUBRANGE"});
  Theme two(document, "long-mesh2",
            "EvalMesh2 with 10^3 and 10^4 points on grids far from zero compared with their steps, long in "
            "u, in v, or "
            "in both",
            {"EV-MESH2-NOACCUM", "EV-MESH2-COORDS"});
  // Ends of both the grid and the domain.
  const Ends kEnds[] = {{16, 17}, {-33, -32}, {0.1, 0.7}, {17.3, 16.1}};
  for (const int n : {1000, 9999})
    for (int i = 0; i < 4; ++i)
      for (const GLenum mode : {GL_POINT, GL_LINE}) {
        if (n > 1000 && mode == (i % 2 == 0 ? GL_LINE : GL_POINT)) continue;
        const Type type = kTypes[i / 2];
        const auto u = rounded(kEnds[i], type);
        const Map map = smooth_map(one.dice(), false, u, {});
        add(one, kPositions, [&](gl::Case& c) {
          define(c, type, map);
          c.Enable(map.target);
          grid1(c, type, n, u.first, u.second);
          c.EvalMesh1(mode, i == 3 ? n / 3 : 0, n);
        });
      }
  int turn = 0;
  struct Size {
    int un, vn;
  };
  for (const Size& size : {Size{1000, 1}, Size{1, 1000}, Size{31, 31}, Size{99, 99}})
    for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
      const Type type = kTypes[turn / 3 % 2];
      const auto u = rounded(kEnds[turn % 4], type), v = rounded(kEnds[(turn + 1) % 4], type);
      ++turn;
      const Map map = smooth_map(two.dice(), true, u, v);
      add(two, kPositions, [&](gl::Case& c) {
        define(c, type, map);
        c.Enable(map.target);
        grid2(c, type, size.un, u.first, u.second, size.vn, v.first, v.second);
        c.EvalMesh2(mode, 0, size.un, 0, size.vn);
      });
    }
}

void steep_meshes(Document& document) {
  Theme theme(
      document, "steep-mesh",
      "meshes with 10^3 and 10^4 points over maps that fall from 1000 to 0: forward differences, single or "
      "double, leave the accepted interval",
      {"EV-MESH1-NOACCUM", "EV-MESH2-NOACCUM"});
  for (const int n : {1000, 9999})
    for (const int order : {4, 6})
      for (const Along& along : kAlong) {
        if (along.two && n > 1000) continue;
        const Type type = kTypes[order / 2 % 2];
        add(theme, kPositions, [&](gl::Case& c) {
          const Map map = falling_map(along.two, along.v, order);
          define(c, type, map);
          c.Enable(map.target);
          grid_along(c, type, along.two, along.v, {n, 0, 1});
          mesh_along(c, order == 4 ? GL_POINT : along.two ? GL_FILL : GL_LINE, along.two, along.v, 0, n);
        });
      }
}

void meshes_keep_state(Document& document) {
  Theme theme(
      document, "mesh-current",
      "meshes with maps of all attributes: every current value, the grids, maps and enables stay as they "
      "were",
      {"EV-CUR-COLOR", "EV-CUR-INDEX", "EV-CUR-NORMAL", "EV-CUR-TEX", "EV-CUR-OTHERUNITS", "EV-CUR-EDGEFLAG",
       "EV-CUR-GRIDMAPS", "EV-CUR-NEXTVERTEX"});
  constexpr Shown kAll{.color = true, .normal = true, .texture_units = 2};
  const auto query = [](gl::Case& c, bool two) {
    c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    c.GetFloatv(GL_CURRENT_INDEX, gl::out<GLfloat>(1));
    c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
    c.GetBooleanv(GL_EDGE_FLAG, gl::out<GLboolean>(1));
    for (const GLenum unit : {GL_TEXTURE1, GL_TEXTURE0}) {
      c.ActiveTexture(unit);
      c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    }
    c.GetIntegerv(two ? GL_MAP2_GRID_SEGMENTS : GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(2));
    c.GetFloatv(two ? GL_MAP2_GRID_DOMAIN : GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(4));
  };
  for (const bool two : {false, true})
    for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL})
      for (GLenum texture = 0; texture < 4; ++texture) {
        if (!two && mode == GL_FILL) continue;
        add(theme, kAll, [&](gl::Case& c) {
          const std::vector<GLenum> targets = {
              target_of(two, texture % 2 == 0 ? GL_MAP1_VERTEX_3 : GL_MAP1_VERTEX_4),
              target_of(two, GL_MAP1_COLOR_4), target_of(two, GL_MAP1_INDEX), target_of(two, GL_MAP1_NORMAL),
              target_of(two, GL_MAP1_TEXTURE_COORD_1 + texture)};
          current_values(c);
          c.Indexf(17);
          c.EdgeFlag(GL_FALSE);
          c.MultiTexCoord4f(GL_TEXTURE1, -1, -2, -3, -4);
          for (const GLenum target : targets) define_and_enable(c, target);
          if (texture == 3) c.Enable(GL_AUTO_NORMAL);
          if (two) {
            c.MapGrid2f(2, 0, 1, 2, 1, 0);
            c.EvalMesh2(mode, 0, 2, 0, 1);
          } else {
            c.MapGrid1f(4, 0, 1);
            c.EvalMesh1(mode, 0, 4);
          }
          query(c, two);
          for (const GLenum target : targets) c.IsEnabled(target);
          query_all(c, target_of(two, GL_MAP1_COLOR_4), two ? 16 : 8);
          c.Begin(GL_POINTS);
          c.Vertex2f(1, 2);
          if (two)
            c.EvalPoint2(1, 1);
          else
            c.EvalPoint1(1);
          c.Vertex2f(3, 4);
          c.End();
          query(c, two);
        });
      }
}

}  // namespace evalcts::vectors::states
