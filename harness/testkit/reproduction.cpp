// Records the cases of a test, finds the check that distinguishes the failure, and writes the C program.
#include <evalcts/testkit/reproduction.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <evalcts/backends/context_in_front.h>

namespace evalcts {
namespace {

// An executed case and its results.
struct Pass {
  gl::Case script;
  gl::Trace trace;
  std::vector<ObservedPrimitive> emitted;
  bool missing_command = false;
};

const gl::Table& no_commands() {
  static const gl::Table kTable;
  return kTable;
}

// An implementation that returns the recorded answers, regardless of the case.
class Replay final : public Implementation {
 public:
  explicit Replay(std::vector<Pass> passes) : passes_(std::move(passes)) {}

  std::string name() const override { return "replay"; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<ReplayContext>(passes_.at(next_ < passes_.size() ? next_++ : next_ - 1));
  }

 private:
  class ReplayContext final : public Context {
   public:
    explicit ReplayContext(const Pass& pass) : pass_(pass) {}
    const gl::Table& table() const override { return no_commands(); }
    gl::Trace play(const gl::Case&) override { return pass_.trace; }
    bool has_sink() const override { return !pass_.emitted.empty(); }
    std::vector<ObservedPrimitive> take_emitted() override { return pass_.emitted; }

   private:
    const Pass& pass_;
  };

