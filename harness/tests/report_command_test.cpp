// Tests `evalcts report`: the files that it accepts and writes, and that a rejected command changes nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include <evalcts/results/files.h>
#include "program.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class Report : public ProgramTest {
 protected:
  static json record(const std::string& name, const std::string& verdict) {
    return {{"format", "evalcts-results-1"},
            {"status", "complete"},
            {"depth", "full"},
            {"seed", 1},
            {"implementation", {{"name", name}}},
            {"summary", {{verdict, 1}}},
            {"tests", json::array({{{"name", "Map1State.Stride"},
                                    {"requirements", {"EV-MAP1-COPY"}},
                                    {"level", "must"},
                                    {"verdict", verdict},
                                    {"expected_by_baseline", false},
                                    {"baseline_reason", ""}}})}};
  }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  std::string path(const std::string& file) const { return (folder_ / file).string(); }
};

TEST_F(Report, PutsFilesAndFoldersSideBySide) {
  write("a/results-osmesa.json", record("osmesa", "pass").dump());
  write("a/results-egl.json", record("egl", "fail").dump());
  write("a/ulp.json", "no result");
  write("b/results-osmesa.json", record("osmesa", "crash").dump());
  write("other.json", record("mine", "pass").dump());
  const Outcome outcome = evalcts({"report", path("a"), path("b/results-osmesa.json"), path("other.json"),
                                   path("a/results-egl.json"), "--output", path("out/deep")});
  EXPECT_EQ(outcome.code, 0) << outcome.text;  // failures in the results do not change the exit code
  const std::string page = text_of("out/deep/index.html");
  for (const std::string& label :
       std::vector<std::string>{"osmesa (" + path("a") + ")", "osmesa (" + path("b") + ")",
                                std::string("egl"), std::string("mine")})
    EXPECT_TRUE(contains(page, "<h3>" + label + "</h3>")) << label;
  EXPECT_TRUE(contains(page, "1 test on 4 implementations"));
  EXPECT_TRUE(contains(page, "The points are read before Map")) << "the texts of the requirements";
  EXPECT_TRUE(contains(text_of("out/deep/summary.md"), "| `egl` | **1** |"));
}

TEST_F(Report, PutsShardsTogether) {
  json one = record("osmesa", "pass"), two = record("osmesa", "pass");
  one["shard"] = "1-of-2";
  two["shard"] = "2-of-2";
  two["tests"][0]["name"] = "Map1State.Another";
  write("first/results-osmesa.1-of-2.json", one.dump());
  write("second/results-osmesa.2-of-2.json", two.dump());
  const Outcome outcome = evalcts({"report", path("first"), path("second"), "--output", path("out")});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "osmesa\n2 tests: 2 pass\n")) << outcome.text;
  EXPECT_TRUE(contains(text_of("out/index.html"), "2 tests on 1 implementation"));
}

TEST_F(Report, ARegressionIsOne) {
  write("old/results-x.json", record("x", "pass").dump());
  write("new/results-x.json", record("x", "fail").dump());
  const Outcome worse = evalcts({"report", path("new"), "--before", path("old"), "--output", path("out")});
  EXPECT_EQ(worse.code, 1) << worse.text;
  EXPECT_TRUE(contains(worse.text, "x since the earlier results: 1 regression\n")) << worse.text;
  EXPECT_TRUE(contains(text_of("out/summary.md"), "* `x`: 1 regression\n"));
  EXPECT_TRUE(contains(text_of("out/index.html"), "1 regression"));
  const Outcome better =
      evalcts({"report", path("old"), "--before", path("new/results-x.json"), "--output", path("out")});
  EXPECT_EQ(better.code, 0) << better.text;
  EXPECT_TRUE(contains(better.text, "1 fix\n")) << better.text;
}

