// What can be said about the page without a parser; check_pages.py reads it back with one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "evalcts/reports.h"
#include "samples.h"

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
  EXPECT_EQ(html_of(results, requirements), html_of(results, requirements));
}

TEST(Html, HostileTextIsEscaped) {
  const std::string page = html_of({hostile_record()}, hostile_requirements());
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
  const std::string page = html_of({record}, requirements);
  EXPECT_TRUE(contains(page, "EV-X/1-D"));
  EXPECT_TRUE(contains(page, "the rule itself"));
}

TEST(Html, NoRecords) {
  const std::string page = html_of({}, nullptr);
  EXPECT_TRUE(contains(page, "No result record was given."));
  EXPECT_TRUE(contains(page, "</html>"));
}

TEST(Html, NotStarted) {
  const std::string page = html_of({read_sample("results-glx.json")}, nullptr);
  EXPECT_TRUE(contains(page, "not started"));
  EXPECT_TRUE(contains(page, "no X server: DISPLAY is not set"));
  EXPECT_FALSE(contains(page, "nothing unexpected"));
}

TEST(Html, WorstFirst) {
  const std::string page =
      html_of({named("x", {{{"name", "A.pass"}, {"verdict", "pass"}},
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

TEST(Html, TestsKnowWhatTheFiltersAskFor) {
  const json pass = {
      {"name", "A.b"}, {"verdict", "pass"}, {"requirements", {"EV-2", "EV-1"}}, {"level", "must"}};
  json fail = pass;
  fail["verdict"] = "fail";
  const json same = {{"name", "B.c"}, {"verdict", "pass"}}, alone = {{"name", "B.d"}, {"verdict", "pass"}};
  const std::string page = html_of({named("x", {pass, same}), named("y", {fail, same, alone})}, nullptr);
  EXPECT_TRUE(contains(page,
                       "id=\"test-A.b\" data-theme=\"A\" data-verdicts=\"pass fail,unexpected\" "
                       "data-level=\"must\" data-rows=\"1 0\" data-differs>"));
  EXPECT_TRUE(contains(page,
                       "id=\"test-B.c\" data-theme=\"B\" data-verdicts=\"pass pass\" data-level=\"must\" "
                       "data-rows=\"\">"));
  EXPECT_TRUE(contains(page, "data-verdicts=\"absent pass\""));
}

// A cell tells the worst of its tests, but what decided nothing only where nothing did.
TEST(Html, RequirementByImplementation) {
  const auto outcome = [](const char* name, const char* verdict, const char* requirement) {
    return json{{"name", name}, {"verdict", verdict}, {"requirements", {requirement}}};
  };
  json known = outcome("A.known", "fail", "EV-KNOWN");
  known["expected_by_baseline"] = true;
  const std::string page = html_of(
      {named("x", {outcome("A.1", "pass", "EV-A"), outcome("A.2", "fail", "EV-A"),
                   outcome("A.3", "pass", "EV-A"), outcome("B.1", "not-observable", "EV-B"),
                   outcome("B.2", "pass", "EV-B"), outcome("C.1", "not-observable", "EV-C"), known}),
       named("y", json::array({outcome("A.1", "pass", "EV-A")}))},
      json{{"requirements",
            {{{"id", "EV-C"}, {"section", "1. First"}}, {{"id", "EV-A"}, {"section", "2. Second"}}}}});
  EXPECT_TRUE(
      contains(page,
               "<td class=\"fail\"><a href=\"#test-A.2\"><span aria-hidden=\"true\">✗</span> fail</a> "
               "<small>1 of 3</small></td><td class=\"pass\"><a href=\"#test-A.1\">"));
  EXPECT_TRUE(
      contains(page,
               "<td class=\"pass\"><a href=\"#test-B.2\"><span aria-hidden=\"true\">✓</span> pass</a> "
               "<small>1 of 2</small></td><td class=\"absent\">no test here</td>"));
  EXPECT_TRUE(contains(page, "<td class=\"not-observable\"><a href=\"#test-C.1\">"));
  EXPECT_TRUE(contains(page, "fail</a> <small>expected</small>"));
  // In the order of the catalogue, with what is not in it at the end.
  EXPECT_LT(page.find("id=\"requirement-EV-C\""), page.find("id=\"requirement-EV-A\""));
  EXPECT_LT(page.find("id=\"requirement-EV-A\""), page.find("Not in the catalogue"));
  EXPECT_LT(page.find("Not in the catalogue"), page.find("id=\"requirement-EV-B\""));
  EXPECT_TRUE(contains(page, "2 of 2 requirements have a test here."));
}

TEST(Html, ReadingsWithTheirMeaning) {
  json x = named("x", json::array());
  x["readings"] = {{"C-TEXT", {"literal"}}};
  const std::string page = html_of(
      {x, named("y", json::array())},
      json{{"contradictions",
            {{{"id", "C-TEXT"}, {"conflict", "two <pages>"}, {"readings", {{"literal", "as it stands"}}}}}}});
  EXPECT_TRUE(contains(page, "<strong>C-TEXT</strong><br>two &lt;pages&gt;"));
  EXPECT_TRUE(contains(page, "<strong>literal</strong>: as it stands"));
  EXPECT_EQ(occurrences(page, "not seen"), 1u);
}

TEST(Html, WhoAgreesInWhatWasNotDecidedSharesIt) {
  const auto hidden = [](const char* name) {
    return json{{"name", name}, {"verdict", "not-observable"}, {"message", "no way"}};
  };
  const std::string page =
      html_of({named("x", {hidden("A.b"), hidden("A.c")}), named("y", {hidden("A.b"), hidden("A.c")}),
               named("z", json::array({hidden("A.b")}))},
              nullptr);
  EXPECT_TRUE(contains(page, "x, y: no way <span class=\"faint\">(2 tests)</span>"));
  EXPECT_TRUE(contains(page, "z: no way <span class=\"faint\">(1 test)</span>"));
}

TEST(Html, ChangesStandFirst) {
  const json before =
      named("x", {{{"name", "A.b"}, {"verdict", "pass"}}, {{"name", "A.gone"}, {"verdict", "pass"}}});
  const json now = named("x", {{{"name", "A.b"}, {"verdict", "fail"}, {"message", "<wrong>"}}});
  JsonOptions options;
  options.before = {before};
  const std::string page = html_of({now}, nullptr, options);
  EXPECT_TRUE(contains(page, "<h3>x: 1 regression, 1 vanished test</h3>"));
  EXPECT_TRUE(contains(page, "<a href=\"#test-A.b\">A.<wbr>b</a>: pass, now fail: &lt;wrong&gt;"));
  EXPECT_TRUE(contains(page, "data-verdicts=\"fail,unexpected,regression\""));
  EXPECT_FALSE(contains(page, "#test-A.gone"));
  EXPECT_LT(page.find("id=\"changes\""), page.find("id=\"implementations\""));
  EXPECT_FALSE(contains(html_of({now}, nullptr), "id=\"changes\""));
}

TEST(Html, FlakesAreMarked) {
  json flake = {{"name", "A.b"}, {"verdict", "fail"}, {"flake", true}}, fail = flake;
  fail.erase("flake");
  const std::string page =
      html_of({named("x", json::array({flake})), named("y", json::array({fail}))}, nullptr);
  EXPECT_TRUE(contains(page, "</span> fail, flake: x</span>"));
  EXPECT_TRUE(contains(page, "</span> fail: y</span>"));
  EXPECT_TRUE(contains(page, "data-verdicts=\"fail,unexpected,flake fail,unexpected\""));
  EXPECT_TRUE(contains(page, "<option value=\"flake\">"));
  EXPECT_FALSE(contains(html_of({named("y", json::array({fail}))}, nullptr), "<option value=\"flake\">"));
}

// What came out alike is told once, with the commands for each.
TEST(Html, OneDescriptionForThoseThatAgree) {
  const auto failing = [](const std::string& name, const char* got, double seconds) {
    return named(name, json::array({{{"name", "A.b"},
                                     {"verdict", "fail"},
                                     {"seconds", seconds},
                                     {"rerun", "./evalcts run --implementation " + name},
                                     {"failures", {{{"case", "one"}, {"captured", got}}}}}}));
  };
  const std::string page =
      html_of({failing("x", "1", 0.5), failing("y", "2", 0.5), failing("z", "1", 0.25)}, nullptr);
  EXPECT_TRUE(contains(page, "fail</span> x, z</h3>"));
  EXPECT_TRUE(contains(page, "fail</span> y</h3>"));
  EXPECT_EQ(occurrences(page, "<section class=\"outcome\">"), 2u);
  for (const char* name : {"x", "z"})
    EXPECT_TRUE(contains(
        page,
        fmt::format("Run just this test, {0}:</span> <code>./evalcts run --implementation {0}<", name)));
  EXPECT_TRUE(contains(page, "Run just this test:</span> <code>./evalcts run --implementation y<"));
  // Of those who agree the times are left out; passes without anything to say share a line.
  EXPECT_FALSE(contains(page, "0.250 s"));
  json slow = {{"name", "A.b"}, {"verdict", "pass"}, {"cases", 2}, {"seconds", 0.5}}, quick = slow;
  quick["seconds"] = 0.25;
  EXPECT_TRUE(contains(html_of({named("x", json::array({slow})), named("y", json::array({quick}))}, nullptr),
                       "<strong>x, y</strong> pass (2 cases)<br>"));
  EXPECT_TRUE(contains(html_of({named("x", json::array({slow}))}, nullptr), "pass (2 cases, 0.500 s)<br>"));
}

// The failures of one case have the same calls.
TEST(Html, CallsOfTheFailureAboveAreNotRepeated) {
  const json of_one = {{"case", "one"}, {"message", "m"}, {"calls", {"glBegin(GL_POINTS);", "glEnd();"}}};
  const json of_another = {{"case", "two"}, {"message", "m"}, {"calls", {"glBegin(GL_LINES);"}}};
  const std::string page = html_of(
      {named("x",
             {{{"name", "A.b"}, {"verdict", "fail"}, {"failures", {of_one, of_one, of_another, of_one}}}})},
      nullptr);
  EXPECT_EQ(occurrences(page, "glBegin(GL_POINTS);"), 2u);
  EXPECT_EQ(occurrences(page, "glBegin(GL_LINES);"), 1u);
  EXPECT_EQ(occurrences(page, "The GL calls are those of the failure above."), 1u);
}

TEST(Html, LeadsToThePageOfAccuracyWhereThereIsOne) {
  JsonOptions options;
  EXPECT_FALSE(contains(html_of({}, nullptr, options), "accuracy.html"));
  options.accuracy_page = true;
  EXPECT_TRUE(contains(html_of({}, nullptr, options), "<a href=\"accuracy.html\">"));
}

TEST(Html, RecordsOfOneNameStayApart) {
  const std::string page = html_of({named("x", json::array()), named("x", json::array())}, nullptr);
  EXPECT_TRUE(contains(page, "<h3>x</h3>"));
  EXPECT_TRUE(contains(page, "<h3>x (2)</h3>"));
  json first = named("x", json::array()), second = first, third = first;
  first["origin"] = "old";
  second["origin"] = third["origin"] = "new";
  const std::string other = html_of({first, second, third}, nullptr);
  for (const char* heading : {"<h3>x (old)</h3>", "<h3>x (new)</h3>", "<h3>x (new) (2)</h3>"})
    EXPECT_TRUE(contains(other, heading)) << heading;
}

TEST(Html, DifferentNamesGiveDifferentAnchors) {
  const std::string page = html_of(
      {named("x", {{{"name", "A b"}, {"verdict", "pass"}}, {{"name", "A~20b"}, {"verdict", "pass"}}})},
      nullptr);
  EXPECT_TRUE(contains(page, "id=\"test-A~20b\""));
  EXPECT_TRUE(contains(page, "id=\"test-A~7E20b\""));
}

TEST(Html, CommandsStandAsRecorded) {
  const std::string page =
      html_of({named("x", {{{"name", "A.b"}, {"verdict", "fail"}, {"rerun", "run --filter 'A.b; rm -r'"}}})},
              nullptr);
  EXPECT_TRUE(contains(page, "<code>run --filter &apos;A.b; rm -r&apos;</code>"));
}

TEST(Html, LoadsNothing) {
  const std::string page = html_of({read_sample("results-osmesa.json")}, nullptr);
  for (const char* loader : {"src=", "url(", "@import", "http://", "https://", "fetch("}) {
    EXPECT_FALSE(contains(page, loader)) << loader;
  }
}

TEST(Html, RefusesWrongRecords) {
  EXPECT_THROW(html_of({json{{"tests", 1}}}, nullptr), FormatError);
  EXPECT_THROW(html_of({json::object()}, json{{"requirements", 1}}), FormatError);
}

}  // namespace
}  // namespace evalcts::reports
