// Every float of an interval as argument of one map: no result is left to chance.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/accuracy/errors.h>
#include <evalcts/accuracy/stream.h>
#include <evalcts/accuracy/swept_map.h>

namespace evalcts::accuracy {

// Floats in order, with numbers: 0 is number 0, the smallest positive float number 1, and so on; negative
// numbers are negative floats. -0 has none.
std::int64_t number_of(float x);
float float_of(std::int64_t number);

// Blocks begin at multiples of this, so that all sweeps share their boundaries.
inline constexpr std::int64_t kBlock = 1 << 16;

// A part of a sweep: all components of the map at the floats from `from` to `to`, in every `shards`-th of
// their blocks, from the one with this position on (0 <= shard < shards).
struct SweepTask {
  SweptMap map;
  float from = 0, to = 1;
  std::int64_t shard = 0, shards = 1;

  std::int64_t first_block() const;
  std::int64_t blocks() const;                             // of all shards
  std::vector<float> arguments(std::int64_t block) const;  // all of them, in order
  bool mine(std::int64_t block) const { return block % shards == shard; }
  std::int64_t blocks_of_shard() const { return (blocks() - shard + shards - 1) / shards; }
};

// The result for all components together. Sums of parts are bit for bit the same in any order of the parts.
struct SweepResult {
  std::uint64_t values = 0;
  std::uint64_t decided_exactly = 0;  // right results that took the exact route
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t not_finite = 0;  // where the right result is; part of the former
  std::uint64_t zeros = 0;       // exact values that are; in none of the others but `values`
  std::uint64_t zeros_wrong = 0;
  // Bins as those of Errors, of the results that are finite and not correctly rounded.
  std::array<std::uint64_t, Errors::kBins> histogram{};
  // The largest errors, of results that are not correctly rounded; of equal ones that of the least argument,
  // and there that of the first component.
  struct Largest {
    double error = 0;
    std::int64_t number = 0;  // of the argument
    float got = 0;
    int component = 0;
    void keep(const Largest& other);
  };
  Largest ulp, condition_aware;
  // The sum, modulo 2^64, of a hash of each argument and component with the bits of its result: equal for
  // equal results, whatever the blocks, shards and machines.
  std::uint64_t digest = 0;

  void add(const SweepResult& other);
};

// Positions of blocks that are done, as ranges.
class BlockSet {
 public:
  bool contains(std::int64_t block) const { return done_[static_cast<std::size_t>(block)]; }
  void insert(std::int64_t block);
  std::int64_t size() const { return size_; }
  explicit BlockSet(std::int64_t blocks) : done_(static_cast<std::size_t>(blocks)) {}
  // First and last of each run.
  std::vector<std::array<std::int64_t, 2>> ranges() const;

 private:
  std::vector<bool> done_;
  std::int64_t size_ = 0;
};

struct SweepState {
  BlockSet done;
  SweepResult result;
};

// Does the blocks that are not done, in so many threads. `progress` is called now and then, and at the end,
// with a state that is whole. Ends early when `stop` becomes true. Throws NotObservable, CannotStart.
void sweep(const SweepTask& task, const StreamSource& source, int threads, SweepState& state,
           const std::atomic<bool>& stop, const std::function<void(const SweepState&)>& progress);

}  // namespace evalcts::accuracy
