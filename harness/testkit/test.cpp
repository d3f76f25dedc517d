// Implements Test: delivers cases, observes them through captures, judges them, and turns mismatches into
// failures and a verdict.
#include <evalcts/testkit/test.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <future>
#include <utility>
#ifndef _WIN32
#include <malloc.h>
#include <unistd.h>
#endif

#include <evalcts/gl/call_in_flight.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/results/hash.h>
#include <evalcts/testkit/reproduction.h>
#include "blame.h"
#include "plot.h"
#include "schedule.h"

namespace evalcts {
namespace {

constexpr std::size_t kFailuresInFull = 8;  // and the first one of each further kind and place of differences
constexpr std::size_t kMostJudged = 64;     // mismatches, behind which kFirstMismatches judges no vertices
// The accuracy of cases with more vertices is not recorded, because this takes longer than judging.
constexpr std::size_t kMostMeasured = 2000;

// Runs a function that creates or moves contexts. Throws NotObservable if the library rejects this.
void run_with_contexts(const std::function<void()>& function) {
  try {
    function();
  } catch (const CannotStart& error) {
    throw NotObservable(std::string("pipeline: a thread has no context: ") + error.what());
  }
}

Mismatch wrong_error(GLenum got, GLenum expected) {
  Mismatch mismatch;
  mismatch.what = "glGetError";
  mismatch.expected = gl::error_name(expected);
  mismatch.captured = gl::error_name(got);
  mismatch.message =
      fmt::format("the commands leave {} behind, expected {}", mismatch.captured, mismatch.expected);
  mismatch.kind = Mismatch::Kind::kError;
  mismatch.got = got;
  mismatch.lowest = mismatch.highest = expected;
  return mismatch;
}

// Returns the kind of observation of a vertex, by which the table of blame tells requirements apart.
std::optional<Observed> observed_in(const Mismatch& mismatch) {
  using Source = Mismatch::Source;
  switch (mismatch.source) {
    case Source::kCurrentOfEvaluatedVertex:
      return Observed::kEvaluatedVertex;
    case Source::kCurrentOfExplicitVertex:
      return Observed::kExplicitVertex;
    case Source::kAutomaticNormal:
      return Observed::kAutomaticNormal;
    case Source::kRationalNormal:
      return Observed::kRationalNormal;
    case Source::kMap:
    case Source::kExplicitPosition:
      break;
  }
  return std::nullopt;
}

}  // namespace

// Counts the case and returns it after delivery. Throws NotObservable or NotSupported if the case cannot be
// judged on this implementation.
gl::DeliveredCase Test::begin_case(const gl::Case& script) {
  ++cases_;
  control_.clear();
  is_order_wrong_ = false;
  if (subject_.reproduction) subject_.reproduction->begin_case(script);
  gl::DeliveredCase delivered = delivery_.apply(script);
  probes_.add(delivered.script);
  const auto has_high_order = [&](const gl::Command& command) {
    return gl::largest_order(command) > max_order();
  };
  if (gl().max_eval_order == 0 && std::ranges::any_of(delivered.script.commands(), has_high_order))
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

CheckedTrace Test::play(const gl::Case& written) { return play(begin_case(written)); }

CheckedTrace Test::play(const gl::DeliveredCase& delivered) {
  const gl::Case& script = delivered.script;
  const std::unique_ptr<Context> context = subject_.implementation->create_context();
  const gl::Trace trace = context->play(script);
  const std::vector<GLenum>& left_over = trace.left_over_errors();
  CheckedTrace checked(*this, delivered, trace);
  if (!left_over.empty()) {
    std::vector<std::string> names;
    for (const GLenum error : left_over) names.push_back(gl::error_name(error));
    const std::string captured = fmt::format("{}", fmt::join(names, ", "));
    if (script.is_control())
      throw NotObservable(fmt::format("pipeline: '{}' leaves {} behind", script.identity(), captured));
    if (const std::optional<GLenum> error = control_.error_without_evaluators(script, left_over))
      throw NotObservable(
          fmt::format("pipeline: explicit commands instead of evaluations leave {} behind as well",
                      gl::error_name(*error)));
    Failure failure;
    failure.case_identity = script.identity();
    failure.message = "spurious error: left behind after the last command: " + captured;
    failure.what = "glGetError";
    failure.difference = {Difference::kError, "", relation_of_errors(names.front(), "GL_NO_ERROR")};
    failure.expected = "GL_NO_ERROR";
    failure.captured = captured;
    const gl::Check check{.answer = {.kind = gl::Answer::Kind::kLeftOver, .is_error = true},
                          .accepted = {{GL_NO_ERROR, GL_NO_ERROR}},
                          .what = "an error left behind"};
    fail(
        std::move(failure), [&] { return gl::all_calls(script); }, check);
  }
  return checked;
}

const Capture& Test::choose_capture(const gl::Case& script, Attributes required, PrimitiveKinds kinds) {
  const Capture* capture = &subject_.captures->showing_all(required, kinds, false);
  if (capture->loses_nonpositive_w() && predict(script, max_order()).has_nonpositive_w())
    capture = &subject_.captures->showing_all(required, kinds, true);
  note_capture(*capture);
  return *capture;
}

void Test::note_capture(const Capture& capture) {
  if (record_.capture.empty()) record_.capture = capture.name();
}

Attributes Test::shown_exactly(Attributes required, PrimitiveKinds kinds) {
  const Attributes shown = subject_.captures->shown_exactly(required, kinds);
  unobserved_ |= required & ~shown;
  return shown;
}

Observation Test::observe(const gl::Case& written, Attributes required, std::size_t most_vertices,
                          PrimitiveKinds kinds) {
  const gl::Case script = begin_case(written).script;
  const Capture& capture = choose_capture(script, required, kinds);
  control_.set_observed(script, capture, required);
  return capture.observe(*subject_.implementation, script, {required, most_vertices, kinds});
}

RecordedVaryings Test::record_varyings(const gl::Case& written, const VaryingShader& shader,
                                       std::size_t most_vertices) {
  const gl::Case script = begin_case(written).script;
  return evalcts::record_varyings(*subject_.implementation, shader, script, kPoints, most_vertices);
}

double Test::kept_memory(const gl::Case& written, bool in_new_contexts) {
  const gl::Case script = begin_case(written).script;
  // The memory that malloc has given out, which may have been resident before, and the resident memory.
  const auto used = []() -> std::array<double, 2> {
#ifdef _WIN32
    throw NotObservable("memory is measured on Linux only");
#else
    std::ifstream file("/proc/self/statm");
    double size = 0, pages = 0;
    if (!(file >> size >> pages)) throw NotObservable("/proc/self/statm does not show the resident memory");
    const struct mallinfo2 info = mallinfo2();
    return {static_cast<double>(info.uordblks + info.hblkhd),
            pages * static_cast<double>(sysconf(_SC_PAGESIZE))};
#endif
  };
  constexpr int kTimes = 8, kRounds = 5;
  std::unique_ptr<Context> context;
  std::array<double, 2> before = {};
  std::array<std::vector<double>, 2> growth;
  for (int round = 0; round <= kRounds; ++round) {  // the first one fills caches
    for (int i = 0; i < kTimes; ++i) {
      if (!context || in_new_contexts) {
        context.reset();
        context = subject_.implementation->create_context();
      }
      context->play(script);
    }
    const std::array<double, 2> now = used();
    for (std::size_t k = 0; k < now.size() && round > 0; ++k) growth[k].push_back(now[k] - before[k]);
    before = now;
  }
  for (std::vector<double>& rounds : growth) std::ranges::sort(rounds);
  return std::max(growth[0][kRounds / 2], growth[1][kRounds / 2]) / kTimes;
}

void Test::require_threads() {
  prefer_fresh_contexts();
  control_.leave_warm_context();
  if (subject_.reproduction) throw NotObservable("a C program has one thread");
  if (!subject_.implementation->create_context()->table().MoveToThreadEVALCTS)
    throw gl::MissingEntryPoint(gl::EntryPoint::MoveToThreadEVALCTS);
}

void Test::run_in_thread(const std::function<void()>& body) {
  require_threads();
  subject_.captures->prove_all();  // a capture that works in this thread only must be proved here
  std::async(std::launch::async, [&] { run_with_contexts(body); }).get();
}

void Test::run_beside(const gl::Case& other, const std::function<void()>& body) {
  require_threads();
  const std::unique_ptr<Context> context = subject_.implementation->create_context();
  run_with_contexts([&] { context->release(); });
  std::atomic<bool> has_begun = false, is_over = false;
  const auto begin = [&] {
    has_begun = true;
    has_begun.notify_one();
  };
  std::future<void> beside = std::async(std::launch::async, [&] {
    try {
      run_with_contexts([&] { context->make_current(); });
      for (; !is_over; begin()) {
        context->play(other);
        context->take_emitted();  // limits memory
      }
      context->release();
    } catch (...) {
      begin();
      throw;
    }
  });
  has_begun.wait(false);
  try {
    body();
  } catch (...) {
    is_over = true;  // the future waits for its thread
    throw;
  }
  is_over = true;
  beside.get();
}

void Test::judge_vertices(const gl::Case& written, Attributes about) {
  const gl::Case script = begin_case(written).script;
  judge_emission(script, predict(script, max_order()), about, Thoroughness::kAllVertices);
}

JudgeOptions Test::options_for(const gl::Case& script, const Capture& capture, Attributes required) const {
  return {.level = record_.level,
          .measured = 0,
          .lengths_of_shader_normals = (required & kShaderNormal) != 0,
          .vectors_as_a_whole = capture.loses_vertices_beyond_float(),
          .version = gl().version_number(),
          .where = script.identity()};
}

// Observes the case through one capture, or through several captures that must agree. Throws NotObservable.
std::vector<Test::CapturedObservation> Test::observe_by_captures(const gl::Case& script,
                                                                 const Prediction& prediction,
                                                                 Attributes required,
                                                                 std::size_t most_vertices) {
  const PrimitiveKinds kinds = kinds_of(prediction);
  const bool cross_checked =
      Schedule(record_.name).is_cross_checked(subject_.depth, prediction.primitives.size());
  std::vector<CapturedObservation> observations;
  for (const Capture* capture : subject_.captures->showing_most(
           required, kinds, prediction.has_nonpositive_w(), cross_checked ? subject_.captures->size() : 1)) {
    // The first capture shows all attributes that it can; the others check the required attributes.
    const Attributes wanted = observations.empty() ? capture->shown() : capture->shown_of(required);
    Topology topology = subject_.topologies->find(prediction, *capture, *subject_.implementation);
    // The explicit primitives, from which the topology was learned, are not part of the case.
    if (observations.empty() && subject_.reproduction) subject_.reproduction->begin_case(script);
    Observation observation =
        capture->observe(*subject_.implementation, script, {wanted, most_vertices, kinds});
    if (!judges_order_of_meshes_) take_triangles_of_meshes_for_quads(prediction, topology, observation);
    if (std::optional<Topology> quads = match_quads(prediction, observation)) topology = *std::move(quads);
    if (!judges_order_of_meshes_)
      topology = with_meshes_in_own_order(prediction, std::move(topology), observation,
                                          options_for(script, *capture, required));
    observations.push_back({capture, std::move(topology), std::move(observation)});
    note_capture(*capture);
  }
  const CapturedObservation& first = observations.front();
  for (std::size_t i = 1; i < observations.size(); ++i) {
    Observation other = observations[i].observation;
    // Automatic normals differ between captures with and without a vertex shader (EV-AUTON-SHADER).
    if (prediction.has_automatic_normals() &&
        (other.attributes & kShaderNormal) != (first.observation.attributes & kShaderNormal))
      other.attributes &= ~static_cast<Attributes>(kNormal);
    const std::string differs =
        disagreement({first.observation, first.topology}, {other, observations[i].topology});
    if (!differs.empty())
      throw NotObservable(fmt::format("untrusted: {} and {} disagree in case {}: {}", first.capture->name(),
                                      observations[i].capture->name(), script.identity(), differs));
  }
  return observations;
}

void Test::judge_emission(const gl::Case& script, const Prediction& prediction, Attributes required,
                          Thoroughness thoroughness, Attributes judged_attributes) {
  if (prediction.error != GL_NO_ERROR && !gl().has(gl::EntryPoint::GetError))
    throw NotSupported("glGetError is missing, without which rejected commands are not judged");
  // There is room for some surplus vertices, so that a message can state their number.
  const std::size_t room = most_vertices_of(prediction) + 8;
  const std::vector<CapturedObservation> observations =
      observe_by_captures(script, prediction, required, room);
  const auto& [capture, topology, observation] = observations.front();  // the other captures agree
  const bool has_surplus_error =
      observation.error_observed && observation.error != GL_NO_ERROR && observation.error != prediction.error;
  const bool judges_errors =
      !has_surplus_error || !control_.error_without_evaluators(script, {observation.error});
  JudgeOptions options = options_for(script, *capture, required);
  options.attributes = judged_attributes;
  if (thoroughness == Thoroughness::kFirstMismatches)
    options.most = kMostJudged;
  else if (prediction.vertex_count() <= kMostMeasured)
    options.measured = required;
  if (!judges_errors) missing_.insert("errors (explicit commands raise them as well)");
  const auto judged = [&, &topology = topology](const Observation& seen) {
    Judgement judgement = evalcts::judge(prediction, topology, seen, options);
    if (judges_errors && seen.error_observed && seen.error != prediction.error)
      judgement.mismatches.insert(judgement.mismatches.begin(), wrong_error(seen.error, prediction.error));
    return judgement;
  };
  Judgement judgement = judged(observation);
  if (capture->is_last_resort() && !subject_.reproduction && !judgement.mismatches.empty()) {
    // The vertices in the capture's own proof set every attribute, so attributes may still be lost
    // in this case.
    const Attributes lost = control_.lost_attributes(script, *capture);
    if (!(required & kAllAttributes & ~lost))
      throw NotObservable(fmt::format("pipeline: wrong with explicit vertices as well: {}", describe(lost)));
    options.attributes &= ~lost;
    unobserved_ |= required & lost;
    judgement = judged(observation);
  }
  if (capture->loses_vertices_beyond_float())
    for (const Mismatch& mismatch : judgement.mismatches)
      if (mismatch.kind == Mismatch::Kind::kVertices && prediction.has_positions_beyond_float())
        throw NotObservable(fmt::format("{} loses vertices whose position is beyond float: {}",
                                        capture->name(), mismatch.message));
  unobserved_ |= required & kAllAttributes & ~capture->shown_of(required);
  is_order_wrong_ =
      judges_order_of_meshes_ && !judgement.mismatches.empty() &&
      evalcts::judge(prediction, with_meshes_in_own_order(prediction, topology, observation, options),
                     observation, options)
          .mismatches.empty();
  control_.set_observed(script, *capture, capture->shown());
  fail_each(
      script, *capture, {capture->shown(), room, kinds_of(prediction)}, observation, judgement.mismatches,
      [&](const Observation& seen) { return judged(seen).mismatches; }, &prediction, required);
  if (judgement.accuracy.values + judgement.accuracy.not_judged > 0) {
    if (!record_.accuracy) record_.accuracy.emplace();
    record_.accuracy->add(judgement.accuracy);
  }
}

void Test::expect_observation(const gl::Case& written, Attributes required, std::size_t most_vertices,
                              PrimitiveKinds kinds, const OwnJudge& judge,
                              const ExplicitControl::Judge& of_controls) {
  const gl::Case script = begin_case(written).script;
  const Capture& capture = choose_capture(script, required, kinds);
  control_.set_observed(script, capture, required, of_controls);
  const CaptureRequest request{required, most_vertices, kinds};
  const Observation seen = capture.observe(*subject_.implementation, script, request);
  fail_each(script, capture, request, seen, judge(seen), judge);
}

void Test::fail_each(const gl::Case& script, const Capture& capture, const CaptureRequest& request,
                     const Observation& seen, const std::vector<Mismatch>& mismatches, const OwnJudge& judge,
                     const Prediction* prediction, Attributes required) {
  if (!mismatches.empty() && !subject_.is_warm)
    control_.run_controls([&](Implementation& implementation) {
      std::set<std::string> wrong;
      for (const Mismatch& mismatch : judge(capture.observe(implementation, script, request)))
        wrong.insert(mismatch.what);
      return std::ranges::all_of(mismatches, [&](const Mismatch& one) { return wrong.contains(one.what); });
    });
  // If the controls lose a part of what the test is about, the rest is judged.
  const Attributes lost = control_.lost_in_controls();
  const bool judges_rest = (required & kAllAttributes & ~lost) != 0;
  for (const Mismatch& mismatch : mismatches) {
    if (judges_rest && (attribute_of(mismatch) & lost)) {
      unobserved_ |= attribute_of(mismatch) & lost;
      continue;
    }
    Failure failure;
    failure.case_identity = script.identity();
    failure.message = mismatch.message;
    failure.what = mismatch.what;
    failure.difference = difference_of(mismatch);
    failure.expected = mismatch.expected;
    failure.captured = mismatch.captured;
    failure.exact = mismatch.exact;
    if (!mismatch.exact.empty()) {
      failure.ulp = mismatch.ulp;
      failure.condition_aware = mismatch.condition_aware;
    }
    failure.capture = capture.name();
    const bool is_seen_in_plot =
        !prediction || mismatch.kind == Mismatch::Kind::kVertices || mismatch.what.starts_with("position");
    if (is_seen_in_plot && (seen.attributes & kPosition) && !has_plot())
      failure.plot = prediction ? plot_of(*prediction, seen) : plot_of(seen);
    std::optional<gl::Check> check;
    if (subject_.reproduction && !subject_.reproduction->is_complete())
      check = check_of(mismatch, mismatches, script, capture, request, judge);
    fail(
        std::move(failure), [&] { return gl::all_calls(script); }, check, observed_in(mismatch));
  }
}

// Returns the check for the C program, which observes only what shows the mismatch, if that shows it.
std::optional<gl::Check> Test::check_of(const Mismatch& mismatch, const std::vector<Mismatch>& all,
                                        const gl::Case& script, const Capture& capture,
                                        const CaptureRequest& request, const OwnJudge& judge) {
  const auto rejudge = [&](const CaptureRequest& requested) {
    return [&, requested](Implementation& implementation) {
      return judge(capture.observe(implementation, script, requested));
    };
  };
  // The captured value differs from run to run if the implementation reads memory that it has not written.
  const auto find_in = [&](const std::vector<Mismatch>& mismatches) {
    const auto same = std::ranges::find_if(mismatches, [&](const Mismatch& other) {
      return other.what == mismatch.what && other.captured == mismatch.captured;
    });
    return same != mismatches.end() ? same : std::ranges::find(mismatches, mismatch.what, &Mismatch::what);
  };
  CaptureRequest least = request;
  const Attributes wrong = attribute_of(mismatch);
  least.attributes &= wrong ? wrong : Attributes{kPosition};
  least.nothing_more = true;
  for (const CaptureRequest& requested : {least, request}) {
    if (requested.attributes == 0) continue;
    subject_.reproduction->begin_case(script);
    std::vector<Mismatch> again;
    try {
      again = rejudge(requested)(*subject_.implementation);
    } catch (const NotObservable&) {
      // The judge of a test may need more than this request shows.
    }
    const auto found = find_in(again);
    if (found == again.end()) continue;
    return subject_.reproduction->check_of(*found, again, rejudge(requested));
  }
  return subject_.reproduction->check_of(mismatch, all, rejudge(request));
}

Difference Test::difference_of(const Mismatch& mismatch) const {
  if (mismatch.kind == Mismatch::Kind::kError)
    return {Difference::kError, "", relation_of_errors(mismatch.captured, mismatch.expected)};
  if (is_order_wrong_ && mismatch.kind == Mismatch::Kind::kValue) return {Difference::kOrder, "", ""};
  return mismatch.difference();
}

bool Test::has_plot() const {
  return std::ranges::any_of(record_.failures, [](const Failure& other) { return other.plot.has_value(); });
}

RequirementId Test::requirement(const std::string& id) const {
  const auto found = std::ranges::find(record_.requirements, id, &RequirementId::id);
  if (found == record_.requirements.end()) throw std::logic_error(record_.name + " does not decide " + id);
  return *found;
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
                const std::optional<gl::Check>& check, std::optional<Observed> observed) {
  if (subject_.is_warm) throw FreshContextsDecide("fresh contexts decide: " + failure.message);
  control_.require_explicit_vertices(failure.what);
  if (!subject_.reproduction) probes_.require(subject_, failure.what == "glGetError");
  std::vector<RequirementId> violated = decided_;
  if (violated.empty() && observed) violated = violated_by(*observed, record_.requirements);
  if (violated.empty() || violated == record_.requirements)
    violates_all_ = true;
  else
    for (const RequirementId& id : violated) violate(id);
  if (subject_.reproduction) subject_.reproduction->failed(failure, check);
  record_.mismatches.push_back(failure.case_identity + ": " + failure.what);
  if (last_failed_case_ != cases_) ++failed_cases_;
  last_failed_case_ = cases_;
  const auto is_like_this = [&](const Failure& kept) {
    return kept.difference.kind == failure.difference.kind &&
           kept.difference.place == failure.difference.place;
  };
  if (record_.failures.size() >= kFailuresInFull && std::ranges::any_of(record_.failures, is_like_this))
    return;
  if (calls) failure.calls = calls();
  record_.failures.push_back(std::move(failure));
}

void Test::violate(const RequirementId& id) {
  if (std::ranges::count(record_.violated, id) == 0) record_.violated.push_back(id);
}

void Test::blame_list_or_commands(const std::function<void(Test&)>& body) {
  const RequirementId of_list = record_.requirements.back();
  const auto outcome_in = [&](gl::Lists lists) {
    TestRecord other;
    other.name = record_.name;
    other.level = record_.level;
    other.requirements = record_.requirements;
    other.requirements.pop_back();
    Subject subject = subject_;
    subject.before_case = nullptr;
    subject.depth = depth();  // the same cases, though the delivery is another one
    Test test(subject, other);
    test.other_lists_ = lists;
    test.run(body);
    return other;
  };
  const TestRecord direct = outcome_in(gl::Lists::kNone);
  if (direct.verdict == Verdict::kFail) {
    record_.violated = direct.blamed();
    return;
  }
  if (direct.verdict != Verdict::kPass) return;
  if (delivery_.lists != gl::Lists::kCompiled && outcome_in(gl::Lists::kCompiled).verdict == Verdict::kPass) {
    record_.violated = {of_list};
    return;
  }
  const bool all_errors = std::ranges::all_of(
      record_.failures, [](const Failure& failure) { return failure.what == "glGetError"; });
  record_.violated = {all_errors ? "EV-DL-ERR-ALL" : "EV-DL-EXECUTE"};
}

// Returns the verdict if no case fails, and the reason for it.
Test::VerdictAndReason Test::end_of(const std::function<void(Test&)>& body) {
  try {
    body(*this);
    return {Verdict::kPass, ""};
  } catch (const NotSupported& exception) {
    return {Verdict::kNotSupported, exception.what()};
  } catch (const NotObservable& exception) {
    return {Verdict::kNotObservable, exception.what()};
  } catch (const FreshContextsDecide& exception) {
    return {Verdict::kNotObservable, exception.what()};
  } catch (const gl::MissingEntryPoint& exception) {
    return {gl().declaration ? Verdict::kNotSupported : Verdict::kNotObservable, exception.what()};
  } catch (const std::exception& exception) {
    return {Verdict::kInternalError, exception.what()};
  }
}

// Returns the mistake of a test that passes without judging what it claims to; empty if there is none.
std::string Test::mistake() const {
  if (cases_ == 0) return "the test ran no case";
  if (is_delivered_in_lists() && !probes_.uses_lists())
    return "no case of the test has a command that goes into a display list";
  return {};
}

void Test::run(const std::function<void(Test&)>& body) {
  record_.seed = subject_.seed;
  random_.seed(subject_.seed * 2654435761u ^ fnv1a<std::uint32_t>(record_.name));
  // Runs and judges. Controls end the test by exceptions.
  const VerdictAndReason ending = end_of(body);
  const bool fails = ending.verdict != Verdict::kInternalError && !record_.mismatches.empty();
  record_.verdict = !fails                             ? ending.verdict
                    : record_.level == Level::kQuality ? Verdict::kQualityWarning
                                                       : Verdict::kFail;
  record_.message = fails ? record_.failures.front().message : ending.why;
  if (fails) {
    // An empty list stands for all requirements, so they are listed only if other failures violate single
    // ones.
    if (violates_all_ && !record_.violated.empty())
      for (const RequirementId& id : record_.requirements) violate(id);
    if (record_.verdict == Verdict::kFail && is_delivered_in_lists() && !other_lists_ &&
        !subject_.reproduction)
      blame_list_or_commands(body);
  }
  std::vector<std::string> unobserved;
  if (unobserved_) unobserved.push_back(describe(unobserved_));
  unobserved.insert(unobserved.end(), missing_.begin(), missing_.end());
  record_.unobserved = fmt::format("{}", fmt::join(unobserved, ", "));
  if (record_.verdict == Verdict::kPass && !mistake().empty()) {
    const bool none_can_run = cases_ == 0 && !missing_.empty();
    record_.verdict = none_can_run ? Verdict::kNotObservable : Verdict::kInternalError;
    record_.message = none_can_run ? record_.unobserved : mistake();
  }
  record_.shorten_mismatches();
  record_.cases = cases_;
  record_.failed_cases = failed_cases_;
}

}  // namespace evalcts
