// Makes cases that are sequences of commands (INTERPRETING.md, "Sequences").
#pragma once

#include <evalcts/gl/case.h>

#include <stdexcept>

#include "document.h"

namespace evalcts::vectors {

// The case has no form in the vectors.
struct HasNoForm : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the first commands of a case, so that the steps of their sequence have about `most_bytes` bytes of
// JSON text. Commands of other parts of the GL are left out. The case ends outside of primitives and display
// lists, behind the first error, vertex and call of a list that it has, even if that takes more bytes, and
// before the first command without a form: one that makes another context, with a texture unit above 7, with
// an answer beyond binary32, or with an array that vectors do not have. Throws HasNoForm if it cannot end.
gl::Case cut_off(const gl::Case& script, std::size_t most_bytes);

// Returns {"level", "since", "steps": [...]}: each command with the errors that it may raise, its answers and
// the primitives that it emits, by the executable specification. GetError is left out, because the replay of
// a sequence asks for errors after each step. Vertices have the attributes that the case sets or evaluates.
// `script`: a result of cut_off().
Json sequence(const gl::Case& script);

}  // namespace evalcts::vectors
