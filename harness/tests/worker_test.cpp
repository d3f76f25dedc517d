// Tests of workers elsewhere: a command starts the suite program, in place of a process of this program.
#include "drill.h"

namespace evalcts {
namespace {

using nlohmann::json;

constexpr char kSuite[] = EVALCTS_PROGRAM "-suite";

class Elsewhere : public DrillTest {
 protected:
  // Returns a command for --worker: a shell script with these lines, in which "$@" starts the worker.
  std::string command(const std::string& lines) const {
    const std::filesystem::path script = folder_ / "elsewhere.sh";
    std::ofstream(script) << "cd '" << folder_.string() << "'\nset -- " << kSuite << " \"$@\"\n"
                          << lines << "\n";
    return "sh " + script.string();
  }

  Outcome run(const std::string& lines, const std::string& filter = "Points.*") {
    return evalcts({"run", "--implementation", "production", "--depth", "quick", "--filter", filter,
                    "--worker", command(lines), "--output", folder_.string(), "--allow-unobserved"});
  }

  static std::map<std::string, std::string> verdicts_of(const json& result) {
    std::map<std::string, std::string> verdicts;
    for (const json& test : result["tests"]) verdicts[test["name"]] = test["verdict"];
    return verdicts;
  }
};

TEST_F(Elsewhere, GivesTheSameVerdicts) {
  const Outcome elsewhere = run("cd /; exec \"$@\"");
  ASSERT_EQ(elsewhere.code, 0) << elsewhere.text;
  const auto verdicts = verdicts_of(results("production"));
  evalcts({"run", "--implementation", "production", "--depth", "quick", "--filter", "Points.*", "--output",
           folder_.string(), "--allow-unobserved"});
  EXPECT_GT(verdicts.size(), 20u);
  EXPECT_EQ(verdicts, verdicts_of(results("production")));
}

TEST_F(Elsewhere, OtherTextIsNoEvent) {
  const Outcome outcome = run("echo 'Welcome, {\"event\": 3}'; echo careful >&2; exec \"$@\"");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(text_of("log-production.txt"), "careful"));
}

// The connection breaks once, while captures are proved or in a test. Workers start at the same time, so only
// the one that makes the folder ends its shell and its sed.
TEST_F(Elsewhere, ALostConnectionLosesNothing) {
  run("exec \"$@\"");
  const json expected = results("production");
  for (const std::string last_event : {"\"name\":\"Sink\"", "\"name\":\"Points"}) {
    std::filesystem::remove(folder_ / "broken");
    const Outcome outcome = run("test -d broken || { \"$@\" | sed -u -e '/" + last_event +
                                "/e mkdir broken 2>&- && kill '$$' $PPID'; exit; }; exec \"$@\"");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "broken"));
    const json result = results("production");
    EXPECT_EQ(as_text(result["status"]), "complete");
    EXPECT_EQ(result["implementation"]["captures"], expected["implementation"]["captures"]);
    EXPECT_EQ(verdicts_of(result), verdicts_of(expected));
  }
}

// A host that cannot be reached any more says nothing about the library.
TEST_F(Elsewhere, AConnectionThatNeverComesBackIsNoCrash) {
  const Outcome outcome =
      run("test -d broken && { echo 'no route to host' >&2; exit 255; }; "
          "\"$@\" | sed -u -e '/\"name\":\"Points/e mkdir -p broken && kill '$$' $PPID'");
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "the worker printed \"no route to host\"")) << outcome.text;
  const json result = results("production");
  EXPECT_EQ(as_text(result["status"]), "interrupted");
  for (const auto& [name, verdict] : verdicts_of(result)) EXPECT_EQ(verdict, "pass") << name;
}

