// Tests the program as its users start it: exit codes, files, and libraries that misbehave.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include <evalcts/gl/c_program.h>
#include <evalcts/results/json.h>
#include "cli/issue.h"
#include "drill.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class CommandLine : public DrillTest {};

TEST_F(CommandLine, WrongUseIsTwo) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{},
        {"nonsense"},
        {"run", "--nonsense"},
        {"run", "--implementation", "nonsense"},
        {"run", "--filter", "No.SuchTest"},
        {"run", "--depth", "abysmal"},
        {"run", "--jobs", "0"},
        {"run", "--jobs", "many"},
        {"list", "nonsense"},
        {"explain", "nonsense"},
        {"run", "--seed", "-1"},
        {"fuzz", "--implementation", "production", "--seconds", "-3"},
        {"fuzz", "--implementation", "production", "--programs", "-3"},
        {"fuzz", "--implementation", "nonsense", "--programs", "3"},
        {"run", "--output", "/proc/evalcts"},
        {"run", "--library", "x", "--implementation", "production"},
        {"run", "--context", "none", "--implementation", "osmesa"},
        {"run", "--name", "../x", "--implementation", "production"},
        {"run", "--name", "x", "--implementation", "production", "--implementation", "reference"}}) {
    std::string typed;
    for (const std::string& argument : arguments) typed += argument + " ";
    EXPECT_EQ(evalcts(arguments).code, 2) << typed;
  }
  EXPECT_EQ(evalcts({"--help"}).code, 0);
  EXPECT_EQ(evalcts({"--version"}).code, 0);
}

TEST_F(CommandLine, ListsAndExplains) {
  const json requirements = parse_json(evalcts({"list", "requirements", "--json"}).text);
  EXPECT_EQ(requirements["requirements"].size(), 401u);
  const json implementations = parse_json(evalcts({"list", "implementations", "--json"}).text);
  EXPECT_EQ(implementations["implementations"].size(), 12u);
  const json coverage = parse_json(evalcts({"coverage", "--json"}).text);
  EXPECT_EQ(coverage["requirements"].size(), 401u);
  EXPECT_TRUE(coverage["problems"].empty());
  const std::string requirement_text = evalcts({"explain", "EV-MAP1-COPY"}).text;
  for (const char* const part : {"Map1State.CopyOnCall/UNMAPPED", "OpenGL-Refpages/gl2.1/xhtml/glMap1.xml"})
    EXPECT_TRUE(contains(requirement_text, part));
  const std::string explained = evalcts({"explain", "Map1State.CopyOnCall/UNMAPPED"}).text;
  for (const char* const part : {"EV-MAP1-COPY", "First of ", "    glMap1f(", "Compared: "})
    EXPECT_TRUE(contains(explained, part));
  EXPECT_TRUE(contains(evalcts({"explain", "Map1State.CopyOnCal/UNMAPPED"}).text,
                       "did you mean Map1State.CopyOnCall/UNMAPPED?"));
  EXPECT_TRUE(contains(evalcts({"explain", "EV-MAP1-COPPY"}).text, "did you mean EV-MAP1-COPY?"));
  EXPECT_TRUE(
      contains(evalcts({"explain", "Map1State.CopyOnCall"}).text, " tests, such as Map1State.CopyOnCall/"));
  // Words are searched for; an ID that does not exist stands for its words.
  for (const auto& [words, found] :
       {std::pair(std::vector<std::string>{"glMap2", "vorder"}, "EV-MAP2-ERR-VORDER: "),
        {{"GL_COEFF"}, "EV-GETMAP-COEFF"},
        {{"EV-MAP2-ERR-STRIDE"}, "EV-MAP2-ERR-USTRIDE: "},
        {{"saturate"}, "(mesa-getmap-saturation)"}}) {
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.begin(), "explain");
    const Outcome search = evalcts(arguments);
    EXPECT_EQ(search.code, 0) << search.text;
    EXPECT_TRUE(contains(search.text, found)) << found << " in " << search.text;
  }
  EXPECT_EQ(evalcts({"explain", "nothing contains this"}).code, 2);
  const std::string bug = evalcts({"explain", "mesa-point-end"}).text;
  for (const char* const part : {"a known bug of Mesa", "    glMapGrid1f(", "Cause: ", "glspec"})
    EXPECT_TRUE(contains(bug, part)) << part << " in " << bug;
  EXPECT_TRUE(contains(evalcts({"explain", "EV-COORD-CURRENT-a6d4"}).text,
                       "EV-COORD-CURRENT-a6d4 is a bug of a run, but not of the last one"));
  EXPECT_TRUE(contains(evalcts({"list", "tets"}).text, "did you mean tests?"));
  const std::string listed = evalcts({"list", "tests", "--filter", "InitialState.O*"}).text;
  EXPECT_TRUE(listed.starts_with("InitialState.OrderOf1D ")) << listed;
  EXPECT_FALSE(contains(listed, "\nMap"));
  EXPECT_EQ(evalcts({"list", "tests", "--filter", "No.SuchTest"}).code, 2);
  EXPECT_EQ(evalcts({"list", "bugs", "--filter", "x"}).code, 2);
  for (const char* verdict : {"not-observable", "not observed"})
    EXPECT_TRUE(evalcts({"explain", verdict}).text.starts_with("not observed: ")) << verdict;
  EXPECT_TRUE(contains(evalcts({"explain", "C-MESH1-LINES"}).text, "Taken here: LINE_STRIP."));
  for (const json& requirement : coverage["requirements"])
    if (as_text(requirement["id"]) == "EV-EXT-ARBVP-COLORINDEX") {
      EXPECT_EQ(as_text(requirement["state"]), "undecidable");
      EXPECT_TRUE(
          contains(evalcts({"coverage"}).text, requirement["reason"].get<std::string>().substr(0, 40)));
      EXPECT_TRUE(contains(evalcts({"explain", "EV-EXT-ARBVP-COLORINDEX"}).text, "undecidable"));
    }
}

