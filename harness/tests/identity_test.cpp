// Tests that a reduction keeps the identity of its difference, and that a bug is called known only if its own
// program fails in the same way: production with wrong entry points shows each case.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include <evalcts/fuzz/normal_form.h>
#include <evalcts/fuzz/reduction.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/roles.h>
#include "altered.h"
#include "fuzz/death.h"
#include "fuzz/reducer.h"

namespace evalcts::fuzz {
namespace {

Reduction reduced_on(Implementation& implementation, const Difference& difference,
                     const std::string& commands) {
  const CapturedSubject subject(implementation);
  return case_reducer(subject)({"Test", difference, commands});
}

bool has(const gl::Case& program, gl::EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}

// The library has two bugs: the current colour is never answered, and a small stride raises no error.
void lose_colours_and_take_small_strides(gl::Table& table) {
  table.GetFloatv = [](GLenum name, GLfloat* values) {
    Altered::original.GetFloatv(name, values);
    if (name == GL_CURRENT_COLOR) values[0] = 0.125f;
  };
  table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    Altered::original.Map1f(target, u1, u2, std::max(stride, 3), order, points);
  };
}

// A program in which both show.
constexpr char kColourAndStride[] =
    R"([["Color4f", 1, 0.5, 0.5, 1], ["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": 4}],
    ["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["GetError"], ["Enable", "GL_MAP1_VERTEX_3"],
    ["Begin", "GL_POINTS"], ["EvalCoord1f", 0.5], ["End"],
    ["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": 4}]])";

TEST(Identity, AMissingErrorStaysAMissingError) {
  Altered altered(lose_colours_and_take_small_strides);
  const Reduction reduction =
      reduced_on(altered, {Difference::kError, "Map", "missing GL_INVALID_VALUE"}, kColourAndStride);
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->cause, "missing error; Map; stride too small");
  EXPECT_FALSE(has(reduction.minimal->program, gl::EntryPoint::GetFloatv));
}

// GetError is asked for behind another command than the one that raises no error.
TEST(Identity, AMissingErrorIsThatOfTheCommandThatHasToRaiseIt) {
  Altered altered(lose_colours_and_take_small_strides);
  const Reduction reduction = reduced_on(
      altered, {Difference::kError, "Map", "missing GL_INVALID_VALUE"},
      R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["MapGrid1f", 3, 0, 1], ["GetError"]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->cause, "missing error; Map; stride too small");
  EXPECT_FALSE(has(reduction.minimal->program, gl::EntryPoint::MapGrid1f));
}

// The library accepts wrong strides and orders, and ignores such maps. Reduction makes arguments 0, and an
// order of 0 breaks another rule.
TEST(Identity, AMissingErrorKeepsTheRuleThatIsBroken) {
  Altered altered([](gl::Table& table) {
    table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                     const GLfloat* points) {
      if (stride >= 3 && order >= 1) Altered::original.Map1f(target, u1, u2, stride, order, points);
    };
  });
  const auto cause_of = [&](const char* map) {
    const Difference missing = {Difference::kError, "Map", "missing GL_INVALID_VALUE"};
    const Reduction reduction = reduced_on(altered, missing, map);
    return reduction.minimal ? reduction.minimal->cause : reduction.why_not;
  };
  EXPECT_EQ(
      cause_of(R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 3, {"f32": [0, 0, 0, 1, 1, 1]}], ["GetError"]])"),
      "missing error; Map; stride too small");
  EXPECT_EQ(cause_of(R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 4, -2, {"f32": [0, 0, 0]}], ["GetError"]])"),
            "missing error; Map; order below 1");
}

// The library has two bugs: AUTO_NORMAL is ignored, and surfaces are evaluated at another u. A program that
// shows both is smaller with a normal map, which is then wrong as well, than with AUTO_NORMAL.
TEST(Identity, AnAutomaticNormalStaysOne) {
  Altered altered([](gl::Table& table) {
    table.Enable = [](GLenum cap) {
      Altered::original.Enable(cap);
      if (cap == GL_AUTO_NORMAL) Altered::original.Disable(cap);
    };
    table.EvalCoord2f = [](GLfloat u, GLfloat v) { Altered::original.EvalCoord2f(u + 0.25f, v); };
  });
  const std::string
      maps =
          R"(["Map2f", "GL_MAP2_VERTEX_3", 0, 1, 3, 2, 0, 1, 6, 2, {"f32": [0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1]}],
      ["Map2f", "GL_MAP2_NORMAL", 0, 1, 3, 2, 0, 1, 6, 1, {"f32": [0, 1, 0, 0, 0, 1]}],
      ["Enable", "GL_MAP2_VERTEX_3"], ["Enable", "GL_MAP2_NORMAL"], )",
      vertex = R"(["Begin", "GL_POINTS"], ["EvalCoord2f", 0.5, 0.5], ["End"])";
  const std::string both = "[" + maps + R"(["Enable", "GL_AUTO_NORMAL"], )" + vertex +
                           R"(, ["Disable", "GL_AUTO_NORMAL"], )" + vertex + "]";
  const Reduction automatic = reduced_on(altered, {"normal", Difference::kAutomaticNormal, ""}, both);
  ASSERT_TRUE(automatic.minimal) << automatic.why_not;
  EXPECT_EQ(automatic.minimal->cause, "evaluated normal; EvalCoord; AUTO_NORMAL");
  EXPECT_EQ(automatic.minimal->requirement, "EV-AUTON-CURVED");
  EXPECT_FALSE(has(automatic.minimal->program, gl::EntryPoint::EvalCoord1f));
}

