// Filters: which of several names a user chooses, and which tests a run runs.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/depth.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// True if the name matches a GoogleTest-like filter: patterns with * and ?, separated by ':', those after a
// '-' excluded. An empty filter matches every name.
bool is_chosen(const std::string& name, const std::string& filter);

// The items whose names match the filter.
template <class Named>
std::vector<Named> matching(std::vector<Named> items, const std::string& filter) {
  std::erase_if(items, [&](const Named& item) { return !is_chosen(item.name, filter); });
  return items;
}

// True if a run of the given depth runs the test, provided that the filter matches its name: the test
// belongs to the depth, or one of the patterns is its exact name.
bool is_played(const ListedTest& test, Depth depth, const std::string& filter);

}  // namespace evalcts
