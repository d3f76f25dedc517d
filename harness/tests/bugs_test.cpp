// Tests that failing tests become distinct bugs: minimal programs, their normal form, grouping.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include <evalcts/fuzz/bugs.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/known_programs.h>
#include <evalcts/fuzz/normal_form.h>
#include <evalcts/fuzz/reduction.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/display_lists.h>
#include <evalcts/results/files.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include "altered.h"
#include "fuzz/legal.h"

namespace evalcts::fuzz {
namespace {

constexpr int kMaxOrder = 30;

// Returns the finding of a minimal program with a difference such as "position; ; far".
Finding finding(const std::string& program, const std::string& difference) {
  Finding made{gl::parse_case(program), {}};
  made.failure.what = difference;
  made.failure.difference = parse_difference(difference).value_or(Difference());
  name_finding(made, kMaxOrder);
  return made;
}

std::string cause_of_program(const std::string& program, const std::string& difference) {
  return finding(program, difference).cause;
}

// Returns a program with maps of a position and of `attribute`, which has `values` components, and with
// commands before Begin, between Begin and End, and after End.
std::string curve(const std::string& attribute, int values, const std::string& before,
                  const std::string& evaluation, const std::string& behind) {
  std::string points;
  for (int i = 0; i < values; ++i) points += i ? ", 0.5" : "0.5";
  return fmt::format(
      R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 3, 1, {{"f32": [0, 0, 0]}}], ["Map1d", "{0}", 0, 1, {1}, 1, {{"f64": [{2}]}}],
      ["Enable", "GL_MAP1_VERTEX_3"], ["Enable", "{0}"], {3} ["Begin", "GL_POINTS"], {4}, ["End"] {5}])",
      attribute, values, points, before, evaluation, behind);
}

TEST(NormalForm, LeavesOutHowAWrongCurrentValueWasNoticed) {
  const std::string cause = "current values after an evaluation";
  // The wrong value is noticed by a query, by the next vertex, by the next evaluated vertex, whose map is
  // off, and in two dimensions.
  EXPECT_EQ(cause_of_program(curve("GL_MAP1_COLOR_4", 4, "", R"(["EvalCoord1f", 0])",
                                   R"(, ["GetFloatv", "GL_CURRENT_COLOR", {"out": "f32", "count": 4}])"),
                             "answer; Get GL_CURRENT_COLOR; far"),
            cause);
  EXPECT_EQ(cause_of_program(curve("GL_MAP1_NORMAL", 3, "",
                                   R"(["EvalCoord1dv", {"f64": [0]}], ["Vertex3f", 0, 0, 0])", ""),
                             "normal; explicit vertex; "),
            cause);
  EXPECT_EQ(
      cause_of_program(
          curve(
              "GL_MAP1_TEXTURE_COORD_2", 2, "", R"(["EvalPoint1", 0])",
              R"(, ["Disable", "GL_MAP1_TEXTURE_COORD_2"], ["Begin", "GL_POINTS"], ["EvalCoord1f", 0], ["End"])"),
          "texture coordinate; evaluated vertex; "),
      cause);
  EXPECT_EQ(cause_of_program(R"([["Map2f", "GL_MAP2_VERTEX_3", 0, 1, 3, 1, 0, 1, 3, 1, {"f32": [0, 0, 0]}],
      ["Map2f", "GL_MAP2_NORMAL", 0, 1, 3, 1, 0, 1, 3, 1, {"f32": [1, 0, 0]}], ["Enable", "GL_MAP2_VERTEX_3"],
      ["Enable", "GL_MAP2_NORMAL"], ["EvalMesh2", "GL_POINT", 0, 0, 0, 0],
      ["GetFloatv", "GL_CURRENT_NORMAL", {"out": "f32", "count": 3}]])",
                             "answer; Get GL_CURRENT_NORMAL; far"),
            cause);
}

