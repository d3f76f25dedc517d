// One-dimensional maps for tests: how they are made, defined and shown.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "suites/fixtures.h"

namespace evalcts {

// A map as Map1 is given it: `order` control points, `stride` values apart, each block whole (order*stride
// values), so that nothing behind the last point is ever out of bounds (U-TAIL).
struct Map1 {
  GLenum target = GL_MAP1_VERTEX_3;
  double u1 = 0, u2 = 1;
  int stride = 3, order = 1;
  std::vector<double> points;

  int components() const { return gl::components_of(target); }
  // The control points packed, as GetMap returns them.
  std::vector<double> coefficients() const;
};

// What the padding between two control points holds in all tests: a value that spoils whatever reads it.
inline constexpr double kPoison = 1e30;

// `coefficients` (packed, order*k of them) laid out with the stride; padding is poisoned.
Map1 make_map1(GLenum target, double u1, double u2, int stride, const std::vector<double>& coefficients);
// Tightly packed over [0,1].
Map1 make_map1(GLenum target, const std::vector<double>& coefficients);

// `count` numbers in [-1,1], exactly representable in single precision.
std::vector<double> random_values(std::mt19937& random, std::size_t count);

// A map over [0,1] with random points, tightly packed or with the stride.
Map1 random_map(Test& t, GLenum target, int order);
Map1 random_map(Test& t, GLenum target, int order, int stride);

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

// What becomes of the points after the call.
struct Fate {
  const char* name;
  gl::AfterCall after;
};
inline constexpr Fate kFates[] = {{"OVERWRITTEN", gl::AfterCall::overwrite},
                                  {"UNMAPPED", gl::AfterCall::unmap},
                                  {"PROTECTED", gl::AfterCall::protect}};

// A target and a form: "MAP1_VERTEX_3_f".
struct TargetForm {
  std::string name;
  GLenum target;
  bool doubles;
};
std::vector<TargetForm> make_target_forms(std::span<const GLenum> targets);
// The targets of one dimension but its INDEX.
std::vector<GLenum> without_index(std::span<const GLenum> targets);
// All nine MAP1 targets, or the eight whose values show (INDEX shows in colour-index contexts only).
const std::vector<TargetForm>& target_forms();
const std::vector<TargetForm>& visible_target_forms();
const std::vector<GLenum>& visible_targets();

// Map1f or Map1d.
gl::Ref define(gl::Case& c, const Map1& map, bool doubles = false, gl::AfterCall after = gl::AfterCall::keep);
// EvalCoord1f or EvalCoord1d.
gl::Ref evaluate(gl::Case& c, double u, bool doubles = false);

// EvalCoord1fv or EvalCoord1dv; the array ends before an inaccessible page.
gl::Ref evaluate_vector(gl::Case& c, double u, bool doubles);

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

// Enables the target and, where it gives no vertex itself, a constant vertex map of its dimension
// as its carrier.
void enable_visibly(gl::Case& c, GLenum target);

// Everything that a failing command must leave alone: order, domain and points of all 18 maps, their enables,
// AUTO_NORMAL, the grids, the current values and the active texture unit, the MAP2 maps last. Room for what a
// wrong implementation might write is allowed for.
std::vector<gl::Ref> query_everything(gl::Case& c, int max_order);
void expect_unchanged(Played& played, const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after);

// Control points that give the same memory to every call with this slot, with the contents of the moment.
gl::Ref define_in_slot(gl::Case& c, const Map1& map, bool doubles, int slot);

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

// Order, domain and points of one map, through GetMapfv or GetMapdv.
struct MapQuery {
  gl::Ref order, domain, coefficients;
};
MapQuery query_map1(gl::Case& c, GLenum target, int max_order, bool doubles = false);
// ... are those of this map, to single precision where it was given in doubles.
void expect_map1(Played& played, const MapQuery& query, const Map1& map, bool doubles = false);
// The same for either dimension, by what each query has to answer.
void expect_answers(Played& played, const MapQuery& query, const std::vector<GLint>& order,
                    const std::vector<double>& domain, const std::vector<double>& coefficients, bool doubles);

}  // namespace evalcts
