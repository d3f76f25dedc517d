// Issues the commands of a case, with client arrays next to inaccessible pages, and drains the errors at its
// end.
#include <evalcts/gl/player.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <future>
#include <list>
#include <map>
#ifdef _WIN32
#include <xmmintrin.h>
#endif

#include <evalcts/gl/call_in_flight.h>
#include <evalcts/gl/errors.h>
#include <evalcts/gl/roles.h>
#include "pages.h"

namespace evalcts::gl {
namespace {

constexpr std::byte kFiller{0xA5};
constexpr std::size_t kMostErrors = 16;

#ifdef _WIN32
constexpr unsigned kDefaultMxcsr = 0x1F80;
#endif
constexpr std::byte kUnlikely{0x4B};  // a float or double of these bytes is a large finite number

// Pages between two inaccessible pages. A few are kept for reuse, because mapping them costs more than most
// calls.
class FencedPages {
 public:
  static FencedPages take(std::size_t count) {
    FencedPages pages(count);
    if (count > kFew) {
      pages.base_ = map_pages(count);
      return pages;
    }
    if (kept_of(count).empty()) {
      pages.base_ = map_pages(count);
    } else {
      pages.base_ = kept_of(count).back();
      kept_of(count).pop_back();
    }
    std::memset(pages.base_, static_cast<int>(kUnlikely), count * page_size());
    return pages;
  }
  FencedPages(FencedPages&& other) noexcept
      : base_(std::exchange(other.base_, nullptr)), count_(other.count_), protected_(other.protected_) {}
  FencedPages& operator=(FencedPages&&) = delete;
  ~FencedPages() {
    if (!base_) return;
    if (count_ <= kFew && !protected_ && kept_of(count_).size() < kMostKept)
      kept_of(count_).push_back(base_);
    else
      unmap();
  }

  std::byte* end() const { return base_ + count_ * page_size(); }
  void unmap() { unmap_pages(std::exchange(base_, nullptr), count_); }
  void protect() {
    protect_pages(base_, count_);
    protected_ = true;
  }

 private:
  static constexpr std::size_t kFew = 4, kMostKept = 512;

  explicit FencedPages(std::size_t count) : count_(count) {}
  static std::vector<std::byte*>& kept_of(std::size_t count) {
    static thread_local std::array<std::vector<std::byte*>, kFew + 1> kept;
    return kept[count];
  }

  std::byte* base_ = nullptr;
  std::size_t count_;
  bool protected_ = false;
};

// Client memory that ends directly before an inaccessible page, so that reading past the end crashes.
class ClientArray {
 public:
  explicit ClientArray(const Input& input)
      : size_(input.bytes.size()), pages_(FencedPages::take((size_ + page_size() - 1) / page_size())) {
    fill(input);
  }

  void fill(const Input& input) {
    if (size_ > 0) std::memcpy(data(), input.bytes.data(), size_);
  }
  std::byte* data() { return pages_.end() - size_; }

  void meet(AfterCall after_call) {
    switch (after_call) {
      case AfterCall::kKeep:
        return;
      case AfterCall::kOverwrite:
        std::memset(data(), static_cast<int>(kUnlikely), size_);
        return;
      case AfterCall::kUnmap:
        return pages_.unmap();
      case AfterCall::kProtect:
        return pages_.protect();
    }
  }

 private:
  std::size_t size_;
  FencedPages pages_;
};

// Returns the message for a missing command. It names commands of the GL and describes those of the harness,
// whose names users do not know.
std::string describe_missing(EntryPoint missing) {
  switch (missing) {
    case EntryPoint::OtherContextEVALCTS:
      return "a second context cannot be created in addition to the first";
    case EntryPoint::SharingContextEVALCTS:
      return "a second context that shares objects with the first cannot be created";
    case EntryPoint::ContextOfKindEVALCTS:
      return "a context of the kind that the test needs cannot be created";
    case EntryPoint::CopyContextEVALCTS:
      return "state cannot be copied from one context to another (glXCopyContext)";
    case EntryPoint::MoveToThreadEVALCTS:
      return "contexts of this implementation, or contexts that tests share, stay in one thread";
    case EntryPoint::RecordRequestsEVALCTS:
    case EntryPoint::RecordedRequestsEVALCTS:
      return "no GLX requests can be recorded";
    default:
      return std::string(name_of(missing)) + " is missing";
  }
}

}  // namespace

MissingEntryPoint::MissingEntryPoint(EntryPoint missing)
    : std::runtime_error(describe_missing(missing)), entry(missing) {}

class Player {
 public:
  Player(const Table& table, const std::function<void(bool)>& set_current)
      : table_(table), set_current_(set_current) {}
  ~Player() { call_in_flight.command = nullptr; }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  Trace play(const Case& script, const std::function<void(std::size_t)>& after_each) {
    for (const Command& command : script.commands())
      if (!has(table_, command.entry)) throw MissingEntryPoint(command.entry);
    trace_.results_.resize(script.commands().size());
    issue_all(script.commands(), after_each, false);
    call_in_flight.command = nullptr;
    if (uses_other_contexts(script)) table_.OtherContextEVALCTS(0);
    trace_.left_over_errors_ = take_errors(table_);
    return std::move(trace_);
  }

