// Reads the known bugs from JSON that is compiled in, finds a bug by its ID or its sign, checks all of them,
// and lists them as Markdown.
#include <evalcts/results/known_bugs.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <regex>
#include <set>

#include <evalcts/results/json_object.h>
#include <evalcts/results/requirements.h>
#include "known_bugs_data.h"  // kKnownBugs

namespace evalcts {
namespace {

using nlohmann::json;

KnownBug read_known_bug(const JsonObject& in) {
  KnownBug out;
  out.id = in.text("id");
  out.title = in.text("title");
  if (const auto affects = in.object("affects"))
    out.affects = {affects->text("product"), affects->text("first"), affects->text("last"),
                   affects->text("renderer")};
  const std::vector<std::string> requirements = in.texts("requirements");
  out.requirements = {requirements.begin(), requirements.end()};
  out.clause = in.text("clause");
  out.program = in.json_text("program");
  out.expected = in.text("expected");
  out.captured = in.text("captured");
  out.cause = in.text("cause");
  out.suspected = in.boolean("suspected");
  out.real_programs = in.text("real_programs");
  out.verified = in.text("verified");
  out.crashes = in.boolean("crashes");
  in.each_object("signs", [&](const JsonObject& sign) {
    out.signs.push_back({sign.text("cause"), sign.text("what"), sign.text("expected"), sign.text("captured"),
                         sign.text("relation")});
  });
  return out;
}

// Returns the numbers at the beginning of the text: 22, 3 and 6 of "22.3.6-1".
std::vector<int> version_numbers(const std::string& text) {
  std::vector<int> numbers;
  const char *at = text.data(), *const end = at + text.size();
  for (int number = 0; at != end;) {
    const auto [behind, error] = std::from_chars(at, end, number);
    if (error != std::errc()) break;
    numbers.push_back(number);
    at = behind;
    if (at == end || *at != '.') break;
    ++at;
  }
  return numbers;
}

// Compares as many numbers of `version` with `bound` as the bound has.
std::strong_ordering compare_versions(std::vector<int> version, const std::vector<int>& bound) {
  version.resize(bound.size());
  return std::lexicographical_compare_three_way(version.begin(), version.end(), bound.begin(), bound.end());
}

bool matches_whole(const std::string& expression, const std::string& text) {
  return expression.empty() || std::regex_match(text, std::regex(expression));
}

// Returns the first numbers of the text, at most `most`: {0.5, 1} of "[0.5, 1]", {3} of "3 vertices".
std::vector<double> numbers_in(const std::string& text, std::size_t most) {
  static const std::regex kNumber("[-+]?[0-9.]+(e[-+]?[0-9]+)?");
  std::vector<double> numbers;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end && numbers.size() < most;
       ++it)
    numbers.push_back(std::strtod(it->str().c_str(), nullptr));
  return numbers;
}

// See BugSign::relation.
bool has_relation(const std::string& relation, const Failure& failure) {
  constexpr double kNear = 0.01;
  if (relation.empty()) return true;
  const std::vector<double> expected =
      numbers_in(failure.expected, failure.expected.starts_with('[') ? 2 : 1);
  const std::vector<double> captured = numbers_in(failure.captured, 1);
  if (expected.empty() || captured.empty()) return false;
  const double above = captured[0] - expected.back(), below = expected[0] - captured[0];
  if (relation == "more") return above > 0;
  if (relation == "less") return below > 0;
  return std::max(above, below) <= kNear * std::max(1.0, std::abs(expected[0]));
}

}  // namespace

std::string AffectedVersions::text() const {
  return fmt::format("{} {}{}{}", product, first, first == last ? "" : " to " + last,
                     renderer.empty() ? "" : " with " + renderer);
}

bool AffectedVersions::contains(const ImplementationRecord& implementation) const {
  const std::size_t at = implementation.version.find(product + " ");
  if (at == std::string::npos || implementation.renderer.find(renderer) == std::string::npos) return false;
  const std::vector<int> version = version_numbers(implementation.version.substr(at + product.size() + 1));
  return !version.empty() && compare_versions(version, version_numbers(first)) >= 0 &&
         compare_versions(version, version_numbers(last)) <= 0;
}

bool BugSign::matches(const std::string& of_cause, const Failure& failure) const {
  return cause == of_cause && matches_whole(what, failure.what) &&
         matches_whole(expected, failure.expected) && matches_whole(captured, failure.captured) &&
         has_relation(relation, failure);
}

bool KnownBug::has_sign(const std::string& of_cause, const Failure& failure) const {
  return std::ranges::any_of(signs, [&](const BugSign& sign) { return sign.matches(of_cause, failure); });
}

