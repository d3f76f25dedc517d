#include <evalcts/testkit/test.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/judge.h>
#include <evalcts/results/control_case.h>
#include <evalcts/results/hash.h>
#include <evalcts/testkit/reproduction.h>

namespace evalcts {
namespace {

constexpr std::size_t kFailuresInFull = 8;

// As many digits as tell the value, which may be a float, from all others of its type.
std::string shortest(double value) {
  const auto single = static_cast<float>(value);
  // Integers to the last digit; their shortest form as floats would end in zeros.
  if (value == std::trunc(value) && std::abs(value) < 0x1p53) return fmt::format("{:.0f}", value + 0.0);
  return static_cast<double>(single) == value ? fmt::format("{}", single) : fmt::format("{}", value);
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size() && i < 16; ++i) text += (i ? ", " : "") + shortest(values[i]);
  if (values.size() > 16) text += fmt::format(", ... ({} values)", values.size());
  return "{" + text + "}";
}

std::string numbers(const gl::Trace& trace, gl::Ref command) {
  return trace.has_output(command) ? fmt::format("{} values", trace.capacity(command))
                                   : std::to_string(trace.result(command));
}

auto all_calls(const gl::Case& script) {
  return [&script] { return gl::to_c(script, 0, static_cast<int>(script.commands().size()) - 1); };
}

std::vector<std::pair<double, double>> exactly(std::int64_t value) {
  return {{static_cast<double>(value), static_cast<double>(value)}};
}

Mismatch wrong_error(GLenum got, GLenum expected) {
  Mismatch mismatch;
  mismatch.what = "glGetError";
  mismatch.expected = gl::error_name(expected);
  mismatch.captured = gl::error_name(got);
  mismatch.message =
      fmt::format("the commands leave {} behind, expected {}", mismatch.captured, mismatch.expected);
  mismatch.of = Mismatch::Of::error;
  mismatch.got = got;
  mismatch.lowest = mismatch.highest = expected;
  return mismatch;
}

bool uses_lists(const gl::Case& script) {
  return std::ranges::any_of(
      script.commands(), [](const gl::Command& command) { return command.entry == gl::EntryPoint::NewList; });
}

Attributes all_shown(const Capture& capture) { return capture.attributes() | capture.inexact_attributes(); }

gl::Check at_most_written(gl::Ref query, std::size_t count) {
  return {.answer = {.of = gl::Answer::Of::written, .command = query},
          .accepted = {{0.0, static_cast<double>(count)}}};
}

template <class T>
std::vector<double> as_doubles(const gl::Trace& trace, gl::Ref query) {
  const std::vector<T> values = trace.values<T>(query);
  return {values.begin(), values.end()};
}

std::vector<double> all_values(const gl::Trace& trace, gl::Ref query) {
  switch (trace.type(query)) {
    case gl::Scalar::f32:
      return as_doubles<GLfloat>(trace, query);
    case gl::Scalar::f64:
      return as_doubles<GLdouble>(trace, query);
    case gl::Scalar::i32:
      return as_doubles<GLint>(trace, query);
    case gl::Scalar::u32:
      return as_doubles<GLuint>(trace, query);
    case gl::Scalar::u8:
      return as_doubles<GLubyte>(trace, query);
    default:
      throw std::logic_error("no query writes this type");
  }
}

}  // namespace

// --- Played ----------------------------------------------------------------------------------------------

Played::Played(Test& test, gl::DeliveredCase delivered, const gl::Trace& trace)
    : test_(test), delivered_(std::move(delivered)), trace_(trace.of(delivered_.positions)) {}

void Played::fail(gl::Check check, const std::string& message, const std::string& expected,
                  const std::string& captured) {
  const gl::Case& script = delivered_.script;
  Failure failure;
  failure.case_identity = script.identity();
  failure.message = message;
  failure.what = std::string(gl::name_of(command(check.answer.command).entry));
  // From here on as the C program counts.
  check.answer.command = as_delivered(check.answer.command);
  if (check.other.index >= 0) check.other = as_delivered(check.other);
  for (gl::Ref& recorded : check.recorded) recorded = as_delivered(recorded);
  const gl::Ref asked = check.answer.command;
  failure.expected = check.expected = expected;
  failure.captured = captured;
  test_.fail(
      std::move(failure), [&] { return gl::to_c(script, 0, asked.index); }, check);
}

