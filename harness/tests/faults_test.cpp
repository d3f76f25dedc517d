// The table of faults, on the suite program with faults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "harness/faults/fault_table.h"
#include "harness/runner/runner.h"

namespace evalcts::faults {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class Faults : public testing::Test {
 protected:
  Faults() { fs::create_directories(scratch_); }
  ~Faults() override { fs::remove_all(scratch_); }

  json try_one(const json& fault) {
    static const json tests = list_tests(SUITE_PROGRAM);
    return try_faults({.suite_program = FAULTY_SUITE_PROGRAM,
                       .faults = json::array({fault}),
                       .tests = tests["tests"],
                       .scratch = scratch_},
                      [](std::size_t, const std::string&) {})
        .at(0);
  }

  const fs::path scratch_ = fs::path(testing::TempDir()) / ("evalcts-faults-" + std::to_string(getpid()));
};

json fault(const char* name, const char* requirements) {
  return {{"name", name},    {"implementation", "production"},
          {"level", "must"}, {"requirements", requirements},
          {"what", ""},      {"kind", "wrapper"}};
}

TEST_F(Faults, OneIsCaughtByATestOfItsRequirement) {
  const json result = try_one(fault("OrderZeroTaken", "EV-MAP1-ERR-ORDER-LOW"));
  EXPECT_EQ(as_text(result["outcome"]), "caught");
  EXPECT_EQ(as_text(result["requirements"][0]["verdict"]), "fail");
  EXPECT_EQ(as_text(result["requirements"][0]["test_level"]), "must");
}

// Caught by tests of other requirements only: the one that it is said to break does not notice.
TEST_F(Faults, OneThatNoTestOfItsRequirementNoticesSurvives) {
  const json result = try_one(fault("OrderZeroTaken", "EV-MAP1-ERR-ORDER-LOW EV-GRID1-ERR-N"));
  EXPECT_EQ(as_text(result["outcome"]), "survives");
  EXPECT_TRUE(result["requirements"][0]["caught"]);
  EXPECT_FALSE(result["requirements"][1]["caught"]);
}

TEST_F(Faults, WhatCannotBeStartedIsNotTried) {
  json unknown = fault("OrderZeroTaken", "EV-MAP1-ERR-ORDER-LOW");
  unknown["implementation"] = "no-such-implementation";
  EXPECT_EQ(as_text(try_one(unknown)["outcome"]), "not-tried");
  EXPECT_EQ(as_text(try_one(fault("NoSuchFault", "EV-MAP1-ERR-ORDER-LOW"))["outcome"]), "not-tried");
}

TEST_F(Faults, TheTableNamesRequirementsWithoutOne) {
  const json faults = json::array({try_one(fault("OrderZeroTaken", "EV-MAP1-ERR-ORDER-LOW"))});
  const json rows = faults_by_requirement(faults, {"EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-TARGET"});
  EXPECT_EQ(rows[0]["faults"], json::array({"OrderZeroTaken"}));
  EXPECT_TRUE(rows[1]["faults"].empty());
  const std::string text = as_markdown({{"faults", faults}, {"requirements", rows}});
  EXPECT_NE(text.find("| EV-MAP1-ERR-ORDER-LOW | OrderZeroTaken"), std::string::npos) << text;
  EXPECT_NE(text.find("| EV-MAP1-ERR-TARGET | none"), std::string::npos) << text;
}

}  // namespace
}  // namespace evalcts::faults
