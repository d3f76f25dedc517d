// The table of the display lists of a context.
#include "list_table.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

namespace glev {
namespace {

// Returns the first of `count` consecutive names from `low` to `high` that do not include `taken`; 0 if there
// are none.
glev_uint fit_into(std::uint64_t low, std::uint64_t high, glev_uint count, glev_uint taken) {
  if (taken >= low && taken < low + count) low = std::uint64_t{taken} + 1;
  return low + count <= high + 1 ? static_cast<glev_uint>(low) : 0;
}

}  // namespace

void ListTable::free(const Allocator& allocator) {
  for (std::size_t i = 0; i < count_; ++i) entries_[i].list.free(allocator);
  allocator.release(entries_, capacity_ * sizeof(Entry), kCacheLine);
  entries_ = nullptr;
  count_ = capacity_ = 0;
}

std::size_t ListTable::lower_bound(glev_uint name) const {
  const Entry* found = std::partition_point(entries_, entries_ + count_,
                                            [name](const Entry& entry) { return entry.last < name; });
  return static_cast<std::size_t>(found - entries_);
}

const DisplayList* ListTable::find(glev_uint name) const {
  const std::size_t i = lower_bound(name);
  return covers(i, name) && !entries_[i].deleted ? &entries_[i].list : nullptr;
}

bool ListTable::define(const Allocator& allocator, glev_uint name, const DisplayList& list) {
  std::size_t i = lower_bound(name);
  if (covers(i, name) && entries_[i].first == entries_[i].last) {
    entries_[i].list.free(allocator);
    entries_[i].list = list;
    entries_[i].deleted = false;
    return true;
  }
  drop_deleted();
  i = lower_bound(name);
  Entry pieces[3];
  std::size_t count = 0;
  const bool split = covers(i, name);
  if (split && entries_[i].first < name) pieces[count++] = {entries_[i].first, name - 1, false, {}};
  pieces[count++] = {name, name, false, list};
  if (split && entries_[i].last > name) pieces[count++] = {name + 1, entries_[i].last, false, {}};
  return replace(allocator, i, split ? 1 : 0, pieces, count);
}

bool ListTable::delete_names(const Allocator& allocator, glev_uint first, glev_uint last) {
  std::size_t i = lower_bound(first);
  if (covers(i, first) && entries_[i].first < first && entries_[i].last > last) {
    if (entries_[i].deleted) return true;
    const Entry pieces[] = {{entries_[i].first, first - 1, false, {}},
                            {last + 1, entries_[i].last, false, {}}};
    return replace(allocator, i, 1, pieces, 2);
  }
  for (; covers(i, last); ++i) {
    Entry& entry = entries_[i];
    if (entry.first < first) {
      entry.last = first - 1;
    } else if (entry.last > last) {
      entry.first = last + 1;
    } else {
      entry.list.free(allocator);
      entry.deleted = any_deleted_ = true;
    }
  }
  return true;
}

bool ListTable::reserve(const Allocator& allocator, glev_uint count, glev_uint taken, glev_uint* first) {
  constexpr std::uint64_t kLast = std::numeric_limits<glev_uint>::max();
  drop_deleted();
  const auto after = [this](std::size_t i) { return i == 0 ? 1 : std::uint64_t{entries_[i - 1].last} + 1; };
  std::size_t place = count_;
  *first = fit_into(after(place), kLast, count, taken);
  for (std::size_t i = 0; *first == 0 && i < count_; ++i) {
    place = i;
    *first = fit_into(after(i), std::uint64_t{entries_[i].first} - 1, count, taken);
  }
  if (*first == 0) return true;
  const glev_uint last = *first + (count - 1);
  if (place > 0 && after(place) == *first && entries_[place - 1].list.empty()) {
    entries_[place - 1].last = last;
    return true;
  }
  const Entry entry = {*first, last, false, {}};
  return replace(allocator, place, 0, &entry, 1);
}

bool ListTable::replace(const Allocator& allocator, std::size_t place, std::size_t replaced,
                        const Entry* entries, std::size_t count) {
  const std::size_t new_count = count_ - replaced + count;
  Entry* target = entries_;
  std::size_t capacity = capacity_;
  if (new_count > capacity_) {
    constexpr std::size_t kSmallest = 16;
    capacity = std::max({kSmallest, 2 * capacity_, new_count});
    target = static_cast<Entry*>(allocator.allocate(capacity * sizeof(Entry), kCacheLine));
    if (target == nullptr) return false;
    std::uninitialized_copy(entries_, entries_ + place, target);
  }
  const std::size_t rest = count_ - place - replaced;
  if (rest != 0) std::memmove(target + place + count, entries_ + place + replaced, rest * sizeof(Entry));
  std::copy(entries, entries + count, target + place);
  if (target != entries_) allocator.release(entries_, capacity_ * sizeof(Entry), kCacheLine);
  entries_ = target;
  count_ = new_count;
  capacity_ = capacity;
  return true;
}

void ListTable::drop_deleted() {
  if (!any_deleted_) return;
  const Entry* end =
      std::remove_if(entries_, entries_ + count_, [](const Entry& entry) { return entry.deleted; });
  count_ = static_cast<std::size_t>(end - entries_);
  any_deleted_ = false;
}

}  // namespace glev