void Played::expect_error(gl::Ref get_error, std::initializer_list<GLenum> allowed) {
  const GLenum got = trace_.error(get_error);
  if (std::find(allowed.begin(), allowed.end(), got) != allowed.end()) return;
  if (get_error.index > 0) require_answer({get_error.index - 1});
  std::string expected;
  for (const GLenum error : allowed) expected += (expected.empty() ? "" : " or ") + gl::error_name(error);
  const std::string captured = gl::error_name(got);
  // The command that the question was about is the one before GetError.
  const gl::Command& subject = command({std::max(get_error.index - 1, 0)});
  const bool none_allowed = *allowed.begin() == GL_NO_ERROR;
  const char* kind = none_allowed ? "spurious error" : got == GL_NO_ERROR ? "missing error" : "wrong error";
  gl::Check check{.answer = {.of = gl::Answer::Of::returned, .command = get_error, .is_error = true}};
  for (const GLenum error : allowed) check.accepted.emplace_back(error, error);
  fail(std::move(check),
       fmt::format("{}: after {} glGetError gives {}, expected {}", kind, gl::to_c(subject, 4), captured,
                   expected),
       expected, captured);
}

void Played::expect_result(gl::Ref asked, std::int64_t expected) {
  const std::int64_t got = trace_.result(asked);
  if (got == expected) return;
  fail({.answer = {.of = gl::Answer::Of::returned, .command = asked}, .accepted = exactly(expected)},
       fmt::format("{} returns {}, expected {}", gl::to_c(command(asked), 4), got, expected),
       std::to_string(expected), std::to_string(got));
}

std::vector<double> Played::written_values(gl::Ref query) const {
  std::vector<double> values = all_values(trace_, query);
  values.resize(std::min(values.size(), trace_.written(query)));
  return values;
}

void Played::require_answer(gl::Ref query) const {
  const gl::Command& asked = command(query);
  if (asked.entry != gl::EntryPoint::GetBooleanv && asked.entry != gl::EntryPoint::GetIntegerv &&
      asked.entry != gl::EntryPoint::GetFloatv && asked.entry != gl::EntryPoint::GetDoublev)
    return;
  const auto name = static_cast<GLenum>(std::get<std::int64_t>(asked.arguments.at(0)));
  if (test_.gl().refused_queries.contains(name))
    throw NotObservable(fmt::format("the query of {} is rejected", gl::token_name(name)));
}

void Played::check_values(gl::Ref query, const std::vector<double>& expected, double relative) {
  require_answer(query);
  const std::vector<double> all = all_values(trace_, query);
  const std::size_t written = trace_.written(query);
  const std::string call = gl::to_c(command(query), 4);
  const std::size_t compared = std::min(all.size(), expected.size());
  std::size_t i = 0;  // the first that is wrong
  while (i < compared &&
         (all[i] == expected[i] || std::abs(all[i] - expected[i]) <= relative * std::abs(expected[i])))
    ++i;
  if (written > expected.size()) {
    fail(at_most_written(query, expected.size()),
         fmt::format("{} writes {} values, expected {}", call, written, expected.size()), list(expected),
         list(written_values(query)));
  } else if (i < expected.size()) {
    const double margin = relative * std::abs(expected[i]);
    fail({.answer = {.of = gl::Answer::Of::element, .command = query, .element = i},
          .accepted = {{expected[i] - margin, expected[i] + margin}}},
         fmt::format("{} answers {}, expected {}", call, list(written_values(query)), list(expected)),
         list(expected), list(written_values(query)));
  }
}

