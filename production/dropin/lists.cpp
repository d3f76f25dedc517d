// Display lists. The driver cannot compile commands of evaluators, so that each of them closes the driver's
// list that is open, is kept here, and opens another one: a list of the program is a sequence of both.
#include "context.h"
#include "src/list_offsets.h"

namespace glev::dropin {
namespace {

constexpr int kMaxNesting = 64;

}  // namespace

bool Summary::IsEmpty() const {
  for (const Setter& setter : last)
    if (setter.send != nullptr) return false;
  return primitive == Primitive::kUnchanged && pops == 0 && pushes == 0;
}

// --- Compiling

void Context::NewList(GLuint name, GLenum mode) {
  if (!list.open && !IsOutside()) return;
  if (list.open || name == 0 || (mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE)) {
    Gl().NewList(name, mode);  // has the error
    return;
  }
  lists_used.Note();
  list.name = name;
  list.mode = mode;
  list.primitive = Primitive::kUnchanged;
  list.deferring = false;
  list.code.clear();
  list.segments.clear();
  // Until EndList the name stands for the list that it stands for now.
  list.begins_elsewhere = static_cast<bool>(evaluators_used) && Gl().IsList(name);
  if (list.begins_elsewhere) {
    OpenSegment();
  } else {
    list.segment = name;
    list.summary.Reset();
    Gl().NewList(name, mode);
    list.driver_is_open = true;
  }
  list.open = true;
}

void Context::OpenSegment() {
  list.segment = group->NewSegment();
  list.summary.Reset();
  if (GLuint* const name = list.segments.Grow(1)) *name = list.segment;
  Gl().NewList(list.segment, list.deferring ? static_cast<GLenum>(GL_COMPILE) : list.mode);
  list.driver_is_open = true;
}

void Context::CloseSegment() {
  Gl().EndList();
  list.driver_is_open = false;
  const GLuint name = list.segment;
  bool kept;
  if (list.summary.IsEmpty()) {
    kept = list.code.Append([name](Context& context, const unsigned char*) {
      context.RunSegment(name, nullptr);
    }) != nullptr;
  } else {
    kept = list.code.Append([name, summary = list.summary](Context& context, const unsigned char*) {
      context.RunSegment(name, &summary);
    }) != nullptr;
  }
  if (!kept) out_of_memory = true;
  if (list.summary.primitive != Primitive::kUnchanged) list.primitive = list.summary.primitive;
}

void Context::EndList() {
  if (!list.open) {
    Gl().EndList();  // has the error
    return;
  }
  if (!IsOutside()) return;
  const bool driver_only = list.code.empty() && list.segment == list.name;
  const bool of_note = !driver_only || !list.summary.IsEmpty();
  CloseSegment();
  list.open = false;
  if (!of_note) {
    group->Delete(list.name, list.name);
    return;
  }
  void* const memory = std::malloc(sizeof(List));
  if (memory == nullptr) {
    out_of_memory = true;
    return;
  }
  auto* const defined = new (memory) List();
  defined->name = list.name;
  defined->primitive = list.primitive;
  defined->code.Swap(list.code);
  defined->segments.Swap(list.segments);
  group->Define(defined);
  // What stood for the name before is gone.
  if (list.begins_elsewhere) {
    Gl().NewList(list.name, GL_COMPILE);
    Gl().EndList();
  }
}

bool Context::BeginRecording() {
  // The first command of evaluators, in a primitive that is being executed: nothing can be enabled yet.
  if (Executes() && maybe_inside) return false;
  CloseSegment();
  list.recorded = list.code.size();
  return true;
}

void Context::EndRecording(bool recorded) {
  if (!recorded)
    out_of_memory = true;
  else if (Executes())
    list.code.Run(*this, list.recorded);
  OpenSegment();
}

void Context::BeginDeferral() {
  CloseSegment();
  list.deferred = list.code.size();
  list.deferring = true;
  OpenSegment();
}

void Context::EndDeferral() {
  CloseSegment();
  list.deferring = false;
  list.code.Run(*this, list.deferred);
  OpenSegment();
}

// Drivers do not bring back all of a primitive that ends in another list than the one it begins in (Mesa
// forgets attributes before the first vertex, and strips of few vertices altogether). So Begin stands beside
// their lists.
void Context::IssueBegin(GLenum mode) {
  if (!list.open) return Begin(mode);
  const bool legal = mode <= 0x000E;  // PATCHES
  if (!legal || !evaluators_used || (Executes() && maybe_inside)) {
    Gl().Begin(mode);
    if (!legal) return;
    list.summary.primitive = Primitive::kOpen;
    if (Executes()) maybe_inside = true;
    return;
  }
  CloseSegment();
  if (Executes()) {
    list.deferring = true;
    list.deferred = list.code.size();
  }
  EndRecording(list.code.Append([mode](Context& context, const unsigned char*) { context.Begin(mode); }) !=
               nullptr);
  list.primitive = Primitive::kOpen;
}

void Context::Begin(GLenum mode) {
  BeforePrimitive();
  Gl().Begin(mode);
  if (!maybe_inside) tracking = HasVertexMap();
  maybe_inside = true;
}

void Context::End() {
  Gl().End();
  if (!list.open) {
    maybe_inside = tracking = false;
    return;
  }
  list.summary.primitive = Primitive::kClosed;
  if (list.deferring)
    EndDeferral();
  else if (Executes())
    maybe_inside = tracking = false;
}

void Context::IssueCallList(GLuint name) {
  if (!list.open) return CallList(name);
  const Primitive primitive = group->PrimitiveOf(name);
  if (Executes() && maybe_inside) {
    Gl().CallList(name);  // nothing of evaluators is in there
    return;
  }
  if (Executes() && primitive == Primitive::kOpen) BeginDeferral();
  Issue([name](Context& context, const unsigned char*) { context.CallList(name); });
  if (primitive != Primitive::kUnchanged) list.primitive = primitive;
  if (list.deferring && primitive == Primitive::kClosed) EndDeferral();
}

void Context::IssueCallLists(GLsizei n, GLenum type, const void* lists) {
  if (!list.open) return CallLists(n, type, lists);
  if (Executes() && maybe_inside) {
    Gl().CallLists(n, type, lists);
    return;
  }
  const std::size_t bytes = n > 0 && lists != nullptr ? static_cast<std::size_t>(n) * BytesOfOffset(type) : 0;
  IssueWith([n, type](Context& context, const unsigned char* copy) { context.CallLists(n, type, copy); },
            bytes,
            [&](unsigned char* copy) {
              if (bytes > 0) std::memcpy(copy, lists, bytes);
            });
}

// Errors of what a list has of these show when the driver's list is executed.
void Context::IssuePushAttrib(GLbitfield mask) {
  if (Executes())
    PushAttrib(mask);
  else
    Gl().PushAttrib(mask);
  if (!list.open) return;
  Summary& summary = list.summary;
  const Primitive primitive = summary.primitive == Primitive::kUnchanged ? list.primitive : summary.primitive;
  if (primitive != Primitive::kOpen && summary.pushes < 16) summary.pushed[summary.pushes++] = mask;
}

void Context::IssuePopAttrib() {
  if (Executes())
    PopAttrib();
  else
    Gl().PopAttrib();
  if (!list.open) return;
  Summary& summary = list.summary;
  const Primitive primitive = summary.primitive == Primitive::kUnchanged ? list.primitive : summary.primitive;
  if (primitive == Primitive::kOpen) return;
  if (summary.pushes > 0)
    --summary.pushes;
  else
    ++summary.pops;
}

// --- Executing

void Context::CallList(GLuint name) {
  List* const called = group->Find(name);
  if (called == nullptr) return Gl().CallList(name);
  if (list_depth < kMaxNesting) {
    ++list_depth;
    called->code.Run(*this, 0);
    --list_depth;
  }
  group->ReleaseList(called);
}

void Context::CallLists(GLsizei n, GLenum type, const void* lists) {
  const std::size_t bytes = BytesOfOffset(type);
  if (n <= 0 || bytes == 0 || group->IsEmpty()) return Gl().CallLists(n, type, lists);
  if (!maybe_inside && list_base_used) list_base = static_cast<GLuint>(Integer(GL_LIST_BASE, 0));
  const GLuint base = list_base;
  for (GLsizei i = 0; i < n; ++i)
    CallList(base +
             OffsetAt(type, static_cast<const unsigned char*>(lists) + static_cast<std::size_t>(i) * bytes));
}

void Context::RunSegment(GLuint name, const Summary* summary) {
  if (summary == nullptr) {
    list_base_known = list_base_known && maybe_inside;
    return Gl().CallList(name);
  }
  const bool moves = summary->pops > 0 || summary->pushes > 0;
  const GLint depth = moves && !maybe_inside ? Integer(GL_ATTRIB_STACK_DEPTH, -1) : -1;
  if (summary->primitive != Primitive::kUnchanged) BeforePrimitive();
  Gl().CallList(name);
  list_base_known = list_base_known && maybe_inside;
  if (summary->primitive == Primitive::kOpen) {
    tracking = maybe_inside ? tracking : HasVertexMap();
    maybe_inside = true;
  } else if (summary->primitive == Primitive::kClosed) {
    maybe_inside = tracking = false;
  }
  if (tracking)
    for (int k = 0; k < kAttributeCount; ++k)
      if (summary->last[k].send != nullptr) current[k] = summary->last[k];
  if (depth >= 0) FollowStack(*summary, depth);
}

// What the GL below has done with its attribute stack in a list.
void Context::FollowStack(const Summary& summary, GLint depth) {
  for (unsigned i = 0; i < summary.pops && depth > 0; ++i) {
    --depth;
    if (depth >= 64 || !pushed[depth]) continue;
    pushed[depth] = false;
    glevPopAttrib(evaluators);
  }
  for (unsigned i = 0; i < summary.pushes && depth < 64; ++i, ++depth) {
    const GLbitfield mask = summary.pushed[i] & (GL_EVAL_BIT | GL_ENABLE_BIT);
    pushed[depth] = mask != 0;
    if (mask == 0) continue;
    glevPushAttrib(evaluators, mask);
    pushed[depth] = glevGetError(evaluators) == GLEV_NO_ERROR;
  }
  glevGetError(evaluators);
  UpdateEnabled();
}

void Context::DeleteLists(GLuint first, GLsizei range) {
  if (!IsOutside()) return;
  if (range > 0) {
    const GLuint last = first + static_cast<GLuint>(range) - 1;
    group->Delete(first, last >= first ? last : 0xffffffffu);
  }
  Gl().DeleteLists(first, range);
}

}  // namespace glev::dropin
