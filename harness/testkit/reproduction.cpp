#include <evalcts/testkit/reproduction.h>

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include <evalcts/gl/c_program.h>

namespace evalcts {
namespace {

// A case as it was played, and what came of it.
struct Pass {
  gl::Case script;
  gl::Trace trace;
  std::vector<ObservedPrimitive> emitted;
  bool missing_command = false;
};

const gl::Table& no_commands() {
  static const gl::Table table;
  return table;
}

// Gives the recorded answers again, whatever is played.
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

// The vertex's values in the order of gl::Check.
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

}  // namespace

class Reproduction::Recorder final : public ImplementationInFront {
 public:
  Recorder(Implementation& inner, std::string file) : ImplementationInFront(inner), file_(std::move(file)) {}

  std::unique_ptr<Context> create_context() override {
    return std::make_unique<RecordingContext>(*this, inner().create_context());
  }
  std::unique_ptr<Context> create_beside() override { return nullptr; }

  void begin_case() { passes_.clear(); }
  const std::vector<Pass>& passes() const { return passes_; }
  void freeze() { frozen_ = true; }
  bool frozen() const { return frozen_; }

  void write(std::size_t pass, const gl::Check* check) const {
    std::string text;
    try {
      text = gl::to_c({.context = context_kind(),
                       .context_library = context_library(),
                       .library = library(),
                       .script = &passes_.at(pass).script,
                       .check = check,
                       .trace = &passes_.at(pass).trace,
                       .emitted_vertices = vertices_in(passes_.at(pass).emitted)});
    } catch (const gl::NoCProgram& why) {
      text = fmt::format("#error {}\n", why.what());
    }
    std::ofstream stream(file_, std::ios::trunc);
    stream << text;
    if (!stream.flush()) throw std::runtime_error(fmt::format("cannot write '{}'", file_));
  }

 private:
  class RecordingContext final : public Context {
   public:
    RecordingContext(Recorder& recorder, std::unique_ptr<Context> inner)
        : recorder_(recorder), inner_(std::move(inner)) {}

    const gl::Table& table() const override { return inner_->table(); }
    bool has_sink() const override { return inner_->has_sink(); }
    Attributes emitted_attributes() const override { return inner_->emitted_attributes(); }

    gl::Trace play(const gl::Case& script) override {
      if (recorder_.frozen_) return inner_->play(script);
      pass_ = recorder_.passes_.size();
      recorder_.passes_.push_back({script, {}, {}});
      recorder_.write(pass_, nullptr);
      try {
        gl::Trace trace = inner_->play(script);
        recorder_.passes_[pass_].trace = trace;
        return trace;
      } catch (const gl::MissingEntryPoint&) {
        recorder_.passes_[pass_].missing_command = true;
        throw;
      }
    }

    std::vector<ObservedPrimitive> take_emitted() override {
      std::vector<ObservedPrimitive> emitted = inner_->take_emitted();
      if (!recorder_.frozen_ && pass_ < recorder_.passes_.size()) recorder_.passes_[pass_].emitted = emitted;
      return emitted;
    }

   private:
    Recorder& recorder_;
    std::unique_ptr<Context> inner_;
    std::size_t pass_ = 0;
  };

