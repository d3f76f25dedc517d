// Tests `evalcts rounding` as its users start it: options, messages, exit codes. A test that it finds wrong
// results would have to change the library, which is not possible here.
#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <thread>

#include "program.h"

namespace evalcts {
namespace {

class RoundingCommand : public ProgramTest {
 protected:
  Outcome rounding(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "rounding");
    return evalcts(arguments);
  }
  // Returns the lines of the classes and the line with the sum.
  static std::vector<std::string> classes_in(const std::string& text) {
    std::vector<std::string> classes;
    const std::regex line(R"((\S+(?:, \w+(?: \w+)?)?) +\d+ values +\d+ decided exactly +\d+ wrong)");
    for (std::sregex_iterator match(text.begin(), text.end(), line), none; match != none; ++match)
      classes.push_back((*match)[1]);
    return classes;
  }
};

TEST_F(RoundingCommand, TriesTheClassesOfTheFilterWithBothOracles) {
  const Outcome outcome =
      rounding({"--samples", "20", "--exact", "5", "--filter", "curve/4/ordinary:surface/4x4/ordinary"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(classes_in(outcome.text),
            (std::vector<std::string>{"curve/4/ordinary", "curve/4/ordinary, exact", "surface/4x4/ordinary",
                                      "surface/4x4/ordinary, exact"}))
      << outcome.text;
  EXPECT_TRUE(std::regex_search(outcome.text, std::regex("seed 1: [1-9]\\d* values, 0 wrong\\s*$")))
      << outcome.text;
}

TEST_F(RoundingCommand, LeavesOutWhatHasNoSamples) {
  const auto tried = [&](const char* samples, const char* exact) {
    return classes_in(
        rounding({"--samples", samples, "--exact", exact, "--filter", "curve/4/ordinary"}).text);
  };
  EXPECT_EQ(tried("20", "0"), std::vector<std::string>{"curve/4/ordinary"});
  EXPECT_EQ(tried("0", "20"), std::vector<std::string>{"curve/4/ordinary, exact"});
}

TEST_F(RoundingCommand, DependsOnTheSeedAndNotOnTheNumberOfThreads) {
  const auto text = [&](const char* seed, const char* jobs) {
    return rounding({"--samples", "2000", "--exact", "10", "--filter", "curve/10/*", "--seed", seed, "--jobs",
                     jobs})
        .text;
  };
  const std::string one = text("7", "1");
  EXPECT_TRUE(contains(one, "seed 7: "));
  EXPECT_EQ(text("7", "3"), one);
}

TEST_F(RoundingCommand, TakesInstructionSetsByName) {
  const Outcome outcome = rounding({"--samples", "20", "--exact", "0", "--filter", "curve/4/ordinary",
                                    "--target", "baseline", "--target", "baseline"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const Outcome unknown = rounding({"--samples", "20", "--target", "nonsense"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(contains(unknown.text, "this machine does not support the instruction set nonsense"));
}

TEST_F(RoundingCommand, WrongUseIsTwo) {
  const Outcome none = rounding({"--filter", "No/Such"});
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.text, "no class of maps matches 'No/Such'"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--nonsense"},
                                                    {"--samples", "-1"},
                                                    {"--samples", "few"},
                                                    {"--samples", "18446744073709551615"},
                                                    {"--exact", "-2"},
                                                    {"--jobs", "0"},
                                                    {"--jobs", "257"},
                                                    {"--seed", "x"},
                                                    {"--target"},
                                                    {"nonsense"}}) {
    std::string typed;
    for (const std::string& argument : arguments) typed += argument + " ";
    EXPECT_EQ(rounding(arguments).code, 2) << typed;
  }
  EXPECT_EQ(rounding({"--samples", "0", "--exact", "0", "--filter", "curve/4/*"}).code, 2) << "nothing to do";
  EXPECT_EQ(rounding({"--help"}).code, 0);
}

bool catches(pid_t process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    if (word == "SigCgt:" && status >> word) return (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

TEST_F(RoundingCommand, EndsSoonAndSaysSoWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const std::string what : {"--samples=1000000000000", "--sweep"}) {
      const std::filesystem::path log = folder_ / "interrupted.log";
      std::filesystem::remove(log);
      ChildProcess child({EVALCTS_PROGRAM, "rounding", what, "--jobs", "1"}, log.string());
      for (int i = 0; i < 1000 && !catches(child.id(), signal); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      kill(child.id(), signal);
      const auto ending = child.wait(60);
      ASSERT_TRUE(ending) << what;
      EXPECT_FALSE(ending->signalled) << what;
      EXPECT_EQ(ending->value, 2) << what;
      const std::string text = read_file(log);
      EXPECT_TRUE(contains(text, "0 wrong (interrupted)"));
    }
  }
}

}  // namespace
}  // namespace evalcts
