// Checks the answers and errors of a case, and records each failure with a check for the C program.
#include <evalcts/testkit/checked_trace.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/testkit/test.h>

namespace evalcts {
namespace {

// Returns the shortest text that distinguishes the value from all other floats, or doubles if it is
// not a float.
std::string shortest(double value) {
  const auto single = static_cast<float>(value);
  // Integers are printed with all digits; the shortest form of a large float would end in zeros.
  if (value == std::trunc(value) && std::abs(value) < 0x1p53) return fmt::format("{:.0f}", value + 0.0);
  return static_cast<double>(single) == value ? fmt::format("{}", single) : fmt::format("{}", value);
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size() && i < 16; ++i) text += (i ? ", " : "") + shortest(values[i]);
  if (values.size() > 16) text += fmt::format(", ... ({} values)", values.size());
  return "{" + text + "}";
}

// Returns the relation of a wrong answer to the intervals of permitted ones: near or far, or
// Difference::kSaturated if the value that is due does not fit into the integer.
std::string relation_of(double captured, const CheckedTrace::Intervals& permitted, gl::Scalar type) {
  constexpr double kLargest = std::numeric_limits<GLint>::max(),
                   kSmallest = std::numeric_limits<GLint>::min();
  const auto is_near = [&](const auto& interval) {
    return evalcts::relation_of(captured, interval.first, interval.second) == "near";
  };
  const auto is_saturated = [&](const auto& interval) {
    return type == gl::Scalar::kI32 && (interval.first >= kLargest || interval.second <= kSmallest);
  };
  if (std::ranges::any_of(permitted, is_saturated)) return Difference::kSaturated;
  return std::ranges::any_of(permitted, is_near) ? "near" : "far";
}

gl::Check at_most_written(gl::Ref query, std::size_t count) {
  return {.answer = {.kind = gl::Answer::Kind::kWritten, .command = query},
          .accepted = {{0.0, static_cast<double>(count)}}};
}

std::vector<double> all_values(const gl::Trace& trace, gl::Ref query) {
  const auto as = [&]<class T>(T) {
    const std::vector<T> values = trace.values<T>(query);
    return std::vector<double>(values.begin(), values.end());
  };
  switch (trace.type(query)) {
    case gl::Scalar::kF32:
      return as(GLfloat());
    case gl::Scalar::kF64:
      return as(GLdouble());
    case gl::Scalar::kI32:
      return as(GLint());
    case gl::Scalar::kU32:
      return as(GLuint());
    case gl::Scalar::kU8:
      return as(GLubyte());
    default:
      throw std::logic_error("no query writes this type");
  }
}

}  // namespace

CheckedTrace::CheckedTrace(Test& test, gl::DeliveredCase delivered, const gl::Trace& trace)
    : test_(test), delivered_(std::move(delivered)), trace_(trace.of(delivered_.positions)) {}

void CheckedTrace::fail(gl::Check check, const Difference& difference, const std::string& message,
                        const std::string& expected, const std::string& captured) {
  ++failures_;
  const gl::Case& script = delivered_.script;
  Failure failure;
  failure.case_identity = script.identity();
  failure.message = message;
  failure.what = std::string(gl::name_of(command(check.answer.command).entry));
  failure.difference = difference;
  // The C program contains the delivered case, so the check must refer to its commands.
  check.answer.command = as_delivered(check.answer.command);
  if (check.other.index >= 0) check.other = as_delivered(check.other);
  for (gl::Ref& recorded : check.recorded) recorded = as_delivered(recorded);
  const gl::Ref asked = check.answer.command;
  failure.expected = check.expected = expected;
  failure.captured = captured;
  if (plot_ && !test_.has_plot()) failure.plot = plot_();
  test_.fail(
      std::move(failure), [&] { return gl::to_c(script, 0, asked.index); }, check, observed_);
}

void CheckedTrace::expect_error(gl::Ref get_error, const std::vector<GLenum>& allowed) {
  expect_error_of({std::max(get_error.index - 1, 0)}, get_error, allowed);
}

