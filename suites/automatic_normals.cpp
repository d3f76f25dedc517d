// Section 10 of the requirements: the normals that AUTO_NORMAL generates. Their directions are judged by the
// accuracy rule for normals, which allows the errors of any usual method of computing them.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/testkit/registration.h>

#include "grid_cases.h"

namespace evalcts::suite_automatic_normals {
namespace {

// The control points of a surface as a function of their indices.
using Net = std::function<std::array<double, 4>(int i, int j)>;

Map surface(GLenum target, int uorder, int vorder, const Net& net) {
  std::vector<double> points;
  for (int i = 0; i < uorder; ++i)
    for (int j = 0; j < vorder; ++j) {
      const std::array<double, 4> point = net(i, j);
      points.insert(points.end(), point.begin(), point.begin() + gl::components_of(target));
    }
  return make_map2(target, uorder, vorder, points);
}

// A plane with u along +x and v along +y, whose normal is (0,0,1).
std::array<double, 4> plane(int i, int j) { return {1.0 * i, 1.0 * j, 0, 1}; }
std::array<double, 4> plane_flipped(int i, int j) { return {1.0 * j, 1.0 * i, 0, 1}; }
// A plane in general position.
std::array<double, 4> tilted(int i, int j) {
  return {2 + i + 0.25 * j, 0.5 * j - 0.125 * i, 1 + 0.5 * i - j, 1};
}
// A biquadratic bump over the unit square.
std::array<double, 4> bump(int i, int j) { return {0.5 * i, 0.5 * j, i == 1 && j == 1 ? 2.0 : 0.0, 1}; }
// A slightly twisted patch, for any orders.
std::array<double, 4> wave(int i, int j) {
  return {i + 0.2 * ((i + j) % 2), j - 0.3 * (i % 2), 0.8 * ((i * j) % 3) - 0.1 * i, 1};
}
// The plane z = 1/2 with weights from 1 to 4 (orders 2 by 2) or more.
std::array<double, 4> weighted_plane(int i, int j) {
  const double w = 1 + i + 2 * j;
  return {i * w, j * w, 0.5 * w, w};
}
// The same with all components negated, which leaves x/w, y/w and z/w unchanged.
std::array<double, 4> negated_plane(int i, int j) {
  std::array<double, 4> point = weighted_plane(i, j);
  for (double& value : point) value = -value;
  return point;
}
// A quarter of a cylinder about the z axis.
std::array<double, 4> cylinder(int i, int j) {
  const double w = i == 1 ? std::sqrt(0.5) : 1.0;
  return {(i < 2 ? 1 : 0) * w, (i > 0 ? 1 : 0) * w, 1.5 * j * w, w};
}
// An eighth of a sphere.
std::array<double, 4> sphere(int i, int j) {
  const double wi = i == 1 ? std::sqrt(0.5) : 1.0, wj = j == 1 ? std::sqrt(0.5) : 1.0;
  const double r = j < 2 ? 1 : 0, z = j > 0 ? 1 : 0;
  return {(i < 2 ? 1 : 0) * r * wi * wj, (i > 0 ? 1 : 0) * r * wi * wj, z * wi * wj, wi * wj};
}

struct Patch {
  const char* name;
  GLenum target;
  int uorder, vorder;
  std::array<double, 4> (*net)(int i, int j);

