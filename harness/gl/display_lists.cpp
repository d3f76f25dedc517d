// Implements the deliveries through display lists: chooses the commands to compile and inserts NewList,
// EndList and CallList.
#include <evalcts/gl/display_lists.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace evalcts::gl {
namespace {

constexpr std::int64_t kFirstList = 0x4c00;  // far from the names that cases use

// Returns true for commands that are compiled here: evaluators, commands that are legal between Begin and
// End, and state on which errors and results of evaluators depend. (GL 4.6c 21.4.1 lists the commands that
// are executed at once.)
bool is_compiled(const Command& command) {
  const auto has_result_of = [](const Value& value) { return std::holds_alternative<ResultOf>(value); };
  if (std::ranges::any_of(command.arguments, has_result_of)) return false;
  const std::string_view name = name_of(command.entry).substr(2);
  if (name == "VertexPointer" || name == "ColorPointer" || name == "ColorMask" || name == "ClearColor")
    return false;
  constexpr std::array kBeginnings = {"Map",      "Eval",  "Vertex",   "Color",          "Normal",
                                      "TexCoord", "Index", "EdgeFlag", "SecondaryColor", "FogCoord",
                                      "Begin",    "End",   "Enable",   "Disable",        "MultiTexCoord",
                                      "Material"};
  for (const char* other : {"EndList", "BeginQuery", "EndQuery", "BeginTransformFeedback",
                            "EndTransformFeedback", "BeginConditionalRender", "EndConditionalRender",
                            "EnableClientState", "DisableClientState", "NormalPointer", "TexCoordPointer"})
    if (name == other) return false;
  if (name == "ActiveTexture" || name == "PushAttrib" || name == "PopAttrib") return true;
  return std::ranges::any_of(kBeginnings, [&](const char* start) { return name.starts_with(start); });
}

class ThroughLists {
 public:
  ThroughLists(const Case& script, Lists lists) : script_(script), lists_(lists) {
    delivered_.script = script.without_commands();
    delivered_.positions.resize(script.commands().size());
  }

  DeliveredCase apply() {
    if (lists_ == Lists::kExecuted)
      execute();
    else
      compile();
    return std::move(delivered_);
  }

 private:
  // Commands [begin, end) of the case.
  struct Run {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  const std::vector<Command>& commands() const { return script_.commands(); }

  void put(std::size_t i) {
    Command command = commands()[i];
    for (Value& argument : command.arguments)
      if (auto* result = std::get_if<ResultOf>(&argument))
        result->command = delivered_.positions[static_cast<std::size_t>(result->command)];
    delivered_.positions[i] = delivered_.script.add(std::move(command)).index;
  }
  void put(const Run& run) {
    for (std::size_t i = run.begin; i < run.end; ++i) put(i);
  }

  std::int64_t new_list(GLenum mode) {
    delivered_.script.NewList(next_list_, mode);
    return next_list_++;
  }
  std::int64_t list_of(const Run& run) {
    const std::int64_t list = new_list(GL_COMPILE);
    put(run);
    delivered_.script.EndList();
    return list;
  }
  std::int64_t list_of_calls(std::initializer_list<std::int64_t> called) {
    const std::int64_t list = new_list(GL_COMPILE);
    for (const std::int64_t inner : called) delivered_.script.CallList(inner);
    delivered_.script.EndList();
    return list;
  }

  // --- compile: lists first, then the case that calls them ------------------------------------------------

  void compile() {
    struct Step {
      Run run;
      std::vector<std::int64_t> calls;  // lists to call; empty: issue the commands themselves
    };
    std::vector<Step> steps;
    for (const auto& [run, compiled] : runs()) {
      if (!compiled) {
        steps.push_back({run, {}});
      } else if (lists_ == Lists::kSplit) {
        constexpr std::size_t kPiece = 3;
        for (std::size_t begin = run.begin, piece = 0; begin < run.end; begin += kPiece, ++piece) {
          const Run part = {begin, std::min(begin + kPiece, run.end)};
          steps.push_back({part, {}});
          if (piece % 3 != 2) steps.back().calls = {list_of(part)};
        }
      } else if (lists_ == Lists::kNested) {
        const std::size_t middle = run.begin + (run.size() + 1) / 2;
        const std::int64_t first = list_of({run.begin, middle}), second = list_of({middle, run.end});
        steps.push_back({run, {list_of_calls({first, second})}});
      } else {
        const std::int64_t list = list_of(run);
        steps.push_back({run, {list}});
        if (lists_ == Lists::kRepeated && leaves_no_primitive_open(run)) steps.back().calls.push_back(list);
      }
    }
    for (const Step& step : steps) {
      if (step.calls.empty()) put(step.run);
      for (const std::int64_t list : step.calls) delivered_.script.CallList(list);
    }
  }

  struct Part {
    Run run;
    bool compiled;
  };

