// Section 21 of the requirements: each context has its own evaluator state. The executable specification has
// one context, so that these tests state what they expect.

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_contexts {
namespace {

// Queries of the same state at two moments, which must have the same answers.
struct Pair {
  std::vector<gl::Ref> before, after;
};

void expect_unchanged(Test& t, gl::Case c, const std::vector<Pair>& pairs) {
  const gl::Ref error = c.GetError();
  CheckedTrace checked = t.play(c);
  checked.expect_no_error(error);
  for (const Pair& pair : pairs) evalcts::expect_unchanged(checked, pair.before, pair.after);
}

// Sets all evaluator state and the current values to something else than their initial values. The two
// variants (0 and 1) differ in the maps and grids.
void set_everything(Test& t, gl::Case& c, int variant) {
  for (const GLenum target : gl::kMap1Targets)
    define_and_enable(c, over(random_map(t, target, 3 + variant), {-1.5 - variant, 1}));
  for (const GLenum target : gl::kMap2Targets)
    define_and_enable(c, over(random_map(t, target, {2 + variant, 4 - variant}), {0, 1}, {0, 7.0 + variant}));
  c.Enable(GL_AUTO_NORMAL);
  c.MapGrid1f(5 + variant, 2.0f, 0.25f);
  c.MapGrid2f(7 + variant, -1.0f, 3.0f, 2, 0.5f, 8.0f);
  c.Color4f(0.25f, 0.5f, 0.75f, 0.5f);
  c.Normal3f(0.6f, 0, 0.8f);
  c.TexCoord4f(4, 3, 2, 5);
}

// A way to make another context current, by its number.
struct Other {
  const char* name;
  gl::Ref (*make_current)(gl::Case&, GLuint);
};
constexpr Other kOthers[] = {
    {"SEPARATE", [](gl::Case& c, GLuint number) { return c.OtherContextEVALCTS(number); }},
    {"SHARING", [](gl::Case& c, GLuint number) { return c.SharingContextEVALCTS(number); }}};

// A new context has the initial state, which the first context had before it was changed.
EVALCTS_TEST(Contexts, Fresh, kMust, "EV-CTX-FRESH", combine(kOthers))
(Test& t, const Other& other) {
  gl::Case c("everything set in the first context, then another one is made");
  const std::vector<gl::Ref> initial = query_everything(t, c);
  set_everything(t, c, 0);
  other.make_current(c, 1);
  const std::vector<gl::Ref> fresh = query_everything(t, c);
  expect_unchanged(t, c, {{initial, fresh}});
};

// Commands in one context do not change the state of another one, whether or not the contexts share objects.
EVALCTS_TEST(Contexts, Private, kMust, "EV-CTX-PRIVATE", combine(kOthers))
(Test& t, const Other& other) {
  gl::Case c("two contexts set in different ways in turn");
  std::vector<Pair> pairs;
  const std::vector<gl::Ref> untouched = query_everything(t, c);
  other.make_current(c, 1);
  set_everything(t, c, 1);
  const std::vector<gl::Ref> second = query_everything(t, c);
  c.OtherContextEVALCTS(0);
  pairs.push_back({untouched, query_everything(t, c)});
  // The enables of the first context differ from those of the other one.
  set_everything(t, c, 0);
  c.Disable(GL_AUTO_NORMAL);
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); i += 2) {
    c.Disable(gl::kMap1Targets[i]);
    c.Disable(gl::kMap2Targets[gl::kMap2Targets.size() - 1 - i]);
  }
  const std::vector<gl::Ref> first = query_everything(t, c);
  c.OtherContextEVALCTS(1);
  pairs.push_back({second, query_everything(t, c)});
  // A third context has the initial state.
  c.OtherContextEVALCTS(2);
  pairs.push_back({untouched, query_everything(t, c)});
  c.OtherContextEVALCTS(0);
  pairs.push_back({first, query_everything(t, c)});
  expect_unchanged(t, c, pairs);
};

// A shared display list defines maps in the context that calls it.
EVALCTS_TEST(Contexts, SharedListDefinesWhereItIsCalled, kMust, "EV-CTX-PRIVATE")
(Test& t) {
  gl::Case c("a list made in one context, called in the other");
  const Map own = random_map(t, GL_MAP1_VERTEX_3, 2), listed = random_map(t, GL_MAP1_VERTEX_3, 4);
  define(c, own);
  c.SharingContextEVALCTS(1);
  c.NewList(9, GL_COMPILE);
  define(c, listed);
  c.MapGrid1f(6, 2.0f, 3.0f);
  c.EndList();
  c.OtherContextEVALCTS(0);
  const gl::Ref shared = c.IsList(9);
  const MapQuery before = query_map(t, c, GL_MAP1_VERTEX_3);
  c.CallList(9);
  const MapQuery after = query_map(t, c, GL_MAP1_VERTEX_3);
  const gl::Ref segments = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  c.OtherContextEVALCTS(1);
  const gl::Ref other_order = c.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLint>(1));
  const gl::Ref other_segments = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  CheckedTrace checked = t.play(c);
  if (checked.trace().result(shared) != GL_TRUE)
    throw NotObservable("the two contexts do not share display lists");
  expect_map(checked, before, own);
  expect_map(checked, after, listed);
  checked.expect_values(segments, std::vector<GLint>{6});
  checked.expect_values(other_order, std::vector<GLint>{1});
  checked.expect_values(other_segments, std::vector<GLint>{1});
};

