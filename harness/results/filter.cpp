// Matches names against the patterns of filters.
#include <evalcts/results/filter.h>

#include <sstream>

#include "posix.h"

namespace evalcts {
namespace {

template <class Holds>
bool any_pattern(const std::string& patterns, const Holds& holds) {
  std::istringstream stream(patterns);
  for (std::string pattern; std::getline(stream, pattern, ':');)
    if (holds(pattern)) return true;
  return false;
}

}  // namespace

bool is_chosen(const std::string& name, const std::string& filter) {
  const auto matches_any = [&](const std::string& patterns) {
    return any_pattern(patterns, [&](const std::string& pattern) {
      return fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
    });
  };
  // The first '-' at the beginning of a pattern starts the excluding patterns, as in GoogleTest.
  const std::size_t dash = filter.starts_with('-') ? 0 : filter.find(":-");
  const std::string positive = dash == std::string::npos ? filter : filter.substr(0, dash);
  const std::string negative =
      dash == std::string::npos ? "" : filter.substr(dash + (filter[dash] == ':' ? 2 : 1));
  return (positive.empty() || matches_any(positive)) && !(!negative.empty() && matches_any(negative));
}

bool is_selected(const ListedTest& test, Depth depth, const std::string& filter) {
  return test.from <= depth ||
         any_pattern(filter, [&](const std::string& pattern) { return pattern == test.name; });
}

}  // namespace evalcts
