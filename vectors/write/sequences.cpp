// Runs a sequence of commands on the executable specification and writes the expected answers.
#include "sequences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <reference/map.h>
#include <reference/rounding.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/results/hash.h>
#include "normals.h"
#include "text.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

using gl::EntryPoint;
using gl::Scalar;

// MAX_EVAL_ORDER of the executable specification. Cases with orders above 8, the minimum, have a flag.
constexpr int kMaxEvalOrder = 64;

GLenum token(const gl::Value& value) { return static_cast<GLenum>(std::get<std::int64_t>(value)); }
double real(const gl::Value& value) {
  const auto* const single = std::get_if<float>(&value);
  return single ? *single : std::get<double>(value);
}

// --- Commands

bool names_texture_unit(const gl::Command& command) {
  return command.entry == EntryPoint::ActiveTexture || gl::stem_of(command.entry) == "MultiTexCoord";
}

// Returns the number of texture units that the commands use: one more than the largest that they name, at
// least 1. Units 8 to 31 exist on some implementations only.
int texture_units_of(const gl::Command& command) {
  if (!names_texture_unit(command)) return 1;
  const GLenum unit = token(command.arguments[0]) - GL_TEXTURE0;
  return unit < 32 ? static_cast<int>(unit) + 1 : 1;
}

std::string bits(GLbitfield mask) {
  if (mask == GL_ALL_ATTRIB_BITS) return "GL_ALL_ATTRIB_BITS";
  const std::vector<const char*> names = gl::names_of_bits(mask);
  if (names.empty()) throw HasNoForm("a bit without a name");
  return fmt::format("{}", fmt::join(names, "|"));
}

// Returns an argument with its real numbers as hexadecimal texts, and without what happens to arrays after
// the call.
Json in_hexadecimal(const nlohmann::json& argument) {
  if (argument.is_number_float()) return hexadecimal(argument.get<double>());
  if (argument.is_number_integer()) return argument.get<std::int64_t>();
  if (argument.is_string()) return argument.get<std::string>();
  if (argument.is_null()) throw HasNoForm("a null pointer");
  if (argument.contains("out"))
    return {{"out", argument["out"].get<std::string>()}, {"count", argument["count"].get<std::size_t>()}};
  for (const char* const type : {"f32", "f64", "i32", "u32", "u8"}) {
    if (!argument.contains(type)) continue;
    Json values = Json::array();
    for (const nlohmann::json& element : argument[type]) values.push_back(in_hexadecimal(element));
    return {{type, std::move(values)}};
  }
  throw HasNoForm("a type of elements that vectors do not have");
}

// Returns the "call" of a command. Throws HasNoForm.
Json call_of(const gl::Command& command) {
  if (texture_units_of(command) > reference::kTextureUnits) throw HasNoForm("texture units above 7");
  gl::Case one;
  one.add(command);
  Json call = Json::array();
  try {
    const nlohmann::json commands = gl::to_json(one);
    for (const nlohmann::json& argument : commands[0]) call.push_back(in_hexadecimal(argument));
  } catch (const std::invalid_argument& problem) {
    throw HasNoForm(problem.what());
  }
  if (command.entry == EntryPoint::PushAttrib)
    call[1] = bits(static_cast<GLbitfield>(std::get<std::int64_t>(command.arguments[0])));
  return call;
}

// Returns the first commands of a case, up to the first without a form, and within so many bytes of JSON
// text. Commands of other parts of the GL are left out.
gl::Case with_form(const gl::Case& script, std::size_t most_bytes) {
  gl::Case first_context;
  for (const gl::Command& command : script.commands()) {
    if (gl::name_of(command.entry).ends_with("EVALCTS")) break;
    first_context.add(command);
  }
  const std::vector<bool> known = specified_commands(first_context, OtherState::kSkipped);
  gl::Case start;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const gl::Command& command = script.commands()[i];
    if (!known[i]) continue;
    try {
      bytes += call_of(command).dump().size();
    } catch (const HasNoForm&) {
      break;
    }
    if (bytes > most_bytes) break;
    start.add(command);
  }
  return start;
}

// --- Answers

// The minimum of MAX_EVAL_ORDER.
constexpr int kLeastMaxEvalOrder = 8;

bool asks_for_integers(const gl::Command& command) {
  const auto* name = std::get_if<std::int64_t>(&command.arguments.front());
  return name && (*name == GL_MAP1_GRID_SEGMENTS || *name == GL_MAP2_GRID_SEGMENTS);
}

