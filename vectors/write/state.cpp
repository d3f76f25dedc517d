// Writes state.json: longer sequences about enables, precedence, emitted vertices, and state that must not
// change.
#include <cmath>

#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/targets.h>
#include <evalcts/gl/tokens.h>
#include "kinds.h"
#include "state.h"

namespace evalcts::vectors::states {

GLenum target_of(bool two, GLenum map1_target) {
  return two ? map1_target - GL_MAP1_COLOR_4 + GL_MAP2_COLOR_4 : map1_target;
}

Map some_map(GLenum target, int order) {
  const int k = gl::components_of(target);
  Map map{target, {order, 0, 1}, {}, {}};
  if (reference::is_map2_target(target)) map.v.order = 2;
  const int first =
      static_cast<int>(target - (reference::is_map2_target(target) ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4));
  for (int i = 0; i < map.u.order * map.v.order * k; ++i)
    map.points.push_back((first + 1) / 4.0 + (i * i % 7) / 8.0 + i / 16.0);
  return map;
}

void define_and_enable(gl::Case& c, GLenum target, Type type) {
  define(c, type, some_map(target));
  c.Enable(target);
}

void current_values(gl::Case& c) {
  c.Color4f(0.125f, 0.25f, 0.375f, 0.5f);
  c.Normal3f(0.5f, -1, 2);
  c.TexCoord4f(5, 6, 7, 8);
}
void evaluate(gl::Case& c, bool two, double u, double v) {
  if (two)
    c.EvalCoord2f(u, v);
  else
    c.EvalCoord1f(u);
}
void draw(gl::Case& c, bool two, double u, double v) {
  c.Begin(GL_POINTS);
  evaluate(c, two, u, v);
  c.End();
}

void add(Theme& theme, const Shown& shown, const std::function<void(gl::Case&)>& what,
         const Names& requirements) {
  gl::Case c;
  what(c);
  theme.add(sequence(c, shown), requirements);
}

namespace {

void query_current_values(gl::Case& c) {
  c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
  c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
  c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
}

// --- State

void initial(Document& document) {
  Theme theme(document, "initial", "a new context",
              {"EV-INIT-MAPS-OFF", "EV-INIT-AUTON-OFF", "EV-INIT-GRID1", "EV-INIT-GRID2"});
  add(theme, kPositions, [](gl::Case& c) {
    for (const GLenum cap : gl::all_caps()) c.IsEnabled(cap);
  });
  add(theme, kPositions, [](gl::Case& c) {
    query_grids(c);
    query_current_values(c);
  });
  Theme evaluable(document, "initial-maps", "maps that are enabled but were never defined: constants",
                  {"EV-INIT-EVALUABLE", "EV-PREC-NOVALIDITY"});
  for (const bool two : {false, true})
    for (const GLenum kind : gl::kMap1Targets)
      add(evaluable, kEverything, [&](gl::Case& c) {
        current_values(c);
        if (kind != GL_MAP1_VERTEX_3 && kind != GL_MAP1_VERTEX_4)
          define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
        c.Enable(target_of(two, kind));
        draw(c, two, -3, 7);
        draw(c, two, 0.5, 0);
      });
}

void limits(Document& document) {
  Theme theme(document, "max-eval-order", "MAX_EVAL_ORDER is 8 or more, and maps of order 8 are accepted",
              {"EV-INIT-MAXORDER", "EV-MAP1-ORDER-ALL", "EV-MAP2-ORDER-ALL"});
  for (const Type type : kTypes)
    for (const GLenum kind : gl::kMap1Targets)
      add(theme, kPositions, [&](gl::Case& c) {
        c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
        c.GetFloatv(GL_MAX_EVAL_ORDER, gl::out<GLfloat>(1));
        c.GetDoublev(GL_MAX_EVAL_ORDER, gl::out<GLdouble>(1));
        c.GetBooleanv(GL_MAX_EVAL_ORDER, gl::out<GLboolean>(1));
        const int k = gl::components_of(kind);
        define(c, type, {kind, {8, 0, 1}, {}, numbered(8 * k)});
        query_all(c, kind, 8 * k);
        define(c, type, {target_of(true, kind), {8, 0, 1}, {8, 0, 1}, numbered(64 * k)});
        query_all(c, target_of(true, kind), 64 * k);
      });
}

void high_orders(Document& document) {
  document.explain("order-above-8", "where MAX_EVAL_ORDER is at least the order of each map");
  Theme theme(document, "high-order", "points and meshes of maps of orders from 9 to 64",
              {"EV-MAP1-ORDER-ALL", "EV-MAP2-ORDER-ALL", "EV-MAP1-BEZIER", "EV-MAP2-BEZIER"});
  constexpr std::pair<int, int> kOrders[] = {{9, 9},  {16, 3}, {3, 16}, {30, 2}, {2, 30},
                                             {33, 4}, {64, 1}, {1, 64}, {64, 8}};
  Dice& dice = theme.dice();
  for (const bool two : {false, true})
    for (const GLenum kind : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4})
      for (const auto& [uorder, vorder] : kOrders) {
        if (!two && uorder < 9) continue;
        const auto value = [&](int c) { return c == 3 ? 1 + std::abs(simple(dice)) / 16 : simple(dice); };
        const Direction u{uorder, 0, 1}, v{vorder, 0, 1};
        const Map map = two ? surface(target_of(true, kind), u, v, [&](int, int, int c) { return value(c); })
                            : curve(kind, u, [&](int, int c) { return value(c); });
        gl::Case c;
        define(c, kTypes[theme.count() % 2], map);
        c.Enable(map.target);
        draw(c, two, 0.375, 0.75);
        if (two)
          c.EvalMesh2(GL_POINT, 0, 1, 0, 0);
        else
          c.EvalMesh1(GL_POINT, 0, 1);
        theme.add(sequence(c), {}, {"order-above-8"});
      }
}

void enables(Document& document) {
  Theme theme(document, "enables", "each of the 19 enables by itself, in all forms of queries",
              {"EV-EN-CAPS", "EV-EN-INDEP", "EV-EN-GETS"});
  const std::vector<GLenum>& all = gl::all_caps();
  for (std::size_t i = 0; i < all.size(); ++i)
    add(theme, kPositions, [&](gl::Case& c) {
      c.Enable(all[i]);
      c.GetBooleanv(all[i], gl::out<GLboolean>(1));
      c.GetIntegerv(all[i], gl::out<GLint>(1));
      c.GetFloatv(all[i], gl::out<GLfloat>(1));
      c.GetDoublev(all[i], gl::out<GLdouble>(1));
      for (const GLenum cap : all) c.IsEnabled(cap);
      c.Disable(all[i]);
      c.IsEnabled(all[i]);
    });
  add(theme, kPositions,
      [&](gl::Case& c) {
        for (const GLenum cap : all) c.Enable(cap);
        for (const GLenum cap : all) c.IsEnabled(cap);
        c.ActiveTexture(GL_TEXTURE1);
        c.Disable(GL_MAP1_TEXTURE_COORD_2);
        c.ActiveTexture(GL_TEXTURE0);
        c.IsEnabled(GL_MAP1_TEXTURE_COORD_2);
        c.IsEnabled(GL_MAP1_TEXTURE_COORD_3);
      },
      {"EV-EN-MULTI", "EV-EN-NOTUNIT"});
}

void grids(Document& document) {
  Theme theme(
      document, "grid-state", "grids through all forms of queries, integers rounded",
      {"EV-GRID-SET1", "EV-GRID-SET2", "EV-GRID-INDEP", "EV-GRID-FD", "EV-GET-GRIDDOMAIN", "EV-GET-GRIDSEG"});
  const std::tuple<int, double, double> kGrids[] = {{1, 0, 1},     {7, -2, 5},         {100, 0.25, 0.75},
                                                    {3, 5, 5},     {2147483647, 1, 0}, {2, 1.4, -1.6},
                                                    {5, 0.5, 2.5}, {4, 1e20, -1e20}};
  for (const Type type : kTypes)
    for (const auto& [n, first, last] : kGrids)
      add(theme, kPositions, [&, n = n, first = first, last = last](gl::Case& c) {
        const double u1 = rounded(first, type), u2 = rounded(last, type);
        grid1(c, type, n, u1, u2);
        grid2(c, type, 3, 2, u1, n, u2, 6);
        for (const GLenum name :
             {GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS}) {
          c.GetFloatv(name, gl::out<GLfloat>(4));
          c.GetDoublev(name, gl::out<GLdouble>(4));
          c.GetIntegerv(name, gl::out<GLint>(4));
          c.GetBooleanv(name, gl::out<GLboolean>(4));
        }
      });
}

// --- Evaluation

void attributes(Document& document) {
  Theme theme(document, "attribute",
              "one map in addition to the vertex map: what it sets, and that current values stay",
              {"EV-COORD-ASIF", "EV-COORD-VERTEXLAST", "EV-COORD-CURRENT", "EV-CUR-NEXTVERTEX"});
  const Names kRequirements[] = {{"EV-ATTR-COLOR", "EV-CUR-COLOR"},
                                 {"EV-ATTR-INDEX-RGBA", "EV-CUR-INDEX"},
                                 {"EV-ATTR-NORMAL", "EV-CUR-NORMAL"},
                                 {"EV-ATTR-TEX1", "EV-CUR-TEX"},
                                 {"EV-ATTR-TEX2", "EV-CUR-TEX"},
                                 {"EV-ATTR-TEX3", "EV-CUR-TEX"},
                                 {"EV-ATTR-TEX4", "EV-CUR-TEX"},
                                 {"EV-ATTR-VERTEX3"},
                                 {"EV-ATTR-VERTEX4"}};
  for (const Type type : kTypes)
    for (const bool two : {false, true})
      for (std::size_t i = 0; i < 9; ++i) {
        const GLenum target = target_of(two, gl::kMap1Targets[i]);
        add(
            theme, kEverything,
            [&](gl::Case& c) {
              current_values(c);
              if (i < 7) define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3), type);
              define_and_enable(c, target, type);
              c.Begin(GL_POINTS);
              evaluate(c, two);
              c.Vertex3f(1, 2, 3);
              evaluate(c, two, 0.5, 0.125);
              c.End();
              query_current_values(c);
            },
            kRequirements[i]);
      }
}