TEST(NormalForm, KeepsWhatMakesAnotherBug) {
  std::set<std::string> causes;
  const auto add = [&](const std::string& program, const std::string& difference) {
    const std::string cause = cause_of_program(program, difference);
    EXPECT_TRUE(causes.insert(cause).second) << cause;
  };
  const std::string vertex = R"(["EvalCoord1f", 0], ["Vertex3f", 0, 0, 0])";
  add(curve("GL_MAP1_NORMAL", 3, "", vertex, ""), "normal; explicit vertex; ");
  add(curve("GL_MAP1_NORMAL", 3, "", R"(["EvalCoord1f", 0])", ""),
      "color; evaluated vertex; ");  // without an earlier evaluation
  add(curve("GL_MAP1_NORMAL", 3, "", R"(["EvalCoord1f", 0])", ""), "normal; ; far");  // an evaluated value
  add(curve("GL_MAP1_NORMAL", 3, "", R"(["EvalCoord1f", 0])", ""), "position; ; far");
  add(R"([["Map1f", "GL_MAP1_NORMAL", 0, 1, 3, 1, {"f32": [1, 0, 0]}], ["Enable", "GL_MAP1_NORMAL"],
      ["Begin", "GL_POINTS"], ["EvalCoord1f", 0], ["Vertex3f", 0, 0, 0], ["End"]])",
      "normal; explicit vertex; ");  // without a vertex map
  for (const char* mode : {"GL_COMPILE", "GL_COMPILE_AND_EXECUTE"})
    add(curve("GL_MAP1_NORMAL", 3, fmt::format(R"(["NewList", 1, "{}"],)", mode), vertex,
              R"(, ["EndList"], ["CallList", 1])"),
        "normal; explicit vertex; ");
  add(R"([["Enable", "GL_MAP1_VERTEX_3"], ["EvalMesh1", "GL_POINT", 0, 1]])", "position; ; far");
  add(R"([["Enable", "GL_MAP1_VERTEX_3"], ["MapGrid1f", 3, 0, 1], ["EvalMesh1", "GL_POINT", 0, 1]])",
      "position; ; far");
  add(R"([["Enable", "GL_MAP1_VERTEX_3"], ["EvalMesh1", "GL_POINT", 0, 1]])", "vertices; ; more");
  const char* const rejected =
      R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["GetError"]])";
  add(rejected, "error; Map; missing GL_INVALID_VALUE");
  add(rejected, "error; Map; GL_INVALID_ENUM instead of GL_INVALID_VALUE");
  add(R"([["NewList", 1, "GL_COMPILE"], ["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["EndList"],
      ["CallList", 1], ["GetError"]])",
      "error; ; missing GL_INVALID_VALUE");
  add(R"([["GetMapiv", "GL_MAP1_INDEX", "GL_COEFF", {"out": "i32", "count": 1}]])",
      "answer; GetMap GL_COEFF; far");
  add(R"([["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 2, {"f32": [0, 0, 0]}], ["GetError"],
      ["GetMapiv", "GL_MAP1_VERTEX_3", "GL_ORDER", {"out": "i32", "count": 1}]])",
      "answer; GetMap GL_ORDER; far");  // the effect of a rejected command
  add(R"([["EvalMesh2", "GL_POINT", 0, 1, 0, 1]])", "order; ; ");
}

TEST(NormalForm, LeavesOutHowTheEffectOfARejectedCommandWasNoticed) {
  const std::string map = R"([["Enable", "GL_MAP1_VERTEX_3"], ["Enable", "GL_MAP1_COLOR_4"],
      ["Map1f", "GL_MAP1_COLOR_4", 0, 1, 2, 1, {"f32": [0, 0, 0, 0]}], ["GetError"])",
                    vertex = R"(, ["Begin", "GL_POINTS"], ["EvalCoord1f", 0], ["End"]])";
  const std::string cause = "effect of a rejected command; Map; GL_INVALID_VALUE";
  EXPECT_EQ(
      cause_of_program(map + R"(, ["GetMapiv", "GL_MAP1_COLOR_4", "GL_ORDER", {"out": "i32", "count": 1}]])",
                       "answer; GetMap GL_ORDER; far"),
      cause);
  EXPECT_EQ(cause_of_program(map + vertex, "color; ; far"), cause);
  EXPECT_EQ(cause_of_program(map + vertex, "vertices; ; more"), cause);
}

// The register has about 80 programs of about 20 bugs.
TEST(NormalForm, PutsTheKnownProgramsIntoFewGroups) {
  std::set<std::string> causes;
  for (const KnownProgram& known : known_programs()) causes.insert(known.cause(kMaxOrder));
  EXPECT_LE(causes.size(), 50u);
  EXPECT_GE(causes.size(), 20u);
}

TEST(KnownPrograms, AreShownByTheirDifferenceOnly) {
  const auto is_of_saturation = [](const KnownProgram& known) {
    return known.bug == "mesa-getmap-saturation";
  };
  const auto saturation = std::ranges::find_if(known_programs(), is_of_saturation);
  ASSERT_NE(saturation, known_programs().end());
  Failure failure;
  failure.difference = saturation->record.difference;
  failure.captured = saturation->record.captured;
  EXPECT_TRUE(saturation->is_shown_by(failure));
  failure.captured = "{-2147483648}";
  EXPECT_FALSE(saturation->is_shown_by(failure)) << "another value";
  failure.captured = saturation->record.captured;
  failure.difference.relation = "far";
  EXPECT_FALSE(saturation->is_shown_by(failure)) << "no value that is too large";
}

// --- grouping --------------------------------------------------------------------------------------------

TestRecord failing(const std::string& name, const std::string& requirement, const std::string& what = "x",
                   Verdict verdict = Verdict::kFail, Level level = Level::kMust) {
  TestRecord test;
  test.name = name;
  test.requirements = {requirement};
  test.verdict = verdict;
  test.level = level;
  Failure failure;
  failure.what = what;
  failure.difference.kind = kind_of(what);
  test.failures = {failure};
  return test;
}

