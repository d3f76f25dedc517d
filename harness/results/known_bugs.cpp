// Reads the known bugs from JSON that is compiled in, finds a bug by its ID, checks all of them,
// and lists them as Markdown.
#include <evalcts/results/known_bugs.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <evalcts/results/json_object.h>
#include <evalcts/results/requirements.h>
#include "known_bugs_data.h"  // kKnownBugs, kKnownSignatures

namespace evalcts {
namespace {

using nlohmann::json;

// The implementations whose evaluators are those of the product that GL_VERSION names.
const std::set<std::string> kWithOwnEvaluators = {"osmesa", "egl", "glx", "glx-indirect"};

FailingTests read_failing_tests(const JsonObject& in) {
  FailingTests out;
  out.scope.renderer = in.text("renderer");
  out.scope.version = VersionRange(in.text("version"));
  out.scope.implementations = in.texts("implementations");
  if (in.has("status")) out.status = in.text("status");
  out.tests = in.texts("tests");
  return out;
}

KnownBug read_known_bug(const JsonObject& in) {
  KnownBug out;
  out.id = in.text("id");
  out.title = in.text("title");
  out.component = in.text("component");
  if (const auto affects = in.object("affects"))
    out.affects = {affects->text("product"),  affects->text("first"),  affects->text("last"),
                   affects->text("renderer"), affects->text("server"), affects->texts("tested"),
                   affects->texts("without")};
  const std::vector<std::string> requirements = in.texts("requirements");
  out.requirements = {requirements.begin(), requirements.end()};
  out.clause = in.text("clause");
  if (const auto quote = in.object("quote")) out.quote = {quote->text("text"), quote->text("source")};
  out.expected = in.text("expected");
  out.captured = in.text("captured");
  out.cause = in.text("cause");
  out.outside_evaluators = in.boolean("outside_evaluators");
  out.suspected = in.boolean("suspected");
  out.real_programs = in.text("real_programs");
  out.verified = in.text("verified");
  out.example = in.texts("example");
  out.fails = in.text("fails");
  out.context = in.text("context");
  FailingTests of_programs;
  in.each_object("programs", [&](const JsonObject& program) {
    BugProgram& added = out.programs.emplace_back();
    added.name = program.text("name");
    added.requirement = program.text("requirement");
    added.difference = program.word("difference", parse_difference).value_or(Difference());
    added.captured = program.text("captured");
    added.commands = program.json_text("commands");
    if (!added.name.empty()) of_programs.tests.push_back("Findings." + added.name);
  });
  if (out.dies())
    of_programs.status = out.programs.front().difference.kind == Difference::kHang ? "Timeout" : "Crash";
  if (!of_programs.tests.empty()) out.tests.push_back(of_programs);
  in.each_object("tests", [&](const JsonObject& tests) { out.tests.push_back(read_failing_tests(tests)); });
  return out;
}

}  // namespace

std::string AffectedVersions::text() const {
  return fmt::format("{}{} {}{}{}", server.empty() ? "" : server + " with clients of ", product, first,
                     first == last ? "" : " to " + last, renderer.empty() ? "" : " with " + renderer);
}

std::string AffectedVersions::tested_text() const {
  const auto list = [](const std::vector<std::string>& versions) {
    return versions.size() < 2
               ? fmt::format("{}", fmt::join(versions, ""))
               : fmt::format("{} and {}", fmt::join(versions.begin(), versions.end() - 1, ", "),
                             versions.back());
  };
  if (!server.empty()) return fmt::format("with clients of {} {}", product, list(tested));
  std::string text = fmt::format("{} {} the bug", list(tested), tested.size() == 1 ? "has" : "have");
  if (!without.empty())
    text += fmt::format(", {} {} not", list(without), without.size() == 1 ? "does" : "do");
  return text;
}

bool AffectedVersions::may_contain(const ImplementationRecord& implementation) const {
  return kWithOwnEvaluators.contains(implementation.kind) &&
         implementation.renderer.find(renderer) != std::string::npos &&
         VersionRange(fmt::format("{} {} or newer", product, first)).contains(implementation.version);
}

bool KnownBug::dies() const { return !programs.empty() && programs.front().difference.is_death(); }

Quote KnownBug::quoted_rule() const {
  if (!quote.text.empty() || outside_evaluators || requirements.empty()) return quote;
  const Requirement* const rule = catalogue().find(requirements.front());
  return rule ? rule->quote : quote;
}

std::vector<KnownBug> parse_known_bugs(const std::string& text) {
  const json data = parse_json(text);
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

const std::set<std::string>& known_signatures(const std::string& product, const std::string& function) {
  static const auto kAll = [] {
    std::map<std::pair<std::string, std::string>, std::set<std::string>> all;
    const json data = parse_json(kKnownSignatures);
    for (const auto& [of_product, functions] : data.items())
      for (const auto& [name, texts] : functions.items()) {
        std::istringstream words(texts.get<std::string>());
        for (std::string word; words >> word;) all[{of_product, name}].insert(word);
      }
    return all;
  }();
  static const std::set<std::string> kNone;
  const auto found = kAll.find({product, function});
  return found == kAll.end() ? kNone : found->second;
}

const KnownBug* find_known_bug(const std::string& id) {
  const auto found = std::ranges::find(known_bugs(), id, &KnownBug::id);
  return found == known_bugs().end() ? nullptr : &*found;
}

std::vector<std::string> lint(const std::vector<KnownBug>& bugs) {
  std::vector<std::string> problems;
  static const std::set<std::string> kStatuses = {"Fail", "Crash", "Timeout", "Flaky", "Skip"};
  std::set<std::string> ids, programs;
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
    const auto& tested = bug.affects.tested;
    if (tested.empty() || !tested.front().starts_with(bug.affects.first) ||
        !tested.back().starts_with(bug.affects.last))
      complain("'affects.tested' does not go from 'first' to 'last'");
    if (!bug.context.empty() && bug.context != KnownBug::kCoreProfile &&
        bug.context != KnownBug::kIndirectGlx)
      complain(fmt::format("unknown context '{}'", bug.context));
    if (bug.requirements.empty()) complain("'requirements' is empty");
    for (const RequirementId& id : bug.requirements)
      if (!catalogue().find(id)) complain(fmt::format("unknown requirement {}", id.text()));
    for (const BugProgram& program : bug.programs) {
      const std::string name = program.name.empty() ? "a program" : program.name;
      if (program.difference.kind.empty()) complain(fmt::format("'difference' of {} is missing", name));
      if (program.commands.empty()) complain(fmt::format("'commands' of {} is missing", name));
      if (program.name.empty()) continue;
      if (!programs.insert(name).second)
        complain(fmt::format("another program has the name '{}', too", name));
      if (!catalogue().find(program.requirement))
        complain(fmt::format("unknown requirement {} of {}", program.requirement, name));
    }
    if (bug.tests.empty()) complain("'tests' is empty");
    for (const FailingTests& failing : bug.tests)
      if (!kStatuses.contains(failing.status))
        complain(fmt::format("unknown status '{}' of tests", failing.status));
  }
  return problems;
}

std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c) {
  std::set<std::string> products;
  for (const KnownBug& bug : bugs) products.insert(bug.affects.product);
  std::string text = fmt::format(
      "# Known bugs\n\n"
      "Bugs that make tests of evaluators fail with {}, one for each root cause. `evalcts run`\n"
      "calls a bug known if one of its programs fails in the same way in that run (a bug without a program: "
      "if "
      "a\n"
      "failing test is one of those that the register lists for it). The failures of known bugs are expected "
      "(see "
      "[Baselines](baselines.md)). This page is\n"
      "generated from `suites/bugs/` by the target `known_bugs`.\n\n"
      "| bug | affects |\n| --- | --- |\n",
      fmt::join(products, " and "));
  for (const KnownBug& bug : bugs)
    text += fmt::format("| [{}](#{}){} | {} |\n", bug.title, bug.id,
                        bug.outside_evaluators ? ", not in the evaluators" : "", bug.affects.text());
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    const KnownBug& bug = bugs[i];
    text += fmt::format("\n## {}\n\n{}.\n\n", bug.id, bug.title);
    const auto line = [&](const char* label, const std::string& words) {
      if (!words.empty()) text += fmt::format("* **{}**: {}\n", label, words);
    };
    line("Affects", bug.affects.text());
    line("Tested", bug.affects.tested_text());
    line("Requirements", fmt::format("{}", fmt::join(texts_of(bug.requirements), ", ")));
    line("Clause", bug.clause);
    line("Quotation", text_of(bug.quoted_rule()));
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
