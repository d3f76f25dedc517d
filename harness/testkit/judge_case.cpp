// Implements the part of Test that judges by the executable specification: every answer, error and emitted
// vertex.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/errors.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/roles.h>
#include <evalcts/testkit/test.h>
#include "blame.h"

namespace evalcts {
namespace {

// Relative tolerance of queries, which may answer in single precision (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE).
constexpr double kTolerance = 1e-5;

// The attributes that are judged wherever a capture shows them.
constexpr Attributes kJudged = kPosition | kColor | kNormal | kTextureCoordinate0;

bool is_real(gl::Scalar type) { return type == gl::Scalar::kF32 || type == gl::Scalar::kF64; }

// Returns the likeliest answer of a query.
std::vector<double> likeliest(const std::vector<reference::PermittedValue>& permitted) {
  std::vector<double> answer;
  for (const reference::PermittedValue& value : permitted) answer.push_back(value.answers.front());
  return answer;
}

// Returns the accepted values of each element of an answer. `tolerance`: relative, for floats and doubles.
std::vector<CheckedTrace::Intervals> accepted(const std::vector<reference::PermittedValue>& permitted,
                                              double tolerance) {
  std::vector<CheckedTrace::Intervals> all;
  for (const reference::PermittedValue& value : permitted) {
    CheckedTrace::Intervals& intervals = all.emplace_back();
    for (const double answer : value.answers) {
      const double margin = std::isfinite(answer) && !value.is_exact ? tolerance * std::abs(answer) : 0;
      intervals.emplace_back(answer - margin,
                             value.is_least ? std::numeric_limits<double>::infinity() : answer + margin);
    }
  }
  return all;
}

// Returns true if the command before GetError, which may be repeated, is compiled, or ends a display list.
bool follows_compiled_command(const gl::Case& script, std::size_t get_error) {
  const std::vector<gl::Command>& commands = script.commands();
  const auto entry = [&](std::size_t i) { return commands[i].entry; };
  std::size_t last = get_error;
  while (last > 0 && entry(last) == gl::EntryPoint::GetError) --last;
  if (entry(last) == gl::EntryPoint::EndList) return true;
  while (last > 0 && entry(last) != gl::EntryPoint::NewList && entry(last) != gl::EntryPoint::EndList) --last;
  return entry(last) == gl::EntryPoint::NewList;
}

// Returns true if both commands ask for the same state.
bool is_same_query(const gl::Command& a, const gl::Command& b) {
  const auto is_same = [](const gl::Value& x, const gl::Value& y) {
    const auto *one = std::get_if<std::int64_t>(&x), *other = std::get_if<std::int64_t>(&y);
    return !one || !other || *one == *other;
  };
  return a.entry == b.entry && std::ranges::equal(a.arguments, b.arguments, is_same);
}

// Returns true if the command is rejected because it stands between Begin and End.
bool is_rejected_in_primitive(const Specified& specified, std::size_t command) {
  return command > 0 && specified.inside[command - 1] &&
         std::ranges::count(specified.errors[command], GLenum{GL_INVALID_OPERATION}) > 0;
}

// Returns the last command before GetError that has to raise the error which is due; the command before
// GetError if none is due.
gl::Ref raising_command(const Specified& specified, gl::Ref get_error) {
  const int before = std::max(get_error.index - 1, 0);
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  if (specified.error_answers[at(get_error.index)].front() == GL_NO_ERROR) return {before};
  for (int i = before; i >= 0 && specified.error_answers[at(i)].empty(); --i)
    if (!specified.errors[at(i)].empty()) return {i};
  return {before};
}

}  // namespace

void Test::require_rejections_in_primitives(const gl::Case& script, const Specified& specified) {
  if (gl().declaration) return;  // a sink has no other state
  gl::Case c(gl::control("commands of other state between Begin and End"));
  std::vector<gl::Ref> errors;
  bool replaced = false;
  for (std::size_t i = 0; i < script.commands().size(); ++i) {
    const gl::Command& command = script.commands()[i];
    const bool asks_for_error = command.entry == gl::EntryPoint::GetError;
    if (!asks_for_error && command.entry != gl::EntryPoint::End && is_rejected_in_primitive(specified, i)) {
      if (gl::asks(command.entry) && !specified.answers.has_output({static_cast<int>(i)}))
        c.IsEnabled(GL_LIGHTING);
      else if (gl::asks(command.entry))
        c.GetIntegerv(GL_MATRIX_MODE, gl::out<GLint>(1));
      else
        c.Enable(GL_CULL_FACE);
      replaced = true;
    } else {
      const gl::Ref added = c.add(command);
      if (asks_for_error && std::exchange(replaced, false)) errors.push_back(added);
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

void Test::require_rounding_of_other_state() {
  if (gl().declaration || !gl().has(gl::EntryPoint::Fogf)) return;  // a sink has no other state
  gl::Case c(gl::control("GetIntegerv of FOG_START"));
  c.Fogf(GL_FOG_START, -1.75f);
  const gl::Ref start = c.GetIntegerv(GL_FOG_START, gl::out<GLint>(1));
  if (play(c).trace().values<GLint>(start) != std::vector<GLint>{-2})
    throw NotObservable("pipeline: GetIntegerv rounds other state wrongly as well");
}

void Test::judge_answer(CheckedTrace& checked, const gl::Case& script, const Specified& specified,
                        gl::Ref query) {
  const auto& permitted = specified.permitted[static_cast<std::size_t>(query.index)];
  const bool is_advisory = std::ranges::any_of(permitted, &reference::PermittedValue::is_advisory);
  if (is_advisory && record_.level != Level::kQuality) return;
  const gl::Scalar type = specified.answers.type(query);
  const std::vector<double> expected = likeliest(permitted);
  const double tolerance = is_real(type) ? kTolerance : 0;
  if (record_.level == Level::kQuality && is_real(type) && !is_advisory) {
    // Single precision relative to the largest value, because a library may compute an end of a domain as a
    // small difference of large numbers.
    double largest = 0;
    for (const double value : expected) largest = std::max(largest, std::abs(value));
    const std::vector<double> values = checked.written_values(query);
    for (std::size_t i = 0; i < std::min(values.size(), expected.size()); ++i)
      if (!(std::abs(values[i] - expected[i]) <= kTolerance * largest))
        throw NotObservable("the answer is wrong, which other tests judge");
    return checked.expect_permitted(query, accepted(permitted, 0), expected);
  }
  const auto is_rounded = [](const reference::PermittedValue& value) {
    return value.state != std::trunc(value.state);
  };
  if (type == gl::Scalar::kI32 && std::ranges::any_of(permitted, is_rounded) &&
      checked.is_query_of_state(query) && !checked.is_permitted(query, accepted(permitted, 0)))
    require_rounding_of_other_state();
  if (!checked.is_permitted(query, accepted(permitted, tolerance)))
    if (const std::string fault = fault_of_explicit_answer(script, query); !fault.empty()) {
      fault_outside_evaluators_ = fault;
      return;
    }
  checked.expect_permitted(query, accepted(permitted, tolerance), expected);
}

void Test::require_no_error_of_explicit_commands(const gl::Case& script, gl::Ref get_error, GLenum answered) {
  gl::Case before = script.without_commands();
  for (int i = 0; i < get_error.index; ++i) before.add(script.commands()[static_cast<std::size_t>(i)]);
  if (control_.error_without_evaluators(before, {answered}))
    throw NotObservable(fmt::format("pipeline: explicit commands instead of evaluations raise {} as well",
                                    gl::error_name(answered)));
}

std::string Test::fault_of_explicit_answer(const gl::Case& script, gl::Ref query) {
  const gl::Command& asked = script.commands()[static_cast<std::size_t>(query.index)];
  if (subject_.is_warm || subject_.reproduction || gl::role_of(asked.entry) != gl::Role::kGet) return {};
  for (const gl::Case& control : {gl::with_explicit_commands(script), gl::with_explicit_vertices(script)}) {
    const Specified specified = specify_answers(control);
    const gl::DeliveredCase delivered = delivery_.apply(control);
    const gl::Trace trace = subject_.implementation->create_context()->play(delivered.script);
    const CheckedTrace checked(*this, delivered, trace);
    for (std::size_t i = 0; i < control.commands().size(); ++i) {
      const gl::Ref same{static_cast<int>(i)};
      if (!specified.known[i] || !specified.errors[i].empty() || !is_same_query(asked, control.commands()[i]))
        continue;
      const double tolerance = is_real(specified.answers.type(same)) ? kTolerance : 0;
      if (!checked.is_permitted(same, accepted(specified.permitted[i], tolerance)))
        return fmt::format(
            "pipeline: with explicit commands instead of evaluations, {} gives a wrong answer as well",
            gl::to_c(asked, 4));
    }
  }
  return {};
}

gl::Ref Test::same_as(const Specified& specified, const gl::Case& script, gl::Ref query) const {
  const gl::Trace& expected = specified.answers;
  const std::vector<gl::Command>& commands = script.commands();
  for (const int earlier : snapshot_) {
    if (earlier >= query.index) break;
    if (expected.same({earlier}, expected, query) &&
        is_same_query(commands[static_cast<std::size_t>(earlier)],
                      commands[static_cast<std::size_t>(query.index)]))
      return {earlier};
  }
  return {};
}

void Test::check_answers(const gl::Case& script, const gl::DeliveredCase& delivered,
                         const Specified& specified) {
  const std::uint64_t begun = cases_;
  CheckedTrace checked = play(delivered);
  const gl::Trace& trace = checked.trace();
  // A Begin that is lost shows in missing errors, or in effects of commands that are legal outside of a
  // primitive; their error is then that of End.
  const auto may_have_lost_begin = [&](std::size_t i) {
    const gl::Ref command{static_cast<int>(i)};
    const std::vector<GLenum>& due = specified.error_answers[i];
    if (!due.empty()) return std::ranges::count(due, trace.error(command)) == 0;
    if (snapshot_.contains(command.index)) {
      const gl::Ref before = same_as(specified, script, command);
      return before.index >= 0 && !trace.same(before, trace, command);
    }
    return specified.known[i] && !trace.same(command, specified.answers, command);
  };
  for (std::size_t i = 0; i < script.commands().size(); ++i)
    if (may_have_lost_begin(i)) {
      require_rejections_in_primitives(script, specified);
      break;
    }
  bool errors_are_right = true;
  fault_outside_evaluators_.clear();
  for (std::size_t i = 0; i < script.commands().size(); ++i) {
    const gl::Ref command{static_cast<int>(i)};
    if (!specified.known[i]) continue;
    if (!specified.error_answers[i].empty()) {
      checked.set_observed(follows_compiled_command(script, i) ? Observed::kCompilingError
                                                               : Observed::kError);
      const std::size_t failures = checked.failures();
      checked.expect_error_of(raising_command(specified, command), command, specified.error_answers[i]);
      errors_are_right = errors_are_right && checked.failures() == failures;
    } else if (snapshot_.contains(command.index)) {
      checked.set_observed(Observed::kChange);
      // Without an error, an effect is no wonder.
      if (errors_are_right) checked.expect_same(same_as(specified, script, command), command);
    } else if (specified.answers.has_output(command) && !specified.errors[i].empty()) {
      checked.set_observed(Observed::kWritten);
      checked.expect_nothing_written(command);
    } else if (specified.answers.has_output(command)) {
      checked.set_observed(Observed::kAnswer);
      judge_answer(checked, script, specified, command);
    } else {
      checked.set_observed(Observed::kAnswer);
      checked.expect_result(command, specified.answers.result(command));
    }
  }
  snapshot_.clear();
  // If controls have run, a later crash is that of the case again.
  if (cases_ != begun && subject_.before_case) subject_.before_case(delivered.script);
  if (!fault_outside_evaluators_.empty() && checked.failures() == 0)
    throw NotObservable(fault_outside_evaluators_);
}

void Test::compare_only(const std::vector<gl::Ref>& queries) {
  for (const gl::Ref query : queries)
    if (query.index >= 0) snapshot_.insert(query.index);
}

Specified Test::specify_answers(const gl::Case& script) const {
  return specify(script, max_order(), units(), OtherState::kSkipped, Emission::kLeftOut);
}

void Test::judge(const gl::Case& script) {
  const gl::DeliveredCase delivered = begin_case(script);
  check_answers(script, delivered, specify_answers(script));
  const Prediction prediction = predict(delivered.script, max_order());
  if (prediction.vertex_count() > 0)
    judge_emission(delivered.script, prediction, kJudged, Thoroughness::kAllVertices);
}

void Test::judge_answers(const gl::Case& script) {
  const gl::DeliveredCase delivered = begin_case(script);
  check_answers(script, delivered, specify_answers(script));
}

void Test::judge_specified(const gl::Case& script, const Specified& specified, Outcomes outcomes,
                           Attributes attributes) {
  if (!delivery_.name.empty()) throw std::logic_error("a prediction is of the case as it is delivered");
  const gl::DeliveredCase delivered = begin_case(script);
  if (outcomes == Outcomes::kAll || outcomes == Outcomes::kAnswers)
    check_answers(script, delivered, specified);
  if (outcomes == Outcomes::kAnswers) return;
  if (outcomes == Outcomes::kAll && specified.prediction.vertex_count() == 0) return;
  if (outcomes == Outcomes::kOrder) judge_order_of_meshes();
  judge_emission(script, specified.prediction, kJudged, Thoroughness::kFirstMismatches, attributes);
}

}  // namespace evalcts
