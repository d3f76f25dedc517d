// Tests single values of the XML; check_pages.py reads it with a parser and checks the verdicts.
#include <gtest/gtest.h>

#include "evalcts/reports.h"
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

json one_test(const json& test) {
  return {{"status", "complete"}, {"implementation", {{"name", "x"}}}, {"tests", {test}}};
}

TEST(Junit, SameInputSameBytes) {
  EXPECT_EQ(junit_of(read_sample("results-osmesa.json")), junit_of(read_sample("results-osmesa.json")));
}

TEST(Junit, NoTests) {
  const std::string xml = junit_of({{"status", "complete"}, {"tests", json::array()}});
  EXPECT_TRUE(contains(xml, "tests=\"0\" failures=\"0\" errors=\"0\""));
  EXPECT_FALSE(contains(xml, "<testcase"));
}

TEST(Junit, ANameWithoutATheme) {
  const std::string xml = junit_of(one_test({{"name", "alone"}, {"verdict", "pass"}}));
  EXPECT_TRUE(contains(xml, "classname=\"x.alone\" name=\"alone\""));
}

TEST(Junit, NoBaselineExpectsAnInternalError) {
  const std::string xml =
      junit_of(one_test({{"name", "A.b"}, {"verdict", "internal-error"}, {"expected_by_baseline", true}}));
  EXPECT_TRUE(contains(xml, "errors=\"1\""));
  EXPECT_TRUE(contains(xml, "skipped=\"0\""));
}

TEST(Junit, RefusesWrongRecords) { EXPECT_THROW(junit_of({{"tests", 1}}), FormatError); }

}  // namespace
}  // namespace evalcts::reports
