// A context in front of another one, for implementations that change some of its commands or record them.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// A context that wraps another one. Its table is a copy of that context's table, in which the constructor of
// the derived class replaces commands.
class ContextInFront : public Context {
 public:
  explicit ContextInFront(std::shared_ptr<Context> inner)
      : table_(inner->table()), inner_(std::move(inner)) {}
  const gl::Table& table() const override { return table_; }
  void make_current() override { inner_->make_current(); }
  void release() override { inner_->release(); }
  bool has_sink() const override { return inner_->has_sink(); }
  Attributes emitted_attributes() const override { return inner_->emitted_attributes(); }
  std::vector<ObservedPrimitive> take_emitted() override { return inner_->take_emitted(); }

 protected:
  Context& inner() const { return *inner_; }

  gl::Table table_;

 private:
  std::shared_ptr<Context> inner_;
};

}  // namespace evalcts
