// Tests stand-alone C programs: they build with one line, and their exit code is the verdict.
#include <evalcts/gl/c_program.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include <evalcts/backends/context_in_front.h>
#include <evalcts/gl/contexts.h>
#include <evalcts/testkit/reproduction.h>
#include <evalcts/testkit/test.h>
#include "program.h"

namespace evalcts {
namespace {

class CProgram : public ProgramTest {
 protected:
  // Builds the program `text` with more options of the compiler, and starts it with `library` as its
  // argument.
  Outcome build_and_start(const std::string& text, const std::string& library = {},
                          const std::vector<std::string>& more = {}) {
    const std::string source = (folder_ / "program.c").string(), program = (folder_ / "program").string();
    std::ofstream(source) << text;
    std::vector<std::string> compile = {"/usr/bin/env",         "cc", "-Wall", "-Werror",
                                        "-Wno-unused-function", "-o", program, source};
    compile.insert(compile.end(), more.begin(), more.end());
    if (library.empty() && more.empty())
      compile.insert(compile.end(), {"-DGLEV_STATIC", "-I" GLEVALUATOR_HEADERS, GLEVALUATOR_LIBRARY, "-lm"});
    compile.push_back("-ldl");
    std::istringstream options(CC_OPTIONS);
    for (std::string option; options >> option;) compile.push_back(option);
    const Outcome built = start(compile);
    EXPECT_EQ(built.code, 0) << built.text << text;
    return start(library.empty() ? std::vector{program} : std::vector{program, library});
  }
};

// Returns a case that draws a straight line from (0,0,0) to (1,2,3).
gl::Case line() {
  gl::Case c("a line");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, gl::array<float>({0, 0, 0, 1, 2, 3}, gl::AfterCall::kUnmap));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0);
  c.EvalCoord1f(0.5f);
  c.End();
  return c;
}

TEST_F(CProgram, OfProductionChecksWhatCameThroughTheSink) {
  const gl::Case c = line();
  const auto outcome = [&](gl::Answer answer, double low, double high) {
    const gl::Check check{.answer = answer, .accepted = {{low, high}}, .what = "it"};
    return build_and_start(
        gl::to_c({.context = "production", .library = {}, .script = &c, .check = &check, .trace = nullptr}));
  };
  using Kind = gl::Answer::Kind;
  const gl::Answer y_of_second{Kind::kEmittedValue, {}, gl::kEmittedValues + 1};
  EXPECT_EQ(outcome(y_of_second, 1, 1).code, 0);
  const Outcome wrong = outcome(y_of_second, 1.5, 2);
  EXPECT_EQ(wrong.code, 1);
  EXPECT_EQ(wrong.text, "it: expected [1.5, 2], got 1 (0x1p+0)\nthe failure shows\n");
  EXPECT_EQ(outcome({Kind::kEmittedVertices}, 2, 2).code, 0);
  EXPECT_EQ(outcome({Kind::kEmittedVertices}, 3, 3).code, 1);
  EXPECT_EQ(outcome({Kind::kLeftOver, {}, 0, true}, 0, 0).code, 0);
}

TEST_F(CProgram, OfASinkChecksWhatItHandsOver) {
#ifndef __SANITIZE_ADDRESS__
  const gl::Case c = line();
  const auto code = [&](gl::Answer answer, double value) {
    const gl::Check check{.answer = answer, .accepted = {{value, value}}, .what = "it"};
    return build_and_start(gl::to_c({.context = "sink", .library = {}, .script = &c, .check = &check}),
                           BEZIER_SINK)
        .code;
  };
  using Kind = gl::Answer::Kind;
  const gl::Answer y_of_second{Kind::kEmittedValue, {}, gl::kEmittedValues + 1};
  EXPECT_EQ(code(y_of_second, 1), 0);
  EXPECT_EQ(code(y_of_second, 2), 1);
  EXPECT_EQ(code({Kind::kEmittedVertices}, 2), 0);
  EXPECT_EQ(code({Kind::kEmittedVertices}, 1), 1);
  EXPECT_EQ(code({Kind::kLeftOver, {}, 0, true}, 0), 0);
#endif
}