  Map map() const { return surface(target, uorder, vorder, net); }
  // Returns the map with x, y and z multiplied by `size`.
  Map map_of_size(double size) const {
    Map map = this->map();
    for (std::size_t i = 0; i < map.points.size(); ++i)
      if (map.components() == 3 || i % 4 != 3) map.points[i] *= size;
    return map;
  }
};
constexpr Patch kPolynomial[] = {{"BUMP_3X3", GL_MAP2_VERTEX_3, 3, 3, bump},
                                 {"WAVE_4X4", GL_MAP2_VERTEX_3, 4, 4, wave},
                                 {"WAVE_2X5", GL_MAP2_VERTEX_3, 2, 5, wave},
                                 {"WAVE_6X3", GL_MAP2_VERTEX_3, 6, 3, wave},
                                 {"WAVE_4X4_W1", GL_MAP2_VERTEX_4, 4, 4, wave}};
constexpr Patch kRational[] = {{"PLANE_2X2", GL_MAP2_VERTEX_4, 2, 2, weighted_plane},
                               {"PLANE_3X4", GL_MAP2_VERTEX_4, 3, 4, weighted_plane},
                               {"CYLINDER", GL_MAP2_VERTEX_4, 3, 2, cylinder},
                               {"SPHERE", GL_MAP2_VERTEX_4, 3, 3, sphere},
                               {"NEGATIVE_W", GL_MAP2_VERTEX_4, 2, 3, negated_plane}};

// Returns all pairs of a `us` and a `vs`.
std::vector<At> lattice(const std::vector<double>& us, const std::vector<double>& vs) {
  std::vector<At> all;
  for (const double u : us)
    for (const double v : vs) all.push_back({u, v});
  return all;
}
const std::vector<At> kAcross = {{0, 1}, {0.25, 0.75}, {0.75, 0.25}};

// Evaluates on a lattice without v2, at which the sphere above is degenerate.
void evaluate_inside(gl::Case& c, const Map& map, int steps = 4) {
  c.Begin(GL_POINTS);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j < steps; ++j)
      c.EvalCoord2f(map.u1 + (map.u2 - map.u1) * i / steps, map.v1 + (map.v2 - map.v1) * j / steps);
  c.End();
}

void expect_normals(Test& t, const std::string& identity, const std::vector<Map>& maps,
                    Attributes required = kNormal) {
  gl::Case c = with_current_values(identity);
  c.Enable(GL_AUTO_NORMAL);
  for (const Map& map : maps) {
    define_and_enable(c, map);
    evaluate_inside(c, map);
    c.Disable(map.target);
  }
  t.judge_vertices(c, required);
}

// Normals of unit length, and those that a vertex shader receives: the same rule, except for the length.
constexpr NamedValue<Attributes> kLengths[] = {{"UNIT", kNormal | kUnitNormal}, {"SHADER", kNormal}};

// --- Where the normal comes from -------------------------------------------------------------------------

EVALCTS_TEST(AutomaticNormals, Used, kMust, "EV-AUTON-USED", by(gl::surface_deliveries()))
(Test& t) {
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
    gl::Case c = with_current_values(label(target));
    // AUTO_NORMAL is enabled before or after the map.
    if (target == GL_MAP2_VERTEX_3) c.Enable(GL_AUTO_NORMAL);
    define_and_enable(c, surface(target, 3, 3, bump));
    if (target == GL_MAP2_VERTEX_4) c.Enable(GL_AUTO_NORMAL);
    evaluate_all(c, lattice({0, 0.25, 0.5, 1}, {0, 0.375, 0.75, 1}));
    t.judge_vertices(c, kNormal);
  }
};

void expect_with(Test& t, const std::string& identity, const std::vector<std::pair<bool, bool>>& switches) {
  gl::Case c = with_current_values(identity);
  define_and_enable(c, surface(GL_MAP2_VERTEX_3, 4, 4, wave));
  define(c, random_map(t, GL_MAP2_NORMAL, {2, 3}));
  // Only enables that change are set, so that redundant calls do not hide a bug.
  std::pair<bool, bool> now = {false, false};
  for (const auto& [automatic, map] : switches) {
    if (automatic != now.first) automatic ? c.Enable(GL_AUTO_NORMAL) : c.Disable(GL_AUTO_NORMAL);
    if (map != now.second) map ? c.Enable(GL_MAP2_NORMAL) : c.Disable(GL_MAP2_NORMAL);
    now = {automatic, map};
    evaluate_all(c, kAcross);
  }
  t.judge_vertices(c, kNormal);
}

