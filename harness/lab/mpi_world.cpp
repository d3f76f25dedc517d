// Implements World with the C interface of MPI. Rank 0 keeps the state and hands out blocks. The other ranks
// request blocks; each request also contains the results of the previous blocks.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <deque>
#include <thread>
#include <type_traits>

#include <evalcts/accuracy/blocks.h>
#include "world.h"

namespace evalcts::cli {
namespace {

// Copies `size` bytes. Unlike memcpy, accepts null pointers, which empty vectors may return, if `size` is 0.
void copy_bytes(void* to, const void* from, std::size_t size) {
  if (size != 0) std::memcpy(to, from, size);
}

using accuracy::SweepResult;
using Clock = std::chrono::steady_clock;

enum Tag { kHello = 1, kReport, kGoodbye, kProblem, kOrders };

// An order is the list of blocks in one message to a rank. Its length is adapted so that the blocks take
// about this long: messages are rare, and little work is lost if a process dies.
constexpr auto kShortOrder = std::chrono::milliseconds(50);
constexpr std::int64_t kLongestOrder = 64;
constexpr auto kBetweenLooks = std::chrono::microseconds(200);

// Message of a rank about its finished blocks. The positions of these blocks follow in the same message.
struct Report {
  std::int64_t wanted = 0;
  std::int64_t finished = 0;
  SweepResult result;
};
static_assert(std::is_trivially_copyable_v<Report>, "it travels as bytes, between machines of one kind");

void send(int rank, Tag tag, const void* data, std::size_t size) {
  MPI_Send(data, static_cast<int>(size), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}
void send(int rank, Tag tag, const std::string& text) { send(rank, tag, text.data(), text.size()); }

std::vector<char> receive(const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::vector<char> data(static_cast<std::size_t>(size));
  MPI_Recv(data.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return data;
}

// Blocks that rank 0 hands out, for the threads of another rank.
class RemoteBlocks final : public accuracy::Blocks {
 public:
  std::optional<std::int64_t> next() override {
    const std::lock_guard lock(mutex_);
    if (orders_.empty() && !ended_) ask();
    if (orders_.empty()) return std::nullopt;
    const std::int64_t block = orders_.front();
    orders_.pop_front();
    return block;
  }
  void finish(std::int64_t block, const SweepResult& result) override {
    const std::lock_guard lock(mutex_);
    finished_.push_back(block);
    result_.add(result);
  }
  void fail(std::exception_ptr problem) override {
    const std::lock_guard lock(mutex_);
    if (!problem_) problem_ = std::move(problem);
    orders_.clear();
    ended_ = true;
  }
  // Sends the last results to rank 0. Must be called after the last block. Rethrows the first problem.
  void end() {
    tell(kGoodbye, 0);
    if (problem_) std::rethrow_exception(problem_);
  }

 private:
  void ask() {
    if (Clock::now() - asked_ < kShortOrder) wanted_ = std::min(2 * wanted_, kLongestOrder);
    if (Clock::now() - asked_ > 4 * kShortOrder) wanted_ = std::max<std::int64_t>(wanted_ / 2, 1);
    tell(kReport, wanted_);
    MPI_Status status;
    MPI_Probe(0, kOrders, MPI_COMM_WORLD, &status);
    const std::vector<char> data = receive(status);
    std::vector<std::int64_t> blocks(data.size() / sizeof(std::int64_t));
    copy_bytes(blocks.data(), data.data(), data.size());
    orders_.assign(blocks.begin(), blocks.end());
    ended_ = blocks.empty();
    asked_ = Clock::now();
  }
  void tell(Tag tag, std::int64_t wanted) {
    const Report report{wanted, static_cast<std::int64_t>(finished_.size()), result_};
    std::vector<char> data(sizeof report + finished_.size() * sizeof(std::int64_t));
    copy_bytes(data.data(), &report, sizeof report);
    copy_bytes(data.data() + sizeof report, finished_.data(), finished_.size() * sizeof(std::int64_t));
    send(0, tag, data.data(), data.size());
    finished_.clear();
    result_ = {};
  }

  std::mutex mutex_;
  std::deque<std::int64_t> orders_;
  bool ended_ = false;
  std::int64_t wanted_ = 1;
  Clock::time_point asked_ = Clock::now();
  std::vector<std::int64_t> finished_;
  SweepResult result_;
  std::exception_ptr problem_;
};

class MpiWorld final : public World {
 public:
  MpiWorld() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (provided < MPI_THREAD_SERIALIZED) throw CannotStart("this MPI supports only programs of one thread");
    if (size_ < processes_of_environment())
      throw CannotStart(
          fmt::format("{} processes were started, but MPI knows of {}: start them with the mpirun of the MPI "
                      "that this program was built with, or with srun --mpi=pmix",
                      processes_of_environment(), size_));
  }
  MpiWorld(const MpiWorld&) = delete;
  MpiWorld& operator=(const MpiWorld&) = delete;
  ~MpiWorld() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void lead(const accuracy::SweepIdentity& identity, const accuracy::StreamSource& source, int threads,
            accuracy::SweepState& state, const std::atomic<bool>& stop,
            const std::function<void(const accuracy::SweepState&)>& progress) override {
    accuracy::OwnBlocks blocks(identity.task, state, stop, progress);
    // Only this thread sends and receives messages, so the blocks of rank 0 are computed by another thread.
    std::thread own([&] { accuracy::work(identity.task, source, threads, blocks); });
    listen(&blocks, accuracy::to_text(identity));
    own.join();
    blocks.end();
  }

  void dismiss() override { listen(nullptr, ""); }

  void serve(const accuracy::SweepTask& task, const std::function<accuracy::StreamSource()>& source,
             int threads) override {
    RemoteBlocks blocks;
    try {
      const accuracy::StreamSource own = source();
      send(0, kHello, accuracy::to_text(accuracy::identity_of(task, own.info)));
      accuracy::work(task, own, threads, blocks);
      blocks.end();
    } catch (const std::exception& problem) {
      send(0, kProblem, problem.what());
      return;
    }
    send(0, kProblem, "");
  }

 private:
  // Answers requests until every other rank has sent its final message, which states a problem or is empty.
  // If `blocks` is null, the answers contain no blocks, so that the other ranks end.
  void listen(accuracy::OwnBlocks* blocks, const std::string& identity) {
    for (int left = size_ - 1; left > 0;) {
      MPI_Status status;
      int there = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
      if (there == 0) {
        std::this_thread::sleep_for(kBetweenLooks);  // blocking MPI calls would keep a core busy
        continue;
      }
      const std::vector<char> data = receive(status);
      const int rank = status.MPI_SOURCE;
      const auto fails = [&](const std::string& why) {
        if (blocks != nullptr)
          blocks->fail(
              std::make_exception_ptr(CannotStart(fmt::format("process {} of {}: {}", rank, size_, why))));
      };
      const std::string text(data.begin(), data.end());
      switch (status.MPI_TAG) {
        case kHello:
          if (text != identity)
            fails(fmt::format("another implementation or version of it: {}, not {}", text, identity));
          break;
        case kProblem:
          --left;
          if (!text.empty()) fails(text);
          break;
        default:
          take(rank, status.MPI_TAG == kReport, data, blocks);
      }
    }
  }

  static void take(int rank, bool wants_more, const std::vector<char>& data, accuracy::OwnBlocks* blocks) {
    Report report;
    copy_bytes(&report, data.data(), sizeof report);
    std::vector<std::int64_t> finished(static_cast<std::size_t>(report.finished)), orders;
    copy_bytes(finished.data(), data.data() + sizeof report, finished.size() * sizeof(std::int64_t));
    try {
      if (blocks != nullptr && !finished.empty()) blocks->finish(finished, report.result);
    } catch (...) {  // the checkpoint cannot be written
      blocks->fail(std::current_exception());
    }
    if (!wants_more) return;
    while (blocks != nullptr && static_cast<std::int64_t>(orders.size()) < report.wanted) {
      const auto block = blocks->next();
      if (!block) break;
      orders.push_back(*block);
    }
    send(rank, kOrders, orders.data(), orders.size() * sizeof(std::int64_t));
  }

  int rank_ = 0, size_ = 1;
};

[[maybe_unused]] const bool kRegistered = [] {
  join_world = [] { return std::unique_ptr<World>(std::make_unique<MpiWorld>()); };
  return true;
}();

}  // namespace
}  // namespace evalcts::cli
