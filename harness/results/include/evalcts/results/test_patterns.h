// Patterns that stand for several tests in the files of a baseline.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace evalcts {

// Returns the tests that the pattern matches, in which * stands for any characters. `tests` is sorted.
std::vector<std::string> tests_of(const std::string& pattern, const std::vector<std::string>& tests);

// Returns few patterns that match all of `names` and none of `others`. Sorted.
std::vector<std::string> patterns_for(const std::set<std::string>& names,
                                      const std::set<std::string>& others);

}  // namespace evalcts
