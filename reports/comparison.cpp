// Compares current with earlier results, test by test, and classifies the changes.
#include "comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>

#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::array<ChangeText, kChangeKinds> kChangeTexts{{
    {"regression", "regression", "regressions", "regression", "worse test", "worse tests"},
    {"new failure", "new failing test", "new failing tests", "new", "failing test of the second only",
     "failing tests of the second only"},
    {"fix", "fix", "fixes", "fix", "better test", "better tests"},
    {"no longer judged", "test no longer judged", "tests no longer judged", "changed",
     "test judged in the first only", "tests judged in the first only"},
    {"fails differently", "test that fails differently", "tests that fail differently", "changed",
     "test that fails differently", "tests that fail differently"},
    {"other change", "other change", "other changes", "changed", "other difference", "other differences"},
    {"new test", "new test", "new tests", "new", "test of the second only", "tests of the second only"},
    {"vanished", "vanished test", "vanished tests", "", "test of the first only", "tests of the first only"},
}};

bool judged(const TestRecord& test) {
  return test.verdict <= Verdict::kQualityWarning || test.verdict == Verdict::kPass;
}

// Returns true if the same cases were run: they depend on the depth and the seed.
bool same_cases(const RunResult& before, const RunResult& now) {
  return before.depth == now.depth && before.seed == now.seed;
}

// Returns the kind of change of a test that both records have; none if it has not changed.
std::optional<ChangeKind> change_of(const TestRecord& before, const TestRecord& now, bool cases_comparable) {
  if (now.is_bad()) {
    if (!before.is_bad() || now.verdict < before.verdict) return ChangeKind::kRegression;
    const bool comparable = cases_comparable && !before.mismatches.empty() && !now.mismatches.empty();
    if (comparable && !further_mismatch(before, now).empty()) return ChangeKind::kRegression;
    if (before.verdict != now.verdict || (comparable && before.signature() != now.signature()))
      return ChangeKind::kFailsOtherwise;
    return std::nullopt;
  }
  if (judged(before) && !judged(now)) return ChangeKind::kNoLongerJudged;
  if (before.is_bad()) return ChangeKind::kFix;
  return before.verdict == now.verdict ? std::nullopt : std::optional(ChangeKind::kOther);
}

}  // namespace

const ChangeText& text_of(ChangeKind kind) { return kChangeTexts[static_cast<std::size_t>(kind)]; }

std::string further_mismatch(const TestRecord& before, const TestRecord& now) {
  // The mismatches of `before` behind the last recorded one are not known.
  const auto end = before.signature_of_all.empty() || before.mismatches.empty()
                       ? now.mismatches.end()
                       : std::ranges::upper_bound(now.mismatches, before.mismatches.back());
  std::vector<std::string> further;
  std::set_difference(now.mismatches.begin(), end, before.mismatches.begin(), before.mismatches.end(),
                      std::back_inserter(further));
  return further.empty() ? "" : further.front();
}

std::string words_of(const Change& change) {
  const TestRecord& latest = change.now ? *change.now : *change.before;
  const std::string word(text_of(latest.verdict).label);
  const bool both = change.now && change.before;
  if (both && change.kind == ChangeKind::kRegression && change.now->verdict == change.before->verdict)
    return fmt::format("{}, in more cases: {}", word,
                       one_line(further_mismatch(*change.before, *change.now)));
  const std::string message = latest.message.empty() ? "" : ": " + one_line(latest.message);
  if (both && change.now->verdict != change.before->verdict)
    return fmt::format("{}, now {}{}", text_of(change.before->verdict).label, word, message);
  return word + message;
}

std::uint64_t Comparison::count(ChangeKind kind) const {
  return static_cast<std::uint64_t>(std::count_if(
      changes.begin(), changes.end(), [kind](const Change& change) { return change.kind == kind; }));
}

std::string Comparison::headline() const {
  std::vector<std::string> parts;
  if (no_longer_starts) parts.emplace_back("no longer starts");
  for (std::size_t i = 0; i < kChangeKinds; ++i) {
    const auto kind = static_cast<ChangeKind>(i);
    const ChangeText& text = text_of(kind);
    const std::string_view one = of_two_implementations ? text.difference : text.one;
    const std::string_view several = of_two_implementations ? text.differences : text.several;
    if (const std::uint64_t n = count(kind)) parts.push_back(fmt::format("{} {}", n, n == 1 ? one : several));
  }
  if (!parts.empty()) return join(parts, ", ");
  return of_two_implementations ? "no difference" : "nothing has changed";
}

std::uint64_t Comparisons::regressions() const {
  return std::accumulate(pairs.begin(), pairs.end(), std::uint64_t{0},
                         [](std::uint64_t n, const Comparison& pair) { return n + pair.regressions(); });
}

Comparison compare(const Column& now, const Column& before) {
  Comparison out{now.label, &before.record, &now.record, false, {}, {}};
  const RunResult &old_record = before.record, &new_record = now.record;
  out.no_longer_starts = !new_record.has_started() && old_record.has_started();
  const auto caveat = [&out](const std::string& words) { out.caveats.push_back(words); };
  if (out.no_longer_starts) caveat("It no longer starts: " + one_line(new_record.reason));
  if (!out.no_longer_starts && !new_record.is_complete()) caveat("The run is not complete.");
  if (!old_record.is_complete()) caveat("The earlier run is not complete.");
  if (old_record.depth != new_record.depth && old_record.depth && new_record.depth)
    caveat(fmt::format("The depths differ: {}, before {}.", name_of(*new_record.depth),
                       name_of(*old_record.depth)));
  else if (old_record.seed != new_record.seed && old_record.seed && new_record.seed)
    caveat(fmt::format("The seeds differ: {}, before {}.", *new_record.seed, *old_record.seed));

  const bool cases_comparable = same_cases(old_record, new_record);
  std::map<std::string, const TestRecord*> earlier;
  for (const TestRecord& test : old_record.tests) earlier[test.name] = &test;
  for (const TestRecord& test : new_record.tests) {
    const auto found = earlier.find(test.name);
    if (found == earlier.end()) {
      out.changes.push_back({test.is_bad() ? ChangeKind::kNewFailure : ChangeKind::kNew, nullptr, &test});
      continue;
    }
    if (const auto kind = change_of(*found->second, test, cases_comparable))
      out.changes.push_back({*kind, found->second, &test});
    found->second = nullptr;
  }
  if (!out.no_longer_starts)
    for (const TestRecord& test : old_record.tests)
      if (earlier[test.name]) out.changes.push_back({ChangeKind::kVanished, &test, nullptr});
  std::stable_sort(out.changes.begin(), out.changes.end(),
                   [](const Change& a, const Change& b) { return a.kind < b.kind; });
  return out;
}

Comparisons compare(const std::vector<Column>& now, const std::vector<Column>& before) {
  Comparisons out;
  if (before.empty()) return out;
  if (now.size() == 1 && before.size() == 1) {
    out.pairs.push_back(compare(now[0], before[0]));
    return out;
  }
  std::vector<bool> used(before.size());
  for (const Column& column : now) {
    const std::string name = column.record.heading("");
    std::size_t i = 0;
    while (i < before.size() && (used[i] || before[i].record.heading("") != name)) ++i;
    if (i == before.size()) {
      out.only_now.push_back(column.label);
      continue;
    }
    used[i] = true;
    out.pairs.push_back(compare(column, before[i]));
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!used[i]) out.only_before.push_back(before[i].label);
  return out;
}

}  // namespace evalcts::reports
