// Tests the trial of faults and variations, with the suite program with faults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <evalcts/faults/trial.h>
#include <evalcts/runner/worker.h>
#include "contains.h"

namespace evalcts::faults {
namespace {

namespace fs = std::filesystem;

class Faults : public testing::Test {
 protected:
  Faults() { fs::create_directories(scratch_); }
  ~Faults() override { fs::remove_all(scratch_); }

  Tried try_one(const ListedChange& fault) {
    static const std::vector<ListedTest> kTests = list_tests(SUITE_PROGRAM);
    return try_all({.suite_program = FAULTY_SUITE_PROGRAM,
                    .changes = {fault},
                    .tests = kTests,
                    .scratch = scratch_},
                   [](std::size_t, const std::string&) {})
        .at(0);
  }

  const fs::path scratch_ = fs::path(testing::TempDir()) / ("evalcts-faults-" + std::to_string(getpid()));
};

ListedChange change(const char* name, const std::vector<std::string>& requirements, const char* kind) {
  ListedChange out;
  out.name = name;
  out.implementation = "production";
  out.requirements = requirements;
  out.kind = kind;
  return out;
}
ListedChange fault(const char* name, const std::vector<std::string>& requirements) {
  return change(name, requirements, "wrapper");
}

TEST_F(Faults, OneIsCaughtByATestOfItsRequirement) {
  const Tried result = try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"}));
  EXPECT_TRUE(result.is_good());
  EXPECT_EQ(result.detections.at(0).first.verdict, Verdict::kFail);
  EXPECT_EQ(result.detections.at(0).first.level, Level::kMust);
  EXPECT_EQ(result.detections.at(0).first.depth, Depth::kQuick);
}

// The tests of one of the requirements do not detect the fault.
TEST_F(Faults, OneThatNoTestOfItsRequirementNoticesSurvives) {
  const Tried result = try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW", "EV-GRID1-ERR-N"}));
  EXPECT_EQ(result.not_tried, "");
  EXPECT_FALSE(result.is_good());
  EXPECT_TRUE(result.detections.at(0).is_detected());
  EXPECT_FALSE(result.detections.at(1).is_detected());
}

// Tries one variation with one fault behind it, on the tests whose names begin with one of `beginnings`.
Tried try_variation(const fs::path& scratch, const char* name, const std::vector<std::string>& violates,
                    const std::vector<std::string>& beginnings, const ListedChange& behind) {
  std::vector<ListedTest> tests = list_tests(SUITE_PROGRAM);
  std::erase_if(tests, [&](const ListedTest& test) {
    return std::ranges::none_of(beginnings,
                                [&](const std::string& begin) { return test.name.starts_with(begin); });
  });
  return try_all({.suite_program = FAULTY_SUITE_PROGRAM,
                  .changes = {change(name, violates, "variation")},
                  .behind = {behind},
                  .tests = tests,
                  .scratch = scratch},
                 [](std::size_t, const std::string&) {})
      .at(0);
}

TEST_F(Faults, FaultBehindAVariationIsDetected) {
  const ListedChange domain = fault("SymmetricDomainTakenForUnit", {"EV-MAP1-DOMAIN"});
  const Tried tried = try_variation(scratch_, "NoNegativeZero", {}, {"Map1Values."}, domain);
  EXPECT_TRUE(tried.is_good()) << as_markdown(std::vector<Tried>{tried});
  EXPECT_GT(tried.passed, 0u);
  EXPECT_EQ(tried.detections.at(0).outcome, Detection::Outcome::kDetected);
  EXPECT_TRUE(tried.detections.at(0).first.test.starts_with("Map1Values."));
}

TEST_F(Faults, VariationWithoutColoursPassesInPart) {
  const ListedChange alpha = fault("AlphaOfTheFirstVertex", {"EV-ATTR-COLOR"});
  const Tried tried = try_variation(scratch_, "PositionOnly", {}, {"Map1Values.", "Attributes."}, alpha);
  EXPECT_TRUE(tried.is_good()) << as_markdown(std::vector<Tried>{tried});
  EXPECT_GT(tried.passed_in_part, 0u);
  EXPECT_GT(tried.unobserved, 0u);
  EXPECT_EQ(tried.detections.at(0).outcome, Detection::Outcome::kNotVisible);
  EXPECT_NE(tried.detections.at(0).reason.find("shows colour"), std::string::npos)
      << tried.detections.at(0).reason;
}

TEST_F(Faults, ReasonWhyAFaultCannotBeVisibleIsStated) {
  const Tried tried =
      try_variation(scratch_, "PositionOnly", {}, {"Ordering.EvaluatesInOrder", "AfterRandomCommands."},
                    fault("ColorWaitsForEnd", {"EV-BE-ORDER"}));
  EXPECT_TRUE(tried.is_good()) << as_markdown(std::vector<Tried>{tried});
  EXPECT_EQ(tried.detections.at(0).outcome, Detection::Outcome::kNotVisible);
  EXPECT_TRUE(tried.detections.at(0).reason.starts_with("explicit vertices wait"))
      << as_markdown(std::vector<Tried>{tried});
}

// Tests of both forms of Map judge the floats, and name the doubles as not observed.
TEST_F(Faults, FaultIsDetectedInTheFormThatExists) {
  const Tried tried = try_variation(scratch_, "NoDoubles", {}, {"GetMap2.OrderDomainAndPoints"},
                                    fault("OrdersExchangedInFloats", {"EV-GETMAP-ORDER2"}));
  EXPECT_TRUE(tried.is_good()) << as_markdown(std::vector<Tried>{tried});
  EXPECT_GT(tried.passed, 0u);
  EXPECT_EQ(tried.passed, tried.passed_in_part);
  EXPECT_EQ(tried.detections.at(0).outcome, Detection::Outcome::kDetected)
      << as_markdown(std::vector<Tried>{tried});
}

// Only positions are observed, so the tests pass only in part, but positions show the fault.
TEST_F(Faults, FaultIsDetectedInThePartThatIsSeen) {
  const Tried tried = try_variation(scratch_, "PositionOnly", {}, {"Map1Values.Domain"},
                                    fault("SymmetricDomainTakenForUnit", {"EV-MAP1-DOMAIN"}));
  EXPECT_TRUE(tried.is_good()) << as_markdown(std::vector<Tried>{tried});
  EXPECT_EQ(tried.passed, tried.passed_in_part);
  EXPECT_EQ(tried.detections.at(0).outcome, Detection::Outcome::kDetected)
      << as_markdown(std::vector<Tried>{tried});
}

TEST_F(Faults, TestThatFailsOnAVariationIsAFalseAlarm) {
  const ListedChange none = fault("OrderZeroTaken", {});
  const std::vector<std::string> points = {"Mesh2.Points"};
  const Tried alarming = try_variation(scratch_, "MeshesBackwards", {}, points, none);
  EXPECT_FALSE(alarming.is_good());
  EXPECT_TRUE(alarming.alarms.at(0).test.starts_with("Mesh2.Points"));
  EXPECT_TRUE(try_variation(scratch_, "MeshesBackwards", {"EV-MESH2-POINT"}, points, none).is_good());
}

TEST_F(Faults, WhatCannotBeStartedIsNotTried) {
  ListedChange unknown = fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"});
  unknown.implementation = "no-such-implementation";
  EXPECT_NE(try_one(unknown).not_tried, "");
  EXPECT_NE(try_one(fault("NoSuchFault", {"EV-MAP1-ERR-ORDER-LOW"})).not_tried, "");
}

// No vertex program can be used with production.
TEST_F(Faults, WhatNoTestObservesIsNotTried) {
  const Tried only = try_one(fault("OrderZeroTaken", {"EV-AUTON-VP"}));
  EXPECT_TRUE(only.not_tried.find("without the fault") != std::string::npos) << only.not_tried;
  const Tried in_part = try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW", "EV-AUTON-VP"}));
  EXPECT_TRUE(in_part.is_good());
  EXPECT_EQ(in_part.detections.at(1).outcome, Detection::Outcome::kNotVisible);
  const FaultTable table = make_table({in_part}, {"EV-MAP1-ERR-ORDER-LOW", "EV-AUTON-VP"});
  EXPECT_EQ(table.requirements.at(0).faults, std::vector<std::string>{"OrderZeroTaken"});
  EXPECT_TRUE(table.requirements.at(1).faults.empty());
}

// The exception leaves the threads, so that the command can report it.
TEST_F(Faults, AProgramThatCannotBeStartedIsAnError) {
  const ListedChange one = fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"});
  EXPECT_THROW(try_all({.suite_program = scratch_ / "missing",
                        .changes = {one, one, one},
                        .tests = list_tests(SUITE_PROGRAM),
                        .jobs = 2,
                        .scratch = scratch_},
                       [](std::size_t, const std::string&) {}),
               std::runtime_error);
}

TEST_F(Faults, TheTableNamesRequirementsWithoutOne) {
  const FaultTable table = make_table({try_one(fault("OrderZeroTaken", {"EV-MAP1-ERR-ORDER-LOW"}))},
                                      {"EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-TARGET"});
  EXPECT_EQ(table.requirements.at(0).faults, std::vector<std::string>{"OrderZeroTaken"});
  EXPECT_TRUE(table.requirements.at(1).faults.empty());
  const std::string text = as_markdown(table);
  EXPECT_TRUE(contains(text, "| EV-MAP1-ERR-ORDER-LOW | OrderZeroTaken"));
  EXPECT_TRUE(contains(text, "| EV-MAP1-ERR-TARGET | none"));
}

}  // namespace
}  // namespace evalcts::faults