void Played::expect_nothing_written(gl::Ref query) {
  if (trace_.written(query) == 0) return;
  fail(at_most_written(query, 0),
       fmt::format("{} writes to its array in spite of the error", gl::to_c(command(query), 4)),
       "nothing written", list(written_values(query)));
}

void Played::expect_same(gl::Ref before, gl::Ref after) {
  if (trace_.same(before, trace_, after)) return;
  const bool array = trace_.has_output(before);
  const std::string was = array ? list(written_values(before)) : numbers(trace_, before);
  const std::string is = array ? list(written_values(after)) : numbers(trace_, after);
  fail({.rule = gl::Check::Rule::same, .answer = {.command = after}, .other = before},
       fmt::format("{} answered {} before and answers {} now", gl::to_c(command(after), 4), was, is), was,
       is);
}

void Played::expect(bool holds, gl::Ref command, const std::string& message, const std::string& expected,
                    const std::string& captured) {
  if (!holds) require_answer(command);
  if (!holds)
    fail({.rule = gl::Check::Rule::unlike, .answer = {.command = command}, .recorded = {command}}, message,
         expected, captured);
}

// --- Test ------------------------------------------------------------------------------------------------

int Test::max_order() const { return std::clamp(subject_.info.max_eval_order, 8, 64); }

int Test::order_limit() const {
  if (subject_.info.max_eval_order == 0)
    throw NotObservable("MAX_EVAL_ORDER is not answered, so that no order is known to be too high");
  return std::max(subject_.info.max_eval_order, 8);
}

Depth Test::depth() const {
  if (subject_.depth == Depth::full && delivery_ && !delivery_->is_plain()) return Depth::quick;
  return subject_.depth;
}

int Test::by_depth(int quick, int full, int thorough) const {
  switch (depth()) {
    case Depth::quick:
      return quick;
    case Depth::full:
      return full;
    case Depth::thorough:
      return thorough;
  }
  return full;
}

void Test::require(int major, int minor, const std::string& or_extension) const {
  if (subject_.info.at_least(major, minor)) return;
  if (!or_extension.empty() && subject_.info.extensions.count(or_extension)) return;
  throw NotSupported(
      fmt::format("needs GL {}.{}{}{}", major, minor, or_extension.empty() ? "" : " or ", or_extension));
}

void Test::require_initial_state() const {
  if (subject_.info.shares_state)
    throw NotObservable("all contexts have one state, which is restored by calls");
}

// Every test at thorough depth; otherwise one in 32, the same ones each time, and not those of many
// primitives: another capture of the same case costs a library far more than the case.
bool Test::cross_checked(const Prediction& prediction) const {
  constexpr std::uint32_t kOneOf = 32;
  constexpr std::size_t kManyPrimitives = 64;
  if (subject_.depth == Depth::thorough) return true;
  return fnv1a<std::uint32_t>(record_.name) % kOneOf == 0 && prediction.primitives.size() <= kManyPrimitives;
}

// Counts the case and returns it as it is delivered.
gl::DeliveredCase Test::begin_case(const gl::Case& script) {
  ++cases_;
  lists_in_doubt_.reset();
  if (subject_.reproduction) subject_.reproduction->begin_case();
  gl::DeliveredCase delivered;
  if (delivery_) {
    delivered = delivery_->apply(script);
  } else {
    delivered = {script, std::vector<int>(script.commands().size())};
    std::iota(delivered.positions.begin(), delivered.positions.end(), 0);
  }
  lists_used_ = lists_used_ || uses_lists(delivered.script);
  if (gl().max_eval_order == 0 &&
      std::ranges::any_of(delivered.script.commands(), [&](const gl::Command& command) {
        return gl::largest_order(command) > max_order();
      }))
    throw NotObservable("MAX_EVAL_ORDER is not answered, so that no order above 8 is known to be accepted");
  if (gl().declaration)
    for (const gl::Command& command : delivered.script.commands())
      if (const std::string part = undeclared_part(*gl().declaration, command); !part.empty())
        throw NotSupported(fmt::format("the sink does not declare {}", part));
  if (gl().no_error && may_raise_an_error(delivered.script, max_order()))
    throw NotSupported("a no-error context, in which what raises an error is undefined");
  if (subject_.before_case) subject_.before_case(delivered.script);
  return delivered;
}

