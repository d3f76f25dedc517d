// Writes issues for bug trackers.
#include "issue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/documents.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {
namespace {

// Returns the text as a sentence.
std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

}  // namespace

std::vector<std::string> program_of(const KnownBug& bug) {
  return bug.programs.empty() ? bug.example : gl::program_of(gl::parse_case(bug.programs.front().commands));
}

std::string issue_text(const RunResult* run, const Bug* bug, const KnownBug* known,
                       const std::vector<std::string>& calls) {
  std::string text = fmt::format("# OpenGL evaluators: {}\n\n", known ? known->title : bug->title);
  if (known) text += fmt::format("Affected: {}.\n", known->affects.text());
  if (run && bug) {
    const ImplementationRecord& implementation = run->implementation;
    text += fmt::format("Observed with: {} ({}, {})", implementation.version, implementation.renderer,
                        implementation.vendor);
    if (!implementation.files.empty())
      text += fmt::format(", loaded from {}", fmt::join(implementation.files, ", "));
    text += ".\n";
  }
  if (!calls.empty()) text += fmt::format("\n## Program\n\n```c\n{}\n```\n", fmt::join(calls, "\n"));
  const std::string expected = known ? known->expected : in_plain_numbers(bug->failure.expected);
  const std::string observed = known ? known->captured : in_plain_numbers(bug->failure.captured);
  const std::string what = known || bug->failure.what.empty() ? "" : bug->failure.what + ": ";
  if (!expected.empty() || !observed.empty())
    text += fmt::format("\n* Expected: {}{}\n* Observed: {}{}\n", what, expected, what, observed);
  else if (bug)
    text += fmt::format("\n{}\n", bug->failure.message);

  text += "\n## Rule\n";
  const std::vector<RequirementId>& requirements = known ? known->requirements : bug->requirements;
  for (const RequirementId& id : requirements)
    if (const Requirement* const requirement = catalogue().find(id)) {
      const std::string& clause = known ? known->clause : requirement->source;
      text += fmt::format("\n> {} ({})\n", requirement->text, clause);
      for (const Document& document : documents_in(clause))
        text += fmt::format("\n* [{}]({})", document.name, document.address);
      text += "\n";
      break;  // the decisive one is first
    }
  if (known && !known->cause.empty())
    text += fmt::format("\n## {}\n\n{}.\n", known->suspected ? "Suspected cause" : "Cause", known->cause);
  if (known && !known->real_programs.empty())
    text += fmt::format("\n## Effect on real programs\n\n{}\n", sentence(known->real_programs));
  text += "\n## How it was found\n\n";
  text += "By evalcts, a conformance test suite for OpenGL evaluators";
  if (bug) text += fmt::format(": {} of its tests fail because of this", bug->tests.size());
  if (known && !known->verified.empty()) text += fmt::format(". Verified: {}", known->verified);
  text += ".\n";
  if (known)
    text += fmt::format(
        "`evalcts check {} --library FILE` has exit code 1 while a library has the bug, and 0 without it.\n",
        known->id);
  if (bug)
    text += fmt::format("`evalcts reproduce {}` writes a stand-alone C program, to be attached.\n", bug->id);
  return text;
}

}  // namespace evalcts::cli
