// Runs a sequence of commands on the executable specification and writes the expected answers.
#include "sequences.h"

#include <fmt/format.h>
#include <reference/map.h>
#include <reference/rounding.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <evalcts/gl/numbers.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/results/hash.h>
#include "normals.h"
#include "text.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

using gl::Scalar;

// MAX_EVAL_ORDER of the executable specification. Cases with orders above 8, the minimum, have a flag.
constexpr int kMaxEvalOrder = 64;

// --- Commands

std::string bits(std::int64_t mask) {
  constexpr std::pair<GLbitfield, const char*> kBits[] = {
      {GL_CURRENT_BIT, "GL_CURRENT_BIT"}, {GL_LIGHTING_BIT, "GL_LIGHTING_BIT"},
      {GL_ENABLE_BIT, "GL_ENABLE_BIT"},   {GL_EVAL_BIT, "GL_EVAL_BIT"},
      {GL_LIST_BIT, "GL_LIST_BIT"},       {GL_TEXTURE_BIT, "GL_TEXTURE_BIT"}};
  if (mask == GL_ALL_ATTRIB_BITS) return "GL_ALL_ATTRIB_BITS";
  std::string names;
  for (const auto& [bit, name] : kBits) {
    if ((mask & bit) == 0) continue;
    names += (names.empty() ? "" : "|") + std::string(name);
    mask &= ~static_cast<std::int64_t>(bit);
  }
  if (mask != 0 || names.empty()) throw std::logic_error("a bit without a name");
  return names;
}

Json integer(std::int64_t value, char kind) {
  const auto token = static_cast<GLenum>(value);
  if (kind == 'b') return bits(value);
  const std::string name = kind == 'm' ? gl::primitive_name(token) : kind == 'e' ? gl::token_name(token) : "";
  if (name.starts_with("GL_")) return name;
  return value;
}

const char* name_of(Scalar type) {
  switch (type) {
    case Scalar::kF32:
      return "f32";
    case Scalar::kF64:
      return "f64";
    case Scalar::kI32:
      return "i32";
    case Scalar::kU32:
      return "u32";
    case Scalar::kU8:
      return "u8";
    default:
      throw std::logic_error("a type of elements that vectors do not have");
  }
}

bool is_real(Scalar type) { return type == Scalar::kF32 || type == Scalar::kF64; }

