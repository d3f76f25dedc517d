#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "evalcts/reports.h"
#include "reports/tests/samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// 200 failing tests of 40 requirements, each with long values.
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

TEST(Terminal, TellsTheWorstFirst) {
  const std::string text = terminal_summary(read_sample("results-osmesa.json"), false, false);
  EXPECT_EQ(text,
            R"(osmesa: Mesa, llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Compatibility Profile) Mesa 22.3.6
interrupted: interrupted by SIGINT
11 tests: 1 internal-error, 1 crash, 1 timeout, 2 fail, 1 quality-warning, 1 not-observable,
  1 not-supported, 1 skipped, 2 pass

EV-MAP2-BEZIER
  internal-error  Map2Values.Rational: the judge was given no vertex
EV-MESH2-FILL
  crash           Map2Output.FillOrder: signal 11 (SIGSEGV) in EvalMesh2
  timeout         Map2Output.HugeGrid: no end after 60 s
EV-MAP1-BEZIER, EV-MAP1-DOMAIN
  fail            Map1Values.Bezier/TEXTURE_COORD_1/d: 2 of 12 cases: 2 of 12 values lie outside ...
      order=4 u=0x1p-1; texcoord[0].s of vertex 3: 1.676e+06 ULP, condition-aware 8.38e+05
      expected [0.25, 0.2501] exact 0.25005 (0x1.000d1cp-2), captured 0.3 (0x1.333334p-2)
EV-INIT-AUTON-OFF
  pass            AutoNormal.InitiallyOff (the baseline expects otherwise: the pages say TRUE): p...

5 unexpected results, 1 failing test as the baseline expects, the run is not complete
)");
}

TEST(Terminal, FitsAScreen) {
  for (const bool colour : {false, true}) {
    const std::vector<std::string> lines = lines_of(terminal_summary(large_record(), colour, false));
    EXPECT_LE(lines.size(), 24u);
    EXPECT_GE(lines.size(), 18u);
    for (const std::string& line : lines) EXPECT_LE(line.size(), colour ? 110u : 100u);
  }
  const std::string text = terminal_summary(large_record(), false, false);
  EXPECT_TRUE(contains(text, "  and 2 tests more of this requirement\n"));
  EXPECT_TRUE(contains(text, "and 190 unexpected results more; --verbose and index.html show all\n"));
}

TEST(Terminal, VerboseTellsAll) {
  const std::string text = terminal_summary(read_sample("results-osmesa.json"), false, true);
  EXPECT_TRUE(contains(text, "  fail            Map1Errors.StrideBelowK/MAP1_VERTEX_3 (expected)"));
  EXPECT_TRUE(contains(text, "      baseline: Mesa checks the stride after the pointer\n"));
  EXPECT_TRUE(contains(text, "order=4 u=0x1p-2"));
  EXPECT_TRUE(contains(text, "  quality-warning MeshQuality.EvalPointBits"));
  EXPECT_TRUE(contains(
      text,
      "  not-observable: the pipeline ignores edge flags of quad strips\n      AutoNormal.EdgeFlags\n"));
  EXPECT_TRUE(contains(text, "  Sink: not available, not in this process\n"));
  EXPECT_EQ(lines_of(terminal_summary(large_record(), false, true)).size(), 2u + 1 + 40 + 200 * 3 + 2);
}

TEST(Terminal, ColourOnlyOnRequest) {
  const json record = read_sample("results-osmesa.json");
  EXPECT_FALSE(contains(terminal_summary(record, false, true), "\x1b"));
  const std::string coloured = terminal_summary(record, true, false);
  EXPECT_TRUE(contains(coloured, "\x1b[31m  crash"));
  const auto starts = std::count(coloured.begin(), coloured.end(), '\x1b');
  EXPECT_EQ(starts % 2, 0) << "every colour ends";
}

TEST(Terminal, HostileTextDoesNotReachTheTerminal) {
  for (const bool verbose : {false, true}) {
    const std::string text = terminal_summary(hostile_record(), false, verbose);
    for (const char c : text)
      EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
    EXPECT_FALSE(contains(text, "\xC2\x9B"));
    EXPECT_FALSE(contains(text, "\xFF"));
  }
}

TEST(Terminal, NothingUnexpected) {
  EXPECT_EQ(terminal_summary(read_sample("results-reference.json"), false, false),
            "reference: evalcts, exact arithmetic, 0.1.0\n3 tests: 3 pass\n\nnothing unexpected\n");
}

TEST(Terminal, NotStarted) {
  EXPECT_EQ(terminal_summary(read_sample("results-glx.json"), false, false),
            "glx\nnot-started: no X server: DISPLAY is not set\n0 tests\n\nthe run is not complete\n");
}

TEST(Terminal, ReasonIsNeverCut) {
  json record = read_sample("results-glx.json");
  record["reason"] = std::string(300, 'x') + "; install it";
  EXPECT_TRUE(contains(terminal_summary(record, false, false), "x; install it\n"));
}

TEST(Terminal, EmptyRecordIsNotGreen) {
  EXPECT_EQ(terminal_summary(json::object(), false, false),
            "(unnamed)\nstatus unknown\n0 tests\n\nthe run is not complete\n");
}

}  // namespace
}  // namespace evalcts::reports