// Returns the accepted answers for a value: the value itself if it is a float, otherwise both adjacent floats
// and, for a query of doubles, the value.
Json accepted_reals(double exact, bool as_double) {
  const auto interval = accepted(Rational(exact), 0);
  if (interval) return Json::array({hexadecimal(exact == 0 ? exact : interval->low)});
  if (std::abs(exact) > std::numeric_limits<float>::max()) throw HasNoForm("an answer beyond binary32");
  const float nearest = reference::round_to_float(Rational(exact));
  const float other = std::nextafter(nearest, nearest < exact ? std::numeric_limits<float>::infinity()
                                                              : -std::numeric_limits<float>::infinity());
  Values values{std::min(nearest, other), std::max(nearest, other)};
  if (as_double) values.insert(values.begin() + 1, exact);
  return hexadecimals(values);
}

Json answers(const gl::Command& command, const std::vector<reference::PermittedValue>& permitted) {
  const Scalar type = std::get<gl::Output>(command.arguments.back()).type;
  Json values = Json::array();
  for (const reference::PermittedValue& value : permitted) {
    if (value.is_least) {
      values.push_back(Json::array({{{"at_least", kLeastMaxEvalOrder}}}));
    } else if (type == Scalar::kU8 || type == Scalar::kI32) {
      std::vector<int> integers(value.answers.begin(), value.answers.end());
      std::ranges::sort(integers);
      values.push_back(integers);
    } else if (type == Scalar::kF64 && asks_for_integers(command)) {
      values.push_back(Json::array({hexadecimal(value.state)}));
    } else {
      values.push_back(accepted_reals(value.state, type == Scalar::kF64));
    }
  }
  return values;
}

// --- The level, and the first version

// Returns true if a domain has the ends +0 and -0, which are equal as numbers.
bool has_zeros_of_both_signs(const gl::Command& map) {
  for (int i = 0; i < gl::dimension_of(map.entry); ++i) {
    const auto ends = static_cast<std::size_t>(1 + 4 * i);
    const double first = real(map.arguments[ends]), last = real(map.arguments[ends + 1]);
    if (first == 0 && last == 0 && std::signbit(first) != std::signbit(last)) return true;
  }
  return false;
}

// The attributes that are listed for a vertex in addition to its position.
struct Shown {
  bool color = false, normal = false;
  int texture_units = 0;
};

// Returns the attributes that commands of the case set, or that enabled maps evaluate.
Shown shown_by(const gl::Case& script) {
  Shown shown;
  for (const gl::Command& command : script.commands()) {
    const std::string stem = gl::stem_of(command.entry);
    const GLenum cap = command.entry == EntryPoint::Enable ? token(command.arguments[0]) : 0;
    shown.color = shown.color || stem == "Color" || cap == GL_MAP1_COLOR_4 || cap == GL_MAP2_COLOR_4;
    shown.normal = shown.normal || stem == "Normal" || cap == GL_AUTO_NORMAL || cap == GL_MAP1_NORMAL ||
                   cap == GL_MAP2_NORMAL;
    const bool evaluates = (cap >= GL_MAP1_TEXTURE_COORD_1 && cap <= GL_MAP1_TEXTURE_COORD_4) ||
                           (cap >= GL_MAP2_TEXTURE_COORD_1 && cap <= GL_MAP2_TEXTURE_COORD_4);
    if (evaluates || stem == "TexCoord") shown.texture_units = std::max(shown.texture_units, 1);
    if (stem == "MultiTexCoord")
      shown.texture_units = std::max(shown.texture_units, texture_units_of(command));
  }
  return shown;
}

// Finds the level of a sequence and the first version of the GL that requires its answers (INTERPRETING.md,
// "Levels and versions").
class Standing {
 public:
  void see(const gl::Command& command, const std::vector<reference::PermittedValue>& permitted) {
    const EntryPoint entry = command.entry;
    if (names_texture_unit(command)) need(13);
    if (gl::stem_of(entry) == "GetnMap") need(45);
    if (entry == EntryPoint::PushAttrib) {
      const GLenum mask = token(command.arguments[0]);
      pushes_enables_ = pushes_enables_ || ((mask & GL_ENABLE_BIT) != 0 && (mask & GL_EVAL_BIT) == 0);
    }
    if ((entry == EntryPoint::Enable || entry == EntryPoint::Disable || entry == EntryPoint::IsEnabled) &&
        token(command.arguments[0]) == GL_AUTO_NORMAL)
      names_automatic_normals_ = true;
    if (pushes_enables_ && names_automatic_normals_) need(11);
    if (gl::role_of(entry) == gl::Role::kMap && has_zeros_of_both_signs(command)) level_ = "advisory";
    for (const reference::PermittedValue& value : permitted) need(value.since);
  }
  void see(const reference::Vertex& vertex, int texture_units) {
    for (int unit = 0; unit < texture_units; ++unit)
      for (const auto& component : vertex.texture_coordinate[static_cast<std::size_t>(unit)])
        if (const auto* sample = std::get_if<reference::Sample>(&component)) {
          if (needs_gl_2(*sample)) need(20);
          if (sample->map().is_initial) need(11);
        }
  }
  const std::string& level() const { return level_; }
  std::string since() const { return fmt::format("{}.{}", since_ / 10, since_ % 10); }

