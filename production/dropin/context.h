// What the drop-in library knows of a context of the GL below: its evaluators, and what it must follow of the
// rest to leave the current values alone and display lists in order.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

#include <glevaluator.h>

#include "production/dropin/array.h"
#include "production/dropin/gl_below.h"

// In front of what programs call.
#define DROPIN_EXPORT extern "C" __attribute__((visibility("default")))

namespace glev::dropin {

class Context;

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

// The current values that maps can stand in for.
enum Attribute { kColor, kNormal, kTexCoord, kAttributeCount };

// How a current value came about, to bring it back by the same command: no conversion is done twice.
struct Setter {
  void (*send)(const void* values);  // null: not known
  alignas(8) unsigned char values[32];

  void Send() const {
    if (send != nullptr) send(values);
  }
};

// What becomes of Begin/End in a list.
enum class Primitive { kUnchanged, kOpen, kClosed };

// What a driver's list does, as far as it matters here. It holds no command of evaluators.
struct Summary {
  Primitive primitive;
  Setter last[kAttributeCount];
  // PopAttrib that match no PushAttrib of the list come first.
  unsigned pops, pushes;
  GLbitfield pushed[16];

  void Reset() { std::memset(static_cast<void*>(this), 0, sizeof *this); }
  bool IsEmpty() const;
};

// Every part of a list begins at a multiple of this.
inline constexpr std::size_t kCodeUnit = 16;
constexpr std::size_t RoundUpToCodeUnit(std::size_t bytes) {
  return (bytes + kCodeUnit - 1) / kCodeUnit * kCodeUnit;
}

// The commands of a display list in order. Where no command of evaluators stands in it, that is one driver's
// list of the same name; else driver's lists of other names, with the commands of evaluators between them.
class Code {
 public:
  // `operation` can be copied as bytes, and is called with a Context& and what stands behind it: `bytes`
  // bytes for the caller to fill. Null without memory.
  template <class Operation>
  unsigned char* Append(const Operation& operation, std::size_t bytes = 0) {
    static_assert(std::is_trivially_copyable_v<Operation> && alignof(Operation) <= kCodeUnit);
    constexpr std::size_t kSize = RoundUpToCodeUnit(sizeof(Operation));
    unsigned char* const place = bytes_.Grow(kHeader + kSize + RoundUpToCodeUnit(bytes));
    if (place == nullptr) return nullptr;
    const Header header = {[](Context& context, const unsigned char* payload) {
                             (*reinterpret_cast<const Operation*>(payload))(context, payload + kSize);
                           },
                           kSize + RoundUpToCodeUnit(bytes)};
    std::memcpy(place, &header, sizeof header);
    new (place + kHeader) Operation(operation);
    return place + kHeader + kSize;
  }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return size() == 0; }
  // What was appended at or after `begin`, a former size().
  void Run(Context& context, std::size_t begin) {
    while (begin < bytes_.size()) {
      Header header;
      std::memcpy(&header, &bytes_[begin], sizeof header);
      header.run(context, &bytes_[begin] + kHeader);
      begin += kHeader + header.size;
    }
  }
  void Swap(Code& other) { bytes_.Swap(other.bytes_); }
  void clear() { bytes_.clear(); }

 private:
  struct Header {
    void (*run)(Context&, const unsigned char* payload);
    std::size_t size;
  };
  static constexpr std::size_t kHeader = RoundUpToCodeUnit(sizeof(Header));

  Array<unsigned char> bytes_;
};

struct List {
  GLuint name = 0;
  unsigned references = 1;
  Primitive primitive = Primitive::kUnchanged;  // lists that it calls included, as they were
  Code code;
  Array<GLuint> segments;  // names of driver's lists that stand for nothing else
};

// The lists of contexts that share them. A list that is not here is the driver's, and does nothing of note.
class Group {
 public:
  static Group* Create();
  void Retain();
  void Release();

  // A list with one more reference; null where there is none.
  List* Find(GLuint name);
  bool IsEmpty();
  void ReleaseList(List* list);
  Primitive PrimitiveOf(GLuint name);
  // Takes the place of the list of that name.
  void Define(List* list);
  void Delete(GLuint first, GLuint last);
  // A name for a driver's list that no program will come upon.
  GLuint NewSegment();
  bool IsSegment(GLuint name);

 private:
  class Lock;
  Group() = default;
  std::size_t LowerBound(GLuint name);
  std::size_t PlaceOfSegment(GLuint name);
  void Drop(List* list);

  unsigned references_ = 1;
  Array<List*> lists_;      // by name
  Array<GLuint> segments_;  // sorted
  GLuint next_segment_ = 0x7e000000;
};

// The list between NewList and EndList.
struct OpenList {
  bool open = false;
  GLuint name = 0;
  GLenum mode = 0;
  GLuint segment = 0;  // the driver's list that is open now
  bool driver_is_open = false;
  bool begins_elsewhere = false;                // its first driver's list has not its name
  Summary summary;                              // of that
  Primitive primitive = Primitive::kUnchanged;  // of all before it
  Code code;
  Array<GLuint> segments;
  // Between Begin and End the GL closes no list, so where a list is executed while it is compiled, its
  // primitives are compiled first, and executed at End.
  bool deferring = false;
  std::size_t deferred = 0;  // where the primitive begins in the code
  std::size_t recorded = 0;  // where the last operation begins
};

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

  // Errors arise in the GL below, so that its GetError answers for both. False, and INVALID_OPERATION there,
  // between Begin and End.
  bool IsOutside();
  void RaiseError(GLenum error);
  // Hands on what the evaluators have recorded.
  void Report();

  GLint Integer(GLenum pname, GLint otherwise);

  // --- evaluation.cpp
  void UpdateEnabled();
  bool HasVertexMap() const;
  // To be called before Begin: queries what evaluation between Begin and End is going to change.
  void BeforePrimitive();
  void SetEnabled(GLenum cap, bool on);
  template <class Real>
  void Map1(GLenum target, Real u1, Real u2, GLint stride, GLint order, const Real* points);
  template <class Real>
  void Map2(GLenum target, Real u1, Real u2, GLint ustride, GLint uorder, Real v1, Real v2, GLint vstride,
            GLint vorder, const Real* points);
  void MapGrid1(GLint n, double u1, double u2);
  void MapGrid2(GLint un, double u1, double u2, GLint vn, double v1, double v2);
  void EvalCoord1(double u);
  void EvalCoord2(double u, double v);
  void EvalPoint1(GLint i);
  void EvalPoint2(GLint i, GLint j);
  void EvalMesh1(GLenum mode, GLint i1, GLint i2);
  void EvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);
  void PushAttrib(GLbitfield mask);
  void PopAttrib();
  void CopyEvalAttributes(const Context& from, bool grids);

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
  bool VertexShaderIsActive();
  void Snapshot();
  void Restore(int dimension);
  void MeshByPoints(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);
  void EvaluatePoint2(GLint i, GLint j);
  void SetActiveTexture();
  bool PrepareEvaluation(int dimension);
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