constexpr char kMeshOverTheInitialGrid[] =
    R"([["Enable", "GL_MAP1_VERTEX_3"], ["EvalMesh1", "GL_POINT", 0, 1]])";
constexpr char kSameInTwoDimensions[] =
    R"([["Enable", "GL_MAP2_VERTEX_3"], ["EvalMesh2", "GL_POINT", 0, 1, 0, 0], ["Flush"]])";

TEST(Bugs, OneForEachNormalFormMostImportantFirst) {
  RunResult run;
  run.tests = {failing("Mesh1.A/x", "EV-MESH1-POINT"), failing("Mesh2.A/x", "EV-MESH2-POINT"),
               failing("GetMap.B", "EV-GETMAP-SATURATE"),
               failing("Lists.C", "EV-DL-NESTED", "", Verdict::kCrash),
               failing("Mesh1.D", "EV-MESH1-COORDS")};
  run.tests.push_back(failing("Fine.E", "EV-MAP1-COPY"));
  run.tests.back().verdict = Verdict::kPass;
  const std::map<std::string, Reduction> reductions = {
      {"Mesh1.A/x", {"Mesh1.A/x", finding(kMeshOverTheInitialGrid, "position; ; far"), ""}},
      {"Mesh2.A/x", {"Mesh2.A/x", finding(kSameInTwoDimensions, "position; ; far"), ""}},
      {"GetMap.B",
       {"GetMap.B",
        finding(R"([["GetMapiv", "GL_MAP1_INDEX", "GL_COEFF", {"out": "i32", "count": 1}]])",
                "answer; GetMap GL_COEFF; far"),
        ""}},
      {"Lists.C",
       {"Lists.C", finding(R"([["NewList", 1, "GL_COMPILE"], ["CallList", 2], ["EndList"]])", "crash; ; "),
        ""}},
      {"Mesh1.D", {"Mesh1.D", {}, "reason"}}};
  const std::vector<Bug> bugs = bugs_of(run, reductions, {});
  ASSERT_EQ(bugs.size(), 4u);
  EXPECT_EQ(bugs[0].tests, std::vector<std::string>{"Lists.C"});
  EXPECT_EQ(bugs[0].verdict, Verdict::kCrash);
  EXPECT_EQ(bugs[1].tests, (std::vector<std::string>{"Mesh1.A/x", "Mesh2.A/x"}));
  EXPECT_EQ(bugs[1].explains, (std::vector<RequirementId>{"EV-MESH1-POINT", "EV-MESH2-POINT"}));
  EXPECT_EQ(bugs[1].failure.calls.size(), 2u) << "the smaller program stands for both";
  EXPECT_TRUE(bugs[1].is_reduced());
  EXPECT_FALSE(bugs[1].title.empty());
  EXPECT_TRUE(bugs[1].id.starts_with(bugs[1].requirements.at(0).text() + "-")) << bugs[1].id;
  const auto unreduced = std::ranges::find(bugs, false, &Bug::is_reduced);
  ASSERT_NE(unreduced, bugs.end());
  EXPECT_EQ(unreduced->tests, std::vector<std::string>{"Mesh1.D"});
  EXPECT_EQ(unreduced->why_not_reduced, "reason");
  EXPECT_EQ(unreduced->commands, "");
  for (const Bug& bug : bugs) EXPECT_TRUE(catalogue().find(bug.requirements.at(0))) << bug.id;
}

TEST(Bugs, WhatIsNotReducedIsGroupedByLikeness) {
  RunResult run;
  run.tests = {failing("Mesh1.Last/LINE", "EV-MESH1-EXACT-N", "position.x of vertex 3"),
               failing("Mesh2.Last/FILL/Nested", "EV-MESH2-EXACT-N", "position.y of vertex 12"),
               failing("Mesh2.Last/POINT", "EV-MESH2-EXACT-N", "number of vertices"),
               failing("Mesh2.First/POINT", "EV-MESH2-EXACT-N", "position.y of vertex 12")};
  EXPECT_EQ(likeness_of(run.tests[0]), "Mesh.Last; EV-MESH-EXACT-N; position");
  std::map<std::string, Reduction> reductions;
  for (const TestRecord& test : run.tests) reductions[test.name] = {test.name, {}, "a picture"};
  std::vector<Bug> bugs = bugs_of(run, reductions, {});
  ASSERT_EQ(bugs.size(), 3u);
  EXPECT_EQ(bugs[0].tests, (std::vector<std::string>{"Mesh1.Last/LINE", "Mesh2.Last/FILL/Nested"}));
  EXPECT_EQ(bugs[0].why_not_reduced, "a picture");
  EXPECT_EQ(bugs[0].failure.what, "position.x of vertex 3");

  // Failures that were not reduced because time was over, or because the library died, join the bug of a
  // reduced failure with the same likeness_of().
  reductions["Mesh1.Last/LINE"] = {"Mesh1.Last/LINE", finding(kMeshOverTheInitialGrid, "position; ; far"),
                                   ""};
  bugs = bugs_of(run, reductions, {});
  EXPECT_EQ(bugs.size(), 4u) << "for another reason they do not";
  for (const char* why : {kOutOfTime, kDiedOnTheWay}) {
    reductions["Mesh2.Last/FILL/Nested"].why_not = why;
    bugs = bugs_of(run, reductions, {});
    ASSERT_EQ(bugs.size(), 3u) << why;
    EXPECT_EQ(bugs[0].tests.size(), 2u);
    EXPECT_TRUE(bugs[0].is_reduced());
  }
}

