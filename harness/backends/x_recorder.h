// Stands between a client and its X server and keeps what the client sends.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace evalcts {

// For one connection to a server on this machine. A thread passes on all bytes and file descriptors, both
// ways, until either side hangs up; the other is hung up on then.
class XRecorder {
 public:
  // `server`: its display, ":1" or "unix:1.0". Throws CannotStart where it is no such name, or no socket can
  // be made for the client.
  explicit XRecorder(const std::string& server);
  ~XRecorder();
  XRecorder(const XRecorder&) = delete;
  XRecorder& operator=(const XRecorder&) = delete;

  // For XOpenDisplay, once.
  const std::string& display() const { return display_; }

  // Keeps what is sent from now on. To be called when the server has answered the last request (XSync): then
  // the first byte kept begins a request.
  void record();
  // The requests since then of the extension with this major opcode, whole (X11 protocol, section 1 and
  // BIG-REQUESTS). Called after XSync, too; nothing is kept any more.
  std::vector<unsigned char> take(unsigned char major_opcode);

 private:
  class Pump;
  std::unique_ptr<Pump> pump_;
  std::string display_;
};

}  // namespace evalcts
