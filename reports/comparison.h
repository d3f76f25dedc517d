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
  kRegression,      // bad now; before not bad, or less bad, or not in all cases that fail now
  kNewFailure,      // bad now; the test did not exist before
  kFix,             // bad before, not bad now
  kNoLongerJudged,  // judged before; now not observable, not supported or skipped
  kFailsOtherwise,  // bad before and now, differently, but no regression
  kOther,           // another verdict, none of the above
  kNew,             // not bad now; the test did not exist before
  kVanished         // the test no longer exists
};
inline constexpr std::size_t kChangeKinds = 8;

// Texts for a kind: a word for it ("regression"), the noun in singular and plural, the word of its filter
// ("regression", "fix", "changed", "new", or empty for a vanished test), and the nouns for a comparison of
// two implementations, in which nothing is earlier ("worse test").
struct ChangeText {
  std::string_view word, one, several, filter, difference, differences;
};
const ChangeText& text_of(ChangeKind kind);

struct Change {
  ChangeKind kind;
  const TestRecord* before;  // null if the test is new
  const TestRecord* now;     // null if it has vanished
};

// Returns the first of the recorded mismatches of `now` that `before` does not have; empty if there is none.
std::string further_mismatch(const TestRecord& before, const TestRecord& now);

// Returns "pass, now fail: message of the test", or for a test on one side only its verdict and message.
std::string words_of(const Change& change);

struct Comparison {
  std::string label;
  const RunResult *before, *now;
  bool no_longer_starts = false;        // counts as a regression
  std::vector<std::string> caveats;     // sentences about what makes the two less comparable
  std::vector<Change> changes;          // sorted by kind, within a kind in the order of the tests
  bool of_two_implementations = false;  // chooses the words of the headline

  std::uint64_t count(ChangeKind kind) const;
  std::uint64_t regressions() const { return count(ChangeKind::kRegression) + (no_longer_starts ? 1 : 0); }
  // Returns "2 regressions, 1 fix, 3 new tests" or "nothing has changed"; for two implementations "2 worse
  // tests, 1 better test" or "no difference".
  std::string headline() const;
};

// Compares two records, whatever their names are. The comparison gets the label of `now` and points into the
// records.
Comparison compare(const Column& now, const Column& before);

struct Comparisons {
  std::vector<Comparison> pairs;                   // in the order of the results
  std::vector<std::string> only_now, only_before;  // labels of the records that are in no pair
  std::uint64_t regressions() const;
};

// Compares the records of the same name, the first with the first, the second with the second and so on; if
// there is one record on each side, these two whatever their names are. The result points into the records.
Comparisons compare(const std::vector<Column>& now, const std::vector<Column>& before);

}  // namespace evalcts::reports
