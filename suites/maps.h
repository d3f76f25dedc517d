// One- and two-dimensional maps for tests: how they are made, laid out in memory, defined, shown and queried.
#pragma once

#include <reference/map.h>

#include <array>
#include <cstddef>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include <evalcts/gl/player.h>
#include <evalcts/gl/targets.h>
#include "fixtures.h"

namespace evalcts {

// Values of parameters `two`, which choose between the two dimensions.
inline constexpr bool kCurves = false, kSurfaces = true;
// Returns the one-dimensional target itself, or the two-dimensional target of the same name.
GLenum target_in(bool two, GLenum map1_target);
// The nine targets of the dimension.
std::span<const GLenum> targets(bool two);
using gl::all_caps;
using gl::all_targets;

// The one-dimensional targets of all attributes but the position.
inline constexpr GLenum kAttributeTargets[] = {
    GL_MAP1_COLOR_4,         GL_MAP1_INDEX,           GL_MAP1_NORMAL,         GL_MAP1_TEXTURE_COORD_1,
    GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4};

struct Orders {
  int u, v = 1;
  friend bool operator==(const Orders&, const Orders&) = default;
};

// The domain of a map in one direction.
struct Interval {
  double first, last;
};

// The arguments of Map1 or Map2: the point R_ij begins at points[ustride*i + vstride*j]. A one-dimensional
// map has vorder 1, and Map1 takes the members of u only. make_map1() and make_map2() end `points` a whole
// stride (the smaller one) after the beginning of the last point, because the specification does not say
// whether an implementation may read the padding after it (U-TAIL).
struct Map {
  GLenum target = GL_MAP1_VERTEX_3;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  int ustride = 3, vstride = 3, uorder = 1, vorder = 1;
  std::vector<double> points;
  bool two = reference::is_map2_target(target);

