// Tests the coverage of requirements, the catalogue's reasons for undecidable ones, and the wrapping of its
// text and its abbreviations.
#include <evalcts/results/coverage.h>
#include <evalcts/results/documents.h>

#include <gtest/gtest.h>

#include <regex.h>

#include <evalcts/results/requirements.h>
#include "cli/wrap.h"

namespace evalcts {
namespace {

using State = Coverage::State;

Catalogue requirements(const std::map<std::string, std::string>& undecidable = {}) {
  Catalogue catalogue;
  catalogue.requirements.resize(2);
  catalogue.requirements[0].id = "A";
  catalogue.requirements[0].undecidable = undecidable;
  catalogue.requirements[1].id = "B";
  return catalogue;
}

const std::map<std::string, std::string> kInvisible = {{"1-D", "nobody can see it"},
                                                       {"2-D", "nobody can see it"}};

std::vector<ListedTest> tests(const std::vector<RequirementId>& decided) { return {{"T.t", decided}}; }

// Codes that are explained elsewhere: of a reference page (P-glMap1) and of a way to observe (O1).
TEST(Requirements, AreUnderstoodByThemselves) {
  regex_t code;
  ASSERT_EQ(regcomp(&code, R"(\bP-f?gl|\bO[1-9]\b|\bGLXenc\b)", REG_EXTENDED | REG_NOSUB), 0);
  const auto has_code = [&](const std::string& text) {
    return regexec(&code, text.c_str(), 0, nullptr, 0) == 0;
  };
  for (const Requirement& requirement : catalogue().requirements)
    for (const std::string& text : {requirement.source, requirement.observation})
      EXPECT_FALSE(has_code(text)) << requirement.id << ": " << text;
  for (const Ambiguity& ambiguity : catalogue().ambiguities)
    for (const std::string& text : {ambiguity.where, ambiguity.text(), ambiguity.why})
      EXPECT_FALSE(has_code(text)) << ambiguity.id << ": " << text;
  regfree(&code);
}

TEST(Coverage, StatesOfARequirement) {
  EXPECT_EQ(coverage_of(requirements(), tests({"A"}))[0].state, State::kDecided);
  EXPECT_EQ(coverage_of(requirements(), tests({"A/1-D", "A/2-D"}))[0].state, State::kDecided);
  const Coverage half = coverage_of(requirements(), tests({"A/2-D"}))[0];
  EXPECT_EQ(half.state, State::kInPart);
  EXPECT_EQ(half.lacks, "1-D");
  EXPECT_EQ(half.tests, std::vector<std::string>{"T.t"});
  EXPECT_EQ(coverage_of(requirements(), tests({"A"}))[1].state, State::kUndecided);
}

TEST(Coverage, UndecidableWithReason) {
  const Coverage entry = coverage_of(requirements(kInvisible), tests({"B"}))[0];
  EXPECT_EQ(entry.state, State::kUndecidable);
  EXPECT_EQ(entry.reason, "nobody can see it");
  const Catalogue half = requirements({{"2-D", "too dark"}});
  EXPECT_EQ(coverage_of(half, tests({"A/1-D"}))[0].state, State::kInPart);
  EXPECT_EQ(coverage_of(half, tests({"A/1-D"}))[0].reason, "too dark");
  EXPECT_EQ(coverage_of(half, tests({"B"}))[0].state, State::kUndecided);
}

TEST(Coverage, LintOfUndecidable) {
  const Catalogue whole = requirements(kInvisible);
  EXPECT_TRUE(lint(whole, tests({"B"})).empty());
  EXPECT_EQ(lint(whole, tests({"A"})).size(), 2u);
  EXPECT_EQ(lint(whole, tests({"A/1-D"})),
            std::vector<std::string>{"A/1-D is undecidable, but T.t decides it"});
  const Catalogue half = requirements({{"2-D", "too dark"}});
  EXPECT_TRUE(lint(half, tests({"A/1-D"})).empty());
  EXPECT_EQ(lint(half, tests({"A/2-D"})).size(), 1u);
  EXPECT_EQ(lint(requirements({{"3-D", "too dark"}}), tests({"B"})).size(), 1u);
  EXPECT_EQ(lint(requirements({{"1-D", ""}}), tests({"B"})).size(), 1u);
}

TEST(Catalogue, QuotesShortly) {
  std::size_t quoted = 0;
  for (const Requirement& requirement : catalogue().requirements) {
    const Quote& quote = requirement.quote;
    EXPECT_EQ(quote.text.empty(), quote.source.empty()) << requirement.id;
    if (quote.text.empty()) continue;
    ++quoted;
    EXPECT_EQ(documents_in(quote.source).size(), 1u) << requirement.id << ": " << quote.source;
    EXPECT_LE(std::ranges::count(quote.text, ' '), 40) << requirement.id;
  }
  EXPECT_GE(quoted, 150u);
}

TEST(Catalogue, ReadsBothFormsOfUndecidable) {
  const Catalogue read = Catalogue::parse(
      R"({"requirements": [{"id": "A", "undecidable": "why"}, {"id": "B", "undecidable": {"2-D": "how"}}]})");
  EXPECT_EQ(read.requirements.at(0).undecidable.size(), 2u);
  EXPECT_EQ(read.requirements.at(1).undecidable, (std::map<std::string, std::string>{{"2-D", "how"}}));
  EXPECT_EQ(read.find("B/1-D"), &read.requirements[1]);
  EXPECT_EQ(read.find("C"), nullptr);
}

TEST(Wrap, BreaksBetweenWords) {
  EXPECT_EQ(cli::wrapped("one two three", 7, "  "), "one two\n  three");
  EXPECT_EQ(cli::wrapped("one two three", 8, "  ", 4), "one\n  two\n  three");
  EXPECT_EQ(cli::wrapped("abcdefghij klm", 5, "  "), "abcdefghij\n  klm");
  EXPECT_EQ(cli::wrapped("§§§ §§§", 7, ""), "§§§ §§§");
  EXPECT_EQ(cli::wrapped("", 10, "  "), "");
}

// --- documents ---------------------------------------------------------------------------------------------

TEST(Documents, AreFoundInSources) {
  const auto names = [](const std::string& source) {
    std::vector<std::string> all;
    for (const Document& document : documents_in(source)) all.push_back(document.name);
    return all;
  };
  using Strings = std::vector<std::string>;
  EXPECT_EQ(names("GL 1.0-4.6c §5.1/§21.1; glMap2 page; fglMap2 page"),
            (Strings{"OpenGL 1.0", "OpenGL 4.6", "the reference page of glMap2"}));
  EXPECT_EQ(names("GL 2.1 5.1, glEvalPoint and glMapGrid pages; GL 2.1 §2.5"),
            (Strings{"OpenGL 2.1", "the reference page of glEvalPoint", "the reference page of glMapGrid"}));
  EXPECT_EQ(names("NV_evaluators errors (second entry); GLX protocol §2.3.5; gl.xml"),
            (Strings{"GL_NV_evaluators", "the GLX protocol", "gl.xml"}));
  EXPECT_EQ(names("(from memory)"), Strings());
  const auto address = [](const std::string& source) { return documents_in(source).at(0).address; };
  EXPECT_TRUE(address("GL 1.2.1 F.2.13").ends_with("/glspec121.pdf"));
  EXPECT_TRUE(address("GL 3.1c").ends_with("/glspec31undep.pdf"));
  EXPECT_TRUE(address("GL 4.3c+").ends_with("/glspec43.compatibility.pdf"));
  EXPECT_TRUE(address("GL 4.6 core 22.1").ends_with("/glspec46.core.pdf"));
  EXPECT_TRUE(address("NV_evaluators").ends_with("/extensions/NV/NV_evaluators.txt"));
  // Nearly all sources name a document.
  std::size_t without = 0;
  for (const Requirement& requirement : catalogue().requirements)
    without += documents_in(requirement.source).empty();
  EXPECT_LT(without, 12u);
}

}  // namespace
}  // namespace evalcts