std::vector<KnownBug> parse_known_bugs(const std::string& text) {
  const json data = json::parse(text, nullptr, false);
  if (data.is_discarded()) throw FormatError("the known bugs are not JSON");
  std::vector<KnownBug> bugs;
  JsonObject(data, "").each_object("bugs",
                                   [&](const JsonObject& item) { bugs.push_back(read_known_bug(item)); });
  std::ranges::sort(bugs, {}, &KnownBug::id);
  return bugs;
}

const std::vector<KnownBug>& known_bugs() {
  static const std::vector<KnownBug> kAll = parse_known_bugs(kKnownBugs);
  return kAll;
}

const KnownBug* find_known_bug(const std::string& id) {
  const auto found = std::ranges::find(known_bugs(), id, &KnownBug::id);
  return found == known_bugs().end() ? nullptr : &*found;
}

std::vector<std::string> lint(const std::vector<KnownBug>& bugs) {
  std::vector<std::string> problems;
  std::set<std::string> ids, signs;
  for (const KnownBug& bug : bugs) {
    const auto complain = [&](const std::string& words) {
      problems.push_back(fmt::format("{}: {}", bug.id.empty() ? "(no ID)" : bug.id, words));
    };
    if (bug.id.empty()) complain("'id' is missing");
    if (!ids.insert(bug.id).second) complain("another bug has the same ID");
    for (const auto& [name, value] : {std::pair{"title", bug.title},
                                      {"affects.product", bug.affects.product},
                                      {"affects.first", bug.affects.first},
                                      {"affects.last", bug.affects.last},
                                      {"clause", bug.clause},
                                      {"expected", bug.expected},
                                      {"captured", bug.captured},
                                      {"cause", bug.cause},
                                      {"real_programs", bug.real_programs},
                                      {"verified", bug.verified}})
      if (value.empty()) complain(fmt::format("'{}' is missing", name));
    if (bug.requirements.empty()) complain("'requirements' is empty");
    if (bug.program.empty() ? bug.crashes || !bug.signs.empty() : bug.crashes && !bug.signs.empty())
      complain("a bug with a program has either 'signs' or 'crashes', and a bug without one has neither");
    for (const RequirementId& id : bug.requirements)
      if (!catalogue().find(id)) complain(fmt::format("unknown requirement {}", id.text()));
    for (const BugSign& sign : bug.signs) {
      const std::string text = fmt::format("{}: {}: {}: {}: {}", sign.cause, sign.what, sign.expected,
                                           sign.captured, sign.relation);
      if (!signs.insert(bug.affects.product + ": " + text).second)
        complain(fmt::format("another bug has the sign '{}', too", text));
      if (!sign.relation.empty() && sign.relation != "more" && sign.relation != "less" &&
          sign.relation != "near")
        complain(fmt::format("unknown relation '{}'", sign.relation));
      for (const std::string& expression : {sign.what, sign.expected, sign.captured}) try {
          std::regex checked(expression);
        } catch (const std::regex_error& error) {
          complain(fmt::format("'{}' is not a regular expression: {}", expression, error.what()));
        }
    }
  }
  return problems;
}

std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c) {
  std::set<std::string> products;
  for (const KnownBug& bug : bugs) products.insert(bug.affects.product);
  std::string text = fmt::format(
      "# Known bugs\n\n"
      "Bugs in the evaluators of {}, one for each root cause. `evalcts run` calls a\n"
      "bug known if the program below fails in the same way in that run, or if a baseline names it. A known\n"
      "bug is still a failure; only a [baseline](baselines.md) excuses it. This page is generated from "
      "`suites/bugs/` by the target\n"
      "`known_bugs`.\n\n"
      "| bug | affects |\n| --- | --- |\n",
      fmt::join(products, " and "));
  for (const KnownBug& bug : bugs)
    text += fmt::format("| [{}](#{}) | {} |\n", bug.title, bug.id, bug.affects.text());
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    const KnownBug& bug = bugs[i];
    text += fmt::format("\n## {}\n\n{}.\n\n", bug.id, bug.title);
    const auto line = [&](const char* label, const std::string& words) {
      if (!words.empty()) text += fmt::format("* **{}**: {}\n", label, words);
    };
    line("Affects", bug.affects.text());
    line("Requirements", fmt::format("{}", fmt::join(texts_of(bug.requirements), ", ")));
    line("Clause", bug.clause);
    line("Expected", bug.expected);
    line("Instead", bug.captured);
    line(bug.suspected ? "Cause (suspected)" : "Cause", bug.cause);
    line("Real programs", bug.real_programs);
    line("Verified", bug.verified);
    if (i < programs_as_c.size() && !programs_as_c[i].empty())
      text += fmt::format("\n```c\n{}\n```\n", programs_as_c[i]);
  }
  return text;
}

}  // namespace evalcts
