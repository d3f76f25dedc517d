// The display lists of a context by name.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glevaluator.h>

#include "allocator.h"
#include "display_list.h"

namespace glev {

// A sorted array of intervals of names. An interval of more than one name stands for empty lists, so names
// that GenLists gave away and nobody has filled cost next to nothing.
class ListTable {
 public:
  ListTable() = default;
  ListTable(const ListTable&) = delete;
  ListTable& operator=(const ListTable&) = delete;
  void free(const Allocator& allocator);

  // Null if there is no such list.
  const DisplayList* find(glev_uint name) const;

  // Gives the name this list, which then belongs to the table. False, and nothing changed, without memory.
  bool define(const Allocator& allocator, glev_uint name, const DisplayList& list);

  // Deletes the lists among the names first to last. False, and nothing changed, without memory: a hole in an
  // interval needs some.
  bool delete_names(const Allocator& allocator, glev_uint first, glev_uint last);

  // Makes `count` (> 0) empty lists with successive names, `taken` not among them. *first: their first name,
  // 0 if there is no such range. False, and nothing changed, without memory.
  bool reserve(const Allocator& allocator, glev_uint count, glev_uint taken, glev_uint* first);

 private:
  struct Entry {
    glev_uint first, last;
    bool deleted;  // stays until the next insertion, so that deleting lists one by one moves nothing
    DisplayList list;
  };

  // The first entry that ends at or after the name.
  std::size_t lower_bound(glev_uint name) const;
  bool covers(std::size_t i, glev_uint name) const { return i < count_ && entries_[i].first <= name; }
  // Puts `count` entries in the place of `replaced` ones. False, and nothing changed, without memory.
  bool replace(const Allocator& allocator, std::size_t place, std::size_t replaced, const Entry* entries,
               std::size_t count);
  void drop_deleted();

  Entry* entries_ = nullptr;
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
  bool any_deleted_ = false;
};

}  // namespace glev
