// One- and two-dimensional maps for tests: how they are made, laid out in memory, defined, shown and queried.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fixtures.h"

namespace evalcts {

// For functions and parameters that take either dimension.
inline constexpr bool kCurves = false, kSurfaces = true;
bool is_two_dimensional(GLenum target);
// The target of one dimension, or its namesake of two.
GLenum target_in(bool two, GLenum map1_target);
// The nine targets of one dimension.
std::span<const GLenum> targets(bool two);
// The 18 targets, those of one dimension first.
const std::vector<GLenum>& all_targets();
// The 18 targets and AUTO_NORMAL: everything that Enable takes.
const std::vector<GLenum>& all_caps();

struct Orders {
  int u, v = 1;
  friend bool operator==(const Orders&, const Orders&) = default;
};

// The domain of a map in one direction.
struct Interval {
  double first, last;
};

// A map as Map1 or Map2 is given it: R_ij begins ustride*i + vstride*j values after the first. In one
// dimension vorder is 1, and Map1 is given what is of u. The memory ends with the whole block of the last
// point, the smaller stride, so that nothing legal is out of bounds (U-TAIL).
struct Map {
  GLenum target = GL_MAP1_VERTEX_3;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  int ustride = 3, vstride = 3, uorder = 1, vorder = 1;
  std::vector<double> points;
  bool two = is_two_dimensional(target);

  int components() const { return gl::components_of(target); }
  // The control points (v fastest), the orders and the domain as GetMap returns them.
  std::vector<double> coefficients() const;
  std::vector<GLint> orders() const;
  std::vector<double> domain() const;
};

// The padding between two control points in all tests: a value that spoils any result that it enters.
inline constexpr double kPoison = 1e30;

// `coefficients` (packed, order*k of them) laid out with the stride; padding is poisoned.
Map make_map1(GLenum target, double u1, double u2, int stride, const std::vector<double>& coefficients);
// Tightly packed over [0,1].
Map make_map1(GLenum target, const std::vector<double>& coefficients);
// `coefficients` (packed, v fastest, uorder*vorder*k of them) over [0,1]x[0,1], laid out with the strides;
// padding is poisoned. Where the strides make points share memory, the last one written stays:
// Map::coefficients() says what the map then is.
Map make_map2(GLenum target, int uorder, int vorder, int ustride, int vstride,
              const std::vector<double>& coefficients);
// Tightly packed, v fastest.
Map make_map2(GLenum target, int uorder, int vorder, const std::vector<double>& coefficients);

// The map with another domain.
Map over(Map map, const Interval& u);
Map over(Map map, const Interval& u, const Interval& v);

// `count` numbers in [-1,1], exactly representable in single precision.
std::vector<double> random_values(std::mt19937& random, std::size_t count);

// Layouts of control points in memory: the strides by k and the orders.
struct Layout {
  const char* name;
  int (*ustride)(int k, int uorder, int vorder);
  int (*vstride)(int k, int uorder, int vorder);
  bool shared;  // points share memory
};
inline constexpr Layout kLayouts[] = {
    {"U_MAJOR", [](int k, int, int vorder) { return k * vorder; }, [](int k, int, int) { return k; }, false},
    {"V_MAJOR", [](int k, int, int) { return k; }, [](int k, int uorder, int) { return k * uorder; }, false},
    // One attribute of several, in rows that are longer than the net.
    {"EMBEDDED_U_MAJOR", [](int k, int, int vorder) { return (k + 5) * (vorder + 2); },
     [](int k, int, int) { return k + 5; }, false},
    {"EMBEDDED_V_MAJOR", [](int k, int, int) { return k + 3; },
     [](int k, int uorder, int) { return (k + 3) * (uorder + 1) + 1; }, false},
    {"EQUAL_STRIDES", [](int k, int, int) { return k; }, [](int k, int, int) { return k; }, true},
    {"EQUAL_PADDED_STRIDES", [](int k, int, int) { return k + 2; }, [](int k, int, int) { return k + 2; },
     true},
    {"OVERLAPPING_POINTS", [](int k, int, int) { return k + 1; }, [](int k, int, int) { return k; }, true},
};

// Random points over [0,1], tightly packed or with the stride.
Map random_map(Test& t, GLenum target, int order);
Map random_map(Test& t, GLenum target, int order, int stride);
// The same over [0,1]x[0,1]. Of a target of one dimension, the map has the order of u.
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

// Orders above MAX_EVAL_ORDER, MAX+1 first. Throws NotObservable where the implementation claims to take any.
std::vector<int> orders_too_high(const Test& t);

// "MAP1_VERTEX_3"
std::string label(GLenum token);

// The two forms of a command.
struct Form {
  const char* name;
  bool doubles;
};
inline constexpr Form kForms[] = {{"f", false}, {"d", true}};

// Fates of the points after the call.
struct Fate {
  const char* name;
  gl::AfterCall after;
};
inline constexpr Fate kFates[] = {{"OVERWRITTEN", gl::AfterCall::kOverwrite},
                                  {"UNMAPPED", gl::AfterCall::kUnmap},
                                  {"PROTECTED", gl::AfterCall::kProtect}};

// A target and a form: "MAP1_VERTEX_3_f".
struct TargetForm {
  std::string name;
  GLenum target;
  bool doubles;
};
std::vector<TargetForm> make_target_forms(std::span<const GLenum> targets);
// The targets but INDEX, which shows in colour-index contexts only.
std::vector<GLenum> without_index(std::span<const GLenum> targets);
// The nine targets of one dimension in both forms, and the eight whose values show.
const std::vector<TargetForm>& target_forms(bool two);
const std::vector<TargetForm>& visible_target_forms(bool two);
const std::vector<GLenum>& visible_targets(bool two);

// Map1f or Map1d, Map2f or Map2d.
gl::Ref define(gl::Case& c, const Map& map, bool doubles = false, gl::AfterCall after = gl::AfterCall::kKeep);
// The control points have the same memory in every call with this slot, with the contents of the moment.
gl::Ref define_in_slot(gl::Case& c, const Map& map, bool doubles, int slot);
void define_and_enable(gl::Case& c, const Map& map, bool doubles = false);

// EvalCoord1f or EvalCoord1d.
gl::Ref evaluate(gl::Case& c, double u, bool doubles = false);
// EvalCoord2f or EvalCoord2d.
gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles = false);
// Commands of one dimension, given what is of u or i, or of two: EvalCoord (by value, or from an array that
// ends before an inaccessible page), EvalPoint and EvalMesh.
gl::Ref eval_coord(gl::Case& c, bool two, double u, double v, bool doubles = false);
gl::Ref eval_coord_vector(gl::Case& c, bool two, double u, double v, bool doubles);
gl::Ref eval_point(gl::Case& c, bool two, int i, int j);
gl::Ref eval_mesh(gl::Case& c, bool two, GLenum mode, int i1, int i2, int j1, int j2);

