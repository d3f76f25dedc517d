// Selects names and tests by the filters that a user gives.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/depth.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// True if the name matches a filter like GoogleTest's: patterns with * and ?, separated by ':'. The first
// pattern that begins with '-', and all after it, exclude names. If there are no other patterns, every other
// name matches.
bool is_chosen(const std::string& name, const std::string& filter);

// Returns the items whose names match the filter.
template <class Item>
std::vector<Item> matching(std::vector<Item> items, const std::string& filter) {
  std::erase_if(items, [&](const Item& item) { return !is_chosen(item.name, filter); });
  return items;
}

// True if a run of the given depth runs the test, provided that the filter matches its name: the test
// belongs to the depth, or one of the patterns is its exact name.
bool is_selected(const ListedTest& test, Depth depth, const std::string& filter);

}  // namespace evalcts
