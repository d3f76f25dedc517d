// The tables of verdicts and levels.
#include <evalcts/results/verdict.h>

#include <algorithm>
#include <array>

namespace evalcts {
namespace {

constexpr std::array<VerdictText, kVerdicts> kVerdictTexts{{
    {"internal-error", "internal-error", "!",
     "an error of evalcts itself; says nothing about the implementation"},
    {"crash", "crash", "‼", "the process died while this test ran"},
    {"timeout", "timeout", "◷", "no end within the time limit"},
    {"fail", "fail", "✗", "something observed contradicts the requirement"},
    {"quality-warning", "quality-warning", "△",
     "falls short of what good implementations do; other tests decide whether it conforms"},
    {"not-observable", "not observed", "◌",
     "nothing that the implementation offers shows the effect reliably; this is never a pass"},
    {"not-supported", "not-supported", "∅", "the implementation does not offer what the test needs"},
    {"skipped", "skipped", "–", "not run, because a baseline or an option excludes the test"},
    {"pass", "pass", "✓", "everything observed agrees with the requirement"},
}};

constexpr std::array kLevelNames{"quality", "interpretation", "must"};

}  // namespace

const VerdictText& text_of(Verdict verdict) { return kVerdictTexts[static_cast<std::size_t>(verdict)]; }

std::optional<Verdict> verdict_named(std::string_view word) {
  const auto found = std::ranges::find(kVerdictTexts, word, &VerdictText::word);
  if (found == kVerdictTexts.end()) return std::nullopt;
  return static_cast<Verdict>(found - kVerdictTexts.begin());
}

const char* name_of(Level level) { return kLevelNames[static_cast<std::size_t>(level)]; }

std::optional<Level> level_named(std::string_view word) {
  const auto found = std::ranges::find(kLevelNames, word);
  if (found == kLevelNames.end()) return std::nullopt;
  return static_cast<Level>(found - kLevelNames.begin());
}

}  // namespace evalcts
