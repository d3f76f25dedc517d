// Tests that evalcts copes with misbehaving libraries, full disks and wrong arguments: the running test gets
// a verdict, the remaining tests run, and no results are lost.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <sstream>

#include <evalcts/runner/folder_lock.h>
#include "drill.h"

namespace evalcts {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// --- libraries ---------------------------------------------------------------------------------------------

#ifdef __SANITIZE_ADDRESS__
constexpr char kMemory[] = "3000";
constexpr char kEndedWell[] = "exit code ";  // the leak sanitizer may change the exit code
#else
constexpr char kMemory[] = "600";
constexpr char kEndedWell[] = "exit code 0";
#endif

struct Misbehaviour {
  const char* what;
  const char* verdict;
  const char* message = "";
  const char* jobs = "2";
  friend void PrintTo(const Misbehaviour& misbehaviour, std::ostream* out) { *out << misbehaviour.what; }
};

class Misbehaviours : public DrillTest, public testing::WithParamInterface<Misbehaviour> {
 protected:
  // The time limit is long because the machine may be busy, but short if the test waits for it.
  static std::vector<std::string> options(const Misbehaviour& misbehaviour) {
    return {"--filter",  std::string("Map1State.Stride/*:InitialState.O*") + kWithoutLists,
            "--timeout", std::string(misbehaviour.verdict) == "timeout" ? "3" : "60",
            "--memory",  kMemory,
            "--jobs",    misbehaviour.jobs};
  }