// The library draws nothing from maps of order 3, and nothing from maps that are not defined. Without its
// Map, a program that shows the first bug shows the second.
TEST(Identity, AnEvaluatedMapStaysDefined) {
  static bool is_lost = true;
  Altered altered([](gl::Table& table) {
    is_lost = true;
    table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                     const GLfloat* points) {
      is_lost = order == 3;
      Altered::original.Map1f(target, u1, u2, stride, order, points);
    };
    table.EvalCoord1f = [](GLfloat u) {
      if (!is_lost) Altered::original.EvalCoord1f(u);
    };
  });
  const Reduction reduction =
      reduced_on(altered, {Difference::kVertices, "", "fewer"},
                 R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 3, 3, {"f32": [0, 0, 0, 1, 1, 1, 2, 0, 0]}],
      ["Enable", "GL_MAP1_VERTEX_3"], ["Begin", "GL_POINTS"], ["EvalCoord1f", 0.5], ["End"]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_TRUE(has(reduction.minimal->program, gl::EntryPoint::Map1f));
}

// Several errors are permitted for a command that is wrong in two ways.
TEST(Identity, AMissingErrorMayBeOneOfSeveral) {
  Altered altered(
      [](gl::Table& table) { table.Map1f = [](GLenum, GLfloat, GLfloat, GLint, GLint, const GLfloat*) {}; });
  const Reduction reduction =
      reduced_on(altered, {Difference::kError, "Map", ""},
                 R"([["Map1f", "GL_AUTO_NORMAL", 1, 1, 3, 1, {"f32": [0, 0, 0]}], ["GetError"]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->title, "Map raises no error, GL_INVALID_ENUM or GL_INVALID_VALUE is due");
}

// A vertex map that is disabled again is no vertex map.
TEST(Identity, AnEvaluationBehindDisableHasNoVertexMap) {
  Altered altered([](gl::Table& table) { table.Disable = [](GLenum) {}; });
  const Reduction reduction =
      reduced_on(altered, {Difference::kVertices, "", "more"},
                 R"([["Enable", "GL_MAP1_VERTEX_3"], ["Disable", "GL_MAP1_VERTEX_3"], ["Begin", "GL_POINTS"],
      ["EvalCoord1f", 0.5], ["End"]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->title, "An evaluation without a vertex map draws too many vertices");
  EXPECT_EQ(reduction.minimal->requirement, "EV-COORD-NOVERTEX");
}

// Explicit commands show a wrong current colour as well, so it is no difference of evaluators.
TEST(Identity, WhatExplicitCommandsShowIsNoDifferenceOfEvaluators) {
  Altered altered(lose_colours_and_take_small_strides);
  const Reduction reduction =
      reduced_on(altered, {Difference::kAnswer, "Get GL_CURRENT_COLOR", ""}, kColourAndStride);
  EXPECT_FALSE(reduction.minimal) << reduction.minimal->title;
}

// The specification does not have FOG_MODE. The other wrong answer of the program is another difference.
TEST(Identity, AnUnknownQueryIsNotReducedToAnotherOne) {
  Altered altered([](gl::Table& table) {
    table.IsEnabled = [](GLenum cap) -> GLboolean { return !Altered::original.IsEnabled(cap); };
  });
  const std::string program =
      R"([["GetIntegerv", "GL_FOG_MODE", {"out": "i32", "count": 1}], ["IsEnabled", "GL_MAP1_INDEX"]])";
  EXPECT_FALSE(reduced_on(altered, {Difference::kAnswer, "Get GL_FOG_MODE", "far"}, program).minimal);
  const Reduction other =
      reduced_on(altered, {Difference::kAnswer, "IsEnabled GL_MAP_INDEX", "far"}, program);
  ASSERT_TRUE(other.minimal);
  EXPECT_EQ(other.minimal->program.commands().size(), 1u);
}

constexpr char kEffectOfSmallStride[] =
    R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 3, 1, {"f32": [1, 0, 0]}],
    ["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["GetError"], ["Enable", "GL_MAP1_VERTEX_3"],
    ["Begin", "GL_POINTS"], ["EvalCoord1f", 0.5], ["End"]])";