EVALCTS_TEST(AutomaticNormals, BeforeNormalMap, kMust, "EV-AUTON-OVERRIDE", by(gl::surface_deliveries()))
(Test& t) { expect_with(t, "AUTO_NORMAL and a NORMAL map", {{true, true}}); };
EVALCTS_TEST(AutomaticNormals, NormalMapWhenOff, kMust, "EV-AUTON-OFF-MAP", by(gl::surface_deliveries()))
(Test& t) { expect_with(t, "a NORMAL map", {{false, true}}); };
EVALCTS_TEST(AutomaticNormals, CurrentNormalWhenOff, kMust, "EV-AUTON-OFF-NONE", by(gl::surface_deliveries()))
(Test& t) { expect_with(t, "neither AUTO_NORMAL nor a NORMAL map", {{false, false}}); };
EVALCTS_TEST(AutomaticNormals, SwitchedOn, kMust, "EV-AUTON-OVERRIDE", "EV-AUTON-OFF-MAP",
             by(gl::surface_deliveries()))
(Test& t) {
  expect_with(t, "a NORMAL map, AUTO_NORMAL on, off and on",
              {{false, true}, {true, true}, {false, true}, {true, true}});
};
EVALCTS_TEST(AutomaticNormals, SwitchedOff, kMust, "EV-AUTON-OFF-NONE", by(gl::surface_deliveries()))
(Test& t) {
  expect_with(t, "all that makes a normal is switched off",
              {{true, true}, {true, false}, {false, false}, {true, false}});
};

std::vector<gl::Delivery> one_dimensional() {
  std::vector<gl::Delivery> deliveries = gl::curve_deliveries();
  std::erase_if(deliveries, [](const gl::Delivery& delivery) { return delivery.lifted; });
  return deliveries;
}

EVALCTS_TEST(AutomaticNormals, NotInOneDimension, kMust, "EV-AUTON-1D", by(one_dimensional()))
(Test& t) {
  for (const bool map : {true, false}) {
    gl::Case c = with_current_values(map ? "AUTO_NORMAL with a MAP1_NORMAL map" : "AUTO_NORMAL alone");
    c.Enable(GL_AUTO_NORMAL);
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_NORMAL}) {
      define(c, random_map(t, target, 3));
      if (map || target == GL_MAP1_VERTEX_3) c.Enable(target);
    }
    evaluate_all(c, {0.0, 0.25, 0.75, 1.0});
    t.judge_vertices(c, kNormal);
  }
};

EVALCTS_TEST(AutomaticNormals, OfTheMapThatIsDrawn, kMust, "EV-AUTON-VERTEX4WINS",
             by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c("VERTEX_3 and VERTEX_4 of different orientation, then each alone");
  c.Enable(GL_AUTO_NORMAL);
  define_and_enable(c, surface(GL_MAP2_VERTEX_3, 2, 2, tilted));
  define_and_enable(c, surface(GL_MAP2_VERTEX_4, 3, 3, sphere));
  for (int round = 0; round < 3; ++round) {
    if (round == 1) c.Disable(GL_MAP2_VERTEX_4);
    if (round == 2) c.Enable(GL_MAP2_VERTEX_4), c.Disable(GL_MAP2_VERTEX_3);
    evaluate_all(c, {{0, 0.125}, {0.25, 0.25}, {0.75, 0.5}});
  }
  t.judge_vertices(c, kNormal);
};

EVALCTS_TEST(AutomaticNormals, NothingWithoutVertexMap, kMust, "EV-AUTON-NOVERTEX",
             by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c("AUTO_NORMAL and all maps but those of vertices");
  enable_maps(t, c, true);
  c.Disable(GL_MAP2_VERTEX_4);
  define_and_enable(c, surface(GL_MAP2_NORMAL, 2, 2, plane));
  c.Enable(GL_AUTO_NORMAL);
  evaluate_all(c, kAcross);
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST(AutomaticNormals, CurrentNormalStays, kMust, "EV-AUTON-CURRENT", by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c("queried after evaluation, seen by the next vertex without AUTO_NORMAL");
  c.Normal3f(0.6f, -0.5f, 0.8f);
  const auto ask = [&] { t.compare_only({c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3))}); };
  ask();
  define_and_enable(c, surface(GL_MAP2_VERTEX_3, 4, 4, wave));
  c.Enable(GL_AUTO_NORMAL);
  evaluate_all(c, kAcross);
  ask();
  t.judge_answers(c);
};