  // Checks that a misbehaviour in one call affects at most the test that makes it, and leaves no
  // processes or files.
  void check(const Misbehaviour& misbehaviour, int code) const {
    const bool dies = std::string(misbehaviour.verdict) != "pass";
    EXPECT_EQ(code, dies ? 1 : 0) << misbehaviour.what;
    const json result = results("drill");
    ASSERT_TRUE(result.is_object());
    EXPECT_EQ(as_text(result["status"]), "complete");
    EXPECT_GT(result["tests"].size(), 15u);
    for (const json& test : result["tests"]) {
      if (as_text(test["name"]) != kVictim) {
        EXPECT_EQ(as_text(test["verdict"]), "pass") << misbehaviour.what << test;
      }
    }
    const json victim = test_named(result, kVictim);
    ASSERT_FALSE(victim.is_null());
    EXPECT_EQ(as_text(victim["verdict"]), misbehaviour.verdict) << misbehaviour.what << victim["message"];
    if (dies) {
      const std::string words = victim["message"];
      EXPECT_TRUE(contains(words, misbehaviour.message));
      EXPECT_TRUE(contains(words, "confirmed alone"));
      EXPECT_TRUE(contains(victim.value("calls", json()).dump(), "glMap1f(GL_MAP1_INDEX"));
    } else {
      EXPECT_TRUE(contains(text_of("log-drill.txt"), misbehaviour.message));
    }
    std::ifstream processes(drill_file());
    for (pid_t process = 0; processes >> process;) EXPECT_NE(kill(process, 0), 0) << process;
    EXPECT_FALSE(fs::exists(folder_ / ".lock"));
    EXPECT_LT(fs::file_size(folder_ / "log-drill.txt"), 200'000u);
  }

  struct ParallelRun {
    std::string name, what;
    std::vector<std::string> options;
    std::function<void(int code)> check;  // runs with the folder of the run as folder_
  };
  // Starts all runs at once, because each waits for time limits.
  void run_in_parallel(const std::vector<ParallelRun>& runs) {
    const fs::path whole = folder_;
    std::vector<std::unique_ptr<ChildProcess>> processes;
    for (const ParallelRun& run : runs) {
      folder_ = whole / run.name;
      fs::create_directory(folder_);
      setenv("EVALCTS_DRILL_FILE", drill_file().c_str(), 1);
      std::vector<std::string> command = drill_arguments(run.what, run.options);
      command.insert(command.begin(), EVALCTS_PROGRAM);
      processes.push_back(std::make_unique<ChildProcess>(command, (folder_ / "command.log").string()));
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
      folder_ = whole / runs[i].name;
      SCOPED_TRACE(runs[i].name);
      const auto ending = processes[i]->wait(60);
      runs[i].check(ending && !ending->signalled ? ending->value : -1);
    }
    folder_ = whole;
  }
};

TEST_P(Misbehaviours, CostOneTestAtMost) {
  const Outcome outcome = drill(GetParam().what, options(GetParam()));
  check(GetParam(), outcome.code);
}
INSTANTIATE_TEST_SUITE_P(
    Ways, Misbehaviours,
    testing::Values(Misbehaviour{"crash", "crash", "SIGSEGV", "1"},
                    Misbehaviour{"crash", "crash", "SIGSEGV", "3"}, Misbehaviour{"abort", "crash", "SIGABRT"},
                    Misbehaviour{"exit", "crash", "exit code 7"},
                    Misbehaviour{"exit-well", "crash", kEndedWell}, Misbehaviour{"kill", "crash", "SIGKILL"},
                    Misbehaviour{"thread", "crash", "SIGSEGV"},
                    Misbehaviour{"heap", "crash", "the process ended with"},
                    Misbehaviour{"memory", "crash", " MiB of memory"}, Misbehaviour{"leak", "pass"},
                    Misbehaviour{"flood", "pass", " more bytes are omitted here"},
                    Misbehaviour{"close", "pass"}, Misbehaviour{"close-and-open", "pass"},
                    Misbehaviour{"threads-stay", "pass"}, Misbehaviour{"process-stays", "pass"},
                    Misbehaviour{"daemon", "pass"}, Misbehaviour{"fork-goes-on", "pass"},
                    Misbehaviour{"arithmetic", "pass"}, Misbehaviour{"at-exit", "pass"},
                    Misbehaviour{"surroundings", "pass",
                                 "has changed the working directory, the locale, a timer; put back"}),
    [](const auto& misbehaviour) {
      std::string name = std::string(misbehaviour.param.what) + "_" + misbehaviour.param.jobs;
      std::ranges::replace(name, '-', '_');
      return name;
    });

// Evaluators are at fault for a crash only if the same case with explicit vertices does not crash.
TEST_F(Misbehaviours, CrashOfAnyPrimitiveIsNotThatOfEvaluators) {
  const auto outcome_of = [&](const char* what) {
    drill(what, {"--filter", "Evaluation.NoArgumentIsAnError/*", "--allow-unobserved"});
    const json result = results("drill");
    for (const json& test : result.at("tests"))
      if (test["message"].dump().find("SIGSEGV") != std::string::npos) return test;
    return json();
  };
  const json shared = outcome_of("end"), own = outcome_of("evaluation");
  EXPECT_EQ(as_text(shared.value("verdict", json())), "not-observable") << shared;
  EXPECT_TRUE(contains(shared.dump(), "also with explicit vertices instead of evaluations"));
  EXPECT_EQ(as_text(own.value("verdict", json())), "crash") << own;
}

// Once three tests have crashed in one query, tests that query all state leave it out and are judged. Tests
// that need the query crash, but only some of the crashes are confirmed.
TEST_F(Misbehaviours, CrashOfAQueryCostsTheTestsThatNeedIt) {
  const Outcome outcome = drill(
      "query", {"--filter",
                "Map1Errors.StrideBelowKAtEveryOrder/MAP1_COLOR_4_d:Map1Errors.StrideBelowKAtEveryOrder/"
                "MAP1_COLOR_4_f:Map1Errors.StrideBelowKAtEveryOrder/MAP1_INDEX_d:"
                "Map1Errors.StrideBelowKAtEveryOrder/MAP1_INDEX_f:Map1Errors.StrideBelowKAtEveryOrder/"
                "MAP1_VERTEX_3_d:Map1Errors.StrideBelowKAtEveryOrder/MAP1_VERTEX_3_f:"
                "Map1State.Stride/MAP1_NORMAL_d:Map1State.Stride/MAP1_NORMAL_f:"
                "Map1State.SmallestStride/MAP1_NORMAL_d:Map1State.SmallestStride/MAP1_NORMAL_f:"
                "Map1State.Stride/MAP1_COLOR_4_f"});
  EXPECT_EQ(outcome.code, 1);
  const json result = results("drill");
  const std::string call = "glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)";
  std::size_t gone_round = 0, confirmed = 0, like_others = 0;
  for (const json& test : result.at("tests")) {
    const std::string name(as_text(test["name"]));
    if (name.starts_with("Map1Errors")) {
      EXPECT_EQ(as_text(test["verdict"]), "pass") << test;
      EXPECT_EQ(test.value("left_out", json()), json::array({call})) << test;
      ++gone_round;
    } else if (name.find("MAP1_NORMAL") != std::string::npos) {
      EXPECT_EQ(as_text(test["verdict"]), "crash") << test;
      const json crash = test.value("crash", json());
      EXPECT_EQ(as_text(crash["call"]), call);
      EXPECT_GT(crash["commands_before"].get<int>(), 0);
      EXPECT_NE(crash["frames"].dump().find("glGetMapiv+0x"), std::string::npos) << crash;
      const std::string message(as_text(test["message"]));
      confirmed += message.find("confirmed alone") != std::string::npos;
      like_others += message.find("as in 3 tests that were run again alone") != std::string::npos;
    } else {
      EXPECT_EQ(as_text(test["verdict"]), "pass") << test;
      EXPECT_FALSE(test.contains("left_out")) << test;
    }
  }
  EXPECT_EQ(gone_round, 6u);
  EXPECT_EQ(confirmed, 3u);
  EXPECT_EQ(like_others, 1u);
}

// Tests that hang run again alone, which decides whether they hang, need more time, or depend on an earlier
// test.
TEST_F(Misbehaviours, ThatHangAreRunAgainAlone) {
  // One of the tests that hang at a place stands for the others.
  const auto one_of_several = [this](int code) {
    EXPECT_EQ(code, 1);
    std::size_t alone = 0, alike = 0;
    const json all = results("drill");
    for (const json& test : all["tests"]) {
      if (as_text(test["verdict"]) != "timeout") continue;
      const std::string_view message = as_text(test["message"]);
      EXPECT_TRUE(contains(test["message"], "in glMap1f(GL_MAP1_INDEX, "));
      alone += message.ends_with("; confirmed alone in a new process");
      alike += message.ends_with(", which was run again alone");
    }
    EXPECT_EQ(alone, 1u);
    EXPECT_GE(alike, 1u);
  };
  // A hang that occurs once, with a part of the time limit, may be due to other processes.
  const auto once = [this](int code) {
    EXPECT_EQ(code, 0);
    EXPECT_TRUE(fs::exists(drill_file()));
    const json all = results("drill");
    for (const json& test : all["tests"]) EXPECT_EQ(as_text(test["verdict"]), "pass") << test;
  };
  std::vector<ParallelRun> runs = {
      {"several",
       "hang",
       {"--filter", std::string("Map1State.*/MAP1_INDEX_f") + kWithoutLists, "--timeout", "3", "--no-bugs"},
       one_of_several},
      {"once",
       "hang-now-and-then",
       {"--filter", std::string("Map1State.Stride/*:InitialState.O*") + kWithoutLists, "--timeout", "15",
        "--no-bugs"},
       once}};
#ifndef __SANITIZE_ADDRESS__
  // A test that hangs only after another one is not taken for a slow one, though it passes alone.
  const std::string defines_order_7 = "Map1State.EveryOrderAccepted/MAP1_COLOR_4_f";
  const auto after_another = [&](int code) {
    EXPECT_EQ(code, 1);
    const json later = test_named(results("drill"), kVictim);
    EXPECT_EQ(as_text(later["verdict"]), "timeout") << later;
    EXPECT_EQ(later["history"], json::array({defines_order_7})) << later;
    EXPECT_TRUE(contains(later["message"], "no answer within 5 seconds in glMap1f(GL_MAP1_INDEX, "));
  };
  runs.push_back(
      {"after-another",
       "second-hang",
       {"--filter", defines_order_7 + ":" + kVictim, "--timeout", "15", "--jobs", "1", "--no-bugs"},
       after_another});
#endif
  run_in_parallel(runs);
}

TEST_F(Misbehaviours, ThatNeverEndAreEnded) {
  constexpr char kUnnamed[] = "no answer within 3 seconds";
  constexpr char kNamed[] = "no answer within 3 seconds in glMap1f(GL_MAP1_INDEX, ";
  const Misbehaviour misbehaviours[] = {
      {"hang", "timeout", kNamed, "1"}, {"hang", "timeout", kNamed, "3"},
      {"stop", "timeout", kUnnamed},    {"deaf", "timeout", kUnnamed},
      {"handler", "timeout", kUnnamed}, {"endless-flood", "timeout", kUnnamed}};
  std::vector<ParallelRun> runs;
  for (const Misbehaviour& each : misbehaviours) {
    const std::string name = fmt::format("{}-{}", each.what, each.jobs);
    std::vector<std::string> more = options(each);
    if (name != "hang-3") more.emplace_back("--no-bugs");  // the reduction of one hang comes to its end
    runs.push_back({name, each.what, more, [this, each](int code) { check(each, code); }});
  }
  run_in_parallel(runs);
}

// --- flakes ------------------------------------------------------------------------------------------------

class Flakes : public DrillTest {
 protected:
  Outcome play(const std::string& what, std::vector<std::string> more = {}) {
    fs::remove(drill_file());
    more.insert(more.end(), {"--filter", std::string("Map1State.Stride/*:InitialState.O*") + kWithoutLists});
    return drill(what, more);
  }
};

// A test that fails only once is not observed, and all output states that it is a flake. A crash stays a
// crash.
TEST_F(Flakes, AreToldApart) {
  const Outcome outcome = play("now-and-then", {"--verbose"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "note: 1 test is unstable: it failed, and not when it was run again"))
      << outcome.text;
  const json flake = test_named(results("drill"), kVictim);
  EXPECT_EQ(as_text(flake["verdict"]), "not-observable");
  EXPECT_TRUE(as_text(flake["message"]).starts_with("unstable: ")) << flake["message"];
  EXPECT_EQ(flake["flake"], true);
  EXPECT_EQ(as_text(flake["again"]["verdict"]), "pass");
  EXPECT_FALSE(flake["mismatches"].empty());
  EXPECT_TRUE(contains(text_of("junit-drill.xml"), "unstable: "));

  EXPECT_EQ(play("now-and-then", {"--retry", "0"}).code, 1);
  EXPECT_FALSE(test_named(results("drill"), kVictim).contains("flake"));

  EXPECT_EQ(play("crash-now-and-then").code, 1);
  const json death = test_named(results("drill"), kVictim);
  EXPECT_EQ(as_text(death["verdict"]), "crash");
  EXPECT_EQ(death["flake"], true);
  EXPECT_EQ(as_text(death["again"]["verdict"]), "pass");
}

// A test that fails again in another way is not a flake. It keeps its verdict, and its message has both
// results.
TEST_F(Flakes, DoNotFailAgain) {
  const Outcome outcome = play("varying", {"--verbose"});
  EXPECT_EQ(outcome.code, 1) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, std::string("\nfail     ") + kVictim + " (another fail when run again)"))
      << outcome.text;
  const json test = test_named(results("drill"), kVictim);
  EXPECT_EQ(as_text(test["verdict"]), "fail");
  EXPECT_FALSE(test.contains("flake"));
  EXPECT_EQ(as_text(test["again"]["verdict"]), "fail");
  EXPECT_TRUE(
      contains(test["message"], "; when it runs again alone in a new process, it fails in another way: " +
                                    test["again"]["message"].get<std::string>()))
      << test["message"];
}

