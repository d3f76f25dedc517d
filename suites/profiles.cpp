// Section 23 of the requirements: contexts with and without evaluators.
#include <fmt/format.h>

#include <optional>

#include <evalcts/gl/contexts.h>
#include <evalcts/testkit/registration.h>
#include "refusal.h"

namespace evalcts::suite_profiles {
namespace {

constexpr GLuint kOther = 1;

// Contexts from which evaluators are removed.
struct Removed {
  const char* name;
  GLuint kind;
};
constexpr Removed kRemoved[] = {{"CORE_PROFILE", EVALCTS_CORE_PROFILE},
                                {"FORWARD_COMPATIBLE", EVALCTS_FORWARD_COMPATIBLE}};

// The case goes on in such a context; `is_one` says afterwards whether it was one.
struct Entered {
  gl::Ref flags, profile;
};

Entered enter(gl::Case& c, GLuint kind) {
  c.ContextOfKindEVALCTS(kOther, kind);
  c.GetError();
  const gl::Ref flags = c.GetIntegerv(GL_CONTEXT_FLAGS, gl::out<GLint>(1));
  const gl::Ref profile = c.GetIntegerv(GL_CONTEXT_PROFILE_MASK, gl::out<GLint>(1));
  c.GetError();  // a context of 3.1 has no profile to ask for
  return {flags, profile};
}

bool has_bit(const Played& played, gl::Ref query, GLint bit) {
  return played.trace().written(query) > 0 && (played.trace().values<GLint>(query)[0] & bit) != 0;
}

void require_removed(const Played& played, const Entered& entered, GLuint kind) {
  const bool is_one = kind == EVALCTS_CORE_PROFILE
                          ? has_bit(played, entered.profile, GL_CONTEXT_CORE_PROFILE_BIT)
                          : has_bit(played, entered.flags, GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT);
  if (!is_one) throw NotObservable("the context that was asked for is of another kind");
}

// All commands of evaluators, legal if evaluators were there.
std::vector<NamedCalls> all_commands() {
  std::vector<NamedCalls> all = forbidden_in_primitives();
#define COMMAND(name, ...) all.push_back({#name, [](gl::Case& c) { c.name(__VA_ARGS__); }})
  COMMAND(EvalCoord1f, 0.5f);
  COMMAND(EvalCoord1d, 0.5);
  COMMAND(EvalCoord1fv, (std::vector<float>{0.5f}));
  COMMAND(EvalCoord1dv, (std::vector<double>{0.5}));
  COMMAND(EvalCoord2f, 0.5f, 0.5f);
  COMMAND(EvalCoord2d, 0.5, 0.5);
  COMMAND(EvalCoord2fv, (std::vector<float>{0.5f, 0.5f}));
  COMMAND(EvalCoord2dv, (std::vector<double>{0.5, 0.5}));
  COMMAND(EvalPoint1, 0);
  COMMAND(EvalPoint2, 0, 0);
  COMMAND(GetMapfv, GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLfloat>(4));
  COMMAND(GetMapdv, GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLdouble>(4));
  COMMAND(GetMapiv, GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLint>(4));
#undef COMMAND
  return all;
}

// What Enable, Disable and IsEnabled took.
std::vector<GLenum> switches() {
  std::vector<GLenum> all(std::begin(gl::kMap1Targets), std::end(gl::kMap1Targets));
  all.insert(all.end(), std::begin(gl::kMap2Targets), std::end(gl::kMap2Targets));
  all.push_back(GL_AUTO_NORMAL);
  return all;
}

// Each of the calls, played in a context of the kind, raises the error.
void expect_removed(Test& t, GLuint kind, const std::string& identity, const std::vector<Calls>& calls,
                    GLenum error) {
  gl::Case c(identity);
  const Entered entered = enter(c, kind);
  std::vector<gl::Ref> errors;
  for (const Calls& call : calls) {
    call(c);
    errors.push_back(c.GetError());
  }
  Played played = t.play(c);
  require_removed(played, entered, kind);
  for (const gl::Ref ref : errors) played.expect_error(ref, {error});
}

EVALCTS_TEST(Profiles, Commands, must, "EV-PROF-CORE-FUNC", combine(kRemoved))
(Test& t, const Removed& removed) {
  std::vector<Calls> calls;
  for (const NamedCalls& command : all_commands()) calls.push_back(command.issue);
  expect_removed(t, removed.kind, "every command of evaluators", calls, GL_INVALID_OPERATION);
};

EVALCTS_TEST(Profiles, Enables, must, "EV-PROF-CORE-ENABLE", combine(kRemoved))
(Test& t, const Removed& removed) {
  std::vector<Calls> calls;
  for (const GLenum name : switches()) {
    calls.push_back([name](gl::Case& c) { c.Enable(name); });
    calls.push_back([name](gl::Case& c) { c.Disable(name); });
    calls.push_back([name](gl::Case& c) { c.IsEnabled(name); });
  }
  expect_removed(t, removed.kind, "Enable, Disable and IsEnabled of every map and of AUTO_NORMAL", calls,
                 GL_INVALID_ENUM);
};

EVALCTS_TEST(Profiles, Gets, must, "EV-PROF-CORE-GET", combine(kRemoved))
(Test& t, const Removed& removed) {
  std::vector<GLenum> names = switches();
  names.insert(names.end(), {GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                             GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS});
  std::vector<Calls> calls;
  for (const GLenum name : names) {
    calls.push_back([name](gl::Case& c) { c.GetBooleanv(name, gl::out<GLboolean>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetIntegerv(name, gl::out<GLint>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetFloatv(name, gl::out<GLfloat>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetDoublev(name, gl::out<GLdouble>(4)); });
  }
  expect_removed(t, removed.kind, "every Get of the state of evaluators", calls, GL_INVALID_ENUM);
};

// Every command, map, switch and Get is there, and all maps together give a vertex.
void expect_everything(Test& t) {
  gl::Case c("every command, map, switch and Get");
  std::vector<gl::Ref> errors;
  const auto step = [&](const Calls& calls) {
    calls(c);
    errors.push_back(c.GetError());
  };
  for (const GLenum target : gl::kMap1Targets)
    step([&](gl::Case& d) { define(d, random_map(t, target, 3)); });
  for (const GLenum target : gl::kMap2Targets)
    step([&](gl::Case& d) { define(d, random_map(t, target, {3, 2})); });
  std::vector<gl::Ref> enabled;
  for (const GLenum name : switches()) {
    step([&](gl::Case& d) { d.Enable(name); });
    enabled.push_back(c.IsEnabled(name));
  }
  for (const NamedCalls& command : all_commands()) {
    const bool draws = command.name.starts_with("EvalCoord") || command.name.starts_with("EvalPoint");
    if (draws) c.Begin(GL_POINTS);
    command.issue(c);
    if (draws) c.End();
    errors.push_back(c.GetError());
  }
  const gl::Ref order = c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
  errors.push_back(c.GetError());
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_no_error(error);
  for (const gl::Ref query : enabled) played.expect_result(query, GL_TRUE);
  played.expect(played.trace().values<GLint>(order)[0] >= 8, order, "MAX_EVAL_ORDER is less than 8",
                "8 or more", fmt::format("{}", played.trace().values<GLint>(order)[0]));

  gl::Case drawn("vertices of maps of all kinds");
  for (const GLenum target : kKinds2[1].targets) {
    define(drawn, random_map(t, target, {3, 2}));
    drawn.Enable(target);
  }
  drawn.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.375f, 1.0f}) drawn.EvalCoord2f(u, 1 - u);
  drawn.End();
  t.expect_emission(drawn, kPosition | kTextureCoordinate0);

  gl::Case meshes("points of meshes and of grids, with automatic normals");
  define(meshes, random_map(t, GL_MAP1_VERTEX_3, 3));
  meshes.Enable(GL_MAP1_VERTEX_3);
  define(meshes, random_map(t, GL_MAP1_NORMAL, 2));
  meshes.Enable(GL_MAP1_NORMAL);
  define(meshes, random_map(t, GL_MAP2_VERTEX_4, {3, 2}));
  meshes.Enable(GL_MAP2_VERTEX_4);
  meshes.Enable(GL_AUTO_NORMAL);
  meshes.MapGrid1f(4, 0.0f, 1.0f);
  meshes.MapGrid2f(2, 0.0f, 1.0f, 3, 1.0f, 0.0f);
  meshes.EvalMesh1(GL_POINT, 1, 3);
  meshes.EvalMesh2(GL_POINT, 0, 2, 1, 2);
  meshes.Begin(GL_POINTS);
  meshes.EvalPoint1(2);
  meshes.EvalPoint2(1, 2);
  meshes.End();
  t.expect_emission(meshes, kPosition | kNormal);
}

EVALCTS_TEST(Profiles, Compatibility, must, "EV-PROF-COMPAT")
(Test& t) {
  t.require(3, 1);
  expect_everything(t);
};

// A later version is for the test before.
EVALCTS_TEST(Profiles, Deprecated, must, "EV-PROF-DEPRECATED")
(Test& t) {
  t.require(3, 0);
  if (t.gl().at_least(3, 1)) throw NotSupported("a rule of GL 3.0, and this is GL " + t.gl().version);
  expect_everything(t);
};

// What is legal works, and GetError has nothing to say. (What is not legal is undefined there.)
EVALCTS_TEST(Profiles, NoError, must, "EV-PROF-NOERROR")
(Test& t) {
  gl::Case c("legal commands in a no-error context");
  std::optional<Entered> entered;  // the usual context may be one itself
  if (!t.gl().no_error) entered = enter(c, EVALCTS_NO_ERROR);
  const Map curve = random_map(t, GL_MAP1_VERTEX_4, 5);
  const Map net = random_map(t, GL_MAP2_COLOR_4, {3, 2});
  define(c, curve);
  define(c, net);
  c.Enable(GL_MAP1_VERTEX_4);
  c.MapGrid1f(4, -1.0f, 3.0f);
  c.EvalMesh1(GL_LINE, 0, 4);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.EvalPoint1(3);
  c.End();
  const MapQuery curve_query = query_map(c, GL_MAP1_VERTEX_4, t.max_order());
  const gl::Ref grid = c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
  const gl::Ref on = c.IsEnabled(GL_MAP1_VERTEX_4), off = c.IsEnabled(GL_MAP2_COLOR_4);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  if (entered && !has_bit(played, entered->flags, GL_CONTEXT_FLAG_NO_ERROR_BIT))
    throw NotObservable("the context that was asked for is of another kind");
  expect_map(played, curve_query, curve);
  played.expect_values<float>(grid, {-1, 3});
  played.expect_result(on, GL_TRUE);
  played.expect_result(off, GL_FALSE);
  played.expect_no_error(error);
};

}  // namespace
}  // namespace evalcts::suite_profiles