  std::string file_;
  std::vector<Pass> passes_;
  bool frozen_ = false;
};

Reproduction::Reproduction(Implementation& implementation, std::string file)
    : recorder_(std::make_unique<Recorder>(implementation, file)), file_(std::move(file)) {}
Reproduction::~Reproduction() = default;

Implementation& Reproduction::implementation() { return *recorder_; }

void Reproduction::begin_case() {
  if (!recorder_->frozen()) recorder_->begin_case();
}

std::optional<gl::Check> Reproduction::check_of(const Mismatch& mismatch,
                                                const std::function<bool(Implementation&)>& still) const {
  if (recorder_->frozen()) return std::nullopt;
  const std::vector<Pass>& passes = recorder_->passes();
  gl::Check check;
  check.accepted = {{mismatch.lowest, mismatch.highest}};
  check.what = mismatch.what;
  check.expected = mismatch.expected;

  const auto matters = [&](std::size_t pass, const std::function<void(Pass&)>& change) {
    std::vector<Pass> changed = passes;
    change(changed[pass]);
    Replay replay(std::move(changed));
    try {
      return !still(replay);
    } catch (const std::exception&) {
      return true;  // the capture cannot make sense of it any more
    }
  };
  const auto found = [&](std::size_t pass, gl::Answer answer) {
    check.pass = pass;
    check.answer = answer;
    return check;
  };
  using Of = gl::Answer::Of;

  if (mismatch.of == Mismatch::Of::value) {
    const auto got = static_cast<float>(mismatch.got);
    const double middle = mismatch.lowest + (mismatch.highest - mismatch.lowest) / 2;
    const auto other = std::isfinite(middle) && !same_bits(static_cast<float>(middle), got)
                           ? static_cast<float>(middle)
                       : got == 0.0f ? 1.0f
                                     : 0.0f;
    for (std::size_t p = 0; p < passes.size(); ++p) {
      std::size_t vertex_index = 0;
      for (std::size_t i = 0; i < passes[p].emitted.size(); ++i)
        for (std::size_t k = 0; k < passes[p].emitted[i].vertices.size(); ++k, ++vertex_index)
          for (std::size_t v = 0; v < gl::kEmittedValues; ++v) {
            ObservedVertex vertex = passes[p].emitted[i].vertices[k];
            if (!same_bits(*value_of(vertex, v), got)) continue;
            if (matters(p, [&](Pass& pass) { *value_of(pass.emitted[i].vertices[k], v) = other; }))
              return found(p, {Of::emitted_value, {}, vertex_index * gl::kEmittedValues + v});
          }
      for (int c = 0; c < static_cast<int>(passes[p].trace.size()); ++c) {
        const gl::Ref command{c};
        if (!passes[p].trace.has_output(command) || passes[p].trace.type(command) != gl::Scalar::f32)
          continue;
        const std::vector<float> values = passes[p].trace.values<float>(command);
        for (std::size_t e = 0; e < values.size(); ++e)
          if (same_bits(values[e], got) &&
              matters(p, [&](Pass& pass) { pass.trace.replace_element(command, e, other); }))
            return found(p, {Of::element, command, e});
      }
    }
    return std::nullopt;
  }

  if (mismatch.of == Mismatch::Of::error) {
    for (std::size_t p = 0; p < passes.size(); ++p)
      for (int c = static_cast<int>(passes[p].trace.size()) - 1; c >= 0; --c) {
        const gl::Ref command{c};
        if (passes[p].script.commands()[static_cast<std::size_t>(c)].entry != gl::EntryPoint::GetError ||
            static_cast<double>(passes[p].trace.result(command)) != mismatch.got)
          continue;
        if (matters(p, [&](Pass& pass) {
              pass.trace.replace_result(command, static_cast<std::int64_t>(mismatch.lowest));
            }))
          return found(p, {Of::returned, command, 0, true});
      }
    return std::nullopt;
  }

  // The number of vertices: counted here, or something that the capture asked for after the case. How many
  // values a right library would answer is the capture's business, so a different answer is all that can be
  // asked for.
  for (std::size_t p = 0; p < passes.size(); ++p) {
    if (!passes[p].emitted.empty() && mismatch.got != mismatch.lowest)
      return found(p, {Of::emitted_vertices});
    for (int c = static_cast<int>(passes[p].trace.size()) - 1; c >= 0; --c) {
      const gl::Ref command{c};
      const gl::Trace& trace = passes[p].trace;
      const bool array = trace.has_output(command);
      if (array && (trace.type(command) != gl::Scalar::u32 || trace.capacity(command) != 1)) continue;
      const std::int64_t answer = array ? trace.values<std::uint32_t>(command)[0] : trace.result(command);
      const std::int64_t other = answer == 0 ? 13 : 0;
      if (!matters(p, [&](Pass& pass) {
            if (array) {
              pass.trace.replace_element(command, 0, static_cast<double>(other));
            } else {
              pass.trace.replace_result(command, other);
            }
          }))
        continue;
      check.rule = gl::Check::Rule::unlike;
      check.recorded = {command};
      return found(p, {Of::returned, command});
    }
  }
  return std::nullopt;
}

void Reproduction::failed(const Failure& failure, const std::optional<gl::Check>& decided) {
  if (recorder_->frozen() || recorder_->passes().empty()) return;
  const Pass& last = recorder_->passes().back();
  gl::Check& check = check_.emplace();
  if (decided) {
    check = *decided;
  } else if (last.missing_command) {
    check.rule = gl::Check::Rule::has_commands;
  } else {
    // A comparison of the test's own: whatever the commands wrote or returned.
    check.rule = gl::Check::Rule::unlike;
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