// A library that cannot have two contexts has no warm one.
TEST_F(Flakes, AreNotMadeByTheWarmContext) {
  const Outcome outcome = play("beside");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "pass")) << outcome.text;
}

// A test that fails each time is not a flake, and a test that the baseline lists as flaky is not repeated.
TEST_F(Flakes, AreNotSeenElsewhere) {
  EXPECT_EQ(drill("lenient", {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f", "--retry", "3"}).code,
            1);
  EXPECT_FALSE(test_named(results("drill"), "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f").contains("flake"));
  const auto times_run = [&] {
    const std::string log = text_of("log-drill.txt"), line = std::string("[ RUN      ] ") + kVictim + "\n";
    std::size_t times = 0;
    for (std::size_t at = log.find(line); at != std::string::npos; at = log.find(line, at + 1)) ++times;
    return times;
  };
  const fs::path baseline = folder_ / "baseline";
  EXPECT_EQ(play("now-and-then", {"--baseline", baseline.string(), "--write-baseline"}).code, 0);
  EXPECT_GT(times_run(), 1u);
  EXPECT_EQ(play("now-and-then", {"--baseline", baseline.string()}).code, 0);
  EXPECT_GT(times_run(), 1u) << "what was not observed is no known failure";
  std::ofstream(baseline / "drill-flakes.txt") << "# now and then\n^Map1State\\.Stride/MAP1_INDEX_f$\n";
  EXPECT_EQ(play("now-and-then", {"--baseline", baseline.string(), "--strict"}).code, 0);
  EXPECT_EQ(times_run(), 1u);
}

// --- disks and folders -------------------------------------------------------------------------------------

class Folders : public DrillTest {
 protected:
  // Runs the script in a shell that can mount file systems. The exit code is -1 if this is not possible.
  Outcome with_mounts(const std::string& script) {
    if (start({"/usr/bin/unshare", "-Urm", "true"}).code != 0) return {-1, "no name spaces here"};
    return start({"/usr/bin/unshare", "-Urm", "/bin/sh", "-c", script});
  }
  std::string line(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), EVALCTS_PROGRAM);
    return shell_line(arguments);
  }
};

