// Prediction of the vertices, answers and errors of a case: the case is run on the executable
// specification, symbolically.
#pragma once

#include <reference/specification.h>

#include <memory>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/player.h>

namespace evalcts {

struct Prediction {
  std::vector<reference::Primitive> primitives;
  GLenum error = GL_NO_ERROR;  // the first error that the case raises

  std::size_t vertex_count() const;
  bool has_nonpositive_w() const;
  // True if a position may come out as infinity or NaN, because the GL promises nothing about its value.
  bool has_positions_beyond_float() const;
  bool has_automatic_normals() const;
  bool has_rational_normals() const;  // automatic ones of a surface whose w is not constant
  bool has_meshes() const;            // true if EvalMesh2 draws any of the primitives
};

// Returns true if the w of the surface is not constant, so that the normal is that of a rational surface.
bool is_rational(const reference::AutomaticNormal& normal);

// The treatment of Enable, Disable, IsEnabled and Get with names of state that the executable specification
// does not have, and of maps of the targets of NV_vertex_program. An error that GetError asks for behind such
// a command is always predicted, because it is then intended.
enum class OtherState {
  kRejected,  // the specification raises INVALID_ENUM
  kSkipped    // they belong to other parts of the GL, and nothing is predicted of them
};

// Returns for each command of the case whether the executable specification has it. Commands of other parts
// of the GL (pixel store, buffers, matrices) are never known. Throws std::invalid_argument for a case of
// several contexts.
std::vector<bool> specified_commands(const gl::Case& script, OtherState other);
// Returns the case with these commands only, without other state. No command may use the result of one that
// is left out.
gl::Case only_specified(const gl::Case& script);

// Predicts the primitives and the first error of a case, from its specified_commands() with kRejected.
Prediction predict(const gl::Case& script, int max_eval_order);

// Returns true if a command of the case raises an error according to the specification. Also returns true for
// a case with several contexts, because the specification has only one.
bool may_raise_an_error(const gl::Case& script, int max_eval_order);

// The complete result of a case on the executable specification.
struct Specified {
  Prediction prediction;
  std::vector<bool> known;  // specified_commands(); nothing is predicted of other commands
  gl::Trace answers;        // answers of the commands; queried values are correctly rounded
  // The permitted answers of each query, see reference::Specification.
  std::vector<std::vector<reference::PermittedValue>> permitted;
  std::vector<std::vector<GLenum>> errors;  // errors that each command may raise; empty for most commands
  // Answers that each GetError may give, the likeliest first; empty for other commands. Distributed
  // implementations may keep several errors until they are queried (GL 2.1 section 2.5).
  std::vector<std::vector<GLenum>> error_answers;
  std::vector<std::size_t> completed;  // number of complete primitives after each command
  std::vector<bool> inside;            // true if a primitive is open after the command
};

// The texture units that a case may use, see reference::Specification::Options.
struct TextureUnits {
  int with_coordinates = reference::kTextureUnits, active = reference::kTextureUnits;
};
enum class Emission {
  kPredicted,
  kLeftOut  // the primitives of the prediction have no vertices: long meshes take most of the memory
};
// Runs the specified_commands() of the case on the specification.
Specified specify(const gl::Case& script, int max_eval_order, TextureUnits units = {},
                  OtherState other = OtherState::kRejected, Emission emission = Emission::kPredicted);

// A context of the specification that runs commands one by one.
class SpecifiedContext {
 public:
  explicit SpecifiedContext(int max_eval_order);
  ~SpecifiedContext();
  SpecifiedContext(const SpecifiedContext&) = delete;
  SpecifiedContext& operator=(const SpecifiedContext&) = delete;

  // Runs a command that the specification has. Returns true if it raises no error.
  bool accepts(const gl::Command& command);

 private:
  std::unique_ptr<reference::Specification> specification_;
};

// Returns a case that draws the predicted primitives with explicit vertices: all values correctly rounded,
// and colour, normal and texture coordinates of unit 0 before each vertex. Evaluation must have the same
// effect (EV-COORD-ASIF), up to the accuracy rule.
gl::Case as_explicit_commands(const Prediction& prediction);

}  // namespace evalcts