  int components() const { return gl::components_of(target); }
  // The control points (v fastest), the orders and the domain as GetMap returns them.
  std::vector<double> coefficients() const;
  std::vector<GLint> orders() const;
  std::vector<double> domain() const;
};

// Value of the padding between control points: so large that any result in which it takes part is wrong.
inline constexpr double kPoison = 1e30;

// Returns a map with the order*k `coefficients`, which are given without padding, laid out with the stride.
// Padding is kPoison.
Map make_map1(GLenum target, double u1, double u2, int stride, const std::vector<double>& coefficients);
// The same without padding, over [0,1].
Map make_map1(GLenum target, const std::vector<double>& coefficients);
// Returns a map over [0,1]x[0,1] with the uorder*vorder*k `coefficients`, which are given without padding and
// with v varying fastest, laid out with the strides. Padding is kPoison. If the strides make points share
// memory, later points overwrite earlier ones; Map::coefficients() returns the result.
Map make_map2(GLenum target, int uorder, int vorder, int ustride, int vstride,
              const std::vector<double>& coefficients);
// The same without padding, v varying fastest.
Map make_map2(GLenum target, int uorder, int vorder, const std::vector<double>& coefficients);

// Returns the map with another domain. The first form keeps the domain of v.
Map over(Map map, const Interval& u);
Map over(Map map, const Interval& u, const Interval& v);

// Returns `count` multiples of 2^-24 in [-1,1), exactly representable in single precision.
std::vector<double> random_values(std::mt19937& random, std::size_t count);

// A layout of control points in memory: the strides as functions of the orders and of k, the number of
// components.
struct Layout {
  const char* name;
  int (*ustride)(int k, int uorder, int vorder);
  int (*vstride)(int k, int uorder, int vorder);
  bool shared;  // true if points share memory
};
inline constexpr Layout kLayouts[] = {
    {"U_MAJOR", [](int k, int, int vorder) { return k * vorder; }, [](int k, int, int) { return k; }, false},
    {"V_MAJOR", [](int k, int, int) { return k; }, [](int k, int uorder, int) { return k * uorder; }, false},
    // The points are one of several attributes of an array whose rows are longer than the net.
    {"EMBEDDED_U_MAJOR", [](int k, int, int vorder) { return (k + 5) * (vorder + 2); },
     [](int k, int, int) { return k + 5; }, false},
    {"EMBEDDED_V_MAJOR", [](int k, int, int) { return k + 3; },
     [](int k, int uorder, int) { return (k + 3) * (uorder + 1) + 1; }, false},
    {"EQUAL_STRIDES", [](int k, int, int) { return k; }, [](int k, int, int) { return k; }, true},
    {"EQUAL_PADDED_STRIDES", [](int k, int, int) { return k + 2; }, [](int k, int, int) { return k + 2; },
     true},
    {"OVERLAPPING_POINTS", [](int k, int, int) { return k + 1; }, [](int k, int, int) { return k; }, true},
};

// Returns a one-dimensional map of random points over [0,1], without padding or with the stride.
Map random_map(Test& t, GLenum target, int order);
Map random_map(Test& t, GLenum target, int order, int stride);
// The same over [0,1]x[0,1]. For a one-dimensional target, orders.v is ignored, and so is the layout.
Map random_map(Test& t, GLenum target, const Orders& orders);
Map random_map(Test& t, GLenum target, const Orders& orders, int ustride, int vstride);
Map random_map(Test& t, GLenum target, const Orders& orders, const Layout& layout);

template <class T>
std::vector<T> converted(const std::vector<double>& values) {
  std::vector<T> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(static_cast<T>(value));
  return out;
}

// Returns orders above MAX_EVAL_ORDER, MAX_EVAL_ORDER + 1 first. Throws NotObservable if MAX_EVAL_ORDER is
// not answered or is above 65536.
std::vector<int> orders_too_high(const Test& t);

// Returns the name of a token without "GL_", as in "MAP1_VERTEX_3".
std::string label(GLenum token);

// The two forms of a command.
struct Form {
  const char* name;
  bool doubles;
};
inline constexpr Form kForms[] = {{"f", false}, {"d", true}};

// Returns a command of the case that the implementation lacks, if any; see Test::can_call.
std::optional<gl::EntryPoint> missing_command(Test& t, const gl::Case& commands);

// Returns the elements of `all` whose commands the implementation has; `append` appends the commands of an
// element to a case. The others are recorded as not observed. Throws gl::MissingEntryPoint if none is left.
template <class Range, class Append>
auto existing(Test& t, const Range& all, const Append& append) {
  std::vector<std::ranges::range_value_t<Range>> left;
  std::optional<gl::EntryPoint> missing;
  for (const auto& each : all) {
    gl::Case commands;
    append(commands, each);
    if (const auto command = missing_command(t, commands))
      missing = command;
    else
      left.push_back(each);
  }
  if (left.empty() && missing) throw gl::MissingEntryPoint(*missing);
  return left;
}

// Returns the forms of Map that the implementation has, in all of these dimensions.
std::vector<Form> existing_forms(Test& t, std::initializer_list<bool> dimensions = {kCurves, kSurfaces});

// A change to the memory of the points after the call.
struct Treatment {
  const char* name;
  gl::AfterCall after;
};
inline constexpr Treatment kTreatments[] = {{"OVERWRITTEN", gl::AfterCall::kOverwrite},
                                            {"UNMAPPED", gl::AfterCall::kUnmap},
                                            {"PROTECTED", gl::AfterCall::kProtect}};

// A target and a form: "MAP1_VERTEX_3_f".
struct TargetForm {
  std::string name;
  GLenum target;
  bool doubles;
};
std::vector<TargetForm> make_target_forms(std::span<const GLenum> targets);
// The targets without INDEX, whose values are visible in colour-index contexts only.
std::vector<GLenum> without_index(std::span<const GLenum> targets);
// The nine targets of the dimension in both forms, and the eight other than INDEX.
const std::vector<TargetForm>& target_forms(bool two);
const std::vector<TargetForm>& visible_target_forms(bool two);
const std::vector<GLenum>& visible_targets(bool two);
// Returns those of target_forms() whose form of Map the implementation has.
std::vector<TargetForm> existing_target_forms(Test& t, bool two);

// Appends Map1f, Map1d, Map2f or Map2d. `after`: what happens to the memory of the points after the call.
gl::Ref define(gl::Case& c, const Map& map, bool doubles = false, gl::AfterCall after = gl::AfterCall::kKeep);
// The same, but all calls with the same slot pass the same pointer; each call stores its own points there
// first.
gl::Ref define_in_slot(gl::Case& c, const Map& map, bool doubles, int slot);
void define_and_enable(gl::Case& c, const Map& map, bool doubles = false);

// EvalCoord1f or EvalCoord1d.
gl::Ref evaluate(gl::Case& c, double u, bool doubles = false);
// EvalCoord2f or EvalCoord2d.
gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles = false);
// Append EvalCoord (by value, or from an array that ends before an inaccessible page), EvalPoint or EvalMesh
// of the dimension. In one dimension the arguments v and j are ignored.
gl::Ref eval_coord(gl::Case& c, bool two, double u, double v, bool doubles = false);
gl::Ref eval_coord_vector(gl::Case& c, bool two, double u, double v, bool doubles);
gl::Ref eval_point(gl::Case& c, bool two, int i, int j);
gl::Ref eval_mesh(gl::Case& c, bool two, GLenum mode, int i1, int i2, int j1, int j2);