// A title must not say that a command is rejected if it raises no error.
TEST(Identity, AnEffectOfACommandThatIsNotRejectedIsItsMissingError) {
  Altered accepting([](gl::Table& table) {
    table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                     const GLfloat* points) {
      Altered::original.Map1f(target, u1, u2, std::max(stride, 3), order, points);
    };
  });
  const Difference position = {"position", "", "far"};
  const Reduction accepted = reduced_on(accepting, position, kEffectOfSmallStride);
  ASSERT_TRUE(accepted.minimal) << accepted.why_not;
  EXPECT_EQ(accepted.minimal->title, "Map (stride too small) raises no error, GL_INVALID_VALUE is due");

  Altered rejecting([](gl::Table& table) {
    table.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                     const GLfloat* points) {
      Altered::original.Map1f(target, u1, u2, stride, order, points);
      if (stride < 3) Altered::original.Map1f(target, u1, u2, 3, order, points);
    };
  });
  const Reduction rejected = reduced_on(rejecting, position, kEffectOfSmallStride);
  ASSERT_TRUE(rejected.minimal) << rejected.why_not;
  EXPECT_EQ(rejected.minimal->title, "Map is rejected with GL_INVALID_VALUE and has an effect nevertheless");
}

// A mesh that is drawn as strips of triangles is not said to have another order only.
TEST(Identity, AFilledMeshOfLinesDrawsOtherPrimitives) {
  Altered altered([](gl::Table& table) {
    table.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
      if (mode != GL_FILL) return Altered::original.EvalMesh2(mode, i1, i2, j1, j2);
      for (GLint j = j1; j < j2; ++j) {
        Altered::original.Begin(GL_LINE_STRIP);
        for (GLint i = i1; i <= i2; ++i) {
          Altered::original.EvalPoint2(i, j);
          Altered::original.EvalPoint2(i, j + 1);
        }
        Altered::original.End();
      }
    };
  });
  const Reduction reduction = reduced_on(
      altered, {Difference::kVertices, "", ""},
      R"([["Map2f", "GL_MAP2_VERTEX_3", 0, 1, 3, 2, 0, 1, 6, 2, {"f32": [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]}],
      ["Enable", "GL_MAP2_VERTEX_3"], ["MapGrid2f", 2, 0, 1, 2, 0, 1], ["EvalMesh2", "GL_FILL", 0, 2, 0, 2]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->title, "EvalMesh draws other vertices or primitives than it has to");
}

// --- known bugs

constexpr char kLargeCoefficient[] =
    R"([["Map1f", "GL_MAP1_INDEX", 0, 1, 1, 1, {"f32": [3e9]}],
    ["GetMapiv", "GL_MAP1_INDEX", "GL_COEFF", {"out": "i32", "count": 1}]])";
constexpr char kSmallCoefficient[] =
    R"([["Map1f", "GL_MAP1_INDEX", 0, 1, 1, 1, {"f32": [7]}],
    ["GetMapiv", "GL_MAP1_INDEX", "GL_COEFF", {"out": "i32", "count": 1}]])";

std::string known_on(Implementation& implementation, const std::string& relation,
                     const std::string& commands) {
  const Reduction reduction =
      reduced_on(implementation, {Difference::kAnswer, "GetMap GL_COEFF", relation}, commands);
  return reduction.minimal ? reduction.minimal->known : reduction.why_not;
}

void answer_the_lower_bits(gl::Table& table) {
  table.GetMapiv = [](GLenum target, GLenum query, GLint* values) {
    Altered::original.GetMapiv(target, query, values);
    GLdouble coefficient = 0;
    if (query != GL_COEFF) return;
    Altered::original.GetMapdv(target, query, &coefficient);
    *values = static_cast<GLint>(static_cast<GLuint>(static_cast<GLint64>(coefficient)));
  };
}

