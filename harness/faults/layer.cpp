// Collects all changes, puts changes in front of the contexts of an implementation, and takes calls through
// their layers.
#include "layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <evalcts/backends/context_in_front.h>
#include <mutations/mutation.h>
#include "rules.h"

namespace evalcts::faults {
namespace {

std::vector<Change>& registered() {
  static std::vector<Change> all;
  return all;
}

// Returns the mutations of the production library that tests of the suite must detect, with their numbers.
// Mutations without requirements are left out, because production's own tests detect them.
const std::vector<std::pair<int, Change>>& mutations() {
  static const std::vector<std::pair<int, Change>> kAll = [] {
    std::vector<std::pair<int, Change>> list;
    int number = 0;
#define GLEV_MUTATION(name, level, requirements, what, test) \
  ++number;                                                  \
  if (*requirements != '\0')                                 \
    list.push_back(                                          \
        {number, {#name, kMutation, "production", *level_named(#level), requirements, what, nullptr}});
#include <mutations/mutation_list.h>
#undef GLEV_MUTATION
    return list;
  }();
  return kAll;
}

// --- Layers ------------------------------------------------------------------------------------------------

// Layers of the current context of the thread, the outermost first.
thread_local std::vector<Layer> layers;
// Number of layers that the current call has reached.
thread_local std::size_t entered = 0;

// Makes the next layer the running one during its lifetime.
class Entrance {
 public:
  Entrance() { ++entered; }
  ~Entrance() { --entered; }
  Entrance(const Entrance&) = delete;
  Entrance& operator=(const Entrance&) = delete;
};

const Entries kTracked = Begin | End | Enable | Disable | ActiveTexture | NewList | EndList | PushAttrib |
                         PopAttrib | ContextOfKindEVALCTS | BindBuffer;

class LayeredContext final : public ContextInFront {
 public:
  LayeredContext(std::shared_ptr<Context> inner, const std::vector<const Change*>& changes)
      : ContextInFront(std::move(inner)) {
    exchange();
    innermost = table_;
    Entries wrapped = kTracked, provided;
    for (const Change* const change : changes) {
      layers.push_back({change->rules().all});
      for (const Rule& rule : layers.back().rules) {
        wrapped = wrapped | rule.entries;
        if (rule.kind == Rule::Kind::kProvided) provided = provided | rule.entries;
      }
    }
    for (std::size_t i = 0; i < gl::kEntryPointCount; ++i) {
      const auto entry = static_cast<gl::EntryPoint>(i);
      if (wrapped.contain(entry) && (has(innermost, entry) || provided.contain(entry)))
        install(entry, table_);
    }
    unmodified = table_;
    for_each_layer_from_inside([this](const Layer& layer) {
      Call none;
      for (const Rule& rule : layer.rules) {
        if (rule.kind == Rule::Kind::kInitial) rule.step(none);
        if (rule.kind != Rule::Kind::kMissing) continue;
        for (std::size_t i = 0; i < gl::kEntryPointCount; ++i)
          if (rule.entries.contain(static_cast<gl::EntryPoint>(i)))
            remove(static_cast<gl::EntryPoint>(i), table_);
      }
    });
  }

  ~LayeredContext() override {
    if (current_ == this) current_ = nullptr;
  }
  void make_current() override {
    ContextInFront::make_current();
    if (current_ != this) exchange();
  }
  void release() override {
    ContextInFront::release();
    if (current_ == this) keep_current();
  }

  std::vector<ObservedPrimitive> take_emitted() override {
    std::vector<ObservedPrimitive> primitives = inner().take_emitted();
    for_each_layer_from_inside([&](const Layer& layer) {
      Call none;
      for (const Rule& rule : layer.rules)
        if (rule.emitted && rule.condition.holds(none)) rule.emitted(primitives);
    });
    return primitives;
  }

 private:
  template <class F>
  static void for_each_layer_from_inside(F f) {
    for (entered = layers.size(); entered > 0; --entered) f(layers[entered - 1]);
  }

  // Puts the layers and tables of this context in the place of those of the current one.
  void exchange() {
    if (current_) keep_current();
    std::tie(layers, innermost, unmodified) = std::exchange(kept_, {});
    current_ = this;
  }

  static void keep_current() {
    current_->kept_ = {std::move(layers), innermost, unmodified};
    current_ = nullptr;
  }

  static inline thread_local LayeredContext* current_ = nullptr;
  std::tuple<std::vector<Layer>, gl::Table, gl::Table> kept_;  // of a context that is not current
};

class LayeredImplementation final : public ImplementationInFront {
 public:
  LayeredImplementation(std::unique_ptr<Implementation> inner, std::vector<const Change*> changes)
      : ImplementationInFront(std::move(inner)), changes_(std::move(changes)) {
    for (const Change* const change : changes_)
      for (const Rule& rule : change->rules().all)
        shares_state_ = shares_state_ || rule.kind == Rule::Kind::kOneState;
  }

  std::unique_ptr<Context> create_context() override {
    std::shared_ptr<Context> made = only_ ? only_ : inner().create_context();
    if (shares_state_) only_ = made;
    return std::make_unique<LayeredContext>(std::move(made), changes_);
  }
  std::unique_ptr<Context> create_beside() override {
    std::shared_ptr<Context> made = shares_state_ ? nullptr : inner().create_beside();
    return made ? std::make_unique<LayeredContext>(std::move(made), changes_) : nullptr;
  }

 private:
  std::vector<const Change*> changes_;
  bool shares_state_ = false;
  std::shared_ptr<Context> only_;  // if all contexts have one state
};

}  // namespace

Registration::Registration(const Change& change) { registered().push_back(change); }

const std::vector<Change>& all_changes() {
  static const std::vector<Change> kSorted = [] {
    std::vector<Change> all = registered();
    for (const auto& [number, change] : mutations()) all.push_back(change);
    std::ranges::sort(all, {}, &Change::name);
    const auto twice = std::ranges::adjacent_find(all, {}, &Change::name);
    if (twice != all.end()) throw std::logic_error(fmt::format("two changes are called {}", twice->name));
    return all;
  }();
  return kSorted;
}

std::unique_ptr<Implementation> with_changes(std::unique_ptr<Implementation> inner,
                                             const std::vector<std::string>& names) {
  std::vector<const Change*> changes;
  for (const std::string& name : names) {
    const auto change = std::ranges::find(all_changes(), name, &Change::name);
    if (change == all_changes().end())
      throw CannotStart(fmt::format("unknown fault or variation '{}'", name));
    if (change->rules) changes.push_back(&*change);
    for (const auto& [number, mutation] : mutations())
      if (mutation.name == name) glev::active_mutation = number;
  }
  if (changes.empty()) return inner;
  return std::make_unique<LayeredImplementation>(std::move(inner), std::move(changes));
}

// --- Calls -------------------------------------------------------------------------------------------------

Layer& running_layer() { return layers[entered - 1]; }

void Call::enter() {
  if (entered == layers.size()) return call_innermost(*this);
  const double first = numbers[0], second = numbers[1];
  const std::size_t before = std::exchange(next, 0);
  const Entrance entrance;
  running_layer().tracked.note_before(entry, first, second);
  go();
  running_layer().tracked.note_after(entry, first, second);
  next = before;
}

void Call::go_original() { enter(); }

void Call::go() {
  const std::vector<Rule>& rules = running_layer().rules;
  const std::size_t before = next;
  const auto rule =
      std::find_if(rules.begin() + static_cast<std::ptrdiff_t>(next), rules.end(),
                   [&](const Rule& r) { return r.kind != Rule::Kind::kMissing && r.entries.contain(entry); });
  if (rule == rules.end()) return enter();
  next = static_cast<std::size_t>(rule - rules.begin()) + 1;
  if (rule->kind == Rule::Kind::kLate) go();
  if (rule->condition.holds(*this))
    rule->step(*this);
  else if (rule->kind != Rule::Kind::kLate)
    go();
  next = before;
}

// --- Tracked state -----------------------------------------------------------------------------------------

bool TrackedState::has_vertex_map(int dimension) {
  return dimension == 1 ? enabled[GL_MAP1_VERTEX_3] || enabled[GL_MAP1_VERTEX_4]
                        : enabled[GL_MAP2_VERTEX_3] || enabled[GL_MAP2_VERTEX_4];
}

void TrackedState::note_before(gl::EntryPoint entry, double first, double second) {
  if (entry == End) primitive = kNoPrimitive;
  if (entry == Enable || entry == Disable) enabled[token(first)] = entry == Enable;
  if (entry == BindBuffer) buffers[token(first)] = token(second);
}

void TrackedState::note_after(gl::EntryPoint entry, double first, double second) {
  if (entry == Begin) primitive = token(first);
  if (entry == ActiveTexture) unit = token(first);
  if (entry == NewList) list_mode = token(second);
  if (entry == EndList) list_mode = 0;
  if (entry == PushAttrib && list_mode == 0) masks.push_back(token(first));
  if (entry == PopAttrib && list_mode == 0 && !masks.empty()) masks.pop_back();
  if (entry == ContextOfKindEVALCTS) kind = token(second);
}

}  // namespace evalcts::faults