// A test belongs to a known bug if a program of this bug explains it here, or if the baseline names the bug
// and its program fails here.
TEST(Bugs, AreKnownOnlyWithAProof) {
  RunResult run;
  run.tests = {failing("GetMap.A/x", "EV-GETMAP-SATURATE")};
  const KnownBug* const saturation = find_known_bug("mesa-getmap-saturation");
  ASSERT_TRUE(saturation);
  Finding minimal = finding(R"([["GetMapiv", "GL_MAP1_INDEX", "GL_COEFF", {"out": "i32", "count": 1}]])",
                            "answer; GetMap GL_COEFF; saturated");
  const auto known = [&](const std::map<std::string, Reduction>& reductions, const Proofs& proofs) {
    return bugs_of(run, reductions, proofs).at(0).known;
  };
  EXPECT_EQ(known({{"GetMap.A/x", {"GetMap.A/x", minimal, ""}}}, {}), "");
  Finding proof = minimal;
  proof.known = saturation->id;
  EXPECT_EQ(known({{"GetMap.A/x", {"GetMap.A/x", proof, ""}}}, {}), saturation->id);
  run.tests[0].known_bugs = {saturation->id};
  EXPECT_EQ(known({}, {}), "") << "its program does not fail";
  EXPECT_EQ(known({}, {{saturation->id, proof}}), saturation->id);
  EXPECT_EQ(known({{"GetMap.A/x", {"GetMap.A/x", minimal, ""}}}, {{saturation->id, proof}}), "")
      << "the minimal program shows another bug";
  const Bug bug = bugs_of(run, {}, {{saturation->id, proof}}).at(0);
  EXPECT_EQ(bug.title, saturation->title);
  EXPECT_EQ(bug.known_in, "Mesa 20.3 to 26.2");
  EXPECT_EQ(bug.verdict, Verdict::kFail) << "nothing is excused";
  EXPECT_EQ(bug.commands, gl::to_text_if_possible(proof.program)) << "the program of the register";
}

// Tests that die at one place are one bug, whether they were reduced or not, and a known one only if the
// program of the known bug dies at the same place.
TEST(Bugs, DeathsAtOnePlaceAreOne) {
  RunResult run;
  const auto add = [&](const std::string& name, const std::string& requirement, Verdict verdict,
                       const std::string& call, const std::vector<std::string>& frames) {
    run.tests.push_back(failing(name, requirement, "", verdict));
    run.tests.back().crash = Crash{call, 0, frames};
  };
  add("Map1Errors.A", "EV-MAP1-COPY", Verdict::kCrash, "glMap1f(GL_MAP1_INDEX, ...)",
      {"libc.so.6+0x1", "libGL.so copy+0x2"});
  add("Map1State.B", "EV-MAP1-ERR-STRIDE", Verdict::kCrash, "glMap1f(GL_MAP1_NORMAL, ...)",
      {"libc.so.6+0x9", "libGL.so copy+0x2"});
  add("Lists.C", "EV-DL-NESTED", Verdict::kCrash, "glEndList()", {"libGL.so end+0x7"});
  add("Mesh2.D", "EV-MESH2-FILL", Verdict::kTimeout, "glEvalMesh2(GL_FILL, 0, 1, 0, 1)",
      {"libGL.so loop+0x1"});
  add("Points.E", "EV-MESH2-POINT", Verdict::kTimeout, "glEvalMesh2(GL_POINT, 0, 2, 0, 2)",
      {"libGL.so loop+0x5"});
  const std::map<std::string, Reduction> reductions = {
      {"Map1State.B",
       {"Map1State.B",
        finding(
            R"([["NewList", 1, "GL_COMPILE"], ["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}]])",
            "crash; ; "),
        ""}}};
  const auto titles = [&](const std::map<std::string, Reduction>& of) {
    std::set<std::string> all;
    for (const Bug& bug : bugs_of(run, of, {}))
      all.insert(fmt::format("{}: {}", bug.tests.size(), bug.title));
    return all;
  };
  EXPECT_EQ(titles(reductions), (std::set<std::string>{"2: glMap1f crashes in a display list",
                                                       "1: glEndList crashes", "2: glEvalMesh2 hangs"}));
  // The program of a known bug dies at the same place.
  const KnownBug* const nested = find_known_bug("mesa-list-nested-crash");
  ASSERT_TRUE(nested && nested->dies());
  std::map<std::string, Reduction> with_known = reductions;
  Finding death = finding(nested->programs.front().commands, "crash; libGL.so end+0x7; ");
  death.known = nested->id;
  with_known["Lists.C"] = {"Lists.C", death, ""};
  add("Lists.F", "EV-DL-NESTED", Verdict::kCrash, "glEndList()", {"libGL.so end+0x7"});
  EXPECT_EQ(titles(with_known), (std::set<std::string>{"2: glMap1f crashes in a display list",
                                                       "2: " + nested->title, "2: glEvalMesh2 hangs"}));
}

