// Collects all faults, those of wrappers and mutations of `production`, and injects a fault into the contexts
// of an implementation.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <evalcts/backends/context_in_front.h>
#include <mutations/mutation.h>
#include "fault.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

std::vector<Fault>& wrappers() {
  static std::vector<Fault> all;
  return all;
}

// Returns the mutations of the production library that tests of the suite must detect, with their numbers.
// Mutations without requirements are left out, because production's own tests detect them.
const std::vector<std::pair<int, Fault>>& mutations() {
  static const std::vector<std::pair<int, Fault>> kAll = [] {
    std::vector<std::pair<int, Fault>> list;
    int number = 0;
#define GLEV_MUTATION(name, level, requirements, what, test) \
  ++number;                                                  \
  if (*requirements != '\0')                                 \
    list.push_back({number, {#name, "production", *level_named(#level), requirements, what, nullptr}});
#include "mutation_list.h"
#undef GLEV_MUTATION
    return list;
  }();
  return kAll;
}

void activate_mutation(std::string_view name) {
  for (const auto& [number, fault] : mutations())
    if (fault.name == name) glev::active_mutation = number;
}

// A context of an implementation with a fault.
class FaultyContext final : public ContextInFront {
 public:
  FaultyContext(std::unique_ptr<Context> inner, const Fault& fault) : ContextInFront(std::move(inner)) {
    forget_rules();
    unmodified = table_;
    Injection injection{table_};
    fault.inject(injection);
    emitted_ = injection.emitted;
    // A missing command stays missing.
#define GL_ENTRY(name, kinds) \
  if (!unmodified.name) table_.name = nullptr;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
    watch(table_);
  }

  std::vector<ObservedPrimitive> take_emitted() override {
    std::vector<ObservedPrimitive> primitives = inner().take_emitted();
    if (emitted_) emitted_(primitives);
    return primitives;
  }

 private:
  std::function<void(std::vector<ObservedPrimitive>&)> emitted_;
};

class Faulty final : public ImplementationInFront {
 public:
  Faulty(std::unique_ptr<Implementation> inner, const Fault& fault)
      : ImplementationInFront(std::move(inner)), fault_(fault) {}

  std::unique_ptr<Context> create_context() override {
    return std::make_unique<FaultyContext>(inner().create_context(), fault_);
  }

 private:
  const Fault& fault_;
};

}  // namespace

FaultRegistration::FaultRegistration(const Fault& fault) { wrappers().push_back(fault); }

const std::vector<Fault>& all_faults() {
  static const std::vector<Fault> kSorted = [] {
    std::vector<Fault> all = wrappers();
    for (const auto& [number, fault] : mutations()) all.push_back(fault);
    std::ranges::sort(all, {}, &Fault::name);
    const auto twice = std::ranges::adjacent_find(all, {}, &Fault::name);
    if (twice != all.end()) throw std::logic_error(fmt::format("two faults are called {}", twice->name));
    return all;
  }();
  return kSorted;
}

std::unique_ptr<Implementation> with_fault(std::unique_ptr<Implementation> inner, std::string_view name) {
  const auto found = std::ranges::find(all_faults(), name, &Fault::name);
  if (found == all_faults().end()) throw CannotStart(fmt::format("unknown fault '{}'", name));
  if (found->inject) return std::make_unique<Faulty>(std::move(inner), *found);
  activate_mutation(name);
  return inner;
}

}  // namespace evalcts::faults