void forms(Document& document) {
  Theme theme(document, "forms",
              "the same vertex by every command: EvalCoord in all forms, EvalPoint, EvalMesh",
              {"EV-API-V", "EV-API-FD", "EV-COORD-FD", "EV-COORD-ARGORDER", "EV-POINT-LIKEMESH"});
  for (const Type type : kTypes)
    for (const bool two : {false, true})
      for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4})
        add(theme, kPositions, [&](gl::Case& c) {
          define_and_enable(c, target_of(two, target), type);
          grid1(c, type, 4, 0, 1);
          grid2(c, type, 4, 0, 1, 2, 0, 1);
          c.Begin(GL_POINTS);
          if (two) {
            c.EvalCoord2f(0.25f, 0.5f);
            c.EvalCoord2d(0.25, 0.5);
            c.EvalCoord2fv(std::vector<GLfloat>{0.25f, 0.5f});
            c.EvalCoord2dv(std::vector<GLdouble>{0.25, 0.5});
            c.EvalPoint2(1, 1);
          } else {
            c.EvalCoord1f(0.25f);
            c.EvalCoord1d(0.25);
            c.EvalCoord1fv(std::vector<GLfloat>{0.25f});
            c.EvalCoord1dv(std::vector<GLdouble>{0.25});
            c.EvalPoint1(1);
          }
          c.End();
          if (two)
            c.EvalMesh2(GL_POINT, 1, 1, 1, 1);
          else
            c.EvalMesh1(GL_POINT, 1, 1);
        });
}

