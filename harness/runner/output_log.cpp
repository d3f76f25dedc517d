// Implements OutputLog: copies the output to the log line by line, up to a limit for each test.
#include <evalcts/runner/output_log.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <evalcts/results/files.h>

namespace evalcts {
namespace {

constexpr char kTestBegins[] = "[ RUN      ] ";
constexpr std::size_t kLongestLine = 4096;    // longer lines are split
constexpr std::size_t kMostAtOnce = 1 << 20;  // bytes per call of take(), so that it returns

}  // namespace

OutputLog::OutputLog(const std::filesystem::path& log) {
  std::array<int, 2> ends{};
  log_ = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log_ < 0 || pipe2(ends.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    if (log_ >= 0) close(log_);
    throw CannotWrite(fmt::format("cannot write '{}': {}", log.string(), std::strerror(error)));
  }
  reader_ = ends[0];
  writer_ = ends[1];
  fcntl(reader_, F_SETFL, O_NONBLOCK);
}

OutputLog::~OutputLog() {
  for (const int descriptor : {reader_, writer_, log_})
    if (descriptor >= 0) close(descriptor);
}

void OutputLog::close_writer() {
  if (writer_ >= 0) close(writer_);
  writer_ = -1;
}

void OutputLog::take() {
  std::array<char, 65536> bytes{};
  for (std::size_t taken = 0; reader_ >= 0 && taken < kMostAtOnce;) {
    const ssize_t count = read(reader_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;
    if (count == 0) {
      close(reader_);
      reader_ = -1;
      return;
    }
    taken += static_cast<std::size_t>(count);
    partial_.append(bytes.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end; (end = partial_.find('\n', begin)) != std::string::npos; begin = end + 1)
      take_line(partial_.substr(begin, end + 1 - begin));
    partial_.erase(0, begin);
    if (partial_.size() > kLongestLine) take_line(std::exchange(partial_, {}));
  }
}

void OutputLog::finish() {
  take();
  if (!partial_.empty()) take_line(std::exchange(partial_, {}));
  say_what_is_left_out();
  flush();
}

void OutputLog::take_line(const std::string& line) {
  // GoogleTest's text need not be at the start of the line, because a library may print an
  // incomplete line before.
  if (const std::size_t test = line.find(kTestBegins); test != std::string::npos) {
    say_what_is_left_out();
    flush();
    kept_ = 0;
  }
  if (first_lines_.size() + line.size() <= kMostRemembered) first_lines_ += line;
  if (left_out_ > 0 || kept_ + line.size() > kMostPrinted) {
    left_out_ += line.size();
    return;
  }
  kept_ += line.size();
  unwritten_ += line;
}

void OutputLog::say_what_is_left_out() {
  if (left_out_ > 0) unwritten_ += fmt::format("evalcts: {} more bytes are omitted here\n", left_out_);
  left_out_ = 0;
}

void OutputLog::flush() {
  for (std::size_t done = 0; done < unwritten_.size();) {
    const ssize_t count = write(log_, unwritten_.data() + done, unwritten_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  unwritten_.clear();
}

}  // namespace evalcts
