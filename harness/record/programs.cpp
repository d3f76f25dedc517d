// Splits recordings into programs.
#include <evalcts/record/programs.h>

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <utility>

#include <evalcts/gl/case_json.h>
#include <evalcts/gl/roles.h>
#include <evalcts/judge/prediction.h>
#include "state.h"

namespace evalcts::record {
namespace {

constexpr std::uint64_t kMostVertices = 2000;  // behind so many, a program ends where it can
constexpr std::uint64_t kProgressStep = 1 << 16;
constexpr int kErrorKinds = 6;  // from INVALID_ENUM to OUT_OF_MEMORY

bool is_specified(gl::EntryPoint entry) {
  static const std::vector<bool> kSpecified = [] {
    gl::Case all;
    for (std::size_t i = 0; i < gl::kEntryPointCount; ++i) {
      const auto each = static_cast<gl::EntryPoint>(i);
      if (!gl::name_of(each).ends_with("EVALCTS")) all.add({each, {}});
    }
    return specified_commands(all, OtherState::kRejected);
  }();
  const auto place = static_cast<std::size_t>(entry);
  return place < kSpecified.size() && kSpecified[place];  // the commands of the harness come last
}

// Returns true if the specification has the command and the command can be a part of a program. The names of
// lists need not be asked for: a program defines the lists that it calls under their recorded names. Other
// state belongs to other parts of the GL.
bool belongs_to_programs(const gl::Command& command) {
  using gl::EntryPoint;
  static const reference::Specification kSpecification;
  if (!is_specified(command.entry)) return false;
  const auto name = static_cast<GLenum>(gl::integer_of(command, 0));
  switch (command.entry) {
    case EntryPoint::GenLists:
    case EntryPoint::IsList:
    case EntryPoint::GetString:
    case EntryPoint::GetStringi:
    case EntryPoint::Flush:
    case EntryPoint::Finish:
      return false;
    case EntryPoint::Enable:
    case EntryPoint::Disable:
    case EntryPoint::IsEnabled:
      return kSpecification.has_state(name);
    default:
      return gl::role_of(command.entry) != gl::Role::kGet || kSpecification.has_state(name);
  }
}

// Gives a query of the control points of a map room for the answer.
void make_room(gl::Command& command, const State& state) {
  if (gl::role_of(command.entry) != gl::Role::kGetMap) return;
  if (auto* const answer = std::get_if<gl::Output>(&command.arguments.back()))
    answer->count = std::max(answer->count, state.control_values(gl::integer_of(command, 0)));
}

// The programs of a context, one behind the other.
class Splitter {
 public:
  Splitter(std::string prefix, const Frames& frames, std::vector<Program>& programs,
           std::map<std::string, std::size_t>& places)
      : prefix_(std::move(prefix)), frames_(frames), programs_(programs), places_(places) {}

  void add(gl::Command command) {
    if (!belongs_to_programs(command) || frame_ > frames_.last) return;
    make_room(command, state_);
    const Drawing drawing = state_.executes() ? state_.drawing_of(command) : Drawing();
    if (state_.is_neutral() && drawing_.vertices >= kMostVertices) end_program();
    state_.apply(command, [this](const gl::Command& executed) { return specification_.accepts(executed); });
    if (frame_ < frames_.first) return;
    drawing_.add(drawing);
    commands_.push_back(std::move(command));
  }

  void end_frame() {
    if (state_.is_neutral()) end_program();
    ++frame_;
    number_ = 0;
  }

  // Ends primitives and lists that are open at the end of the recording.
  void end() {
    using gl::EntryPoint;
    for (int i = 0; i < 2 && !state_.is_neutral(); ++i)
      add({state_.is_compiling() ? EntryPoint::EndList : EntryPoint::End, {}});
    end_program();
  }

 private:
  void end_program() {
    if (drawing_.concerns_evaluators) keep();
    drawing_ = {};
    commands_.clear();
    begin_ = state_;
  }

  void keep() {
    gl::Case script = begin_.commands_before(commands_);
    for (const gl::Command& command : commands_) script.add(command);
    // A distributed implementation may keep an error of each kind, and errors that are left over are
    // failures.
    const bool raises = may_raise_an_error(script, reference::kMaxOrder);
    for (int i = 0; i < (raises ? kErrorKinds : 1); ++i) script.GetError();
    std::string text = gl::to_text(script, gl::NonFinite::kByName);
    ++number_;
    if (const auto known = places_.find(text); known != places_.end()) {
      ++programs_[known->second].times;
      return;
    }
    places_.emplace(text, programs_.size());
    programs_.push_back({fmt::format("{}Frame{}/{}", prefix_, frame_, number_), std::move(text),
                         predict(script, reference::kMaxOrder).vertex_count()});
  }

  const std::string prefix_;
  const Frames& frames_;
  std::vector<Program>& programs_;
  std::map<std::string, std::size_t>& places_;  // of programs, by their commands
  SpecifiedContext specification_{reference::kMaxOrder};
  State state_, begin_;  // now, and at the beginning of the program
  std::vector<gl::Command> commands_;
  Drawing drawing_;
  std::uint64_t frame_ = 0;
  int number_ = 0;  // of programs of the frame
};

}  // namespace

std::optional<Frames> parse_frames(const std::string& text) {
  Frames frames;
  const char* const end = text.data() + text.size();
  const auto [middle, error] = std::from_chars(text.data(), end, frames.first);
  if (error != std::errc()) return {};
  frames.last = frames.first;
  if (middle == end) return frames;
  if (!std::string_view(middle, end).starts_with("..")) return {};
  const auto [stop, last_error] = std::from_chars(middle + 2, end, frames.last);
  if (last_error != std::errc() || stop != end || frames.last < frames.first) return {};
  return frames;
}

std::vector<Program> programs_of(const Recording& recording, const Frames& frames,
                                 const std::function<void(std::uint64_t)>& progress) {
  std::vector<Program> programs;
  std::map<std::string, std::size_t> places;
  std::uint64_t count = 0;
  for (std::size_t context = 0; context < recording.contexts(); ++context) {
    Splitter splitter(recording.contexts() > 1 ? fmt::format("Context{}", context + 1) : "", frames, programs,
                      places);
    recording.read(
        context,
        [&](gl::Command command) {
          splitter.add(std::move(command));
          if (++count % kProgressStep == 0 && progress) progress(count);
        },
        [&] { splitter.end_frame(); });
    splitter.end();
  }
  return programs;
}

}  // namespace evalcts::record
