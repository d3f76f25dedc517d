// Shader programs of captures: made in the prologue of a case, or kept by a context that several cases share.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/player.h>

namespace evalcts {

struct ProgramSource {
  std::string vertex;                                          // GLSL
  std::string fragment = {};                                   // GLSL; empty: no fragment shader
  std::vector<std::string> varyings = {};                      // recorded by transform feedback, interleaved
  std::vector<std::pair<GLuint, std::string>> locations = {};  // generic attributes, bound before linking
};

// A program that a case makes and uses.
class UsedProgram {
 public:
  // Appends to `prologue` the commands that make the program, unless `context` has kept it, and UseProgram.
  // `context` must outlive the object.
  UsedProgram(gl::Case& prologue, Context& context, const ProgramSource& source);

  // Must be called after the case. Throws NotObservable if the program does not link; otherwise the context
  // keeps it.
  void require_linked(const gl::Trace& trace) const;

 private:
  Context& context_;
  std::string key_;
  std::optional<gl::Ref> made_, linked_;  // null if it was kept
};

}  // namespace evalcts
