// Writes the changes since earlier results for a terminal.
#include <fmt/format.h>

#include "comparison.h"
#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::uint64_t kMostOfAKind = 8;

}  // namespace

Changes changes(const std::vector<RunResult>& results, const std::vector<RunResult>& before,
                std::size_t columns) {
  const std::vector<Column> now = label_columns(results), earlier = label_columns(before);
  const Comparisons comparisons = compare(now, earlier);
  std::string out;
  const auto line = [&](const std::string& text) {
    out += (columns > 3 ? cut(one_line(text), columns) : one_line(text)) + "\n";
  };
  for (const Comparison& pair : comparisons.pairs) {
    line(fmt::format("{} since the earlier results: {}", pair.label, pair.headline()));
    for (const std::string& caveat : pair.caveats) line("  " + caveat);
    std::uint64_t told = 0;
    for (std::size_t i = 0; i < pair.changes.size(); ++i) {
      const Change& change = pair.changes[i];
      told = i > 0 && pair.changes[i - 1].kind == change.kind ? told + 1 : 1;
      if (told <= kMostOfAKind)
        line(fmt::format("  {:<16} {} ({})", text_of(change.kind).word,
                         (change.now ? change.now : change.before)->name, words_of(change)));
      if (told == kMostOfAKind + 1)
        line(fmt::format("  {:<16} and {} more; index.html shows all", "",
                         pair.count(change.kind) - kMostOfAKind));
    }
  }
  for (const std::string& label : comparisons.only_now) line(label + ": not in the earlier results");
  for (const std::string& label : comparisons.only_before) line(label + ": only in the earlier results");
  return {out, comparisons.regressions()};
}

}  // namespace evalcts::reports
