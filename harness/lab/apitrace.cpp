// Makes recordings of traces.
#include "apitrace.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>

#include <evalcts/gl/roles.h>
#include <evalcts/record/recording.h>

namespace evalcts::lab {
namespace {

using Kind = TraceValue::Kind;

// Returns a value of a call as a number of a type.
template <class T>
T number_of(const TraceValue& value) {
  if (std::is_integral_v<T> && value.kind == Kind::kReal)
    throw BadTrace("has a real number in place of an integer");
  return value.kind == Kind::kReal ? static_cast<T>(value.real) : static_cast<T>(value.integer);
}

// Returns an array that a command reads, with the elements that the trace has.
template <class T>
gl::Value input_of(const TraceValue& value) {
  if (value.kind == Kind::kNull) return nullptr;
  if constexpr (std::is_arithmetic_v<T>) {
    std::vector<T> elements;
    for (const TraceValue& each : value.elements) elements.push_back(number_of<T>(each));
    return gl::array(elements);
  } else {
    return gl::Input{gl::Scalar::kU8,
                     {reinterpret_cast<const std::byte*>(value.bytes.data()),
                      reinterpret_cast<const std::byte*>(value.bytes.data() + value.bytes.size())}};
  }
}

template <class P>
gl::Value argument_of(const TraceValue& value) {
  if constexpr (!std::is_pointer_v<P>)
    return std::conditional_t<std::is_floating_point_v<P>, P, std::int64_t>(number_of<P>(value));
  else if constexpr (std::is_const_v<std::remove_pointer_t<P>>)
    return input_of<std::remove_cv_t<std::remove_pointer_t<P>>>(value);
  else if (value.kind == Kind::kNull)
    return nullptr;
  else
    return gl::Output{};
}

// A command that is recorded, by its name in the trace.
struct RecordedCommand {
  gl::EntryPoint entry;
  std::size_t parameters;
  std::function<gl::Command(const std::vector<TraceValue>&)> command;
};

template <class Result, class... P>
RecordedCommand recorded(gl::EntryPoint entry, Result (*)(P...)) {
  const auto command = [entry](const std::vector<TraceValue>& arguments) {
    gl::Command made{entry, {}};
    [[maybe_unused]] auto next = arguments.begin();
    (made.arguments.push_back(argument_of<P>(*next++)), ...);
    return made;
  };
  return {entry, sizeof...(P), command};
}

const std::map<std::string, RecordedCommand>& recorded_commands() {
  static const std::map<std::string, RecordedCommand> kAll = {
#define GL_ENTRY(name, kinds) \
  {"gl" #name, recorded(gl::EntryPoint::name, decltype(gl::Table::name)(nullptr))},
#define OTHER_ENTRY(name, kinds)
#define HARNESS_ENTRY(name, kinds)
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  };
  return kAll;
}

// Removes a beginning, one of several, and returns it; empty if there is none.
std::string_view take(std::string_view& text, std::initializer_list<std::string_view> beginnings) {
  for (const std::string_view each : beginnings)
    if (text.starts_with(each)) {
      text.remove_prefix(each.size());
      return each;
    }
  return {};
}

// Makes the form with doubles of a form with integers, such as glColor3ubv. GL 2.1, table 2.9: integer
// colors and normals are mapped to [-1, 1] or [0, 1].
void convert_integers(TraceCall& call) {
  std::string_view rest = call.name;
  take(rest, {"gl"});
  const std::string_view stem =
      take(rest, {"Vertex", "Color", "Normal", "TexCoord", "MultiTexCoord", "Index"});
  const std::string_view number = take(rest, {"1", "2", "3", "4"});
  const std::string_view type = take(rest, {"b", "s", "i", "ub", "us", "ui"});
  const bool is_array = !take(rest, {"v"}).empty();
  take(rest, {"ARB"});
  if (stem.empty() || type.empty() || !rest.empty()) return;
  const double largest = std::exp2(type.ends_with('b') ? 8 : type.ends_with('s') ? 16 : 32) - 1;
  const bool is_normalized = stem == "Color" || stem == "Normal";
  const std::size_t first = stem == "MultiTexCoord" ? 1 : 0;
  if (is_array) {
    if (call.arguments.size() != first + 1) return;
    const std::vector<TraceValue> elements = std::move(call.arguments.back().elements);
    call.arguments.pop_back();
    call.arguments.insert(call.arguments.end(), elements.begin(), elements.end());
  }
  for (std::size_t i = first; i < call.arguments.size(); ++i) {
    TraceValue& value = call.arguments[i];
    const auto integer = static_cast<double>(value.integer);
    value = {Kind::kReal, 0,
             !is_normalized   ? integer
             : type[0] == 'u' ? integer / largest
                              : (2 * integer + 1) / largest};
  }
  call.name = fmt::format("gl{}{}d", stem, number);
}

// Functions of window systems, each with the place of the context among its arguments.
const std::map<std::string, std::size_t> kMakeCurrent = {
    {"glXMakeCurrent", 2},      {"glXMakeContextCurrent", 3}, {"glXMakeCurrentReadSGI", 3},
    {"eglMakeCurrent", 3},      {"wglMakeCurrent", 1},        {"wglMakeContextCurrentARB", 2},
    {"CGLSetCurrentContext", 0}};
const std::map<std::string, std::size_t> kDestroy = {
    {"glXDestroyContext", 1}, {"eglDestroyContext", 1}, {"wglDeleteContext", 0}, {"CGLDestroyContext", 0}};
bool ends_a_frame(const std::string& name) {
  return name.starts_with("glXSwapBuffers") || name.starts_with("eglSwapBuffers") ||
         name.starts_with("wglSwapBuffers") || name == "wglSwapLayerBuffers" || name == "CGLFlushDrawable" ||
         name == "glFrameTerminatorGREMEDY";
}

// The context of a thread whose context the trace does not name, because it was trimmed, or traced without
// the window system that the program uses.
constexpr std::uint64_t kUnnamedContext = 1;

constexpr std::uint32_t kMostThreads = 4096;

// `threads`: those whose context is known.
void add(TraceCall call, record::RecordingWriter& recording, std::set<std::uint32_t>& threads) {
  if (call.is_fake) return;
  if (call.thread >= kMostThreads) throw BadTrace("has too many threads");
  recording.thread(call.thread);
  const auto context = [&](const std::map<std::string, std::size_t>& places) -> std::optional<std::uint64_t> {
    const auto place = places.find(call.name);
    if (place == places.end() || place->second >= call.arguments.size()) return {};
    return static_cast<std::uint64_t>(call.arguments[place->second].integer);
  };
  if (const auto current = context(kMakeCurrent)) {
    const bool fails = call.result && call.result->kind == Kind::kInteger && call.result->integer == 0 &&
                       !call.name.starts_with("CGL");
    if (fails) return;
    recording.context(*current);
    threads.insert(call.thread);
  } else if (const auto destroyed = context(kDestroy)) {
    recording.destroy(*destroyed);
  } else if (ends_a_frame(call.name)) {
    recording.frame();
  } else if (call.name.starts_with("gl") && !call.name.starts_with("glX")) {
    const std::string name = call.name;
    convert_integers(call);
    if (call.name.ends_with("ARB") && !recorded_commands().contains(call.name))
      if (const std::string core = call.name.substr(0, call.name.size() - 3);
          core == "glActiveTexture" || core.starts_with("glMultiTexCoord"))
        call.name = core;
    const auto found = recorded_commands().find(call.name);
    // A query that did not return has no answer.
    const auto lacks_only_an_answer = [&] {
      return gl::asks(found->second.entry) && call.arguments.size() + 1 == found->second.parameters;
    };
    if (found == recorded_commands().end() ||
        (call.arguments.size() != found->second.parameters && !lacks_only_an_answer())) {
      recording.count(name);
      return;
    }
    if (threads.insert(call.thread).second) recording.context(kUnnamedContext);
    call.arguments.resize(found->second.parameters);
    const gl::Command command = found->second.command(call.arguments);
    recording.command(command, record::has_all_elements(command));
  }
}

}  // namespace

ImportedTrace import_trace(const std::filesystem::path& file) {
  TraceReader reader(file);
  std::set<std::uint32_t> threads;
  ImportedTrace imported{record::RecordingWriter({reader.program()}), ""};
  try {
    while (std::optional<TraceCall> call = reader.next()) add(std::move(*call), imported.recording, threads);
    if (reader.is_cut()) imported.problem = "the trace ends within a call, and the program may have gone on";
  } catch (const BadTrace& error) {
    imported.problem = fmt::format("the trace {}; only its beginning was read", error.what());
  }
  return imported;
}

}  // namespace evalcts::lab
