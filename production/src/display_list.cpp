// The memory of display lists.
#include "display_list.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

namespace glev {

std::byte* DisplayList::append(const Allocator& allocator, RunsCommand run, std::uint64_t payload_bytes) {
  constexpr std::size_t kSmallest = 256;
  const std::uint64_t bytes = round_up_to_list_unit(sizeof(Record) + payload_bytes);
  if (bytes > capacity_ - size_) {
    if (bytes > std::numeric_limits<std::size_t>::max() / 2 - size_) return nullptr;
    const std::size_t capacity =
        std::max({kSmallest, 2 * capacity_, static_cast<std::size_t>(size_ + bytes)});
    auto* data = static_cast<std::byte*>(allocator.allocate(capacity, kCacheLine));
    if (data == nullptr) return nullptr;
    if (size_ != 0) std::memcpy(data, data_, size_);
    allocator.release(data_, capacity_, kCacheLine);
    data_ = data;
    capacity_ = capacity;
  }
  std::byte* place = data_ + size_;
  new (place) Record{run, static_cast<std::size_t>(bytes - sizeof(Record))};
  size_ += bytes;
  return place + sizeof(Record);
}

void DisplayList::free(const Allocator& allocator) {
  allocator.release(data_, capacity_, kCacheLine);
  *this = {};
}

}  // namespace glev
