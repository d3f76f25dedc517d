// The display lists of a context by name.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glevaluator.h>

#include "allocator.h"
#include "display_list.h"

namespace glev {

// A sorted array of intervals of names. An interval of more than one name represents empty lists, so unused
// names from GenLists take almost no memory.
class ListTable {
 public:
  ListTable() = default;
  ListTable(const ListTable&) = delete;
  ListTable& operator=(const ListTable&) = delete;
  void free(const Allocator& allocator);

  // Returns the list; null if there is none.
  const DisplayList* find(glev_uint name) const;

  // Assigns the list to the name; the table then owns the list. Returns false, and changes nothing, if there
  // is no memory.
  bool define(const Allocator& allocator, glev_uint name, const DisplayList& list);

  // Deletes the lists among the names first to last. Returns false, and changes nothing, if there is no
  // memory, which is needed to split an interval.
  bool delete_names(const Allocator& allocator, glev_uint first, glev_uint last);

  // Makes `count` (> 0) empty lists with consecutive names other than `taken`. *first is the first name, or 0
  // if there is no such range. Returns false, and changes nothing, if there is no memory.
  bool reserve(const Allocator& allocator, glev_uint count, glev_uint taken, glev_uint* first);

 private:
  struct Entry {
    glev_uint first, last;
    bool deleted;  // kept until the next insertion, so that deletions move no entries
    DisplayList list;
  };

  // Returns the first entry that ends at or after the name.
  std::size_t lower_bound(glev_uint name) const;
  bool covers(std::size_t i, glev_uint name) const { return i < count_ && entries_[i].first <= name; }
  // Replaces `replaced` entries at `place` by `count` entries. Returns false, and changes nothing, if there
  // is no memory.
  bool replace(const Allocator& allocator, std::size_t place, std::size_t replaced, const Entry* entries,
               std::size_t count);
  void drop_deleted();

  Entry* entries_ = nullptr;
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
  bool any_deleted_ = false;
};

}  // namespace glev