EVALCTS_TEST(AutomaticNormals, NextVertexHasTheCurrentNormal, kMust, "EV-AUTON-CURRENT",
             by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("Vertex, and evaluation without AUTO_NORMAL, after evaluation with it");
  define_and_enable(c, surface(GL_MAP2_VERTEX_3, 4, 4, wave));
  c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  c.EvalCoord2f(0.25f, 0.5f);
  c.Vertex3f(1, 2, 3);
  c.EvalCoord2f(0.75f, 0.5f);
  c.End();
  c.Disable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  c.EvalCoord2f(0.25f, 0.5f);
  c.End();
  t.judge_vertices(c, kNormal);
};

// --- Direction and length --------------------------------------------------------------------------------

EVALCTS_TEST(AutomaticNormals, Direction, kMust, "EV-AUTON-DIRECTION",
             combine(kLengths).by(gl::list_deliveries()))
(Test& t, const NamedValue<Attributes>& lengths) {
  expect_normals(t, "u along +x and v along +y, the reverse, and a tilted plane",
                 {surface(GL_MAP2_VERTEX_3, 2, 2, plane), surface(GL_MAP2_VERTEX_3, 2, 2, plane_flipped),
                  surface(GL_MAP2_VERTEX_3, 3, 2, plane), surface(GL_MAP2_VERTEX_3, 2, 2, tilted),
                  surface(GL_MAP2_VERTEX_3, 3, 4, tilted), surface(GL_MAP2_VERTEX_4, 2, 2, tilted)},
                 lengths.value);
};

EVALCTS_TEST(AutomaticNormals, Curved, kMust, "EV-AUTON-CURVED", "EV-AUTON-METHOD",
             combine(kPolynomial).by(gl::list_deliveries()))
(Test& t, const Patch& patch) {
  expect_normals(t, "over [0,1] and over [2,5] x [-3,-1]",
                 {patch.map(), over(patch.map(), {2, 5}, {-3, -1})});
};

EVALCTS_TEST(AutomaticNormals, OrderPairs, kMust, "EV-AUTON-CURVED", by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("all pairs of orders from 2 to 5, of both vertex maps");
  c.Enable(GL_AUTO_NORMAL);
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
    c.Enable(target);
    for (int uorder = 2; uorder <= 5; ++uorder)
      for (int vorder = 2; vorder <= 5; ++vorder) {
        define(c, surface(target, uorder, vorder, wave));
        evaluate_all(c, kAcross);
      }
  }
  t.judge_vertices(c, kNormal);
};

EVALCTS_TEST(AutomaticNormals, LargeOrders, kMust, "EV-AUTON-CURVED", by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("orders above 8, near the middle of nets around the origin");
  c.Enable(GL_AUTO_NORMAL);
  const int max = t.max_order();
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
    c.Enable(target);
    for (const auto& [uorder, vorder] : {Orders{9, 9}, {12, 17}, {20, 20}, {30, 30}, {max, 8}}) {
      if (uorder > max || vorder > max) continue;
      // Elsewhere, or farther from the origin, the errors of the values would exceed the differences of
      // control points, and any normal would be accepted.
      define(c, surface(target, uorder, vorder, [u = uorder, v = vorder](int i, int j) {
               return std::array<double, 4>{i - (u - 1) / 2.0, j - (v - 1) / 2.0, (i * j % 3 - 1) / 16.0, 1};
             }));
      evaluate_all(c, std::vector<At>{{0.5, 0.5}, {0.53125, 0.46875}});
    }
  }
  t.judge_vertices(c, kNormal);
};

// GL 1.0 requires the analytic normal. It is judged to single precision.
EVALCTS_TEST(AutomaticNormals, Analytic, kQuality, "EV-AUTON-METHOD",
             combine(kPolynomial).by(gl::list_deliveries()))
(Test& t, const Patch& patch) { expect_normals(t, "the analytic normal", {patch.map()}); };

EVALCTS_TEST(AutomaticNormals, Rational, kMust, "EV-AUTON-RATIONAL",
             combine(kRational).by(gl::list_deliveries()))
(Test& t, const Patch& patch) { expect_normals(t, "derivatives of x/w, y/w, z/w", {patch.map()}); };