Played Test::play(const gl::Case& written) {
  const gl::DeliveredCase delivered = begin_case(written);
  const gl::Case& script = delivered.script;
  const std::unique_ptr<Context> context = subject_.implementation->create_context();
  const gl::Trace trace = context->play(script);
  const std::vector<GLenum>& left_over = trace.left_over_errors();
  Played played(*this, delivered, trace);
  if (!left_over.empty()) {
    std::vector<std::string> names;
    for (const GLenum error : left_over) names.push_back(gl::error_name(error));
    const std::string captured = fmt::format("{}", fmt::join(names, ", "));
    if (is_control(script.identity()))
      throw NotObservable(fmt::format("pipeline: '{}' leaves {} behind", script.identity(), captured));
    Failure failure;
    failure.case_identity = script.identity();
    failure.message = "spurious error: left behind after the last command: " + captured;
    failure.what = "glGetError";
    failure.expected = "GL_NO_ERROR";
    failure.captured = captured;
    const gl::Check check{.answer = {.of = gl::Answer::Of::left_over, .is_error = true},
                          .accepted = exactly(GL_NO_ERROR),
                          .what = "an error left behind"};
    fail(std::move(failure), all_calls(script), check);
  }
  return played;
}

const Capture& Test::capture_for(Attributes required, PrimitiveKinds kinds) const {
  for (std::size_t i = 0; i < subject_.captures->size(); ++i) {
    const Capture* const capture = subject_.captures->at(i);
    if (capture && capture->takes(kinds) && (capture->attributes() & required) == required) return *capture;
  }
  throw NotObservable(fmt::format("no capture of this implementation shows {}", describe(required)));
}

std::vector<const Capture*> Test::captures_showing(Attributes required, PrimitiveKinds kinds,
                                                   bool nonpositive_w, std::size_t most) const {
  std::vector<const Capture*> captures;
  const auto is_usable = [&](const Capture& capture) {
    return !(nonpositive_w && capture.loses_nonpositive_w()) && capture.takes(kinds);
  };
  const Attributes wanted = required & kAllAttributes;
  Attributes shown = 0;
  for (std::size_t i = 0; i < subject_.captures->size(); ++i) {
    if (shown == wanted && captures.size() >= most) break;  // the next one might have to be proved
    const Capture* const capture = subject_.captures->at(i);
    if (!capture || !is_usable(*capture) || (shown == wanted && capture->is_last_resort())) continue;
    const Attributes of_this = capture->shown_of(required);
    if (std::popcount(of_this) > std::popcount(shown)) {
      captures = {capture};
      shown = of_this;
    } else if (of_this != 0 && (of_this & shown) == shown) {
      captures.push_back(capture);
    }
  }
  if (captures.empty())
    throw NotObservable(fmt::format("no capture of this implementation shows {}{}", describe(required),
                                    nonpositive_w ? " of vertices with w <= 0" : ""));
  if (captures.size() > most) captures.resize(most);
  return captures;
}

void Test::note_capture(const Capture& capture) {
  if (record_.capture.empty()) record_.capture = capture.name();
}

Observation Test::observe(const gl::Case& written, Attributes required, std::size_t most_vertices,
                          PrimitiveKinds kinds) {
  const gl::Case script = begin_case(written).script;
  const Capture& capture = capture_for(required, kinds);
  note_capture(capture);
  note_lists(script, capture, required);
  return capture.observe(*subject_.implementation, script, {required, most_vertices, kinds});
}

RecordedVaryings Test::record_varyings(const gl::Case& written, const VaryingShader& shader,
                                       std::size_t most_vertices) {
  const gl::Case script = begin_case(written).script;
  return evalcts::record_varyings(*subject_.implementation, shader, script, kPoints, most_vertices);
}

