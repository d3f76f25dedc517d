// Probes of the rest of the pipeline: whether commands outside the evaluators do what failing cases rely on.
#pragma once

#include <cstdint>
#include <set>

#include <evalcts/gl/case.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

class PipelineProbes {
 public:
  // Notes what the case, as it is delivered, relies on.
  void add(const gl::Case& delivered);
  bool uses_lists() const { return uses_lists_; }

  // Must be called when a case has failed. Throws NotObservable if one of these goes wrong without
  // evaluators, and a case relies on it: PushAttrib and PopAttrib in display lists; and for a wrong error
  // also the error of End outside of a primitive, and errors of commands in display lists when they are due.
  void require(const Subject& subject, bool is_error) const;

 private:
  bool uses_lists_ = false;
  bool has_stack_in_list_ = false;     // attributes are pushed or popped in a list
  bool may_end_outside_ = false;       // End may be outside of a primitive
  std::set<std::int64_t> list_modes_;  // second arguments of NewList
};

}  // namespace evalcts
