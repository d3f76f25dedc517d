// Distribution of a sweep's blocks among threads of this process or other processes.
#pragma once

#include <chrono>
#include <exception>
#include <mutex>

#include <evalcts/accuracy/sweep.h>

namespace evalcts::accuracy {

// A source of blocks and a sink of their results. Its functions are called by several threads at once.
class Blocks {
 public:
  virtual ~Blocks() = default;
  // Returns the position of the next block to evaluate; nothing if none is left.
  virtual std::optional<std::int64_t> next() = 0;
  virtual void finish(std::int64_t block, const SweepResult& result) = 0;
  // Reports that a thread stops because of an exception. next() then returns nothing.
  virtual void fail(std::exception_ptr problem) = 0;
};

// Evaluates and judges blocks in `threads` threads until none is left.
void work(const SweepTask& task, const StreamSource& source, int threads, Blocks& blocks);

// Distributes the blocks of a sweep that are not finished, and adds their results to its state.
class OwnBlocks final : public Blocks {
 public:
  using Progress = std::function<void(const SweepState&)>;
  // `progress` is called about once a second, by one thread at a time, with a consistent state. next()
  // returns nothing once `stop` is true.
  OwnBlocks(const SweepTask& task, SweepState& state, const std::atomic<bool>& stop, const Progress& progress)
      : task_(task), state_(state), stop_(stop), progress_(progress) {}

  std::optional<std::int64_t> next() override;
  void finish(std::int64_t block, const SweepResult& result) override;
  // Adds the common result of several blocks.
  void finish(const std::vector<std::int64_t>& blocks, const SweepResult& result);
  void fail(std::exception_ptr problem) override;

  // Must be called after the last block. Calls `progress` once more, then rethrows the first exception given
  // to fail().
  void end();

 private:
  const SweepTask& task_;
  SweepState& state_;
  const std::atomic<bool>& stop_;
  const Progress& progress_;
  std::mutex mutex_;
  std::int64_t next_ = 0;
  std::chrono::steady_clock::time_point reported_ = std::chrono::steady_clock::now();
  std::exception_ptr problem_;
};

}  // namespace evalcts::accuracy
