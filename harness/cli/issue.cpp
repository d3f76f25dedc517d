// Writes issues for bug trackers.
#include "issue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <evalcts/fuzz/bugs.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/documents.h>
#include <evalcts/results/requirements.h>

namespace evalcts::cli {
namespace {

constexpr std::size_t kMostLines = 24;    // of a program in an issue
constexpr std::size_t kLongestLoop = 6;   // lines of the body of a loop
constexpr std::size_t kFewestRounds = 4;  // rounds of a loop
constexpr std::size_t kLongestLine = 400;

// Returns the shortest decimal that is the same number, as C writes it: "0.1f", "3.0".
std::string decimal(double value, bool single) {
  std::string text = single ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text + (single ? "f" : "");
}

// Replaces hexadecimal floating-point numbers, with the comments behind them, by decimal ones.
std::string in_decimal(std::string line) {
  for (std::size_t at = line.find("0x"); at != std::string::npos; at = line.find("0x", at + 1)) {
    char* after = nullptr;
    const double value = std::strtod(line.c_str() + at, &after);
    std::size_t end = static_cast<std::size_t>(after - line.c_str());
    if (line.substr(at, end - at).find('p') == std::string::npos) continue;  // a token
    const bool single = end < line.size() && line[end] == 'f';
    end += single;
    if (line.compare(end, 4, " /* ") == 0) end = line.find("*/", end) + 2;
    line.replace(at, end - at, decimal(value, single));
  }
  if (line.size() > kLongestLine) line = line.substr(0, kLongestLine) + " ... /* cut */";
  return line;
}

// Returns the text as a sentence.
std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

// Returns the number of times that the `length` lines at `begin` are repeated.
std::size_t rounds_at(const std::vector<std::string>& lines, std::size_t begin, std::size_t length) {
  std::size_t rounds = 1;
  while (begin + (rounds + 1) * length <= lines.size() &&
         std::equal(lines.begin() + static_cast<std::ptrdiff_t>(begin),
                    lines.begin() + static_cast<std::ptrdiff_t>(begin + length),
                    lines.begin() + static_cast<std::ptrdiff_t>(begin + rounds * length)))
    ++rounds;
  return rounds;
}

}  // namespace

std::vector<std::string> program_of(const KnownBug& bug) {
  return bug.programs.empty() ? bug.example
                              : fuzz::readable_calls(gl::parse_case(bug.programs.front().commands));
}

std::vector<std::string> short_program(const std::vector<std::string>& calls) {
  std::vector<std::string> lines, out;
  for (const std::string& call : calls) lines.push_back(in_decimal(call));
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t length = 1;
    while (length <= kLongestLoop && rounds_at(lines, i, length) < kFewestRounds) ++length;
    if (length > kLongestLoop) {
      out.push_back(lines[i++]);
      continue;
    }
    const std::size_t rounds = rounds_at(lines, i, length);
    out.push_back(fmt::format("for (int i = 0; i < {}; ++i){}", rounds, length > 1 ? " {" : ""));
    for (std::size_t k = 0; k < length; ++k) out.push_back("  " + lines[i + k]);
    if (length > 1) out.emplace_back("}");
    i += rounds * length;
  }
  if (out.size() <= kMostLines) return out;
  std::vector<std::string> cut(out.begin(), out.begin() + kMostLines / 2);
  cut.push_back(fmt::format("/* {} more lines, which the attached program has */", out.size() - kMostLines));
  cut.insert(cut.end(), out.end() - kMostLines / 2, out.end());
  return cut;
}

std::string in_plain_numbers(const std::string& expected) {
  double low = 0, high = 0;
  int end = 0;
  if (std::sscanf(expected.c_str(), "[%lf, %lf]%n", &low, &high, &end) != 2 ||
      end != static_cast<int>(expected.size()))
    return expected;
  const double middle = low / 2 + high / 2, half = high / 2 - low / 2;
  if (std::abs(middle) <= half && half < 1e-30) return "0";
  if (half == 0) return fmt::format("{:.9g}", middle);
  return fmt::format("{:.6g} +- {:.1g}", std::abs(middle) < half * 1e-3 ? 0.0 : middle, half);
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
  const std::vector<std::string> program = short_program(calls);
  if (!program.empty()) text += fmt::format("\n## Program\n\n```c\n{}\n```\n", fmt::join(program, "\n"));
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
