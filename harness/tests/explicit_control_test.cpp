// Tests the control of a failing case: the same case with explicit commands instead of evaluation.
#include <evalcts/testkit/explicit_control.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/testkit/reproduction.h>
#include "synthetic_capture.h"

namespace evalcts {
namespace {

gl::Case evaluated(GLenum mode = GL_POINTS) {
  gl::Case c("a curve");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{1, 2, 3, 4, 5, 6});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Color4f(0.5f, 0.25f, 0, 1);
  c.Begin(mode);
  c.EvalCoord1f(0.5f);
  c.EvalCoord1f(1);
  c.End();
  return c;
}
gl::Case in_lists(GLenum mode = GL_POINTS) {
  return gl::through_lists(evaluated(mode), gl::Lists::kCompiled).script;
}

// Vertices alone, with attributes, and with attributes from arrays.
constexpr int kControls = 3;

void lose_positions(Observation& seen, const gl::Case&) { seen.primitives[0].vertices[1].position[0] = 99; }
void lose_colors(Observation& seen, const gl::Case&) { seen.primitives[0].vertices[1].color = {}; }

// An implementation that accepts Enable and Disable of all capabilities from `first_known` on.
class WithCapabilities final : public Implementation {
 public:
  static inline GLenum first_known = GL_INDEX_LOGIC_OP;  // the accepted capability with the least token

  std::string name() const override { return "with capabilities"; }
  std::unique_ptr<Context> create_context() override { return std::make_unique<WithEnable>(); }

 private:
  static inline GLenum error = GL_NO_ERROR;
  class WithEnable final : public Context {
   public:
    WithEnable() {
      table_.Enable = table_.Disable = [](GLenum capability) {
        if (capability < first_known) error = GL_INVALID_ENUM;
      };
      table_.GetError = [] { return std::exchange(error, static_cast<GLenum>(GL_NO_ERROR)); };
    }
    const gl::Table& table() const override { return table_; }

   private:
    gl::Table table_{};
  };
};

class ExplicitControlTest : public testing::Test {
 protected:
  ExplicitControlTest() {
    subject_.implementation = &implementation_;
    WithCapabilities::first_known = GL_INDEX_LOGIC_OP;
  }

  // Returns the number of controls that run if a case that is judged by these attributes fails twice.
  int controls(const gl::Case& script, const SyntheticCapture& capture, Attributes judged = kAllAttributes,
               const std::string& what = "point 1") {
    control_.set_observed(script, capture, judged);
    control_.require_explicit_vertices(what);
    control_.require_explicit_vertices(what);
    return capture.observations;
  }

  static CaptureTraits traits() { return {.attributes = kPosition | kColor}; }

  WithCapabilities implementation_;
  Subject subject_;
  ExplicitControl control_{subject_};
};

TEST_F(ExplicitControlTest, ListsThatKeepExplicitVerticesAreNotTheCause) {
  EXPECT_EQ(controls(in_lists(), SyntheticCapture(traits())), kControls);
}

TEST_F(ExplicitControlTest, ListsThatLoseExplicitVerticesAre) {
  const SyntheticCapture capture(traits(), lose_positions);
  try {
    controls(in_lists(), capture);
    FAIL();
  } catch (const NotObservable& reason) {
    EXPECT_TRUE(std::string(reason.what())
                    .starts_with("pipeline: explicit commands instead of evaluations go wrong as well: "
                                 "position.x of vertex 1 "))
        << reason.what();
  }
  // For later failures of the same case, the controls do not run again.
  const int observed_before = capture.observations;
  EXPECT_THROW(control_.require_explicit_vertices("normal.x of vertex 0"), NotObservable);
  EXPECT_EQ(capture.observations, observed_before);
}

TEST_F(ExplicitControlTest, AttributesThatAreNotJudgedDoNotMatterButPositionsAlwaysDo) {
  const SyntheticCapture without_color(traits(), lose_colors), out_of_place(traits(), lose_positions);
  EXPECT_EQ(controls(in_lists(), without_color, kPosition), kControls);
  EXPECT_THROW(controls(in_lists(), without_color, kColor), NotObservable);
  EXPECT_THROW(controls(in_lists(), out_of_place, kColor), NotObservable);
}

// A pipeline that loses colours is not the root cause of wrong normals.
TEST_F(ExplicitControlTest, OtherAttributesDoNotExplainAFailure) {
  const SyntheticCapture without_color(traits(), lose_colors);
  EXPECT_EQ(controls(evaluated(), without_color, kAllAttributes, "normal.x of vertex 1"), kControls);
  EXPECT_THROW(controls(evaluated(), without_color, kAllAttributes, "color.R of vertex 1"), NotObservable);
  const SyntheticCapture out_of_place(traits(), lose_positions);
  EXPECT_THROW(controls(evaluated(), out_of_place, kAllAttributes, "color.R of vertex 1"), NotObservable);
}

// gl4es loses TexCoord2fv, but not TexCoord2f.
TEST_F(ExplicitControlTest, PipelineMayLoseAttributesFromArraysOnly) {
  const SyntheticCapture loses_arrays(traits(), [](Observation& seen, const gl::Case& control) {
    for (const gl::Command& command : control.commands())
      if (command.entry == gl::EntryPoint::Color4fv) lose_colors(seen, control);
  });
  gl::Case c = evaluated();
  EXPECT_EQ(controls(c, loses_arrays), kControls);
  gl::Case colored("a curve with colours");
  colored.Enable(GL_MAP1_COLOR_4);
  colored.append(c);
  EXPECT_THROW(controls(colored, loses_arrays, kAllAttributes, "color.R of vertex 1"), NotObservable);
}

// Arrays for each of 40,000 vertices would exceed the number of mappings of a process.
TEST_F(ExplicitControlTest, LongPrimitivesHaveNoArrays) {
  gl::Case c("many points");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLfloat>{0, 0, 0, 1, 1, 0});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  for (int i = 0; i < 2500; ++i) c.EvalCoord1f(static_cast<float>(i) / 2500);
  c.End();
  EXPECT_EQ(controls(c, SyntheticCapture(traits())), kControls - 1);
}

