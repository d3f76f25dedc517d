// Tests the summary, the list of bugs and the changes for a terminal.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "evalcts/reports.h"
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Returns a record with 200 failing tests of 40 requirements and with long values.
json large_record() {
  json tests = json::array();
  for (int i = 0; i < 200; ++i) {
    tests.push_back(
        {{"name", "Theme.Rule/" + std::to_string(i)},
         {"requirements", {"EV-" + std::to_string(i % 40)}},
         {"verdict", "fail"},
         {"message", std::string(150, 'm')},
         {"failures",
          {{{"case", "u=1"}, {"expected", std::string(90, '1')}, {"captured", std::string(90, '2')}}}}});
  }
  return {{"status", "complete"}, {"implementation", {{"name", "large"}}}, {"tests", tests}};
}

// Each report has the whole note, which warns if another library than the intended one was judged.
TEST(Terminal, NoteOnTheImplementation) {
  json record = large_record();
  const std::string note =
      "GALLIUM_DRIVER=zink asks for another driver than the one that was judged: " + std::string(100, 'x') +
      " end";
  record["implementation"]["note"] = note;
  record["implementation"]["files"] = {"/build/libEGL_mesa.so.0"};
  EXPECT_EQ(lines_of(terminal_of(record, nullptr, false, false))[1], "loaded: /build/libEGL_mesa.so.0");
  EXPECT_EQ(lines_of(terminal_of(record, nullptr, false, false))[2], "note: " + note);
  EXPECT_NE(html_of({record}, nullptr).find(note), std::string::npos);
  EXPECT_NE(html_of({record}, nullptr).find("/build/libEGL_mesa.so.0"), std::string::npos);
  EXPECT_NE(markdown_of({record}).find("**note**: `" + note), std::string::npos);
}

// Returns the sample without bugs, as if they had not been looked for.
json sample_without_bugs() {
  json record = read_sample("results-osmesa.json");
  record.erase("bugs");
  record.erase("bugs_note");
  return record;
}