// A full disk is not the fault of the library: it causes no verdict, and the results that fit are kept.
TEST_F(Folders, AFullDiskLosesNothingThatFits) {
  const fs::path disk = folder_ / "disk", kept = folder_ / "kept";
  fs::create_directory(disk);
  fs::create_directory(kept);
  std::vector<std::string> arguments = drill_arguments("nothing", {"--filter", "Map1State.*:Map1Errors.*"});
  *std::ranges::find(arguments, folder_.string()) = disk.string();
  const Outcome outcome =
      with_mounts("mount -t tmpfs -o size=600k none " + disk.string() + " && { " + line(arguments) +
                  "; code=$?; cp " + disk.string() + "/* " + kept.string() + "; exit $code; }");
  if (outcome.code == -1) GTEST_SKIP() << outcome.text;
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "No space left on device"));
  EXPECT_TRUE(contains(outcome.text, "--output"));
  std::ifstream records(kept / "records-drill.jsonl");
  std::size_t judged = 0;
  for (std::string record; std::getline(records, record);) {
    const json event = parse_json(record);
    if (!event.is_object() || as_text(event["event"]) != "result") continue;
    const std::string verdict = event["record"]["verdict"];
    EXPECT_TRUE(verdict == "pass" || verdict == "not-observable") << event["record"];
    ++judged;
  }
  EXPECT_GT(judged, 100u);
}

