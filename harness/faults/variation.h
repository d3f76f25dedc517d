// Defines variations, the inverse of faults. A variation makes an implementation differ from those that the
// suite was developed with, in a way that the specification permits or that does not concern evaluators. No
// test may fail on a variation, and tests must detect faults behind a variation if they are visible.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/table.h>

namespace evalcts::variations {

// The parts of an implementation that a variation may change. Entry points are plain functions: a variation
// sets lambdas without a capture, which call `unvaried`.
struct Varied {
  gl::Table& gl;
  void (*emitted)(std::vector<ObservedPrimitive>&) = nullptr;  // for implementations with a sink
  bool one_state = false;                                      // there is one context, which keeps its state
};

struct Variation {
  std::string_view name;
  std::string_view implementation;  // the implementation that is varied
  std::string_view what;            // the difference, in words
  std::string_view violates;        // violated requirements, separated by blanks; mostly empty
  void (*vary)(Varied&);
};

// The entry points without the variation.
inline gl::Table unvaried;

// State of the context that the wrappers of the active variation remember, with its initial values.
struct Remembered {
  GLfloat* feedback = nullptr;
  GLsizei feedback_size = 0;
  bool inside = false;         // between Begin and End
  bool compiling = false;      // between NewList and EndList
  GLenum error = GL_NO_ERROR;  // pending error that the variation itself raised
  std::uint32_t random = 1;
};
inline Remembered remembered;

// Returns all variations, sorted by name.
const std::vector<Variation>& all_variations();

// Returns the implementation with the variation. Throws CannotStart if there is no such variation.
std::unique_ptr<Implementation> with_variation(std::unique_ptr<Implementation> inner, std::string_view name);

struct VariationRegistration {
  explicit VariationRegistration(const Variation& variation);
};

// Defines and registers a variation:
// EVALCTS_VARIATION(NoLists, "dropin", "there are no display lists", "") { v.gl.NewList = nullptr; }
#define EVALCTS_VARIATION(name, implementation, what, violates)                  \
  static void name(::evalcts::variations::Varied& v);                            \
  static const ::evalcts::variations::VariationRegistration name##_registration{ \
      {#name, implementation, what, violates, name}};                            \
  static void name(::evalcts::variations::Varied& v)

}  // namespace evalcts::variations