 private:
  // Issues the commands from index_ on, until the context moves back to the calling thread.
  void issue_all(const std::vector<Command>& commands, const std::function<void(std::size_t)>& after_each,
                 bool in_other_thread) {
    while (index_ < commands.size()) {
      const Command& command = commands[index_];
      if (command.entry != EntryPoint::MoveToThreadEVALCTS) {
        call_in_flight.position = index_;
        call_in_flight.command = &command;
        issue(command);
        if (after_each) after_each(index_);
        ++index_;
        continue;
      }
      ++index_;
      const bool to_other_thread = integer_of(command, 0) != 0;
      if (to_other_thread == in_other_thread) continue;
      if (in_other_thread) return;
      set_current_(false);
      std::async(std::launch::async, [&] {
        set_current_(true);
        issue_all(commands, after_each, true);
        set_current_(false);
      }).get();
      set_current_(true);
    }
  }

  bool uses_other_contexts(const Case& script) const {
    if (!table_.OtherContextEVALCTS) return false;
    return std::ranges::any_of(script.commands(), [](const Command& command) {
      return command.entry == EntryPoint::OtherContextEVALCTS ||
             command.entry == EntryPoint::SharingContextEVALCTS ||
             command.entry == EntryPoint::ContextOfKindEVALCTS;
    });
  }

  void issue(const Command& command) {
    switch (command.entry) {
#define GL_ENTRY(name, kinds)     \
  case EntryPoint::name:          \
    invoke(table_.name, command); \
    break;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
    }
    for (std::size_t i = 0; i < command.arguments.size(); ++i)
      if (const auto* input = std::get_if<Input>(&command.arguments[i]))
        inputs_of_call_[i]->meet(input->after);
  }

  template <class Result, class... Parameters>
  void invoke(Result (*function)(Parameters...), const Command& command) {
    invoke_with(function, command, std::index_sequence_for<Parameters...>());
  }

  template <class Result, class... Parameters, std::size_t... kIndices>
  void invoke_with(Result (*function)(Parameters...), const Command& command,
                   std::index_sequence<kIndices...>) {
    // Braces fix the order of evaluation: memory for pointers is set up from the first argument to the last.
    [[maybe_unused]] const std::tuple<Parameters...> arguments{
        argument<Parameters>(command.arguments[kIndices], kIndices)...};
    if constexpr (std::is_void_v<Result>) {
      function(std::get<kIndices>(arguments)...);
    } else {
      keep(function(std::get<kIndices>(arguments)...));
    }
  }

  template <class T>
  void keep(T value) {
    Trace::Result& result = trace_.results_[index_];
    if constexpr (std::is_pointer_v<T>) {
      if (value) result.text = reinterpret_cast<const char*>(value);
    } else {
      result.value = static_cast<std::int64_t>(value);
    }
  }

  template <class Parameter>
  Parameter argument(const Value& value, std::size_t position) {
    if constexpr (std::is_pointer_v<Parameter>) {
      return reinterpret_cast<Parameter>(pointer(value, position));
    } else {
      if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<Parameter>(*integer);
      if (const auto* single = std::get_if<float>(&value)) return static_cast<Parameter>(*single);
      if (const auto* real = std::get_if<double>(&value)) return static_cast<Parameter>(*real);
      if (const auto* result = std::get_if<ResultOf>(&value)) return static_cast<Parameter>(earlier(*result));
      return Parameter{};
    }
  }

  void* pointer(const Value& value, std::size_t position) {
    if (const auto* input = std::get_if<Input>(&value)) {
      ClientArray*& shared = slots_[{input->slot, input->bytes.size()}];
      if (input->slot >= 0 && shared) {
        shared->fill(*input);
      } else {
        shared = &inputs_.emplace_back(*input);
      }
      inputs_of_call_[position] = shared;
      return inputs_of_call_[position]->data();
    }
    if (const auto* output = std::get_if<Output>(&value)) {
      if (trace_.results_[index_].output)
        throw std::logic_error("a command fills one array of a case at most");
      Trace::Output written{output->type, output->count, {}};
      written.bytes.assign((output->count + kGuardElements) * size_of(output->type), kFiller);
      return trace_.results_[index_].output.emplace(std::move(written)).bytes.data();
    }
    if (const auto* strings = std::get_if<Strings>(&value)) {
      auto& pointers = strings_.emplace_back();
      for (const std::string& text : strings->values) pointers.push_back(text.c_str());
      return pointers.data();
    }
    return nullptr;
  }