TEST_F(Folders, AReadOnlyFolderIsSaidAtOnce) {
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  std::vector<std::string> arguments = drill_arguments("nothing");
  *std::ranges::find(arguments, folder_.string()) = disk.string();
  const Outcome outcome =
      with_mounts("mount -t tmpfs -o ro none " + disk.string() + " && exec " + line(arguments));
  if (outcome.code == -1) GTEST_SKIP() << outcome.text;
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_TRUE(contains(outcome.text,
                       "cannot write into '" + disk.string() + "'; choose another folder with --output"));
}

TEST_F(Folders, BelongToOneCommandAtATime) {
  {
    // A result file for `report`.
    const fs::path there = folder_ / "results-x.json";
    std::ofstream(there) << R"({"format": "evalcts-results-1", "status": "complete", "tests": []})";
    const FolderLock lock(folder_, "process 1: evalcts run, of somebody else");
    const std::string folder = folder_.string();
    const std::vector<std::string> commands[] = {
        drill_arguments("nothing"),
        {"report", there.string(), "--output", folder},
        {"fuzz", "--implementation", "production", "--programs", "1", "--output", folder},
        {"ulp", "--implementation", "production", "--values", "1", "--output", folder}};
    for (const std::vector<std::string>& command : commands) {
      const Outcome outcome = evalcts(command);
      EXPECT_EQ(outcome.code, 2) << command.front();
      EXPECT_TRUE(contains(
          outcome.text, "another command is writing into '" + folder +
                            "' (process 1: evalcts run, of somebody else); wait for it, or choose another"))
          << command.front() << outcome.text;
    }
    EXPECT_FALSE(fs::exists(folder_ / "results-drill.json"));
    EXPECT_FALSE(fs::exists(folder_ / "index.html"));
    EXPECT_FALSE(fs::exists(folder_ / "ulp.json"));
    EXPECT_THROW(FolderLock(folder_, "again"), FolderInUse);
  }
  EXPECT_FALSE(fs::exists(folder_ / ".lock"));
  // The lock file of a killed run does not lock.
  std::ofstream(folder_ / ".lock") << "process 1";
  EXPECT_EQ(drill("nothing").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / ".lock"));
}