TEST_F(CProgram, AnswersOfEveryKind) {
  gl::Case c("queries");
  const gl::Ref error = c.GetError();
  c.Map1d(GL_MAP1_INDEX, 0, 1, 1, 2, gl::array<double>({5, 7}, gl::AfterCall::kOverwrite));
  const gl::Ref order = c.GetMapiv(GL_MAP1_INDEX, GL_ORDER, gl::out<GLint>(1));
  const gl::Ref values = c.GetMapdv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLdouble>(4));
  const gl::Ref again = c.GetMapdv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLdouble>(4));
  c.Map1d(GL_MAP1_INDEX, 0, 1, 1, 1, gl::array<double>({9}, gl::AfterCall::kProtect));
  const gl::Ref later = c.GetMapdv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLdouble>(4));
  const gl::Ref enabled = c.IsEnabled(GL_MAP1_INDEX);
  const auto production = open_implementation({.name = "production"});
  const gl::Trace trace = production->create_context()->play(c);
  const auto outcome = [&](const gl::Check& check) {
    return build_and_start(
        gl::to_c({.context = "production", .library = {}, .script = &c, .check = &check, .trace = &trace}));
  };
  using Kind = gl::Answer::Kind;
  using Rule = gl::Check::Rule;
  const gl::Answer returned_error{Kind::kReturned, error, 0, true};
  EXPECT_EQ(outcome({.answer = returned_error, .accepted = {{0, 0}}, .expected = "GL_NO_ERROR"}).code, 0);
  const Outcome missing_error =
      outcome({.answer = returned_error, .accepted = {{0x500, 0x500}}, .expected = "GL_INVALID_ENUM"});
  EXPECT_EQ(missing_error.code, 1);
  EXPECT_TRUE(contains(missing_error.text, "glGetError(): expected GL_INVALID_ENUM, got GL_NO_ERROR"));
  EXPECT_EQ(outcome({.answer = {Kind::kElement, order, 0}, .accepted = {{2, 2}}}).code, 0);
  const Outcome wrong_order = outcome({.answer = {Kind::kElement, order, 0}, .accepted = {{3, 3}}});
  EXPECT_EQ(wrong_order.code, 1);
  EXPECT_TRUE(contains(wrong_order.text,
                       "values[0] of glGetMapiv(GL_MAP1_INDEX, GL_ORDER, values): expected 3, got 2"));
  EXPECT_EQ(outcome({.answer = {Kind::kElement, values, 1}, .accepted = {{7, 7}}}).code, 0);
  EXPECT_EQ(outcome({.answer = {Kind::kWritten, values}, .accepted = {{0, 2}}}).code, 0);
  EXPECT_EQ(outcome({.answer = {Kind::kWritten, values}, .accepted = {{0, 1}}}).code, 1);
  EXPECT_EQ(outcome({.answer = {Kind::kReturned, enabled}, .accepted = {{1, 1}}}).code, 1);
  EXPECT_EQ(outcome({.rule = Rule::kSame, .answer = {.command = again}, .other = values}).code, 0);
  EXPECT_EQ(outcome({.rule = Rule::kSame, .answer = {.command = later}, .other = values}).code, 1);
  // The program fails because its answers are equal to the recorded ones.
  EXPECT_EQ(outcome({.rule = Rule::kUnlike, .recorded = {values, order}}).code, 1);
  gl::Trace another = trace;
  another.replace_element(values, 0, 6);
  const gl::Check check{.rule = Rule::kUnlike, .recorded = {values, order}};
  EXPECT_EQ(
      build_and_start(
          gl::to_c(
              {.context = "production", .library = {}, .script = &c, .check = &check, .trace = &another}))
          .code,
      0);
}

// A case with two contexts: the first keeps its state while the second is used, and does not see
// the second's state.
TEST_F(CProgram, OtherContexts) {
  gl::Case c("two contexts");
  c.MapGrid1f(3, 0, 1);
  c.OtherContextEVALCTS(1);
  const gl::Ref other = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  c.MapGrid1f(5, 0, 1);
  c.OtherContextEVALCTS(0);
  const gl::Ref first = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  const auto outcome = [&](const char* context, const char* library, gl::Ref query, double segments) {
    const gl::Check check{.answer = {.kind = gl::Answer::Kind::kElement, .command = query},
                          .accepted = {{segments, segments}},
                          .what = "segments"};
    return build_and_start(
               gl::to_c({.context = context, .library = {}, .script = &c, .check = &check, .trace = nullptr}),
               library)
        .code;
  };
  EXPECT_EQ(outcome("production", "", other, 1), 0);
  EXPECT_EQ(outcome("production", "", first, 3), 0);
  EXPECT_EQ(outcome("production", "", first, 5), 1);
#ifndef __SANITIZE_ADDRESS__
  const int code = outcome("osmesa", "libOSMesa.so.8", other, 1);
  if (code == 2) GTEST_SKIP() << "no OSMesa here";
  EXPECT_EQ(code, 0);
  EXPECT_EQ(outcome("osmesa", "libOSMesa.so.8", first, 3), 0);
  EXPECT_EQ(outcome("osmesa", "libOSMesa.so.8", first, 5), 1);
#endif
}