EVALCTS_TEST(Contexts, Switched, kMust, "EV-CTX-SWITCH", combine(kOthers))
(Test& t, const Other& other) {
  gl::Case c("everything set, another context used, and back");
  set_everything(t, c, 0);
  const std::vector<gl::Ref> before = query_everything(t, c);
  for (int round = 0; round < 3; ++round) {
    other.make_current(c, 1);
    c.Begin(GL_POINTS);
    c.EvalCoord1f(0.5f);
    c.EvalCoord2f(0.5f, 0.25f);
    c.End();
    c.EvalMesh1(GL_LINE, 0, 2);
    c.OtherContextEVALCTS(0);
  }
  const std::vector<gl::Ref> after = query_everything(t, c);
  expect_unchanged(t, c, {{before, after}});
};

// The same evaluation gives the same feedback before and after evaluation in another context.
EVALCTS_TEST(Contexts, EvaluatesAfterSwitch, kMust, "EV-CTX-SWITCH", "EV-CTX-PRIVATE", combine(kOthers))
(Test& t, const Other& other) {
  constexpr std::size_t kRoom = 64;
  gl::Case c("feedback of the same evaluation before and after another context evaluated");
  const auto draw = [&] {
    const gl::Ref buffer = c.FeedbackBuffer(kRoom, GL_3D_COLOR, gl::out<GLfloat>(kRoom));
    c.RenderMode(GL_FEEDBACK);
    c.Begin(GL_POINTS);
    for (const float u : {0.0f, 0.375f, 1.0f}) c.EvalCoord1f(u);
    c.End();
    return std::pair{buffer, c.RenderMode(GL_RENDER)};
  };
  const auto define_all = [&] {
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4})
      define_and_enable(c, random_map(t, target, 4));
  };
  define_all();
  const auto [before, count_before] = draw();
  other.make_current(c, 1);
  define_all();
  c.Disable(GL_MAP1_COLOR_4);
  draw();
  c.OtherContextEVALCTS(0);
  const auto [after, count_after] = draw();
  CheckedTrace checked = t.play(c);
  if (checked.trace().result(count_before) <= 0)
    throw NotObservable("pipeline: nothing comes back in feedback mode");
  checked.expect_same(count_before, count_after);
  checked.expect_same(before, after);
};

// --- glXCopyContext ----------------------------------------------------------------------------------------

constexpr GLuint kCopy = 1;

// Sets all state in the first context and copies the groups of the mask to a new context, kCopy. The first
// context is current afterwards. Throws NotObservable if glXCopyContext does not copy the clear colour
// either.
void set_and_copy(Test& t, gl::Case& c, GLbitfield mask) {
  gl::Case control(gl::control("the clear colour"));
  control.ClearColor(0.25f, 0.5f, 0.75f, 1.0f);
  control.OtherContextEVALCTS(kCopy);
  control.CopyContextEVALCTS(0, kCopy, GL_COLOR_BUFFER_BIT);
  control.OtherContextEVALCTS(kCopy);
  const gl::Ref color = control.GetFloatv(GL_COLOR_CLEAR_VALUE, gl::out<GLfloat>(4));
  const std::vector<GLfloat> expected = {0.25f, 0.5f, 0.75f, 1.0f};
  if (t.play(control).trace().values<GLfloat>(color) != expected)
    throw NotObservable("pipeline: glXCopyContext does not copy the clear colour");
  set_everything(t, c, 0);
  c.OtherContextEVALCTS(kCopy);
  c.CopyContextEVALCTS(0, kCopy, mask);
}

// Appends queries of the state in the group EVAL_BIT.
std::vector<gl::Ref> query_pushable(gl::Case& c) {
  std::vector<gl::Ref> queries;
  for (const GLenum cap : all_caps()) queries.push_back(c.IsEnabled(cap));
  queries.push_back(c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2)));
  queries.push_back(c.GetFloatv(GL_MAP2_GRID_DOMAIN, gl::out<GLfloat>(4)));
  queries.push_back(c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1)));
  queries.push_back(c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2)));
  return queries;
}

EVALCTS_TEST(Contexts, CopyOfEvalBit, kMust, "EV-CTX-COPY")
(Test& t) {
  gl::Case c("EVAL_BIT is copied");
  set_and_copy(t, c, GL_EVAL_BIT);
  const std::vector<gl::Ref> source = query_pushable(c);
  c.OtherContextEVALCTS(kCopy);
  const std::vector<gl::Ref> copy = query_pushable(c);
  expect_unchanged(t, c, {{source, copy}});
};

EVALCTS_TEST(Contexts, CopyHasNoMaps, kMust, "EV-CTX-COPY-NOMAPS")
(Test& t) {
  gl::Case c("ALL_ATTRIB_BITS are copied");
  const auto query_maps = [&] {
    std::vector<gl::Ref> queries;
    for (const GLenum target : all_targets()) {
      queries.push_back(c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2)));
      queries.push_back(c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4)));
      queries.push_back(c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(64)));
    }
    return queries;
  };
  const std::vector<gl::Ref> initial = query_maps();
  set_and_copy(t, c, GL_ALL_ATTRIB_BITS);
  c.OtherContextEVALCTS(kCopy);
  const std::vector<gl::Ref> copied = query_maps();
  expect_unchanged(t, c, {{initial, copied}});
};

}  // namespace
}  // namespace evalcts::suite_contexts
