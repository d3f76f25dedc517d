#include "harness/accuracy/sweep.h"

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

#include "harness/accuracy/exact_line.h"

namespace evalcts::accuracy {
namespace {

constexpr std::int64_t kMagnitudeMask = 0x7fffffff;
// Relative, of what is computed in double: far above its rounding errors, far below what anybody reads.
constexpr double kSlack = 0x1p-30;
constexpr auto kBetweenReports = std::chrono::seconds(1);

// The finalizer of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

// Harrison's ULP of a double, which may be off by its own rounding where it is a power of two.
double ulp_of(double x) {
  if (std::abs(x) <= 0x1p-126) return 0x1p-149;
  int exponent = 0;
  const double significand = std::frexp(std::abs(x), &exponent);  // 1/2 <= it < 1
  return std::ldexp(1.0, std::clamp(exponent - 24 - (significand == 0.5 ? 1 : 0), -149, 104));
}

double extended(float x) { return std::isinf(x) ? std::copysign(0x1p128, x) : x; }

// One thread's view of the polynomial.
class Judge {
 public:
  explicit Judge(const std::vector<double>& points)
      : points_(points),
        curve_{points_.data(), 1, static_cast<int>(points_.size()), 0, 1},
        right_(curve_),
        line_(ExactLine::of(points)),
        filter_(curve_),
        exact_(curve_) {}

  SweepResult judge(std::int64_t first, std::span<const float> u, std::span<const float> got) {
    const std::size_t count = u.size();
    arguments_.assign(u.begin(), u.end());
    rights_.resize(count);
    SweepResult result;
    result.values = count;
    if (line_) {
      for (std::size_t i = 0; i < count; ++i) rights_[i] = line_->to_float(u[i]);
    } else {
      result.decided_exactly = right_.to_float({arguments_}, rights_);
    }
    for (std::size_t i = 0; i < count; ++i)
      result.digest += mixed(static_cast<std::uint64_t>(first + static_cast<std::int64_t>(i)) << 32 ^
                             std::bit_cast<std::uint32_t>(got[i]));
    wrong_.clear();
    for (std::size_t i = 0; i < count; ++i)
      // A right result that is zero may be an exact one or the nearest to something small.
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
    filter_.enclose({wrong_arguments_}, {}, enclosures_);
    for (std::size_t w = 0; w < wrong_.size(); ++w) {
      const std::size_t i = wrong_[w];
      const std::int64_t number = first + static_cast<std::int64_t>(i);
      if (rights_[i] == 0 && exactly(u[i]).value.is_zero()) {
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
      // Near an end of a bin, or where the enclosure says little, the exact value decides.
      const double uncertain = bound / unit + ulp * kSlack;
      const bool doubtful = std::isnan(got[i]) || !(uncertain < kSlack * 16 * std::max(ulp, 0.5)) ||
                            Errors::bin_of(ulp - uncertain) != Errors::bin_of(ulp + uncertain) ||
                            ulp_of(high + bound) != unit || ulp_of(high - bound) != unit;
      const double certain_ulp = doubtful ? exact_ulp(u[i], got[i]) : ulp;
      if (finite) ++result.histogram[Errors::bin_of(certain_ulp)];
      if (certain_ulp > result.ulp.error * (1 + kSlack))
        result.ulp = {doubtful ? certain_ulp : exact_ulp(u[i], got[i]), number, got[i]};
      const double condition =
          doubtful ? std::numeric_limits<double>::infinity() : difference / (0x1p-24 * magnitude(u[i]));
      if (condition > result.condition_aware.error * (1 + kSlack)) {
        const reference::Evaluation exact = exactly(u[i]);
        result.condition_aware.keep(
            {reference::condition_distance(got[i], exact.value, exact.magnitude), number, got[i]});
      }
    }
  }

  reference::Evaluation exactly(float u) const {
    return exact_.evaluate_with_magnitude(reference::Argument::coordinate(u));
  }
  double exact_ulp(float u, float got) const {
    return reference::ulp_distance(got, exact_.evaluate(reference::Argument::coordinate(u)));
  }
  // SUM |B_i| |R_i|, good to many digits wherever the terms are in the range of double.
  double magnitude(double u) const {
    const auto order = static_cast<int>(points_.size());
    const double s = std::abs(1 - u), t = std::abs(u);
    double sum = std::abs(points_[0]), binomial = 1, power = 1;
    for (int i = 1; i < order; ++i) {
      binomial = binomial * (order - i) / i;
      power *= t;
      sum = sum * s + binomial * power * std::abs(points_[i]);
    }
    return sum;
  }

  const std::vector<double>& points_;
  reference::Curve curve_;
  reference::CorrectlyRounded right_;
  std::optional<ExactLine> line_;
  reference::Filter filter_;
  reference::BernsteinForm exact_;
  std::vector<double> arguments_, wrong_arguments_;
  std::vector<float> rights_;
  std::vector<std::size_t> wrong_;
  std::vector<reference::Enclosure> enclosures_;
};

// The arguments of a block, and their results where another thread has evaluated them.
struct Job {
  std::int64_t block = 0;  // its position
  std::int64_t first = 0;  // number of the first argument
  std::vector<float> u, results;
};

// Hands out the blocks, takes the results.
class Sweep {
 public:
  Sweep(const SweepTask& task, SweepState& state, const std::atomic<bool>& stop,
        const std::function<void(const SweepState&)>& progress)
      : task_(task), state_(state), stop_(stop), progress_(progress) {}