void CheckedTrace::expect_error_of(gl::Ref raises, gl::Ref get_error, const std::vector<GLenum>& allowed) {
  const GLenum got = trace_.error(get_error);
  if (std::find(allowed.begin(), allowed.end(), got) != allowed.end()) return;
  require_answer(raises);
  if (got != GL_NO_ERROR)
    test_.require_no_error_of_explicit_commands(delivered_.script, as_delivered(get_error), got);
  std::string expected;
  for (const GLenum error : allowed) expected += (expected.empty() ? "" : " or ") + gl::error_name(error);
  const std::string captured = gl::error_name(got);
  const gl::Command& subject = command(raises);
  const bool none_allowed = allowed.front() == GL_NO_ERROR;
  const char* kind = none_allowed ? "spurious error" : got == GL_NO_ERROR ? "missing error" : "wrong error";
  gl::Check check{.answer = {.kind = gl::Answer::Kind::kReturned, .command = get_error, .is_error = true}};
  for (const GLenum error : allowed) check.accepted.emplace_back(error, error);
  // A command that executes, begins or ends a list does not show which command of the list raises the error.
  const gl::EntryPoint entry = subject.entry;
  const bool hides_command = entry == gl::EntryPoint::CallList || entry == gl::EntryPoint::CallLists ||
                             entry == gl::EntryPoint::EndList || entry == gl::EntryPoint::NewList;
  std::string place = hides_command ? "" : gl::stem_without_dimension(entry);
  if (const std::string rules = gl::broken_map_rules(subject, test_.max_order());
      !rules.empty() && allowed == std::vector<GLenum>{GL_INVALID_VALUE})
    place += " " + rules;
  fail(std::move(check),
       {Difference::kError, place, relation_of_errors(captured, gl::error_name(allowed.front()))},
       fmt::format("{}: after {} glGetError gives {}, expected {}", kind, gl::to_c(subject, 4), captured,
                   expected),
       expected, captured);
}

void CheckedTrace::expect_result(gl::Ref asked, std::int64_t expected) {
  const std::int64_t got = trace_.result(asked);
  if (got == expected) return;
  fail({.answer = {.kind = gl::Answer::Kind::kReturned, .command = asked},
        .accepted = {{static_cast<double>(expected), static_cast<double>(expected)}}},
       {Difference::kAnswer, place_of(asked), "far"},
       fmt::format("{} returns {}, expected {}", gl::to_c(command(asked), 4), got, expected),
       std::to_string(expected), std::to_string(got));
}

std::vector<double> CheckedTrace::written_values(gl::Ref query) const {
  std::vector<double> values = all_values(trace_, query);
  values.resize(std::min(values.size(), trace_.written(query)));
  return values;
}

bool CheckedTrace::is_query_of_state(gl::Ref query) const {
  const gl::EntryPoint entry = command(query).entry;
  return entry == gl::EntryPoint::GetBooleanv || entry == gl::EntryPoint::GetIntegerv ||
         entry == gl::EntryPoint::GetFloatv || entry == gl::EntryPoint::GetDoublev;
}

std::string CheckedTrace::place_of(gl::Ref query) const {
  const gl::Command& asked = command(query);
  std::string place = gl::stem_without_dimension(asked.entry);
  if (place == "GetnMap") place = "GetMap";
  const std::size_t name = gl::role_of(asked.entry) == gl::Role::kGetMap ? 1 : 0;
  if (asked.arguments.size() <= name || gl::parameter_kinds(asked.entry)[name] == '.') return place;
  std::string token = gl::token_name(static_cast<GLenum>(gl::integer_of(asked, name)));
  // The targets and grids of one and two dimensions have the same rules.
  if (token.starts_with("GL_MAP1") || token.starts_with("GL_MAP2")) token.erase(6, 1);
  return place + " " + token;
}

void CheckedTrace::require_answer(gl::Ref query) const {
  if (!is_query_of_state(query)) return;
  const gl::Command& asked = command(query);
  const auto name = static_cast<GLenum>(std::get<std::int64_t>(asked.arguments.at(0)));
  if (test_.gl().rejected_queries.contains({asked.entry, name}))
    throw NotObservable(fmt::format("{} of {} is rejected", gl::name_of(asked.entry), gl::token_name(name)));
}