  std::vector<Pass> passes_;
  std::size_t next_ = 0;
};

// Returns value `index` of the vertex, in the order of gl::kEmittedValues.
float* value_of(ObservedVertex& vertex, std::size_t index) {
  if (index < 4) return &vertex.position[index];
  if (index < 8) return &vertex.color[index - 4];
  if (index < 11) return &vertex.normal[index - 8];
  return &vertex.texture_coordinate[(index - 11) / 4][(index - 11) % 4];
}

std::size_t vertices_in(const std::vector<ObservedPrimitive>& primitives) {
  std::size_t count = 0;
  for (const ObservedPrimitive& primitive : primitives) count += primitive.vertices.size();
  return count;
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Finds the answer that a mismatch depends on, by changing one recorded answer after the other until the
// mismatch disappears.
class Experiment {
 public:
  // `still_fails` returns true if the mismatch occurs when the case is observed on the given implementation.
  Experiment(const std::vector<Pass>& passes, const Mismatch& mismatch,
             std::function<bool(Implementation&)> still_fails)
      : passes_(passes), mismatch_(mismatch), still_fails_(std::move(still_fails)) {
    check_.accepted = {{mismatch.lowest, mismatch.highest}};
    check_.what = mismatch.what;
    check_.expected = mismatch.expected;
  }

  // Returns none if the mismatch does not depend on a single answer.
  std::optional<gl::Check> find_check() {
    for (check_.pass = 0; check_.pass < passes_.size(); ++check_.pass)
      if (find_in_pass()) return check_;
    return std::nullopt;
  }

 private:
  using Kind = gl::Answer::Kind;

  const Pass& pass() const { return passes_[check_.pass]; }

  bool find_in_pass() {
    switch (mismatch_.kind) {
      case Mismatch::Kind::kValue:
        return find_emitted_value() || find_element();
      case Mismatch::Kind::kError:
        return find_error();
      case Mismatch::Kind::kVertices:
        return find_count();
    }
    return false;
  }

  bool find_emitted_value() {
    const float other = other_value();
    std::size_t index = 0;
    for (std::size_t i = 0; i < pass().emitted.size(); ++i)
      for (std::size_t k = 0; k < pass().emitted[i].vertices.size(); ++k)
        for (std::size_t v = 0; v < gl::kEmittedValues; ++v, ++index) {
          ObservedVertex vertex = pass().emitted[i].vertices[k];
          if (same_bits(*value_of(vertex, v), got()) &&
              decides({Kind::kEmittedValue, {}, index},
                      [&](Pass& changed) { *value_of(changed.emitted[i].vertices[k], v) = other; }))
            return true;
        }
    return false;
  }

  bool find_element() {
    const gl::Trace& trace = pass().trace;
    for (gl::Ref command{0}; command.index < static_cast<int>(trace.size()); ++command.index) {
      if (!trace.has_output(command) || trace.type(command) != gl::Scalar::kF32) continue;
      const std::vector<float> values = trace.values<float>(command);
      for (std::size_t e = 0; e < values.size(); ++e)
        if (same_bits(values[e], got()) && decides({Kind::kElement, command, e}, [&](Pass& changed) {
              changed.trace.replace_element(command, e, other_value());
            }))
          return true;
    }
    return false;
  }

  bool find_error() {
    const std::vector<gl::Command>& commands = pass().script.commands();
    for (gl::Ref command = last_command(); command.index >= 0; --command.index)
      if (commands[static_cast<std::size_t>(command.index)].entry == gl::EntryPoint::GetError &&
          static_cast<double>(pass().trace.result(command)) == mismatch_.got &&
          decides({Kind::kReturned, command, 0, true}, [&](Pass& changed) {
            changed.trace.replace_result(command, static_cast<std::int64_t>(mismatch_.lowest));
          }))
        return true;
    return false;
  }

  // Finds the answer that determines the number of vertices: the emitted vertices, or an answer to the
  // capture's own commands after the case. Only the capture knows the correct answer, so the check only
  // requires a different one.
  bool find_count() {
    if (!pass().emitted.empty() && mismatch_.got != mismatch_.lowest) {
      check_.answer = {Kind::kEmittedVertices};
      return true;
    }
    const gl::Trace& trace = pass().trace;
    for (gl::Ref command = last_command(); command.index >= 0; --command.index) {
      const bool array = trace.has_output(command);
      if (array && (trace.type(command) != gl::Scalar::kU32 || trace.capacity(command) != 1)) continue;
      const std::int64_t answer = array ? trace.values<std::uint32_t>(command)[0] : trace.result(command);
      const std::int64_t other = answer == 0 ? 13 : 0;
      if (!decides({Kind::kReturned, command}, [&](Pass& changed) {
            if (array)
              changed.trace.replace_element(command, 0, static_cast<double>(other));
            else
              changed.trace.replace_result(command, other);
          }))
        continue;
      check_.rule = gl::Check::Rule::kUnlike;
      check_.recorded = {command};
      return true;
    }
    return false;
  }

  gl::Ref last_command() const { return {static_cast<int>(pass().trace.size()) - 1}; }
  float got() const { return static_cast<float>(mismatch_.got); }

  // Returns a value that would not be a mismatch.
  float other_value() const {
    const double middle = mismatch_.lowest + (mismatch_.highest - mismatch_.lowest) / 2;
    if (std::isfinite(middle) && !same_bits(static_cast<float>(middle), got()))
      return static_cast<float>(middle);
    return got() == 0.0f ? 1.0f : 0.0f;
  }

  // Returns true if the mismatch disappears when the answer is changed. Then the answer becomes that
  // of the check.
  template <class Change>
  bool decides(const gl::Answer& answer, const Change& change) {
    std::vector<Pass> changed = passes_;
    change(changed[check_.pass]);
    Replay replay(std::move(changed));
    try {
      if (still_fails_(replay)) return false;
    } catch (const std::exception&) {
      // If the capture cannot decode the changed answers, the mismatch has disappeared, too.
    }
    check_.answer = answer;
    return true;
  }

  const std::vector<Pass>& passes_;
  const Mismatch& mismatch_;
  std::function<bool(Implementation&)> still_fails_;
  gl::Check check_;
};

}  // namespace

class Reproduction::Recorder final : public ImplementationInFront {
 public:
  Recorder(Implementation& inner, Write write, gl::CStyle style)
      : ImplementationInFront(inner), write_(std::move(write)), style_(style) {}

  std::unique_ptr<Context> create_context() override {
    return std::make_unique<RecordingContext>(*this, inner().create_context());
  }
  std::unique_ptr<Context> create_beside() override { return nullptr; }

  void begin_case(const gl::Case& script) {
    in_control_ = script.is_control();
    if (in_control_) return;
    passes_.clear();
    own_.clear();
    for (const gl::Command& command : script.commands()) own_.push_back(command.entry);
  }
  const std::vector<Pass>& passes() const { return passes_; }
  void freeze() { frozen_ = true; }
  bool frozen() const { return frozen_; }

