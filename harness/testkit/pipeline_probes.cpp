// Implements PipelineProbes by cases without evaluators in fresh contexts.
#include <evalcts/testkit/pipeline_probes.h>

#include <algorithm>
#include <utility>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/roles.h>

namespace evalcts {
namespace {

bool uses_attribute_stack_in_list(const gl::Case& script) {
  bool is_list_open = false;
  return std::ranges::any_of(script.commands(), [&](const gl::Command& command) {
    if (command.entry == gl::EntryPoint::NewList) is_list_open = true;
    if (command.entry == gl::EntryPoint::EndList) is_list_open = false;
    return is_list_open &&
           (command.entry == gl::EntryPoint::PushAttrib || command.entry == gl::EntryPoint::PopAttrib);
  });
}

// Returns true if End may be outside of a primitive, also because lists may leave one open.
bool may_end_outside(const gl::Case& script) {
  bool is_open = false;
  return std::ranges::any_of(script.commands(), [&](const gl::Command& command) {
    if (command.entry == gl::EntryPoint::End) return !std::exchange(is_open, false);
    if (command.entry == gl::EntryPoint::Begin) is_open = gl::integer_of(command, 0) <= GL_POLYGON;
    return false;
  });
}

gl::Trace play(const Subject& subject, const gl::Case& probe) {
  return subject.implementation->create_context()->play(probe);
}

void require_attribute_stack_in_lists(const Subject& subject) {
  gl::Case c(gl::control("PushAttrib and PopAttrib in a display list"));
  c.NewList(1, GL_COMPILE);
  c.PushAttrib(GL_ENABLE_BIT);
  c.Enable(GL_CULL_FACE);
  c.PopAttrib();
  c.EndList();
  c.CallList(1);
  const gl::Ref enabled = c.IsEnabled(GL_CULL_FACE);
  if (play(subject, c).result(enabled) != GL_FALSE)
    throw NotObservable("pipeline: display lists lose PushAttrib and PopAttrib of other state as well");
}

void require_error_of_end(const Subject& subject) {
  gl::Case c(gl::control("End outside of a primitive"));
  c.End();
  const gl::Ref error = c.GetError();
  if (play(subject, c).error(error) != GL_INVALID_OPERATION)
    throw NotObservable("pipeline: End outside of a primitive does not raise its error before GetError");
}

// `mode`: of NewList.
void require_errors_in_lists(const Subject& subject, std::int64_t mode) {
  const bool executes = mode == GL_COMPILE_AND_EXECUTE;
  if (!subject.info.has(gl::EntryPoint::MatrixMode) || (mode != GL_COMPILE && !executes)) return;
  gl::Case c(gl::control("MatrixMode of no matrix in a display list"));
  c.NewList(1, static_cast<GLenum>(mode));
  c.MatrixMode(GL_NONE);
  c.EndList();
  const gl::Ref compiled = c.GetError();
  c.CallList(1);
  const gl::Ref called = c.GetError();
  const gl::Trace trace = play(subject, c);
  if (trace.error(compiled) != (executes ? GL_INVALID_ENUM : GL_NO_ERROR) ||
      trace.error(called) != GL_INVALID_ENUM)
    throw NotObservable(
        "pipeline: commands of other state in display lists do not raise their errors when they are due, "
        "either");
}

}  // namespace

void PipelineProbes::add(const gl::Case& delivered) {
  uses_lists_ = uses_lists_ || gl::uses_lists(delivered);
  has_stack_in_list_ = has_stack_in_list_ || uses_attribute_stack_in_list(delivered);
  may_end_outside_ = may_end_outside_ || may_end_outside(delivered);
  for (const gl::Command& command : delivered.commands())
    if (command.entry == gl::EntryPoint::NewList) list_modes_.insert(gl::integer_of(command, 1));
}

void PipelineProbes::require(const Subject& subject, bool is_error) const {
  if (has_stack_in_list_) require_attribute_stack_in_lists(subject);
  if (!is_error) return;
  if (may_end_outside_) require_error_of_end(subject);
  for (const std::int64_t mode : list_modes_) require_errors_in_lists(subject, mode);
}

}  // namespace evalcts
