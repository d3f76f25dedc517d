// Tests random programs: how they are made, judged, reduced and stored.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/known_programs.h>
#include <evalcts/fuzz/normal_form.h>
#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/files.h>
#include <evalcts/results/hash.h>
#include <evalcts/results/json.h>
#include "altered.h"
#include "fuzz/legal.h"
#include "fuzz/reducer.h"
#include "fuzz/shrink.h"
#include "program.h"

namespace evalcts::fuzz {
namespace {

using nlohmann::json;

constexpr int kMaxOrder = 30, kLength = 120;

std::string text_of(const gl::Case& program) {
  std::string text;
  for (const gl::Command& command : program.commands()) text += gl::to_c(command) + "\n";
  return text;
}

bool has(const gl::Case& program, gl::EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}

gl::Case small_curve() {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLfloat>{0, 0, 0, 1, 2, 3});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  return c;
}

// --- programs ---------------------------------------------------------------------------------------------

TEST(RandomProgram, IsTheSameForTheSameSeedOnEveryMachine) {
  const auto program = [](std::uint32_t seed, std::uint32_t number) {
    return text_of(random_program(seed, number, kLength, kMaxOrder));
  };
  EXPECT_EQ(program(3, 7), program(3, 7));
  EXPECT_NE(program(3, 7), program(3, 8));
  EXPECT_NE(program(3, 7), program(4, 7));
  EXPECT_EQ(fnv1a<std::uint64_t>(program(1, 0)), 8295766669054373899u)
      << "the programs of all seeds have changed: mean it";
}

TEST(RandomProgram, GoesEverywhereAndIsDefined) {
  std::map<gl::EntryPoint, int> times;
  for (std::uint32_t number = 0; number < 200; ++number) {
    const gl::Case program = random_program(1, number, kLength, kMaxOrder);
    ASSERT_TRUE(specify_if_defined(program, kMaxOrder)) << number;
    for (const gl::Command& command : program.commands()) ++times[command.entry];
  }
  using gl::EntryPoint;
  for (const EntryPoint entry :
       {EntryPoint::Map1f, EntryPoint::Map1d, EntryPoint::Map2f, EntryPoint::Map2d, EntryPoint::MapGrid1d,
        EntryPoint::MapGrid2f, EntryPoint::EvalCoord1dv, EntryPoint::EvalCoord2fv, EntryPoint::EvalPoint1,
        EntryPoint::EvalPoint2, EntryPoint::EvalMesh1, EntryPoint::EvalMesh2, EntryPoint::GetMapdv,
        EntryPoint::CallList, EntryPoint::PushAttrib, EntryPoint::PopAttrib, EntryPoint::ActiveTexture,
        EntryPoint::Vertex3f})
    EXPECT_GT(times[entry], 5) << gl::name_of(entry);
}

// Programs must leave out kinds of commands, because otherwise the bug that shows most easily
// hides the others.
TEST(RandomProgram, LeavesPartsOut) {
  using gl::EntryPoint;
  int without_lists = 0, without_surfaces = 0, errors_from_lists = 0;
  for (std::uint32_t number = 0; number < 100; ++number) {
    const auto [program, specified] = random_specified_program(1, number, kLength, kMaxOrder);
    without_lists += !has(program, EntryPoint::NewList);
    without_surfaces += !has(program, EntryPoint::EvalCoord2f) && !has(program, EntryPoint::EvalMesh2);
    for (std::size_t i = 0; i < program.commands().size(); ++i)
      errors_from_lists +=
          program.commands()[i].entry == EntryPoint::CallList && !specified.errors[i].empty();
  }
  EXPECT_GT(without_lists, 20);
  EXPECT_LT(without_lists, 80);
  EXPECT_GT(without_surfaces, 10);
  EXPECT_GT(errors_from_lists, 0);
}

TEST(RandomPast, DrawsPointsAndLeavesNothingOpen) {
  const std::unique_ptr<Implementation> specification = open_implementation({.name = "reference"});
  for (std::uint32_t number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    gl::Case c = random_past(1, number, kLength, kMaxOrder);
    for (const reference::Primitive& primitive : predict(c, kMaxOrder).primitives)
      EXPECT_EQ(primitive.mode, GLenum{GL_POINTS});
    const gl::Ref left = c.GetError();
    const gl::Ref list = c.GetIntegerv(GL_LIST_INDEX, gl::out<GLint>(1));
    const gl::Ref depth = c.GetIntegerv(GL_ATTRIB_STACK_DEPTH, gl::out<GLint>(1));
    const gl::Ref unit = c.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
    const gl::Ref error = c.GetError();  // GL_INVALID_OPERATION between Begin and End
    const gl::Trace trace = specification->create_context()->play(c);
    EXPECT_EQ(trace.error(left), GLenum{GL_NO_ERROR});
    EXPECT_EQ(trace.values<GLint>(list)[0], 0);
    EXPECT_EQ(trace.values<GLint>(depth)[0], 0);
    EXPECT_EQ(trace.values<GLint>(unit)[0], GL_TEXTURE0);
    EXPECT_EQ(trace.error(error), GLenum{GL_NO_ERROR});
  }
}

TEST(IsDefined, TellsWhatTheSpecificationLeavesOpen) {
  EXPECT_TRUE(specify_if_defined(small_curve(), kMaxOrder));
  gl::Case outside;
  outside.EvalCoord1f(0);
  EXPECT_FALSE(specify_if_defined(outside, kMaxOrder));
  gl::Case open = small_curve();
  open.Begin(GL_POINTS);
  EXPECT_FALSE(specify_if_defined(open, kMaxOrder));
  gl::Case two_mistakes;
  two_mistakes.Map1f(GL_MAP1_VERTEX_3, 0, 0, 3, 0, std::vector<GLfloat>(6));
  two_mistakes.GetError();
  EXPECT_TRUE(specify_if_defined(two_mistakes, kMaxOrder)) << "both are INVALID_VALUE";
  two_mistakes.Map1f(GL_COEFF, 0, 0, 3, 0, std::vector<GLfloat>(6));
  two_mistakes.GetError();
  EXPECT_TRUE(specify_if_defined(two_mistakes, kMaxOrder)) << "INVALID_ENUM or INVALID_VALUE";
  gl::Case mistakes_in_a_list;
  mistakes_in_a_list.NewList(1, GL_COMPILE);
  mistakes_in_a_list.EvalMesh1(GL_FILL, 0, 1);
  mistakes_in_a_list.End();
  mistakes_in_a_list.EndList();
  EXPECT_TRUE(specify_if_defined(mistakes_in_a_list, kMaxOrder));
  mistakes_in_a_list.CallList(1);
  mistakes_in_a_list.GetError();
  EXPECT_FALSE(specify_if_defined(mistakes_in_a_list, kMaxOrder)) << "a library may keep both codes";
  gl::Case unasked;
  unasked.EvalMesh1(GL_FILL, 0, 1);
  EXPECT_FALSE(specify_if_defined(unasked, kMaxOrder));
  gl::Case other_commands;
  other_commands.PixelStorei(GL_PACK_ALIGNMENT, 1);
  EXPECT_FALSE(specify_if_defined(other_commands, kMaxOrder));
  gl::Case in_list;
  in_list.NewList(1, GL_COMPILE);
  in_list.EvalCoord1f(0);
  in_list.EndList();
  EXPECT_TRUE(specify_if_defined(in_list, kMaxOrder));
  in_list.CallList(1);
  EXPECT_FALSE(specify_if_defined(in_list, kMaxOrder));
  gl::Case nameless;
  nameless.CallList(0);
  EXPECT_FALSE(specify_if_defined(nameless, kMaxOrder));
}

// --- JSON -------------------------------------------------------------------------------------------------

TEST(CaseJson, ComesBackTheSame) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    const gl::Case program = random_program(2, number, kLength, kMaxOrder);
    EXPECT_EQ(text_of(gl::case_from_json(parse_json(gl::to_json(program).dump()))), text_of(program))
        << number;
  }
}

