// Section 21 of the requirements, in several threads: contexts of their own, at once, and a context that
// moves.
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "fixtures.h"
#include "grid_cases.h"
#include "maps.h"

namespace evalcts::suite_threads {
namespace {

// Defines random maps and a grid, and sets the current values, which Mesa changes by evaluation.
void define_all(Test& t, gl::Case& c, bool two) {
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), {4, 3}));
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_TEXTURE_COORD_2), {3, 2}));
  map_grid(c, two, {3, 0, 1}, {2, 0.25f, 1});
  set_current_values(c);
}

// Draws points by EvalCoord, EvalPoint and EvalMesh.
void draw(gl::Case& c, bool two) {
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.375, 1.0}) eval_coord(c, two, u, 0.625);
  eval_point(c, two, 2, 1);
  c.End();
  eval_mesh(c, two, GL_POINT, 0, 3, 0, 2);
}

gl::Case drawing(Test& t, bool two, const char* identity, int repetitions) {
  gl::Case c(identity);
  for (int i = 0; i < repetitions; ++i) {
    define_all(t, c, two);
    draw(c, two);
  }
  return c;
}

// A library may have no current context in another thread: what it draws there without evaluators is lost,
// too.
EVALCTS_TEST_PAIR(Contexts.InThread, Contexts.InThread2, kMust,
                  decide("EV-CTX-THREAD/1-D", "EV-CTX-THREAD/2-D"))
(Test& t, bool two) {
  const gl::Case c = drawing(t, two, "a context of a second thread", 1);
  t.run_in_thread([&] { t.judge(c); });
};

EVALCTS_TEST_PAIR(Contexts.MovedToThread, Contexts.MovedToThread2, kMust,
                  decide("EV-CTX-THREAD/1-D", "EV-CTX-THREAD/2-D"))
(Test& t, bool two) {
  constexpr int kFirst = 0, kSecond = 1;
  gl::Case control(gl::control("the current colour in a context that moves"));
  control.Color4f(0.25f, 0.5f, 0.75f, 0.5f);
  control.MoveToThreadEVALCTS(kSecond);
  const gl::Ref color = control.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
  if (t.play(control).trace().values<GLfloat>(color) != std::vector<GLfloat>{0.25f, 0.5f, 0.75f, 0.5f})
    throw NotObservable("pipeline: a context that moves to another thread loses its current colour");

  gl::Case c("everything set, a context moves to a second thread and back");
  c.Enable(GL_AUTO_NORMAL);
  define_all(t, c, two);
  take_snapshot(t, c);
  c.MoveToThreadEVALCTS(kSecond);
  take_snapshot(t, c);
  draw(c, two);
  define_all(t, c, two);
  take_snapshot(t, c);
  c.MoveToThreadEVALCTS(kFirst);
  take_snapshot(t, c);
  draw(c, two);
  t.judge(c);
};

// The judged context is that of the first thread, and then that of a second one. Libraries that die when two
// threads draw explicit vertices do so in the control.
EVALCTS_TEST_PAIR(Contexts.BesideThread, Contexts.BesideThread2, kMust,
                  decide("EV-CTX-THREAD/1-D", "EV-CTX-THREAD/2-D"))
(Test& t, bool two) {
  constexpr int kRepetitions = 40;
  const int times = t.by_depth(1, 4, 16);
  const gl::Case other = drawing(t, two, "another thread evaluates", kRepetitions);
  const gl::Case first = drawing(t, two, "the first thread, while a second one evaluates", kRepetitions);
  const gl::Case second = drawing(t, two, "a second thread, while a third one evaluates", kRepetitions);
  const auto repeat = [&](const auto& body) {
    for (int i = 0; i < times; ++i) body();
  };
  const gl::Case explicit_vertices = gl::with_explicit_vertices(other);
  gl::Case control(gl::control("explicit vertices, while another thread draws some"));
  for (const gl::Command& command : explicit_vertices.commands()) control.add(command);
  t.run_beside(explicit_vertices, [&] { repeat([&] { t.play(control); }); });
  const auto judge_beside = [&](const gl::Case& c) {
    t.run_beside(other, [&] { repeat([&] { t.judge(c); }); });
  };
  judge_beside(first);
  t.run_in_thread([&] { judge_beside(second); });
};

}  // namespace
}  // namespace evalcts::suite_threads
