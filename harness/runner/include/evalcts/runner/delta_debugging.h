// Delta debugging (Zeller and Hildebrandt 2002): reduces a list that causes a failure to the items that are
// necessary for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace evalcts {

enum class Direction { kForwards, kBackwards };

// Divides the list into runs of `length` items (the last run may be shorter), and removes each run if
// still_fails() returns true for the remaining list, which may be empty. Returns true if any run was removed.
template <class Item, class StillFails>
bool remove_runs(std::vector<Item>& items, std::size_t length, Direction direction,
                 const StillFails& still_fails) {
  const bool forwards = direction == Direction::kForwards;
  bool removed = false;
  for (std::size_t seen = 0; seen < items.size();) {
    const std::size_t count = std::min(length, items.size() - seen);
    const std::size_t first = forwards ? seen : items.size() - seen - count;
    std::vector<Item> rest = items;
    const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(first);
    rest.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    if (still_fails(rest)) {
      items = std::move(rest);
      removed = true;
    } else {
      seen += count;
    }
  }
  return removed;
}

// Removes runs of half of the items, of a quarter, and so on down to single items. Returns true if the last
// step removed a single item, so that another call may remove more.
template <class Item, class StillFails>
bool reduce(std::vector<Item>& items, Direction direction, const StillFails& still_fails) {
  bool removed = false;
  for (std::size_t length = std::max<std::size_t>(items.size() / 2, 1); length > 0; length /= 2)
    removed = remove_runs(items, length, direction, still_fails);
  return removed;
}

}  // namespace evalcts