// Programs with arrays that are overwritten, unmapped or protected after the call, or that share their
// memory.
TEST(CaseJson, KeepsTheTreatmentOfArraysAndTheirSlots) {
  gl::Case program;
  for (const gl::AfterCall after :
       {gl::AfterCall::kKeep, gl::AfterCall::kOverwrite, gl::AfterCall::kUnmap, gl::AfterCall::kProtect}) {
    gl::Input points = gl::array<float>({5}, after);
    if (after == gl::AfterCall::kKeep) points.slot = 3;
    program.Map1f(GL_MAP1_INDEX, 0, 1, 1, 1, points);
  }
  const gl::Case read = gl::parse_case(gl::to_text(program));
  ASSERT_EQ(read.commands().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& wanted = std::get<gl::Input>(program.commands()[i].arguments[5]);
    const auto& got = std::get<gl::Input>(read.commands()[i].arguments[5]);
    EXPECT_EQ(got.bytes, wanted.bytes);
    EXPECT_EQ(got.after, wanted.after);
    EXPECT_EQ(got.slot, wanted.slot);
  }
}

TEST(CaseJson, SaysWhatIsWrong) {
  const auto read = [](const char* text) { return gl::case_from_json(parse_json(text)); };
  for (const char* wrong : {"{}",
                            "[[]]",
                            "[[1]]",
                            R"([["NoSuchCommand"]])",
                            R"([["EvalCoord1f"]])",
                            R"([["EvalCoord1f", "x"]])",
                            R"([["Enable", "GL_NO_SUCH_TOKEN"]])",
                            R"([["Enable", 1.5]])",
                            R"([["EvalCoord1fv", [0.5]]])",
                            R"([["EvalCoord1fv", {"f99": [0.5]}]])",
                            R"([["EvalCoord1fv", {}]])",
                            R"([["EvalCoord1fv", {"after": "unmap"}]])",
                            R"([["EvalCoord1fv", {"f32": [0.5], "f64": [0.5]}]])",
                            R"([["EvalCoord1fv", {"f32": [0.5], "after": "gone"}]])",
                            R"([["EvalCoord1fv", {"f32": [0.5], "after": "unmap", "slot": 0}]])",
                            R"([["EvalCoord1fv", {"f32": [0.5], "slot": -1}]])",
                            R"([["EvalCoord1fv", {"f32": [0.5], "slot": 70000}]])",
                            R"([["EvalCoord1fv", {"f32": ["x"]}]])",
                            R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32"}]])",
                            R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": 4}]])",
                            R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": -1}]])",
                            R"([["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": 1000000000000}]])"})
    EXPECT_THROW(read(wrong), std::invalid_argument) << wrong;
  gl::Case strings;
  strings.ShaderSource(1, 1, gl::Strings{{"void main() {}"}}, nullptr);
  EXPECT_THROW(gl::to_json(strings), std::invalid_argument);
}

