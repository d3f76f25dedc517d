// What a case must emit: the case played on the executable specification, symbolically.
#pragma once

#include <reference/specification.h>

#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/player.h>

namespace evalcts {

struct Prediction {
  std::vector<reference::Primitive> primitives;
  GLenum error = GL_NO_ERROR;  // the first error that the case raises

  std::size_t vertex_count() const;
  bool has_nonpositive_w() const;
  // Whether a position may come out as infinity or no number: where the GL promises nothing of its value.
  bool has_positions_beyond_float() const;
  bool has_automatic_normals() const;
  bool has_meshes() const;  // of EvalMesh2
};

// Commands that the specification does not have (pixel store, buffers, matrices) do not concern evaluators
// and are left out, in display lists too. No other command may take a result of theirs.
Prediction predict(const gl::Case& script, int max_eval_order);

// Whether a command of the case raises an error, by the specification as far as it has the commands; true,
// too, for a case of several contexts, of which it has one.
bool may_raise_an_error(const gl::Case& script, int max_eval_order);

// All that the executable specification says of a case.
struct Specified {
  Prediction prediction;
  gl::Trace answers;                        // of the commands: each query correctly rounded
  std::vector<std::vector<GLenum>> errors;  // that each command is free to raise; none for most
  std::vector<std::size_t> completed;       // how many primitives are complete after each command
  std::vector<bool> inside;                 // whether one is open after each command
};

// Throws std::logic_error if the specification lacks one of the commands.
Specified specify(const gl::Case& script, int max_eval_order);

// The primitives of the prediction with explicit vertices: each value correctly rounded, colour, normal and
// texture coordinates of unit 0 before each vertex. What evaluation has to be like (EV-COORD-ASIF), up to the
// accuracy rule.
gl::Case as_explicit_commands(const Prediction& prediction);

}  // namespace evalcts
