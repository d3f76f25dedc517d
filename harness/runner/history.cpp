// Finds how many preceding tests are needed by doubling and bisection, then removes unnecessary tests by
// delta debugging.
#include "history.h"

#include <algorithm>

#include <evalcts/runner/delta_debugging.h>

namespace evalcts {
namespace {

using Tests = std::vector<std::string>;

Tests last(const Tests& tests, std::size_t count) {
  return {tests.end() - static_cast<std::ptrdiff_t>(count), tests.end()};
}

History without_needless(Tests tests, const HappensAfter& happens_after) {
  bool is_in_time = true;
  const auto still_happens = [&](const Tests& rest) {
    if (!is_in_time || rest.empty()) return false;  // the failure does not happen if its test runs alone
    const std::optional<bool> happens = happens_after(rest);
    is_in_time = happens.has_value();
    return happens.value_or(false);
  };
  bool may_be_shorter = reduce(tests, Direction::kForwards, still_happens);
  while (may_be_shorter) may_be_shorter = remove_runs(tests, 1, Direction::kForwards, still_happens);
  return {is_in_time ? History::Quality::kShortest : History::Quality::kShortened, tests};
}

}  // namespace

std::optional<std::size_t> least(std::size_t most,
                                 const std::function<std::optional<bool>(std::size_t)>& happens) {
  std::size_t too_few = 0;
  while (most - too_few > 1) {
    const std::size_t middle = too_few + (most - too_few) / 2;
    const std::optional<bool> there = happens(middle);
    if (!there) return std::nullopt;
    (*there ? most : too_few) = middle;
  }
  return most;
}

History shortest_history(const Tests& predecessors, const Tests& first_guess,
                         const HappensAfter& happens_after) {
  if (!first_guess.empty()) {
    const std::optional<bool> happens = happens_after(first_guess);
    if (!happens) return {};
    if (*happens) return without_needless(first_guess, happens_after);
  }
  if (predecessors.empty()) return {History::Quality::kNotReproduced, {}};
  std::size_t too_few = 0;
  std::size_t count = 1;
  while (true) {
    const std::optional<bool> happens = happens_after(last(predecessors, count));
    if (!happens) return {};
    if (*happens) break;
    if (count == predecessors.size()) return {History::Quality::kNotReproduced, {}};
    too_few = count;
    count = std::min(2 * count, predecessors.size());
  }
  const std::optional<std::size_t> more =
      least(count - too_few, [&](std::size_t n) { return happens_after(last(predecessors, too_few + n)); });
  if (!more) return {History::Quality::kShortened, last(predecessors, count)};
  return without_needless(last(predecessors, too_few + *more), happens_after);
}

}  // namespace evalcts