TEST(Bugs, WhatIsNotReducedBelongsToTheBugOfTheBaseline) {
  RunResult run;
  run.implementation.version = "4.5 (Compatibility Profile) Mesa 22.3.6";
  run.tests = {failing("Mesh1.A", "EV-MESH1-POINT"), failing("Mesh2.B", "EV-MESH2-FILL"),
               failing("Mesh2.C", "EV-MESH2-FILL")};
  for (TestRecord& test : run.tests) {
    test.expected_by_baseline = true;
    test.known_bugs = {"mesa-initial-grid"};
  }
  run.tests[2].known_bugs.clear();
  const Proofs proofs = {{"mesa-initial-grid", finding(kMeshOverTheInitialGrid, "position; ; far")}};
  std::vector<Bug> bugs = bugs_of(run, {}, proofs);
  ASSERT_EQ(bugs.size(), 2u);
  EXPECT_EQ(bugs[0].known, "mesa-initial-grid");
  EXPECT_EQ(bugs[0].tests, (std::vector<std::string>{"Mesh1.A", "Mesh2.B"}));
  EXPECT_EQ(bugs[0].title, find_known_bug("mesa-initial-grid")->title);
  EXPECT_EQ(bugs[1].known, "");
  run.tests[1].known_bugs.clear();
  EXPECT_EQ(bugs_of(run, {}, proofs).size(), 3u);
}

TEST(Bugs, ThatExplicitVerticesShowAsWellAreNotFailures) {
  RunResult run;
  for (const char* name : {"A.Shared", "B.OfBoth", "C.Known", "D.Own"}) {
    run.tests.emplace_back().name = name;
    run.tests.back().verdict = Verdict::kCrash;
  }
  const auto add = [&](const char* title, bool is_shared, std::vector<std::string> tests) {
    Bug& bug = run.bugs.emplace_back();
    bug.title = title;
    bug.outside_evaluators = is_shared;
    bug.tests = std::move(tests);
  };
  add("End crashes", true, {"A.Shared", "B.OfBoth"});
  add("known", true, {"C.Known"});
  run.bugs.back().known = "mesa-known";
  add("EvalMesh1 crashes", false, {"B.OfBoth", "D.Own"});
  set_aside_shared_bugs(run);
  ASSERT_EQ(run.bugs.size(), 2u);
  EXPECT_EQ(run.bugs[0].title, "known");
  EXPECT_EQ(run.tests[0].verdict, Verdict::kNotObservable);
  EXPECT_TRUE(run.tests[0].message.ends_with("End crashes")) << run.tests[0].message;
  for (std::size_t i = 1; i < run.tests.size(); ++i) EXPECT_EQ(run.tests[i].verdict, Verdict::kCrash) << i;
  EXPECT_EQ(run.counts[static_cast<std::size_t>(Verdict::kCrash)], 3u);
}

TEST(Bugs, OfRealProgramsAreMarked) {
  RunResult run;
  run.tests = {failing("RealPrograms.Teapot", "EV-MESH2-FILL")};
  EXPECT_TRUE(bugs_of(run, {}, {}).at(0).breaks_real_programs);
}

TEST(Reductions, GoThroughTheirText) {
  const Reduction reduction = {"A.b", finding(kMeshOverTheInitialGrid, "position; ; far"), ""};
  const std::optional<Reduction> read = parse_reduction(to_line(reduction));
  ASSERT_TRUE(read && read->minimal);
  EXPECT_EQ(read->test, "A.b");
  EXPECT_EQ(gl::to_text(read->minimal->program), gl::to_text(reduction.minimal->program));
  EXPECT_EQ(read->minimal->failure.difference.text(), "position; ; far");
  EXPECT_EQ(read->minimal->title, reduction.minimal->title);
  EXPECT_FALSE(parse_reduction(to_line(StillRunning())));
  EXPECT_FALSE(parse_reduction("{"));
  const FailingCase failing =
      parse_failing_case(to_text(FailingCase{"A.b", {"position", "", ""}, "[]", 1.5}));
  EXPECT_EQ(failing.commands, "[]");
  EXPECT_EQ(failing.difference.kind, "position");
  EXPECT_EQ(failing.seconds, 1.5);
  EXPECT_THROW(parse_failing_case("{]"), std::invalid_argument);
}