// Contexts from a provider, and commands from another library than the contexts.
TEST_F(CProgram, ContextsFromAProviderAndFromAnotherLibrary) {
#ifndef __SANITIZE_ADDRESS__
  gl::Case c("grid");
  c.MapGrid1f(3, 0, 1);
  const gl::Ref query = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  const auto outcome = [&](const char* context, const char* context_library, const char* library,
                           double segments) {
    const gl::Check check{.answer = {.kind = gl::Answer::Kind::kElement, .command = query},
                          .accepted = {{segments, segments}},
                          .what = "segments"};
    return build_and_start(gl::to_c({.context = context,
                                     .context_library = context_library,
                                     .library = {},
                                     .script = &c,
                                     .check = &check}),
                           library)
        .code;
  };
  const int code = outcome("provider", "", OSMESA_PROVIDER, 3);
  if (code == 2) GTEST_SKIP() << "no OSMesa here";
  EXPECT_EQ(code, 0);
  EXPECT_EQ(outcome("provider", "", OSMESA_PROVIDER, 5), 1);
  EXPECT_EQ(outcome("provider", OSMESA_PROVIDER, "libOSMesa.so.8", 3), 0);
  EXPECT_EQ(outcome("osmesa", "libOSMesa.so.8", "libOSMesa.so.8", 3), 0);
  EXPECT_EQ(outcome("osmesa", "libOSMesa.so.8", "libOSMesa.so.8", 5), 1);
#endif
}

TEST_F(CProgram, FallsBackToTheExtensionOfACommand) {
#ifndef __SANITIZE_ADDRESS__
  gl::Case c("active texture");
  c.ActiveTexture(GL_TEXTURE1);
  const gl::Ref query = c.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
  const gl::Check check{.answer = {.kind = gl::Answer::Kind::kElement, .command = query},
                        .accepted = {{GL_TEXTURE1, GL_TEXTURE1}},
                        .what = "unit"};
  setenv("EVALCTS_DRILL", "older", 1);
  const Outcome outcome = build_and_start(
      gl::to_c({.context = "provider", .context_library = "", .library = {}, .script = &c, .check = &check}),
      DEGRADED_PROVIDER);
  unsetenv("EVALCTS_DRILL");
  if (outcome.text.find("OSMesa creates no context") != std::string::npos) GTEST_SKIP() << "no OSMesa here";
  EXPECT_EQ(outcome.code, 0) << outcome.text;
#endif
}

TEST_F(CProgram, ThereIsNoneOfWhatOnlyEvalctsCanOpen) {
  const gl::Case c = line();
  EXPECT_THROW(gl::to_c({.context = "reference", .library = {}, .script = &c}), gl::NoCProgram);
  EXPECT_THROW(gl::to_c({.context = "provider.so", .library = {}, .script = &c}), gl::NoCProgram);
  gl::Case moves;
  moves.MoveToThreadEVALCTS(1);
  EXPECT_THROW(gl::to_c({.context = "osmesa", .library = {}, .script = &moves}), gl::NoCProgram);
}

// A case that asks for the order of a map of order 2, with a check that accepts `order`.
struct OrderQuery {
  explicit OrderQuery(double order) {
    c.Map1f(GL_MAP1_INDEX, 0, 1, 1, 2, gl::array<float>({5, 0.1f}, gl::AfterCall::kOverwrite));
    for (int i = 0; i < 10; ++i) c.EvalCoord1f(1);
    check.answer = {gl::Answer::Kind::kElement, c.GetMapiv(GL_MAP1_INDEX, GL_ORDER, gl::out<GLint>(1)), 0};
    check.accepted = {{order, order}};
  }
  gl::Case c;
  gl::Check check;
};

std::string short_program(const gl::Case& c, const gl::Check& check, gl::CStyle style = gl::CStyle::kShort) {
  return gl::to_c(
      {.style = style, .context = "egl", .library = "libEGL.so.1", .script = &c, .check = &check});
}

