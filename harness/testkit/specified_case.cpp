// Judges a case by the executable specification: every answer, error and emitted vertex.
#include <algorithm>
#include <string_view>
#include <utility>

#include <evalcts/testkit/test.h>

namespace evalcts {
namespace {

// Relative tolerance of queries, which may answer in single precision (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE).
constexpr double kTolerance = 1e-5;

template <class T>
std::vector<T> written_values(const gl::Trace& trace, gl::Ref query) {
  std::vector<T> values = trace.values<T>(query);
  values.resize(trace.written(query));
  return values;
}

void expect_answer(CheckedTrace& checked, const gl::Trace& expected, gl::Ref query) {
  switch (expected.type(query)) {
    case gl::Scalar::kI32:
      return checked.expect_values(query, written_values<GLint>(expected, query));
    case gl::Scalar::kU8:
      return checked.expect_values(query, written_values<GLubyte>(expected, query));
    case gl::Scalar::kF32:
      return checked.expect_values_near(query, written_values<GLfloat>(expected, query), kTolerance);
    default:
      return checked.expect_values_near(query, written_values<GLdouble>(expected, query), kTolerance);
  }
}

// Returns true if the command is rejected because it stands between Begin and End.
bool is_rejected_in_primitive(const Specified& specified, std::size_t command) {
  return command > 0 && specified.inside[command - 1] &&
         std::ranges::count(specified.errors[command], GLenum{GL_INVALID_OPERATION}) > 0;
}

}  // namespace

void Test::require_rejections_in_primitives(const gl::Case& script, const Specified& specified) {
  if (gl().declaration) return;  // a sink has no other state
  gl::Case c(gl::control("commands of other state between Begin and End"));
  std::vector<gl::Ref> errors;
  bool replaced = false;
  for (std::size_t i = 0; i < script.commands().size(); ++i) {
    const gl::Command& command = script.commands()[i];
    const std::string_view name = gl::name_of(command.entry);
    const bool ends_or_asks = name == "glEnd" || name == "glGetError";
    if (!ends_or_asks && is_rejected_in_primitive(specified, i)) {
      if (name.starts_with("glIs"))
        c.IsEnabled(GL_LIGHTING);
      else if (name.starts_with("glGet"))
        c.GetIntegerv(GL_MATRIX_MODE, gl::out<GLint>(1));
      else
        c.Enable(GL_CULL_FACE);
      replaced = true;
    } else {
      const gl::Ref added = c.add(command);
      if (name == "glGetError" && std::exchange(replaced, false)) errors.push_back(added);
    }
  }
  if (errors.empty()) return;
  const gl::Ref enabled = c.IsEnabled(GL_CULL_FACE);
  c.GetError();  // an evaluator library has no such capability
  const CheckedTrace checked = play(c);
  const gl::Trace& trace = checked.trace();
  const auto is_silent = [&](gl::Ref error) { return trace.error(error) == GL_NO_ERROR; };
  if (trace.result(enabled) != GL_FALSE || std::ranges::any_of(errors, is_silent))
    throw NotObservable(
        "pipeline: Enable(CULL_FACE) or a query of other state takes effect or raises no error between Begin "
        "and End as well");
}

void Test::judge_answers(const gl::Case& script, const Specified& specified) {
  CheckedTrace checked = play(script);
  const auto is_missing = [&](std::size_t i) {
    const std::vector<GLenum>& due = specified.error_answers[i];
    return !due.empty() && std::ranges::count(due, GLenum{GL_NO_ERROR}) == 0 &&
           checked.trace().error({static_cast<int>(i)}) == GL_NO_ERROR;
  };
  for (std::size_t i = 0; i < script.commands().size(); ++i)
    if (is_missing(i)) {
      require_rejections_in_primitives(script, specified);
      break;
    }
  for (std::size_t i = 0; i < script.commands().size(); ++i) {
    const gl::Ref command{static_cast<int>(i)};
    if (!specified.error_answers[i].empty()) {
      checked.expect_error(command, specified.error_answers[i]);
    } else if (specified.answers.has_output(command)) {
      expect_answer(checked, specified.answers, command);
    } else {
      checked.expect_result(command, specified.answers.result(command));
    }
  }
}

void Test::judge(const gl::Case& script) { judge(script, specify(script, max_order())); }

void Test::judge(const gl::Case& script, const Specified& specified, Outcomes outcomes) {
  constexpr Attributes kJudged = kPosition | kColor | kNormal | kTextureCoordinate0;
  const bool emits = specified.prediction.vertex_count() > 0;
  if (outcomes == Outcomes::kAll || outcomes == Outcomes::kAnswers) judge_answers(script, specified);
  if (outcomes == Outcomes::kAnswers || (outcomes == Outcomes::kAll && !emits)) return;
  if (outcomes == Outcomes::kOrder) judge_order_of_meshes();
  expect_emission(script, specified.prediction, kJudged);
}

}  // namespace evalcts
