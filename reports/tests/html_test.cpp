// Tests the page as text, and the data in it. check_pages.py reads the page with a parser, and
// browser_test.py opens it in a browser.
#include <gtest/gtest.h>

#include <algorithm>

#include <evalcts/results/known_bugs.h>
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

// Returns the data that the script of the page renders.
json data_of(const std::string& page) {
  const std::string start = "id=\"data\">";
  const std::size_t begin = page.find(start) + start.size();
  return parse_json(page.substr(begin, page.find("</script>", begin) - begin));
}

std::string text_of(const json& data, const json& number) {
  return data["strings"][number.get<std::size_t>()].get<std::string>();
}

// Returns the record of a test in the page's data; null if the column lacks the test. Its fields 0 to 7 are
// verdict, severity, flags, message, baseline, facts, accuracy and violated requirements, the others
// failures.
json record_of(const json& data, std::size_t column, const std::string& test) {
  const json& tests = data["tests"];
  const auto found = std::find_if(tests.begin(), tests.end(),
                                  [&](const json& one) { return text_of(data, one[0]) == test; });
  const int number = data["outcomes"][column][static_cast<std::size_t>(found - tests.begin())].get<int>();
  return number < 0 ? json() : data["records"][static_cast<std::size_t>(number)];
}

TEST(Html, SameInputSameBytes) {
  const std::vector<json> results{read_sample("results-osmesa.json"), read_sample("results-reference.json")};
  const json requirements = read_sample("requirements.json");
  EXPECT_EQ(html_of(results, requirements), html_of(results, requirements));
}

TEST(Html, HalfOfARequirementHasItsText) {
  const json requirements = {
      {"requirements", {{{"id", "EV-X"}, {"text", "the rule itself"}, {"source", "GL 1.0"}}}}};
  const json record = named("x", {{{"name", "A.b"}, {"verdict", "pass"}, {"requirements", {"EV-X/1-D"}}}});
  const json data = data_of(html_of({record}, requirements));
  ASSERT_EQ(data["requirements"].size(), 1u);
  EXPECT_EQ(text_of(data, data["requirements"][0][0]), "EV-X/1-D");
  EXPECT_EQ(text_of(data, data["requirements"][0][2]), "the rule itself");
}

// Counts of known failures have a class of their own and link to the tests.
TEST(Html, Overview) {
  json known = {{"name", "A.known"}, {"verdict", "fail"}, {"expected_by_baseline", true}};
  const json fail = {{"name", "A.fail"}, {"verdict", "fail"}},
             pass = {{"name", "A.pass"}, {"verdict", "pass"}};
  const std::string page =
      html_of({named("x y", {known, pass}), named("bad", {known, fail}), named("good", json::array({pass}))},
              nullptr);
  EXPECT_TRUE(contains(page, "No new failures; 1 known"));
  EXPECT_TRUE(contains(page, "<tr class=\"known\">"));
  EXPECT_TRUE(contains(page, "<tr class=\"bad\">"));
  EXPECT_TRUE(contains(page, "<tr class=\"good\">"));
  EXPECT_TRUE(contains(page,
                       "<td class=\"number known\" data-label=\"fail\"><a "
                       "href=\"#on=x%20y&amp;verdict=fail\">1</a></td>"));
  EXPECT_TRUE(contains(page, "<a href=\"#on=bad&amp;new=1\">1 new failure; 1 known</a>"));
  EXPECT_TRUE(contains(page, "<td class=\"number bad\" data-label=\"fail\">"));
}

