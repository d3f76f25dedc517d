// What the drop-in library knows of a context of the GL below: its evaluators, and what it must follow of the
// rest to leave the current values alone and display lists in order.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include <glevaluator.h>

#include "gl_below.h"
#include "lists.h"

// In front of what programs call.
#define DROPIN_EXPORT extern "C" __attribute__((visibility("default")))

namespace glev::dropin {

// What the program has done once, in any thread.
class Once {
 public:
  void Note() {
    if (!*this) noted_.store(true, std::memory_order_relaxed);
  }
  explicit operator bool() const { return noted_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> noted_{false};
};
// A command of evaluators: until then lists are left to the driver wherever possible.
inline Once evaluators_used;
// NewList.
inline Once lists_used;
// ListBase: until then it is 0.
inline Once list_base_used;

class Context {
 public:
  enum class Kind {
    kUnknown,
    kEvaluators,  // all but the following
    kRemoved,     // core profile or forward-compatible: the GL has no evaluators any more
    kForeign      // OpenGL ES
  };

  static Context* Create(Group* group);
  void Destroy();

  Kind kind = Kind::kUnknown;
  int version = 0;  // 45: 4.5
  bool no_error = false;
  bool multitexture = false;
  bool vertex_programs = false;

  Group* group = nullptr;
  glev_context* evaluators = nullptr;
  std::uint32_t enabled = 0;  // a bit for each map and AUTO_NORMAL
  bool out_of_memory = false;

  // False: certainly not between Begin and End.
  bool maybe_inside = false;
  // Between Begin and End: `current` is what the GL has.
  bool tracking = false;
  Setter current[kAttributeCount];
  bool keeps_length = false;  // of automatic normals: a vertex shader is active
  bool in_mesh = false;
  int emitting = 0;  // dimension of the maps that are being evaluated

  // Whether that group of the attribute stack is one of the evaluators', by depth.
  bool pushed[64] = {};
  bool list_base_known = true;
  GLuint list_base = 0;
  OpenList list;
  int list_depth = 0;

  void Identify();

  // Errors arise in the GL below, so that its GetError answers for both.
  void RaiseError(GLenum error);
  // Hands on what the evaluators have recorded.
  void Report();
  // False, and INVALID_OPERATION, between Begin and End.
  bool IsOutside();

  GLint Integer(GLenum pname, GLint otherwise);

  // What commands do when they are executed.
  // --- state.cpp
  void UpdateEnabled();
  bool HasVertexMap() const;
  void SetEnabled(GLenum cap, bool on);
  template <class Real>
  void Map1(GLenum target, Real u1, Real u2, GLint stride, GLint order, const Real* points);
  template <class Real>
  void Map2(GLenum target, Real u1, Real u2, GLint ustride, GLint uorder, Real v1, Real v2, GLint vstride,
            GLint vorder, const Real* points);
  void MapGrid1(GLint n, double u1, double u2);
  void MapGrid2(GLint un, double u1, double u2, GLint vn, double v1, double v2);
  void PushAttrib(GLbitfield mask);
  void PopAttrib();
  void CopyEvalAttributes(const Context& from, bool grids);

  // --- evaluation.cpp
  // To be called before Begin: queries what evaluation between Begin and End is going to change.
  void BeforePrimitive();
  void EvalCoord1(double u);
  void EvalCoord2(double u, double v);
  void EvalPoint1(GLint i);
  void EvalPoint2(GLint i, GLint j);
  void EvalMesh1(GLenum mode, GLint i1, GLint i2);
  void EvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);

  // --- lists.cpp
  // Executes the operation, or makes it part of the list that is open, or both.
  template <class Operation>
  void Issue(const Operation& operation) {
    if (!list.open) return operation(*this, nullptr);
    if (BeginRecording()) EndRecording(list.code.Append(operation) != nullptr);
  }
  // The same for one that needs a copy of `bytes` bytes: written by copy(unsigned char*).
  template <class Operation, class Copy>
  void IssueWith(const Operation& operation, std::size_t bytes, const Copy& copy) {
    if (!BeginRecording()) return;
    unsigned char* const room = list.code.Append(operation, bytes);
    if (room != nullptr) copy(room);
    EndRecording(room != nullptr);
  }
  void NewList(GLuint name, GLenum mode);
  void EndList();
  void CallList(GLuint name);
  void CallLists(GLsizei n, GLenum type, const void* lists);
  void IssueCallList(GLuint name);
  void IssueCallLists(GLsizei n, GLenum type, const void* lists);
  void DeleteLists(GLuint first, GLsizei range);
  void IssuePushAttrib(GLbitfield mask);
  void IssuePopAttrib();
  void IssueBegin(GLenum mode);
  void Begin(GLenum mode);
  void End();
  void RunSegment(GLuint name, const Summary* summary);
  // Whether the GL executes what is being compiled.
  bool Executes() const { return !list.open || (list.mode != GL_COMPILE && !list.deferring); }
  void Note(Attribute attribute, const Setter& setter) {
    if (tracking && Executes()) current[attribute] = setter;
    if (list.open) list.summary.last[attribute] = setter;
  }
  bool IsWatching() const { return tracking || list.open; }

 private:
  Context() = default;
  static void OnBegin(void* user, glev_enum mode);
  static void OnVertex(void* user, const glev_vertex* vertex);
  static void OnEnd(void* user);
  void Snapshot();
  void Restore(int dimension);
  void MeshByPoints(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);
  void EvaluatePoint2(GLint i, GLint j);
  void SetActiveTexture();
  bool PrepareEvaluation(int dimension);
  // --- shader_normals.cpp
  bool VertexShaderIsActive();
  double LengthOfNormal(const glev_batch* batch, const glev_mesh* mesh);

  bool BeginRecording();
  void EndRecording(bool recorded);
  void CloseSegment();
  void OpenSegment();
  void FollowStack(const Summary& summary, GLint depth);
  void BeginDeferral();
  void EndDeferral();

  double normal_length_ = 1;  // of the next vertex, see keeps_length
};

// The context that is current in this thread, if its GL has evaluators.
Context* Current();
// The same, whatever it has; null where none is current.
Context* CurrentOfAnyKind();

}  // namespace glev::dropin
