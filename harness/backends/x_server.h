// An X server of this process's own, for machines without one.
#pragma once

#include <sys/types.h>

#include <string>

namespace evalcts {

// Xvfb, found in PATH, on the first display that is free, with indirect GLX. It ends with this object, with
// its last client, and with the thread that made it, however that ends and whatever has become of the server:
// neither process nor socket is left behind.
class XServer {
 public:
  // `preload`: a library that the server loads before its own; empty: none. Returns once clients can connect.
  // Throws CannotStart.
  explicit XServer(const std::string& preload);
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  // For XOpenDisplay: ":1".
  const std::string& display() const { return display_; }

 private:
  std::string end();

  pid_t guardian_ = -1;
  int log_ = -1;
  int* number_ = nullptr;  // of the display; shared with the guardian
  std::string display_;
};

}  // namespace evalcts
