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

// Returns the commands of a case that the specification supports.
gl::Case known_commands(const gl::Case& script) {
  gl::Case known;
  std::vector<std::optional<int>> places;  // positions in `known`; none for omitted commands
  for (gl::Command command : script.commands()) {
    std::optional<int>& place = places.emplace_back();
    if (gl::is_of_harness(command.entry))
      throw std::logic_error("a case of several contexts has no prediction");
    if (!gl::has(oracle(), command.entry)) continue;
    for (gl::Value& argument : command.arguments)
      if (auto* result = std::get_if<gl::ResultOf>(&argument))
        result->command = places.at(static_cast<std::size_t>(result->command)).value();
    place = known.add(std::move(command)).index;
  }
  return known;
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
  void raise(const std::vector<GLenum>& errors, std::size_t most) {
    if (errors.empty()) return;
    for (const GLenum error : errors)
      if (std::ranges::count(codes_, error) == 0) codes_.push_back(error);
    recorded_ += most;
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

// See Specified::error_answers.
std::vector<std::vector<GLenum>> error_answers(const gl::Case& script, const Specified& specified) {
  constexpr std::size_t kMostOfList = 1000;  // errors of the commands in called lists
  std::vector<std::vector<GLenum>> answers(script.commands().size());
  PendingErrors pending;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const gl::EntryPoint entry = script.commands()[i].entry;
    if (entry == gl::EntryPoint::GetError)
      answers[i] = i > 0 && specified.inside[i - 1] ? std::vector<GLenum>{GL_NO_ERROR} : pending.take();
    const bool calls = entry == gl::EntryPoint::CallList || entry == gl::EntryPoint::CallLists;
    pending.raise(specified.errors[i], calls ? kMostOfList : 1);
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

Prediction predict(const gl::Case& script, int max_eval_order) {
  reference::Specification specification({.max_eval_order = max_eval_order});
  // This saves a copy of the commands of long primitives.
  const bool all_known = std::ranges::all_of(
      script.commands(), [](const gl::Command& command) { return gl::has(oracle(), command.entry); });
  const gl::Trace trace =
      all_known ? play(script, specification) : play(known_commands(script), specification);
  return prediction_of(specification, trace);
}

bool may_raise_an_error(const gl::Case& script, int max_eval_order) {
  if (std::ranges::any_of(script.commands(), gl::is_of_harness, &gl::Command::entry)) return true;
  const gl::Case known = known_commands(script);
  reference::Specification specification({.max_eval_order = max_eval_order});
  const gl::Trace trace = play(known, specification);
  if (!trace.left_over_errors().empty()) return true;
  for (std::size_t i = 0; i < known.commands().size(); ++i)
    if (known.commands()[i].entry == gl::EntryPoint::GetError &&
        trace.error({static_cast<int>(i)}) != GL_NO_ERROR)
      return true;
  return false;
}

Specified specify(const gl::Case& script, int max_eval_order) {
  reference::Specification specification({.max_eval_order = max_eval_order});
  Specified specified;
  std::vector<reference::Primitive> primitives;
  try {
    specified.answers = play(script, specification, [&](std::size_t) {
      specified.errors.push_back(specification.permitted_errors());
      std::ranges::move(specification.take_primitives(), std::back_inserter(primitives));
      specified.completed.push_back(primitives.size());
      specified.inside.push_back(specification.inside());
    });
  } catch (const gl::MissingEntryPoint& missing) {
    throw std::logic_error(missing.what());
  }
  specified.error_answers = error_answers(script, specified);
  specified.prediction = prediction_of(specification, specified.answers);
  specified.prediction.primitives = std::move(primitives);
  return specified;
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
