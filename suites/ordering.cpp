// Section 19 of the requirements: which evaluator commands may stand between Begin and End, and that each
// command sees all earlier ones and no later one.
#include <fmt/format.h>

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"
#include "pictures.h"
#include "refusal.h"

namespace evalcts::suite_ordering {
namespace {

std::vector<NamedCalls> allowed() {
  return {
      {"EvalCoord1f", [](gl::Case& c) { c.EvalCoord1f(0.5f); }},
      {"EvalCoord1d", [](gl::Case& c) { c.EvalCoord1d(0.5); }},
      {"EvalCoord1fv", [](gl::Case& c) { c.EvalCoord1fv(std::vector<float>{0.5f}); }},
      {"EvalCoord1dv", [](gl::Case& c) { c.EvalCoord1dv(std::vector<double>{0.5}); }},
      {"EvalCoord2f", [](gl::Case& c) { c.EvalCoord2f(0.5f, 0.25f); }},
      {"EvalCoord2d", [](gl::Case& c) { c.EvalCoord2d(0.5, 0.25); }},
      {"EvalCoord2fv",
       [](gl::Case& c) {
         c.EvalCoord2fv(std::vector<float>{0.5f, 0.25f});
       }},
      {"EvalCoord2dv",
       [](gl::Case& c) {
         c.EvalCoord2dv(std::vector<double>{0.5, 0.25});
       }},
      {"EvalPoint1", [](gl::Case& c) { c.EvalPoint1(1); }},
      {"EvalPoint2", [](gl::Case& c) { c.EvalPoint2(1, 0); }},
  };
}

// And what switches and asks.
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

// Vertex maps of both dimensions, and grids.
void enable_vertices(Test& t, gl::Case& c) {
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  define(c, random_map2(t, GL_MAP2_VERTEX_3, 2, 3));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid1f(2, 0, 1);
  c.MapGrid2f(2, 0, 1, 3, 0, 1);
}

constexpr GLenum kModes[] = {GL_POINTS,         GL_LINES,        GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLES,
                             GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS,     GL_QUAD_STRIP, GL_POLYGON};

}  // namespace

EVALCTS_TEST(Ordering, AllowedInPrimitives, must, "EV-BE-ALLOWED", combine(allowed()))
(Test& t, const NamedCalls& command) {
  gl::Case c("in every primitive");
  enable_vertices(t, c);
  std::vector<gl::Ref> errors;
  for (const GLenum mode : kModes) {
    c.Begin(mode);
    for (int i = 0; i < 4; ++i) command.issue(c);
    c.End();
    errors.push_back(c.GetError());
  }
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_no_error(error);
};

EVALCTS_TEST(Ordering, ForbiddenInPrimitives, must, "EV-BE-ALLOWED", "EV-BE-IGNORED",
             combine(forbidden()).by(gl::list_deliveries()))
(Test& t, const NamedCalls& command) {
  gl::Case c("between two points of a primitive");
  enable_vertices(t, c);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  command.issue(c);
  c.EvalCoord1f(0.75f);
  c.End();
  const gl::Ref error = c.GetError(), no_more = c.GetError();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_OPERATION});
  played.expect_no_error(no_more);
  expect_unchanged(played, before, after);
  t.expect_emission(c, kPosition);
};

// --- Order -----------------------------------------------------------------------------------------------

namespace {

constexpr std::string_view kAnotherGrid = "another grid";

// State, then what is drawn under it.
struct Step {
  std::string_view name;
  Calls change;
  bool of_pipeline = false;
};

const std::vector<float> kSmall = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.125f, 0, 0, 1};
const std::vector<float> kMoved = {0.5f, 0, 0, 0, 0, -0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0.25f, 0, 1};

// Positions that fill [-0.75,0.75], `sign` says which way.
void define_vertices(gl::Case& c, bool two, double sign) {
  const double a = 0.75 * sign;
  if (two)
    define(c, make_map2(GL_MAP2_VERTEX_3, 2, 2, {-a, -a, 0, a, -0.5 * a, 0, -0.5 * a, a, 0.25, a, a, 0.5}));
  else
    define(c, make_map1(GL_MAP1_VERTEX_3, {-a, -a, 0, 0.5 * a, -a, 0.25, a, a, 0.5}));
}
void define_colors(gl::Case& c, bool two, double red) {
  if (two)
    define(c, make_map2(GL_MAP2_COLOR_4, 1, 2, {red, 0, 0.5, 1, 1 - red, 1, 0.5, 1}));
  else
    define(c, make_map1(GL_MAP1_COLOR_4, {red, 0, 0.5, 1, 1 - red, 1, 0.5, 1}));
}

