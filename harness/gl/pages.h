// Pages of memory between two inaccessible ones, so that an access beyond their ends crashes.
#pragma once

#include <cstddef>

namespace evalcts::gl {

// Returns the size of a page in bytes.
std::size_t page_size();
// Returns the first of `count` pages that can be read and written. Throws std::bad_alloc.
std::byte* map_pages(std::size_t count);
// Make `count` pages from map_pages() inaccessible. The address range of unmapped ones may be used again.
void unmap_pages(std::byte* first, std::size_t count);
void protect_pages(std::byte* first, std::size_t count);

}  // namespace evalcts::gl