// --- reduction --------------------------------------------------------------------------------------------

TEST(Shrink, LeavesWhatMatters) {
  int asked = 0;
  const auto still = [&](const gl::Case& candidate) {
    ++asked;
    return specify_if_defined(candidate, kMaxOrder) && has(candidate, gl::EntryPoint::EvalCoord1d);
  };
  std::uint32_t number = 0;
  while (!has(random_program(1, number, kLength, kMaxOrder), gl::EntryPoint::EvalCoord1d)) ++number;
  const gl::Case small = shrink(random_program(1, number, kLength, kMaxOrder), still, 2000);
  EXPECT_LE(small.commands().size(), 5u) << text_of(small);
  EXPECT_TRUE(contains(text_of(small), "glEvalCoord1d(0.0)"));
  EXPECT_LT(asked, 2000);
}

TEST(Shrink, StopsWhenItMayNotAskAnyMore) {
  int asked = 0;
  const gl::Case program = random_program(1, 0, kLength, kMaxOrder);
  shrink(
      program, [&](const gl::Case&) { return ++asked % 3 == 0; }, 40);
  EXPECT_EQ(asked, 40);
}

TEST(Shrink, CutsOffWhatNoMapReads) {
  const auto points_left = [](GLint stride) {
    gl::Case c;
    c.Map1f(GL_MAP1_VERTEX_3, 0, 1, stride, 1, std::vector<GLfloat>(64, 1));
    const gl::Case shrunk = shrink(
        c, [](const gl::Case& candidate) { return has(candidate, gl::EntryPoint::Map1f); }, 100);
    return std::get<gl::Input>(shrunk.commands()[0].arguments[5]).bytes.size() / sizeof(GLfloat);
  };
  EXPECT_EQ(points_left(5), 3u);
  EXPECT_EQ(points_left(2), 64u) << "a rejected command may read anything";
}