TEST_F(CommandLine, RunWritesEverything) {
  const Outcome outcome = evalcts({"run", "--implementation", "reference", "--implementation", "production",
                                   "--filter", "InitialState.*:-*Domain", "--output", folder_.string()});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const std::string name : {"reference", "production"}) {
    const json result = results(name);
    ASSERT_TRUE(result.is_object());
    EXPECT_EQ(as_text(result["format"]), "evalcts-results-1");
    EXPECT_EQ(as_text(result["status"]), "complete");
    ASSERT_FALSE(result["tests"].empty());
    EXPECT_TRUE(test_named(result, "InitialState.Domain").is_null());
    EXPECT_EQ(result.value("started", "").size(), 20u);
    EXPECT_GT(result.value("seconds", 0.0), 0);
    EXPECT_FALSE(result.value("host", "").empty());
    EXPECT_TRUE(result["tests"][0].value("source", "").starts_with("suites/initial_state.cpp:"));
    EXPECT_EQ(result["summary"]["pass"], result["tests"].size());
    EXPECT_TRUE(fs::exists(folder_ / ("junit-" + name + ".xml")));
    EXPECT_TRUE(fs::exists(folder_ / ("records-" + name + ".jsonl")));
    EXPECT_FALSE(fs::exists(folder_ / ("results-" + name + ".reuse-context.json"))) << "a second pass";
    const std::string page = read_file(folder_ / "index.html");
    for (const std::string& file : {"results-" + name + ".json", "log-" + name + ".txt"})
      EXPECT_TRUE(contains(page, "<a href=\"" + file + "\">" + file + "</a>")) << file;
  }
}

// The drill library does not provide most commands.
TEST_F(CommandLine, LittleThatIsObservedIsNoPass) {
  std::vector<std::string> arguments =
      drill_arguments("nothing", {"--filter", "Map1State.Stride/*:InitialState.O*"});
  std::erase(arguments, "--allow-unobserved");
  const Outcome outcome = evalcts(arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, "tests could be observed, which is not a pass"));
  EXPECT_EQ(as_text(test_named(results("drill"), kVictim)["verdict"]), "pass");
}

// If a library violates one requirement, the record and the summary name the requirement and the calls.
TEST_F(CommandLine, FailureSaysWhatWasExpectedAndWhatCame) {
  const Outcome outcome = drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f"});
  EXPECT_EQ(outcome.code, 1);
  const json result = results("drill");
  EXPECT_EQ(as_text(test_named(result, "Map1Errors.StrideBelowK/MAP1_VERTEX_4_f")["verdict"]), "pass");
  const json test = test_named(result, "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  EXPECT_EQ(as_text(test["verdict"]), "fail");
  EXPECT_EQ(as_text(test["level"]), "must");
  EXPECT_EQ(as_text(test["requirements"][0]), "EV-MAP1-ERR-STRIDE");
  EXPECT_EQ(test["mismatches"].size(), 5u) << "one for each stride";
  EXPECT_EQ(as_text(test["expected"]), "GL_INVALID_VALUE");
  EXPECT_EQ(as_text(test["captured"]), "GL_NO_ERROR");
  EXPECT_TRUE(contains(test["message"], "missing error: after glMap1f(GL_MAP1_VERTEX_3"));
  const std::vector<std::string> calls = test["calls"];
  EXPECT_EQ(calls.back(), "glGetError();");
  EXPECT_TRUE(contains(calls[calls.size() - 2], "glMap1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 2, 3"));
  EXPECT_TRUE(contains(outcome.text, "EV-MAP1-ERR-STRIDE"));
}

// Regardless of the number of processes, each test runs once, and the results differ only in times.
TEST_F(CommandLine, JobsDecideTheSame) {
  const auto run = [&](const std::string& jobs) {
    const Outcome outcome = drill(
        "lenient",
        {"--filter", std::string("Map1State.*_f:Map1Errors.StrideBelowK/*:InitialState.*") + kWithoutLists,
         "--jobs", jobs, "--retry", "0"});
    EXPECT_EQ(outcome.code, 1) << outcome.text;
    std::map<std::string, int> lines;
    std::ifstream records(folder_ / "records-drill.jsonl");
    for (std::string line; std::getline(records, line);) {
      const json event = parse_json(line);
      EXPECT_TRUE(event.is_object()) << line;
      if (as_text(event["event"]) == "result") ++lines[event["record"]["name"]];
    }
    json result = results("drill");
    EXPECT_GT(result["tests"].size(), 50u);
    EXPECT_EQ(lines.size(), result["tests"].size());
    for (const auto& [name, count] : lines) EXPECT_EQ(count, 1) << name;
    std::size_t logged = 0;
    std::ifstream log(folder_ / "log-drill.txt");
    for (std::string line; std::getline(log, line);) logged += line.starts_with("[ RUN ");
    EXPECT_EQ(logged, result["tests"].size());
    for (const char* const member : {"command", "started", "seconds"}) result.erase(member);
    for (json& test : result["tests"]) test.erase("seconds");
    return result.dump();
  };
  const std::string one = run("1");
  EXPECT_EQ(run("3"), one);
}

// Quick depth runs at least one test of each decided requirement.
TEST_F(CommandLine, QuickDepthKeepsEveryRule) {
  const json tests = parse_json(evalcts({"list", "tests", "--json"}).text);
  std::map<std::string, bool> requirements;
  std::size_t quick = 0;
  for (const json& test : tests["tests"]) {
    const bool is_quick = as_text(test["from"]) == "quick";
    quick += is_quick;
    for (const std::string id : test["requirements"]) {
      bool& decided = requirements[id];
      decided = decided || is_quick;
    }
  }
  EXPECT_GT(quick, 500u);
  EXPECT_LT(quick, tests["tests"].size() / 5);
  for (const auto& [id, decided] : requirements) EXPECT_TRUE(decided) << id;
}

// The reading that an implementation follows is recorded. If the user chooses another reading,
// the test fails.
TEST_F(CommandLine, Readings) {
  const auto judge = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "run",      "--implementation",  "production", "--output", folder_.string(),
        "--filter", "Interpretations.*", "--baseline", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return evalcts(arguments).code;
  };
  EXPECT_EQ(judge({}), 0);
  const json readings = results("production")["readings"];
  ASSERT_TRUE(readings.contains("C-V-GETN")) << readings;
  const std::string followed = readings["C-V-GETN"][0];
  EXPECT_EQ(judge({"--interpretation", "C-V-GETN=" + followed}), 0);
  const std::string other = followed == "INVALID_VALUE" ? "INVALID_OPERATION" : "INVALID_VALUE";
  EXPECT_EQ(judge({"--interpretation", "C-V-GETN=" + other}), 1);
  EXPECT_EQ(results("production")["summary"]["fail"], 1);
}