void modes(Document& document) {
  Theme theme(document, "modes", "evaluated and given vertices, one- and two-dimensional, in every primitive",
              {"EV-COORD-PRIMS", "EV-COORD-MIX", "EV-COORD-MIXDIM", "EV-COORD-INBEGIN"});
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    add(theme, kPositions, [&](gl::Case& c) {
      define_and_enable(c, GL_MAP1_VERTEX_3);
      define_and_enable(c, GL_MAP2_VERTEX_4);
      c.Begin(mode);
      c.EvalCoord1f(0);
      c.EvalCoord2f(0.5f, 0.25f);
      c.Vertex3f(1, 2, 3);
      c.EvalCoord1f(0.75f);
      c.EvalPoint1(1);
      c.EvalPoint2(0, 1);
      c.End();
    });
}

void nothing(Document& document) {
  Theme theme(document, "no-vertex-map", "without a vertex map of that dimension nothing happens at all",
              {"EV-COORD-NOVERTEX", "EV-COORD-NOVERTEX-OTHERDIM", "EV-EN-DIM"});
  for (const bool two : {false, true})
    for (const GLenum other : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_VERTEX_3})
      add(theme, kEverything, [&](gl::Case& c) {
        current_values(c);
        // The vertex map is of the other dimension, all other maps are of this one.
        define_and_enable(c, target_of(other == GL_MAP1_VERTEX_3 ? !two : two, other));
        c.Enable(GL_AUTO_NORMAL);
        c.Begin(GL_POINTS);
        evaluate(c, two);
        c.Vertex2f(1, 2);
        evaluate(c, two);
        c.End();
        if (two)
          c.EvalMesh2(GL_FILL, 0, 1, 0, 1);
        else
          c.EvalMesh1(GL_LINE, 0, 1);
        query_current_values(c);
      });

  Theme dimensions(document, "dimension", "maps of one dimension do not affect evaluation in the other",
                   {"EV-COORD-DIM1", "EV-COORD-DIM2", "EV-MESH1-ONLY1D", "EV-MESH2-ONLY2D"});
  for (const bool two : {false, true})
    add(dimensions, kEverything, [&](gl::Case& c) {
      current_values(c);
      define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
      for (const GLenum kind : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_VERTEX_4})
        define_and_enable(c, target_of(!two, kind));
      draw(c, two);
      draw(c, !two);
    });
}

