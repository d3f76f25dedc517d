// Reads the known bugs from JSON that is compiled in, finds a bug by its ID or its sign, checks all of them,
// and lists them as Markdown.
#include <evalcts/results/known_bugs.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
  out.product = in.text("product");
  out.affects = in.texts("affects");
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
  out.signs = in.texts("signs");
  return out;
}

}  // namespace

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

const KnownBug* known_bug_with_sign(const std::string& cause, const ImplementationRecord& implementation) {
  const auto is_of = [&](const std::string& product) {
    return std::ranges::any_of(
        std::initializer_list<const std::string*>{&implementation.vendor, &implementation.renderer,
                                                  &implementation.version},
        [&](const std::string* text) { return text->find(product) != std::string::npos; });
  };
  for (const KnownBug& bug : known_bugs())
    if (std::ranges::count(bug.signs, cause) > 0 && is_of(bug.product)) return &bug;
  return nullptr;
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
                                      {"product", bug.product},
                                      {"clause", bug.clause},
                                      {"expected", bug.expected},
                                      {"captured", bug.captured},
                                      {"cause", bug.cause},
                                      {"real_programs", bug.real_programs},
                                      {"verified", bug.verified}})
      if (value.empty()) complain(fmt::format("'{}' is missing", name));
    if (bug.affects.empty()) complain("'affects' is empty");
    if (bug.requirements.empty()) complain("'requirements' is empty");
    if (bug.signs.empty()) complain("'signs' is empty");
    for (const RequirementId& id : bug.requirements)
      if (!catalogue().find(id)) complain(fmt::format("unknown requirement {}", id.text()));
    for (const std::string& sign : bug.signs)
      if (!signs.insert(bug.product + ": " + sign).second)
        complain(fmt::format("another bug has the sign '{}', too", sign));
  }
  return problems;
}

std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c) {
  std::set<std::string> products;
  for (const KnownBug& bug : bugs) products.insert(bug.product);
  std::string text = fmt::format(
      "# Known bugs\n\n"
      "Bugs in the evaluators of {}, one for each root cause. `evalcts run` labels\n"
      "failures that match one of them, and `evalcts bugs` lists them. A known bug is still a failure; only\n"
      "a [baseline](baselines.md) excuses it. This page is generated from `suites/bugs/` by the target\n"
      "`known_bugs`.\n\n"
      "| bug | affects |\n| --- | --- |\n",
      fmt::join(products, " and "));
  const auto join = [](const std::vector<std::string>& parts) {
    std::string joined;
    for (const std::string& part : parts) joined += (joined.empty() ? "" : ", ") + part;
    return joined;
  };
  for (const KnownBug& bug : bugs)
    text += fmt::format("| [{}](#{}) | {} |\n", bug.title, bug.id, join(bug.affects));
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    const KnownBug& bug = bugs[i];
    text += fmt::format("\n## {}\n\n{}.\n\n", bug.id, bug.title);
    const auto line = [&](const char* label, const std::string& words) {
      if (!words.empty()) text += fmt::format("* **{}**: {}\n", label, words);
    };
    line("Affects", join(bug.affects));
    line("Requirements", join(texts_of(bug.requirements)));
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