 private:
  void need(int version) { since_ = std::max(since_, version); }

  std::string level_ = "must";
  int since_ = 10;
  bool pushes_enables_ = false, names_automatic_normals_ = false;
};

// --- Vertices

Json component(const reference::Component& value) {
  if (const float* plain = std::get_if<float>(&value)) return hexadecimal(*plain);
  return entry_of(std::get<reference::Sample>(value));
}

template <std::size_t kCount>
Json components(const std::array<reference::Component, kCount>& values) {
  Json list = Json::array();
  for (const reference::Component& value : values) list.push_back(component(value));
  return list;
}

Json vertex_as_json(const reference::Vertex& vertex, const Shown& shown, Standing& standing) {
  standing.see(vertex, shown.texture_units);
  Json data = {{"position", components(vertex.position)}};
  if (shown.color) data["color"] = components(vertex.color);
  if (shown.normal) {
    if (const auto* automatic = std::get_if<reference::AutomaticNormal>(&vertex.normal))
      data["automatic_normal"] = entry_of(*automatic);
    else
      data["normal"] = components(std::get<0>(vertex.normal));
  }
  if (shown.texture_units == 0) return data;
  Json units = Json::array();
  for (int unit = 0; unit < shown.texture_units; ++unit)
    units.push_back(components(vertex.texture_coordinate[static_cast<std::size_t>(unit)]));
  data["texture_coordinates"] = std::move(units);
  return data;
}

Json emitted(const reference::Primitive& primitive, const Shown& shown, Standing& standing) {
  Json vertices = Json::array();
  for (const reference::Vertex& vertex : primitive.vertices)
    vertices.push_back(vertex_as_json(vertex, shown, standing));
  return {{"mode", gl::primitive_name(primitive.mode)}, {"vertices", std::move(vertices)}};
}

// --- Summaries of steps with many vertices

using Primitives = std::vector<const reference::Primitive*>;

// The steps of a case list at most this number of vertices; those of a step that would list more are
// summarised.
constexpr std::size_t kMostListed = 24;
// A case ends before the step with which it would draw more.
constexpr std::size_t kMostVertices = 12'000;

std::size_t vertices_of(const Primitives& primitives) {
  std::size_t count = 0;
  for (const reference::Primitive* primitive : primitives) count += primitive->vertices.size();
  return count;
}

// FNV-1a hash of the bits of correctly rounded numbers, with the least significant byte first.
class Digest {
 public:
  template <std::size_t kCount>
  void add(const std::array<reference::Component, kCount>& values) {
    for (const reference::Component& value : values) {
      const auto bits = std::bit_cast<std::uint32_t>(reference::rounded(value));
      char bytes[4];
      for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(bits >> 8 * i);
      hash_ = fnv1a<std::uint64_t>({bytes, 4}, hash_);
    }
  }
  void add(const reference::Vertex& vertex, const Shown& shown) {
    add(vertex.position);
    if (shown.color) add(vertex.color);
    if (const auto* normal = std::get_if<0>(&vertex.normal); shown.normal && normal) add(*normal);
    for (int unit = 0; unit < shown.texture_units; ++unit)
      add(vertex.texture_coordinate[static_cast<std::size_t>(unit)]);
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = fnv1a<std::uint64_t>("");
};

// Primitives of the same mode and size that follow each other.
struct Run {
  GLenum mode;
  std::size_t size, count, first;  // `first`: index of its first vertex
};

std::vector<Run> runs_of(const Primitives& primitives) {
  std::vector<Run> runs;
  std::size_t vertices = 0;
  for (const reference::Primitive* const primitive : primitives) {
    const std::size_t size = primitive->vertices.size();
    if (!runs.empty() && runs.back().mode == primitive->mode && runs.back().size == size)
      ++runs.back().count;
    else
      runs.push_back({primitive->mode, size, 1, vertices});
    vertices += size;
  }
  return runs;
}

// Returns the indices of the vertices to list: both ends of the first and the last primitive of the runs, and
// of many vertices some spread evenly between.
std::set<std::size_t> sampled(const std::vector<Run>& runs, std::size_t count) {
  constexpr std::size_t kMostRuns = 3, kSpread = 3;
  std::set<std::size_t> numbers;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i >= kMostRuns && i + 1 < runs.size()) continue;
    const auto& [mode, size, primitives, first] = runs[i];
    const std::size_t last = first + size * (primitives - 1);
    numbers.insert({first, first + size - 1, last, last + size - 1});
  }
  if (count > kMostListed)
    for (std::size_t i = 1; i <= kSpread; ++i) numbers.insert(count * i / (kSpread + 1) + i % 3);
  return numbers;
}