void precedence(Document& document) {
  Theme vertex(document, "precedence-vertex",
               "VERTEX_3 and VERTEX_4 enabled: only VERTEX_4 is used, in whichever order",
               {"EV-PREC-VERTEX", "EV-PREC-ORDERFREE", "EV-PREC-FALLBACK"});
  Theme texture(document, "precedence-texture",
                "several texture maps enabled: only the one with most coordinates is used",
                {"EV-PREC-TEX", "EV-PREC-LOSER-IGNORED", "EV-PREC-FALLBACK", "EV-CUR-MAXCOMP"});
  Theme kinds(document, "precedence-kinds", "maps of all kinds side by side: all take effect",
              {"EV-PREC-PERKIND"});
  for (const bool two : {false, true}) {
    for (const bool four_first : {false, true})
      add(vertex, kPositions, [&](gl::Case& c) {
        for (const bool four : {four_first, !four_first})
          define_and_enable(c, target_of(two, four ? GL_MAP1_VERTEX_4 : GL_MAP1_VERTEX_3));
        draw(c, two);
        c.Disable(target_of(two, GL_MAP1_VERTEX_4));
        draw(c, two);
        c.Enable(target_of(two, GL_MAP1_VERTEX_4));
        c.Disable(target_of(two, GL_MAP1_VERTEX_3));
        draw(c, two);
      });
    for (int subset = 1; subset < 16; ++subset)
      add(texture, {.texture_units = 1}, [&](gl::Case& c) {
        c.TexCoord4f(5, 6, 7, 8);
        define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
        for (GLenum i = 0; i < 4; ++i)
          if (subset >> i & 1) define_and_enable(c, target_of(two, GL_MAP1_TEXTURE_COORD_1 + i));
        draw(c, two);
        for (GLenum i = 3; i > 0; --i)
          if (subset >> i & 1) {
            c.Disable(target_of(two, GL_MAP1_TEXTURE_COORD_1 + i));
            draw(c, two);
            break;
          }
      });
    add(kinds, kEverything, [&](gl::Case& c) {
      for (const GLenum kind : gl::kMap1Targets) define_and_enable(c, target_of(two, kind));
      draw(c, two);
    });
  }
}