TEST(Html, RecordsInTheData) {
  const json pass = {
      {"name", "A.b"}, {"verdict", "pass"}, {"requirements", {"EV-2", "EV-1"}}, {"level", "quality"}};
  json fail = pass;
  fail["verdict"] = "fail";
  fail["message"] = "wrong";
  fail["flake"] = true;
  fail["cases"] = 12;
  fail["failed_cases"] = 2;
  fail["rerun"] = "run --filter 'A.b; rm -r'";
  const json alone = {{"name", "B.d"}, {"verdict", "pass"}};
  const json data = data_of(html_of({named("x", json::array({pass})), named("y", {fail, alone})}, nullptr));
  EXPECT_EQ(data["columns"], json({"x", "y"}));
  ASSERT_EQ(data["tests"].size(), 2u);
  EXPECT_EQ(text_of(data, data["requirements"][data["tests"][0][3].get<std::size_t>()][0]), "EV-2");
  EXPECT_EQ(as_text(data["levels"][data["tests"][0][1].get<std::size_t>()]), "quality");
  const auto verdict_of = [&](const json& record) {
    return std::string(as_text(data["verdicts"][record[0].get<std::size_t>()][0]));
  };
  EXPECT_EQ(verdict_of(record_of(data, 0, "A.b")), "pass");
  EXPECT_TRUE(record_of(data, 0, "B.d").is_null());
  const json record = record_of(data, 1, "A.b");
  EXPECT_EQ(verdict_of(record), "fail");
  EXPECT_EQ(record[2], 1 + 4);  // the flags for an unexpected result and for a flake
  EXPECT_EQ(text_of(data, record[3]), "wrong");
  EXPECT_EQ(text_of(data, record[5]), "2 of 12 cases failed");
  const json& commands = data["commands"][data["commandsOf"][1][0].get<std::size_t>()];
  EXPECT_EQ(text_of(data, commands[0]), std::string("run --filter '\0; rm -r'", 23));
}

// A failing test may violate another requirement than its own.
TEST(Html, ViolatedRequirementsInTheData) {
  json fail = {{"name", "A.b"}, {"verdict", "fail"}, {"requirements", {"EV-1", "EV-2"}}}, elsewhere = fail;
  elsewhere["violated"] = {"EV-2", "EV-3"};
  const json data =
      data_of(html_of({named("x", json::array({fail})), named("y", json::array({elsewhere}))}, nullptr));
  const auto violated = [&](std::size_t column) {
    std::vector<std::string> out;
    for (const json& number : data["violations"][record_of(data, column, "A.b")[7].get<std::size_t>()])
      out.push_back(text_of(data, data["requirements"][number.get<std::size_t>()][0]));
    return out;
  };
  EXPECT_EQ(violated(0), (std::vector<std::string>{"EV-1", "EV-2"}));
  EXPECT_EQ(violated(1), (std::vector<std::string>{"EV-2", "EV-3"}));
  EXPECT_EQ(data["tests"][0].size(), 3u + 2u);  // the test's own requirements only
}

// Equal records are stored once, and so are equal calls.
TEST(Html, NothingStandsInTheDataTwice) {
  const auto failing = [](const std::string& name, const char* captured, double seconds) {
    const json failure = {
        {"case", "one"}, {"captured", captured}, {"calls", {"glBegin(GL_POINTS);", "glEnd();"}}};
    return named(name, json::array({{{"name", "A.b"},
                                     {"verdict", "fail"},
                                     {"seconds", seconds},
                                     {"rerun", "./evalcts run --implementation " + name + " --filter A.b"},
                                     {"failures", {failure, failure}}}}));
  };
  const std::string page =
      html_of({failing("x", "1", 0.5), failing("y", "2", 0.5), failing("z", "1", 0.25)}, nullptr);
  const json data = data_of(page);
  EXPECT_EQ(data["outcomes"][0], data["outcomes"][2]);
  EXPECT_NE(data["outcomes"][0], data["outcomes"][1]);
  EXPECT_EQ(data["calls"].size(), 1u);
  EXPECT_EQ(data["failures"].size(), 2u);
  EXPECT_EQ(occurrences(page, "glBegin(GL_POINTS);"), 1u);
}

