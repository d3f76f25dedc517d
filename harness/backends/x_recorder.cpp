// Implements XRecorder: a thread that passes bytes and file descriptors between the sockets of the client and
// the server.
#include "x_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <evalcts/backends/implementation.h>

namespace evalcts {
namespace {

constexpr int kFirstNumber = 1000, kNumbers = 1000;  // far from the display numbers that servers use
constexpr std::size_t kMostDescriptors = 32;         // in one message; Xlib and servers send fewer

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  explicit operator bool() const { return number_ >= 0; }
  int get() const { return number_; }

 private:
  int number_;
};

// Returns the path of a server's socket. Xlib finds a server by its number, and some versions of Xlib look
// only in the file system.
std::string socket_of(int number) { return "/tmp/.X11-unix/X" + std::to_string(number); }

Descriptor new_socket() { return Descriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)); }

// Fills in a socket address. A leading '@' of the name stands for the null byte of an abstract address.
bool fill_in(sockaddr_un& address, socklen_t& length, const std::string& name) {
  address = {};
  address.sun_family = AF_UNIX;
  if (name.size() >= sizeof address.sun_path) return false;
  std::memcpy(address.sun_path, name.data(), name.size());
  if (name.front() == '@') address.sun_path[0] = '\0';
  length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (name.front() != '@'));
  return true;
}

Descriptor connect_to(const std::string& name) {
  Descriptor connection = new_socket();
  sockaddr_un address;
  socklen_t length = 0;
  if (connection && fill_in(address, length, name) &&
      connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), length) == 0)
    return connection;
  return Descriptor();
}

}  // namespace

