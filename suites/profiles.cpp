// Section 23 of the requirements: contexts with and without evaluators.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include <evalcts/gl/contexts.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"
#include "rejection.h"

namespace evalcts::suite_profiles {
namespace {

constexpr GLuint kOther = 1;

// Kinds of contexts without evaluators.
constexpr NamedValue<GLuint> kRemoved[] = {{"CORE_PROFILE", EVALCTS_CORE_PROFILE},
                                           {"FORWARD_COMPATIBLE", EVALCTS_FORWARD_COMPATIBLE}};

// Queries of the kind of the context that enter() made current, to be checked after the run.
struct Entered {
  gl::Ref flags, profile;
};

Entered enter(gl::Case& c, GLuint kind) {
  c.ContextOfKindEVALCTS(kOther, kind);
  c.GetError();
  const gl::Ref flags = c.GetIntegerv(GL_CONTEXT_FLAGS, gl::out<GLint>(1));
  const gl::Ref profile = c.GetIntegerv(GL_CONTEXT_PROFILE_MASK, gl::out<GLint>(1));
  c.GetError();  // GL 3.1 has no query of the profile
  return {flags, profile};
}

bool has_bit(const CheckedTrace& checked, gl::Ref query, GLint bit) {
  return checked.trace().written(query) > 0 && (checked.trace().values<GLint>(query)[0] & bit) != 0;
}

void require_removed(const CheckedTrace& checked, const Entered& entered, GLuint kind) {
  const bool is_one = kind == EVALCTS_CORE_PROFILE
                          ? has_bit(checked, entered.profile, GL_CONTEXT_CORE_PROFILE_BIT)
                          : has_bit(checked, entered.flags, GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT);
  if (!is_one) throw NotObservable("the context that was asked for is of another kind");
}

// Returns calls of all evaluator commands except GetMap; they would be legal in a context with evaluators.
std::vector<NamedCalls> commands_without_queries() {
  std::vector<NamedCalls> all = forbidden_in_primitives();
  for (const NamedCalls& command : allowed_in_primitives()) all.push_back(command);
  return all;
}
std::vector<NamedCalls> queries_of_maps() {
  std::vector<NamedCalls> all;
  for (const Getter& getter : kGetters)
    all.push_back({getter.name, [&](gl::Case& c) { getter.get(c, GL_MAP1_VERTEX_3, GL_ORDER, 4); }});
  return all;
}

// A call of a removed command, and the errors of which it has to raise one.
struct Removed {
  Calls call;
  GLenum error, other;
};

// Expects each of the calls to raise one of its errors in a context of the kind. Throws NotObservable if the
// context is of another kind.
void expect_removed(Test& t, GLuint kind, const std::string& identity, const std::vector<Removed>& calls) {
  gl::Case c(identity);
  const Entered entered = enter(c, kind);
  std::vector<gl::Ref> errors;
  for (const Removed& removed : calls) {
    removed.call(c);
    errors.push_back(c.GetError());
  }
  CheckedTrace checked = t.play(c);
  require_removed(checked, entered, kind);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    std::vector<GLenum> allowed = {calls[i].error};
    if (calls[i].other != calls[i].error) allowed.push_back(calls[i].other);
    checked.expect_error(errors[i], allowed);
  }
}
void expect_removed(Test& t, GLuint kind, const std::string& identity, const std::vector<Calls>& calls,
                    GLenum error) {
  std::vector<Removed> removed;
  for (const Calls& call : calls) removed.push_back({call, error, error});
  expect_removed(t, kind, identity, removed);
}

EVALCTS_TEST(Profiles, Commands, kMust, "EV-PROF-CORE-FUNC", combine(kRemoved))
(Test& t, const NamedValue<GLuint>& removed) {
  std::vector<Removed> calls;
  for (const NamedCalls& command : existing_calls(t, commands_without_queries()))
    calls.push_back({command.issue, GL_INVALID_OPERATION, GL_INVALID_OPERATION});
  // Section E.2 of GL 4.6 does not list GetMap, and its targets are not valid enumerants there.
  for (const NamedCalls& query : existing_calls(t, queries_of_maps()))
    calls.push_back({query.issue, GL_INVALID_OPERATION, GL_INVALID_ENUM});
  expect_removed(t, removed.value, "every command of evaluators", calls);
};

EVALCTS_TEST(Profiles, Enables, kMust, "EV-PROF-CORE-ENABLE", combine(kRemoved))
(Test& t, const NamedValue<GLuint>& removed) {
  std::vector<Calls> calls;
  for (const GLenum name : all_caps()) {
    calls.push_back([name](gl::Case& c) { c.Enable(name); });
    calls.push_back([name](gl::Case& c) { c.Disable(name); });
    calls.push_back([name](gl::Case& c) { c.IsEnabled(name); });
  }
  expect_removed(t, removed.value, "Enable, Disable and IsEnabled of every map and of AUTO_NORMAL", calls,
                 GL_INVALID_ENUM);
};

EVALCTS_TEST(Profiles, Gets, kMust, "EV-PROF-CORE-GET", combine(kRemoved))
(Test& t, const NamedValue<GLuint>& removed) {
  std::vector<GLenum> names = all_caps();
  names.insert(names.end(), {GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                             GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS});
  std::vector<Calls> calls;
  for (const GLenum name : names) {
    calls.push_back([name](gl::Case& c) { c.GetBooleanv(name, gl::out<GLboolean>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetIntegerv(name, gl::out<GLint>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetFloatv(name, gl::out<GLfloat>(4)); });
    calls.push_back([name](gl::Case& c) { c.GetDoublev(name, gl::out<GLdouble>(4)); });
  }
  expect_removed(t, removed.value, "every Get of the state of evaluators", calls, GL_INVALID_ENUM);
};

// Judges all commands, maps, enables and queries, and evaluation.
void judge_everything(Test& t) {
  gl::Case c("every command, map, switch and Get");
  for (const GLenum target : all_targets()) {
    define(c, random_map(t, target, {3, 2}));
    c.GetError();
  }
  for (const GLenum name : all_caps()) {
    c.Enable(name);
    c.GetError();
    c.IsEnabled(name);
  }
  std::vector<NamedCalls> commands = commands_without_queries();
  std::ranges::move(queries_of_maps(), std::back_inserter(commands));
  for (const NamedCalls& command : existing_calls(t, commands)) {
    const bool draws = command.name.starts_with("EvalCoord") || command.name.starts_with("EvalPoint");
    if (draws) c.Begin(GL_POINTS);
    command.issue(c);
    if (draws) c.End();
    c.GetError();
  }
  c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
  c.GetError();
  t.judge_answers(c);

  gl::Case drawn("vertices of maps of all kinds");
  for (const GLenum target : kKinds2[1].targets) define_and_enable(drawn, random_map(t, target, {3, 2}));
  evaluate_all(drawn, {{0, 1}, {0.375, 0.625}, {1, 0}});
  t.judge_vertices(drawn, kPosition | kTextureCoordinate0);

  gl::Case meshes("points of meshes and of grids, with automatic normals");
  define_and_enable(meshes, random_map(t, GL_MAP1_VERTEX_3, 3));
  define_and_enable(meshes, random_map(t, GL_MAP1_NORMAL, 2));
  define_and_enable(meshes, random_map(t, GL_MAP2_VERTEX_4, {3, 2}));
  meshes.Enable(GL_AUTO_NORMAL);
  meshes.MapGrid1f(4, 0.0f, 1.0f);
  meshes.MapGrid2f(2, 0.0f, 1.0f, 3, 1.0f, 0.0f);
  meshes.EvalMesh1(GL_POINT, 1, 3);
  meshes.EvalMesh2(GL_POINT, 0, 2, 1, 2);
  meshes.Begin(GL_POINTS);
  meshes.EvalPoint1(2);
  meshes.EvalPoint2(1, 2);
  meshes.End();
  t.judge_vertices(meshes, kPosition | kNormal);
}

EVALCTS_TEST(Profiles, Compatibility, kMust, "EV-PROF-COMPAT")
(Test& t) {
  t.require(3, 1);
  judge_everything(t);
};

// GL 3.0 only: the test above covers later versions.
EVALCTS_TEST(Profiles, Deprecated, kMust, "EV-PROF-DEPRECATED")
(Test& t) {
  t.require(3, 0);
  if (t.gl().at_least(3, 1)) throw NotSupported("a rule of GL 3.0, and this is GL " + t.gl().version);
  judge_everything(t);
};

// In a no-error context legal commands work without an error. (Illegal ones are undefined there.)
EVALCTS_TEST(Profiles, NoError, kMust, "EV-PROF-NOERROR")
(Test& t) {
  gl::Case c("legal commands in a no-error context");
  std::optional<Entered> entered;  // empty if the default context is a no-error context
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
  const MapQuery query = query_map(t, c, curve.target);
  const gl::Ref domain = c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2)),
                enabled = c.IsEnabled(GL_MAP1_VERTEX_4), disabled = c.IsEnabled(GL_MAP2_COLOR_4),
                error = c.GetError();
  CheckedTrace checked = t.play(c);
  if (entered && !has_bit(checked, entered->flags, GL_CONTEXT_FLAG_NO_ERROR_BIT))
    throw NotObservable("the context that was asked for is of another kind");
  expect_map(checked, query, curve);
  checked.expect_values(domain, std::vector<GLfloat>{-1, 3});
  checked.expect_result(enabled, GL_TRUE);
  checked.expect_result(disabled, GL_FALSE);
  checked.expect_no_error(error);
};

}  // namespace
}  // namespace evalcts::suite_profiles
