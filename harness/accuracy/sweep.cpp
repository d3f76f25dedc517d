// Evaluates the blocks of a sweep, judges their results, and distributes blocks among threads.
#include <evalcts/accuracy/sweep.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <queue>
#include <thread>

#include <reference/filter.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/blocks.h>
#include <evalcts/accuracy/digest.h>

namespace evalcts::accuracy {
namespace {

constexpr std::int64_t kMagnitudeMask = 0x7fffffff;
// Relative margin of errors computed in double: far above their rounding errors, far below the printed
// digits.
constexpr double kSlack = 0x1p-30;
constexpr auto kBetweenReports = std::chrono::seconds(1);

// Makes the hashes of different components different.
constexpr std::uint64_t kComponent = 0x9e3779b97f4a7c15;

// Returns the ULP for binary32 (Harrison) of a double that approximates an exact value. It may be wrong by a
// factor of two if x is a power of two.
double ulp_of(double x) {
  if (std::abs(x) <= 0x1p-126) return 0x1p-149;
  int exponent = 0;
  const double significand = std::frexp(std::abs(x), &exponent);  // 1/2 <= significand < 1
  return std::ldexp(1.0, std::clamp(exponent - 24 - (significand == 0.5 ? 1 : 0), -149, 104));
}

double extended(float x) { return std::isinf(x) ? std::copysign(0x1p128, x) : x; }

// Judges the results of one component, in one thread.
class Judge {
 public:
  Judge(const SweptMap& map, int component) : component_(component), polynomial_(map, component) {}

  SweepResult judge(std::int64_t first, std::span<const float> u, std::span<const float> got) {
    const std::size_t count = u.size();
    arguments_.assign(u.begin(), u.end());
    rights_.resize(count);
    SweepResult result;
    result.values = count;
    result.decided_exactly = polynomial_.to_float(arguments_, rights_);
    for (std::size_t i = 0; i < count; ++i)
      result.digest += mixed((static_cast<std::uint64_t>(first + static_cast<std::int64_t>(i)) << 32 ^
                              std::bit_cast<std::uint32_t>(got[i])) +
                             static_cast<std::uint64_t>(component_) * kComponent);
    wrong_.clear();
    for (std::size_t i = 0; i < count; ++i)
      // A correct result 0 may be an exact zero or a rounded small value.
      if (!(got[i] == rights_[i]) || rights_[i] == 0) wrong_.push_back(i);
    measure(first, u, got, result);
    return result;
  }

 private:
  void measure(std::int64_t first, std::span<const float> u, std::span<const float> got,
               SweepResult& result) {
    if (wrong_.empty()) return;
    wrong_arguments_.clear();
    for (const std::size_t i : wrong_) wrong_arguments_.push_back(u[i]);
    enclosures_.resize(wrong_.size());
    polynomial_.enclose(wrong_arguments_, enclosures_);
    for (std::size_t w = 0; w < wrong_.size(); ++w) {
      const std::size_t i = wrong_[w];
      const std::int64_t number = first + static_cast<std::int64_t>(i);
      if (rights_[i] == 0 && polynomial_.exactly(u[i]).value.is_zero()) {
        ++result.zeros;
        if (got[i] != 0) ++result.zeros_wrong;
        continue;
      }
      if (got[i] == rights_[i]) continue;
      ++result.not_correctly_rounded;
      const bool finite = std::isfinite(got[i]);
      if (!finite && std::isfinite(rights_[i])) ++result.not_finite;
      const auto [high, low, bound] = enclosures_[w];
      const double difference = std::abs((extended(got[i]) - high) - low);
      const double unit = ulp_of(high);
      const double ulp = difference / unit;
      // The exact value decides if the error is near the boundary of a bin or the enclosure is too wide.
      const double uncertain = bound / unit + ulp * kSlack;
      const bool doubtful = std::isnan(got[i]) || !(uncertain < kSlack * 16 * std::max(ulp, 0.5)) ||
                            Errors::bin_of(ulp - uncertain) != Errors::bin_of(ulp + uncertain) ||
                            ulp_of(high + bound) != unit || ulp_of(high - bound) != unit;
      const double certain_ulp = doubtful ? exact_ulp(u[i], got[i]) : ulp;
      if (finite) ++result.histogram[Errors::bin_of(certain_ulp)];
      if (certain_ulp > result.ulp.error * (1 + kSlack))
        result.ulp = {doubtful ? certain_ulp : exact_ulp(u[i], got[i]), number, got[i], component_};
      const double condition = doubtful ? std::numeric_limits<double>::infinity()
                                        : difference / (0x1p-24 * polynomial_.magnitude(u[i]));
      if (condition > result.condition_aware.error * (1 + kSlack)) {
        const reference::Evaluation exact = polynomial_.exactly(u[i]);
        result.condition_aware.keep({reference::condition_distance(got[i], exact.value, exact.magnitude),
                                     number, got[i], component_});
      }
    }
  }