class XRecorder::Pump {
 public:
  explicit Pump(std::string server_socket) : server_socket_(std::move(server_socket)) {
    wake_ = Descriptor(eventfd(0, EFD_CLOEXEC));
    listener_ = new_socket();
    if (!wake_ || !listener_) fail();
    sockaddr_un address;
    socklen_t length = 0;
    for (int number = kFirstNumber; number_ < 0; ++number) {
      if (number >= kFirstNumber + kNumbers || !fill_in(address, length, socket_of(number))) fail();
      if (bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), length) == 0) {
        number_ = number;
        has_socket_ = true;
      } else if (errno != EADDRINUSE) {
        fail();
      }
    }
    if (listen(listener_.get(), 1) != 0) {
      remove_socket();
      fail();
    }
    // The threads of the suite handle signals, so this thread blocks them.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  ~Pump() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = write(wake_.get(), &one, sizeof one);
    thread_.join();
    remove_socket();
  }
  Pump(const Pump&) = delete;
  Pump& operator=(const Pump&) = delete;

  std::string display() const { return ":" + std::to_string(number_); }

  void record() {
    const std::lock_guard lock(mutex_);
    kept_.emplace();
  }

  std::vector<unsigned char> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(kept_, std::nullopt).value_or(std::vector<unsigned char>());
  }

 private:
  [[noreturn]] static void fail() {
    throw CannotStart(
        fmt::format("cannot create a socket for a recorded connection: {}", std::strerror(errno)));
  }

  void remove_socket() {
    if (has_socket_.exchange(false)) unlink(socket_of(number_).c_str());
  }

  // Waits until there is something to read. Returns false when the thread must end.
  bool wait_for(std::array<pollfd, 3>& events, nfds_t count) const {
    events[0] = {wake_.get(), POLLIN, 0};
    while (poll(events.data(), count, -1) < 0)
      if (errno != EINTR) return false;
    return events[0].revents == 0;
  }

  void run() {
    std::array<pollfd, 3> events{};
    events[1] = {listener_.get(), POLLIN, 0};
    if (!wait_for(events, 2)) return;
    const Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    listener_ = Descriptor();
    remove_socket();
    // The abstract address is tried first, as in Xlib.
    Descriptor server = connect_to("@" + server_socket_);
    if (!server) server = connect_to(server_socket_);
    if (!client || !server) return;
    while (true) {
      events[1] = {client.get(), POLLIN, 0};
      events[2] = {server.get(), POLLIN, 0};
      if (!wait_for(events, 3)) return;
      if (events[1].revents && !pass_on(client.get(), server.get(), true)) return;
      if (events[2].revents && !pass_on(server.get(), client.get(), false)) return;
    }
  }

  // Forwards the available bytes with their file descriptors. Returns false if a side has closed the
  // connection.
  bool pass_on(int from, int to, bool keep) {
    std::array<unsigned char, 1 << 16> data;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> control;
    iovec part{data.data(), data.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    ssize_t length = 0;
    do length = recvmsg(from, &message, MSG_CMSG_CLOEXEC);
    while (length < 0 && errno == EINTR);
    if (length <= 0) return false;
    std::vector<Descriptor> passed;
    for (cmsghdr* header = CMSG_FIRSTHDR(&message); header; header = CMSG_NXTHDR(&message, header)) {
      if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS) continue;
      for (std::size_t i = 0; i < (header->cmsg_len - CMSG_LEN(0)) / sizeof(int); ++i) {
        int number = -1;
        std::memcpy(&number, CMSG_DATA(header) + i * sizeof number, sizeof number);
        passed.emplace_back(number);
      }
    }
    if (keep) {
      const std::lock_guard lock(mutex_);
      if (kept_) kept_->insert(kept_->end(), data.data(), data.data() + length);
    }
    if (passed.empty()) {
      message.msg_control = nullptr;
      message.msg_controllen = 0;
    }
    for (std::size_t sent = 0; sent < static_cast<std::size_t>(length);) {
      part = {data.data() + sent, static_cast<std::size_t>(length) - sent};
      const ssize_t now = sendmsg(to, &message, MSG_NOSIGNAL);
      if (now < 0 && errno == EINTR) continue;
      if (now < 0) return false;
      sent += static_cast<std::size_t>(now);
      message.msg_control = nullptr;  // descriptors are sent only once
      message.msg_controllen = 0;
    }
    return true;
  }

  std::string server_socket_;
  int number_ = -1;
  std::atomic<bool> has_socket_ = false;
  Descriptor wake_, listener_;
  std::mutex mutex_;
  std::optional<std::vector<unsigned char>> kept_;
  std::thread thread_;
};

XRecorder::XRecorder(const std::string& server) {
  // Accepted forms are ":1", "unix:1" and ":1.0".
  const std::size_t colon = server.starts_with("unix:") ? 4 : 0;
  int number = -1;
  const char* const end = server.data() + server.size();
  const auto [after, error] =
      std::from_chars(server.data() + std::min(colon + 1, server.size()), end, number);
  if (server[colon] != ':' || error != std::errc() || number < 0 || (after != end && *after != '.'))
    throw CannotStart(fmt::format("display {} is not a display of this machine", server));
  pump_ = std::make_unique<Pump>(socket_of(number));
  display_ = pump_->display();
}

XRecorder::~XRecorder() = default;

void XRecorder::record() { pump_->record(); }

std::vector<unsigned char> XRecorder::take(unsigned char major_opcode) {
  const std::vector<unsigned char> all = pump_->take();
  std::vector<unsigned char> chosen;
  for (std::size_t at = 0; at + 4 <= all.size();) {
    std::uint16_t words = 0;
    std::uint32_t large = 0;
    std::memcpy(&words, &all[at + 2], sizeof words);
    if (words == 0 && at + 8 <= all.size()) std::memcpy(&large, &all[at + 4], sizeof large);
    const std::size_t length = 4 * static_cast<std::size_t>(words ? words : large);
    if (length < 4 || length > all.size() - at) break;
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(at);
    if (all[at] == major_opcode)
      chosen.insert(chosen.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    at += length;
  }
  return chosen;
}

}  // namespace evalcts