TEST_F(CommandLine, WhatGoesWrongInAControlIsNotTheEvaluators) {
  const std::string name = "CurrentValues.Color/AT_ONCE/EvalCoord1f";
  using Case = std::pair<const char*, const char*>;
  for (const auto& [what, message] :
       {Case{"control", "pipeline: the process ended with signal 11"}, Case{"control-error", "pipeline: "}}) {
    const Outcome outcome = drill(what, {"--filter", name});
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const json test = test_named(results("drill"), name);
    EXPECT_EQ(as_text(test["verdict"]), "not-observable") << test;
    EXPECT_TRUE(contains(test["message"], message)) << test;
  }
  EXPECT_EQ(drill("nothing", {"--filter", name}).code, 0);
  EXPECT_EQ(as_text(test_named(results("drill"), name)["verdict"]), "pass");
}

TEST_F(CommandLine, DeathThatDependsOnAnEarlierTestNamesIt) {
  // The tests of the other targets define a map of order 7, before the last test defines INDEX with order 5.
  const Outcome outcome = drill("second", {"--filter",
                                           "Map1State.EveryOrderAccepted/MAP1_COLOR_4_*:"
                                           "Map1State.EveryOrderAccepted/MAP1_NORMAL_d:"
                                           "Map1State.Stride/MAP1_INDEX_f",
                                           "--jobs", "1"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  const std::string message = test_named(results("drill"), kVictim)["message"];
  EXPECT_TRUE(contains(message, "passes alone"));
  EXPECT_EQ(test_named(results("drill"), kVictim)["history"].size(), 1u);
  EXPECT_TRUE(contains(message, "after Map1State.EveryOrderAccepted/MAP1_COLOR_4_"));
  EXPECT_TRUE(contains(message, "Map1State.EveryOrderAccepted/MAP1_COLOR_4_f"));
}

// The second pass finds a bug that fresh contexts hide, and names the earlier test and case that
// it depends on.
TEST_F(CommandLine, SecondPassNamesTheShortestHistory) {
  const char* const guilty = "Map1State.Stride/MAP1_INDEX_f";
  const char* const victim = "Map1State.Stride/MAP1_VERTEX_3_f";
  const Outcome outcome =
      drill("history", {"--filter", "Map1State.Stride/*_f:InitialState.O*", "--reuse-context"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "\ndrill, one shared context: "));
  const json first = results("drill");
  EXPECT_EQ(first["summary"]["pass"], first["tests"].size()) << first["summary"];
  EXPECT_FALSE(first.contains("pass"));
  const json second = results("drill.reuse-context");
  EXPECT_EQ(as_text(second["pass"]), "reuse-context");
  EXPECT_EQ(as_text(second["status"]), "complete");
  const json test = test_named(second, victim);
  EXPECT_EQ(as_text(test["verdict"]), "fail");
  EXPECT_EQ(test["history"], json::array({guilty}));
  EXPECT_TRUE(contains(test["history_case"], "strides k to 2^16 + k"));
  EXPECT_TRUE(test["message"].get<std::string>().starts_with("after " + std::string(guilty)))
      << test["message"];
  EXPECT_EQ(as_text(test_named(second, guilty)["verdict"]), "pass");
  for (const char* name : {"junit-drill.reuse-context.xml", "log-drill.reuse-context.txt"})
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
}

TEST_F(CommandLine, SecondPassOfASoundLibraryFindsNothing) {
  const Outcome outcome = evalcts(
      {"run", "--implementation", "reference", "--implementation", "production", "--reuse-context", "--depth",
       "full", "--filter", "InitialState.*:Map1State.Stride/MAP1_VERTEX_*:CurrentValues.*Color*:Enables.*",
       "--output", folder_.string()});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const std::string name : {"reference", "production"})
    EXPECT_EQ(results(name + ".reuse-context")["summary"], results(name)["summary"]) << name;
}

// In the second pass, a failure that also occurs in fresh contexts is expected; other failures need an entry
// in the baseline of this pass.
TEST_F(CommandLine, SecondPassKnowsWhatFailsAnyway) {
  const std::vector<std::string> tests = {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f",
                                          "--reuse-context"};
  EXPECT_EQ(drill("lenient", tests).code, 1);  // because of the first pass
  const json known = test_named(results("drill.reuse-context"), "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f");
  EXPECT_EQ(as_text(known["verdict"]), "fail");
  EXPECT_EQ(known["expected_by_baseline"], true);
  EXPECT_EQ(as_text(known["baseline_reason"]), "fails in a fresh context as well");
  EXPECT_FALSE(known.contains("history"));

  const fs::path baseline = folder_ / "baseline";
  std::vector<std::string> history = {"--filter", "Map1State.Stride/MAP1_*_f", "--reuse-context",
                                      "--baseline", baseline.string()};
  history.push_back("--write-baseline");
  EXPECT_EQ(drill("history", history).code, 0);
  EXPECT_TRUE(fs::exists(baseline / "drill.reuse-context-fails.txt"));
  EXPECT_FALSE(contains(read_file(baseline / "drill-fails.txt"), ",Fail"));
  history.back() = "--strict";
  EXPECT_EQ(drill("history", history).code, 0);
  EXPECT_EQ(drill("nothing", history).code, 1);  // an unexpected pass
}

// Uses the baseline as CI does: skipped tests do not run, flaky tests never fail the run, and changes do.
TEST_F(CommandLine, BaselineDecidesWhatIsRed) {
  const fs::path baseline = folder_ / "baseline";
  const auto run = [&](const std::string& what, std::vector<std::string> more = {}) {
    more.insert(more.end(),
                {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f:Map1State.Stride/MAP1_INDEX_f",
                 "--baseline", baseline.string(), "--timeout", "20"});
    return drill(what, more);
  };
  const auto append = [&](const char* name, const std::string& text) {
    std::ofstream(baseline / name, std::ios::app) << text;
  };
  EXPECT_EQ(run("lenient", {"--write-baseline"}).code, 0);
  EXPECT_EQ(run("lenient", {"--strict"}).code, 0);

  // Replaces the signature by that of a run in which other cases failed.
  const fs::path signatures = baseline / "drill-signatures.txt";
  const std::string right = read_file(signatures), test = "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f";
  ASSERT_TRUE(contains(right, "seed 1"));
  std::ofstream(signatures) << test << ",thorough,1-0000000000000000\n";
  const Outcome changed = run("lenient");
  EXPECT_EQ(changed.code, 1);
  EXPECT_TRUE(contains(test_named(results("drill"), test)["message"], "other cases fail"));
  EXPECT_EQ(run("lenient", {"--seed", "2"}).code, 0);  // not compared
  std::ofstream(signatures) << right;

  // Deletes the entry of one failure, but not its signature.
  const fs::path fails = baseline / "drill-fails.txt";
  const std::string entries = read_file(fails), entry = test + ",Fail\n";
  ASSERT_TRUE(contains(entries, entry));
  std::ofstream(fails) << std::string(entries).erase(entries.find(entry), entry.size());
  const Outcome taken_back = run("lenient", {"--quiet"});
  EXPECT_EQ(taken_back.code, 1);
  EXPECT_TRUE(contains(taken_back.text, "drill: 1 new failure"));
  EXPECT_TRUE(contains(taken_back.text, test + " has a signature but no entry in drill-fails.txt; the "
                                               "signature is ignored\n"))
      << taken_back.text;
  std::ofstream(fails) << entries;

  EXPECT_EQ(run("nothing").code, 0);
  const Outcome passes = run("nothing", {"--strict"});
  EXPECT_EQ(passes.code, 1);
  EXPECT_TRUE(
      contains(passes.text, "\n1 unexpected pass (--strict): Map1Errors.StrideBelowK/MAP1_VERTEX_3_f"));

  EXPECT_EQ(run("crash").code, 1);
  append("drill-flakes.txt", "# crashes now and then\n^Map1State\\.Stride/MAP1_INDEX_f$\n");
  const Outcome flaky = run("crash");
  EXPECT_EQ(flaky.code, 0) << flaky.text;
  EXPECT_EQ(as_text(test_named(results("drill"), kVictim)["baseline_reason"]), "flaky: crashes now and then");
  EXPECT_EQ(run("lenient", {"--strict"}).code, 0);  // ... and passes

  append("drill-skips.txt", "# takes the machine down\nMAP1_INDEX_f$\n\n# gone\n^Gone\\.\n");
  EXPECT_EQ(run("crash").code, 0);
  const json skipped = test_named(results("drill"), kVictim);
  EXPECT_EQ(as_text(skipped["verdict"]), "skipped");
  EXPECT_EQ(as_text(skipped["message"]), "takes the machine down");
  EXPECT_FALSE(contains(text_of("log-drill.txt"), "MAP1_INDEX_f"));

  const Outcome stale = run("lenient", {"--strict"});
  EXPECT_EQ(stale.code, 1);
  EXPECT_TRUE(
      contains(stale.text, "\n1 stale baseline entry (--strict): ^Gone\\. (in the skips); 1 known (base"));
  EXPECT_TRUE(contains(text_of("summary.md"), "1 stale baseline entry (--strict): ^Gone\\. (in the skips)"));
  EXPECT_FALSE(contains(text_of("summary.md"), "No "));
  EXPECT_EQ(results("drill")["stale_baseline_entries"].size(), 1u);

  append("drill-flakes.txt", "\n# wrong\n*\n");
  const Outcome bad = run("lenient");
  EXPECT_EQ(bad.code, 2);
  EXPECT_TRUE(contains(bad.text, "drill-flakes.txt:5: '*' is not a regular expression"));
}

// A baseline is chosen by its header, and by name if no header fits.
TEST_F(CommandLine, BaselineIsNamedAndChosen) {
  const fs::path folder = folder_ / "baseline";
  const auto run = [&](const std::string& baseline, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f", "--baseline", baseline});
    return drill("lenient", more);
  };
  EXPECT_EQ(run(folder.string(), {"--write-baseline"}).code, 0);
  EXPECT_TRUE(
      contains(run(folder.string()).text, "baseline: drill (--baseline DIR adds failures that you know, "));

  const std::string own = read_file(folder / "drill-fails.txt"), first = "# vendor: ";
  ASSERT_TRUE(own.starts_with(first)) << own;
  std::ofstream(folder / "drill-fails.txt") << first << "somebody else" << own.substr(own.find('\n'));
  const Outcome other = run(folder.string());
  EXPECT_EQ(other.code, 1);
  EXPECT_TRUE(contains(other.text, "baseline: none; 'evalcts waive' or --write-baseline"));
  EXPECT_EQ(run((folder / "drill").string()).code, 0);

  const Outcome absent = run((folder / "absent").string());
  EXPECT_EQ(absent.code, 2);
  EXPECT_TRUE(contains(absent.text, "not a directory, a baseline in a directory"));
}

// --write-baseline must not replace a file of the same name whose header does not fit the implementation.
TEST_F(CommandLine, WriteBaselineKeepsFilesForOtherImplementations) {
  const fs::path folder = folder_ / "baseline";
  const std::string other = "# version: Mesa 20.3\n\n# found by hand\nMap1State.Stride/MAP1_INDEX_f,Fail\n";
  fs::create_directories(folder);
  std::ofstream(folder / "drill-fails.txt") << other;
  const auto write = [&](const std::string& baseline) {
    return drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f", "--baseline", baseline,
                             "--write-baseline"});
  };

  const Outcome rejected = write(folder.string());
  EXPECT_EQ(rejected.code, 2);
  EXPECT_TRUE(contains(rejected.text, "drill-fails.txt is for other implementations (version: Mesa 20.3)"));
  EXPECT_EQ(read_file(folder / "drill-fails.txt"), other);
  EXPECT_EQ(results("drill")["tests"].size(), 1u);  // the results are not lost

  EXPECT_EQ(write((folder / "drill").string()).code, 0);
  EXPECT_TRUE(contains(read_file(folder / "drill-fails.txt"), "# found by hand\n"));
  EXPECT_TRUE(contains(read_file(folder / "drill-fails.txt"), "StrideBelowK/MAP1_VERTEX_3_f,Fail"));
}