  double exact_ulp(float u, float got) const {
    return reference::ulp_distance(got, polynomial_.exactly(u).value);
  }

  int component_;
  SweptPolynomial polynomial_;
  std::vector<double> arguments_, wrong_arguments_;
  std::vector<float> rights_;
  std::vector<std::size_t> wrong_;
  std::vector<reference::Enclosure> enclosures_;
};

// Judges the results of all components.
class Judges {
 public:
  explicit Judges(const SweptMap& map) {
    for (int k = 0; k < map.map.components; ++k) judges_.emplace_back(map, k);
  }

  // The components of each argument are adjacent in `results`.
  SweepResult judge(std::span<const float> u, std::span<const float> results) {
    const std::int64_t first = number_of(u.front());
    if (judges_.size() == 1) return judges_[0].judge(first, u, results);
    SweepResult sum;
    own_.resize(u.size());
    for (std::size_t k = 0; k < judges_.size(); ++k) {
      for (std::size_t i = 0; i < u.size(); ++i) own_[i] = results[i * judges_.size() + k];
      sum.add(judges_[k].judge(first, u, own_));
    }
    return sum;
  }

 private:
  std::vector<Judge> judges_;
  std::vector<float> own_;
};

// The arguments and results of a block.
struct Job {
  Job(const SweepTask& task, std::int64_t position)
      : block(position), u(task.arguments(position)), results(u.size() * task.map.map.components) {}
  std::int64_t block;
  std::vector<float> u, results;
};

// The queue between the evaluating thread and the judging threads. Its capacity is small to limit memory.
class Queue {
 public:
  explicit Queue(std::size_t room) : room_(room) {}
  void push(Job job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_.size() < room_ || closed_; });
    jobs_.push(std::move(job));
    changed_.notify_all();
  }
  std::optional<Job> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !jobs_.empty() || closed_; });
    if (jobs_.empty()) return std::nullopt;
    Job job = std::move(jobs_.front());
    jobs_.pop();
    changed_.notify_all();
    return job;
  }
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::size_t room_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<Job> jobs_;
  bool closed_ = false;
};

}  // namespace

std::int64_t number_of(float x) {
  const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(x));
  return std::signbit(x) ? -(bits & kMagnitudeMask) : bits;
}

float float_of(std::int64_t number) {
  const float magnitude = std::bit_cast<float>(static_cast<std::uint32_t>(std::abs(number)));
  return number < 0 ? -magnitude : magnitude;
}

std::vector<float> SweepTask::arguments(std::int64_t block) const {
  const std::int64_t begin = (first_block() + block) * kBlock;
  const std::int64_t first = std::max(begin, number_of(from)),
                     last = std::min(begin + kBlock - 1, number_of(to));
  std::vector<float> all;
  all.reserve(kBlock);
  for (std::int64_t n = first; n <= last; ++n) all.push_back(float_of(n));
  return all;
}

std::int64_t SweepTask::first_block() const {
  const std::int64_t first = number_of(from);
  return first >= 0 ? first / kBlock : -((-first + kBlock - 1) / kBlock);
}

std::int64_t SweepTask::blocks() const {
  const std::int64_t last = number_of(to);
  const std::int64_t last_block = last >= 0 ? last / kBlock : -((-last + kBlock - 1) / kBlock);
  return last_block - first_block() + 1;
}

