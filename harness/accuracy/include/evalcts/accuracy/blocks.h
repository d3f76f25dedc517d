// Distribution of a sweep's blocks among threads of this process or other processes.
#pragma once

#include <chrono>
#include <exception>
#include <mutex>

#include <evalcts/accuracy/sweep.h>

namespace evalcts::accuracy {

// Called by several threads at once.
class Blocks {
 public:
  virtual ~Blocks() = default;
  // The position of a block to do; none where there is no more.
  virtual std::optional<std::int64_t> next() = 0;
  virtual void finish(std::int64_t block, const SweepResult& result) = 0;
  // A thread cannot go on. No more blocks from now on.
  virtual void fail(std::exception_ptr problem) = 0;
};

// Evaluates and judges blocks, in so many threads, until there is no more.
void work(const SweepTask& task, const StreamSource& source, int threads, Blocks& blocks);

// The blocks of a sweep that are not done; keeps their results.
class OwnBlocks final : public Blocks {
 public:
  using Progress = std::function<void(const SweepState&)>;
  // `progress` is called now and then, by one thread at a time, with a state that is whole. No more blocks
  // once `stop` is true.
  OwnBlocks(const SweepTask& task, SweepState& state, const std::atomic<bool>& stop, const Progress& progress)
      : task_(task), state_(state), stop_(stop), progress_(progress) {}

  std::optional<std::int64_t> next() override;
  void finish(std::int64_t block, const SweepResult& result) override;
  // Takes the result of several blocks together.
  void finish(const std::vector<std::int64_t>& blocks, const SweepResult& result);
  void fail(std::exception_ptr problem) override;

  // After the last block: progress once more, then throws the first problem.
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
