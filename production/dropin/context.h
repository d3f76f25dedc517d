// The state that the drop-in library keeps for a context of the GL below: its evaluators, and the state that
// it must track to preserve the current values and the order of display lists.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <glevaluator.h>

#include "gl_below.h"
#include "lists.h"

// Marks the functions that programs call.
#define DROPIN_EXPORT extern "C" __attribute__((visibility("default")))

namespace glev::dropin {

// A flag that is set once the program has done something, in any thread.
class Once {
 public:
  void note() {
    if (!*this) noted_.store(true, std::memory_order_relaxed);
  }
  explicit operator bool() const { return noted_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> noted_{false};
};
// Set by the first command of evaluators. Until then, display lists are left to the driver if possible.
inline Once evaluators_used;
// Set by NewList.
inline Once lists_used;
// Set by ListBase. Until then, the list base is 0.
inline Once list_base_used;

// The arguments of Map in one direction.
template <class Real>
struct MapDirection {
  Real first, last;
  GLint stride, order;
};
// u and v. One-dimensional maps do not use v, which has order 1.
template <class Real>
using MapDirections = std::array<MapDirection<Real>, 2>;

class Context {
 public:
  enum class Kind {
    kUnknown,
    kEvaluators,  // the GL has evaluators
    kRemoved,     // core profile or forward-compatible: evaluators were removed
    kForeign      // OpenGL ES
  };

  static Context* create(Group* group);
  void destroy();

  Kind kind = Kind::kUnknown;
  int version = 0;  // 45 for version 4.5
  bool no_error = false;
  bool multitexture = false;
  bool vertex_programs = false;

  Group* group = nullptr;
  glev_context* evaluators = nullptr;
  std::uint32_t enabled = 0;  // a bit for each map and AUTO_NORMAL
  bool out_of_memory = false;

  // False if the context is certainly not between Begin and End.
  bool maybe_inside = false;
  // True if `current` holds the current values of the GL, between Begin and End.
  bool tracking = false;
  Setter current[kAttributeCount];
  bool keeps_length = false;  // automatic normals are not normalised, because a vertex shader is active
  bool in_mesh = false;
  int emitting = 0;  // dimension of the maps that are being evaluated

  // For each depth of the attribute stack, true if the entry was pushed to the stack of `evaluators`, too.
  bool pushed[64] = {};
  bool list_base_known = true;
  GLuint list_base = 0;
  OpenList list;
  int list_depth = 0;

  void identify();

  // Raises an error in the GL below, so that its GetError returns the errors of both.
  void raise_error(GLenum error);
  // Passes on the error that the evaluators have recorded.
  void report();
  // Returns true outside Begin/End. Otherwise raises INVALID_OPERATION and returns false.
  bool is_outside();

  GLint get_integer(GLenum pname, GLint otherwise);

  // The functions below execute commands. --- state.cpp
  void update_enabled();
  bool has_vertex_map() const;
  void set_enabled(GLenum cap, bool on);
  template <class Real>
  void map(int dimension, GLenum target, const MapDirections<Real>& directions, const Real* points);
  void map_grid1(GLint n, double u1, double u2);
  void map_grid2(GLint un, double u1, double u2, GLint vn, double v1, double v2);
  void push_attrib(GLbitfield mask);
  void pop_attrib();
  void copy_eval_attributes(const Context& from, bool grids);

  // --- evaluation.cpp Must be called before Begin. Queries the state that evaluation between Begin and End
  // changes.
  void before_primitive();
  void eval_coord(int dimension, double u, double v);
  void eval_point(int dimension, GLint i, GLint j);
  void eval_mesh1(GLenum mode, GLint i1, GLint i2);
  void eval_mesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);

  // --- lists.cpp Executes the operation, appends it to the open list, or both.
  template <class Operation>
  void issue(const Operation& operation) {
    if (!list.open) return operation(*this, nullptr);
    if (begin_recording()) end_recording(list.code.append(operation) != nullptr);
  }
  // The same for an operation that needs a copy of `bytes` bytes, which copy(unsigned char*) writes. Requires
  // an open list.
  template <class Operation, class Copy>
  void issue_with(const Operation& operation, std::size_t bytes, const Copy& copy) {
    if (!begin_recording()) return;
    unsigned char* const room = list.code.append(operation, bytes);
    if (room != nullptr) copy(room);
    end_recording(room != nullptr);
  }
  void new_list(GLuint name, GLenum mode);
  void end_list();
  void call_list(GLuint name);
  void call_lists(GLsizei n, GLenum type, const void* lists);
  void issue_call_list(GLuint name);
  void issue_call_lists(GLsizei n, GLenum type, const void* lists);
  void delete_lists(GLuint first, GLsizei range);
  void issue_push_attrib(GLbitfield mask);
  void issue_pop_attrib();
  void issue_begin(GLenum mode);
  void begin(GLenum mode);
  void end();
  void run_segment(GLuint name, const Summary* summary);
  // Returns true if the GL executes the commands that are being compiled.
  bool executes() const { return !list.open || (list.mode != GL_COMPILE && !list.deferring); }
  void note(Attribute attribute, const Setter& setter) {
    if (tracking && executes()) current[attribute] = setter;
    if (list.open) list.summary.last[attribute] = setter;
  }
  bool is_watching() const { return tracking || list.open; }

 private:
  Context() = default;
  static void on_begin(void* user, glev_enum mode);
  static void on_vertex(void* user, const glev_vertex* vertex);
  static void on_end(void* user);
  void take_snapshot();
  void restore(int dimension);
  void mesh_by_points(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);
  void evaluate_point2(GLint i, GLint j);
  void set_active_texture();
  bool prepare_evaluation(int dimension);
  void finish_evaluation(int dimension);
  template <class Draw>
  void draw_mesh(int dimension, const Draw& draw);
  // --- shader_normals.cpp
  bool is_vertex_shader_active();
  double length_of_normal(const glev_batch* batch, const glev_mesh* mesh);

  bool begin_recording();
  void end_recording(bool recorded);
  void close_segment();
  void open_segment();
  void follow_stack(const Summary& summary, GLint depth);
  void begin_deferral();
  void end_deferral();

  double normal_length_ = 1;  // length of the normal of the next vertex, see keeps_length
};

// Returns the current context of this thread if its GL has evaluators, otherwise null.
Context* current_context();
// Returns the current context of this thread; null if there is none.
Context* current_context_of_any_kind();

}  // namespace glev::dropin