// The dimension of an evaluated vertex after an EvalCoord2 without vertices distinguishes causes.
TEST(Shrink, ChangesTheDimensionOfWhatGoesTogether) {
  gl::Case c;
  c.EvalCoord2f(0, 0);
  c.Enable(GL_MAP2_VERTEX_3);
  c.EvalCoord2f(0, 0);
  const auto still = [](const gl::Case& candidate) {
    const std::string text = text_of(candidate);
    return text.starts_with("glEvalCoord2f") &&
           (text.find("glEnable(GL_MAP2_VERTEX_3);\nglEvalCoord2f") != std::string::npos ||
            text.find("glEnable(GL_MAP1_VERTEX_3);\nglEvalCoord1f") != std::string::npos);
  };
  EXPECT_TRUE(contains(text_of(shrink(c, still, 100)), "glEvalCoord1f"));
}

TEST(Shrink, FlushStandsForWhatElseFlushes) {
  gl::Case c;
  c.EvalMesh1(GL_POINT, 0, 0);
  c.NewList(1, GL_COMPILE);
  c.EndList();
  c.IsEnabled(GL_AUTO_NORMAL);
  const auto still = [](const gl::Case& candidate) {
    const std::string text = text_of(candidate);
    return text.starts_with("glEvalMesh1") && text.find("glIsEnabled") != std::string::npos &&
           (text.find("glNewList") < text.find("glEndList") || text.find("glFlush") != std::string::npos);
  };
  EXPECT_EQ(text_of(shrink(c, still, 100)),
            "glEvalMesh1(GL_POINT, 0, 0);\nglFlush();\nglIsEnabled(GL_AUTO_NORMAL);\n");
}

TEST(Shrink, TakesAPrimitiveForAMesh) {
  gl::Case c;
  c.EvalMesh2(GL_LINE, 0, 3, 0, 2);
  const auto still = [](const gl::Case& candidate) {
    return text_of(candidate).find("glEval") != std::string::npos && specify_if_defined(candidate, kMaxOrder);
  };
  EXPECT_EQ(text_of(shrink(c, still, 100)), "glBegin(GL_POINTS);\nglEvalCoord1f(0.0f);\nglEnd();\n");
}

TEST(Shrink, TakesListsAwayTogetherWithTheirCalls) {
  gl::Case c;
  c.NewList(7, GL_COMPILE);
  c.EvalPoint1(1);
  c.EndList();
  c.CallList(7);
  const auto still = [](const gl::Case& candidate) {
    const std::string text = text_of(candidate);
    const bool has_list = contains(text, "glNewList");
    return contains(text, "glEvalPoint1") && contains(text, "glEndList") == has_list &&
           contains(text, "glCallList") == has_list;
  };
  EXPECT_EQ(text_of(shrink(c, still, 100)), "glEvalPoint1(0);\n");
}

// --- names ------------------------------------------------------------------------------------------------

std::string requirement_of(const gl::Case& program, const Difference& difference) {
  Finding finding{program, {}};
  finding.failure.difference = difference;
  name_finding(finding, kMaxOrder);
  return finding.requirement;
}