// The results are written even if nobody reads the output to its end.
TEST_F(Folders, AClosedPipeCostsNothing) {
  start({"/bin/sh", "-c", line(drill_arguments("nothing")) + " | true"});
  EXPECT_EQ(as_text(results("drill")["status"]), "complete");
  EXPECT_TRUE(fs::exists(folder_ / "index.html"));
}

// Names on the command line must not become paths.
TEST_F(Folders, NamesDoNotLeadOutOfThem) {
  const std::vector<std::string> names = {"../x", "/tmp/x", "..",   ".x",
                                          "a/b",  "a b",    "a\nb", std::string(101, 'x')};
  for (const std::string& name : names) {
    std::vector<std::string> arguments = drill_arguments("nothing");
    *std::ranges::find(arguments, "drill") = name;
    const Outcome outcome = evalcts(arguments);
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_TRUE(contains(outcome.text, "--name is used in file names"));
  }
}

// --- GoogleTest's own variables ----------------------------------------------------------------------------

class Variables : public DrillTest {
 protected:
  ~Variables() override {
    for (const char* name :
         {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX", "GTEST_SHARD_STATUS_FILE", "GTEST_FILTER",
          "GTEST_REPEAT", "GTEST_OUTPUT", "XML_OUTPUT_FILE", "TESTBRIDGE_TEST_ONLY"})
      unsetenv(name);
  }

  using Verdicts = std::map<std::string, std::string>;
  Verdicts verdicts_of(const std::string& name) const {
    Verdicts verdicts;
    const json result = results(name);
    for (const json& test : result["tests"]) verdicts[test["name"]] = test["verdict"];
    return verdicts;
  }
  // Returns the names of the tests that the suite program runs with these options.
  std::set<std::string> tests_run_by(const std::string& filter, std::vector<std::string> implementation = {
                                                                    "--implementation", "production"}) {
    implementation.insert(implementation.begin(), SUITE_PROGRAM);
    implementation.insert(implementation.end(), {"--depth", "thorough", "--gtest_filter=" + filter});
    std::istringstream lines(start(implementation).text);
    std::set<std::string> names;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("[ RUN      ] ")) names.insert(line.substr(13));
    return names;
  }
};