TEST_F(CProgram, ShortOnesAreLinkedWithThePlatformsLibraries) {
  const auto outcome = [&](double order) {
    const OrderQuery query(order);
    return build_and_start(short_program(query.c, query.check), "", {"-lEGL", "-lGL"});
  };
  const Outcome right = outcome(2);
  if (right.code == 2) GTEST_SKIP() << "EGL makes no context here";
  EXPECT_EQ(right.code, 0) << right.text;
  const Outcome wrong = outcome(3);
  EXPECT_EQ(wrong.code, 1);
  EXPECT_TRUE(
      contains(wrong.text, "values[0] of glGetMapiv(GL_MAP1_INDEX, GL_ORDER, values): expected 3, got 2\n"));
  const OrderQuery query(2);
  const std::string text = short_program(query.c, query.check);
  EXPECT_LE(std::ranges::count(text, '\n'), 40);
  EXPECT_TRUE(contains(text, "static GLfloat in_0_5[] = {5.0f, 0.1f};"));
  EXPECT_TRUE(contains(text, "  for (int i = 0; i < 10; ++i)\n    glEvalCoord1f(1.0f);\n"));
}

// The test's own commands come first, and the capture's behind them.
TEST_F(CProgram, ShortOnesBeginWithTheCommandsOfTheTest) {
  gl::Case c;
  c.FeedbackBuffer(2, GL_2D, gl::out<GLfloat>(2));
  c.GetError();
  c.EvalCoord1f(0);
  const gl::Ref query = c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
  const gl::Check check{.answer = {gl::Answer::Kind::kElement, query, 0}, .accepted = {{8, 8}}};
  const std::string text = gl::to_c({.style = gl::CStyle::kShort,
                                     .context = "egl",
                                     .library = "libEGL.so.1",
                                     .script = &c,
                                     .first_own = 2,
                                     .own = 1,
                                     .check = &check});
  EXPECT_LT(text.find("glEvalCoord1f"), text.find("glFeedbackBuffer"));
  EXPECT_TRUE(contains(text, "  draw();\n  glGetIntegerv(GL_MAX_EVAL_ORDER, "));
  EXPECT_FALSE(contains(text, "glGetError")) << "only a capture's own check";
}

TEST_F(CProgram, ShortOnesMakeTheKindOfContextOfTheCase) {
  gl::Case c;
  c.ContextOfKindEVALCTS(1, EVALCTS_CORE_PROFILE);
  const gl::Ref query = c.GetIntegerv(GL_CONTEXT_PROFILE_MASK, gl::out<GLint>(1));
  const gl::Check check{.answer = {gl::Answer::Kind::kElement, query, 0},
                        .accepted = {{GL_CONTEXT_CORE_PROFILE_BIT, GL_CONTEXT_CORE_PROFILE_BIT}}};
  const Outcome outcome = build_and_start(short_program(c, check), "", {"-lEGL", "-lGL"});
  if (outcome.code == 2) GTEST_SKIP() << "EGL makes no context here";
  EXPECT_EQ(outcome.code, 0) << outcome.text;
}

TEST_F(CProgram, ShortOnesRejectWhatNeedsTheFullStyle) {
  const gl::Check check;
  gl::Case contexts;
  contexts.OtherContextEVALCTS(1);
  EXPECT_THROW(short_program(contexts, check), gl::NoCProgram);
  EXPECT_THROW(short_program(line(), check), gl::NoCProgram) << "unmaps an array";
  EXPECT_THROW(
      gl::to_c({.style = gl::CStyle::kShort, .context = "production", .library = "", .script = &contexts}),
      gl::NoCProgram);
  const gl::Case nothing;
  EXPECT_THROW(
      gl::to_c({.style = gl::CStyle::kShort, .context = "egl", .library = "/x/libmy.so", .script = &nothing}),
      gl::NoCProgram);
}

// The part of piglit-util-gl.h that such tests use.
constexpr char kPiglitHeader[] = R"(
#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
enum piglit_result { PIGLIT_PASS, PIGLIT_FAIL };
enum { PIGLIT_GL_VISUAL_RGBA = 1, PIGLIT_GL_VISUAL_DOUBLE = 2, PIGLIT_HAS_ERRORS = 1, PIGLIT_NO_ERRORS = 2 };
struct piglit_config { int supports_gl_compat_version, supports_gl_core_version, window_visual, khr_no_error_support; };
enum piglit_result piglit_display(void);
void piglit_init(int argc, char **argv);
void configure(struct piglit_config *pointer);
#define PIGLIT_GL_TEST_CONFIG_BEGIN void configure(struct piglit_config *pointer) { struct piglit_config config = {0};
#define PIGLIT_GL_TEST_CONFIG_END *pointer = config; }
int main(int argc, char **argv) {
  struct piglit_config config;
  configure(&config);
  if (config.supports_gl_compat_version != 10 || !config.window_visual || !config.khr_no_error_support) return 3;
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  if (!display || !eglInitialize(display, NULL, NULL)) return 2;
  eglBindAPI(EGL_OPENGL_API);
  if (!eglMakeCurrent(display, NULL, NULL, eglCreateContext(display, NULL, NULL, NULL))) return 2;
  piglit_init(argc, argv);
  return piglit_display() == PIGLIT_PASS ? 0 : 1;
}
)";