TEST(Terminal, TellsTheDistinctBugsFirst) {
  const std::string text =
      terminal_of(read_sample("results-osmesa.json"), read_sample("requirements.json"), false, false);
  EXPECT_TRUE(contains(text, R"(
4 distinct bugs behind 4 failing tests, most important first; 1 known
 1. EvalMesh2 behind CallList crashes
    crash, must: 1 test (1 unexpected), explicit vertices show it as well; EV-MESH2-FILL-1a2b [GL 1.0 §5.1]
    crash: expected no crash, got signal 11 (SIGSEGV, Segmentation fault)
    C program: ./evalcts reproduce osmesa:EV-MESH2-FILL-1a2b
 2. Map2Output.HugeGrid does not end
    timeout, must: 1 test (1 unexpected), not reduced; EV-MESH2-FILL-77c0 [GL 1.0 §5.1]
)")) << text;
  EXPECT_TRUE(contains(text, R"(
 4. Map1 with a stride below the number of values of a point raises no error
    fail, must: 1 test; mesa-stride-not-checked [GL 1.0 §5.1; glMap1 page]
'evalcts bugs' shows each with its program, --verbose the failing tests
)")) << text;
  EXPECT_TRUE(contains(text, "\nnote: 1 of 4 failing tests was not reduced")) << text;
  // Tests that bugs explain are shown with --verbose only; other failing tests are always shown.
  EXPECT_FALSE(contains(text, "fail     Map1Values.Bezier")) << text;
  EXPECT_TRUE(contains(text, "\ninternal-error Map2Values.Rational\n")) << text;
  EXPECT_TRUE(contains(terminal_of(read_sample("results-osmesa.json"), nullptr, false, true),
                       "fail     Map1Values.Bezier"));
}

TEST(Terminal, ListsBugsWithTheirPrograms) {
  const auto list = [](bool verbose) {
    return bug_list(read_run_result(read_sample("results-osmesa.json")),
                    catalogue_of(read_sample("requirements.json")), false, verbose);
  };
  const std::string text = list(false);
  EXPECT_TRUE(text.starts_with("osmesa: 4 distinct bugs behind 4 failing tests\n")) << text;
  EXPECT_TRUE(contains(text, R"(
3. EvalCoord with a map of texture coordinates: texture coordinate s of the vertex is wrong
   EV-MAP1-BEZIER-09d4: fail, must; 1 failing test, 2 requirements
)")) << text;
  EXPECT_TRUE(contains(text, R"(
   what differs: texcoord[0].s of vertex 0
   expected: 0.25
   captured: 0.3
   minimal program:
     glMap1d(GL_MAP1_TEXTURE_COORD_1, 0.0, 1.0, 1, 2, (GLdouble[]){0.0, 0.5});
)")) << text;
  EXPECT_TRUE(contains(text, "   not reduced: the time for reduction was over\n")) << text;
  EXPECT_TRUE(contains(text, "   known: mesa-stride-not-checked, in Mesa 21.0 to 22.3\n")) << text;
  EXPECT_TRUE(contains(text, "\nnote: 1 of 4 failing tests was not reduced")) << text;
  RunResult many = read_run_result(read_sample("results-osmesa.json"));
  many.bugs[0].tests = {"A.1", "A.2", "A.3", "A.4", "A.5", "A.6", "A.7"};
  EXPECT_TRUE(
      contains(bug_list(many, Catalogue(), false, false), "tests: A.1, A.2, A.3, A.4, A.5, and 2 more\n"));
  EXPECT_TRUE(contains(bug_list(many, Catalogue(), false, true), "A.5, A.6, A.7\n"));
  for (const char c : bug_list(read_run_result(hostile_record()), Catalogue(), false, true))
    EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
}

TEST(Terminal, TellsTheWorstFirst) {
  const std::string text = terminal_of(sample_without_bugs(), read_sample("requirements.json"), false, false);
  EXPECT_EQ(text,
            R"(osmesa: Mesa, llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Compatibility Profile) Mesa 22.3.6
11 tests: 1 internal-error, 1 crash, 1 timeout, 2 fail, 1 quality-warning, 1 not observed, 1 not-supported, 1 skipped, 2 pass

internal-error Map2Values.Rational
  the judge was given no vertex
  why: EV-MAP2-BEZIER

crash    Map2Output.FillOrder
  signal 11 (SIGSEGV) in EvalMesh2
  why: EV-MESH2-FILL
  rerun: ./evalcts run --implementation osmesa --filter Map2Output.FillOrder
  C program: ./evalcts reproduce osmesa:Map2Output.FillOrder   debugger: gdb --args build/evalcts-suite --implementation osmesa --gtest_filter=Map2Output.FillOrder

fail     Map1Values.Bezier/TEXTURE_COORD_1/d: 2 of 12 cases, order=4 u=0.5
  texcoord[0].s of vertex 3: expected 0.25005 +- 5e-05 exact 0.25005, got 0.3 (1,676,000 ULP, condition-aware 838,000)
  why: EV-MAP1-BEZIER (and 1 more): The map evaluates to p = SUM i=0..n of B(n,i,uh) * R_i with n = order - 1, component by component. [GL 1.0-4.6c §5.1/§21.1; glMap1 page]
  rerun: ./evalcts run --implementation osmesa --filter Map1Values.Bezier/TEXTURE_COORD_1/d
  C program: ./evalcts reproduce osmesa:Map1Values.Bezier/TEXTURE_COORD_1/d   debugger: gdb --args build/evalcts-suite --implementation osmesa --gtest_filter=Map1Values.Bezier/TEXTURE_COORD_1/d

timeout  Map2Output.HugeGrid
  no end after 60 s
  why: EV-MESH2-FILL

pass            AutoNormal.InitiallyOff (the baseline expects otherwise: the pages say TRUE): passes by the reading specification

baseline: none; 'evalcts waive' or --write-baseline records known failures
1 internal error; 3 new failures; 1 known; 1 unexpected pass: AutoNormal.InitiallyOff; not complete: interrupted by SIGINT
)");
}

// The text has eight failures of different requirements. On a screen, only commands exceed its columns.
TEST(Terminal, SaysEnough) {
  EXPECT_EQ(lines_of(terminal_of(large_record(), nullptr, false, false)).size(), 2u + 8 * (1 + 3) + 4);
  for (const bool colour : {false, true})
    for (const std::size_t columns : {80u, 100u, 200u}) {
      const std::string text = terminal_of(large_record(), nullptr, colour, false, 0, columns);
      for (const std::string& line : lines_of(text))
        EXPECT_LE(line.size(), columns + (colour ? 10 : 0)) << line;
      // Broken lines are the whole text.
      std::string words = text, whole = terminal_of(large_record(), nullptr, colour, false);
      if (colour || columns < 100) continue;  // lines of more than four rows are cut
      for (std::string* each : {&words, &whole}) {
        std::erase(*each, '\n');
        std::erase(*each, ' ');
      }
      EXPECT_EQ(words, whole) << columns;
    }
  // Notes are never cut, and nothing is with --verbose.
  json one = large_record();
  one["implementation"]["note"] = std::string(3000, '~');
  EXPECT_EQ(std::ranges::count(terminal_of(one, nullptr, false, false, 0, 80), '~'), 3000);
  one = large_record();
  one["tests"][0]["failures"][0]["expected"] = std::string(3000, '~');
  EXPECT_GE(std::ranges::count(terminal_of(one, nullptr, false, true, 0, 80), '~'), 3000);
  EXPECT_LT(std::ranges::count(terminal_of(one, nullptr, false, false, 0, 80), '~'), 400);
  const std::string text = terminal_of(large_record(), nullptr, false, false);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(contains(text, "  why: EV-" + std::to_string(i) + "\n")) << i;
  EXPECT_TRUE(contains(text, "and 192 unexpected results more; --verbose and index.html show all\n"));
}

// A small screen gets fewer failures, but at least one.
TEST(Terminal, FitsTheScreen) {
  for (const std::size_t lines : {10u, 24u, 30u, 50u}) {
    const std::string text = terminal_of(large_record(), nullptr, false, false, lines);
    EXPECT_TRUE(contains(text, "  why: EV-0\n")) << lines;
    EXPECT_LE(lines_of(text).size(), std::max<std::size_t>(lines, 12)) << lines;
  }
  EXPECT_EQ(terminal_of(large_record(), nullptr, false, false, 200),
            terminal_of(large_record(), nullptr, false, false));
}

// A pass that does not cover all parts of its test says so in each report.
TEST(Terminal, PassesInPart) {
  json record = large_record();
  record["tests"] = {{{"name", "Theme.Both"},
                      {"requirements", {"EV-A"}},
                      {"verdict", "pass"},
                      {"unobserved", "glMap1d (missing)"}},
                     {{"name", "Theme.One"}, {"requirements", {"EV-A"}}, {"verdict", "pass"}}};
  EXPECT_NE(terminal_of(record, nullptr, false, false)
                .find("  1 of these passes without glMap1d (missing): not observed\n"),
            std::string::npos)
      << terminal_of(record, nullptr, false, false);
  EXPECT_NE(html_of({record}, nullptr).find("not observed: glMap1d (missing)"), std::string::npos);
}

TEST(Terminal, OneLineWhereThatIsWanted) {
  EXPECT_EQ(terminal_line_of(read_sample("results-reference.json"), false), "reference: No failures\n");
  EXPECT_EQ(terminal_line_of(read_sample("results-glx.json"), false),
            "glx: Not judged: no X server: DISPLAY is not set\n");
  EXPECT_TRUE(contains(terminal_line_of(large_record(), true), "\x1b[31mlarge: 200 failures\x1b[0m\n"));
}

// The text has one line about the accuracy of all targets and one about equal bits, from the tests of level
// quality that decided something.
TEST(Terminal, SaysForWhichTargetsTheLibraryIsAccurate) {
  const auto test = [](const char* name, const char* requirement, const char* level, const char* verdict) {
    return json{{"name", name}, {"requirements", {requirement}}, {"level", level}, {"verdict", verdict}};
  };
  json record = {
      {"status", "complete"},
      {"implementation", {{"name", "some"}}},
      {"tests",
       {test("Accuracy.Good/MAP1_INDEX", "EV-NUM-ACCURACY/1-D", "quality", "pass"),
        test("Accuracy.Good/MAP1_COLOR_4", "EV-NUM-ACCURACY/1-D", "quality", "pass"),
        test("Accuracy.Ends/MAP1_COLOR_4/Compiled", "EV-NUM-ACCURACY/1-D", "quality", "quality-warning"),
        test("Accuracy.Good/MAP2_NORMAL", "EV-NUM-ACCURACY/2-D", "quality", "not-observable"),
        test("Accuracy.Acceptable/MAP2_VERTEX_3", "EV-NUM-ACCURACY/2-D", "must", "pass"),
        test("Points.SameBits/MAP2_VERTEX_4", "EV-POINT-LIKEMESH", "quality", "quality-warning"),
        test("Normals.Analytic/WAVE", "EV-AUTON-METHOD", "quality", "pass")}}};
  const std::string line = "as good as single precision for 2 of 3 targets; not for MAP1_COLOR_4";
  EXPECT_TRUE(contains(terminal_of(record, nullptr, false, false), "\nquality: " + line + "\n"));
  EXPECT_TRUE(contains(markdown_of({record}), "`" + line + "`")) << markdown_of({record});
  const std::string bits = "not bit-identical: EvalPoint and EvalMesh (1 test)";
  EXPECT_TRUE(contains(terminal_of(record, nullptr, false, false), "\nquality: " + bits + "\n"));
  EXPECT_TRUE(contains(markdown_of({record}), "`" + bits + "`"));
  record["tests"] =
      json::array({test("Normals.Analytic/WAVE", "EV-AUTON-METHOD", "quality", "quality-warning")});
  EXPECT_TRUE(contains(terminal_of(record, nullptr, false, false),
                       "as good as single precision for 0 of 1 target; not for AUTO_NORMAL\n"));
  record["tests"] =
      json::array({test("Points.SameBits/MAP2_VERTEX_4", "EV-POINT-LIKEMESH", "quality", "pass")});
  EXPECT_FALSE(contains(terminal_of(record, nullptr, false, false), "quality:"));
  json memory = test("Contexts.MemoryOfMaps", "EV-CTX-UNBOUNDED/1-D", "quality", "quality-warning");
  memory["message"] = "memory grows by 256 bytes with each Map1f";
  record["tests"] = json::array({memory});
  EXPECT_TRUE(contains(terminal_of(record, nullptr, false, false),
                       "\nquality: memory grows by 256 bytes with each Map1f\n"));
}

TEST(Terminal, TellsFlakesApart) {
  json record = large_record();
  record["tests"][0]["flake"] = true;
  record["tests"][0]["again"] = {{"verdict", "pass"}, {"message", ""}};
  record["tests"][1]["again"] = {{"verdict", "fail"}, {"message", "other cases"}};
  record["confirmed_by_group"] = 100;
  const std::string text = terminal_of(record, nullptr, false, false);
  EXPECT_TRUE(contains(text, "\nfail     Theme.Rule/0 (flake: pass when run again), u=1\n")) << text;
  EXPECT_TRUE(contains(text, "\nfail     Theme.Rule/1 (another fail when run again), u=1\n")) << text;
  EXPECT_TRUE(contains(text, "100 unexpected failures had another of the same kind run again instead\n"))
      << text;
  EXPECT_TRUE(contains(junit_of(record), "flake: pass when run again"));
}

TEST(Terminal, TellsWhyMuchWasNotObserved) {
  const auto text_with = [](std::size_t unobserved) {
    json record = large_record();
    json& tests = record["tests"];
    for (std::size_t i = 0; i < tests.size() * unobserved / 10; ++i) {
      tests[i]["verdict"] = "not-observable";
      tests[i]["message"] = "nothing comes out";
    }
    record["implementation"]["captures"] =
        json::array({{{"name", "Pixels"}, {"available", false}, {"reason", "no shaders"}, {"printed", ""}}});
    return terminal_of(record, nullptr, false, false);
  };
  const std::string much = text_with(5);
  EXPECT_TRUE(contains(much, "because: nothing comes out\n")) << much;
  EXPECT_TRUE(contains(much, "\n  Pixels does not work: no shaders\n")) << much;
  EXPECT_FALSE(contains(text_with(1), "does not work")) << "little is not observed";
}

TEST(Terminal, VerboseTellsAll) {
  const std::string text =
      terminal_of(read_sample("results-osmesa.json"), read_sample("requirements.json"), false, true);
  EXPECT_TRUE(contains(text,
                       "\nfail            Map1Errors.StrideBelowK/MAP1_VERTEX_3 (expected: Mesa checks the "
                       "stride after the pointer): stride 2 raised nothing\n"));
  EXPECT_TRUE(contains(text, "order=4 u=0.25"));
  EXPECT_TRUE(contains(text, "\nquality-warning MeshQuality.EvalPointBits"));
  EXPECT_TRUE(contains(
      text, "  not observed: the pipeline ignores edge flags of quad strips\n      AutoNormal.EdgeFlags\n"));
  EXPECT_TRUE(contains(text, "  Sink: not available, not in this process\n"));
  EXPECT_EQ(lines_of(terminal_of(large_record(), nullptr, false, true)).size(), 2u + 200 * (1 + 3) + 3);
}

TEST(Terminal, ColourOnlyOnRequest) {
  const json record = read_sample("results-osmesa.json");
  EXPECT_FALSE(contains(terminal_of(record, nullptr, false, true), "\x1b"));
  const std::string coloured = terminal_of(record, nullptr, true, false);
  EXPECT_TRUE(contains(coloured, "\x1b[31m 1. EvalMesh2 behind CallList crashes\x1b[0m\n"));
  EXPECT_TRUE(contains(terminal_of(sample_without_bugs(), nullptr, true, false), "\x1b[31mcrash"));
  const auto starts = std::count(coloured.begin(), coloured.end(), '\x1b');
  EXPECT_EQ(starts % 2, 0) << "every colour ends";
}

TEST(Terminal, HostileTextDoesNotReachTheTerminal) {
  for (const bool verbose : {false, true}) {
    const std::string text = terminal_of(hostile_record(), hostile_requirements(), false, verbose);
    for (const char c : text)
      EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
    EXPECT_FALSE(contains(text, "\xC2\x9B"));
    EXPECT_FALSE(contains(text, "\xFF"));
  }
}

TEST(Terminal, NothingUnexpected) {
  EXPECT_EQ(terminal_of(read_sample("results-reference.json"), nullptr, false, false),
            "reference: evalcts, exact arithmetic, 0.1.0\n"
            "  the executable specification: the tests agree with it, so they can pass\n"
            "3 tests: 3 pass\n\nNo failures\n");
}

TEST(Terminal, NotStarted) {
  EXPECT_EQ(terminal_of(read_sample("results-glx.json"), nullptr, false, false),
            "glx\n0 tests\n\nNot judged: no X server: DISPLAY is not set\n");
}

TEST(Terminal, ReasonIsNeverCut) {
  json record = read_sample("results-glx.json");
  record["reason"] = std::string(300, 'x') + "; install it";
  EXPECT_TRUE(contains(terminal_of(record, nullptr, false, false), "x; install it\n"));
}

TEST(Terminal, EmptyRecordIsNotGreen) {
  EXPECT_EQ(terminal_of(json::object(), nullptr, false, false),
            "(unnamed)\n0 tests\n\nNo failures so far; not complete: status unknown\n");
}

// --- annotations -------------------------------------------------------------------------------------------

TEST(Annotations, AreOfNewFailuresOnly) {
  const std::vector<RunResult> results = {read_run_result(read_sample("results-osmesa.json"))};
  const std::string github = github_annotations(results);
  EXPECT_EQ(std::ranges::count(github, '\n'), 4) << github;
  EXPECT_TRUE(
      contains(github,
               "::error title=osmesa%3A EvalMesh2 behind CallList crashes::EV-MESH2-FILL-1a2b (crash, 1 new "
               "failing test). crash: expected no crash, got signal 11"))
      << github;
  EXPECT_FALSE(contains(github, "Map1 with a stride below")) << github;  // known
  EXPECT_TRUE(contains(github, "::error title=osmesa%3A Map2Values.Rational::internal-error: ")) << github;
  const json gitlab = parse_json(gitlab_code_quality(results, "ci/library-fails.txt"));
  ASSERT_EQ(gitlab.size(), 4u);
  EXPECT_EQ(as_text(gitlab[0]["check_name"]), "osmesa:EV-MESH2-FILL-1a2b");
  EXPECT_EQ(as_text(gitlab[0]["severity"]), "critical");
  EXPECT_EQ(as_text(gitlab[0]["location"]["path"]), "ci/library-fails.txt");
  std::set<std::string> fingerprints;
  for (const json& each : gitlab) fingerprints.insert(each["fingerprint"].get<std::string>());
  EXPECT_EQ(fingerprints.size(), 4u);
  EXPECT_EQ(github_annotations({}), "");
  EXPECT_EQ(gitlab_code_quality({}, "x"), "[]\n");
}

TEST(Annotations, AreFewAndCannotBecomeCommands) {
  const std::string github = github_annotations({read_run_result(large_record())});
  EXPECT_EQ(std::ranges::count(github, '\n'), 10) << github;
  EXPECT_TRUE(contains(github, "::error title=evalcts::191 more are in the summary\n")) << github;
  json record = large_record();
  record["tests"][0]["message"] = "one\n::error::two %";
  record["tests"][0].erase("failures");
  const std::string escaped = github_annotations({read_run_result(record)});
  EXPECT_TRUE(contains(escaped, "one%0A::error::two %25")) << escaped;
}

}  // namespace
}  // namespace evalcts::reports