template <class T>
std::vector<T> elements(const std::vector<std::byte>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

Json array(const gl::Input& input) {
  if (is_real(input.type)) return hexadecimals(gl::elements(input));
  if (input.type == Scalar::kU8) return elements<std::uint8_t>(input.bytes);
  if (input.type == Scalar::kU32) return elements<std::uint32_t>(input.bytes);
  return elements<std::int32_t>(input.bytes);
}

Json argument(const gl::Value& value, char kind) {
  if (const auto* number = std::get_if<std::int64_t>(&value)) return integer(*number, kind);
  if (const auto* single = std::get_if<float>(&value)) return hexadecimal(*single);
  if (const auto* real = std::get_if<double>(&value)) return hexadecimal(*real);
  if (const auto* input = std::get_if<gl::Input>(&value)) return {{name_of(input->type), array(*input)}};
  if (const auto* output = std::get_if<gl::Output>(&value))
    return {{"out", name_of(output->type)}, {"count", output->count}};
  throw std::logic_error("a kind of argument that vectors do not have");
}

std::string name_of(const gl::Command& command) { return std::string(gl::name_of(command.entry).substr(2)); }

Json call(const gl::Command& command) {
  const std::string_view kinds = gl::parameter_kinds(command.entry);
  Json data = Json::array({name_of(command)});
  for (std::size_t i = 0; i < command.arguments.size(); ++i)
    data.push_back(argument(command.arguments[i], kinds[i]));
  return data;
}

// --- Answers

// The minimum of MAX_EVAL_ORDER.
constexpr int kLeastMaxEvalOrder = 8;

// Returns the integers nearest to a value. Cases with other readings of GetMapiv (C-GETMAPIV-NORM) have a
// flag.
Json accepted_integers(double exact) {
  using Limits = std::numeric_limits<GLint>;
  const double low = std::ceil(exact - 0.5), high = std::floor(exact + 0.5);  // differ only for n + 1/2
  Json values = Json::array();
  for (const double value : {low, high}) {
    const auto saturated = static_cast<GLint>(std::clamp<double>(value, Limits::min(), Limits::max()));
    if (values.empty() || values.back() != saturated) values.push_back(saturated);
  }
  return values;
}

bool asks_for_integers(const gl::Command& command) {
  const auto* name = std::get_if<std::int64_t>(&command.arguments.front());
  return name && (*name == GL_MAP1_GRID_SEGMENTS || *name == GL_MAP2_GRID_SEGMENTS);
}

// Returns the accepted answers for a value: the value itself if it is a float, otherwise both adjacent floats
// and, for a query of doubles, the value.
Json accepted_reals(double exact, bool as_double) {
  const auto interval = accepted(Rational(exact), 0);
  if (interval) return Json::array({hexadecimal(exact == 0 ? exact : interval->low)});
  if (std::abs(exact) > std::numeric_limits<float>::max())
    throw std::logic_error("an answer beyond binary32");
  const float nearest = reference::round_to_float(Rational(exact));
  const float other = std::nextafter(nearest, nearest < exact ? std::numeric_limits<float>::infinity()
                                                              : -std::numeric_limits<float>::infinity());
  Values values{std::min(nearest, other), std::max(nearest, other)};
  if (as_double) values.insert(values.begin() + 1, exact);
  return hexadecimals(values);
}

bool is_normalized(const gl::Command& command) {
  const auto* name = std::get_if<std::int64_t>(&command.arguments.front());
  return command.entry == gl::EntryPoint::GetIntegerv && name &&
         (*name == GL_CURRENT_COLOR || *name == GL_CURRENT_NORMAL);
}

Json answers(const gl::Command& command, const std::vector<reference::PermittedValue>& permitted) {
  if (is_normalized(command))
    throw std::logic_error("colours and normals as integers are not in the vectors");
  const Scalar type = std::get<gl::Output>(command.arguments.back()).type;
  Json values = Json::array();
  for (const reference::PermittedValue& value : permitted) {
    if (value.is_least)
      values.push_back(Json::array({{{"at_least", kLeastMaxEvalOrder}}}));
    else if (type == Scalar::kU8)
      values.push_back(Json::array({value.state == 0 ? 0 : 1}));
    else if (type == Scalar::kI32)
      values.push_back(accepted_integers(value.state));
    else if (type == Scalar::kF64 && asks_for_integers(command))
      values.push_back(Json::array({hexadecimal(value.state)}));
    else
      values.push_back(accepted_reals(value.state, type == Scalar::kF64));
  }
  return values;
}

// --- The level, and the first version

bool is_map(const gl::Command& command) {
  const std::string name = name_of(command);
  return name.starts_with("Map1") || name.starts_with("Map2");
}
bool is_query_of_map(const gl::Command& command) {
  const std::string name = name_of(command);
  return name.starts_with("GetMap") || name.starts_with("GetnMap");
}
bool is_texture_map(GLenum target) {
  return (target >= GL_MAP1_TEXTURE_COORD_1 && target <= GL_MAP1_TEXTURE_COORD_4) ||
         (target >= GL_MAP2_TEXTURE_COORD_1 && target <= GL_MAP2_TEXTURE_COORD_4);
}

double real(const gl::Value& value) {
  const auto* const single = std::get_if<float>(&value);
  return single ? *single : std::get<double>(value);
}
GLenum token(const gl::Value& value) { return static_cast<GLenum>(std::get<std::int64_t>(value)); }

// Returns true if a domain has the ends +0 and -0, which are equal as numbers.
bool has_zeros_of_both_signs(const gl::Command& map) {
  const std::size_t count = name_of(map).starts_with("Map2") ? 2 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double first = real(map.arguments[1 + 4 * i]), last = real(map.arguments[2 + 4 * i]);
    if (first == 0 && last == 0 && std::signbit(first) != std::signbit(last)) return true;
  }
  return false;
}

