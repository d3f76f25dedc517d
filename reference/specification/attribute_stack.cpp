// The attribute stack (GL 2.1 section 6.1.14); the groups are those of the state tables (section 6.2).

#include <reference/specification.h>

namespace evalcts::reference {

void Specification::PushAttrib(GLbitfield mask) {
  if (compiled(&Specification::PushAttrib, mask)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION},
                 {attribute_stack_.size() == kMaxAttribStackDepth, GL_STACK_OVERFLOW}})) {
    return;
  }
  attribute_stack_.push_back({mask, attributes_});
}

void Specification::PopAttrib() {
  if (compiled(&Specification::PopAttrib)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {attribute_stack_.empty(), GL_STACK_UNDERFLOW}})) return;
  const auto [mask, saved] = attribute_stack_.back();
  attribute_stack_.pop_back();
  if (mask & (GL_EVAL_BIT | GL_ENABLE_BIT)) attributes_.enables = saved.enables;
  if (mask & GL_EVAL_BIT) attributes_.grids = saved.grids;  // EV-ATTRIB-EVALBIT, EV-ATTRIB-ENABLEBIT-NOGRID
  if (mask & GL_CURRENT_BIT) attributes_.current = saved.current;
  if (mask & GL_TEXTURE_BIT) attributes_.active_texture = saved.active_texture;
  if (mask & GL_LIST_BIT) attributes_.list_base = saved.list_base;
}

}  // namespace evalcts::reference