// Maps of all kinds of data that go into one vertex: each attribute has a map of its own.
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

// Enables the target and, where it gives no vertex itself, a constant vertex map of its dimension
// as its carrier.
void enable_visibly(gl::Case& c, GLenum target);

// --- Arguments -------------------------------------------------------------------------------------------

// u and v of one evaluation.
struct At {
  double u, v;
};

// Points: the ends, the numbers next to them, and values in between.
std::vector<double> arguments(Test& t, const Interval& domain, int count);
// Corners, edges and points inside; the first is always inside.
std::vector<At> arguments(Test& t, const Interval& u, const Interval& v, int count);

// Evaluates at all arguments, in one primitive of points.
void evaluate_all(gl::Case& c, const std::vector<double>& arguments);
void evaluate_all(gl::Case& c, const std::vector<At>& arguments);
// Evaluates in either dimension.
void evaluate_all(gl::Case& c, bool two, const std::vector<At>& arguments, bool doubles = false);

// --- Queries ---------------------------------------------------------------------------------------------

// Everything that a failing command must leave alone: order, domain and points of all 18 maps, their enables,
// AUTO_NORMAL, the grids, the current values and the active texture unit, the MAP2 maps last. Room for what a
// wrong implementation might write is allowed for. Queries that crash are left out (Test::append_optional).
std::vector<gl::Ref> query_everything(Test& t, gl::Case& c);
void expect_unchanged(Played& played, const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after);

// One of the three forms; `room` elements to write to.
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

// Orders, domain and points of one map, through GetMapfv or GetMapdv.
struct MapQuery {
  gl::Ref order, domain, coefficients;
};
MapQuery query_map(gl::Case& c, GLenum target, int max_order, bool doubles = false);
// The answers are those of the map, to single precision where it was given in doubles.
void expect_map(Played& played, const MapQuery& query, const Map& map, bool doubles = false);

}  // namespace evalcts
