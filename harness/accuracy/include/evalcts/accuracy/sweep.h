// Sweeps: evaluation of one map at every float of an interval.
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

// Number the floats in order: 0 has number 0, the smallest positive float number 1, and so on; negative
// floats have negative numbers. -0 and +0 have the same number.
std::int64_t number_of(float x);
float float_of(std::int64_t number);

// Number of floats of a block. Blocks begin at multiples of kBlock, so all sweeps have the same block
// boundaries.
inline constexpr std::int64_t kBlock = 1 << 16;

// A part of a sweep: all components of the map at the floats from `from` to `to`, in the blocks shard, shard
// + shards, shard + 2 * shards, ... (0 <= shard < shards).
struct SweepTask {
  SweptMap map;
  float from = 0, to = 1;
  std::int64_t shard = 0, shards = 1;

  std::int64_t first_block() const;
  std::int64_t blocks() const;                             // number of blocks of all shards
  std::vector<float> arguments(std::int64_t block) const;  // all arguments of a block, in order
  bool mine(std::int64_t block) const { return block % shards == shard; }
  std::int64_t blocks_of_shard() const { return (blocks() - shard + shards - 1) / shards; }
};

// The result for all components together. Adding results in any order gives the same bits.
struct SweepResult {
  std::uint64_t values = 0;
  std::uint64_t decided_exactly = 0;  // correctly rounded values computed by the exact route
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t not_finite = 0;  // although the exact result rounds to a finite float; also counted above
  std::uint64_t zeros = 0;       // exact values that are zero; not in the counts of errors above
  std::uint64_t zeros_wrong = 0;
  // The bins of Errors, for results that are finite and not correctly rounded.
  std::array<std::uint64_t, Errors::kBins> histogram{};
  // The largest error of results that are not correctly rounded. Of equal errors, it is that of the least
  // argument, and of its components that of the first.
  struct Largest {
    double error = 0;
    std::int64_t number = 0;  // number_of() the argument
    float got = 0;
    int component = 0;
    void keep(const Largest& other);
  };
  Largest ulp, condition_aware;
  // The sum, modulo 2^64, of a hash of each argument, component and result. Equal results have equal digests,
  // independently of blocks, shards and machines.
  std::uint64_t digest = 0;

  void add(const SweepResult& other);
};

// The set of finished blocks, by position.
class BlockSet {
 public:
  bool contains(std::int64_t block) const { return done_[static_cast<std::size_t>(block)]; }
  void insert(std::int64_t block);
  std::int64_t size() const { return size_; }
  explicit BlockSet(std::int64_t blocks) : done_(static_cast<std::size_t>(blocks)) {}
  // Returns the first and last position of each run of consecutive blocks.
  std::vector<std::array<std::int64_t, 2>> ranges() const;

 private:
  std::vector<bool> done_;
  std::int64_t size_ = 0;
};

struct SweepState {
  BlockSet done;
  SweepResult result;
};

// Evaluates the unfinished blocks in `threads` threads. Calls `progress` about once a second and at the end,
// with a consistent state. Ends early when `stop` becomes true. Throws NotObservable, CannotStart.
void sweep(const SweepTask& task, const StreamSource& source, int threads, SweepState& state,
           const std::atomic<bool>& stop, const std::function<void(const SweepState&)>& progress);

}  // namespace evalcts::accuracy