// How the capture shows the primitives that the case draws; asked once, since it is always the same.
Topology Test::topology_of(const Prediction& prediction, const Capture& capture) const {
  constexpr std::size_t kMostKnown = 1000;
  const PrimitiveKinds kinds = kinds_of(prediction);
  if (kinds == kPoints) return Topology::points(prediction.vertex_count());
  Shape drawn;
  for (const reference::Primitive& primitive : prediction.primitives)
    drawn.emplace_back(primitive.mode, primitive.vertices.size());
  const std::pair key(capture.name(), drawn);
  const auto known = subject_.topologies->find(key);
  if (known != subject_.topologies->end()) return known->second;

  const Attributes numbered = capture.attributes() & (kPosition | kTextureCoordinate0);
  const Observation control = capture.observe(*subject_.implementation, explicit_primitives(prediction),
                                              {numbered, most_vertices_of(prediction), kinds});
  std::optional<Topology> topology = read_topology(prediction, control);
  if (!topology || control.error != GL_NO_ERROR)
    throw NotObservable(fmt::format(
        "pipeline: {} does not show these primitives with explicit vertices, either", capture.name()));
  if (subject_.topologies->size() < kMostKnown) subject_.topologies->emplace(key, *topology);
  return *std::move(topology);
}

// A failure of this case will put the lists in doubt that it goes through, if any.
void Test::note_lists(const gl::Case& script, const Capture& capture, Attributes judged) {
  // In a reproduction they are beyond doubt, and the control is not the case.
  if (!uses_lists(script) || subject_.reproduction) return;
  // Where vertices are astray nothing else of them is right.
  lists_in_doubt_ = {script, &capture, (judged | kPosition) & all_shown(capture)};
}

// Where a case through display lists fails, the same with explicit vertices has to be right: otherwise the
// lists are to blame, not the evaluators. Throws NotObservable.
void Test::require_lists_of_vertices(const Listed& listed) const {
  const gl::Case control = gl::with_explicit_vertices(listed.script);
  const Prediction prediction = predict(control, max_order());
  const PrimitiveKinds kinds = kinds_of(prediction);
  if (!listed.capture->takes(kinds)) return;
  const Topology topology = topology_of(prediction, *listed.capture);
  const Observation seen = listed.capture->observe(*subject_.implementation, control,
                                                   {listed.judged, most_vertices_of(prediction) + 8, kinds});
  const JudgeOptions options{.attributes = listed.judged, .version = 10 * gl().major + gl().minor};
  const std::vector<Mismatch> mismatches = judge(prediction, topology, seen, options).mismatches;
  if (!mismatches.empty())
    throw NotObservable("pipeline: in display lists explicit vertices go wrong, too: " +
                        mismatches.front().message);
}

void Test::expect_emission(const gl::Case& written, Attributes required) {
  const gl::Case script = begin_case(written).script;
  judge_emission(script, predict(script, max_order()), required, true);
}

void Test::expect_emission(const gl::Case& script, const Prediction& prediction, Attributes required,
                           bool measured) {
  if (delivery_) throw std::logic_error("a prediction is of the case as it is delivered");
  begin_case(script);
  judge_emission(script, prediction, required, measured);
}

