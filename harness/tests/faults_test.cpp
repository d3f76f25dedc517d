// The table of faults, on the suite program with faults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <evalcts/faults/fault_table.h>
#include <evalcts/runner/question.h>

namespace evalcts::faults {
namespace {

namespace fs = std::filesystem;

class Faults : public testing::Test {
 protected:
  Faults() { fs::create_directories(scratch_); }
  ~Faults() override { fs::remove_all(scratch_); }

  TriedFault try_one(const ListedFault& fault) {
    static const std::vector<ListedTest> tests = list_tests(SUITE_PROGRAM);
    return try_faults({.suite_program = FAULTY_SUITE_PROGRAM,
                       .faults = {fault},
                       .tests = tests,
                       .scratch = scratch_},
                      [](std::size_t, const std::string&) {})
        .at(0);
  }

  const fs::path scratch_ = fs::path(testing::TempDir()) / ("evalcts-faults-" + std::to_string(getpid()));
};

ListedFault fault(const char* name, const std::vector<std::string>& requirements) {
  ListedFault out;
  out.name = name;
  out.implementation = "production";
  out.requirements = requirements;
  out.kind = "wrapper";
  return out;
}

TEST_F(Faults, OneIsCaughtByATestOfItsRequirement) {
  const TriedFault result = try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"}));
  EXPECT_EQ(result.outcome, FaultOutcome::kDetected);
  EXPECT_EQ(result.detections.at(0).verdict, Verdict::kFail);
  EXPECT_EQ(result.detections.at(0).test_level, Level::must);
}

// Detected by tests of other requirements only: the one that it is said to break does not notice.
TEST_F(Faults, OneThatNoTestOfItsRequirementNoticesSurvives) {
  const TriedFault result = try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW", "EV-GRID1-ERR-N"}));
  EXPECT_EQ(result.outcome, FaultOutcome::kSurvives);
  EXPECT_TRUE(result.detections.at(0).detected);
  EXPECT_FALSE(result.detections.at(1).detected);
}

TEST_F(Faults, WhatCannotBeStartedIsNotTried) {
  ListedFault unknown = fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"});
  unknown.implementation = "no-such-implementation";
  EXPECT_EQ(try_one(unknown).outcome, FaultOutcome::kNotTried);
  EXPECT_EQ(try_one(fault("NoSuchFault", {"EV-MAP1-ERR-ORDER-LOW"})).outcome, FaultOutcome::kNotTried);
}

TEST_F(Faults, TheTableNamesRequirementsWithoutOne) {
  const FaultTable table = make_table({try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"}))},
                                      {"EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-TARGET"});
  EXPECT_EQ(table.requirements.at(0).faults, std::vector<std::string>{"OrderZeroTaken"});
  EXPECT_TRUE(table.requirements.at(1).faults.empty());
  const std::string text = as_markdown(table);
  EXPECT_NE(text.find("| EV-MAP1-ERR-ORDER-LOW | OrderZeroTaken"), std::string::npos) << text;
  EXPECT_NE(text.find("| EV-MAP1-ERR-TARGET | none"), std::string::npos) << text;
}

}  // namespace
}  // namespace evalcts::faults
