// Section 22 of the requirements, query objects: evaluated primitives are counted like explicit ones, and
// conditional rendering discards them.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "drawings.h"
#include "programs.h"

namespace evalcts::suite_queries_of_primitives {
namespace {

// --- Counts ----------------------------------------------------------------------------------------------

struct Counted {
  CheckedTrace checked;
  std::vector<gl::Ref> queries;

  GLuint count(std::size_t i) const { return checked.trace().values<GLuint>(queries[i])[0]; }
};

Counted count(Test& t, const gl::Identity& identity, GLenum target, const std::vector<Scene>& scenes) {
  gl::Case c(identity);
  c.Viewport(0, 0, kSide, kSide);
  std::vector<gl::Ref> queries;
  for (const Scene& scene : scenes) {
    const gl::ResultOf query = make_query(c);
    c.BeginQuery(target, query);
    c.append(scene.commands);
    c.EndQuery(target);
    queries.push_back(c.GetQueryObjectuiv(query, GL_QUERY_RESULT, gl::out<GLuint>(1)));
  }
  return {t.play(c), queries};
}

void expect_counted_like_explicit(Test& t, GLenum target, const std::vector<Drawing>& drawings) {
  // The last scene draws nothing.
  std::vector<Scene> vertices = scenes_of(drawings, false), evaluated = scenes_of(drawings, true);
  gl::Case empty;
  define_curve(empty);
  define_patch(empty);
  empty.EvalMesh1(GL_LINE, 3, 2);
  empty.EvalMesh2(GL_FILL, 0, kColumns, 1, 0);
  vertices.emplace_back("nothing", gl::Case());
  evaluated.emplace_back("meshes of empty ranges", empty);
  const Counted control = count(t, gl::control("explicit vertices"), target, vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if ((control.count(i) == 0) != (i == drawings.size()))
      throw NotObservable("pipeline: explicit vertices are not counted");
  Counted counted = count(t, "evaluated", target, evaluated);
  for (std::size_t i = 0; i < evaluated.size(); ++i)
    counted.checked.expect(counted.count(i) == control.count(i), counted.queries[i],
                           fmt::format("{}: {} are counted, of explicit vertices {}", evaluated[i].name,
                                       counted.count(i), control.count(i)),
                           std::to_string(control.count(i)), std::to_string(counted.count(i)));
}

EVALCTS_TEST(Pipeline, SamplesPassed, kMust, "EV-PIPE-QUERY")
(Test& t) {
  t.require(1, 5, "GL_ARB_occlusion_query");
  expect_counted_like_explicit(t, GL_SAMPLES_PASSED, all_drawings(t));
};

EVALCTS_TEST(Pipeline, PrimitivesGenerated, kMust, "EV-PIPE-PRIMGEN", combine(kMeshKinds))
(Test& t, const MeshKind& kind) {
  t.require(3, 0);
  expect_counted_like_explicit(t, GL_PRIMITIVES_GENERATED, meshes_of(t, kind));
};

// --- Conditional rendering -------------------------------------------------------------------------------

// ReadPixels after each drawing in conditional rendering, by a query without and by one with passed samples.
struct Conditional {
  CheckedTrace checked;
  std::vector<gl::Ref> failed, passed;

  std::size_t lit(gl::Ref read) const { return count_lit(checked, read); }
};

Conditional render(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes) {
  gl::Case c(identity);
  c.Viewport(0, 0, kSide, kSide);
  c.ClearColor(0, 0, 0, 0);
  const gl::ResultOf failing = make_query(c), passing = make_query(c);
  c.BeginQuery(GL_SAMPLES_PASSED, failing);
  c.EndQuery(GL_SAMPLES_PASSED);
  c.BeginQuery(GL_SAMPLES_PASSED, passing);
  c.Begin(GL_TRIANGLES);
  c.Vertex2f(-1, -1);
  c.Vertex2f(1, -1);
  c.Vertex2f(0, 1);
  c.End();
  c.EndQuery(GL_SAMPLES_PASSED);
  std::vector<gl::Ref> failed, passed;
  for (const Scene& scene : scenes)
    for (const bool passes : {false, true}) {
      c.Clear(GL_COLOR_BUFFER_BIT);
      c.BeginConditionalRender(passes ? passing : failing, GL_QUERY_WAIT);
      c.append(scene.commands);
      c.EndConditionalRender();
      (passes ? passed : failed)
          .push_back(c.ReadPixels(0, 0, kSide, kSide, GL_RED, GL_FLOAT, gl::out<GLfloat>(kSide * kSide)));
    }
  return {t.play(c), failed, passed};
}

void expect_discarded(Test& t, const std::vector<Drawing>& drawings) {
  const Conditional control = render(t, gl::control("explicit vertices"), scenes_of(drawings, false));
  for (std::size_t i = 0; i < drawings.size(); ++i)
    if (control.lit(control.failed[i]) > 0 || control.lit(control.passed[i]) == 0)
      throw NotObservable(
          "pipeline: explicit vertices are not discarded, or are discarded regardless of the query");
  const std::vector<Scene> scenes = scenes_of(drawings, true);
  Conditional evaluated = render(t, "evaluated", scenes);
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    const std::size_t lit = evaluated.lit(evaluated.failed[i]);
    evaluated.checked.expect(
        lit == 0, evaluated.failed[i],
        fmt::format("{}: {} pixels are drawn, though no sample passed", scenes[i].name, lit), "no pixel",
        fmt::format("{} pixels", lit));
    evaluated.checked.expect(evaluated.lit(evaluated.passed[i]) > 0, evaluated.passed[i],
                             fmt::format("{}: nothing is drawn, though samples passed", scenes[i].name),
                             "some pixels", "no pixel");
  }
}

EVALCTS_TEST(Pipeline, ConditionalMeshes, kMust, "EV-PIPE-CONDRENDER")
(Test& t) {
  t.require(3, 0, "GL_NV_conditional_render");
  expect_discarded(t, meshes(t));
};

EVALCTS_TEST(Pipeline, ConditionalPrimitives, kMust, "EV-PIPE-CONDRENDER-COORD")
(Test& t) {
  t.require(3, 0);
  expect_discarded(t, primitives(t));
};

}  // namespace
}  // namespace evalcts::suite_queries_of_primitives