TEST(Html, Bugs) {
  const auto with_bug = [](const std::string& name, const char* test, const char* known) {
    json record =
        named(name, {{{"name", "A.b"}, {"verdict", "fail"}}, {{"name", "A.c"}, {"verdict", "fail"}}});
    const json failure = {{"calls", {"glEvalCoord1f(0.5f);"}}};
    record["bugs"] = {{{"id", "EV-X-1"},
                       {"title", "a <bug>"},
                       {"clause", "GL 1.0"},
                       {"requirements", {"EV-X"}},
                       {"failure", failure},
                       {"tests", {test}},
                       {"known", known},
                       {"known_in", known}}};
    return record;
  };
  json many = with_bug("z", "A.b", "");
  many["bugs"].push_back({{"id", "EV-A-2"}, {"title", "more tests"}, {"tests", {"A.b", "A.c"}}});
  const std::string page = html_of({with_bug("x", "A.b", ""), with_bug("y", "A.c", "Mesa 1"), many}, nullptr);
  const json data = data_of(page);
  // Both have the same number of tests, so the order is that of their names.
  ASSERT_EQ(data["bugs"].size(), 2u);
  EXPECT_EQ(as_text(data["bugs"][0]["id"]), "EV-A-2");
  EXPECT_EQ(as_text(data["bugs"][1]["title"]), "a <bug>");
  EXPECT_EQ(data["bugs"][1]["found"], json({{0, 0, 0}, {1, 1, 1}, {2, 0, 0}}));
  // The page shows bugs without scripts, too.
  EXPECT_TRUE(contains(page, "<strong>a &lt;bug&gt;</strong>"));
  EXPECT_TRUE(contains(page, "x (1 test), y (1 test), z (1 test)"));
  EXPECT_TRUE(contains(page, "<pre><code>glEvalCoord1f(0.5f);</code></pre>"));
  EXPECT_TRUE(contains(page, "2 distinct bugs, 2 new"));
  EXPECT_TRUE(contains(page, "<br>1 distinct bug<br>") || contains(page, "<br>1 distinct bug</td>"));
  EXPECT_FALSE(contains(html_of({named("x", json::array())}, nullptr), "id=\"bugs\""));
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
  EXPECT_EQ(occurrences(page, "<span class=\"faint\">not observed</span>"), 1u);
}

TEST(Html, Changes) {
  const json before =
      named("x", {{{"name", "A.b"}, {"verdict", "pass"}}, {{"name", "A.gone"}, {"verdict", "pass"}}});
  const json now = named("x", {{{"name", "A.b"}, {"verdict", "fail"}, {"message", "<wrong>"}}});
  JsonOptions options;
  options.before = {before};
  const std::string page = html_of({now}, nullptr, options);
  EXPECT_TRUE(contains(page,
                       "<a class=\"bad\" href=\"#from=x%2C%20earlier&amp;to=x\">1 regression, 1 vanished "
                       "test</a>"));
  const json data = data_of(page);
  EXPECT_EQ(data["columns"], json({"x", "x, earlier"}));
  EXPECT_EQ(data["earlier"], 1);
  ASSERT_EQ(data["comparisons"].size(), 1u);
  const json& pair = data["comparisons"][0];
  EXPECT_EQ(pair["from"], 1);
  EXPECT_EQ(pair["to"], 0);
  EXPECT_EQ(pair["changes"], json({0, 0, 0, 1, 7, 0}));  // a regression and a vanished test
  EXPECT_EQ(data["since"], json::array({0}));
}