TEST_F(CProgram, TestsOfPiglitReturnAResult) {
  std::ofstream(folder_ / "piglit-util-gl.h") << kPiglitHeader;
  const auto outcome = [&](double order) {
    const OrderQuery query(order);
    return build_and_start(short_program(query.c, query.check, gl::CStyle::kPiglit), "",
                           {"-I" + folder_.string(), "-lEGL", "-lGL"});
  };
  const Outcome right = outcome(2);
  if (right.code == 2) GTEST_SKIP() << "EGL makes no context here";
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_EQ(outcome(3).code, 1);
  const OrderQuery query(2);
  EXPECT_TRUE(contains(short_program(query.c, query.check, gl::CStyle::kPiglit),
                       "static void\ndraw(void)\n{\n\tstatic GLfloat in_0_5[] = "));
  EXPECT_TRUE(contains(gl::to_c({.style = gl::CStyle::kPiglit, .context = "egl", .library = ""},
                                {"GLenum error = glGetError();"}, "error != GL_INVALID_ENUM", 0),
                       "PIGLIT_HAS_ERRORS"));
}

// The production evaluator, but with one wrong value.
class Bent final : public Implementation {
 public:
  std::string name() const override { return "production"; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<BentContext>(inner_->create_context());
  }

 private:
  class BentContext final : public ContextInFront {
   public:
    using ContextInFront::ContextInFront;
    std::vector<ObservedPrimitive> take_emitted() override {
      auto emitted = inner().take_emitted();
      if (!emitted.empty() && emitted.front().vertices.size() == 2)
        emitted.front().vertices[1].position[2] = 3;
      return emitted;
    }
  };
  std::unique_ptr<Implementation> inner_ = open_implementation({.name = "production"});
};

// The check refers to the wrong value, although other values are equal to it, and a correct library passes.
TEST_F(CProgram, FindsTheAnswerThatAMismatchRestsOn) {
  Bent bent;
  std::string written;
  Reproduction reproduction(
      bent, [&](const std::string& program) { written = program; }, gl::CStyle::kFull);
  Subject subject;
  subject.implementation = &reproduction.implementation();
  subject.info = inquire(bent);
  const std::vector<std::string> sink{"Sink"};
  Captures captures(bent, subject.info, &sink);
  subject.captures = &captures;
  subject.reproduction = &reproduction;
  TestRecord record;
  record.name = "A.Test";
  evalcts::Test test(subject, record);
  test.run([](evalcts::Test& t) { t.judge_vertices(line(), kPosition); });
  ASSERT_EQ(record.verdict, Verdict::kFail);
  ASSERT_TRUE(reproduction.check());
  const gl::Check& check = *reproduction.check();
  EXPECT_EQ(check.answer.kind, gl::Answer::Kind::kEmittedValue);
  EXPECT_EQ(check.answer.element, gl::kEmittedValues + 2);
  EXPECT_LT(check.accepted.front().first, 1.5);
  EXPECT_GT(check.accepted.front().second, 1.5);
  EXPECT_LT(check.accepted.front().second, 1.6);
  const Outcome outcome = build_and_start(written);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "position.z of vertex 1: expected [1.4"));
}

// Some tests run a control after a case that is about to fail.
TEST_F(CProgram, HasTheFailingCaseAndNotTheControlAfterIt) {
  const std::unique_ptr<Implementation> production = open_implementation({.name = "production"});
  std::string written;
  Reproduction reproduction(
      *production, [&](const std::string& program) { written = program; }, gl::CStyle::kFull);
  Subject subject;
  subject.implementation = &reproduction.implementation();
  subject.info = inquire(*production);
  subject.reproduction = &reproduction;
  TestRecord record;
  record.name = "A.Test";
  evalcts::Test test(subject, record);
  test.run([](evalcts::Test& t) {
    gl::Case c("grid");
    c.MapGrid1f(3, 0, 1);
    const gl::Ref query = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
    CheckedTrace checked = t.play(c);
    gl::Case control(gl::control("colour"));
    control.Color4f(1, 2, 3, 4);
    t.play(control);
    checked.expect_values<GLint>(query, {4});
  });
  ASSERT_EQ(record.verdict, Verdict::kFail) << record.message;
  EXPECT_TRUE(contains(written, "glMapGrid1f(3, 0.0f, 1.0f);"));
  EXPECT_FALSE(contains(written, "glColor4f"));
}

}  // namespace
}  // namespace evalcts