// `run --shard`, `run` under GoogleTest's variables, and the suite program under them run the same tests. All
// shards together run each test once, with the verdicts of a whole run.
TEST_F(Variables, ShardTheSameWay) {
  const std::string filter =
      std::string("InitialState.*:Map1Errors.StrideBelowK/*:Map1State.Stride/*") + kWithoutLists;
  EXPECT_EQ(drill("lenient", {"--filter", filter}).code, 1);
  const Verdicts whole = verdicts_of("drill");
  EXPECT_GT(whole.size(), 50u);
  Verdicts together;
  for (int shard = 0; shard < 3; ++shard) {
    const std::string number = std::to_string(shard + 1), label = "drill." + number + "-of-3";
    drill("lenient", {"--filter", filter, "--shard", number + "/3"});
    EXPECT_EQ(as_text(results(label)["shard"]), number + "-of-3");
    const Verdicts by_option = verdicts_of(label);
    EXPECT_LE(by_option.size(), whole.size() / 3 + 1);
    fs::remove(folder_ / ("results-" + label + ".json"));

    setenv("GTEST_TOTAL_SHARDS", "3", 1);
    setenv("GTEST_SHARD_INDEX", std::to_string(shard).c_str(), 1);
    setenv("GTEST_SHARD_STATUS_FILE", (folder_ / "status").c_str(), 1);
    drill("lenient", {"--filter", filter});
    EXPECT_EQ(verdicts_of(label), by_option);
    EXPECT_TRUE(fs::exists(folder_ / "status"));

    std::set<std::string> names;
    for (const auto& [name, verdict] : by_option) names.insert(name);
    EXPECT_EQ(tests_run_by(filter, {"--implementation", "osmesa", "--library", DRILL_LIBRARY}), names);
    for (const char* name : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX", "GTEST_SHARD_STATUS_FILE"})
      unsetenv(name);
    for (const auto& [name, verdict] : by_option) EXPECT_TRUE(together.emplace(name, verdict).second) << name;
  }
  EXPECT_EQ(together, whole);
  for (const char* wrong : {"0/3", "4/3", "3", "1/", "/2", "1/2/3", "a/b", "1-of-2"})
    EXPECT_EQ(drill("lenient", {"--shard", wrong}).code, 2) << wrong;
}

// A test name with a '-', as other runners pass it, selects the test and is not read as an exclusion.
TEST_F(Variables, NamesWorkAsTheyAreListed) {
  const std::string name = "DisplayLists.CalledTwiceSameBits/1-D", other = "InitialState.OrderOf1D";
  EXPECT_EQ(tests_run_by(name), std::set({name}));
  EXPECT_EQ(tests_run_by(name + ":" + other), std::set({name, other}));
  EXPECT_EQ(tests_run_by("DisplayLists.CalledTwiceSameBits/*:-" + name),
            std::set<std::string>({"DisplayLists.CalledTwiceSameBits/2-D"}));
}

TEST_F(Variables, ThatMakeNoSenseAreRefused) {
  const std::pair<const char*, const char*> wrong[] = {
      {"3", "3"}, {"3", ""}, {"x", "1"}, {"3", "-1"}, {"0", "0"}};
  for (const auto& [total, index] : wrong) {
    setenv("GTEST_TOTAL_SHARDS", total, 1);
    setenv("GTEST_SHARD_INDEX", index, 1);
    const Outcome outcome = drill("nothing");
    EXPECT_EQ(outcome.code, 2) << total << " " << index;
    EXPECT_TRUE(contains(outcome.text, "use --shard K/N"));
  }
}

// Variables for other programs do not change the run.
TEST_F(Variables, ForOthersAreForgotten) {
  setenv("GTEST_FILTER", "Nothing.*", 1);
  setenv("TESTBRIDGE_TEST_ONLY", "Nothing.*", 1);
  setenv("GTEST_REPEAT", "3", 1);
  setenv("GTEST_OUTPUT", ("xml:" + (folder_ / "own.xml").string()).c_str(), 1);
  setenv("XML_OUTPUT_FILE", (folder_ / "own.xml").c_str(), 1);
  const Outcome outcome = drill("nothing");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_GT(verdicts_of("drill").size(), 15u);
  EXPECT_FALSE(fs::exists(folder_ / "own.xml"));
}

// --- terminals ---------------------------------------------------------------------------------------------

class Terminal : public DrillTest {
 protected:
  // Returns the output of evalcts on a terminal with this number of lines and 80 columns.
  std::string shown(const std::vector<std::string>& arguments, int lines,
                    const std::string& environment = {}) {
    std::vector<std::string> command = arguments;
    command.insert(command.begin(), EVALCTS_PROGRAM);
    return start(
               {"/usr/bin/script", "--quiet", "--command",
                "stty rows " + std::to_string(lines) + " cols 80; " + environment + " " + shell_line(command),
                "/dev/null"})
        .text;
  }
};

TEST_F(Terminal, ProgressColourAndTheSizeOfTheScreen) {
  if (!fs::exists("/usr/bin/script")) GTEST_SKIP() << "no terminal without script(1)";
  const std::vector<std::string> arguments =
      drill_arguments("lenient", {"--filter", "Map1Errors.StrideBelowK/*", "--retry", "0"});
  const auto lines_of = [](const std::string& text) {
    return std::ranges::count(text.substr(text.find("drill: evalcts")), '\n');
  };
  const std::string usual = shown(arguments, 24);
  EXPECT_TRUE(contains(usual, "\r\x1b[K"));
  EXPECT_TRUE(contains(usual, "drill: 0 of "));
  EXPECT_TRUE(contains(usual, "\x1b[31m 1. "));
  EXPECT_LT(lines_of(usual), 24);
  const std::string plain = shown(arguments, 24, "NO_COLOR=1");
  EXPECT_FALSE(contains(plain, "\x1b[31m"));
  EXPECT_EQ(shown(arguments, 24, "NO_COLOR=").find("\x1b[31m") == std::string::npos, false);

  std::vector<std::string> quiet = arguments;
  quiet.push_back("--quiet");
  const Outcome outcome = evalcts(quiet);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.text.starts_with("drill: ")) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, " failure"));
  EXPECT_EQ(std::ranges::count(outcome.text, '\n'), 1);
  EXPECT_FALSE(contains(outcome.text, "\x1b"));
  quiet.push_back("--verbose");
  EXPECT_EQ(evalcts(quiet).code, 2);
}

