// Changes since earlier results.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "side_by_side.h"

namespace evalcts::reports {

// Kinds of changes, in the order of reporting.
enum class ChangeKind {
  kRegression,      // bad now, and before it was not, or not as bad, or not in all these cases
  kNewFailure,      // bad, and there was no such test
  kFix,             // bad before, and now it is not
  kNoLongerJudged,  // judged before, and now not observable, not supported or skipped
  kFailsOtherwise,  // bad before and now, but no worse
  kOther,           // between pass and quality-warning, or judged for the first time
  kNew,
  kVanished
};
inline constexpr std::size_t kChangeKinds = 8;

// The kind in a word ("regression"), what one and several of it are called, and the word of its filter:
// "regression", "fix", "changed", "new", and empty for what has vanished.
struct ChangeText {
  std::string_view word, one, several, filter;
};
const ChangeText& text_of(ChangeKind kind);

struct Change {
  ChangeKind kind;
  const TestRecord* before;  // null where the test is new
  const TestRecord* now;     // null where it has vanished
};

// The first thing that is wrong now and was not before, as far as the records tell; empty if there is none.
std::string further_mismatch(const TestRecord& before, const TestRecord& now);

// "pass, now fail: what the record says"; of a test that is on one side only, its verdict there.
std::string words_of(const Change& change);

struct Comparison {
  std::string label;
  const RunResult *before, *now;
  bool no_longer_starts = false;     // counts as a regression
  std::vector<std::string> caveats;  // sentences: what makes the two less comparable
  std::vector<Change> changes;       // by kind, those of a kind in the order of the tests

  std::uint64_t count(ChangeKind kind) const;
  std::uint64_t regressions() const { return count(ChangeKind::kRegression) + (no_longer_starts ? 1 : 0); }
  // "2 regressions, 1 fix, 3 new tests", "nothing has changed".
  std::string headline() const;
};

// Compares two records, whatever they are called; `label` is that of `now`.
Comparison compare(const Column& now, const Column& before);

struct Comparisons {
  std::vector<Comparison> pairs;                   // in the order of the results
  std::vector<std::string> only_now, only_before;  // labels of records without a counterpart
  std::uint64_t regressions() const;
};

// Compares the records of one name, the first with the first, the second with the second and so on; a single
// record on either side with the other whatever they are called. They point into the columns.
Comparisons compare(const std::vector<Column>& now, const std::vector<Column>& before);

}  // namespace evalcts::reports
