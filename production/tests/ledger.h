// An allocator that tracks its blocks and can fail.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include <glevaluator.h>

namespace glev_tests {

// Tracks allocated blocks, checks their release, and fails from the nth request on.
struct Ledger {
  std::map<void*, std::pair<std::size_t, std::size_t>> out;
  int requests = 0;
  int refuse_from = -1;

  glev_allocator make_allocator() {
    return {sizeof(glev_allocator), this,
            [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
              auto* ledger = static_cast<Ledger*>(user);
              if (ledger->refuse_from >= 0 && ledger->requests >= ledger->refuse_from) return nullptr;
              ++ledger->requests;
              void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
              std::memset(memory, 0xA5, bytes);
              ledger->out[memory] = {bytes, alignment};
              return memory;
            },
            [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
              auto* ledger = static_cast<Ledger*>(user);
              EXPECT_EQ(ledger->out.count(memory), 1u);
              EXPECT_EQ(ledger->out[memory], std::make_pair(bytes, alignment));
              ledger->out.erase(memory);
              std::free(memory);
            }};
  }
};

}  // namespace glev_tests