void currents(Document& document) {
  Theme theme(document, "current",
              "current values that change between vertices: attributes without a map have them",
              {"EV-COORD-CURRENT", "EV-COORD-MATERIAL", "EV-MESH1-CURRENT"});
  for (const bool two : {false, true})
    add(theme, kEverything, [&](gl::Case& c) {
      define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
      c.Begin(GL_LINE_STRIP);
      c.Color3f(1, 0.5f, 0.25f);
      evaluate(c, two);
      c.Normal3f(1, 2, 3);
      evaluate(c, two);
      c.TexCoord2f(-1, 4);
      evaluate(c, two);
      c.Color4f(0, 0, 2, -1);
      c.Vertex2f(1, 1);
      evaluate(c, two);
      c.End();
      if (two)
        c.EvalMesh2(GL_LINE, 0, 1, 0, 1);
      else
        c.EvalMesh1(GL_LINE, 0, 1);
    });

  Theme units(document, "texture-units",
              "texture maps feed unit 0, whatever unit is active; the others keep their values",
              {"EV-ATTR-UNIT0", "EV-ATTR-OTHERUNITS", "EV-CUR-OTHERUNITS"});
  for (const bool two : {false, true})
    for (GLenum i = 0; i < 4; ++i)
      add(units, {.texture_units = 2}, [&](gl::Case& c) {
        c.MultiTexCoord4f(GL_TEXTURE0, 1, 2, 3, 4);
        c.MultiTexCoord4f(GL_TEXTURE1, 5, 6, 7, 8);
        define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
        define_and_enable(c, target_of(two, GL_MAP1_TEXTURE_COORD_1 + i));
        c.ActiveTexture(GL_TEXTURE1);
        draw(c, two);
        c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
        c.ActiveTexture(GL_TEXTURE0);
        c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
      });

  Theme clamping(document, "colors-beyond-one", "colours outside of [0, 1] are not clamped by the evaluator",
                 {"EV-ATTR-COLOR-CLAMP"});
  for (const bool two : {false, true})
    add(clamping, {.color = true}, [&](gl::Case& c) {
      define_and_enable(c, target_of(two, GL_MAP1_VERTEX_3));
      Map map = some_map(target_of(two, GL_MAP1_COLOR_4));
      for (double& x : map.points) x = 4 * x - 3;
      define(c, Type::kSingle, map);
      c.Enable(map.target);
      draw(c, two);
    });

  Theme rational(document, "rational",
                 "only the vertex is rational: w divides no colour, normal or texture coordinate",
                 {"EV-ATTR-RATIONAL-ONLYVTX", "EV-ATTR-VERTEX4"});
  for (const bool two : {false, true})
    add(rational, kEverything, [&](gl::Case& c) {
      for (const GLenum kind : {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
        define_and_enable(c, target_of(two, kind));
      draw(c, two);
    });
}

// --- Meshes

void meshes(Document& document) {
  Theme one(document, "mesh1", "EvalMesh1: points and one line strip",
            {"EV-MESH1-POINT", "EV-MESH1-LINE", "EV-MESH1-COORDS", "EV-MESH1-SUBRANGE"});
  Theme two(document, "mesh2",
            "EvalMesh2: points with i fastest, strips along u and then along v, strips of quads",
            {"EV-MESH2-POINT", "EV-MESH2-LINE", "EV-MESH2-FILL", "EV-MESH2-COORDS", "EV-MESH2-MODESAGREE"});
  struct Grid {
    int n;
    double first, last;
    int from, to;
    Names requirements;
  };
  const Grid kGrids[] = {{3, 0, 1, 0, 3, {}},
                         {3, 0.1, 0.7, 0, 3, {}},
                         {3, 0, 1, -1, 1, {"EV-MESH1-NEGATIVE"}},
                         {2, 0, 1, 1, 4, {"EV-MESH1-NEGATIVE"}},
                         {4, 1, 0, 1, 3, {"EV-GRID-REVERSED"}},
                         {5, 0.5, 0.5, 0, 2, {"EV-GRID-EQUAL"}},
                         {3, 0, 1, 2, 2, {"EV-MESH1-SINGLE"}},
                         {3, 0, 1, 2, 1, {"EV-MESH1-EMPTY"}},
                         {2147483647, 0, 1, 2147483646, 2147483647, {"EV-GRID-LARGE"}}};
  for (const Grid& g : kGrids)
    for (const GLenum mode : {GL_POINT, GL_LINE}) {
      const Type type = kTypes[one.count() / 2 % 2];
      add(
          one, kPositions,
          [&](gl::Case& c) {
            define_and_enable(c, GL_MAP1_VERTEX_3);
            grid1(c, type, g.n, rounded(g.first, type), rounded(g.last, type));
            c.EvalMesh1(mode, g.from, g.to);
          },
          g.requirements);
    }
  struct Range {
    int i1, i2, j1, j2;
    Names requirements;
  };
  const Range kRanges[] = {{0, 2, 0, 1, {"EV-MESH2-SHAREDROW"}},
                           {0, 1, 0, 2, {"EV-MESH2-SHAREDROW"}},
                           {-1, 0, 1, 2, {"EV-MESH2-RANGE"}},
                           {1, 3, 2, 3, {"EV-MESH2-RANGE"}},
                           {1, 1, 0, 1, {"EV-MESH2-LINE-DEGENERATE", "EV-MESH2-EMPTY"}},
                           {0, 1, 2, 2, {"EV-MESH2-LINE-DEGENERATE", "EV-MESH2-EMPTY"}},
                           {1, 1, 1, 1, {"EV-MESH2-LINE-DEGENERATE", "EV-MESH2-EMPTY"}},
                           {2, 1, 0, 1, {"EV-MESH2-EMPTY"}},
                           {0, 1, 1, 0, {"EV-MESH2-EMPTY"}}};
  for (const Range& r : kRanges)
    for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
      const Type type = kTypes[two.count() / 3 % 2];
      add(
          two, kPositions,
          [&](gl::Case& c) {
            define_and_enable(c, GL_MAP2_VERTEX_3);
            grid2(c, type, 2, rounded(0.1, type), rounded(0.7, type), 2, 1, 0);
            c.EvalMesh2(mode, r.i1, r.i2, r.j1, r.j2);
          },
          r.requirements);
    }

  Theme late(document, "grid-late",
             "meshes and points use the grid and the maps in force when they are executed",
             {"EV-GRID-LATE", "EV-MAP1-LIVE"});
  for (const bool surfaces : {false, true})
    add(late, kPositions, [&](gl::Case& c) {
      define_and_enable(c, target_of(surfaces, GL_MAP1_VERTEX_3));
      for (const int n : {2, 5}) {
        c.MapGrid1f(n, 0, 1);
        c.MapGrid2f(n, 0, 1, n, 1, 0);
        c.Begin(GL_POINTS);
        if (surfaces)
          c.EvalPoint2(1, 1);
        else
          c.EvalPoint1(1);
        c.End();
        if (surfaces)
          c.EvalMesh2(GL_POINT, 1, 2, 1, 1);
        else
          c.EvalMesh1(GL_POINT, 1, 2);
        define(c, Type::kReal, some_map(target_of(surfaces, GL_MAP1_VERTEX_3), 3));
      }
    });
}

// --- Normals

void normals(Document& document) {
  Theme theme(document, "auto-normal", "which normal a vertex has: generated, of a map, the current one",
              {"EV-AUTON-USED", "EV-AUTON-OVERRIDE", "EV-AUTON-OFF-MAP", "EV-AUTON-OFF-NONE", "EV-AUTON-1D",
               "EV-AUTON-CURRENT", "EV-AUTON-VERTEX4WINS", "EV-AUTON-MESH", "EV-AUTON-SAMEVERTEX"});
  const auto plane = [](GLenum target, bool turned) {
    const int k = gl::components_of(target);
    Map map{target, {2, 0, 1}, {2, 0, 1}, {}};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int c = 0; c < k; ++c)
          map.points.push_back(c == 0 ? (turned ? j : i) : c == 1 ? (turned ? i : j) : c == 2 ? i * j : 1);
    return map;
  };
  for (const bool with_map : {false, true})
    for (const bool automatic : {false, true})
      for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4})
        for (const int how : {0, 1, 2})
          add(theme, {.normal = true}, [&](gl::Case& c) {
            c.Normal3f(0.5f, -1, 2);
            define(c, Type::kSingle, plane(target, false));
            c.Enable(target);
            if (how == 1) {  // both vertex maps, with opposite normals
              const GLenum other = target == GL_MAP2_VERTEX_3 ? GL_MAP2_VERTEX_4 : GL_MAP2_VERTEX_3;
              define(c, Type::kSingle, plane(other, true));
              c.Enable(other);
            }
            if (with_map) define_and_enable(c, GL_MAP2_NORMAL);
            if (automatic) c.Enable(GL_AUTO_NORMAL);
            if (how == 2) {
              c.MapGrid2f(2, 0, 1, 2, 0, 1);
              c.EvalMesh2(target == GL_MAP2_VERTEX_3 ? GL_FILL : GL_POINT, 0, 1, 1, 2);
            } else {
              draw(c, true);
            }
            c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
          });
  add(theme, {.normal = true}, [](gl::Case& c) {
    c.Normal3f(0.5f, -1, 2);
    define_and_enable(c, GL_MAP1_VERTEX_3);
    c.Enable(GL_AUTO_NORMAL);
    draw(c, false);
    define_and_enable(c, GL_MAP1_NORMAL);
    draw(c, false);
  });
}

