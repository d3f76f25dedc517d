// Tests child processes: their end, time limits, logs, and the quoting of shell commands; and workers that do
// not read their jobs.
#include <evalcts/runner/child_process.h>

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include <evalcts/runner/worker.h>

#include "contains.h"

namespace evalcts {
namespace {

TEST(ChildProcess, ReportsHowItEnded) {
  ChildProcess exits({"/bin/sh", "-c", "exit 3"}, "");
  const auto ending = exits.wait(10);
  ASSERT_TRUE(ending);
  EXPECT_FALSE(ending->signalled);
  EXPECT_EQ(describe(*ending), "exit code 3");

  ChildProcess dies({"/bin/sh", "-c", "kill -SEGV $$"}, "");
  const auto death = dies.wait(10);
  ASSERT_TRUE(death);
  EXPECT_TRUE(death->signalled);
  EXPECT_EQ(death->value, SIGSEGV);
  EXPECT_TRUE(contains(describe(*death), "SIGSEGV"));
}

TEST(ChildProcess, WaitsNoLongerThanAskedAndKillsTheWholeGroup) {
  ChildProcess sleeps({"/bin/sh", "-c", "sleep 100 & wait"}, "");
  EXPECT_FALSE(sleeps.wait(0.05));
  sleeps.kill();
  const auto ending = sleeps.wait(10);
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->value, SIGKILL);
}

TEST(ChildProcess, KeepsItsOutputInTheLog) {
  const std::string log = testing::TempDir() + "child_process_test.log";
  std::remove(log.c_str());
  ChildProcess writes({"/bin/sh", "-c", "echo out; echo err >&2; cat"}, log);
  ASSERT_TRUE(writes.wait(10));  // cat ends: standard input is empty
  std::ifstream file(log);
  std::string out, err;
  std::getline(file, out);
  std::getline(file, err);
  EXPECT_EQ(out + err, "outerr");
}

TEST(ChildProcess, RefusesWhatIsNoProgram) {
  EXPECT_THROW(ChildProcess({"/nonexistent/program"}, ""), std::runtime_error);
}

// A program that goes on for a moment after it has closed its standard input.
TEST(Worker, SurvivesAProcessThatDoesNotReadItsJobs) {
  Worker worker({"/bin/sh", "-c", "exec <&-; sleep 0.3; exit 3"}, "", {});
  std::size_t jobs = 0;
  do {
    worker.give({"test", "A.B"});
    ++jobs;
    wait_for_activity({&worker});
  } while (!worker.update());
  EXPECT_EQ(describe(worker.run().ending), "exit code 3");
  EXPECT_FALSE(worker.run().complete);
  EXPECT_EQ(worker.waiting().size(), jobs);
}

TEST(ShellLine, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_line({"run", "--filter", "Map1Values.Bezier/TEXTURE_COORD_1"}),
            "run --filter Map1Values.Bezier/TEXTURE_COORD_1");
  EXPECT_EQ(shell_line({"", "Map1*", "a b"}), "'' 'Map1*' 'a b'");
  EXPECT_EQ(shell_line({"a'b; rm $HOME", "~root"}), "'a'\\''b; rm $HOME' '~root'");
}

}  // namespace
}  // namespace evalcts