// Targets of maps that together supply all attributes of a vertex: position, colour, normal and texture
// coordinates.
struct Kinds {
  const char* name;
  std::array<GLenum, 4> targets;
};
inline constexpr Kinds kKinds1[] = {
    {"VERTEX_3", {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_3}},
    {"VERTEX_4", {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4}}};
inline constexpr Kinds kKinds2[] = {
    {"VERTEX_3", {GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4, GL_MAP2_NORMAL, GL_MAP2_TEXTURE_COORD_3}},
    {"VERTEX_4", {GL_MAP2_VERTEX_4, GL_MAP2_COLOR_4, GL_MAP2_NORMAL, GL_MAP2_TEXTURE_COORD_4}}};

inline const auto& kinds_of(bool two) { return two ? kKinds2 : kKinds1; }

// Enables the target and, unless it is a vertex map itself, a constant vertex map of its dimension, without
// which evaluation emits no vertices.
void enable_visibly(gl::Case& c, GLenum target);

// --- Arguments -------------------------------------------------------------------------------------------

// u and v of one evaluation.
struct At {
  double u, v;
};

// Returns at least five arguments in the domain, in single precision: both ends, the adjacent floats inside,
// the centre, and random ones up to `count`.
std::vector<double> arguments(Test& t, const Interval& domain, int count);
// Returns `count` pairs of arguments: corners, points of edges, and random interior points, of which the
// first is one.
std::vector<At> arguments(Test& t, const Interval& u, const Interval& v, int count);

// Evaluate at all arguments, between one Begin(POINTS) and End.
void evaluate_all(gl::Case& c, const std::vector<double>& arguments);
void evaluate_all(gl::Case& c, const std::vector<At>& arguments);
// Evaluates in either dimension.
void evaluate_all(gl::Case& c, bool two, const std::vector<At>& arguments, bool doubles = false);

// --- Queries ---------------------------------------------------------------------------------------------

// Appends queries of the state that a rejected command must leave unchanged: enables, orders, domains and
// points of the MAP1 maps, AUTO_NORMAL, both grids, the current colour, normal and texture coordinates, and
// the MAP2 maps. The arrays have room for maps of the highest order. Queries that crash are omitted
// (Test::append_optional).
std::vector<gl::Ref> query_everything(Test& t, gl::Case& c);
void expect_unchanged(CheckedTrace& checked, const std::vector<gl::Ref>& before,
                      const std::vector<gl::Ref>& after);
// Appends the same queries. The test judges whether their answers stay the same (see Test::compare_only).
void take_snapshot(Test& t, gl::Case& c);

// A form of GetMap; `get` appends the query with an array of `room` elements.
struct Getter {
  const char* name;
  gl::Ref (*get)(gl::Case&, GLenum target, GLenum query, std::size_t room);
};
inline constexpr Getter kGetters[] = {
    {"GetMapfv", [](gl::Case& c, GLenum target, GLenum query,
                    std::size_t room) { return c.GetMapfv(target, query, gl::out<GLfloat>(room)); }},
    {"GetMapdv", [](gl::Case& c, GLenum target, GLenum query,
                    std::size_t room) { return c.GetMapdv(target, query, gl::out<GLdouble>(room)); }},
    {"GetMapiv", [](gl::Case& c, GLenum target, GLenum query, std::size_t room) {
       return c.GetMapiv(target, query, gl::out<GLint>(room));
     }}};
// Returns the forms of GetMap that the implementation has.
std::vector<Getter> existing_getters(Test& t);

// Queries of the orders, the domain and the points of one map, through GetMapiv and GetMapfv or GetMapdv.
struct MapQuery {
  gl::Ref order, domain, coefficients;
};
MapQuery query_map(gl::Case& c, GLenum target, int max_order, bool doubles = false);
// The same for a test, with doubles only if the implementation has GetMapdv.
MapQuery query_map(Test& t, gl::Case& c, GLenum target, bool doubles = false);
// Expects the answers to be the map's, to a relative error of 1e-5. `doubles` is that of the call of
// query_map().
void expect_map(CheckedTrace& checked, const MapQuery& query, const Map& map, bool doubles = false);

}  // namespace evalcts