std::vector<Step> steps(bool two) {
  return {{"as it begins",
           [=](gl::Case& c) {
             define_vertices(c, two, 1);
             define_colors(c, two, 1);
             c.Enable(two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
             c.Enable(two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
             if (two)
               c.MapGrid2f(2, 0, 1, 1, 0, 1);
             else
               c.MapGrid1f(3, 0, 1);
           }},
          {"another matrix", [](gl::Case& c) { c.LoadMatrixf(kSmall); }, true},
          {"another vertex map", [=](gl::Case& c) { define_vertices(c, two, -0.75); }},
          {"another colour map", [=](gl::Case& c) { define_colors(c, two, 0); }},
          // The current colour is given anew: whether evaluated ones replace it is for section 11.
          {"no colour map",
           [=](gl::Case& c) {
             c.Disable(two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
             c.Color4f(1, 1, 0, 1);
           }},
          {"another current colour", [](gl::Case& c) { c.Color4f(0.25f, 1, 0.75f, 1); }},
          {kAnotherGrid,
           [=](gl::Case& c) {
             if (two)
               c.MapGrid2f(2, 1, 0.25f, 1, 0.5f, 0.75f);
             else
               c.MapGrid1f(3, 0.75f, 0.25f);
           }},
          {"lighting",
           [](gl::Case& c) {
             c.Enable(GL_LIGHTING);  // no lamp: a normal that the matrix lengthens would saturate all colours
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
constexpr Drawn kDrawn[] = {{"EVALMESH", true,
                             [](gl::Case& c, bool two) {
                               if (two)
                                 c.EvalMesh2(GL_POINT, 0, 2, 0, 1);
                               else
                                 c.EvalMesh1(GL_POINT, 0, 3);
                             }},
                            {"EVALCOORD", false,
                             [](gl::Case& c, bool two) {
                               c.Begin(GL_POINTS);
                               for (const float u : {0.0f, 0.25f, 1.0f}) {
                                 if (two)
                                   c.EvalCoord2f(u, 0.25f);
                                 else
                                   c.EvalCoord1f(u);
                               }
                               c.End();
                             }},
                            {"EVALPOINT", true, [](gl::Case& c, bool two) {
                               c.Begin(GL_POINTS);
                               for (const GLint i : {2, 0, 1}) {
                                 if (two)
                                   c.EvalPoint2(i, 1);
                                 else
                                   c.EvalPoint1(i);
                               }
                               c.End();
                             }}};

// One picture of ten drawings with a change of state before each; the explicit vertices get the same changes.
void expect_in_order(Test& t, const Drawn& drawn, bool two) {
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
  const Picture control = feedback(t, "control: explicit vertices", {}, vertices);
  // Each change shows.
  const std::vector<double>& values = control.values();
  const auto size = static_cast<std::ptrdiff_t>(values.size() / all.size());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i) * size;
    require_an_effect(std::vector<double>(begin, begin + size), std::vector<double>(begin - size, begin));
  }
  Picture picture = feedback(t, "evaluated, state changed between the drawings", {}, evaluated);
  if (predict(evaluated, t.max_order()).has_meshes())
    expect_meshes_like_explicit(picture, control);
  else
    expect_like_explicit(picture, control);
}

}  // namespace

// The changes that concern the evaluator show in what comes out of it, too.
namespace {

void expect_evaluated_in_order(Test& t, const Drawn& drawn, bool two) {
  gl::Case c("drawn after each change");
  for (const Step& step : steps(two)) {
    if (step.of_pipeline) continue;
    step.change(c);
    drawn.draw(c, two);
  }
  t.expect_emission(c, kPosition | kColor);
}

}  // namespace

EVALCTS_TEST(Ordering, EvaluatesInOrder1, must, "EV-BE-ORDER/1-D", combine(kDrawn).by(gl::list_deliveries()))
(Test& t, const Drawn& drawn) { expect_evaluated_in_order(t, drawn, false); };
EVALCTS_TEST(Ordering, EvaluatesInOrder2, must, "EV-BE-ORDER/2-D", combine(kDrawn).by(gl::list_deliveries()))
(Test& t, const Drawn& drawn) { expect_evaluated_in_order(t, drawn, true); };

namespace {

// The map of each attribute switched on and off again, a drawing after each change. Current values are given
// anew, as above.
void expect_enables_in_order(Test& t, const Drawn& drawn, bool two) {
  gl::Case c("drawn with each map, and without it");
  enable_vertices(t, c);
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    const GLenum target = two ? gl::kMap2Targets[i] : gl::kMap1Targets[i], kind = gl::kMap1Targets[i];
    if (kind == GL_MAP1_INDEX || kind == GL_MAP1_VERTEX_3) continue;
    if (two)
      define(c, random_map2(t, target, 2, 2));
    else
      define(c, random_map(t, target, 3));
    for (const bool on : {true, false}) {
      if (on)
        c.Enable(target);
      else
        c.Disable(target);
      c.Color4f(0.25f, 0.5f, 0.75f, 1);
      c.Normal3f(0.5f, -0.25f, 0.125f);
      c.TexCoord4f(2, 3, 4, 5);
      drawn.draw(c, two);
    }
  }
  t.expect_emission(c, kPosition | kColor | kNormal | kTextureCoordinate0);
}

}  // namespace

EVALCTS_TEST(Ordering, SeesEnables1, must, "EV-BE-ORDER/1-D", combine(kDrawn).by(gl::list_deliveries()))
(Test& t, const Drawn& drawn) { expect_enables_in_order(t, drawn, false); };
EVALCTS_TEST(Ordering, SeesEnables2, must, "EV-BE-ORDER/2-D", combine(kDrawn).by(gl::list_deliveries()))
(Test& t, const Drawn& drawn) { expect_enables_in_order(t, drawn, true); };

EVALCTS_TEST(Ordering, SeesEarlierState1, must, "EV-BE-ORDER/1-D", combine(kDrawn))
(Test& t, const Drawn& drawn) { expect_in_order(t, drawn, false); };
EVALCTS_TEST(Ordering, SeesEarlierState2, must, "EV-BE-ORDER/2-D", combine(kDrawn))
(Test& t, const Drawn& drawn) { expect_in_order(t, drawn, true); };

}  // namespace evalcts::suite_ordering