  void write(std::size_t pass, const gl::Check* check) const {
    std::string text;
    // A capture encloses the commands of the test; its deliveries may have changed some of them.
    const std::vector<gl::Command>& commands = passes_.at(pass).script.commands();
    const auto first =
        std::search(commands.begin(), commands.end(), own_.begin(), own_.end(),
                    [](const gl::Command& command, gl::EntryPoint own) { return command.entry == own; });
    const bool is_found = first != commands.end() && !own_.empty();
    try {
      text = gl::to_c({.style = style_,
                       .context = context_kind(),
                       .context_library = context_library(),
                       .library = library(),
                       .library_below = library_below(),
                       .script = &passes_.at(pass).script,
                       .first_own = is_found ? static_cast<std::size_t>(first - commands.begin()) : 0,
                       .own = is_found ? own_.size() : SIZE_MAX,
                       .check = check,
                       .trace = &passes_.at(pass).trace,
                       .emitted_vertices = vertices_in(passes_.at(pass).emitted)});
    } catch (const gl::NoCProgram& why) {
      text = fmt::format("#error {}\n", why.what());
    }
    write_(text);
  }

 private:
  class RecordingContext final : public ContextInFront {
   public:
    RecordingContext(Recorder& recorder, std::unique_ptr<Context> inner)
        : ContextInFront(std::move(inner)), recorder_(recorder) {}

    gl::Trace play(const gl::Case& script) override {
      if (recorder_.frozen_ || recorder_.in_control_) return inner().play(script);
      pass_ = recorder_.passes_.size();
      recorder_.passes_.push_back({script, {}, {}});
      recorder_.write(*pass_, nullptr);
      try {
        gl::Trace trace = inner().play(script);
        recorder_.passes_[*pass_].trace = trace;
        return trace;
      } catch (const gl::MissingEntryPoint&) {
        recorder_.passes_[*pass_].missing_command = true;
        throw;
      }
    }

    std::vector<ObservedPrimitive> take_emitted() override {
      std::vector<ObservedPrimitive> emitted = inner().take_emitted();
      if (!recorder_.frozen_ && pass_ && *pass_ < recorder_.passes_.size())
        recorder_.passes_[*pass_].emitted = emitted;
      return emitted;
    }

   private:
    Recorder& recorder_;
    std::optional<std::size_t> pass_;  // none before a case is recorded
  };

  Write write_;
  gl::CStyle style_;
  std::vector<Pass> passes_;
  std::vector<gl::EntryPoint> own_;  // of the test's case, without a capture
  bool frozen_ = false, in_control_ = false;
};

Reproduction::Reproduction(Implementation& implementation, Write write, gl::CStyle style)
    : recorder_(std::make_unique<Recorder>(implementation, std::move(write), style)) {}
Reproduction::~Reproduction() = default;

Implementation& Reproduction::implementation() { return *recorder_; }

bool Reproduction::is_complete() const { return recorder_->frozen(); }

void Reproduction::begin_case(const gl::Case& script) {
  if (!recorder_->frozen()) recorder_->begin_case(script);
}

std::optional<gl::Check> Reproduction::check_of(const Mismatch& mismatch, const std::vector<Mismatch>& all,
                                                const Rejudge& rejudge) const {
  if (recorder_->frozen()) return std::nullopt;
  // The same mismatch may occur several times, because a vertex may be drawn several times.
  const auto times = [&](const std::vector<Mismatch>& mismatches) {
    return std::ranges::count_if(mismatches, [&](const Mismatch& other) {
      return other.what == mismatch.what && other.captured == mismatch.captured;
    });
  };
  const auto still_fails = [&](Implementation& replay) { return times(rejudge(replay)) == times(all); };
  return Experiment(recorder_->passes(), mismatch, still_fails).find_check();
}

void Reproduction::failed(const Failure& failure, const std::optional<gl::Check>& decided) {
  if (recorder_->frozen() || recorder_->passes().empty()) return;
  const Pass& last = recorder_->passes().back();
  gl::Check& check = check_.emplace();
  if (decided) {
    check = *decided;
  } else if (last.missing_command) {
    check.rule = gl::Check::Rule::kHasCommands;
  } else {
    // The test compared the answers by itself, so the check records all of them.
    check.rule = gl::Check::Rule::kUnlike;
    check.pass = recorder_->passes().size() - 1;
    check.what = failure.what;
    check.expected = failure.expected;
    for (int c = 0; c < static_cast<int>(last.trace.size()); ++c)
      if (last.trace.has_output({c})) check.recorded.push_back({c});
  }
  if (check.expected.empty()) check.expected = failure.expected;
  recorder_->write(check.pass, &check);
  recorder_->freeze();
}

}  // namespace evalcts