// Reduces the cases on an implementation. `starts` is called before each case.
std::vector<Reduction> reduced_on(
    Implementation& implementation, const std::vector<FailingCase>& cases,
    const std::function<void()>& starts = [] {}) {
  const CapturedSubject subject(implementation);
  const auto reduce = case_reducer(subject);
  std::vector<Reduction> reductions;
  for (const FailingCase& failing : cases) {
    starts();
    reductions.push_back(reduce(failing));
  }
  for (const Reduction& reduction : reductions)
    EXPECT_TRUE(reduction.minimal) << reduction.test << ": " << reduction.why_not;
  return reductions;
}

// A large mesh of a surface belongs to the known cause if its commands alone differ in the same way, and is
// not reduced.
TEST(Reductions, OfLargeMeshesStopAtAKnownCause) {
  static int contexts = 0;
  Altered altered([](gl::Table& table) {
    ++contexts;
    table.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
      Altered::original.EvalMesh2(mode, i1, i2, j1, j2 - 1);  // without the last row
    };
  });
  const auto mesh = [](GLint side) {
    gl::Case c;
    c.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 6, 2, 0.0f, 1.0f, 3, 2,
            std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5f});
    c.Map2f(GL_MAP2_NORMAL, 0.0f, 1.0f, 3, 1, 0.0f, 1.0f, 3, 1, std::vector<float>{0, 0, 1});
    c.Enable(GL_MAP2_VERTEX_3);
    c.Enable(GL_MAP2_NORMAL);
    c.Color4f(0.5f, 0.25f, 0.75f, 1.0f);
    c.MapGrid2f(side, 0.0f, 1.0f, side, 0.0f, 1.0f);
    c.EvalMesh2(GL_POINT, 0, side, 0, side);
    return gl::to_text(c);
  };
  std::vector<int> contexts_before;
  const std::vector<Reduction> reductions = reduced_on(
      altered, {{"Small", {"vertices", "", ""}, mesh(3)}, {"Large", {"vertices", "", ""}, mesh(40)}},
      [&] { contexts_before.push_back(contexts); });
  ASSERT_EQ(reductions.size(), 2u);
  ASSERT_TRUE(reductions[0].minimal && reductions[1].minimal);
  EXPECT_EQ(reductions[0].minimal->cause, reductions[1].minimal->cause);
  EXPECT_EQ(gl::to_text(reductions[0].minimal->program), gl::to_text(reductions[1].minimal->program));
  EXPECT_LE(contexts - contexts_before.at(1), 15) << "the large case was reduced, which took the small one "
                                                  << contexts_before.at(1) - contexts_before.at(0);
}

gl::Case plane() {
  gl::Case c;
  c.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 6, 2, 0.0f, 1.0f, 3, 2,
          std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5f});
  c.Enable(GL_MAP2_VERTEX_3);
  return c;
}

TEST(Reductions, ShowTheOrderOfAMesh) {
  Altered altered([](gl::Table& table) {
    table.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
      for (GLint i = i1; i <= i2; ++i) Altered::original.EvalMesh2(mode, i, i, j1, j2);  // j fastest
    };
  });
  gl::Case mesh = plane();
  mesh.MapGrid2f(4, 0.0f, 1.0f, 4, 0.0f, 1.0f);
  mesh.EvalMesh2(GL_POINT, 0, 4, 0, 4);
  const std::vector<Reduction> reductions =
      reduced_on(altered, {{"Points", {Difference::kOrder, "", ""}, gl::to_text(mesh)}});
  ASSERT_EQ(reductions.size(), 1u);
  ASSERT_TRUE(reductions[0].minimal);
  EXPECT_EQ(reductions[0].minimal->failure.difference.kind, Difference::kOrder);
  EXPECT_EQ(reductions[0].minimal->requirement, "EV-MESH2-POINT");
  EXPECT_EQ(reductions[0].minimal->cause, "order of a mesh");
}

TEST(Reductions, ShowVerticesWhereNoneAreDue) {
  Altered altered([](gl::Table& table) {
    table.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
      Altered::original.EvalMesh2(mode, std::min(i1, i2), i2, j1, j2);  // draws an empty range
    };
  });
  gl::Case mesh = plane();
  mesh.MapGrid2f(4, 0.0f, 1.0f, 4, 0.0f, 1.0f);
  mesh.EvalMesh2(GL_POINT, 1, 0, 0, 2);
  const std::vector<Reduction> reductions =
      reduced_on(altered, {{"EmptyRange", {"vertices", "", ""}, gl::to_text(mesh)}});
  ASSERT_EQ(reductions.size(), 1u);
  ASSERT_TRUE(reductions[0].minimal);
  EXPECT_EQ(reductions[0].minimal->failure.expected, "0 vertices");
}