// If one direction of the domain is reversed, either sign is accepted (U-AUTON-REVSIGN).
EVALCTS_TEST(AutomaticNormals, ReversedDomain, kMust, "EV-AUTON-CURVED",
             combine(kLengths).by(gl::list_deliveries()))
(Test& t, const NamedValue<Attributes>& lengths) {
  std::vector<Map> maps;
  for (const auto& [u, v] : {std::pair{Interval{1, 0}, Interval{0, 1}}, {{0, 1}, {1, 0}}, {{1, 0}, {1, 0}}})
    maps.push_back(over(surface(GL_MAP2_VERTEX_3, 4, 4, wave), u, v));
  expect_normals(t, "u, v, and both reversed", maps, lengths.value);
};

EVALCTS_TEST(AutomaticNormals, UnitLength, kMust, "EV-AUTON-UNIT", by(gl::list_deliveries()))
(Test& t) {
  std::vector<Map> maps;
  for (const double size : {5e-5, 0.01, 1.0, 37.0, 1000.0})
    for (const Patch& patch : {kPolynomial[0], kPolynomial[1], kRational[3]})
      maps.push_back(patch.map_of_size(size));
  maps.push_back(over(surface(GL_MAP2_VERTEX_3, 3, 3, bump), {0, 100}, {0, 0.125}));
  expect_normals(t, "patches of size 5e-5 to 1000, and over [0,100] x [0,1/8]", maps, kNormal | kUnitNormal);
};

// A vertex shader receives normals that are not normalised: a plane of 10 by 10 over [0,1] x [0,1] has a
// normal of length 100.
EVALCTS_TEST(AutomaticNormals, NotNormalisedWithShader, kMust, "EV-AUTON-SHADER", by(gl::list_deliveries()))
(Test& t) {
  t.require(2, 0, "GL_ARB_vertex_shader");
  std::vector<Map> maps;
  for (const double size : {0.125, 1.0, 10.0})
    for (const Patch& patch : {Patch{"", GL_MAP2_VERTEX_3, 2, 2, plane}, kPolynomial[0], kRational[2]})
      maps.push_back(patch.map_of_size(size));
  expect_normals(t, "planes, bumps and cylinders of three sizes", maps, kNormal | kShaderNormal);
};

// --- Other values ----------------------------------------------------------------------------------------

EVALCTS_TEST(AutomaticNormals, RestOfTheVertex, kMust, "EV-AUTON-SAMEVERTEX", by(gl::surface_deliveries()))
(Test& t) {
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
    gl::Case c = with_current_values(label(target) + " with colour and texture coordinate maps");
    for (const GLenum other : {GL_MAP2_COLOR_4, GL_MAP2_TEXTURE_COORD_3})
      define_and_enable(c, random_map(t, other, {3, 2}));
    define_and_enable(c, surface(target, 4, 4, target == GL_MAP2_VERTEX_4 ? weighted_plane : wave));
    for (const bool automatic : {false, true}) {
      if (automatic) c.Enable(GL_AUTO_NORMAL);
      evaluate_all(c, {{0, 1}, {0.25, 0.75}, {0.75, 0.25}, {1, 0}});
    }
    t.judge_vertices(c, kUnit0);
  }
};

EVALCTS_TEST(AutomaticNormals, PositionToTheBit, kQuality, "EV-AUTON-SAMEVERTEX",
             combine(kRational).by(gl::list_deliveries()))
(Test& t, const Patch& patch) {
  gl::Case c("off, then on");
  const Map map = patch.map();
  define_and_enable(c, map);
  evaluate_inside(c, map);
  c.Enable(GL_AUTO_NORMAL);
  evaluate_inside(c, map);
  const std::vector<ObservedVertex> vertices = vertices_of(t.observe(c, kPosition, 64));
  const auto in_words = [](const std::array<float, 4>& p) {
    return fmt::format("({}, {}, {}, {})", hexadecimal(p[0]), hexadecimal(p[1]), hexadecimal(p[2]),
                       hexadecimal(p[3]));
  };
  const std::size_t half = vertices.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    const auto &position = vertices[i].position, &moved = vertices[half + i].position;
    if (position == moved) continue;
    const std::string what = fmt::format("position of vertex {}", i);
    t.fail(failure_of(c, what, what + " changes by some bits when AUTO_NORMAL is switched on",
                      in_words(position) + " as without AUTO_NORMAL", in_words(moved)));
  }
};

