// Tests that each run has a folder of its own, and that commands read the last run or a chosen one.
#include "cli/run_folders.h"

#include <gtest/gtest.h>

#include <set>

#include "program.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

class RunFolders : public ProgramTest {
 protected:
  Outcome run(const std::string& filter, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run", "--implementation", "production", "--filter", filter};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return evalcts(arguments);
  }
  // Returns the folders of runs, in the order of their names.
  std::set<fs::path> folders() const {
    std::set<fs::path> all;
    for (const auto& entry : fs::directory_iterator(runs_))
      if (!entry.is_symlink()) all.insert(entry.path());
    return all;
  }
  fs::path latest() const { return fs::canonical(runs_ / "latest"); }

  fs::path runs_ = folder_ / "runs";
};

TEST_F(RunFolders, AFilteredRunReplacesNoOther) {
  const Outcome whole = run("InitialState.*");
  ASSERT_EQ(whole.code, 0) << whole.text;
  const fs::path first = latest();
  EXPECT_TRUE(first.filename().string().starts_with("production-20")) << first;
  EXPECT_TRUE(contains(whole.text, "Report: " + (first / "index.html").string()));
  const std::string page = read_file(first / "index.html");

  EXPECT_EQ(run("InitialState.OrderOf1D", {"--name", "part"}).code, 0);
  const fs::path second = latest();
  EXPECT_NE(first, second);
  EXPECT_TRUE(second.filename().string().starts_with("part-20")) << second;
  EXPECT_EQ(read_file(first / "index.html"), page);
  EXPECT_TRUE(contains(read_file(second / "results-part.json"), "\"filter\": \"InitialState.OrderOf1D\""));
  EXPECT_EQ(folders(), (std::set{first, second}));

  // The last run, and another one.
  EXPECT_TRUE(contains(evalcts({"report"}).text, "\n1 test: 1 pass\n"));
  const std::string name = first.filename().string();
  EXPECT_TRUE(
      contains(evalcts({"report", "--run", name}).text, "Report: " + (first / "index.html").string()));
  EXPECT_TRUE(contains(evalcts({"bugs"}).text, "part: 0 distinct bugs"));
  EXPECT_TRUE(contains(evalcts({"bugs", "--run", name}).text, "production: 0 distinct bugs"));
  const Outcome wrong = evalcts({"bugs", "--run", "nothing"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(contains(wrong.text, "chooses one of these: part-20")) << wrong.text;
  EXPECT_TRUE(contains(evalcts({"reproduce", "Order", "--run", name}).text, "nothing failed in that run"));

  // --output is used exactly as given.
  EXPECT_EQ(run("InitialState.OrderOf1D", {"--output", (folder_ / "own").string()}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "own/index.html"));
  EXPECT_EQ(latest(), second);
  EXPECT_TRUE(contains(evalcts({"bugs", "--run", (folder_ / "own").string()}).text, "production: 0"));

  fs::remove_all(second);
  const Outcome dangling = evalcts({"bugs"});
  EXPECT_EQ(dangling.code, 2);
  EXPECT_TRUE(contains(dangling.text, "leads to a folder that does not exist; --run NAME chooses"))
      << dangling.text;
}

TEST_F(RunFolders, OfRejectedCommandsAreNotMade) {
  EXPECT_EQ(run("No.SuchTest").code, 2);
  EXPECT_FALSE(fs::exists(runs_));
  const Outcome none = evalcts({"bugs"});
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.text, "there is no last run: ")) << none.text;
}

TEST_F(RunFolders, OfOneSecondHaveNumbers) {
  std::set<fs::path> made;
  for (int i = 0; i < 5; ++i) made.insert(cli::create_run_folder("x"));
  EXPECT_EQ(made.size(), 5u);
  EXPECT_EQ(folders(), made);
}

// A folder that is called `latest` is not replaced.
TEST_F(RunFolders, LatestMayNotBeSet) {
  fs::create_directories(runs_ / "latest/x");
  const Outcome outcome = run("InitialState.OrderOf1D");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.text, "name this run with --run production-20")) << outcome.text;
  EXPECT_TRUE(fs::exists(runs_ / "latest/x"));
}

}  // namespace
}  // namespace evalcts