TEST_F(Terminal, WhatWasMeantIsGuessed) {
  const std::pair<std::vector<std::string>, std::string> slips[] = {
      {{"rnu"}, "did you mean run?"},
      {{"explian", "x"}, "did you mean explain?"},
      {{"run", "--basline", "none"}, "did you mean --baseline?"},
      {{"run", "--implementaion=osmesa"}, "did you mean --implementation?"},
      {{"vectors", "emti"}, "did you mean emit?"}};
  for (const auto& [arguments, words] : slips) {
    const Outcome outcome = evalcts(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(contains(outcome.text, words));
    EXPECT_FALSE(contains(outcome.text, "is required"));
  }
  EXPECT_FALSE(contains(evalcts({"run", "--utterly-unlike"}).text, "did you mean"));
}

TEST_F(Terminal, EveryCommandHasExamples) {
  const std::string all = evalcts({"--help"}).text;
  // CLI11 2.5 and newer write "SUBCOMMANDS:".
  std::istringstream lines(all.substr(std::min(all.find("Subcommands:"), all.find("SUBCOMMANDS:"))));
  int commands = 0;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");) {
    if (line[2] == ' ') continue;  // the line continues a description
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    const std::string help = evalcts({command, "--help"}).text;
    EXPECT_TRUE(contains(help, "Examples:\n  $ evalcts " + command));
    ++commands;
  }
  EXPECT_GE(commands, 10);
}

}  // namespace
}  // namespace evalcts