// The history has all runs in the folder of results, whatever else is there.
TEST_F(Report, HasTheHistoryOfAllRuns) {
  const auto run = [&](const std::string& folder, const std::string& version, const std::string& date,
                       const std::string& verdict) {
    json result = record("x", verdict);
    result["implementation"]["version"] = version;
    result["started"] = date;
    if (verdict == "fail")
      result["bugs"] = {{{"id", "EV-MAP1-COPY-1234"},
                         {"title", "stride"},
                         {"tests", {"Map1State.Stride"}},
                         {"failure", {{"case", "c"}}},
                         {"verdict", "fail"},
                         {"level", "must"}}};
    write("runs/" + folder + "/results-x.json", result.dump());
  };
  EXPECT_EQ(evalcts({"report", "--history"}).code, 2);
  run("x-1", "4.5 Mesa 9.0", "2026-01-01T10:00:00Z", "fail");
  run("x-2", "4.5 Mesa 22.3.6", "2026-01-02T10:00:00Z", "pass");
  write("runs/broken/results-x.json", "{");
  write("runs/notes/text.txt", "");
  fs::create_directory_symlink("x-2", folder_ / "runs/latest");
  const Outcome outcome = evalcts({"report", "--history"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const char* const part :
       {"History of x, full depth: 2 runs\n", "  Mesa 9.0: bugs: 1\n",
        "  Mesa 22.3.6: bugs: 0; 1 gone: EV-MAP1-COPY-1234\n", "broken/results-x.json': this is not JSON",
        "left out: '", "notes' contains no results"})
    EXPECT_TRUE(contains(outcome.text, part)) << part << " in " << outcome.text;
  const std::string page = text_of("runs/x-2/index.html");
  EXPECT_TRUE(contains(page, "<h2 id=\"history\"")) << outcome.text;
  EXPECT_TRUE(contains(page, "Bugs: 1 to 0"));
  EXPECT_FALSE(fs::exists(folder_ / "runs/x-1/index.html"));
  // Folders that are given: the page is that of their last run.
  EXPECT_EQ(evalcts({"report", "--history", path("runs"), "--output", path("page")}).code, 0);
  EXPECT_TRUE(contains(text_of("page/index.html"), "Mesa 22.3.6"));
  const Outcome foreign = evalcts({"report", "--history", path("runs/notes")});
  EXPECT_EQ(foreign.code, 2);
  EXPECT_TRUE(contains(foreign.text, "has no runs")) << foreign.text;
}

TEST_F(Report, WhatIsNoResultIsRefusedAndNothingIsWrittenOver) {
  const std::string good = record("x", "pass").dump();
  json foreign = record("x", "pass"), wrong = foreign, nameless = foreign, twice = foreign, shard = foreign;
  foreign["format"] = "evalcts-ulp-2";
  nameless.erase("format");
  wrong["tests"][0]["verdict"] = "passed";
  twice["tests"].push_back(twice["tests"][0]);
  shard["shard"] = "3-of-2";
  write("good/results-x.json", good);
  write("out/index.html", "the page of before");
  fs::create_directories(folder_ / "empty");
  const std::pair<std::string, std::string> cases[] = {
      {good.substr(0, good.size() / 2), "this is not JSON, or was cut off"},
      {"", "this is not JSON, or was cut off"},
      {std::string("\x00\xff\xfe", 3), "this is not JSON, or was cut off"},
      {std::string(100000, '['), "nested too deeply"},
      {good.substr(0, good.size() - 1) + ",\"x\":" + std::string(100000, '[') + std::string(100000, ']') +
           "}",
       "nested too deeply"},
      {"[1]", "expected an object, found an array"},
      {foreign.dump(), "\"evalcts-ulp-2\""},
      {nameless.dump(), "its format is missing"},
      {wrong.dump(), "tests[0].verdict: unknown word \"passed\""},
      {twice.dump(), "occurs twice in this record"},
      {shard.dump(), "is not K-of-N"}};
  const auto expect_rejected = [this](const std::vector<std::string>& arguments, const std::string& words) {
    std::vector<std::string> command = {"report", "--output", path("out")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Outcome outcome = evalcts(command);
    EXPECT_EQ(outcome.code, 2) << words;
    EXPECT_TRUE(contains(outcome.text, words)) << outcome.text;
    EXPECT_EQ(text_of("out/index.html"), "the page of before");
  };
  for (const auto& [text, words] : cases) {
    write("bad/results-y.json", text);
    expect_rejected({path("good"), path("bad")}, words);
  }
  expect_rejected({path("bad/results-y.json")}, "is not K-of-N");
  expect_rejected({path("good"), "--before", path("bad")}, "is not K-of-N");
  for (const std::string& argument :
       std::vector<std::string>{path("nowhere"), path("empty"), std::string("/dev/null"), std::string()}) {
    const Outcome outcome = evalcts({"report", argument, "--output", path("out")});
    EXPECT_EQ(outcome.code, 2) << argument << outcome.text;
    EXPECT_EQ(text_of("out/index.html"), "the page of before");
  }
  EXPECT_EQ(evalcts({"report", path("good"), "--output", "/proc/evalcts"}).code, 2);
  EXPECT_EQ(evalcts({"report", path("good"), "--output", path("out/index.html")}).code, 2);
}

// The schema describes all fields that a run records.
TEST_F(Report, TheSchemaIsInStep) {
  setenv("EVALCTS_DRILL", "lenient", 1);
  EXPECT_EQ(evalcts({"run", "--implementation", "osmesa", "--library", DRILL_LIBRARY, "--filter",
                     "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f", "--output", folder_.string()})
                .code,
            1);
  EXPECT_EQ(evalcts({"run", "--implementation", "production", "--filter",
                     "Api.FormsReplaceEachOther/MAP1_COLOR_4", "--output", folder_.string()})
                .code,
            0);
  const json schema = parse_json(read_file(RESULTS_SCHEMA)), &definitions = schema["definitions"];
  const json& evidence = definitions["evidence"]["properties"];
  std::map<std::string, int> seen;
  const auto check = [&](const std::string& kind, const json& object, const std::vector<json>& named) {
    for (const auto& item : object.items()) {
      ++seen[kind + "." + item.key()];
      EXPECT_TRUE(std::any_of(named.begin(), named.end(),
                              [&](const json& names) { return names.contains(item.key()); }))
          << kind << "." << item.key();
    }
  };
  for (const char* name : {"osmesa", "production"}) {
    const json result = results(name);
    check("result", result, {schema["properties"]});
    check("implementation", result["implementation"], {definitions["implementation"]["properties"]});
    for (const json& test : result["tests"]) {
      check("test", test, {definitions["test"]["properties"], evidence});
      for (const json& failure : test["failures"])
        check("failure", failure, {definitions["failure"]["properties"], evidence});
      if (test.contains("accuracy"))
        check("accuracy", test["accuracy"], {definitions["accuracy"]["properties"]});
    }
  }
  for (const char* name : {"result.seed", "test.mismatches", "failure.calls", "accuracy.worst"})
    EXPECT_GT(seen[name], 0) << name;
}

// `report` makes the same page from the files of a run as the run itself.
TEST_F(Report, OfARunIsThePageOfTheRun) {
  ASSERT_EQ(evalcts({"run", "--implementation", "production", "--filter", "InitialState.*", "--output",
                     folder_.string()})
                .code,
            0);
  const std::string page = text_of("index.html"), summary = text_of("summary.md");
  EXPECT_TRUE(contains(summary, "| `production` | 0 |")) << summary;
  fs::remove(folder_ / "index.html");
  ASSERT_EQ(evalcts({"report", "--run", folder_.string()}).code, 0);
  EXPECT_EQ(text_of("summary.md"), summary);
  EXPECT_EQ(text_of("index.html"), page);
}

}  // namespace
}  // namespace evalcts