// A primitive of thousands of vertices is halved until it is small. Display lists, which do not matter, are
// left out.
TEST(Reductions, ShortenLongPrimitives) {
  static GLfloat before[4];
  Altered altered([](gl::Table& table) {
    table.Begin = [](GLenum mode) {
      Altered::original.GetFloatv(GL_CURRENT_COLOR, before);
      Altered::original.Begin(mode);
    };
    table.EvalCoord1f = [](GLfloat u) {
      Altered::original.EvalCoord1f(u);
      Altered::original.Color4fv(before);  // loses the colour that was set after Begin
    };
  });
  gl::Case strip;
  strip.Map1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 2, std::vector<float>{0, 0, 0, 1, 1, 1});
  strip.Enable(GL_MAP1_VERTEX_3);
  strip.Begin(GL_LINE_STRIP);
  strip.Color4f(0.5f, 0.25f, 0.75f, 1.0f);
  for (int i = 0; i < 3000; ++i) {
    strip.EvalCoord1f(static_cast<GLfloat>(i) / 4096);
    strip.Vertex3f(0, 0, 0);
  }
  strip.End();
  const gl::Case in_list = gl::through_lists(strip, gl::Lists::kCompiled).script;
  const std::vector<Reduction> reductions =
      reduced_on(altered, {{"Long", {"color", "explicit vertex", ""}, gl::to_text(strip)},
                           {"Long/Compiled", {"color", "explicit vertex", ""}, gl::to_text(in_list)}});
  ASSERT_EQ(reductions.size(), 2u);
  for (const Reduction& reduction : reductions) {
    ASSERT_TRUE(reduction.minimal);
    EXPECT_LE(reduction.minimal->program.commands().size(), 7u);
    EXPECT_FALSE(gl::uses_lists(reduction.minimal->program));
  }
}

// No candidate calls a list that does not exist, unless the case does: Mesa crashes in such programs.
TEST(Reductions, DefineTheListsThatTheyCall) {
  static std::set<GLuint> defined;
  static int calls_of_missing = 0;
  Altered altered([](gl::Table& table) {
    defined.clear();
    table.NewList = [](GLuint list, GLenum mode) {
      defined.insert(list);
      Altered::original.NewList(list, mode);
    };
    table.CallList = [](GLuint list) {
      calls_of_missing += !defined.contains(list);
      Altered::original.CallList(list);
      Altered::original.EvalMesh1(GL_POINT, 0, 0);  // a vertex too many
    };
  });
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 2, std::vector<float>{0, 0, 0, 1, 1, 1});
  c.Enable(GL_MAP1_VERTEX_3);
  c.MapGrid1f(4, 0.0f, 1.0f);
  c.NewList(2, GL_COMPILE);
  c.EvalMesh1(GL_POINT, 0, 4);
  c.EndList();
  c.NewList(1, GL_COMPILE);
  c.EvalMesh1(GL_POINT, 1, 3);
  c.CallList(2);
  c.EndList();
  c.CallList(1);
  const std::vector<Reduction> reductions =
      reduced_on(altered, {{"Nested", {"vertices", "", ""}, gl::to_text(c)}});
  EXPECT_EQ(reductions.size(), 1u);
  EXPECT_EQ(calls_of_missing, 0);
}

TEST(Legal, ErrorsOfAListThatIsCalledTwiceCanBeAskedFor) {
  const gl::Case program = gl::parse_case(
      R"([["NewList", 1, "GL_COMPILE"], ["Map1f", "GL_MAP1_VERTEX_3", 0, 1, 2, 1, {"f32": [0, 0, 0]}], ["EndList"],
          ["CallList", 1], ["CallList", 1], ["GetError"]])");
  EXPECT_FALSE(specify_if_defined(program, kMaxOrder));
  const gl::Case asking = with_errors_asked_for(program, kMaxOrder);
  EXPECT_TRUE(specify_if_defined(asking, kMaxOrder));
  EXPECT_EQ(asking.commands().size(), program.commands().size() + 1);
}

// --- from tests to bugs ------------------------------------------------------------------------------------