Json summary(const Primitives& primitives, const Shown& shown, Standing& standing) {
  const std::vector<Run> runs = runs_of(primitives);
  Digest digest;
  std::vector<const reference::Vertex*> vertices;
  for (const reference::Primitive* const primitive : primitives)
    for (const reference::Vertex& vertex : primitive->vertices) {
      vertices.push_back(&vertex);
      digest.add(vertex, shown);
    }
  Json listed_runs = Json::array(), samples = Json::array();
  for (const auto& [mode, size, count, first] : runs)
    listed_runs.push_back(Json::array({gl::primitive_name(mode), size, count}));
  for (const std::size_t number : sampled(runs, vertices.size()))
    samples.push_back({{"number", number}, {"vertex", vertex_as_json(*vertices[number], shown, standing)}});
  return {{"primitives", std::move(listed_runs)}, {"digest", digest.text()}, {"samples", std::move(samples)}};
}

bool calls_list(const gl::Command& command) {
  return command.entry == EntryPoint::CallList || command.entry == EntryPoint::CallLists;
}

bool may_emit(const gl::Command& command) {
  return command.entry == EntryPoint::End || gl::role_of(command.entry) == gl::Role::kEvalMesh ||
         calls_list(command);
}

bool returns_a_flag(const gl::Command& command) {
  return command.entry == EntryPoint::IsEnabled || command.entry == EntryPoint::IsList;
}
bool writes(const gl::Command& command) {
  return !command.arguments.empty() && std::holds_alternative<gl::Output>(command.arguments.back());
}

// Makes the steps of a case one after the other.
class Steps {
 public:
  Steps(const gl::Case& script, const Specified& specified)
      : script_(script), specified_(specified), shown_(shown_by(script)) {}

  // Adds the step of a command. Throws HasNoForm.
  void add(std::size_t i) {
    const gl::Command& command = script_.commands()[i];
    const std::vector<GLenum>& raised = specified_.errors[i];
    const auto& permitted = specified_.permitted[i];
    Json step = {{"call", call_of(command)}};
    for (const GLenum error : raised)
      if (std::ranges::count(pending_, error) == 0) pending_.push_back(error);
    if (!specified_.inside[i]) {
      Json errors = Json::array();
      for (const GLenum error : pending_) errors.push_back(gl::error_name(error));
      step["errors"] = std::move(errors);
      pending_.clear();
    }
    standing_.see(command, permitted);
    if (writes(command))
      step["answers"] = answers(command, permitted);
    else if (returns_a_flag(command))
      step["answers"] = raised.empty()
                            ? Json::array({Json::array({specified_.answers.result({static_cast<int>(i)})})})
                            : Json::array();
    if (std::ranges::any_of(permitted, &reference::PermittedValue::is_advisory)) step["level"] = "advisory";
    if (may_emit(command)) step["emits"] = emits(i);
    bytes_ += step.dump().size();
    steps_.push_back(std::move(step));
  }
  std::size_t bytes() const { return bytes_; }
  Json sequence() && {
    return {{"level", standing_.level()}, {"since", standing_.since()}, {"steps", std::move(steps_)}};
  }

 private:
  Json emits(std::size_t i) {
    Primitives primitives;
    for (; completed_ < specified_.completed[i]; ++completed_)
      if (const auto& primitive = specified_.prediction.primitives[completed_]; !primitive.vertices.empty())
        primitives.push_back(&primitive);
    const std::size_t count = vertices_of(primitives);
    if ((vertices_ += count) > kMostVertices) throw HasNoForm("too many vertices");
    if (listed_ + count > kMostListed) return summary(primitives, shown_, standing_);
    listed_ += count;
    Json list = Json::array();
    for (const reference::Primitive* const primitive : primitives)
      list.push_back(emitted(*primitive, shown_, standing_));
    return list;
  }

