// Expects the answers, errors and vertices of a program on the executable specification from the
// implementation under test.
#include <evalcts/fuzz/as_specified.h>

namespace evalcts::fuzz {
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

void expect_answers(Test& t, const gl::Case& program, const gl::Trace& expected) {
  CheckedTrace checked = t.play(program);
  for (int i = 0; i < static_cast<int>(program.commands().size()); ++i) {
    const gl::Ref command{i};
    if (program.commands()[static_cast<std::size_t>(i)].entry == gl::EntryPoint::GetError) {
      checked.expect_error(command, {expected.error(command)});
    } else if (expected.has_output(command)) {
      expect_answer(checked, expected, command);
    } else {
      checked.expect_result(command, expected.result(command));
    }
  }
}

}  // namespace

void expect_as_specified(Test& t, const gl::Case& program, const Specified& specified, Look look) {
  constexpr Attributes kJudged = kPosition | kColor | kNormal | kTextureCoordinate0;
  const bool emits = specified.prediction.vertex_count() > 0;
  if (look == Look::kAll || look == Look::kAnswers) expect_answers(t, program, specified.answers);
  if (look == Look::kAnswers || (look == Look::kAll && !emits)) return;
  if (look == Look::kOrder) t.judge_order_of_meshes();
  t.expect_emission(program, specified.prediction, kJudged);
}

}  // namespace evalcts::fuzz
