// Runs cases on the executable specification.
#include <evalcts/judge/prediction.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <evalcts/gl/bind_methods.h>
#include <evalcts/gl/player.h>
#include <evalcts/gl/roles.h>

namespace evalcts {
namespace {

bool may_be_anything(const reference::Component& component) {
  return std::holds_alternative<reference::Sample>(component) && !reference::must_applies(component);
}

// The specification that predicts. It is separate from the current context of an implementation under test,
// which may be a Specification as well.
struct Oracle {
  static inline thread_local reference::Specification* current = nullptr;
};

const gl::Table& oracle() {
  static const gl::Table kTable = bind_methods<Oracle, reference::Specification>();
  return kTable;
}

gl::Trace play(const gl::Case& script, reference::Specification& specification,
               const std::function<void(std::size_t)>& after_each = {}) {
  Oracle::current = &specification;
  gl::Trace trace = gl::play(script, oracle(), after_each);
  Oracle::current = nullptr;
  return trace;
}

bool uses_several_contexts(const gl::Case& script) {
  using gl::EntryPoint;
  return std::ranges::any_of(script.commands(), [](const gl::Command& command) {
    return command.entry == EntryPoint::OtherContextEVALCTS ||
           command.entry == EntryPoint::SharingContextEVALCTS ||
           command.entry == EntryPoint::ContextOfKindEVALCTS ||
           command.entry == EntryPoint::CopyContextEVALCTS;
  });
}

// Targets of NV_vertex_program.
bool is_target_of_vertex_programs(GLenum target) {
  return (target >= GL_MAP1_VERTEX_ATTRIB0_4_NV && target <= GL_MAP1_VERTEX_ATTRIB15_4_NV) ||
         (target >= GL_MAP2_VERTEX_ATTRIB0_4_NV && target <= GL_MAP2_VERTEX_ATTRIB15_4_NV);
}

// Returns true if the command takes the name of state that the specification does not have.
bool names_other_state(const gl::Command& command) {
  static const reference::Specification kSpecification;
  const auto* const number =
      command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
  if (!number) return false;
  const auto name = static_cast<GLenum>(*number);
  const gl::Role role = gl::role_of(command.entry);
  if (role == gl::Role::kMap || role == gl::Role::kGetMap) return is_target_of_vertex_programs(name);
  const bool takes_a_name = role == gl::Role::kGet || command.entry == gl::EntryPoint::Enable ||
                            command.entry == gl::EntryPoint::Disable ||
                            command.entry == gl::EntryPoint::IsEnabled;
  return takes_a_name && !kSpecification.has_state(name);
}

// Returns the commands for which `known` is true, and their positions; -1 for others.
std::pair<gl::Case, std::vector<int>> chosen(const gl::Case& script, const std::vector<bool>& known) {
  gl::Case left(script.identity());
  std::vector<int> positions;
  for (std::size_t i = 0; i < known.size(); ++i) {
    positions.push_back(-1);
    if (!known[i]) continue;
    gl::Command command = script.commands()[i];
    for (gl::Value& argument : command.arguments)
      if (auto* result = std::get_if<gl::ResultOf>(&argument)) {
        result->command = positions.at(static_cast<std::size_t>(result->command));
        if (result->command < 0)
          throw std::logic_error("a command uses the result of one that the specification does not have");
      }
    positions.back() = left.add(std::move(command)).index;
  }
  return {std::move(left), std::move(positions)};
}

Prediction prediction_of(reference::Specification& specification, const gl::Trace& trace) {
  Prediction prediction;
  prediction.primitives = specification.take_primitives();
  if (!trace.left_over_errors().empty()) prediction.error = trace.left_over_errors().front();
  return prediction;
}

// The errors that an implementation may have recorded and not yet returned.
class PendingErrors {
 public:
  void raise(const std::vector<GLenum>& errors, std::size_t times) {
    if (errors.empty()) return;
    for (const GLenum error : errors)
      if (std::ranges::count(codes_, error) == 0) codes_.push_back(error);
    recorded_ += times;
    may_be_none_ = false;
  }
  // Returns the answers that GetError may give.
  std::vector<GLenum> take() {
    std::vector<GLenum> answers = codes_;
    if (may_be_none_) answers.insert(answers.begin(), GL_NO_ERROR);
    if (recorded_ > 0) --recorded_;
    if (recorded_ == 0) codes_.clear();
    may_be_none_ = true;
    return answers;
  }