TEST_F(CommandLine, ShuffledRunsDecideTheSame) {
  const auto names = [](const json& result) {
    std::vector<std::string> all;
    for (const json& test : result["tests"]) all.push_back(test["name"]);
    return all;
  };
  const std::string filter = std::string("Map1State.Stride/*:Map1Errors.StrideBelowK/*") + kWithoutLists;
  EXPECT_EQ(drill("lenient", {"--filter", filter}).code, 1);
  const json plain = results("drill");
  EXPECT_EQ(drill("lenient", {"--filter", filter, "--shuffle", "7"}).code, 1);
  const json shuffled = results("drill");
  EXPECT_NE(names(plain), names(shuffled));
  EXPECT_EQ(plain["summary"], shuffled["summary"]);
}

TEST_F(CommandLine, WhatCannotStartIsNotStarted) {
  const Outcome crash = drill("start");
  EXPECT_EQ(crash.code, 2) << crash.text;
  EXPECT_EQ(as_text(results("drill")["status"]), "not-started");
  EXPECT_TRUE(contains(results("drill")["reason"], "SIGSEGV"));

  unsetenv("EVALCTS_DRILL");
  const fs::path text = folder_ / "text.so";
  std::ofstream(text) << "no library\n";
  const std::pair<std::string, std::string> cases[] = {
      {text.string(), "cannot load"},
      {(folder_ / "absent.so").string(), "cannot load"},
      {"libm.so.6", "it is not OSMesa"},
      {DRILL_WITHOUT_EVALUATORS_LIBRARY, "has no evaluators"}};
  for (const auto& [library, reason] : cases) {
    const Outcome outcome =
        evalcts({"run", "--implementation", "osmesa", "--library", library, "--name", "drill", "--output",
                 folder_.string(), "--filter", "InitialState.*", "--quiet"});
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_TRUE(outcome.text.starts_with("drill: Not judged: ")) << outcome.text;
    const json result = results("drill");
    EXPECT_EQ(as_text(result["status"]), "not-started");
    EXPECT_TRUE(contains(result["reason"], reason));
    EXPECT_TRUE(contains(outcome.text, reason));
  }
  const std::pair<std::string, std::string> readings[] = {{"C-V-GETN", "is not NAME=READING"},
                                                          {"C-NONE=x", "unknown interpretation 'C-NONE'"},
                                                          {"C-V-GETN=x", "C-V-GETN has no reading 'x'"}};
  for (const auto& [choice, reason] : readings) {
    const Outcome outcome = evalcts({"run", "--implementation", "production", "--interpretation", choice,
                                     "--output", folder_.string(), "--filter", "InitialState.O*"});
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, reason));
  }
  const std::pair<std::vector<std::string>, std::string> contexts[] = {
      {{"--context", "none"}, "--context none needs --library"},
      {{"--context", "nonsense"},
       "neither one of osmesa, egl-surfaceless, egl-device, egl-gles2, glx, glx-indirect, wgl, cgl, none nor "
       "a provider"},
      {{"--context", "egl-gles2"}, "--context egl-gles2 needs --library"},
      {{"--context", "./absent.so"}, "cannot load './absent.so'"},
      {{"--context", "libm.so.6"}, "does not export evalcts_provider_open"},
      {{"--context", "none", "--library", "libm.so.6"}, "glGetString"},
      {{"--implementation", "sink"}, "needs --library"},
      {{"--implementation", "sink", "--library", "libm.so.6"}, "exports no evalcts_sink_open"},
      {{"--implementation", "egl", "--library", "libm.so.6"}, "it is not EGL"},
      {{"--implementation", "glx", "--library", "libm.so.6"}, "it is not GLX"},
      {{"--library", "libm.so.6"}, "choose the interface that creates its contexts with --context"},
      {{"--library", OSMESA_PROVIDER}, "pass it with --context"}};
  for (const auto& [more, reason] : contexts) {
    std::vector<std::string> arguments = {"run", "--name", "drill", "--output", folder_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = evalcts(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, reason));
  }
  // The kind is guessed from the library's symbols.
  EXPECT_EQ(evalcts({"run", "--library", DRILL_LIBRARY, "--output", folder_.string(), "--filter",
                     "InitialState.O*"})
                .code,
            0);
}