void Test::judge_emission(const gl::Case& script, const Prediction& prediction, Attributes required,
                          bool measured) {
  const PrimitiveKinds kinds = kinds_of(prediction);
  // Some room beyond what is right, so that the message can say how many came.
  const std::size_t room = most_vertices_of(prediction) + 8;

  const auto options_for = [&](const Capture& capture) {
    return JudgeOptions{.level = record_.level,
                        .measured = measured ? required : 0,
                        .lengths_of_shader_normals = (required & kShaderNormal) != 0,
                        .vectors_as_a_whole = capture.loses_vertices_beyond_float(),
                        .version = 10 * gl().major + gl().minor,
                        .where = script.identity()};
  };
  struct Look {
    const Capture* capture;
    Topology topology;
    Observation observation;
  };
  std::vector<Look> looks;
  const std::size_t most = cross_checked(prediction) ? subject_.captures->size() : 1;
  for (const Capture* capture : captures_showing(required, kinds, prediction.has_nonpositive_w(), most)) {
    // The first shows all it can; the others cross-check what the test is about.
    const Attributes wanted = looks.empty() ? all_shown(*capture) : capture->shown_of(required);
    Topology topology = topology_of(prediction, *capture);
    // The explicit primitives are not the case.
    if (looks.empty() && subject_.reproduction) subject_.reproduction->begin_case();
    Observation observation = capture->observe(*subject_.implementation, script, {wanted, room, kinds});
    if (std::optional<Topology> quads = match_quads(prediction, observation)) topology = *std::move(quads);
    if (!judges_order_of_meshes_)
      topology =
          with_meshes_in_own_order(prediction, std::move(topology), observation, options_for(*capture));
    looks.push_back({capture, std::move(topology), std::move(observation)});
    note_capture(*capture);
  }
  for (std::size_t i = 1; i < looks.size(); ++i) {
    Observation other = looks[i].observation;
    // A vertex shader changes automatic normals (EV-AUTON-SHADER).
    if (prediction.has_automatic_normals() &&
        (other.attributes & kShaderNormal) != (looks[0].observation.attributes & kShaderNormal))
      other.attributes &= ~static_cast<Attributes>(kNormal);
    const std::string differs =
        disagreement({looks[0].observation, looks[0].topology}, {other, looks[i].topology});
    if (!differs.empty())
      throw NotObservable(fmt::format("untrusted: {} and {} disagree in case {}: {}",
                                      looks[0].capture->name(), looks[i].capture->name(), script.identity(),
                                      differs));
  }

  const auto& [capture, topology, observation] = looks.front();  // the others agree with it
  const JudgeOptions options = options_for(*capture);
  const auto judged = [&, &topology = topology](const Observation& seen) {
    Judgement judgement = judge(prediction, topology, seen, options);
    if (seen.error_observed && seen.error != prediction.error)
      judgement.mismatches.insert(judgement.mismatches.begin(), wrong_error(seen.error, prediction.error));
    return judgement;
  };
  const Judgement judgement = judged(observation);
  if (capture->loses_vertices_beyond_float() && prediction.has_positions_beyond_float())
    for (const Mismatch& mismatch : judgement.mismatches)
      if (mismatch.of == Mismatch::Of::vertices)
        throw NotObservable(fmt::format("{} loses vertices whose position is beyond float: {}",
                                        capture->name(), mismatch.message));
  unobserved_ |= required & kAllAttributes & ~capture->shown_of(required);
  note_lists(script, *capture, all_shown(*capture));
  fail_each(script, *capture, {all_shown(*capture), room, kinds}, observation,
            [&](const Observation& seen) { return judged(seen).mismatches; });
  if (judgement.accuracy.values + judgement.accuracy.not_judged > 0) {
    if (!record_.accuracy) record_.accuracy.emplace();
    record_.accuracy->add(judgement.accuracy);
  }
}

void Test::expect_observation(const gl::Case& written, Attributes required, std::size_t most_vertices,
                              PrimitiveKinds kinds, const OwnJudge& judge, Judged judged) {
  const gl::Case script = begin_case(written).script;
  const Capture& capture = capture_for(required, kinds);
  note_capture(capture);
  if (judged == Judged::in_lists) note_lists(script, capture, required);
  const Wanted wanted{required, most_vertices, kinds};
  fail_each(script, capture, wanted, capture.observe(*subject_.implementation, script, wanted), judge);
}