TEST(Requirement, IsThatOfTheCommandsAndOfTheDifference) {
  const Difference position = {"position", "", "far"}, color = {"color", Difference::kEvaluatedVertex, ""},
                   answer = {Difference::kAnswer, "Get", ""}, crash = {Difference::kCrash, "", ""};
  EXPECT_EQ(requirement_of(small_curve(), position), "EV-COORD-ASIF");
  gl::Case normals = small_curve();
  normals.Enable(GL_AUTO_NORMAL);
  EXPECT_EQ(requirement_of(normals, position), "EV-AUTON-SAMEVERTEX");
  normals.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
  EXPECT_EQ(requirement_of(normals, answer), "EV-AUTON-CURRENT");
  gl::Case given = small_curve();
  given.Vertex3f(0, 0, 0);
  EXPECT_EQ(requirement_of(small_curve(), color), "EV-COORD-CURRENT");
  EXPECT_EQ(requirement_of(given, color), "EV-CUR-NEXTVERTEX");
  gl::Case without_vertices;
  without_vertices.EvalCoord2f(0, 0);
  EXPECT_EQ(requirement_of(without_vertices, answer), "EV-COORD-NOVERTEX");
  without_vertices.Enable(GL_AUTO_NORMAL);
  EXPECT_EQ(requirement_of(without_vertices, answer), "EV-AUTON-NOVERTEX");
  gl::Case list;
  list.NewList(1, GL_COMPILE);
  list.EndList();
  EXPECT_EQ(requirement_of(list, crash), "EV-DL-EXECUTE");
  EXPECT_EQ(requirement_of(list, {Difference::kError, "", ""}), "EV-DL-ERR-ALL");
  gl::Case nested;
  nested.NewList(1, GL_COMPILE);
  nested.CallList(2);
  nested.EndList();
  EXPECT_EQ(requirement_of(nested, crash), "EV-DL-NESTED");
}

gl::Case program_of(std::initializer_list<gl::Command> commands) {
  gl::Case program;
  for (const gl::Command& command : commands) program.add(command);
  return program;
}

// A known program does not explain a difference that only part of its commands, or other commands, show.
TEST(KnownProgram, ExplainsWhatNeedsAllItsCommands) {
  gl::Case program = small_curve();
  program.NewList(1, GL_COMPILE);
  program.EndList();
  program.EvalMesh1(GL_POINT, 0, 0);
  const Specified specified = specify(program, kMaxOrder);
  const auto by_evaluation = [](const gl::Case& candidate) {
    return has(candidate, gl::EntryPoint::EvalCoord1f);
  };
  const auto by_both = [&](const gl::Case& candidate) {
    return by_evaluation(candidate) && has(candidate, gl::EntryPoint::NewList);
  };
  const gl::Case evaluation = program_of({{gl::EntryPoint::EvalCoord1d, {0.5}}}),
                 both = program_of({{gl::EntryPoint::EvalCoord1d, {0.5}},
                                    {gl::EntryPoint::NewList, {std::int64_t{1}, std::int64_t{GL_COMPILE}}}}),
                 other = program_of(
                     {{gl::EntryPoint::EvalCoord1d, {0.5}}, {gl::EntryPoint::EvalCoord2f, {0.5f, 0.5f}}});
  EXPECT_TRUE(is_explained_by(evaluation, program, specified, by_evaluation));
  EXPECT_FALSE(is_explained_by(both, program, specified, by_evaluation));
  EXPECT_TRUE(is_explained_by(both, program, specified, by_both));
  EXPECT_FALSE(is_explained_by(evaluation, program, specified, by_both));
  EXPECT_FALSE(is_explained_by(other, program, specified, by_evaluation));
}

// --- judging ----------------------------------------------------------------------------------------------

struct CampaignResult {
  std::vector<Finding> findings;
  std::uint64_t programs = 0, commands = 0;
};

CampaignResult run_campaign(Implementation& implementation, std::uint32_t programs) {
  const CapturedSubject subject(implementation);
  CampaignResult result;
  const auto judge = campaign(subject, [&](const CampaignEvent& event) {
    if (const auto* made = std::get_if<FindingMade>(&event)) result.findings.push_back(made->finding);
    if (const auto* judged = std::get_if<ProgramJudged>(&event)) {
      ++result.programs;
      result.commands += judged->commands;
    }
  });
  for (std::uint32_t number = 0; number < programs; ++number) judge({.number = number, .length = 60});
  return result;
}

TEST(Campaign, FindsNothingInASoundEvaluator) {
  Altered unaltered(nullptr);
  const CampaignResult result = run_campaign(unaltered, 40);
  EXPECT_EQ(result.programs, 40u);
  EXPECT_GT(result.commands, 40u * 60);
  for (const Finding& finding : result.findings) ADD_FAILURE() << to_text(finding);
}

