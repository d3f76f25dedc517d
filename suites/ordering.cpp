// Section 19 of the requirements: the evaluator commands that are allowed between Begin and End, and the
// order of commands: each one takes effect on all later commands and on no earlier one.

#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "drawings.h"
#include "rejection.h"

namespace evalcts::suite_ordering {
namespace {

// Returns forbidden_in_primitives(), and enables and queries.
std::vector<NamedCalls> forbidden() {
  std::vector<NamedCalls> all = forbidden_in_primitives();
  all.push_back({"Enable_MAP1", [](gl::Case& c) { c.Enable(GL_MAP1_COLOR_4); }});
  all.push_back({"Enable_MAP2", [](gl::Case& c) { c.Enable(GL_MAP2_COLOR_4); }});
  all.push_back({"Enable_AUTO_NORMAL", [](gl::Case& c) { c.Enable(GL_AUTO_NORMAL); }});
  all.push_back({"Disable_MAP1", [](gl::Case& c) { c.Disable(GL_MAP1_VERTEX_3); }});
  all.push_back({"Disable_MAP2", [](gl::Case& c) { c.Disable(GL_MAP2_VERTEX_3); }});
  all.push_back({"IsEnabled", [](gl::Case& c) { c.IsEnabled(GL_MAP1_VERTEX_3); }});
  all.push_back(
      {"GetMapfv", [](gl::Case& c) { c.GetMapfv(GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLfloat>(1)); }});
  all.push_back(
      {"GetMapdv", [](gl::Case& c) { c.GetMapdv(GL_MAP2_VERTEX_3, GL_DOMAIN, gl::out<GLdouble>(4)); }});
  all.push_back({"GetMapiv", [](gl::Case& c) { c.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, gl::out<GLint>(1)); }});
  return all;
}

// Defines and enables vertex maps of both dimensions, and sets the grids.
void enable_vertices(Test& t, gl::Case& c) {
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  define(c, random_map(t, GL_MAP2_VERTEX_3, {2, 3}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid1f(2, 0, 1);
  c.MapGrid2f(2, 0, 1, 3, 0, 1);
}

constexpr GLenum kModes[] = {GL_POINTS,         GL_LINES,        GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLES,
                             GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS,     GL_QUAD_STRIP, GL_POLYGON};

EVALCTS_TEST(Ordering, AllowedInPrimitives, kMust, "EV-BE-ALLOWED", combine(allowed_in_primitives()))
(Test& t, const NamedCalls& command) {
  gl::Case c("in every primitive");
  enable_vertices(t, c);
  for (const GLenum mode : kModes) {
    c.Begin(mode);
    for (int i = 0; i < 4; ++i) command.issue(c);
    c.End();
    c.GetError();
  }
  t.judge_answers(c);
};

EVALCTS_TEST(Ordering, ForbiddenInPrimitives, kMust, "EV-BE-ALLOWED", "EV-BE-IGNORED",
             combine(forbidden()).by(gl::list_deliveries()))
(Test& t, const NamedCalls& command) {
  gl::Case c("between two points of a primitive");
  enable_vertices(t, c);
  take_snapshot(t, c);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  command.issue(c);
  c.EvalCoord1f(0.75f);
  c.End();
  c.GetError();
  c.GetError();
  take_snapshot(t, c);
  t.judge_answers(c);
  t.judge_vertices(c, kPosition);
};

// --- Order -----------------------------------------------------------------------------------------------

constexpr std::string_view kAnotherGrid = "another grid";

// A change of state before a drawing.
struct Step {
  std::string_view name;
  Calls change;
  bool of_pipeline = false;
};

const std::vector<float> kSmall = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.125f, 0, 0, 1};
const std::vector<float> kMoved = {0.5f, 0, 0, 0, 0, -0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0.25f, 0, 1};

// Defines a vertex map whose x and y cover [-0.75,0.75], multiplied by `sign`.
void define_vertices(gl::Case& c, bool two, double sign) {
  const double a = 0.75 * sign;
  define(c, two ? make_map2(GL_MAP2_VERTEX_3, 2, 2, {-a, -a, 0, a, -0.5 * a, 0, -0.5 * a, a, 0.25, a, a, 0.5})
                : make_map1(GL_MAP1_VERTEX_3, {-a, -a, 0, 0.5 * a, -a, 0.25, a, a, 0.5}));
}
void define_colors(gl::Case& c, bool two, double red) {
  const std::vector<double> ends = {red, 0, 0.5, 1, 1 - red, 1, 0.5, 1};
  define(c, two ? make_map2(GL_MAP2_COLOR_4, 1, 2, ends) : make_map1(GL_MAP1_COLOR_4, ends));
}

std::vector<Step> steps(bool two) {
  return {{"as it begins",
           [=](gl::Case& c) {
             define_vertices(c, two, 1);
             define_colors(c, two, 1);
             c.Enable(target_in(two, GL_MAP1_VERTEX_3));
             c.Enable(target_in(two, GL_MAP1_COLOR_4));
             map_grid(c, two, {two ? 2 : 3, 0, 1}, {1, 0, 1});
           }},
          {"another matrix", [](gl::Case& c) { c.LoadMatrixf(kSmall); }, true},
          {"another vertex map", [=](gl::Case& c) { define_vertices(c, two, -0.75); }},
          {"another colour map", [=](gl::Case& c) { define_colors(c, two, 0); }},
          // Sets the current colour again: other tests judge whether evaluation keeps it (section 11).
          {"no colour map",
           [=](gl::Case& c) {
             c.Disable(target_in(two, GL_MAP1_COLOR_4));
             c.Color4f(1, 1, 0, 1);
           }},
          {"another current colour", [](gl::Case& c) { c.Color4f(0.25f, 1, 0.75f, 1); }},
          {kAnotherGrid,
           [=](gl::Case& c) {
             map_grid(c, two, {two ? 2 : 3, two ? 1 : 0.75f, 0.25f}, {1, 0.5f, 0.75f});
           }},
          {"lighting",
           [](gl::Case& c) {
             c.Enable(GL_LIGHTING);  // no light: scaled normals would saturate all colours
             c.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, std::vector<float>{0.75f, 0, 0, 1});
           },
           true},
          {"another material",
           [](gl::Case& c) {
             c.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, std::vector<float>{0, 0.75f, 0.5f, 1});
           },
           true},
          {"another matrix once more", [](gl::Case& c) { c.LoadMatrixf(kMoved); }, true}};
}

