// An implementation with injected mistakes, for tests in this process: `production` with some entry points
// replaced.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts {

class Altered final : public Implementation {
 public:
  // `alter` replaces entry points of the table of each new context; it may be null.
  explicit Altered(void (*alter)(gl::Table&)) : alter_(alter) {}
  std::string name() const override { return "altered"; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<AlteredContext>(inner_->create_context(), alter_);
  }
  // The unmodified entry points, which the replacing functions may call.
  static inline gl::Table original;

 private:
  class AlteredContext final : public Context {
   public:
    AlteredContext(std::unique_ptr<Context> inner, void (*alter)(gl::Table&)) : inner_(std::move(inner)) {
      original = table_ = inner_->table();
      if (alter) alter(table_);
    }
    const gl::Table& table() const override { return table_; }
    bool has_sink() const override { return true; }
    std::vector<ObservedPrimitive> take_emitted() override { return inner_->take_emitted(); }

   private:
    std::unique_ptr<Context> inner_;
    gl::Table table_;
  };

  std::unique_ptr<Implementation> inner_ = open_implementation({.name = "production"});
  void (*alter_)(gl::Table&);
};

}  // namespace evalcts