TEST(Known, IsABugWithTheCapturedValueOfItsProgram) {
  Altered lower_bits(answer_the_lower_bits);
  EXPECT_EQ(known_on(lower_bits, Difference::kSaturated, kLargeCoefficient), "mesa-getmap-saturation");
  Altered smallest([](gl::Table& table) {
    table.GetMapiv = [](GLenum target, GLenum query, GLint* values) {
      Altered::original.GetMapiv(target, query, values);
      if (query == GL_COEFF && *values == std::numeric_limits<GLint>::max())
        *values = std::numeric_limits<GLint>::min();
    };
  });
  EXPECT_EQ(known_on(smallest, Difference::kSaturated, kLargeCoefficient), "nvidia-getmap-saturation");
  Altered another([](gl::Table& table) {
    table.GetMapiv = [](GLenum target, GLenum query, GLint* values) {
      Altered::original.GetMapiv(target, query, values);
      if (query == GL_COEFF && *values == std::numeric_limits<GLint>::max()) *values = 17;
    };
  });
  EXPECT_EQ(known_on(another, Difference::kSaturated, kLargeCoefficient), "");
}

TEST(Known, IsNotDecidedAfterTheTimeIsOver) {
  Altered lower_bits(answer_the_lower_bits);
  const CapturedSubject subject(lower_bits);
  bool is_over = true;
  Reducer reducer(subject, nullptr, 100, {.is_over = [&] { return is_over; }});
  EXPECT_FALSE(reducer.prove("mesa-getmap-saturation"));
  is_over = false;
  EXPECT_TRUE(reducer.prove("mesa-getmap-saturation"));
}

TEST(Deaths, AreThoseOfTheProgramInFlight) {
  WorkerRun run;
  run.ending = {.signalled = true, .value = SIGSEGV};
  EXPECT_FALSE(death_of(run)) << "the library died before the program";
  run.in_flight = "program";
  EXPECT_EQ(death_of(run).value().kind, Difference::kCrash);
  run.hung = true;
  EXPECT_EQ(death_of(run).value().kind, Difference::kHang);
  run.hung = false;
  run.ending = {.signalled = false, .value = kOwnFault};
  EXPECT_FALSE(death_of(run)) << "the suite program has failed";
}

// The program of a known crash proves nothing if the library dies elsewhere, or does not say where.
TEST(Deaths, AreKnownOnlyAtTheSamePlace) {
  const gl::Case program = gl::parse_case(kLargeCoefficient);
  const Difference death{Difference::kCrash, "libGL.so end+0x7", ""};
  const auto known = [&](const Difference& of_all) {
    std::vector<Finding> seen;
    const std::optional<Finding> found = reduce_death(
        program, death, [&](const gl::Case&) { return std::optional(of_all); }, seen, 10, 8);
    return found ? found->known : "";
  };
  EXPECT_NE(known(death), "");
  EXPECT_EQ(known({Difference::kCrash, "", ""}), "");
  EXPECT_EQ(known({Difference::kCrash, "libGL.so begin+0x3", ""}), "");
}

TEST(NormalForm, KeepsWhatIsAskedFor) {
  const auto cause = [](const char* place) {
    Finding finding{gl::parse_case(kLargeCoefficient), {}};
    finding.failure.difference = {Difference::kAnswer, place, "far"};
    name_finding(finding, 8);
    return finding.cause;
  };
  EXPECT_NE(cause("GetMap GL_COEFF"), cause("GetMap GL_ORDER"));
}

// All coefficients are answered wrongly, large ones as well as others.
TEST(Known, IsNoBugWhoseProgramFailsForAnotherReason) {
  Altered altered([](gl::Table& table) {
    table.GetMapiv = [](GLenum target, GLenum query, GLint* values) {
      Altered::original.GetMapiv(target, query, values);
      if (query == GL_COEFF) *values = 0;
    };
  });
  EXPECT_EQ(known_on(altered, "far", kSmallCoefficient), "");
}

// The last row of each mesh is missing. The program of a known bug of lost vertices fails here, too, but so
// do its meshes alone.
TEST(Known, IsNoBugWhoseProgramFailsInParts) {
  Altered altered([](gl::Table& table) {
    table.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
      Altered::original.EvalMesh2(mode, i1, i2, j1, j2 - 1);
    };
  });
  const Reduction reduction = reduced_on(
      altered, {Difference::kVertices, "", "fewer"},
      R"([["Map2f", "GL_MAP2_VERTEX_3", 0, 1, 3, 2, 0, 1, 6, 2, {"f32": [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]}],
      ["Enable", "GL_MAP2_VERTEX_3"], ["MapGrid2f", 2, 0, 1, 2, 0, 1], ["EvalMesh2", "GL_POINT", 0, 2, 0, 2]])");
  ASSERT_TRUE(reduction.minimal) << reduction.why_not;
  EXPECT_EQ(reduction.minimal->known, "");
}

}  // namespace
}  // namespace evalcts::fuzz