  // Splits the case into runs of commands that are compiled and runs of other commands.
  std::vector<Part> runs() const {
    std::vector<Part> parts;
    bool in_own_list = false;
    for (std::size_t i = 0; i < commands().size(); ++i) {
      const EntryPoint entry = commands()[i].entry;
      if (entry == EntryPoint::NewList) in_own_list = true;
      const bool compiled = !in_own_list && is_compiled(commands()[i]);
      if (entry == EntryPoint::EndList) in_own_list = false;
      if (parts.empty() || parts.back().compiled != compiled) parts.push_back({{i, i}, compiled});
      parts.back().run.end = i + 1;
    }
    return parts;
  }

  bool leaves_no_primitive_open(const Run& run) const {
    bool open = false;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const EntryPoint entry = commands()[i].entry;
      if (entry != EntryPoint::Begin && entry != EntryPoint::End) continue;
      if ((entry == EntryPoint::Begin) == open) return false;
      open = !open;
    }
    return !open;
  }

  // --- execute: lists that are as long as possible ---------------------------------------------------------

  // Queries keep their position, because they are executed at once and see the effects of the list. A list
  // ends before a NewList of the case, and outside Begin and End.
  void execute() {
    std::size_t i = 0;
    while (i < commands().size()) {
      const std::size_t end = end_of_list(i);
      const bool worth_it = std::any_of(commands().begin() + static_cast<std::ptrdiff_t>(i),
                                        commands().begin() + static_cast<std::ptrdiff_t>(end), is_compiled);
      if (worth_it) new_list(GL_COMPILE_AND_EXECUTE);
      put(Run{i, end});
      if (worth_it) delivered_.script.EndList();
      i = end;
      if (i == commands().size()) break;
      // A list of the case, or commands after a Begin without an End.
      const bool own = commands()[i].entry == EntryPoint::NewList;
      for (bool over = false; i < commands().size() && !over; ++i) {
        put(i);
        over = own && commands()[i].entry == EntryPoint::EndList;
      }
    }
  }

  // Returns the end of the longest list that begins at `begin`, which is outside Begin and End, and that also
  // ends outside Begin and End.
  std::size_t end_of_list(std::size_t begin) const {
    std::size_t end = begin;
    bool open = false;
    for (std::size_t i = begin; i < commands().size(); ++i) {
      const EntryPoint entry = commands()[i].entry;
      if (entry == EntryPoint::NewList) break;
      if (entry == EntryPoint::Begin) open = true;
      if (entry == EntryPoint::End) open = false;
      if (!open) end = i + 1;
    }
    return end;
  }

  const Case& script_;
  const Lists lists_;
  std::int64_t next_list_ = kFirstList;
  DeliveredCase delivered_;
};

// Executes the commands of a case as the GL does, and keeps those that are not about lists.
class WithoutLists {
 public:
  explicit WithoutLists(const Case& script) : executed_(script.without_commands()) {
    for (const Command& command : script.commands()) issue(command);
  }
  Case take() { return std::move(executed_); }

 private:
  static constexpr int kMostNesting = 16;  // cases have less

  static std::int64_t integer(const Command& command, std::size_t i) {
    const auto* value = std::get_if<std::int64_t>(&command.arguments.at(i));
    return value ? *value : 0;
  }

  void issue(const Command& command) {
    if (command.entry == EntryPoint::NewList) {
      open_ = integer(command, 0);
      is_executed_ = integer(command, 1) == GL_COMPILE_AND_EXECUTE;
      contents_.clear();
    } else if (command.entry == EntryPoint::EndList) {
      if (open_) lists_[*open_] = std::move(contents_);
      open_.reset();
    } else if (open_ && (is_compiled(command) || command.entry == EntryPoint::CallList)) {
      contents_.push_back(command);
      if (is_executed_) execute(command, 0);
    } else {
      execute(command, 0);
    }
  }

  void execute(const Command& command, int depth) {
    if (command.entry != EntryPoint::CallList) {
      executed_.add(command);
    } else if (const auto list = lists_.find(integer(command, 0));
               list != lists_.end() && depth < kMostNesting) {
      for (const Command& inner : list->second) execute(inner, depth + 1);
    }
  }

  Case executed_;
  std::map<std::int64_t, std::vector<Command>> lists_;
  std::optional<std::int64_t> open_;
  bool is_executed_ = false;
  std::vector<Command> contents_;  // of the open list
};

}  // namespace

Case without_lists(const Case& script) {
  const auto uses_result = [](const Command& command) {
    return std::ranges::any_of(
        command.arguments, [](const Value& argument) { return std::holds_alternative<ResultOf>(argument); });
  };
  return std::ranges::any_of(script.commands(), uses_result) ? script : WithoutLists(script).take();
}

DeliveredCase through_lists(const Case& script, Lists lists) { return ThroughLists(script, lists).apply(); }

bool uses_lists(const Case& script) {
  return std::ranges::count(script.commands(), EntryPoint::NewList, &Command::entry) > 0;
}

}  // namespace evalcts::gl
