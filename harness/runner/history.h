// Finds the history of a failure: the earlier tests in the same process that it depends on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace evalcts {

// The tests that must run before a failing test to make it fail, as far as a search has found them.
struct History {
  enum class Quality {
    kShortest,       // no single test of `tests` can be removed
    kShortened,      // time ran out: `tests` reproduces the failure, but may be longer than necessary
    kNotReproduced,  // even all predecessors in their order do not reproduce it: it is not deterministic
    kOutOfTime,      // time ran out before anything was found
  };
  Quality quality = Quality::kOutOfTime;
  std::vector<std::string> tests;
  std::string only_case = {};  // of a single test: the last of its cases that matters; empty: not searched

  bool is_found() const { return quality == Quality::kShortest || quality == Quality::kShortened; }
};

// Returns true if the failure happens after these tests in this order; empty if time ran out first.
using HappensAfter = std::function<std::optional<bool>(const std::vector<std::string>&)>;

// Returns the shortest history of a failure that does not happen if its test runs alone. The search
// first tries `first_guess`, unless that is empty; then it doubles the number of last predecessors
// until the failure happens, finds the least number by bisection, and removes unnecessary tests by
// delta debugging (delta_debugging.h).
History shortest_history(const std::vector<std::string>& predecessors,
                         const std::vector<std::string>& first_guess, const HappensAfter& happens_after);

// Returns the least number in [1, most] for which `happens` returns true, by bisection; empty if time ran
// out. `happens` must be monotonic, and is assumed to return true for `most`.
std::optional<std::size_t> least(std::size_t most,
                                 const std::function<std::optional<bool>(std::size_t)>& happens);

}  // namespace evalcts