TEST_F(ExplicitControlTest, CasesWithoutListsHaveOneAsWell) {
  EXPECT_EQ(controls(evaluated(), SyntheticCapture(traits())), kControls);
  EXPECT_THROW(controls(evaluated(), SyntheticCapture(traits(), lose_positions)), NotObservable);
}

TEST_F(ExplicitControlTest, ReproductionsHaveNoControl) {
  Reproduction reproduction(
      implementation_, [](const std::string&) {}, gl::CStyle::kFull);
  subject_.reproduction = &reproduction;
  EXPECT_EQ(controls(in_lists(), SyntheticCapture(traits(), lose_positions)), 0);
}

TEST_F(ExplicitControlTest, ANewCaseForgetsTheOneBefore) {
  const SyntheticCapture capture(traits(), lose_positions);
  control_.set_observed(in_lists(), capture, kPosition);
  control_.clear();
  EXPECT_NO_THROW(control_.require_explicit_vertices("point 1"));
  EXPECT_EQ(capture.observations, 0);
}

TEST_F(ExplicitControlTest, PrimitivesThatTheCaptureDoesNotTakeHaveNoControl) {
  CaptureTraits points_only = traits();
  points_only.takes = kPoints;
  const SyntheticCapture capture(points_only, lose_positions);
  EXPECT_EQ(controls(in_lists(GL_LINES), capture), 0);
  EXPECT_EQ(control_.lost_attributes(evaluated(GL_LINES), capture), 0u);
}

TEST_F(ExplicitControlTest, LinesAreTakenApartAsTheCaptureDoesIt) {
  const SyntheticCapture backwards(traits(), [](Observation& seen, const gl::Case&) {
    for (ObservedPrimitive& primitive : seen.primitives) std::ranges::reverse(primitive.vertices);
  });
  EXPECT_EQ(controls(in_lists(GL_LINES), backwards), kControls + 1);  // the further one learns the topology
}

// Returns the capability whose Enable and Disable replace Map1f and Enable in the control; 0 if
// there is none.
GLenum changed_in(const gl::Case& control) {
  for (const gl::Command& command : control.commands())
    if (command.entry == gl::EntryPoint::Enable)
      return static_cast<GLenum>(std::get<std::int64_t>(command.arguments[0]));
  return 0;
}

// If a library loses values after any change of state, the control must show it, regardless of the
// capabilities that the library supports.
TEST_F(ExplicitControlTest, StateThatTheLibraryKnowsIsChanged) {
  for (const GLenum known : {GL_INDEX_LOGIC_OP, GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL}) {
    WithCapabilities::first_known = known;
    subject_.info.idle_capability = gl::find_idle_capability(implementation_.create_context()->table());
    const SyntheticCapture loses_behind_changes(traits(), [&](Observation& seen, const gl::Case& control) {
      if (changed_in(control) == known) lose_positions(seen, control);
    });
    EXPECT_THROW(controls(evaluated(), loses_behind_changes), NotObservable) << known;
  }
  WithCapabilities::first_known = GL_POLYGON_OFFSET_FILL + 1;  // no candidate is accepted
  subject_.info.idle_capability = gl::find_idle_capability(implementation_.create_context()->table());
  GLenum changed = 0;
  const SyntheticCapture capture(traits(), [&](Observation&, const gl::Case& control) {
    changed = std::max(changed, changed_in(control));
  });
  EXPECT_EQ(controls(evaluated(), capture), kControls);
  EXPECT_EQ(changed, 0u);
}

