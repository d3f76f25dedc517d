// Collects all variations, and applies one to the contexts of an implementation.
#include "variation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <evalcts/backends/context_in_front.h>

namespace evalcts::variations {
namespace {

std::vector<Variation>& registered() {
  static std::vector<Variation> all;
  return all;
}

// Wraps the commands of a variation to keep `remembered` up to date.

void note(gl::Table& table) {
  static gl::Table varied;
  varied = table;
  if (table.Begin)
    table.Begin = [](GLenum mode) {
      varied.Begin(mode);
      remembered.inside = true;
    };
  if (table.End)
    table.End = [] {
      varied.End();
      remembered.inside = false;
    };
  if (table.NewList)
    table.NewList = [](GLuint list, GLenum mode) {
      varied.NewList(list, mode);
      remembered.compiling = true;
    };
  if (table.EndList)
    table.EndList = [] {
      varied.EndList();
      remembered.compiling = false;
    };
}

class VariedContext final : public ContextInFront {
 public:
  VariedContext(std::shared_ptr<Context> inner, const Variation& variation)
      : ContextInFront(std::move(inner)) {
    remembered = {};
    unvaried = table_;
    Varied varied{table_};
    variation.vary(varied);
    emitted_ = varied.emitted;
    note(table_);
  }

  std::vector<ObservedPrimitive> take_emitted() override {
    std::vector<ObservedPrimitive> primitives = inner().take_emitted();
    if (emitted_) emitted_(primitives);
    return primitives;
  }

 private:
  void (*emitted_)(std::vector<ObservedPrimitive>&) = nullptr;
};

class VariedImplementation final : public ImplementationInFront {
 public:
  VariedImplementation(std::unique_ptr<Implementation> inner, const Variation& variation)
      : ImplementationInFront(std::move(inner)), variation_(variation) {
    gl::Table unused;
    Varied varied{unused};
    variation.vary(varied);
    one_state_ = varied.one_state;
  }

  std::unique_ptr<Context> create_context() override {
    if (!only_) {
      std::shared_ptr<Context> made = inner().create_context();
      if (one_state_) only_ = made;
      return std::make_unique<VariedContext>(std::move(made), variation_);
    }
    return std::make_unique<VariedContext>(only_, variation_);
  }
  std::unique_ptr<Context> create_beside() override { return one_state_ ? nullptr : inner().create_beside(); }

 private:
  const Variation& variation_;
  bool one_state_ = false;
  std::shared_ptr<Context> only_;
};

}  // namespace

VariationRegistration::VariationRegistration(const Variation& variation) {
  registered().push_back(variation);
}

const std::vector<Variation>& all_variations() {
  static const std::vector<Variation> kSorted = [] {
    std::vector<Variation> all = registered();
    std::ranges::sort(all, {}, &Variation::name);
    return all;
  }();
  return kSorted;
}

std::unique_ptr<Implementation> with_variation(std::unique_ptr<Implementation> inner, std::string_view name) {
  const auto found = std::ranges::find(all_variations(), name, &Variation::name);
  if (found == all_variations().end()) throw CannotStart(fmt::format("unknown variation '{}'", name));
  return std::make_unique<VariedImplementation>(std::move(inner), *found);
}

}  // namespace evalcts::variations