void Test::fail_each(const gl::Case& script, const Capture& capture, const Wanted& wanted,
                     const Observation& seen, const OwnJudge& judge) {
  const std::vector<Mismatch> mismatches = judge(seen);
  for (const Mismatch& mismatch : mismatches) {
    Failure failure;
    failure.case_identity = script.identity();
    failure.message = mismatch.message;
    failure.what = mismatch.what;
    failure.expected = mismatch.expected;
    failure.captured = mismatch.captured;
    failure.exact = mismatch.exact;
    if (!mismatch.exact.empty()) {
      failure.ulp = mismatch.ulp;
      failure.condition_aware = mismatch.condition_aware;
    }
    failure.capture = capture.name();
    std::optional<gl::Check> check;
    if (subject_.reproduction) {
      // Whether another run of the same capture leads to the same mismatch, as often (a vertex may come out
      // several times).
      const auto times = [&](const std::vector<Mismatch>& all) {
        return std::count_if(all.begin(), all.end(), [&](const Mismatch& other) {
          return other.what == mismatch.what && other.captured == mismatch.captured;
        });
      };
      check = subject_.reproduction->check_of(mismatch, [&](Implementation& implementation) {
        return times(judge(capture.observe(implementation, script, wanted))) == times(mismatches);
      });
    }
    fail(std::move(failure), all_calls(script), check);
  }
}

void Test::follows(const std::string& text, const std::string& reading) {
  record_.readings[text] = reading;
  const auto asked = subject_.readings.find(text);
  if (asked == subject_.readings.end() || asked->second == reading) return;
  Failure failure;
  failure.what = text;
  failure.expected = asked->second;
  failure.captured = reading;
  failure.message = fmt::format("{} is read as '{}', '{}' was asked for", text, reading, asked->second);
  fail(std::move(failure));
}

void Test::fail(Failure failure, const std::function<std::vector<std::string>()>& calls,
                const std::optional<gl::Check>& check) {
  if (lists_in_doubt_) require_lists_of_vertices(*std::exchange(lists_in_doubt_, std::nullopt));
  if (subject_.reproduction) subject_.reproduction->failed(failure, check);
  record_.mismatches.push_back(failure.case_identity + ": " + failure.what);
  if (last_failed_case_ != cases_) ++failed_cases_;
  last_failed_case_ = cases_;
  if (record_.failures.size() >= kFailuresInFull) return;
  if (calls) failure.calls = calls();
  record_.failures.push_back(std::move(failure));
}

void Test::run(const std::function<void(Test&)>& body) {
  record_.seed = subject_.seed;
  random_.seed(subject_.seed * 2654435761u ^ fnv1a<std::uint32_t>(record_.name));
  std::string why;
  Verdict otherwise = Verdict::kPass;
  try {
    body(*this);
  } catch (const NotSupported& exception) {
    otherwise = Verdict::kNotSupported;
    why = exception.what();
  } catch (const NotObservable& exception) {
    otherwise = Verdict::kNotObservable;
    why = exception.what();
  } catch (const gl::MissingEntryPoint& exception) {
    otherwise = gl().declaration ? Verdict::kNotSupported : Verdict::kNotObservable;
    why = exception.what();
  } catch (const std::exception& exception) {
    otherwise = Verdict::kInternalError;
    why = exception.what();
  }
  if (otherwise == Verdict::kInternalError || record_.mismatches.empty()) {
    record_.verdict = otherwise;
    record_.message = why;
  } else {
    record_.verdict = record_.level == Level::quality ? Verdict::kQualityWarning : Verdict::kFail;
    record_.message = record_.failures.front().message;
  }
  if (record_.verdict == Verdict::kPass && cases_ == 0) {
    record_.verdict = Verdict::kInternalError;
    record_.message = "the test played no case";
  }
  if (record_.verdict == Verdict::kPass && delivery_ && delivery_->lists != gl::Lists::none && !lists_used_) {
    record_.verdict = Verdict::kInternalError;
    record_.message = "no case of the test has a command that goes into a display list";
  }
  std::sort(record_.mismatches.begin(), record_.mismatches.end());
  if (unobserved_) record_.unobserved = describe(unobserved_);
  record_.cases = cases_;
  record_.failed_cases = failed_cases_;
}

}  // namespace evalcts
