// Makes a framebuffer object with renderbuffers for colours, depth and stencil.
#include "framebuffer_object.h"

#include <fmt/format.h>

#include <string>

#include "context_maker.h"

namespace evalcts {

void FramebufferObject::bind(const std::function<void*(const char*)>& address_of) {
  const auto find = [&](const std::string& name) {
    void* const address = address_of(name.c_str());
    if (!address)
      throw CannotStart(
          fmt::format("{} is missing: a context without a surface needs a framebuffer object", name));
    return address;
  };
  if (!gl_.GetError) {
#define X(name) gl_.name = reinterpret_cast<decltype(gl_.name)>(find("gl" #name));
    FRAMEBUFFER_COMMANDS(X)
#undef X
  }
  GLuint framebuffer = 0;
  GLuint renderbuffers[2] = {};
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.GenRenderbuffers(2, renderbuffers);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffers[0]);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kFramebufferSide, kFramebufferSide);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffers[1]);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, kFramebufferSide, kFramebufferSide);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, 0);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffers[0]);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderbuffers[1]);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, renderbuffers[1]);
  gl_.DrawBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.Viewport(0, 0, kFramebufferSide, kFramebufferSide);
  gl_.Scissor(0, 0, kFramebufferSide, kFramebufferSide);
  const GLenum status = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER);
  const GLenum error = gl_.GetError();
  if (status != GL_FRAMEBUFFER_COMPLETE || error != GL_NO_ERROR)
    throw CannotStart(fmt::format("the framebuffer object is not complete (status 0x{:04X}, error 0x{:04X})",
                                  status, error));
}

}  // namespace evalcts