// A library with its own context, which cannot create any.
TEST_F(CommandLine, ContextNone) {
  const std::vector<std::string> arguments = {"run",
                                              "--library",
                                              DRILL_OWN_CONTEXT_LIBRARY,
                                              "--name",
                                              "own",
                                              "--output",
                                              folder_.string(),
                                              "--filter",
                                              "Map1State.Stride/*",
                                              "--depth",
                                              "thorough"};
  Outcome outcome = evalcts(arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, "exports none of OSMesaCreateContext"));
  std::vector<std::string> with_context = arguments;
  with_context.insert(with_context.end(), {"--context", "none", "--allow-unobserved"});
  outcome = evalcts(with_context);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_GT(results("own")["summary"].value("pass", 0), 10) << outcome.text;
}

// The declared features of a sink are judged; tests of other features are not-supported.
TEST_F(CommandLine, SinkIsJudgedByWhatItDeclares) {
  const Outcome outcome =
      evalcts({"run", "--library", BEZIER_SINK, "--name", "bezier", "--depth", "thorough", "--output",
               folder_.string(), "--filter", "Map1*:Precedence*:Api.VectorForm/*:Api.EntryPoint/*Map1*"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const json result = results("bezier");
  EXPECT_EQ(as_text(result["implementation"]["renderer"]), "Bezier example");
  const std::pair<const char*, const char*> expected[] = {
      {"Map1Values.AllOrders/MAP1_VERTEX_3/EvalCoord1f", "pass"},
      {"Map1Values.Ends/MAP1_VERTEX_4/EvalCoord1fv", "pass"},
      {"Precedence.Vertex4BeforeVertex3/EvalCoord1f", "pass"},
      {"Map1Values.AllOrders/MAP1_VERTEX_3/EvalCoord1d", "not-supported"},  // no such command
      {"Map1Values.AllOrders/MAP1_COLOR_4/EvalCoord1f", "not-supported"},   // no such target
      {"Map1Errors.StrideBelowK/MAP1_VERTEX_3_f", "not-supported"},         // no GetError
      {"Api.EntryPoint/Map1d", "not-supported"}};
  for (const auto& [name, verdict] : expected)
    EXPECT_EQ(as_text(test_named(result, name)["verdict"]), verdict) << name;
  for (const char* verdict : {"fail", "crash", "internal-error"})
    EXPECT_FALSE(result["summary"].contains(verdict)) << verdict;
}

TEST_F(CommandLine, SmallestSinkPassesAndItsWrongTwinFails) {
  const auto run = [&](const char* library, const char* name) {
    return evalcts(
        {"run", "--library", library, "--name", name, "--allow-unobserved", "--output", folder_.string()});
  };
  const Outcome right = run(SMALLEST_SINK, "smallest");
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_GT(results("smallest")["summary"].value("pass", 0), 10) << right.text;
  const Outcome wrong = run(WRONG_SINK, "wrong");
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_EQ(as_text(test_named(results("wrong"), "Map1Values.Ends/MAP1_VERTEX_3/EvalCoord1f")["verdict"]),
            "fail");
}

TEST_F(CommandLine, IssuesCanBeFiled) {
  // A known bug, without a run.
  const std::string known = evalcts({"bugs", "--issue", "mesa-getmap-saturation", folder_.string()}).text;
  EXPECT_EQ(known.find("# OpenGL evaluators: GetMapiv answers the lower 32 bits"), 0u) << known;
  for (const char* const part :
       {"Affected: Mesa 20.3 to ", "\n> If a value is so large in magnitude that ",
        "```c\nglMap1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 1, (GLfloat[]){3000000000.0f});\n",
        "* Expected: 2147483647\n* Observed: -1294967296",
        "## Rule\n\nGetMapiv of a value beyond the int range", "glspec21.pdf)", "## Cause",
        "## Effect on real programs\n\nPrograms that",
        "evalcts check mesa-getmap-saturation --mesa-build build"})
    EXPECT_TRUE(contains(known, part)) << part << " in " << known;
  // A bug outside the evaluators, of a driver.
  const std::string outside =
      evalcts({"bugs", "--issue", "mesa-zink-short-primitives", folder_.string()}).text;
  for (const char* const part :
       {"# zink: glEndList crashes ", "22.3.6, 25.0.7 and 26.2.6 have the bug",
        "The program uses no evaluators.",
        "GALLIUM_DRIVER=zink evalcts check mesa-zink-short-primitives --mesa-build build"})
    EXPECT_TRUE(contains(outside, part)) << part << " in " << outside;
  EXPECT_EQ(evalcts({"bugs", "--issue", "mesa-nothing", folder_.string()}).code, 2);
  // A new bug of a run.
  reduces_failures_ = true;
  drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f"});
  const json bugs = results("drill")["bugs"];
  ASSERT_EQ(bugs.size(), 1u);
  const Outcome outcome = evalcts({"bugs", "--issue", bugs[0]["id"].get<std::string>(), folder_.string()});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const char* const part : {"\nObserved with: ", "glMap1f(GL_MAP1_VERTEX_3, ",
                                 "* Expected: ", "## Rule\n\nINVALID_VALUE if stride < k. (",
                                 "1 of its tests fails", "evalcts reproduce "})
    EXPECT_TRUE(contains(outcome.text, part)) << part << " in " << outcome.text;
}

// Starts the program in $0 with indirect GLX. Its exit code is 124 if it hangs, and 2 without an X server.
constexpr char kWithIndirectGlx[] = R"(
LD_PRELOAD=libOSMesa.so.8 Xvfb -displayfd 3 -screen 0 64x64x24 -nolisten tcp +iglx 3>$0.display 2>$0.log & server=$!
for i in $(seq 50); do test -s $0.display && break; sleep 0.1; done
DISPLAY=:$(cat $0.display) timeout 5 $0
code=$?
kill -9 $server
exit $code)";