// EvalCoord2d exchanges its arguments, which is a bug of one form of a command.
TEST(Campaign, FindsADefectAndMakesItSmall) {
  Altered altered([](gl::Table& table) {
    table.EvalCoord2d = [](GLdouble u, GLdouble v) { Altered::original.EvalCoord2d(v, u); };
  });
  const CampaignResult result = run_campaign(altered, 40);
  ASSERT_FALSE(result.findings.empty());
  const Finding& finding = result.findings.front();
  const gl::Case& program = finding.program;
  EXPECT_LE(program.commands().size(), 5u) << text_of(program);
  EXPECT_TRUE(has(program, gl::EntryPoint::EvalCoord2d)) << text_of(program);
  EXPECT_EQ(finding.title, "EvalCoord gives a wrong position");
}

// Color4f is also wrong with explicit commands, so it is no difference of evaluators.
TEST(Campaign, LeavesOutWhatExplicitCommandsShowAsWell) {
  Altered altered([](gl::Table& table) {
    table.Color4f = [](GLfloat r, GLfloat g, GLfloat b, GLfloat a) { Altered::original.Color4f(g, r, b, a); };
  });
  for (const Finding& finding : run_campaign(altered, 800).findings) ADD_FAILURE() << to_text(finding);
}

// A campaign shows a known bug by its own program, not by commands of the random program.
TEST(Campaign, ShowsTheProgramOfAKnownBug) {
  static bool has_grid;
  Altered altered([](gl::Table& table) {
    has_grid = false;
    table.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
      has_grid = true;
      Altered::original.MapGrid1f(n, u1, u2);
    };
    table.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
      has_grid = true;
      Altered::original.MapGrid1d(n, u1, u2);
    };
    table.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
      if (!has_grid) Altered::original.MapGrid1f(1, 0.5f, 2);
      Altered::original.EvalMesh1(mode, i1, i2);
      if (!has_grid) Altered::original.MapGrid1f(1, 0, 1);
    };
  });
  const auto known = std::ranges::find(known_programs(), "mesa-initial-grid", &KnownProgram::bug);
  ASSERT_NE(known, known_programs().end());
  const std::vector<Finding> findings = run_campaign(altered, 400).findings;
  const auto first = std::ranges::find(findings, known->bug, &Finding::known);
  ASSERT_NE(first, findings.end());
  EXPECT_EQ(text_of(first->program), text_of(known->program));
}

// The difference is in an answer, not in a vertex.
TEST(Campaign, FindsAWrongAnswer) {
  Altered altered([](gl::Table& table) {
    table.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
      Altered::original.MapGrid1f(n < 1 ? 1 : n, u1, u2);
    };
  });
  const CampaignResult result = run_campaign(altered, 400);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(result.findings.front().cause, "missing error; MapGrid");
}

// --- the command ------------------------------------------------------------------------------------------

class FuzzCommand : public ProgramTest {
 protected:
  Outcome fuzz(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"fuzz", "--output", folder_.string()});
    return evalcts(arguments);
  }
  Outcome fuzz_drill(const char* drill, std::vector<std::string> more = {}) {
    setenv("EVALCTS_DRILL", drill, 1);
    more.insert(more.end(), {"--implementation", "osmesa", "--library", DRILL_LIBRARY, "--programs", "150",
                             "--allow-unobserved"});
    return fuzz(more);
  }
  json finding(int number = 1) const {
    return parse_json(read_file(folder_ / ("fuzz-osmesa-" + std::to_string(number) + ".json")));
  }
};

TEST_F(FuzzCommand, SaysWhatItNeeds) {
  EXPECT_EQ(fuzz({}).code, 2);
  EXPECT_EQ(fuzz({"--implementation", "no-such-implementation", "--programs", "1"}).code, 2);
  EXPECT_EQ(fuzz({"--library", "/no/such/library.so", "--programs", "1"}).code, 2);
}