EVALCTS_TEST(AutomaticNormals, InMeshes, kMust, "EV-AUTON-MESH",
             combine(kMeshModes).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  gl::Case c = with_current_values("polynomial and rational patches");
  c.Enable(GL_AUTO_NORMAL);
  map_grid(c, {4, 0, 1}, {3, 0, 0.75f});
  for (const Patch& patch : {kPolynomial[0], kPolynomial[1], kRational[3]}) {
    define_and_enable(c, patch.map());
    c.EvalMesh2(mode.mode, 0, 4, 0, 3);
    c.Disable(patch.target);
  }
  t.judge_vertices(c, kNormal);
};

struct Degenerate {
  const char* name;
  Map map;
};

// Judges positions only, because the normals of these patches are unspecified (U-AUTON-ZERO, U-AUTON-W0). A
// later evaluation of a regular patch has to work.
void expect_survival(Test& t, const std::vector<Degenerate>& patches) {
  for (const auto& [name, map] : patches) {
    gl::Case c(name);
    c.Enable(GL_AUTO_NORMAL);
    define_and_enable(c, map);
    evaluate_all(c, lattice({0, 0.5, 1}, {0, 0.25, 1}));
    c.Disable(map.target);
    define_and_enable(c, surface(GL_MAP2_VERTEX_3, 2, 2, tilted));
    evaluate_all(c, lattice({0.5}, {0.25}));
    t.judge_vertices(c, kPosition);
  }
}

EVALCTS_TEST(AutomaticNormals, DegeneratePatches, kMust, "EV-AUTON-DEGENERATE", by(gl::surface_deliveries()))
(Test& t) {
  const auto point = [](int, int) { return std::array<double, 4>{0.5, -1, 2, 1}; };
  const auto line = [](int i, int j) { return std::array<double, 4>{1.0 * (i + j), 2.0 * (i + j), 0.25, 1}; };
  const auto fan = [](int i, int j) {
    return std::array<double, 4>{1.0 * i * (j + 1), 1.0 * i * (2 - j), 0.5 * i, 1};
  };
  const auto zero_w = [](int i, int j) { return std::array<double, 4>{1.0 * i, 1.0 * j, 0.5, 0}; };
  const auto changing_w = [](int i, int j) { return std::array<double, 4>{1.0 * i, 1.0 * j, 0.5, 1.0 - i}; };
  expect_survival(t, {{"all points equal", surface(GL_MAP2_VERTEX_3, 3, 3, point)},
                      {"parallel derivatives", surface(GL_MAP2_VERTEX_3, 3, 3, line)},
                      {"an edge that is a point", surface(GL_MAP2_VERTEX_3, 3, 3, fan)},
                      {"a pole of a sphere", surface(GL_MAP2_VERTEX_4, 3, 3, sphere)},
                      {"w = 0", surface(GL_MAP2_VERTEX_4, 2, 2, zero_w)},
                      {"w through 0", surface(GL_MAP2_VERTEX_4, 3, 2, changing_w)}});
};

EVALCTS_TEST(AutomaticNormals, OrderOne, kMust, "EV-AUTON-DEGENERATE", "EV-AUTON-SAMEVERTEX",
             by(gl::surface_deliveries()))
(Test& t) {
  expect_survival(t, {{"order 1 in u", surface(GL_MAP2_VERTEX_3, 1, 3, wave)},
                      {"order 1 in v", surface(GL_MAP2_VERTEX_4, 3, 1, wave)},
                      {"order 1 in u, 2 in v", surface(GL_MAP2_VERTEX_3, 1, 2, wave)},
                      {"order 2 in u, 1 in v", surface(GL_MAP2_VERTEX_4, 2, 1, wave)},
                      {"order 1 in both", surface(GL_MAP2_VERTEX_3, 1, 1, wave)}});
};

}  // namespace
}  // namespace evalcts::suite_automatic_normals
