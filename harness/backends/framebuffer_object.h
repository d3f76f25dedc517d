// A framebuffer object for contexts whose drawing surface has no usable pixels.
#pragma once

#include <functional>

#include <evalcts/gl/table.h>

namespace evalcts {

// The commands that make it.
// clang-format off
#define FRAMEBUFFER_COMMANDS(X)                                                    \
  X(GenFramebuffers) X(BindFramebuffer) X(GenRenderbuffers) X(BindRenderbuffer)    \
  X(RenderbufferStorage) X(FramebufferRenderbuffer) X(CheckFramebufferStatus)      \
  X(DrawBuffer) X(ReadBuffer) X(Viewport) X(Scissor) X(GetError)
// clang-format on

class FramebufferObject {
 public:
  // Binds a complete framebuffer object of kFramebufferSide squared pixels in the current context, with which
  // it is destroyed. Without a complete one, every Begin raises INVALID_FRAMEBUFFER_OPERATION. Also sets
  // viewport and scissor box, which are empty in a context without a surface. `address_of`: returns the
  // address of a command, or null. Throws CannotStart.
  void bind(const std::function<void*(const char*)>& address_of);

 private:
#define X(name) decltype(&::gl##name) name = nullptr;
  struct Commands {
    FRAMEBUFFER_COMMANDS(X)
  };
#undef X
  Commands gl_;  // null before the first call
};

}  // namespace evalcts
