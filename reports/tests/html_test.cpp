// What can be said about the page without a parser; check_pages.py reads it back with one.
#include <gtest/gtest.h>

#include "evalcts/reports.h"
#include "reports/tests/samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

json named(const std::string& name, const json& tests) {
  return {{"status", "complete"}, {"implementation", {{"name", name}}}, {"tests", tests}};
}

TEST(Html, SameInputSameBytes) {
  const std::vector<json> results{read_sample("results-osmesa.json"), read_sample("results-reference.json")};
  const json requirements = read_sample("requirements.json");
  EXPECT_EQ(html(results, requirements), html(results, requirements));
}

TEST(Html, HostileTextIsEscaped) {
  const std::string page = html({hostile_record()}, hostile_requirements());
  EXPECT_FALSE(contains(page, "<script>alert"));
  EXPECT_TRUE(contains(
      page, "&lt;script&gt;alert(1)&lt;/script&gt; &quot; &apos; &amp; ]]&gt; --&gt; {{name}} {{{name}}}"));
  EXPECT_EQ(occurrences(page, "<script"), 1u);
  EXPECT_FALSE(contains(page, "\xFF"));
  EXPECT_FALSE(contains(page, "\x1b"));
}

TEST(Html, HalfOfARequirementShowsItsText) {
  const json requirements = {
      {"requirements", {{{"id", "EV-X"}, {"text", "the rule itself"}, {"source", "GL 1.0"}}}}};
  const json record = named("x", {{{"name", "A.b"}, {"verdict", "pass"}, {"requirements", {"EV-X/1-D"}}}});
  const std::string page = html({record}, requirements);
  EXPECT_TRUE(contains(page, "EV-X/1-D"));
  EXPECT_TRUE(contains(page, "the rule itself"));
}

TEST(Html, NoRecords) {
  const std::string page = html({}, nullptr);
  EXPECT_TRUE(contains(page, "No result record was given."));
  EXPECT_TRUE(contains(page, "</html>"));
}

TEST(Html, NotStarted) {
  const std::string page = html({read_sample("results-glx.json")}, nullptr);
  EXPECT_TRUE(contains(page, "not started"));
  EXPECT_TRUE(contains(page, "no X server: DISPLAY is not set"));
  EXPECT_FALSE(contains(page, "nothing unexpected"));
}

TEST(Html, WorstFirst) {
  const std::string page =
      html({named("x", {{{"name", "A.pass"}, {"verdict", "pass"}},
                        {{"name", "A.warn"}, {"verdict", "quality-warning"}},
                        {{"name", "A.known"}, {"verdict", "crash"}, {"expected_by_baseline", true}},
                        {{"name", "A.fail"}, {"verdict", "fail"}}})},
           nullptr);
  const auto at = [&](const char* name) { return page.find("id=\"test-" + std::string(name) + "\""); };
  EXPECT_LT(at("A.fail"), at("A.known"));
  EXPECT_LT(at("A.known"), at("A.warn"));
  EXPECT_LT(at("A.warn"), at("A.pass"));
  EXPECT_NE(at("A.pass"), std::string::npos);
}

TEST(Html, MatrixMarksWhereImplementationsDiffer) {
  const json pass = {{"name", "A.b"}, {"verdict", "pass"}}, fail = {{"name", "A.b"}, {"verdict", "fail"}};
  const json same = {{"name", "A.c"}, {"verdict", "pass"}}, alone = {{"name", "A.d"}, {"verdict", "pass"}};
  const std::string page = html({named("x", {pass, same}), named("y", {fail, same, alone})}, nullptr);
  EXPECT_TRUE(
      contains(page, "id=\"test-A.b\" data-verdicts=\"pass fail unexpected\" data-level=\"\" data-differs"));
  EXPECT_TRUE(contains(page, "id=\"test-A.c\" data-verdicts=\"pass pass\" data-level=\"\">"));
  EXPECT_TRUE(contains(page, "id=\"test-A.d\" data-verdicts=\"pass\" data-level=\"\">"));
  EXPECT_EQ(occurrences(page, "not in this record"), 1u);
}

TEST(Html, RecordsOfOneNameStayApart) {
  const std::string page = html({named("x", json::array()), named("x", json::array())}, nullptr);
  EXPECT_TRUE(contains(page, "<h3>x</h3>"));
  EXPECT_TRUE(contains(page, "<h3>x (2)</h3>"));
}

TEST(Html, DifferentNamesGiveDifferentAnchors) {
  const std::string page =
      html({named("x", {{{"name", "A b"}, {"verdict", "pass"}}, {{"name", "A~20b"}, {"verdict", "pass"}}})},
           nullptr);
  EXPECT_TRUE(contains(page, "id=\"test-A~20b\""));
  EXPECT_TRUE(contains(page, "id=\"test-A~7E20b\""));
}

TEST(Html, CommandsStandAsRecorded) {
  const std::string page =
      html({named("x", {{{"name", "A.b"}, {"verdict", "fail"}, {"rerun", "run --filter 'A.b; rm -r'"}}})},
           nullptr);
  EXPECT_TRUE(contains(page, "<code>run --filter &apos;A.b; rm -r&apos;</code>"));
}

TEST(Html, LoadsNothing) {
  const std::string page = html({read_sample("results-osmesa.json")}, nullptr);
  for (const char* loader : {"src=", "url(", "@import", "http://", "https://", "fetch("}) {
    EXPECT_FALSE(contains(page, loader)) << loader;
  }
}

TEST(Html, RefusesWrongRecords) {
  EXPECT_THROW(html({json{{"tests", 1}}}, nullptr), FormatError);
  EXPECT_THROW(html({json::object()}, json{{"requirements", 1}}), FormatError);
}

}  // namespace
}  // namespace evalcts::reports
