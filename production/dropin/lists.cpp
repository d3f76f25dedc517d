// Display lists. The driver cannot compile commands of evaluators. Each of them therefore closes the open
// list of the driver, is recorded here, and opens another list of the driver. A list of the program is a
// sequence of lists of the driver (segments) and recorded commands.
#include "context.h"
#include "src/list_offsets.h"

namespace glev::dropin {
namespace {

constexpr int kMaxNesting = 64;

}  // namespace

bool Summary::is_empty() const {
  for (const Setter& setter : last)
    if (setter.send != nullptr) return false;
  return primitive == Primitive::kUnchanged && pops == 0 && pushes == 0;
}

// --- Compiling

void Context::new_list(GLuint name, GLenum mode) {
  if (!list.open && !is_outside()) return;
  if (list.open || name == 0 || (mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE)) {
    gl_below().NewList(name, mode);  // has the error
    return;
  }
  lists_used.note();
  list.name = name;
  list.mode = mode;
  list.primitive = Primitive::kUnchanged;
  list.deferring = false;
  list.code.clear();
  list.segments.clear();
  // Until EndList, the name keeps its previous meaning.
  list.begins_elsewhere = static_cast<bool>(evaluators_used) && gl_below().IsList(name);
  if (list.begins_elsewhere) {
    open_segment();
  } else {
    list.segment = name;
    list.summary.reset();
    gl_below().NewList(name, mode);
    list.driver_is_open = true;
  }
  list.open = true;
}

void Context::open_segment() {
  list.segment = group->new_segment();
  list.summary.reset();
  if (GLuint* const name = list.segments.grow(1)) *name = list.segment;
  gl_below().NewList(list.segment, list.deferring ? static_cast<GLenum>(GL_COMPILE) : list.mode);
  list.driver_is_open = true;
}

void Context::close_segment() {
  gl_below().EndList();
  list.driver_is_open = false;
  const GLuint name = list.segment;
  bool kept;
  if (list.summary.is_empty()) {
    kept = list.code.append([name](Context& context, const unsigned char*) {
      context.run_segment(name, nullptr);
    }) != nullptr;
  } else {
    kept = list.code.append([name, summary = list.summary](Context& context, const unsigned char*) {
      context.run_segment(name, &summary);
    }) != nullptr;
  }
  if (!kept) out_of_memory = true;
  if (list.summary.primitive != Primitive::kUnchanged) list.primitive = list.summary.primitive;
}

void Context::end_list() {
  if (!list.open) {
    gl_below().EndList();  // has the error
    return;
  }
  if (!is_outside()) return;
  const bool driver_only = list.code.empty() && list.segment == list.name;
  const bool of_note = !driver_only || !list.summary.is_empty();
  close_segment();
  list.open = false;
  if (!of_note) {
    group->delete_lists(list.name, list.name);
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
  defined->code.swap(list.code);
  defined->segments.swap(list.segments);
  group->define(defined);
  // Removes the former content of the driver's list.
  if (list.begins_elsewhere) {
    gl_below().NewList(list.name, GL_COMPILE);
    gl_below().EndList();
  }
}

bool Context::begin_recording() {
  // This is the first command of evaluators, in a primitive that is being executed. No map can be enabled
  // yet, so the command has no effect.
  if (executes() && maybe_inside) return false;
  close_segment();
  list.recorded = list.code.size();
  return true;
}

void Context::end_recording(bool recorded) {
  if (!recorded)
    out_of_memory = true;
  else if (executes())
    list.code.run(*this, list.recorded);
  open_segment();
}

void Context::begin_deferral() {
  close_segment();
  list.deferred = list.code.size();
  list.deferring = true;
  open_segment();
}

void Context::end_deferral() {
  close_segment();
  list.deferring = false;
  list.code.run(*this, list.deferred);
  open_segment();
}

// Drivers do not replay primitives correctly that end in another list than they begin in (Mesa forgets
// attributes before the first vertex, and strips of few vertices altogether). So Begin is recorded here and
// not compiled into a list of the driver.
void Context::issue_begin(GLenum mode) {
  if (!list.open) return begin(mode);
  const bool legal = mode <= 0x000E;  // PATCHES
  if (!legal || !evaluators_used || (executes() && maybe_inside)) {
    gl_below().Begin(mode);
    if (!legal) return;
    list.summary.primitive = Primitive::kOpen;
    if (executes()) maybe_inside = true;
    return;
  }
  close_segment();
  if (executes()) {
    list.deferring = true;
    list.deferred = list.code.size();
  }
  end_recording(list.code.append([mode](Context& context, const unsigned char*) { context.begin(mode); }) !=
                nullptr);
  list.primitive = Primitive::kOpen;
}

void Context::begin(GLenum mode) {
  before_primitive();
  gl_below().Begin(mode);
  if (!maybe_inside) tracking = has_vertex_map();
  maybe_inside = true;
}

void Context::end() {
  gl_below().End();
  if (!list.open) {
    maybe_inside = tracking = false;
    return;
  }
  list.summary.primitive = Primitive::kClosed;
  if (list.deferring)
    end_deferral();
  else if (executes())
    maybe_inside = tracking = false;
}

void Context::issue_call_list(GLuint name) {
  if (!list.open) return call_list(name);
  const Primitive primitive = group->primitive_of(name);
  if (executes() && maybe_inside) {
    gl_below().CallList(name);  // it contains no commands of evaluators
    return;
  }
  if (executes() && primitive == Primitive::kOpen) begin_deferral();
  issue([name](Context& context, const unsigned char*) { context.call_list(name); });
  if (primitive != Primitive::kUnchanged) list.primitive = primitive;
  if (list.deferring && primitive == Primitive::kClosed) end_deferral();
}

void Context::issue_call_lists(GLsizei n, GLenum type, const void* lists) {
  if (!list.open) return call_lists(n, type, lists);
  if (executes() && maybe_inside) {
    gl_below().CallLists(n, type, lists);
    return;
  }
  const std::size_t bytes =
      n > 0 && lists != nullptr ? static_cast<std::size_t>(n) * bytes_of_offset(type) : 0;
  issue_with([n, type](Context& context, const unsigned char* copy) { context.call_lists(n, type, copy); },
             bytes,
             [&](unsigned char* copy) {
               if (bytes > 0) std::memcpy(copy, lists, bytes);
             });
}

// Records the changes of the attribute stack by the open list. Their errors arise when the list of the driver
// is executed.
void Context::issue_push_attrib(GLbitfield mask) {
  if (executes())
    push_attrib(mask);
  else
    gl_below().PushAttrib(mask);
  if (!list.open) return;
  Summary& summary = list.summary;
  const Primitive primitive = summary.primitive == Primitive::kUnchanged ? list.primitive : summary.primitive;
  if (primitive != Primitive::kOpen && summary.pushes < 16) summary.pushed[summary.pushes++] = mask;
}

void Context::issue_pop_attrib() {
  if (executes())
    pop_attrib();
  else
    gl_below().PopAttrib();
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

void Context::call_list(GLuint name) {
  List* const called = group->find(name);
  if (called == nullptr) return gl_below().CallList(name);
  if (list_depth < kMaxNesting) {
    ++list_depth;
    called->code.run(*this, 0);
    --list_depth;
  }
  group->release_list(called);
}

void Context::call_lists(GLsizei n, GLenum type, const void* lists) {
  const std::size_t bytes = bytes_of_offset(type);
  if (n <= 0 || bytes == 0 || group->is_empty()) return gl_below().CallLists(n, type, lists);
  if (!maybe_inside && list_base_used) list_base = static_cast<GLuint>(get_integer(GL_LIST_BASE, 0));
  const GLuint base = list_base;
  for (GLsizei i = 0; i < n; ++i)
    call_list(base + offset_at(type, static_cast<const unsigned char*>(lists) +
                                         static_cast<std::size_t>(i) * bytes));
}

void Context::run_segment(GLuint name, const Summary* summary) {
  if (summary == nullptr) {
    list_base_known = list_base_known && maybe_inside;
    return gl_below().CallList(name);
  }
  const bool moves = summary->pops > 0 || summary->pushes > 0;
  const GLint depth = moves && !maybe_inside ? get_integer(GL_ATTRIB_STACK_DEPTH, -1) : -1;
  if (summary->primitive != Primitive::kUnchanged) before_primitive();
  gl_below().CallList(name);
  list_base_known = list_base_known && maybe_inside;
  if (summary->primitive == Primitive::kOpen) {
    tracking = maybe_inside ? tracking : has_vertex_map();
    maybe_inside = true;
  } else if (summary->primitive == Primitive::kClosed) {
    maybe_inside = tracking = false;
  }
  if (tracking)
    for (int k = 0; k < kAttributeCount; ++k)
      if (summary->last[k].send != nullptr) current[k] = summary->last[k];
  if (depth >= 0) follow_stack(*summary, depth);
}

// Applies to the evaluators the changes of the attribute stack that a list has made in the GL below.
void Context::follow_stack(const Summary& summary, GLint depth) {
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
  update_enabled();
}

void Context::delete_lists(GLuint first, GLsizei range) {
  if (!is_outside()) return;
  if (range > 0) {
    const GLuint last = first + static_cast<GLuint>(range) - 1;
    group->delete_lists(first, last >= first ? last : 0xffffffffu);
  }
  gl_below().DeleteLists(first, range);
}

}  // namespace glev::dropin