// Any two implementations can be compared, in both directions.
TEST(Html, ComparisonsOfImplementations) {
  json worse = {{"name", "A.b"}, {"verdict", "fail"}, {"mismatches", {"one: x", "two: y"}}}, bad = worse;
  bad["mismatches"] = {"one: x"};
  const json data =
      data_of(html_of({named("x", json::array({bad})), named("y", json::array({worse}))}, nullptr));
  ASSERT_EQ(data["comparisons"].size(), 2u);
  EXPECT_EQ(data["since"], json::array());
  const auto to = [&](std::size_t column) {
    return *std::find_if(data["comparisons"].begin(), data["comparisons"].end(),
                         [&](const json& pair) { return pair["to"] == column; });
  };
  EXPECT_EQ(to(1)["changes"][1], 0);
  EXPECT_EQ(text_of(data, to(1)["changes"][2]), "two: y");
  EXPECT_EQ(to(0)["changes"][1], 4);  // ChangeKind::kFailsOtherwise
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

// The only addresses are those of links to the documents of the registry.
TEST(Html, LoadsNothing) {
  std::string page = html_of({read_sample("results-osmesa.json")}, nullptr);
  for (std::size_t at = page.find("https://registry.khronos.org/"); at != std::string::npos;
       at = page.find("https://registry.khronos.org/"))
    page.erase(at, 8);
  for (const char* loader : {"src=", "url(", "@import", "http://", "https://", "fetch("}) {
    EXPECT_FALSE(contains(page, loader)) << loader;
  }
}

// A known bug has its cause and effect, and the clause links to its documents.
TEST(Html, KnownBugsHaveTheirCause) {
  json record = named("x", {{{"name", "A.b"}, {"verdict", "fail"}}});
  record["bugs"] = {{{"id", "EV-X-1"},
                     {"title", "a bug"},
                     {"clause", "GL 2.1 5.1; glMap1 page"},
                     {"requirements", {"EV-COORD-MIX"}},
                     {"tests", {"A.b"}},
                     {"known", "mesa-mesh-steps"}}};
  const KnownBug& known = *find_known_bug("mesa-mesh-steps");
  const std::string page =
      html_of({record}, {{"requirements", {{{"id", "EV-COORD-MIX"}, {"text", "the rule"}}}}});
  const json data = data_of(page), &bug = data["bugs"][0];
  EXPECT_EQ(as_text(bug["cause"]), known.cause);
  EXPECT_EQ(as_text(bug["realPrograms"]), known.real_programs);
  EXPECT_EQ(as_text(bug["affects"]), known.affects.text());
  ASSERT_EQ(bug["documents"].size(), 2u);
  EXPECT_TRUE(contains(page, "<a href=\"https://registry.khronos.org/OpenGL/specs/gl/glspec21.pdf\""));
  EXPECT_EQ(data["documents"][bug["documents"][1].get<std::size_t>()],
            json({"the reference page of glMap1",
                  "https://registry.khronos.org/OpenGL-Refpages/gl2.1/xhtml/glMap1.xml"}));
  // The requirement has its text although no test names it.
  ASSERT_EQ(data["requirements"].size(), 1u);
  EXPECT_EQ(text_of(data, data["requirements"][0][2]), "the rule");
}

TEST(Html, RunDetails) {
  json record = named("x", {{{"name", "A.b"}, {"verdict", "pass"}, {"source", "suites/maps.cpp:7"}}});
  record["started"] = "2026-11-28T11:27:22Z";
  record["seconds"] = 167;
  record["host"] = "a host";
  record["implementation"]["files"] = {"/usr/lib/libGL.so.1"};
  JsonOptions options;
  options.files = {{"results-x.json", "../a b:c/log-x.txt"}};
  options.sources = "../..";
  const std::string page = html_of({record}, nullptr, options);
  for (const char* part :
       {"<dt>Run</dt><dd>2026-11-28 11:27 UTC, 2 min 47 s</dd>", "<dt>Host</dt><dd>a host</dd>",
        "<dt>Loaded</dt><dd>/usr/lib/libGL.so.1</dd>", "<a href=\"results-x.json\">results-x.json</a>",
        "<a href=\"../a%20b%3Ac/log-x.txt\">log-x.txt</a>"})
    EXPECT_TRUE(contains(page, part)) << part;
  const json data = data_of(page);
  EXPECT_EQ(as_text(data["sources"]), "../..");
  EXPECT_EQ(text_of(data, data["tests"][0][2]), "suites/maps.cpp:7");
}

// Numbers are decimal in all texts.
TEST(Html, PlainNumbers) {
  json record = named(
      "x",
      {{{"name", "A.b"},
        {"verdict", "fail"},
        {"message", "is 0.5 (0x1p-1)"},
        {"failures",
         {{{"case", "u=0x1p-2"}, {"expected", "[0.49998, 0.50002]"}, {"captured", "0.75 (0x1.8p-1)"}}}}}});
  const json data = data_of(html_of({record}, nullptr));
  EXPECT_EQ(text_of(data, record_of(data, 0, "A.b")[3]), "is 0.5");
  const json& failure = data["failures"][0];
  EXPECT_EQ(text_of(data, failure[0]), "u=0.25");
  EXPECT_EQ(text_of(data, failure[3]), "0.5 +- 2e-05");
  EXPECT_EQ(text_of(data, failure[4]), "0.75");
}

TEST(Html, RefusesWrongRecords) {
  EXPECT_THROW(html_of({json{{"tests", 1}}}, nullptr), FormatError);
  EXPECT_THROW(html_of({json::object()}, json{{"requirements", 1}}), FormatError);
}

}  // namespace
}  // namespace evalcts::reports