  const gl::Case& script_;
  const Specified& specified_;
  const Shown shown_;
  Json steps_ = Json::array();
  Standing standing_;
  std::vector<GLenum> pending_;  // errors that were raised since the last step outside Begin and End
  std::size_t completed_ = 0, vertices_ = 0, listed_ = 0, bytes_ = 0;
};

// The places at which a case may end: outside of primitives and display lists, and behind the first of each
// of the things that it shows: an error, a vertex, the call of a list, or, without these, an answer or an
// emission of nothing.
class PossibleEnds {
 public:
  PossibleEnds(const gl::Case& script, const Specified& specified) : script_(script), specified_(specified) {
    const auto count = static_cast<int>(script.commands().size());
    due_ = {
        .error = std::ranges::any_of(specified.errors, [](const auto& errors) { return !errors.empty(); }),
        .vertex = specified.prediction.vertex_count() > 0,
        .call = std::ranges::any_of(script.commands(), calls_list)};
    for (int i = 0; i < count && !due_.error && !due_.vertex && !due_.call; ++i)
      due_.answer = due_.answer || shows_an_answer(script.commands()[static_cast<std::size_t>(i)]);
  }

  // Returns true if the case may end behind the command. Asks for all commands in order.
  bool may_end_behind(std::size_t i) {
    const gl::Command& command = script_.commands()[i];
    const bool is_rejected = !specified_.errors[i].empty();
    if (!is_rejected && command.entry == EntryPoint::NewList) is_compiling_ = true;
    if (!is_rejected && command.entry == EntryPoint::EndList) is_compiling_ = false;
    seen_.error = seen_.error || is_rejected;
    for (; completed_ < specified_.completed[i]; ++completed_)
      seen_.vertex = seen_.vertex || !specified_.prediction.primitives[completed_].vertices.empty();
    seen_.call = seen_.call || (!is_compiling_ && calls_list(command));
    seen_.answer = seen_.answer || (!is_compiling_ && shows_an_answer(command));
    return !specified_.inside[i] && !is_compiling_ && seen_.error >= due_.error &&
           seen_.vertex >= due_.vertex && seen_.call >= due_.call && seen_.answer >= due_.answer &&
           (due_.error || due_.vertex || due_.call || due_.answer);
  }

 private:
  struct Things {
    bool error = false, vertex = false, call = false, answer = false;
  };
  static bool shows_an_answer(const gl::Command& command) {
    return writes(command) || returns_a_flag(command) || may_emit(command);
  }

  const gl::Case& script_;
  const Specified& specified_;
  Things due_, seen_;
  std::size_t completed_ = 0;
  bool is_compiling_ = false;
};

}  // namespace

gl::Case cut_off(const gl::Case& whole, std::size_t most_bytes) {
  constexpr std::size_t kAtLeastMore = 3'000;        // bytes behind the first place at which the case may end
  constexpr std::size_t kMostBytesOfCalls = 60'000;  // if `most_bytes` is less
  const gl::Case script = with_form(whole, std::max(kMostBytesOfCalls, most_bytes));
  const Specified specified = specify(script, kMaxEvalOrder);
  Steps steps(script, specified);
  PossibleEnds possible(script, specified);
  std::size_t kept = 0, most = std::numeric_limits<std::size_t>::max();
  try {
    for (std::size_t i = 0; i < script.commands().size(); ++i) {
      if (script.commands()[i].entry != EntryPoint::GetError) steps.add(i);
      if (kept > 0 && steps.bytes() > most) break;
      if (!possible.may_end_behind(i)) continue;
      if (kept == 0) most = std::max(most_bytes, steps.bytes() + kAtLeastMore);
      kept = i + 1;
    }
  } catch (const HasNoForm&) {  // the case ends before that step
  }
  if (kept == 0) throw HasNoForm("nothing to see within its first commands");
  gl::Case left;
  for (std::size_t i = 0; i < kept; ++i) left.add(script.commands()[i]);
  return left;
}

Json sequence(const gl::Case& script) {
  const Specified specified = specify(script, kMaxEvalOrder);
  Steps steps(script, specified);
  for (std::size_t i = 0; i < script.commands().size(); ++i)
    if (script.commands()[i].entry != EntryPoint::GetError) steps.add(i);
  return std::move(steps).sequence();
}

}  // namespace evalcts::vectors