 private:
  std::vector<GLenum> codes_;
  std::size_t recorded_ = 0;  // largest number of errors that are still recorded
  bool may_be_none_ = true;   // one GetError may have returned the only error
};

// See Specified::error_answers. `raised`: how often each command raised an error.
std::vector<std::vector<GLenum>> error_answers(const gl::Case& script, const Specified& specified,
                                               const std::vector<std::size_t>& raised) {
  std::vector<std::vector<GLenum>> answers(script.commands().size());
  PendingErrors pending;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (script.commands()[i].entry == gl::EntryPoint::GetError)
      answers[i] = i > 0 && specified.inside[i - 1] ? std::vector<GLenum>{GL_NO_ERROR} : pending.take();
    pending.raise(specified.errors[i], raised[i]);
  }
  return answers;
}

}  // namespace

std::size_t Prediction::vertex_count() const {
  std::size_t count = 0;
  for (const reference::Primitive& primitive : primitives) count += primitive.vertices.size();
  return count;
}

bool Prediction::has_meshes() const {
  return std::ranges::any_of(primitives,
                             [](const reference::Primitive& primitive) { return primitive.mesh != 0; });
}

bool Prediction::has_automatic_normals() const {
  for (const reference::Primitive& primitive : primitives)
    for (const reference::Vertex& vertex : primitive.vertices)
      if (std::holds_alternative<reference::AutomaticNormal>(vertex.normal)) return true;
  return false;
}

bool Prediction::has_rational_normals() const {
  for (const reference::Primitive& primitive : primitives)
    for (const reference::Vertex& vertex : primitive.vertices)
      if (const auto* normal = std::get_if<reference::AutomaticNormal>(&vertex.normal);
          normal && is_rational(*normal))
        return true;
  return false;
}

bool is_rational(const reference::AutomaticNormal& normal) {
  if (normal.map->components() < 4) return false;
  const std::vector<double>& points = normal.map->points;
  for (std::size_t w = 3; w < points.size(); w += 4)
    if (points[w] != points[3]) return true;
  return false;
}

bool Prediction::has_positions_beyond_float() const {
  for (const reference::Primitive& primitive : primitives)
    for (const reference::Vertex& vertex : primitive.vertices)
      if (std::ranges::any_of(vertex.position, may_be_anything)) return true;
  return false;
}

bool Prediction::has_nonpositive_w() const {
  const auto may_be_nonpositive = [](const reference::Component& w) {
    if (const float* given = std::get_if<float>(&w)) return !(*given > 0);
    return !(reference::exact(w) > reference::acceptance_bound(w));
  };
  for (const reference::Primitive& primitive : primitives)
    for (const reference::Vertex& vertex : primitive.vertices)
      if (std::ranges::any_of(vertex.position, may_be_anything) || may_be_nonpositive(vertex.position[3]))
        return true;
  return false;
}

std::vector<bool> specified_commands(const gl::Case& script, OtherState other) {
  const std::vector<gl::Command>& commands = script.commands();
  if (uses_several_contexts(script))
    throw std::invalid_argument("a case of several contexts has no prediction");
  std::vector<bool> known;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const bool asks_for_error = i + 1 < commands.size() && commands[i + 1].entry == gl::EntryPoint::GetError;
    const bool is_skipped =
        other == OtherState::kSkipped && !asks_for_error && names_other_state(commands[i]);
    known.push_back(gl::has(oracle(), commands[i].entry) && !is_skipped);
  }
  return known;
}

gl::Case only_specified(const gl::Case& script) {
  return chosen(script, specified_commands(script, OtherState::kSkipped)).first;
}