// A warm context stands for fresh ones only if the case fails there, too, and its controls pass there.
TEST_F(ExplicitControlTest, ControlsRunInTheWarmContextIfTheCaseFailsThere) {
  std::unique_ptr<Implementation> library;
  std::unique_ptr<WarmContext> warm;
  for (const char* const name : {"osmesa", "egl"}) {
    if (warm) break;
    try {
      library = open_implementation({name});
      warm = WarmContext::of(*library, inquire(*library));
    } catch (const CannotStart&) {
      continue;
    }
  }
  if (!warm) GTEST_SKIP() << "neither OSMesa nor EGL here";
  subject_.warm = warm.get();
  const auto run = [&](const SyntheticCapture& capture, bool fails_in_warm_context) {
    control_.clear();
    control_.set_observed(evaluated(), capture, kAllAttributes);
    control_.run_controls([&](Implementation& used) {
      EXPECT_EQ(&used, &warm->implementation());
      return fails_in_warm_context;
    });
    control_.require_explicit_vertices("point 1");
    return capture.last_implementation;
  };
  const SyntheticCapture right(traits()), wrong(traits(), lose_positions);
  EXPECT_EQ(run(right, true), &warm->implementation());
  EXPECT_EQ(right.observations, kControls);
  EXPECT_EQ(run(right, false), subject_.implementation);
  EXPECT_EQ(right.observations, 2 * kControls);
  EXPECT_THROW(run(wrong, true), NotObservable);
  EXPECT_EQ(wrong.last_implementation, subject_.implementation);
}

// An implementation whose End always raises an error, as CallList does, and whose other commands do nothing.
class FailsAtEnd final : public Implementation {
 public:
  std::string name() const override { return "fails at End"; }
  std::unique_ptr<Context> create_context() override { return std::make_unique<OfEnd>(); }

 private:
  static inline GLenum error = GL_NO_ERROR;
  class OfEnd final : public Context {
   public:
    OfEnd() {
      table_.Begin = [](GLenum) {};
      table_.End = [] {
        if (error == GL_NO_ERROR) error = GL_INVALID_OPERATION;
      };
      table_.Vertex3f = [](GLfloat, GLfloat, GLfloat) {};
      table_.Color4f = [](GLfloat, GLfloat, GLfloat, GLfloat) {};
      table_.NewList = [](GLuint, GLenum) {};
      table_.EndList = [] {};
      table_.CallList = [](GLuint) { error = GL_INVALID_VALUE; };
      table_.GetError = [] { return std::exchange(error, static_cast<GLenum>(GL_NO_ERROR)); };
    }
    const gl::Table& table() const override { return table_; }

   private:
    gl::Table table_{};
  };
};

TEST_F(ExplicitControlTest, ErrorThatExplicitVerticesRaiseAsWellIsNotThatOfEvaluators) {
  FailsAtEnd implementation;
  subject_.implementation = &implementation;
  EXPECT_EQ(control_.error_without_evaluators(evaluated(), {GL_INVALID_OPERATION}), GL_INVALID_OPERATION);
  EXPECT_EQ(control_.error_without_evaluators(evaluated(), {GL_INVALID_ENUM}), std::nullopt);
  gl::Case nothing_evaluated("a primitive");
  nothing_evaluated.Begin(GL_POINTS);
  nothing_evaluated.End();
  EXPECT_EQ(control_.error_without_evaluators(nothing_evaluated, {GL_INVALID_OPERATION}),
            GL_INVALID_OPERATION);
  gl::Case only_evaluators("a map without a primitive");
  only_evaluators.Enable(GL_MAP1_VERTEX_3);
  only_evaluators.Disable(GL_MAP1_VERTEX_3);
  EXPECT_EQ(control_.error_without_evaluators(only_evaluators, {GL_INVALID_OPERATION}), std::nullopt);
}

// Mesa crashes if a list calls one that does not exist within a primitive.
TEST_F(ExplicitControlTest, ControlsOfErrorsCallNoLists) {
  FailsAtEnd implementation;
  subject_.implementation = &implementation;
  gl::Case in_list("a list that evaluates");
  in_list.NewList(1, GL_COMPILE_AND_EXECUTE);
  in_list.Begin(GL_POINTS);
  in_list.EvalCoord1f(0);
  in_list.End();
  in_list.EndList();
  EXPECT_EQ(control_.error_without_evaluators(in_list, {GL_INVALID_VALUE}), std::nullopt);
}

TEST_F(ExplicitControlTest, LostAttributesAreThoseOfExplicitVertices) {
  EXPECT_EQ(control_.lost_attributes(evaluated(), SyntheticCapture(traits())), 0u);
  EXPECT_EQ(control_.lost_attributes(evaluated(), SyntheticCapture(traits(), lose_colors)),
            static_cast<Attributes>(kColor));
  EXPECT_EQ(control_.lost_attributes(evaluated(), SyntheticCapture({}, lose_colors)), 0u);  // not shown
}

}  // namespace
}  // namespace evalcts