// The examples of known bugs are complete programs, and those of Mesa show the bugs of an affected Mesa.
TEST_F(CommandLine, ExamplesOfKnownBugsShowThem) {
  for (const KnownBug& bug : known_bugs()) {
    EXPECT_FALSE(bug.example.empty() && bug.programs.empty()) << bug.id;
    if (bug.example.empty()) continue;
    const std::string source = (folder_ / "example.c").string(), program = (folder_ / "example").string();
    const bool is_indirect = bug.context == KnownBug::kIndirectGlx;
    std::ofstream(source) << gl::to_c({.style = gl::CStyle::kShort,
                                       .context = is_indirect ? "glx-indirect" : "egl",
                                       .library = "libEGL.so.1"},
                                      bug.example, bug.fails,
                                      bug.context == KnownBug::kCoreProfile ? EVALCTS_CORE_PROFILE : 0);
    const Outcome built = start({"/usr/bin/env", "cc", "-Wall", "-Wextra", "-Werror", "-o", program, source,
                                 is_indirect ? "-lX11" : "-lEGL", "-lGL"});
    ASSERT_EQ(built.code, 0) << bug.id << built.text;
    const std::string driver = bug.affects.renderer.empty() ? "llvmpipe" : bug.affects.renderer;
    const Outcome run = is_indirect
                            ? start({"/bin/sh", "-c", kWithIndirectGlx, program})
                            : start({"/usr/bin/env", "GALLIUM_DRIVER=" + driver, "timeout", "60", program});
    const std::string version = run.text.substr(0, run.text.find('\n'));
    if (run.code == 2 || !contains(version, bug.affects.renderer)) continue;
    const auto is_one_of = [&](const std::vector<std::string>& versions) {
      return std::ranges::any_of(versions, [&](const std::string& each) {
        return contains(version, bug.affects.product + " " + each);
      });
    };
    if (is_one_of(bug.affects.without)) {
      EXPECT_EQ(run.code, 0) << bug.id << run.text;
    }
    if (!is_one_of(bug.affects.tested)) continue;
    if (!is_indirect) {  // an indirect context has a bug that is a hang
      EXPECT_NE(run.code, 124) << bug.id << " exceeds the time limit: " << run.text;
    }
    if (bug.fails.empty()) {
      EXPECT_NE(run.code, 0) << bug.id << run.text;
    } else {
      EXPECT_EQ(run.code, 1) << bug.id << run.text;
      EXPECT_TRUE(contains(run.text, "expected")) << run.text;
    }
  }
}

