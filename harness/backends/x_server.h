// Starts an X server for this process, on machines without one.
#pragma once

#include <sys/types.h>

#include <string>

namespace evalcts {

// Runs Xvfb from PATH on the first free display, with indirect GLX. The server ends with this object, with
// its last client, or with the thread that started it, however that thread ends. Neither process nor socket
// is left behind, even if the server hangs.
class XServer {
 public:
  // `preload`: a library that the server loads before its own; empty: none. Returns when clients can connect.
  // Throws CannotStart.
  explicit XServer(const std::string& preload);
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  // Returns the display name for XOpenDisplay, such as ":1".
  const std::string& display() const { return display_; }

 private:
  std::string end();

  pid_t guardian_ = -1;
  int log_ = -1;
  int* number_ = nullptr;  // number of the display; shared with the guardian
  std::string display_;
};

}  // namespace evalcts