// Finds the level of a sequence and the first version of the GL that requires its answers (INTERPRETING.md,
// "Levels and versions").
class Standing {
 public:
  void see(const gl::Command& command, bool is_refused) {
    const std::string name = name_of(command);
    if (name == "ActiveTexture" || name.starts_with("MultiTexCoord")) need("1.3");
    if (name.starts_with("Getn")) need("4.5");
    if (name == "PushAttrib") {
      const GLenum mask = token(command.arguments[0]);
      pushes_enables_ = pushes_enables_ || ((mask & GL_ENABLE_BIT) != 0 && (mask & GL_EVAL_BIT) == 0);
    }
    if ((name == "Enable" || name == "Disable" || name == "IsEnabled") &&
        token(command.arguments[0]) == GL_AUTO_NORMAL)
      names_automatic_normals_ = true;
    if (pushes_enables_ && names_automatic_normals_) need("1.1");
    if (is_map(command)) {
      if (has_zeros_of_both_signs(command)) level_ = "advisory";
      if (!is_refused) (is_compiling_ ? compiled_[list_] : defined_).insert(token(command.arguments[0]));
    }
    if (name == "NewList" && !is_refused) {
      list_ = token(command.arguments[0]);
      is_compiling_ = token(command.arguments[1]) == GL_COMPILE;
    }
    if (name == "EndList") is_compiling_ = false;
    if (name == "CallList") defined_.merge(std::set(compiled_[token(command.arguments[0])]));
    if (is_query_of_map(command) && !is_refused && is_initial(token(command.arguments[0])) &&
        token(command.arguments[1]) == GL_COEFF && is_texture_map(token(command.arguments[0])))
      need("1.1");
  }
  void see(const reference::Vertex& vertex, int texture_units) {
    for (int unit = 0; unit < texture_units; ++unit)
      for (const auto& component : vertex.texture_coordinate[static_cast<std::size_t>(unit)])
        if (const auto* sample = std::get_if<reference::Sample>(&component)) {
          if (needs_gl_2(*sample)) need("2.0");
          if (is_initial(sample->map().target)) need("1.1");
        }
  }
  const std::string& level() const { return level_; }
  const std::string& since() const { return since_; }

 private:
  void need(const std::string& version) { since_ = std::max(since_, version); }
  bool is_initial(GLenum target) const { return !defined_.contains(target); }