struct Drawn {
  const char* name;
  bool on_grid;
  void (*draw)(gl::Case&, bool two);
};
constexpr Drawn kDrawn[] = {
    {"EVALMESH", true, [](gl::Case& c, bool two) { eval_mesh(c, two, GL_POINT, 0, two ? 2 : 3, 0, 1); }},
    {"EVALCOORD", false,
     [](gl::Case& c, bool two) {
       c.Begin(GL_POINTS);
       for (const double u : {0.0, 0.25, 1.0}) eval_coord(c, two, u, 0.25);
       c.End();
     }},
    {"EVALPOINT", true, [](gl::Case& c, bool two) {
       c.Begin(GL_POINTS);
       for (const GLint i : {2, 0, 1}) eval_point(c, two, i, 1);
       c.End();
     }}};

// One picture of ten drawings, each after a change of state. The control has the same changes.
EVALCTS_TEST_PAIR(Ordering.SeesEarlierState1, Ordering.SeesEarlierState2, kMust,
                  decide("EV-BE-ORDER/1-D", "EV-BE-ORDER/2-D"), combine(kDrawn))
(Test& t, bool two, const Drawn& drawn) {
  gl::Case evaluated, vertices;
  std::size_t drawn_before = 0;
  std::vector<Step> all = steps(two);
  if (!drawn.on_grid) std::erase_if(all, [](const Step& step) { return step.name == kAnotherGrid; });
  for (const Step& step : all) {
    step.change(evaluated);
    step.change(vertices);
    drawn.draw(evaluated, two);
    Prediction prediction = predict(evaluated, t.max_order());
    prediction.primitives.erase(prediction.primitives.begin(),
                                prediction.primitives.begin() + static_cast<std::ptrdiff_t>(drawn_before));
    drawn_before += prediction.primitives.size();
    vertices.append(as_explicit_commands(prediction));
  }
  const Picture control = feedback(t, gl::control("explicit vertices"), {}, vertices);
  // Each change has to be visible.
  const std::vector<double>& values = control.values();
  const auto size = static_cast<std::ptrdiff_t>(values.size() / all.size());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i) * size;
    require_an_effect(std::vector<double>(begin, begin + size), std::vector<double>(begin - size, begin));
  }
  Picture picture = feedback(t, "evaluated, state changed between the drawings", {}, evaluated);
  predict(evaluated, t.max_order()).has_meshes() ? expect_meshes_like_explicit(picture, control)
                                                 : expect_like_explicit(picture, control);
};

// The vertices of the same drawings, without the changes of later stages of the pipeline.
EVALCTS_TEST_PAIR(Ordering.EvaluatesInOrder1, Ordering.EvaluatesInOrder2, kMust,
                  decide("EV-BE-ORDER/1-D", "EV-BE-ORDER/2-D"), combine(kDrawn).by(gl::list_deliveries()))
(Test& t, bool two, const Drawn& drawn) {
  gl::Case c("drawn after each change");
  for (const Step& step : steps(two)) {
    if (step.of_pipeline) continue;
    step.change(c);
    drawn.draw(c, two);
  }
  t.judge_vertices(c, kPosition | kColor);
};

// The map of each attribute is enabled and disabled, with a drawing after each change. Current values are set
// again, as above.
EVALCTS_TEST_PAIR(Ordering.SeesEnables1, Ordering.SeesEnables2, kMust,
                  decide("EV-BE-ORDER/1-D", "EV-BE-ORDER/2-D"), combine(kDrawn).by(gl::list_deliveries()))
(Test& t, bool two, const Drawn& drawn) {
  gl::Case c("drawn with each map, and without it");
  enable_vertices(t, c);
  for (const GLenum kind : gl::kMap1Targets) {
    const GLenum target = target_in(two, kind);
    if (kind == GL_MAP1_INDEX || kind == GL_MAP1_VERTEX_3) continue;
    define(c, random_map(t, target, two ? Orders{2, 2} : Orders{3}));
    for (const bool on : {true, false}) {
      on ? c.Enable(target) : c.Disable(target);
      c.Color4f(0.25f, 0.5f, 0.75f, 1);
      c.Normal3f(0.5f, -0.25f, 0.125f);
      c.TexCoord4f(2, 3, 4, 5);
      drawn.draw(c, two);
    }
  }
  t.judge_vertices(c, kPosition | kColor | kNormal | kTextureCoordinate0);
};

}  // namespace
}  // namespace evalcts::suite_ordering
