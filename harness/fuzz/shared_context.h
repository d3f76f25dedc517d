// A context that many programs share, while other programs use fresh contexts. Private to harness/fuzz.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <utility>

#include <evalcts/backends/reused_context.h>
#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

inline constexpr std::size_t kMostHistory = 8;  // programs that a shared context remembers

class SharedContext {
 public:
  // Returns null if the implementation cannot create a context beside others, or has a sink, for which a
  // shared context is not faster.
  static std::unique_ptr<SharedContext> of(const Subject& fresh) {
    std::unique_ptr<WarmContext> warm = WarmContext::of(*fresh.implementation, fresh.info);
    return warm ? std::make_unique<SharedContext>(fresh, std::move(warm)) : nullptr;
  }

  SharedContext(const Subject& fresh, std::unique_ptr<WarmContext> warm)
      : subject_(fresh), warm_(std::move(warm)) {
    subject_.implementation = &warm_->implementation();
  }

  Judged judge(const gl::Case& program, const Specified& specified, Outcomes outcomes = Outcomes::kAll,
               Attributes attributes = kAllAttributes) {
    history_.push_back(program);
    if (history_.size() > kMostHistory + 1) history_.pop_front();
    return judge_aside(program, specified, outcomes, attributes);
  }
  // The same, but the program is not added to the history.
  Judged judge_aside(const gl::Case& program, const Specified& specified, Outcomes outcomes,
                     Attributes attributes) const {
    return judge_program(subject_, program, specified, outcomes, attributes);
  }

  // Returns a case of the last `count` programs before the latest one, followed by the latest one; empty if
  // there were fewer.
  gl::Case behind(std::size_t count) const {
    gl::Case joint(history_.back().identity());
    if (count >= history_.size()) return joint;
    for (std::size_t i = history_.size() - 1 - count; i < history_.size(); ++i) joint.append(history_[i]);
    return joint;
  }

  void renew() {
    warm_->renew();
    subject_.implementation = &warm_->implementation();
    history_.clear();
  }

 private:
  Subject subject_;
  std::unique_ptr<WarmContext> warm_;
  std::deque<gl::Case> history_;
};

}  // namespace evalcts::fuzz