// The drill library does not provide most commands.
TEST_F(FuzzCommand, LittleThatIsObservedIsNoPass) {
  setenv("EVALCTS_DRILL", "nothing", 1);
  std::vector<std::string> arguments = {"--implementation", "osmesa",     "--library",
                                        DRILL_LIBRARY,      "--programs", "40"};
  const Outcome outcome = fuzz(arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, "of 40 programs could be observed, which is not a pass"))
      << outcome.text;
  arguments.emplace_back("--allow-unobserved");
  EXPECT_EQ(fuzz(arguments).code, 0);
}

TEST_F(FuzzCommand, ProductionHoldsOut) {
  // Files of an earlier search are removed; files with similar names are kept.
  for (const char* file : {"fuzz-production-1.json", "fuzz-production-1.c", "fuzz-production-old-1.json"})
    std::ofstream(folder_ / file) << "{}";
  const Outcome outcome = fuzz({"--implementation", "production", "--programs", "40", "--seed", "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "seed 5: 40 programs (40 judged, 40 of them in full)"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fuzz-production-1.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fuzz-production-1.c"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fuzz-production-old-1.json"));
}

// llvmpipe below loses vertices behind primitives without vertices, with explicit vertices as well.
TEST_F(FuzzCommand, TheDropInLibraryHoldsOut) {
  const bool has_osmesa = dlopen("libOSMesa.so.8", RTLD_LAZY) != nullptr;
  if (!has_osmesa && !dlopen("libEGL.so.1", RTLD_LAZY)) GTEST_SKIP() << "neither OSMesa nor EGL here";
  const Outcome outcome =
      fuzz({"--implementation", has_osmesa ? "dropin" : "dropin-egl", "--programs", "400"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "seed 1: 400 programs"));
}

// Programs for a sink contain only commands and targets that it declares.
TEST_F(FuzzCommand, SinkOfOneTargetIsSearched) {
  const Outcome right = fuzz({"--library", SMALLEST_SINK, "--programs", "300"});
  EXPECT_EQ(right.code, 0) << right.text;
  const Outcome wrong = fuzz({"--library", WRONG_SINK, "--programs", "300"});
  EXPECT_EQ(wrong.code, 1) << wrong.text;
}

// The library crashes during the reduction of a wrong answer. Both the crash and the wrong
// answer become findings.
TEST_F(FuzzCommand, ACrashOnTheWayToAWrongAnswerIsAFinding) {
  const Outcome outcome = fuzz_drill("fragile");
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "150 programs"));
  const json crash = finding(1), answer = finding(2);
  ASSERT_TRUE(crash.is_object() && answer.is_object()) << outcome.text;
  EXPECT_EQ(as_text(crash["cause"]), "crash; Map");
  EXPECT_EQ(crash["program"].size(), 2u) << crash["program"];
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fuzz-osmesa-1.c")) << "a C program";
  EXPECT_EQ(as_text(answer["cause"]), "missing error; Enable, Map; stride too small");
  EXPECT_EQ(answer["program"].size(), 3u) << answer["program"];
}

TEST_F(FuzzCommand, AWrongAnswerIsMadeSmall) {
  const Outcome outcome = fuzz_drill("lenient");
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  ASSERT_TRUE(finding().is_object()) << outcome.text;
  EXPECT_EQ(as_text(finding()["what"]), "glGetError");
  EXPECT_EQ(finding()["program"].size(), 2u) << finding()["program"];
}

// Most programs share a context. A difference that depends on several programs is found, and reduced in a
// fresh context.
TEST_F(FuzzCommand, WhatDependsOnHistoryIsFound) {
  const Outcome outcome = fuzz_drill("worn", {"--jobs", "1"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  ASSERT_TRUE(finding().is_object()) << outcome.text;
  EXPECT_TRUE(finding()["cause"].get<std::string>().starts_with("answer of IsEnabled")) << finding()["cause"];
  EXPECT_GT(finding()["program"].size(), 90u);
  EXPECT_EQ(fuzz_drill("worn", {"--fresh-contexts"}).code, 0);
}

// A difference that needs hundreds of primitives is not reproduced by nine programs, so it is not a finding.
TEST_F(FuzzCommand, WhatAFreshContextDoesNotRepeatIsNoFinding) {
  const Outcome outcome = fuzz_drill("worn-out", {"--jobs", "1"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "differed in a shared context only"));
}

}  // namespace
}  // namespace evalcts::fuzz