// --- Saved state and lists

void attribute_stack(Document& document) {
  Theme theme(document, "attribute-stack", "what each bit saves and restores: never the maps themselves",
              {"EV-ATTRIB-EVALBIT", "EV-ATTRIB-ENABLEBIT", "EV-ATTRIB-ENABLEBIT-NOGRID", "EV-ATTRIB-NOMAPS",
               "EV-ATTRIB-ALL", "EV-ATTRIB-OTHERBITS", "EV-ATTRIB-NEST"});
  constexpr GLbitfield kMasks[] = {GL_EVAL_BIT,        GL_ENABLE_BIT,   GL_CURRENT_BIT,
                                   GL_ALL_ATTRIB_BITS, GL_LIGHTING_BIT, GL_EVAL_BIT | GL_CURRENT_BIT};
  const auto change = [](gl::Case& c, int by) {
    c.MapGrid1f(2 + by, by, 2.0f * by + 1);
    c.MapGrid2f(3 + by, by, 7, 4, 1, -1.0f * by);
    current_values(c);
    c.Color4f(0.25f * by, 0.5f, 0.5f, 0.5f);
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_COLOR_4, GL_AUTO_NORMAL}) {
      if (by % 2 == 1)
        c.Enable(target);
      else
        c.Disable(target);
    }
    map1(c, Type::kSingle, GL_MAP1_INDEX, 0, by, 1, 2, {1.0 * by, 2.0 * by});
  };
  const auto query = [](gl::Case& c) {
    query_grids(c);
    query_current_values(c);
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_COLOR_4, GL_AUTO_NORMAL}) c.IsEnabled(target);
    query_all(c, GL_MAP1_INDEX, 2);
  };
  for (const GLbitfield mask : kMasks)
    add(theme, kPositions, [&](gl::Case& c) {
      change(c, 1);
      c.PushAttrib(mask);
      change(c, 2);
      query(c);
      c.PopAttrib();
      query(c);
    });
  add(theme, kPositions, [&](gl::Case& c) {
    for (int depth = 1; depth <= 4; ++depth) {
      change(c, depth);
      c.PushAttrib(kMasks[depth - 1]);
    }
    for (int depth = 4; depth > 0; --depth) {
      c.PopAttrib();
      query(c);
    }
  });
}

