// Writes issues for bug trackers.
#include "issue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/documents.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {
namespace {

// Returns the text as a sentence. A first word with an underscore or a capital inside, such as save_Map1f or
// libGL, is a name and stays as it is.
std::string sentence(std::string text) {
  const std::string word = text.substr(0, text.find(' '));
  const bool is_name = std::ranges::any_of(word, [](unsigned char c) { return c == '_' || std::isupper(c); });
  if (!text.empty() && !is_name)
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

bool uses_evaluators(const std::string& call) {
  return std::ranges::any_of(std::array{"Eval", "GL_MAP1_", "GL_MAP2_", "GL_AUTO_NORMAL"},
                             [&](const char* word) { return call.find(word) != std::string::npos; });
}

// Returns the variable that chooses the driver of a bug of Mesa; empty if every driver has the bug, or if
// Mesa chooses the driver by itself on a machine without a GPU.
std::string gallium_driver(const KnownBug& bug) {
  const std::string& renderer = bug.affects.renderer;
  return renderer.empty() || renderer == "llvmpipe" ? "" : "GALLIUM_DRIVER=" + renderer;
}

// Returns the section with the rule, which may be null, and the quotation, which may be empty. `clause`:
// where the documents state the rule.
std::string rule_text(const Requirement* rule, const Quote& quote, const std::string& clause) {
  if (!rule && quote.text.empty()) return "";
  std::string text = "\n## Rule\n";
  if (rule) text += fmt::format("\n{} ({})\n", rule->text, clause);
  if (!quote.text.empty()) text += fmt::format("\n> {}\n\n({})\n", quote.text, quote.source);
  for (const Document& document : documents_in(clause + "; " + quote.source))
    text += fmt::format("\n* [{}]({})", document.name, document.address);
  return text + "\n";
}

}  // namespace

std::vector<std::string> program_of(const KnownBug& bug) {
  if (!bug.example.empty() || bug.programs.empty()) return bug.example;
  return gl::program_of(gl::parse_case(bug.programs.front().commands));
}

std::string issue_text(const RunResult* run, const Bug* bug, const KnownBug* known,
                       const std::vector<std::string>& calls) {
  const bool is_outside = known ? known->outside_evaluators : bug->outside_evaluators;
  const std::string component = known && !known->component.empty() ? known->component : "OpenGL evaluators",
                    prefix = is_outside && !known ? "" : component + ": ";
  std::string text = fmt::format("# {}{}\n\n", prefix, known ? known->title : bug->title);
  if (known)
    text += fmt::format("Affected: {}. Tested: {}.\n", known->affects.text(), known->affects.tested_text());
  if (run && bug)
    text += fmt::format("Observed with: {} ({}, {}).\n", run->implementation.version,
                        run->implementation.renderer, run->implementation.vendor);
  const std::string driver = known ? gallium_driver(*known) : "";
  if (!calls.empty()) {
    text += fmt::format("\n## Program\n\n```c\n{}\n```\n", fmt::join(calls, "\n"));
    if (is_outside && std::ranges::none_of(calls, uses_evaluators))
      text += "\nThe program uses no evaluators.\n";
    if (!driver.empty()) text += fmt::format("\nThe driver is chosen by `{}`.\n", driver);
    if (known && known->context == KnownBug::kIndirectGlx)
      text += "\nIt needs an indirect context, of an X server that was started with `+iglx`.\n";
  }
  if (bug)
    text += fmt::format(
        "\n`evalcts reproduce {}` writes a complete C program, to be attached, which prints the result.\n",
        known ? known->id : bug->id);
  const std::string expected = known ? known->expected : in_plain_numbers(bug->failure.expected);
  const std::string observed = known ? known->captured : in_plain_numbers(bug->failure.captured);
  const std::string subject = known || bug->failure.what.empty() ? "" : bug->failure.what + ": ";
  if (!expected.empty() || !observed.empty())
    text += fmt::format("\n* Expected: {}{}\n* Observed: {}{}\n", subject, expected, subject, observed);
  else if (bug)
    text += fmt::format("\n{}\n", bug->failure.message);

  const std::vector<RequirementId>& requirements = known ? known->requirements : bug->requirements;
  const Requirement* const rule =
      is_outside || requirements.empty() ? nullptr : catalogue().find(requirements.front());
  text += rule_text(rule,
                    known  ? known->quoted_rule()
                    : rule ? rule->quote
                           : Quote(),
                    known && !is_outside ? known->clause
                    : rule               ? rule->source
                                         : "");
  if (known && !known->cause.empty())
    text += fmt::format("\n## {}\n\n{}\n", known->suspected ? "Analysis" : "Cause", sentence(known->cause));
  if (known && !known->real_programs.empty())
    text += fmt::format("\n## Effect on real programs\n\n{}\n", sentence(known->real_programs));
  text += "\n## Verification\n\nFound by evalcts, a conformance test suite for OpenGL evaluators";
  if (bug)
    text += bug->tests.size() == 1
                ? ": 1 of its tests fails because of this bug"
                : fmt::format(": {} of its tests fail because of this bug", bug->tests.size());
  text += ".\n";
  if (known && !known->verified.empty()) text += sentence(known->verified) + "\n";
  if (known && !calls.empty() && known->affects.product != "Mesa")
    text += fmt::format("`evalcts check {}` has exit code 1 while a driver has the bug, and 0 without it.\n",
                        known->id);
  else if (known && !calls.empty() && known->context != KnownBug::kIndirectGlx)
    text += fmt::format(
        "\n```sh\ngit bisect run sh -c 'ninja -C build || exit 125; {}evalcts check {} --mesa-build "
        "build'\n```\n",
        driver.empty() ? "" : driver + " ", known->id);
  if (run && bug && !run->implementation.files.empty())
    text += fmt::format("\nLoaded files: {}.\n", fmt::join(run->implementation.files, ", "));
  return text;
}

}  // namespace evalcts::cli
