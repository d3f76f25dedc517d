// Implementations with injected mistakes, for tests in this process: `production` or another one with some
// entry points replaced; and the subject of tests that an implementation is.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <evalcts/backends/context_in_front.h>
#include <evalcts/capture/capture.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

class Altered final : public Implementation {
 public:
  // `alter` replaces entry points of the table of each new context; it may be null. Throws CannotStart.
  explicit Altered(void (*alter)(gl::Table&), const std::string& implementation = "production")
      : inner_(open_implementation({.name = implementation})), alter_(alter) {}
  std::string name() const override { return "altered"; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<AlteredContext>(inner_->create_context(), alter_);
  }
  // The unmodified entry points, which the replacing functions may call.
  static inline gl::Table original;

 private:
  class AlteredContext final : public ContextInFront {
   public:
    AlteredContext(std::unique_ptr<Context> inner, void (*alter)(gl::Table&))
        : ContextInFront(std::move(inner)) {
      original = table_;
      if (alter) alter(table_);
    }
  };

  std::unique_ptr<Implementation> inner_;
  void (*alter_)(gl::Table&);
};

// An implementation with all its captures, which keep a reference to `info`.
class CapturedSubject : public Subject {
 public:
  explicit CapturedSubject(Implementation& judged) : all_captures_(judged, info, nullptr) {
    implementation = &judged;
    info = inquire(judged);
    captures = &all_captures_;
  }
  CapturedSubject(const CapturedSubject&) = delete;
  CapturedSubject& operator=(const CapturedSubject&) = delete;

 private:
  Captures all_captures_;
};

}  // namespace evalcts