// --- Random programs

bool fits_every_implementation(const gl::Case& program) {
  for (const gl::Command& command : program.commands()) {
    const std::string_view name = gl::name_of(command.entry);
    const auto above = [&](std::size_t at) { return std::get<std::int64_t>(command.arguments[at]) > 8; };
    if (name.starts_with("glMap1") && above(4)) return false;
    if (name.starts_with("glMap2") && (above(4) || above(8))) return false;
  }
  return true;
}

void random_programs(Document& document) {
  constexpr std::uint32_t kSeed = 20, kMostTried = 4000;
  constexpr int kPrograms = 60, kLength = 24, kMaxEvalOrder = 64;
  constexpr std::size_t kMostVertices = 24, kFewestVertices = 1;
  Theme theme(document, "random",
              "random legal programs, commands that are rejected among them; orders up to 8",
              {"EV-COORD-ASIF", "EV-COORD-CURRENT", "EV-CUR-GRIDMAPS", "EV-BE-ORDER"});
  for (std::uint32_t number = 0; theme.count() < kPrograms && number < kMostTried; ++number) {
    const fuzz::SpecifiedProgram random =
        fuzz::random_specified_program(kSeed, number, kLength, kMaxEvalOrder);
    const std::size_t vertices = random.specified.prediction.vertex_count();
    if (!fits_every_implementation(random.program) || vertices < kFewestVertices || vertices > kMostVertices)
      continue;
    gl::Case program;
    // Programs that replay a sequence query the errors after each step.
    for (const gl::Command& command : random.program.commands())
      if (command.entry != gl::EntryPoint::GetError) program.add(command);
    theme.add(sequence(program, {.color = true, .normal = true, .texture_units = 2}));
  }
}

}  // namespace
}  // namespace evalcts::vectors::states

namespace evalcts::vectors {

Document state() {
  using namespace states;
  Document document("state",
                    "Sequences of commands: errors, answers to queries, and the vertices that are drawn.");
  initial(document);
  enables(document);
  grids(document);
  attributes(document);
  forms(document);
  modes(document);
  nothing(document);
  precedence(document);
  currents(document);
  meshes(document);
  normals(document);
  attribute_stack(document);
  lists(document);
  random_programs(document);
  exact_ends(document);
  long_meshes(document);
  steep_meshes(document);
  meshes_keep_state(document);
  limits(document);
  high_orders(document);
  return document;
}

}  // namespace evalcts::vectors
