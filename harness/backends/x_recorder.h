// Records the requests that an X client sends to its server.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace evalcts {

// A proxy for one connection to a server on this machine. A thread forwards all bytes and file descriptors in
// both directions until either side closes the connection, and then closes the other.
class XRecorder {
 public:
  // `server`: the display of the server, such as ":1" or "unix:1.0". Throws CannotStart if the name has
  // another form, or no socket can be made for the client.
  explicit XRecorder(const std::string& server);
  ~XRecorder();
  XRecorder(const XRecorder&) = delete;
  XRecorder& operator=(const XRecorder&) = delete;

  // Returns the display name for XOpenDisplay, which may be used once.
  const std::string& display() const { return display_; }

  // Starts to record. Must be called when the server has answered the last request (XSync), so that the first
  // recorded byte begins a request.
  void record();
  // Stops recording and returns the complete requests of the extension with this major opcode (X11 protocol,
  // section 1 and BIG-REQUESTS). Must be called after XSync as well.
  std::vector<unsigned char> take(unsigned char major_opcode);

 private:
  class Pump;
  std::unique_ptr<Pump> pump_;
  std::string display_;
};

}  // namespace evalcts
