// An allocator that tracks its blocks and can fail, and fixtures whose context uses it.
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

// Adds to a fixture that its context has the memory of a ledger, and expects that all of it is released.
template <class Fixture>
class WithLedger : public Fixture {
 protected:
  WithLedger() { replace_context(); }
  ~WithLedger() override {
    glevDestroyContext(this->gl);
    this->gl = nullptr;
    EXPECT_TRUE(ledger_.out.empty()) << ledger_.out.size() << " blocks leaked";
  }
  void replace_context() {
    glevDestroyContext(this->gl);
    EXPECT_EQ(glevCreateContext(&info_, &this->gl), GLEV_SUCCESS);
    const glev_sink sink = this->recording.make_sink();
    glevSetSink(this->gl, &sink);
  }

  Ledger ledger_;
  const glev_allocator allocator_ = ledger_.make_allocator();
  const glev_context_info info_ = {sizeof info_, &allocator_, nullptr};
};

}  // namespace glev_tests