TEST_F(CommandLine, ChecksSayByTheirExitCodeWhatIsWrong) {
  const auto check = [&](const std::string& name, const std::string& library) {
    return evalcts({"check", name, "--library", library});
  };
  for (const std::string name :
       {"EV-MAP1-ZEROPOW", "Map1Values.Ends", "Map1Values.Ends/MAP1_VERTEX_3/EvalCoord1f"}) {
    const Outcome good = check(name, SMALLEST_SINK);
    EXPECT_EQ(good.code, 0) << good.text;
    EXPECT_TRUE(contains(good.text, "good: ")) << good.text;
    const Outcome bad = check(name, WRONG_SINK);
    EXPECT_EQ(bad.code, 1) << bad.text;
    EXPECT_TRUE(contains(bad.text, "bad: Map1Values.")) << bad.text;
  }
  // A failure that violates another requirement does not count.
  EXPECT_EQ(check("EV-MAP1-STRIDE", WRONG_SINK).code, 0);
  // The example of a known bug, which the system's Mesa may have.
  const Outcome example = evalcts({"check", "mesa-list-line-loop", "--implementation", "egl"});
  const bool is_run = contains(example.text, "the example of ");
  EXPECT_EQ(example.code, !is_run ? 125 : example.text.starts_with("bad: ") ? 1 : 0) << example.text;
  // The programs of a known bug, which the sink passes as far as it has their commands.
  EXPECT_EQ(evalcts({"check", "mesa-point-end", "--implementation", "production"}).code, 0);
  for (const auto& [name, library, why] :
       {std::tuple("Meshes.Nonsense", SMALLEST_SINK,
                   "is not a known bug, a requirement or a test that can be run"),
        {"EV-MAP1-ZEROPOW", "/no/such/library.so", "no such file"},
        {"Mesh2.FlatShading", SMALLEST_SINK, "Mesh2.FlatShading"}}) {
    const Outcome unknown = check(name, library);
    EXPECT_EQ(unknown.code, 125) << unknown.text;
    EXPECT_TRUE(unknown.text.starts_with("cannot be judged: ") && contains(unknown.text, why))
        << unknown.text;
  }
}