void CheckedTrace::check_values(gl::Ref query, const std::vector<double>& expected, double relative) {
  std::vector<Intervals> permitted;
  for (const double value : expected) {
    const double margin = std::isfinite(value) ? relative * std::abs(value) : 0;
    permitted.push_back({{value - margin, value + margin}});
  }
  expect_permitted(query, permitted, expected);
}

namespace {

// Returns the index of the first value that is in none of its intervals; the number of values if there is
// none.
std::size_t first_wrong(const std::vector<double>& values,
                        const std::vector<CheckedTrace::Intervals>& permitted) {
  std::size_t i = 0;
  const auto is_permitted = [&](const auto& interval) {
    return interval.first <= values[i] && values[i] <= interval.second;
  };
  while (i < std::min(values.size(), permitted.size()) && std::ranges::any_of(permitted[i], is_permitted))
    ++i;
  return i;
}

}  // namespace

bool CheckedTrace::is_permitted(gl::Ref query, const std::vector<Intervals>& permitted) const {
  return trace_.written(query) <= permitted.size() &&
         first_wrong(all_values(trace_, query), permitted) >= permitted.size();
}

void CheckedTrace::expect_permitted(gl::Ref query, const std::vector<Intervals>& permitted,
                                    const std::vector<double>& expected) {
  // A form of Get that rejects state of evaluators fails if another form answers it.
  if (!is_query_of_state(query) || gl::integer_of(command(query), 0) != GL_MAX_EVAL_ORDER ||
      !test_.gl().answers(GL_MAX_EVAL_ORDER))
    require_answer(query);
  const std::size_t written = trace_.written(query);
  const std::string call = gl::to_c(command(query), 4);
  const std::size_t i = first_wrong(all_values(trace_, query), permitted);
  if (written > expected.size()) {
    fail(at_most_written(query, expected.size()), {Difference::kAnswer, place_of(query), "more values"},
         fmt::format("{} writes {} values, expected {}", call, written, expected.size()), list(expected),
         list(written_values(query)));
  } else if (i < expected.size()) {
    fail({.answer = {.kind = gl::Answer::Kind::kElement, .command = query, .element = i},
          .accepted = permitted[i]},
         {Difference::kAnswer, place_of(query),
          relation_of(all_values(trace_, query)[i], permitted[i], trace_.type(query))},
         fmt::format("{} answers {}, expected {}", call, list(written_values(query)), list(expected)),
         list(expected), list(written_values(query)));
  }
}

void CheckedTrace::expect_nothing_written(gl::Ref query) {
  if (trace_.written(query) == 0) return;
  fail(at_most_written(query, 0), {Difference::kAnswer, place_of(query), "written in spite of the error"},
       fmt::format("{} writes to its array in spite of the error", gl::to_c(command(query), 4)),
       "nothing written", list(written_values(query)));
}

void CheckedTrace::expect_same(gl::Ref before, gl::Ref after) {
  if (before.index < 0 || after.index < 0) return;
  if (trace_.same(before, trace_, after)) return;
  const auto answer = [&](gl::Ref query) {
    return trace_.has_output(query) ? list(written_values(query)) : std::to_string(trace_.result(query));
  };
  const std::string was = answer(before), is = answer(after);
  fail({.rule = gl::Check::Rule::kSame, .answer = {.command = after}, .other = before},
       {Difference::kAnswer, place_of(after), ""},
       fmt::format("{} answered {} before and answers {} now", gl::to_c(command(after), 4), was, is), was,
       is);
}

void CheckedTrace::expect(bool holds, gl::Ref command, const std::string& message,
                          const std::string& expected, const std::string& captured) {
  if (holds) return;
  require_answer(command);
  fail({.rule = gl::Check::Rule::kUnlike, .answer = {.command = command}, .recorded = {command}},
       {kind_of(std::string(gl::name_of(this->command(command).entry))), place_of(command), ""}, message,
       expected, captured);
}

}  // namespace evalcts