  std::int64_t earlier(const ResultOf& which) const {
    const Trace::Result& result = trace_.results_.at(static_cast<std::size_t>(which.command));
    if (which.element < 0) return result.value;
    std::uint32_t element = 0;
    std::memcpy(&element, result.output.value().bytes.data() + 4 * static_cast<std::size_t>(which.element),
                4);
    return element;
  }

  const Table& table_;
  const std::function<void(bool)>& set_current_;
  Trace trace_;
  std::size_t index_ = 0;
  std::list<ClientArray> inputs_;  // all arrays exist until the case ends
  std::map<std::pair<int, std::size_t>, ClientArray*> slots_;
  std::list<std::vector<const char*>> strings_;
  std::array<ClientArray*, 16> inputs_of_call_{};
};

std::vector<GLenum> take_errors(const Table& table) {
  std::vector<GLenum> errors;
  while (table.GetError && errors.size() < kMostErrors) {
    const GLenum error = table.GetError();
    if (error == GL_NO_ERROR) break;
    errors.push_back(error);
  }
  return errors;
}

Trace play(const Case& script, const Table& table, const std::function<void(std::size_t)>& after_each,
           const std::function<void(bool)>& set_current) {
  Trace trace = Player(table, set_current).play(script, after_each);
  std::fesetenv(FE_DFL_ENV);
#ifdef _WIN32
  _mm_setcsr(kDefaultMxcsr);  // fesetenv() of mingw leaves it as it is
#endif
  return trace;
}

const Trace::Output& Trace::output(Ref command) const {
  const auto& output = results_.at(static_cast<std::size_t>(command.index)).output;
  if (!output) throw std::logic_error("this command writes no array");
  return *output;
}

std::int64_t Trace::result(Ref command) const {
  return results_.at(static_cast<std::size_t>(command.index)).value;
}

const std::string& Trace::text(Ref get_string) const {
  return results_.at(static_cast<std::size_t>(get_string.index)).text;
}

bool Trace::has_output(Ref command) const {
  return results_.at(static_cast<std::size_t>(command.index)).output.has_value();
}

std::vector<std::byte> Trace::bytes(Ref command) const {
  const Output& array = output(command);
  return {array.bytes.begin(),
          array.bytes.begin() + static_cast<std::ptrdiff_t>(array.count * size_of(array.type))};
}

Trace Trace::of(const std::vector<int>& commands) const {
  Trace chosen;
  chosen.left_over_errors_ = left_over_errors_;
  for (const int command : commands)
    chosen.results_.push_back(command < 0 ? Result() : results_.at(static_cast<std::size_t>(command)));
  return chosen;
}

void Trace::replace_result(Ref command, std::int64_t value) {
  results_.at(static_cast<std::size_t>(command.index)).value = value;
}

void Trace::replace_element(Ref command, std::size_t element, double value) {
  Output& array = results_.at(static_cast<std::size_t>(command.index)).output.value();
  if (element >= array.count) throw std::logic_error("no such element");
  const auto store = [&](auto converted) {
    std::memcpy(array.bytes.data() + element * sizeof converted, &converted, sizeof converted);
  };
  switch (array.type) {
    case Scalar::kU8:
      return store(static_cast<std::uint8_t>(value));
    case Scalar::kI8:
      return store(static_cast<std::int8_t>(value));
    case Scalar::kI32:
      return store(static_cast<std::int32_t>(value));
    case Scalar::kU32:
      return store(static_cast<std::uint32_t>(value));
    case Scalar::kI64:
      return store(static_cast<std::int64_t>(value));
    case Scalar::kF32:
      return store(static_cast<float>(value));
    case Scalar::kF64:
      return store(value);
  }
}

std::size_t Trace::written(Ref command) const {
  const Output& output_array = output(command);
  std::size_t last = output_array.bytes.size();
  while (last > 0 && output_array.bytes[last - 1] == kFiller) --last;
  const std::size_t element = size_of(output_array.type);
  return (last + element - 1) / element;
}

bool Trace::same(Ref a, const Trace& other, Ref b) const {
  const Result& mine = results_.at(static_cast<std::size_t>(a.index));
  const Result& theirs = other.results_.at(static_cast<std::size_t>(b.index));
  if (mine.value != theirs.value || mine.text != theirs.text) return false;
  if (mine.output.has_value() != theirs.output.has_value()) return false;
  return !mine.output || mine.output->bytes == theirs.output->bytes;
}

}  // namespace evalcts::gl
