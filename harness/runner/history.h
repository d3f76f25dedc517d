// History of a failure: the tests before it that it depends on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace evalcts {

// The tests that have to come before a failing one, as far as they were found.
struct History {
  enum class Found {
    kShortest,       // `tests` is as short as single tests can make it
    kShortened,      // time ran out: `tests` shows the failure, and may be longer than it has to be
    kNotReproduced,  // not even all predecessors in their order show it: it does not always happen
    kOutOfTime,      // nothing was found in the time given
  };
  Found found = Found::kOutOfTime;
  std::vector<std::string> tests;
};

// Returns true if the failure shows after these tests, in this order; empty if time ran out first.
using HappensAfter = std::function<std::optional<bool>(const std::vector<std::string>&)>;

// The shortest history of a failure that does not happen alone: the last predecessors, doubled in number
// until they show it, then halved, then freed of what is not needed, piece by piece and at last test by test
// (as in Zeller's delta debugging). `first_guess`, where not empty, is tried before all that.
History shortest_history(const std::vector<std::string>& predecessors,
                         const std::vector<std::string>& first_guess, const HappensAfter& happens_after);

// The least number in [1, most] for which `happens` holds, which it does for `most`; empty where time ran
// out.
std::optional<std::size_t> least(std::size_t most,
                                 const std::function<std::optional<bool>(std::size_t)>& happens);

}  // namespace evalcts
