// Implements Session: opens the implementation and its captures, and runs tests in warm and fresh contexts.
#include "session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <utility>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/backends/mesa_build.h>
#include <evalcts/backends/rejected_queries.h>
#include <evalcts/fuzz/finding.h>
#include <evalcts/gl/call_in_flight.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/roles.h>
#include <evalcts/results/hash.h>
#include "surroundings.h"

namespace evalcts {
namespace {

// Returns a warning if another driver than requested was loaded; otherwise an empty string. Sinks and
// built-in implementations have no driver, and a layer hides the renderer below it.
std::string note_on_driver(const ImplementationInfo& info, const ImplementationOptions& options) {
  const bool is_layer = !options.context.empty() && !options.library.empty();
  if (is_layer || info.name == "sink" || info.name == "production" || info.name == "reference") return {};
  return describe_other_driver(info.renderer);
}

// Returns the queries of grids that raise an error. Their own tests fail; other tests leave these queries out
// when they query all state, because the error would be taken for that of another command.
std::set<std::string> rejected_grid_queries(Implementation& implementation) {
  std::set<std::string> calls;
  for (const auto& [get, name] : find_rejected_queries(implementation, kGridQueries))
    calls.insert(gl::call_text({get, {std::int64_t{name}, gl::Output()}}));
  return calls;
}

constexpr float kSpecial = 1e30f;

template <class T>
bool has_special(const gl::Input& array) {
  for (std::size_t at = 0; at + sizeof(T) <= array.bytes.size(); at += sizeof(T)) {
    T value;
    std::memcpy(&value, &array.bytes[at], sizeof value);
    if (!(std::abs(value) < kSpecial)) return true;
  }
  return false;
}

// Returns true if an argument is not finite or so large that results may overflow.
bool has_specials(const gl::Case& script) {
  const auto is_special = [](const gl::Value& value) {
    if (const auto* single = std::get_if<float>(&value)) return !(std::abs(*single) < kSpecial);
    if (const auto* real = std::get_if<double>(&value)) return !(std::abs(*real) < kSpecial);
    const auto* const array = std::get_if<gl::Input>(&value);
    return array && ((array->type == gl::Scalar::kF32 && has_special<float>(*array)) ||
                     (array->type == gl::Scalar::kF64 && has_special<double>(*array)));
  };
  return std::ranges::any_of(script.commands(), [&](const gl::Command& command) {
    return std::ranges::any_of(command.arguments, is_special);
  });
}

gl::Case explicit_specials() {
  gl::Case c(gl::control("explicit vertices that are not finite"));
  constexpr float kMost = std::numeric_limits<float>::max();
  for (const GLenum mode : {GL_POINTS, GL_LINE_STRIP, GL_QUAD_STRIP})
    for (const float special : {std::nanf(""), HUGE_VALF, -HUGE_VALF, kMost}) {
      c.Begin(mode);
      for (int i = 0; i < 4; ++i) c.Vertex4f(i == 1 ? special : 0.25f, i == 2 ? special : 0.5f, 0, 1);
      c.End();
    }
  return c;
}

// Runs the controls of a case that ends the process: explicit commands replace evaluation, and maps and grids
// are left out. If the case draws no vertices, the first control omits evaluation instead. If it has
// arguments that are not finite, another control draws such vertices. The last control draws the primitives
// from which topologies are learned. Throws NotObservable if the library survives all controls.
void run_without_evaluators(const Subject& subject, const gl::Case& script) {
  std::vector<gl::Case> controls = gl::controls_without_evaluators(script);
  const Prediction prediction = predict(script, subject.info.max_order());
  if (prediction.vertex_count() == 0) {
    gl::Case without = script.without_commands();
    for (const gl::Command& command : script.commands())
      if (!gl::is_evaluation(command.entry)) without.add(command);
    controls.front() = gl::with_explicit_vertices(without);
  }
  if (has_specials(script)) controls.push_back(explicit_specials());
  if (prediction.vertex_count() > 0) controls.push_back(explicit_primitives(prediction));
  for (const gl::Case& control : controls) {
    gl::Case supported = control.without_commands();  // a sink need not support all explicit commands
    for (const gl::Command& command : control.commands())
      if (subject.info.has(command.entry)) supported.add(command);
    subject.implementation->create_context()->play(supported);
  }
  throw NotObservable("the library survives the case with explicit vertices");
}

}  // namespace

Session::Session(SessionOptions options, const Wrapping& wrapping,
                 const std::function<void(const Event&)>& report)
    : options_(std::move(options)), wrapping_(wrapping), report_(report) {}

void Session::close() {
  warm_.reset();
  reused_.reset();
  captures_.reset();
}

void Session::open() {
  if (implementation_) return;
  const std::string& mesa = options_.implementation.mesa_build;
  if (!mesa.empty() && !uses_mesa_build(mesa))
    use_mesa_build(mesa);  // throws as before this program started again
  implementation_ = open_implementation(options_.implementation);
  if (wrapping_) implementation_ = wrapping_(std::move(implementation_));
  subject_.info = inquire(*implementation_);
  if (!subject_.info.rejected_queries.empty())
    implementation_ = without_queries(std::move(implementation_), subject_.info.rejected_queries);
  subject_.implementation = implementation_.get();
  subject_.depth = options_.depth;
  subject_.seed = options_.seed;
  subject_.omitted_calls = {options_.omitted_calls.begin(), options_.omitted_calls.end()};
  for (const std::string& choice : options_.readings) {
    const std::size_t equals = choice.find('=');
    if (equals == std::string::npos) throw CannotStart("'" + choice + "' is not NAME=READING");
    subject_.readings[choice.substr(0, equals)] = choice.substr(equals + 1);
  }
}

void Session::open_captures() {
  open();
  if (captures_) return;
  const bool shares_state = subject_.info.shares_state;
  if (shares_state) reused_ = reuse_context(*implementation_, subject_.info);
  captures_ = std::make_unique<Captures>(shares_state ? *reused_ : *implementation_, subject_.info,
                                         options_.captures ? &*options_.captures : nullptr);
  subject_.captures = captures_.get();
  if (options_.reuse_context && !shares_state) {
    captures_->prove_all();
    reused_ = reuse_context(*implementation_, subject_.info);
  }
  if (reused_) subject_.implementation = reused_.get();
  if (options_.warm && !reused_) warm_ = WarmContext::of(*implementation_, subject_.info);
  if (options_.reproduce) {
    reproduction_ = std::make_unique<Reproduction>(
        *subject_.implementation, [this](const std::string& program) { report_(ProgramWritten{program}); },
        *options_.reproduce);
    subject_.reproduction = reproduction_.get();
    subject_.implementation = &reproduction_->implementation();
  }
}

void Session::open_for_tests() {
  open();
  if (!std::exchange(is_open_for_tests_, true))
    subject_.omitted_calls.merge(rejected_grid_queries(*implementation_));
  open_captures();
}

const Subject& Session::subject() {
  open_captures();
  return subject_;
}

Description Session::describe() {
  open();
  const ImplementationInfo& info = subject_.info;
  Description description;
  std::vector<ListedTest> tests;
  for (const TestInfo& test : all_tests()) tests.push_back(test.listed());
  description.suite = suite_id(tests);
  ImplementationRecord& implementation = description.implementation;
  implementation.name = info.name;
  implementation.library = info.library;
  implementation.context_library = implementation_->context_library();
  implementation.vendor = info.vendor;
  implementation.renderer = info.renderer;
  implementation.version = info.version;
  implementation.max_eval_order = info.max_eval_order;
  implementation.note = note_on_driver(info, options_.implementation);
  implementation.files = loaded_gl_files();
  if (!options_.implementation.mesa_build.empty())
    require_mesa_build(options_.implementation.mesa_build, implementation.files);
  for (const auto& capture : all_captures()) description.captures.push_back(capture->name());
  return description;
}

CaptureRecord Session::prove(const std::string& name) {
  open();
  for (auto& capture : all_captures()) {
    if (capture->name() != name) continue;
    CaptureRecord result{name, true, "", ""};
    try {
      capture->prove(*implementation_, subject_.info);
      result.shows = evalcts::describe(capture->attributes());
      if (const Attributes inexact = capture->inexact_attributes())
        result.shows = (capture->attributes() ? result.shows + ", and inexactly " : "inexactly ") +
                       evalcts::describe(inexact);
    } catch (const NotObservable& exception) {
      result.available = false;
      result.reason = exception.what();
    }
    return result;
  }
  throw std::runtime_error("unknown capture '" + name + "'");
}

// Keeps the latest case of the running test if it is the first that failed.
void Session::keep_failing_case() {
  if (!record_ || !failing_case_.empty() || record_->failures.empty() ||
      record_->failures.front().case_identity != latest_case_.identity())
    return;
  failing_case_ = gl::to_text_if_possible(latest_case_);
}

void Session::begin_case(const gl::Case& script, const Job& job) {
  keep_failing_case();
  latest_case_ = script;
  // The control of the last case takes its place, and ends the test.
  if (job.runs_control && cases_left_ == 1) run_without_evaluators(subject_, script);
  // Ends the test. Nobody reads its verdict, an internal error.
  if (cases_left_-- == 0) throw std::runtime_error("no further cases of this test were requested");
  if (job.traces_cases)
    report_(CaseStarted{script.identity(), script.is_control(), gl::all_calls(script),
                        gl::to_text_if_possible(script)});
}

void Session::run_on(const Subject& subject, const TestInfo& test, const Job& job, TestRecord& record) {
  cases_left_ = job.cases.value_or(std::numeric_limits<std::uint64_t>::max());
  record_ = &record;
  latest_case_ = {};
  failing_case_.clear();
  Subject watched = subject;
  watched.before_case = [&](const gl::Case& script) { begin_case(script, job); };
  Test running(watched, record);
  running.run(test.body);
  keep_failing_case();
  record_ = nullptr;
}

// Runs the test in the warm context, if there is one. Returns true, with the result in `record`, if it
// passes.
bool Session::passes_in_warm_context(const TestInfo& test, const Job& job, TestRecord& record) {
  Subject subject = subject_;
  subject.implementation = &warm_->implementation();
  subject.is_warm = true;
  TestRecord warm = record;
  run_on(subject, test, job, warm);
  if (!warm_->restore() || warm.verdict != Verdict::kPass) return false;
  record = std::move(warm);
  return true;
}

// Runs the test in the warm context first, if there is one. Anything but a pass is discarded: the test runs
// again in fresh contexts, which decide. A sample of the tests uses fresh contexts only.
void Session::run_warm_then_fresh(const TestInfo& test, const Job& job, TestRecord& record) {
  constexpr std::uint32_t kSample = 16;
  const bool is_in_sample = (fnv1a<std::uint32_t>(record.name) + subject_.seed) % kSample == 0;
  const bool uses_warm_context = warm_ && !warm_->is_hopeless() && !is_in_sample;
  if (uses_warm_context && passes_in_warm_context(test, job, record)) return;
  Subject subject = subject_;
  if (uses_warm_context) subject.warm = warm_.get();
  run_on(subject, test, job, record);
}

TestRecord Session::run_test(const TestInfo& test, const Job& job) {
  open_for_tests();
  TestRecord record;
  record.name = test.full_name();
  record.requirements = test.requirements;
  record.level = test.level;
  const auto start = std::chrono::steady_clock::now();
  const Surroundings surroundings;
  run_warm_then_fresh(test, job, record);
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<std::string> changed = surroundings.put_back();
  if (!failing_case_.empty()) report_(CaseFailed{record.name, failing_case_});
  report_(TestFinished{record});
  if (!changed.empty())
    std::cout << fmt::format("evalcts: the library has changed {}; put back", fmt::join(changed, ", "))
              << std::endl;
  return record;
}

void Session::observe(const ValuesRequest& request) {
  ValuesObserved answer;
  try {
    ObservedValues observed = observe_values(*captures_, *subject().implementation, request);
    answer = {std::move(observed.capture), std::move(observed.values), ""};
  } catch (const NotObservable& reason) {
    answer.why_not = reason.what();
  } catch (const gl::MissingEntryPoint& missing) {
    answer.why_not = missing.what();
  }
  report_(answer);
}

TestRecord Session::run_program(const Job& job) {
  const Subject& of_programs = subject();
  gl::Case script = fuzz::with_what_exists(of_programs.info, implementation_->create_context()->table(),
                                           gl::parse_case(job.data));
  script.set_identity("program");
  const Specified specified = specify(script, of_programs.info.max_order());
  // kAll judges vertices only if some are due; surplus ones and the order of meshes are judged on their own.
  std::vector<Outcomes> all_outcomes = {Outcomes::kAll};
  if (specified.prediction.vertex_count() == 0) all_outcomes.push_back(Outcomes::kVertices);
  if (specified.prediction.has_meshes()) all_outcomes.push_back(Outcomes::kOrder);
  TestRecord record;
  record.name = "program";
  record.verdict = Verdict::kPass;
  for (const Outcomes outcomes : all_outcomes) {
    if (!record.failures.empty()) break;
    record.failures = fuzz::judge_program(of_programs, script, specified, outcomes).failures;
  }
  if (!record.failures.empty()) {
    record.verdict = Verdict::kFail;
    record.message = record.failures.front().message;
  }
  report_(TestFinished{record});
  return record;
}

}  // namespace evalcts