  // The next block to do; none where there is no more.
  std::optional<Job> next() {
    const std::lock_guard lock(mutex_);
    while (next_ < task_.blocks() && (!task_.mine(next_) || state_.done.contains(next_))) ++next_;
    if (stop_ || failed_ || next_ >= task_.blocks()) return std::nullopt;
    Job job;
    job.block = next_++;
    const std::int64_t begin = (task_.first_block() + job.block) * kBlock;
    job.first = std::max(begin, number_of(task_.from));
    const std::int64_t last = std::min(begin + kBlock - 1, number_of(task_.to));
    for (std::int64_t n = job.first; n <= last; ++n) job.u.push_back(float_of(n));
    job.results.resize(job.u.size());
    return job;
  }

  void finish(const Job& job, const SweepResult& result) {
    const std::lock_guard lock(mutex_);
    state_.done.insert(job.block);
    state_.result.add(result);
    const auto now = std::chrono::steady_clock::now();
    if (now - reported_ < kBetweenReports) return;
    reported_ = now;
    progress_(state_);
  }

  void fail(std::exception_ptr problem) {
    const std::lock_guard lock(mutex_);
    if (!problem_) problem_ = std::move(problem);
    failed_ = true;
  }
  void end() {
    progress_(state_);
    if (problem_) std::rethrow_exception(problem_);
  }

 private:
  const SweepTask& task_;
  SweepState& state_;
  const std::atomic<bool>& stop_;
  const std::function<void(const SweepState&)>& progress_;
  std::mutex mutex_;
  std::int64_t next_ = 0;
  std::chrono::steady_clock::time_point reported_ = std::chrono::steady_clock::now();
  std::exception_ptr problem_;
  std::atomic<bool> failed_ = false;
};

// From the thread that evaluates to those that judge; short, so that memory stays small.
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
  if (other.error > error || (other.error == error && error > 0 && other.number < number)) *this = other;
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

void sweep(const SweepTask& task, const StreamSource& source, int threads, SweepState& state,
           const std::atomic<bool>& stop, const std::function<void(const SweepState&)>& progress) {
  Sweep run(task, state, stop, progress);
  Queue queue(2 * static_cast<std::size_t>(threads));
  const auto guarded = [&](const auto& work) {
    return [&run, &queue, &work] {
      try {
        work();
      } catch (...) {
        run.fail(std::current_exception());
        queue.close();
      }
    };
  };
  const auto evaluate_and_judge = [&] {
    Judge judge(task.points);
    const std::unique_ptr<Stream> stream = source.make(task.points);
    while (auto job = run.next()) {
      stream->evaluate(job->u, job->results);
      run.finish(*job, judge.judge(job->first, job->u, job->results));
    }
  };
  const auto judge_only = [&] {
    Judge judge(task.points);
    while (auto job = queue.pop()) run.finish(*job, judge.judge(job->first, job->u, job->results));
  };
  const auto evaluate_only = [&] {
    const std::unique_ptr<Stream> stream = source.make(task.points);
    while (auto job = run.next()) {
      stream->evaluate(job->u, job->results);
      queue.push(std::move(*job));
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
  run.end();
}

}  // namespace evalcts::accuracy