TEST_F(Elsewhere, WhatDoesNotStartIsNamed) {
  const Outcome missing = run("echo 'no route to host' >&2; exit 255");
  EXPECT_EQ(missing.code, 2);
  EXPECT_TRUE(contains(missing.text, "the command of --worker ended with exit code 255"));
  EXPECT_TRUE(contains(missing.text, "the worker printed \"no route to host\""));
  EXPECT_EQ(evalcts({"run", "--worker", command("exec \"$@\"")}).code, 2);
}

TEST_F(Elsewhere, AWorkerOfOtherSourcesIsNotUsed) {
  const std::string other = "\"$@\" | sed 's/digest [0-9a-f]*/digest 0/'";
  std::vector<Outcome> outcomes = {run(other)};
  for (const char* const name : {"fuzz", "ulp"})
    outcomes.push_back(evalcts(
        {name, "--implementation", "production", "--worker", command(other), "--output", folder_.string()}));
  for (const Outcome& outcome : outcomes) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(contains(outcome.text, "build both from the same sources")) << outcome.text;
  }
}

TEST_F(Elsewhere, MeasuresTheSameErrors) {
  std::vector<std::string> ulp = {"ulp",      "--implementation", "production",
                                  "--filter", "curve/4/ordinary", "--values",
                                  "500",      "--output",         folder_.string()};
  EXPECT_EQ(evalcts(ulp).code, 0);
  const std::string here = text_of("ulp.csv");
  EXPECT_TRUE(contains(here, "curve/4/ordinary"));
  ulp.insert(ulp.end(), {"--worker", command("exec \"$@\"")});
  const Outcome elsewhere = evalcts(ulp);
  EXPECT_EQ(elsewhere.code, 0) << elsewhere.text;
  EXPECT_EQ(text_of("ulp.csv"), here);
}

// A library that needs much memory from the start must not cost a process for each test.
TEST(Worker, MemoryOfTheFirstJobIsNoGrowth) {
  const std::string jobs = R"({"job": "test", "name": "Points.LastIsExact/1-D_U"})";
  const std::string text = "for i in 1 2 3; do echo '" + jobs + "'; done | " + kSuite +
                           " --implementation production --depth quick --events - --most-growth 8 2>&1 | "
                           "grep -c '\"event\":\"result\"' | grep -qx 3";
  EXPECT_EQ(std::system(text.c_str()), 0);
}

// Nobody sends a worker elsewhere a signal if it hangs.
TEST_F(Elsewhere, CrashesAndHangsAreReported) {
  for (const auto& [what, verdict] : {std::pair{"crash", "crash"}, {"hang", "timeout"}}) {
    std::vector<std::string> more = {"--filter",  std::string("Map1State.Stride/*") + kWithoutLists,
                                     "--timeout", std::string(verdict) == "timeout" ? "2" : "60",
                                     "--worker",  command("\"$@\" | cat")};
    EXPECT_EQ(drill(what, more).code, 1);
    const json victim = test_named(results("drill"), kVictim);
    EXPECT_EQ(as_text(victim["verdict"]), verdict);
    EXPECT_TRUE(contains(as_text(victim["message"]), "in glMap1f(GL_MAP1_INDEX")) << victim["message"];
  }
}

// A result file must not start commands.
TEST_F(Elsewhere, ReproduceAsksForTheCommand) {
  const std::string worker = command("exec \"$@\"");
  drill("crash", {"--filter", std::string("Map1State.Stride/*") + kWithoutLists, "--worker", worker});
  const std::vector<std::string> reproduce = {"reproduce",      kVictim,    "--run",
                                              folder_.string(), "--output", (folder_ / "victim.c").string()};
  const Outcome refused = evalcts(reproduce);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.text, "start it with --worker"));
  std::vector<std::string> with_worker = reproduce;
  with_worker.insert(with_worker.end(), {"--worker", worker});
  EXPECT_EQ(evalcts(with_worker).code, 0);
  EXPECT_TRUE(contains(text_of("victim.c"), "glMap1f(GL_MAP1_INDEX"));
}

}  // namespace
}  // namespace evalcts