void SweepResult::Largest::keep(const Largest& other) {
  if (other.error > error || (other.error == error && error > 0 &&
                              std::pair(other.number, other.component) < std::pair(number, component)))
    *this = other;
}

void SweepResult::add(const SweepResult& other) {
  values += other.values;
  decided_exactly += other.decided_exactly;
  not_correctly_rounded += other.not_correctly_rounded;
  not_finite += other.not_finite;
  zeros += other.zeros;
  zeros_wrong += other.zeros_wrong;
  for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += other.histogram[i];
  ulp.keep(other.ulp);
  condition_aware.keep(other.condition_aware);
  digest += other.digest;
}

void BlockSet::insert(std::int64_t block) {
  const auto position = static_cast<std::size_t>(block);
  if (!done_[position]) ++size_;
  done_[position] = true;
}

std::vector<std::array<std::int64_t, 2>> BlockSet::ranges() const {
  std::vector<std::array<std::int64_t, 2>> all;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(done_.size()); ++i) {
    if (!contains(i)) continue;
    if (!all.empty() && all.back()[1] == i - 1) {
      all.back()[1] = i;
    } else {
      all.push_back({i, i});
    }
  }
  return all;
}

std::optional<std::int64_t> OwnBlocks::next() {
  const std::lock_guard lock(mutex_);
  while (next_ < task_.blocks() && (!task_.mine(next_) || state_.done.contains(next_))) ++next_;
  if (stop_ || problem_ || next_ >= task_.blocks()) return std::nullopt;
  return next_++;
}

void OwnBlocks::finish(std::int64_t block, const SweepResult& result) { finish(std::vector{block}, result); }

void OwnBlocks::finish(const std::vector<std::int64_t>& blocks, const SweepResult& result) {
  const std::lock_guard lock(mutex_);
  for (const std::int64_t block : blocks) state_.done.insert(block);
  state_.result.add(result);
  const auto now = std::chrono::steady_clock::now();
  if (now - reported_ < kBetweenReports) return;
  reported_ = now;
  progress_(state_);
}

void OwnBlocks::fail(std::exception_ptr problem) {
  const std::lock_guard lock(mutex_);
  if (!problem_) problem_ = std::move(problem);
}

void OwnBlocks::end() {
  progress_(state_);
  if (problem_) std::rethrow_exception(problem_);
}

void work(const SweepTask& task, const StreamSource& source, int threads, Blocks& blocks) {
  Queue queue(2 * static_cast<std::size_t>(threads));
  const auto guarded = [&](const auto& what) {
    return [&blocks, &queue, &what] {
      try {
        what();
      } catch (...) {
        blocks.fail(std::current_exception());
        queue.close();
      }
    };
  };
  const auto evaluate_and_judge = [&] {
    Judges judges(task.map);
    const std::unique_ptr<Stream> stream = source.make(task.map);
    while (const auto block = blocks.next()) {
      Job job(task, *block);
      stream->evaluate(job.u, job.results);
      blocks.finish(job.block, judges.judge(job.u, job.results));
    }
  };
  const auto judge_only = [&] {
    Judges judges(task.map);
    while (const auto job = queue.pop()) blocks.finish(job->block, judges.judge(job->u, job->results));
  };
  const auto evaluate_only = [&] {
    const std::unique_ptr<Stream> stream = source.make(task.map);
    while (const auto block = blocks.next()) {
      Job job(task, *block);
      stream->evaluate(job.u, job.results);
      queue.push(std::move(job));
    }
  };
  std::vector<std::thread> others;
  if (source.for_threads) {
    for (int i = 1; i < threads; ++i) others.emplace_back(guarded(evaluate_and_judge));
    guarded(evaluate_and_judge)();
  } else {
    for (int i = 0; i < threads; ++i) others.emplace_back(guarded(judge_only));
    guarded(evaluate_only)();
    queue.close();
  }
  for (std::thread& other : others) other.join();
}

void sweep(const SweepTask& task, const StreamSource& source, int threads, SweepState& state,
           const std::atomic<bool>& stop, const std::function<void(const SweepState&)>& progress) {
  OwnBlocks blocks(task, state, stop, progress);
  work(task, source, threads, blocks);
  blocks.end();
}

}  // namespace evalcts::accuracy