Prediction predict(const gl::Case& script, int max_eval_order) {
  reference::Specification specification({.max_eval_order = max_eval_order});
  // This saves a copy of the commands of long primitives.
  const std::vector<bool> known = specified_commands(script, OtherState::kRejected);
  const bool all_known = std::ranges::count(known, false) == 0;
  const gl::Trace trace =
      all_known ? play(script, specification) : play(chosen(script, known).first, specification);
  return prediction_of(specification, trace);
}

bool may_raise_an_error(const gl::Case& script, int max_eval_order) {
  if (uses_several_contexts(script)) return true;
  const gl::Case known = chosen(script, specified_commands(script, OtherState::kRejected)).first;
  reference::Specification specification({.max_eval_order = max_eval_order, .keeps_vertices = false});
  const gl::Trace trace = play(known, specification);
  if (!trace.left_over_errors().empty()) return true;
  for (std::size_t i = 0; i < known.commands().size(); ++i)
    if (known.commands()[i].entry == gl::EntryPoint::GetError &&
        trace.error({static_cast<int>(i)}) != GL_NO_ERROR)
      return true;
  return false;
}

Specified specify(const gl::Case& script, int max_eval_order, TextureUnits units, OtherState other,
                  Emission emission) {
  reference::Specification specification({.max_eval_order = max_eval_order,
                                          .texture_units = units.with_coordinates,
                                          .active_units = units.active,
                                          .keeps_vertices = emission == Emission::kPredicted});
  Specified specified;
  specified.known = specified_commands(script, other);
  const auto [known, positions] = chosen(script, specified.known);
  std::vector<reference::Primitive> primitives;
  std::vector<std::size_t> raised;
  // Adds the state after the known commands so far, for the next command of the case.
  const auto add = [&] {
    specified.completed.push_back(primitives.size());
    specified.inside.push_back(specification.inside());
  };
  const auto add_unknown = [&, &positions = positions] {
    while (specified.errors.size() < positions.size() && positions[specified.errors.size()] < 0) {
      specified.errors.emplace_back();
      raised.push_back(0);
      specified.permitted.emplace_back();
      add();
    }
  };
  add_unknown();
  specified.answers = play(known, specification, [&](std::size_t) {
    specified.errors.push_back(specification.permitted_errors());
    raised.push_back(specification.raised_errors());
    specified.permitted.push_back(specification.permitted_answer());
    std::ranges::move(specification.take_primitives(), std::back_inserter(primitives));
    add();
    add_unknown();
  });
  specified.prediction = prediction_of(specification, specified.answers);
  specified.prediction.primitives = std::move(primitives);
  specified.answers = specified.answers.of(positions);
  specified.error_answers = error_answers(script, specified, raised);
  return specified;
}

SpecifiedContext::SpecifiedContext(int max_eval_order)
    : specification_(std::make_unique<reference::Specification>(
          reference::Specification::Options{.max_eval_order = max_eval_order, .keeps_vertices = false})) {}

SpecifiedContext::~SpecifiedContext() = default;

bool SpecifiedContext::accepts(const gl::Command& command) {
  gl::Case script;
  script.add(command);
  bool is_accepted = true;
  play(script, *specification_, [&](std::size_t) { is_accepted = specification_->raised_errors() == 0; });
  specification_->take_primitives();
  return is_accepted;
}

gl::Case as_explicit_commands(const Prediction& prediction) {
  gl::Case c("explicit vertices");
  for (const reference::Primitive& primitive : prediction.primitives) {
    c.Begin(primitive.mode);
    for (const reference::Vertex& vertex : primitive.vertices) {
      const auto value = [](const reference::Component& component) { return reference::rounded(component); };
      const auto& [position, color, normal, textures, index, edge_flag] = vertex;
      const auto& texture = textures[0];
      c.Color4f(value(color[0]), value(color[1]), value(color[2]), value(color[3]));
      const std::array<float, 3> direction = reference::rounded(normal);
      c.Normal3f(direction[0], direction[1], direction[2]);
      c.TexCoord4f(value(texture[0]), value(texture[1]), value(texture[2]), value(texture[3]));
      c.EdgeFlag(edge_flag);
      c.Vertex4f(value(position[0]), value(position[1]), value(position[2]), value(position[3]));
    }
    c.End();
  }
  return c;
}

}  // namespace evalcts