  std::string level_ = "must", since_ = kFirstVersion;
  bool pushes_enables_ = false, names_automatic_normals_ = false;
  // Targets of the maps that are defined, and of those that each display list defines when it is called.
  std::set<GLenum> defined_;
  std::map<GLuint, std::set<GLenum>> compiled_;
  GLuint list_ = 0;
  bool is_compiling_ = false;
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

// The vertices of a step are summarised if there are more.
constexpr std::size_t kMostListed = 64;
constexpr std::size_t kSpreadSamples = 9;

std::size_t vertices_of(const Primitives& primitives) {
  std::size_t count = 0;
  for (const reference::Primitive* primitive : primitives) count += primitive->vertices.size();
  return count;
}

// Returns the indices of the vertices to list: two at each end, and some spread evenly between.
std::vector<std::size_t> sampled(std::size_t count) {
  std::vector<std::size_t> numbers{0, 1, count - 2, count - 1};
  for (std::size_t i = 1; i <= kSpreadSamples; ++i)
    numbers.push_back(count * i / (kSpreadSamples + 1) + i % 3);
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
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

Json summary(const Primitives& primitives, const Shown& shown, Standing& standing) {
  Json runs = Json::array();
  Digest digest;
  std::vector<const reference::Vertex*> vertices;
  for (const reference::Primitive* primitive : primitives) {
    const std::string mode = gl::primitive_name(primitive->mode);
    const std::size_t size = primitive->vertices.size();
    if (!runs.empty() && as_text(runs.back()[0]) == mode && runs.back()[1] == size)
      runs.back()[2] = runs.back()[2].get<std::size_t>() + 1;
    else
      runs.push_back(Json::array({mode, size, 1}));
    for (const reference::Vertex& vertex : primitive->vertices) {
      vertices.push_back(&vertex);
      digest.add(vertex, shown);
    }
  }
  Json samples = Json::array();
  for (const std::size_t number : sampled(vertices.size()))
    samples.push_back({{"number", number}, {"vertex", vertex_as_json(*vertices[number], shown, standing)}});
  return {{"primitives", std::move(runs)}, {"digest", digest.text()}, {"samples", std::move(samples)}};
}

Json emits(const Primitives& primitives, const Shown& shown, Standing& standing) {
  if (vertices_of(primitives) > kMostListed) return summary(primitives, shown, standing);
  Json list = Json::array();
  for (const reference::Primitive* primitive : primitives)
    list.push_back(emitted(*primitive, shown, standing));
  return list;
}

bool may_emit(const gl::Command& command) {
  const std::string name = name_of(command);
  return name == "End" || name.starts_with("EvalMesh") || name.starts_with("CallList");
}

bool returns_a_flag(const gl::Command& command) { return name_of(command).starts_with("Is"); }
bool writes(const gl::Command& command) {
  return !command.arguments.empty() && std::holds_alternative<gl::Output>(command.arguments.back());
}

}  // namespace

Json sequence(const gl::Case& script, const Shown& shown) {
  const Specified specified = specify(script, kMaxEvalOrder);
  if (!script.commands().empty() && specified.inside.back()) throw std::logic_error("a primitive stays open");

  Json steps = Json::array();
  Standing standing;
  std::vector<GLenum> pending;  // errors that were raised since the last step outside Begin and End
  std::size_t completed = 0;
  for (std::size_t i = 0; i < script.commands().size(); ++i) {
    const gl::Command& command = script.commands()[i];
    const gl::Ref ref{static_cast<int>(i)};
    Json step = {{"call", call(command)}};
    for (const GLenum error : specified.errors[i])
      if (std::ranges::find(pending, error) == pending.end()) pending.push_back(error);
    if (!specified.inside[i]) {
      Json errors = Json::array();
      for (const GLenum error : pending) errors.push_back(gl::error_name(error));
      step["errors"] = std::move(errors);
      pending.clear();
    }
    const bool is_refused = !specified.errors[i].empty();
    standing.see(command, is_refused);
    if (writes(command))
      step["answers"] = answers(command, specified.permitted[i]);
    else if (returns_a_flag(command))
      step["answers"] =
          is_refused ? Json::array() : Json::array({Json::array({specified.answers.result(ref)})});
    const auto& permitted = specified.permitted[i];
    if (std::ranges::any_of(permitted, &reference::PermittedValue::is_advisory) &&
        token(command.arguments[1]) == GL_DOMAIN)
      step["level"] = "advisory";
    if (may_emit(command)) {
      Primitives primitives;
      for (; completed < specified.completed[i]; ++completed)
        if (const auto& primitive = specified.prediction.primitives[completed]; !primitive.vertices.empty())
          primitives.push_back(&primitive);
      step["emits"] = emits(primitives, shown, standing);
    }
    steps.push_back(std::move(step));
  }
  return {{"level", standing.level()}, {"since", standing.since()}, {"steps", std::move(steps)}};
}

void map1(gl::Case& c, Type type, GLenum target, double u1, double u2, int stride, int order,
          const Values& points) {
  if (type == Type::kReal)
    c.Map1d(target, u1, u2, stride, order, points);
  else
    c.Map1f(target, u1, u2, stride, order, std::vector<GLfloat>(points.begin(), points.end()));
}

void map2(gl::Case& c, Type type, GLenum target, double u1, double u2, int ustride, int uorder, double v1,
          double v2, int vstride, int vorder, const Values& points) {
  if (type == Type::kReal)
    c.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  else
    c.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder,
            std::vector<GLfloat>(points.begin(), points.end()));
}

void grid1(gl::Case& c, Type type, int segments, double u1, double u2) {
  if (type == Type::kReal)
    c.MapGrid1d(segments, u1, u2);
  else
    c.MapGrid1f(segments, u1, u2);
}

void grid2(gl::Case& c, Type type, int usegments, double u1, double u2, int vsegments, double v1, double v2) {
  if (type == Type::kReal)
    c.MapGrid2d(usegments, u1, u2, vsegments, v1, v2);
  else
    c.MapGrid2f(usegments, u1, u2, vsegments, v1, v2);
}

void define(gl::Case& c, Type type, const Map& map) {
  const int k = map.components();
  if (map.is_two_dimensional())
    map2(c, type, map.target, map.u.first, map.u.last, k * map.v.order, map.u.order, map.v.first, map.v.last,
         k, map.v.order, map.points);
  else
    map1(c, type, map.target, map.u.first, map.u.last, k, map.u.order, map.points);
}

void query_all(gl::Case& c, GLenum target, int values) {
  const std::size_t dimensions = reference::is_map2_target(target) ? 2 : 1;
  c.GetMapiv(target, GL_ORDER, gl::out<GLint>(dimensions));
  c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(2 * dimensions));
  c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(static_cast<std::size_t>(values)));
}

void query_grids(gl::Case& c) {
  c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
  c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
  c.GetFloatv(GL_MAP2_GRID_DOMAIN, gl::out<GLfloat>(4));
}

Values numbered(int count, int first) {
  Values values;
  for (int i = 0; i < count; ++i) values.push_back(first + i);
  return values;
}

}  // namespace evalcts::vectors