// Runs these tests on production with the fault, and returns the result with its bugs. If a known bug is
// given, a baseline expects each failure for it. `reduced` is set to the number of tests that were to be
// reduced.
RunResult run_with_fault(const std::string& fault, const std::vector<std::string>& tests,
                         const std::string& known_bug = "", std::optional<std::uint64_t> seed = {},
                         std::size_t* reduced = nullptr) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("evalcts-bugs-{}", getpid());
  fs::create_directories(folder);
  const std::vector<std::string> suite = {FAULTY_SUITE_PROGRAM, "--fault", fault, "--implementation",
                                          "production"};
  RunResult run;
  run.implementation.max_eval_order = kMaxOrder;
  run.seed = seed;
  Worker worker(suite, folder / "log", {});
  for (const std::string& test : tests) worker.give({.kind = "test", .name = test});
  worker.finish();
  worker.wait({}, [&](const Event& event) {
    if (const auto* failed = std::get_if<CaseFailed>(&event))
      run.failing_cases[failed->test] = failed->commands;
    if (const auto* result = std::get_if<TestFinished>(&event)) run.tests.push_back(result->record);
  });
  for (TestRecord& test : run.tests) {
    test.expected_by_baseline = !known_bug.empty();
    if (!known_bug.empty()) test.known_bugs = {known_bug};
  }
  find_bugs(run, {.suite_command = suite, .jobs = 2, .seconds = 300, .scratch = folder, .limits = {}},
            [&](std::size_t, std::size_t total) {
              if (reduced) *reduced = total;
            });
  fs::remove_all(folder);
  return run;
}

// One mistake becomes few bugs, regardless of the number of tests that detect it, their dimensions
// and their commands.
TEST(FaultyImplementation, HasFewBugs) {
  struct Injected {
    std::string fault;
    std::size_t most;  // maximum number of bugs
    std::vector<std::string> tests;
  };
  const std::vector<Injected> faults = {
      {"OrderZeroTaken",
       1,
       {"Map1Errors.OrderTooLow/MAP1_COLOR_4_d", "Map1Errors.OrderTooLow/MAP1_NORMAL_f",
        "Map1Errors.OrderTooLow/MAP1_VERTEX_3_f"}},
      {"VertexAfterEvaluationHasInitialNormal",
       1,
       {"Evaluation.MixedWithVertex/EvalCoord1d", "Evaluation.MixedWithVertex/EvalCoord2f",
        "Evaluation.MixedWithVertex/EvalPoint1"}}};
  for (const auto& [fault, most, tests] : faults) {
    SCOPED_TRACE(fault);
    const RunResult run = run_with_fault(fault, tests);
    EXPECT_EQ(run.tests.size(), tests.size());
    std::string causes;
    std::size_t explained = 0;
    for (const Bug& bug : run.bugs) {
      causes += bug.cause + "\n";
      explained += bug.tests.size();
      EXPECT_TRUE(bug.is_reduced()) << bug.why_not_reduced;
      EXPECT_LE(bug.failure.calls.size(), 24u);  // the program fits on a screen
      EXPECT_EQ(bug.known, "");
    }
    EXPECT_EQ(run.bugs.size(), most) << causes;
    EXPECT_EQ(explained, tests.size());
    EXPECT_EQ(run.bugs_note, "");
  }
}

// A rejected command that takes effect breaks another rule than one that is not rejected.
TEST(FaultyImplementation, ViolatesTheErrorOrTheRuleOfItsEffect) {
  const auto violated = [](const std::string& fault, const std::string& test) {
    const RunResult run = run_with_fault(fault, {test});
    return run.tests.empty() ? std::vector<std::string>() : texts_of(run.tests[0].violated);
  };
  EXPECT_EQ(violated("DomainSetBeforeStrideCheck", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f"),
            std::vector<std::string>{"EV-MAP1-ERR-NOEFFECT"});
  EXPECT_EQ(violated("OrderZeroTaken", "Map1Errors.OrderTooLow/MAP1_VERTEX_3_f"),
            std::vector<std::string>{"EV-MAP1-ERR-ORDER-LOW"});
}

// A failure that the baseline names is not reduced if its bug is proven here, or has no program that could
// prove it.
TEST(FaultyImplementation, IsReducedOnlyAsFarAsTheBaselineDoesNotNameTheBug) {
  std::vector<std::string> tests;
  for (const char* target : {"COLOR_4", "INDEX", "NORMAL", "VERTEX_3", "VERTEX_4"})
    for (const char* form : {"d", "f"})
      tests.push_back(fmt::format("Map1Errors.OrderTooLow/MAP1_{}_{}", target, form));
  const auto run = [&](const std::string& known_bug, std::optional<std::uint64_t> seed) {
    std::size_t reduced = 0;
    const RunResult result = run_with_fault("OrderZeroTaken", tests, known_bug, seed, &reduced);
    EXPECT_EQ(result.tests.size(), tests.size());
    EXPECT_EQ(result.bugs.size(), 1u);
    return std::pair(reduced, result.bugs.empty() ? std::string() : result.bugs[0].known);
  };
  using Outcome = std::pair<std::size_t, std::string>;
  EXPECT_EQ(run("mesa-getmap-saturation", 1), Outcome(10, "")) << "its program does not fail";
  EXPECT_EQ(run("mesa-long-primitives", 1), Outcome(0, "mesa-long-primitives")) << "it has no program";
  EXPECT_EQ(run("mesa-long-primitives", 2), Outcome(3, "mesa-long-primitives"))
      << "with another seed, the failing cases were not compared";
}

}  // namespace
}  // namespace evalcts::fuzz