// The fourth of eight commits reads control points with the wrong stride, and the third and fifth do not
// compile.
TEST_F(CommandLine, ChecksDecideABisection) {
  if (start({"/usr/bin/env", "git", "--version"}).code != 0) GTEST_SKIP() << "git is not installed";
  const std::string source = read_file(SMALLEST_SINK_SOURCE), right = "p[i / 3 * stride + i % 3]";
  ASSERT_NE(source.find(right), std::string::npos);
  setenv("GIT_CONFIG_GLOBAL", "/dev/null", 1);
  const auto git = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"/usr/bin/env", "git", "-C", folder_.string(), "-c",
                                         "user.name=test", "-c", "user.email=test@localhost"});
    return start(arguments);
  };
  ASSERT_EQ(git({"init", "--quiet"}).code, 0);
  for (int commit = 1; commit <= 8; ++commit) {
    std::string text = source + "/* " + std::to_string(commit) + " */\n";
    if (commit >= 4) text.replace(text.find(right), right.size(), "p[i]");
    if (commit == 3 || commit == 5) text += "does not compile\n";
    std::ofstream(folder_ / "sink.c") << text;
    git({"add", "sink.c"});
    ASSERT_EQ(git({"commit", "--quiet", "--message", "commit " + std::to_string(commit)}).code, 0);
  }
  git({"bisect", "start", "HEAD", "HEAD~7"});
  const std::string build =
      "cc " CC_OPTIONS "-shared -fPIC -I" PLUGIN_HEADERS " -o libsink.so sink.c || exit 125; ";
  const Outcome found = git({"bisect", "run", "sh", "-c",
                             build + EVALCTS_PROGRAM + " check EV-MAP1-STRIDE --library ./libsink.so"});
  // Since the third commit cannot be judged, it may be the first bad one as well.
  EXPECT_TRUE(contains(found.text, "The first bad commit could be any of")) << found.text;
  EXPECT_TRUE(contains(found.text, "good: ") && contains(found.text, "bad: ")) << found.text;
  const std::string end = found.text.substr(found.text.find("The first bad commit could be any of"));
  for (const int commit : {3, 4})
    EXPECT_TRUE(
        contains(end, git({"rev-parse", fmt::format("refs/heads/master~{}", 8 - commit)}).text.substr(0, 40)))
        << end;
}

TEST_F(CommandLine, NamedImplementationsThatStartAreStillJudged) {
  const Outcome outcome = evalcts({"run", "--implementation", "reference", "--filter", "InitialState.Grid1",
                                   "--output", folder_.string()});
  EXPECT_EQ(outcome.code, 0);
  // A run first removes stale files of an earlier run with the same name.
  drill("start");
  EXPECT_FALSE(fs::exists(folder_ / "records-drill.jsonl"));
  EXPECT_TRUE(fs::exists(folder_ / "results-reference.json"));
}

// If a child is killed from outside, the running test gets a verdict, and the remaining tests run.
TEST_F(CommandLine, KilledChildIsReplaced) {
  std::vector<std::string> command =
      drill_arguments("hang", {"--filter", std::string("Map1State.Stride/*:InitialState.O*") + kWithoutLists,
                               "--jobs", "1", "--no-bugs"});
  command.insert(command.begin(), EVALCTS_PROGRAM);
  ChildProcess run(command, (folder_ / "command.log").string());
  // Two children are killed when they hang: the first one in the test, the second one is to confirm that.
  pid_t killed = 0;
  for (int round = 0; round < 2; ++round) {
    pid_t latest = killed;
    for (int i = 0; i < 1000 && latest == killed; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::ifstream hanging(drill_file());
      for (pid_t each = 0; hanging >> each;) latest = each;
    }
    ASSERT_NE(latest, killed);
    kill(latest, SIGKILL);
    killed = latest;
  }
  const auto ending = run.wait(60);
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->value, 1);
  const json result = results("drill");
  EXPECT_EQ(as_text(result["status"]), "complete");
  EXPECT_EQ(as_text(test_named(result, kVictim)["verdict"]), "crash");
  EXPECT_TRUE(contains(test_named(result, kVictim)["message"], "SIGKILL"));
  EXPECT_EQ(result["summary"]["crash"], 1);
}

// Results before the signal are kept. With three processes, these are all but the hanging test, and include a
// crash that has not been confirmed.
TEST_F(CommandLine, InterruptedRunKeepsWhatItHas) {
  for (const std::string jobs : {"1", "3"})
    for (const int signal : {SIGINT, SIGTERM}) {
      fs::remove(folder_ / "records-drill.jsonl");
      setenv("EVALCTS_DRILL", jobs == "1" ? "hang" : "both", 1);
      ChildProcess run({EVALCTS_PROGRAM, "run", "--implementation", "osmesa", "--library", DRILL_LIBRARY,
                        "--name", "drill", "--output", folder_.string(), "--filter",
                        "Map1State.Stride/*:InitialState.O*", "--jobs", jobs},
                       (folder_ / "command.log").string());
      const auto reached = [&] {
        bool started = false, last_ended = false;
        std::ifstream records(folder_ / "records-drill.jsonl");
        for (std::string line; std::getline(records, line);) {
          const json event = parse_json(line);
          if (!event.is_object()) continue;
          if (as_text(event["event"]) == "start") started = started || as_text(event["name"]) == kVictim;
          if (as_text(event["event"]) == "result")
            last_ended = last_ended || as_text(event["record"]["name"]) == "Map1State.Stride/MAP1_VERTEX_4_f";
        }
        return started && (jobs == "1" || last_ended);
      };
      for (int i = 0; i < 1000 && !reached(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      kill(run.id(), signal);
      const auto ending = run.wait(20);
      ASSERT_TRUE(ending);
      EXPECT_EQ(ending->value, 2);
      const json result = results("drill");
      EXPECT_EQ(as_text(result["status"]), "interrupted");
      EXPECT_EQ(as_text(test_named(result, "InitialState.OrderOf1D")["verdict"]), "pass");
      const json victim = test_named(result, kVictim);
      if (jobs == "1") {
        EXPECT_TRUE(victim.is_null());
      } else {
        EXPECT_EQ(as_text(test_named(result, "Map1State.Stride/MAP1_VERTEX_4_f")["verdict"]), "pass");
        EXPECT_TRUE(test_named(result, "Map1State.Stride/MAP1_INDEX_d").is_null());
        ASSERT_FALSE(victim.is_null());
        EXPECT_EQ(as_text(victim["verdict"]), "crash");
        EXPECT_TRUE(contains(victim["message"], "not confirmed")) << victim;
      }
      EXPECT_TRUE(fs::exists(folder_ / "junit-drill.xml"));
    }
}

}  // namespace
}  // namespace evalcts
