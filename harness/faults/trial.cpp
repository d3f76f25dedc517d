// Runs tests on implementations with faults and variations. A test counts only if it passes without the
// change.
#include <evalcts/faults/trial.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/runner.h>
#include <evalcts/runner/worker.h>

namespace evalcts::faults {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDeaths = 60;  // workers that may die while the tests run on one implementation

// Faults that no test can detect behind a variation, although the tests that detect them without it may pass
// in part.
struct Invisible {
  std::string_view variation, fault, reason;
};
constexpr std::string_view kOfMap1d = "the fault is one of Map1d, which is missing";
constexpr Invisible kInvisible[] = {
    {"NoDoubles", "ReversedDomainSorted", kOfMap1d},
    {"NoDoubles", "SinglePointReadLate", kOfMap1d},
    {"PositionOnly", "ColorWaitsForEnd",
     "explicit vertices wait for the colour as well, so tests with a control excuse it, and tests "
     "without one need the colours of vertices; CURRENT_COLOR is wrong only until the primitive ends, "
     "with and without evaluation"}};

struct CannotTry {
  std::string reason;
};

// The implementation of a change, with the fault and the variation of these names; both may be empty.
struct Subject {
  const ListedChange& change;
  std::string fault, variation;

  std::string label() const { return fmt::format("{}-{}-{}", change.implementation, fault, variation); }
  std::vector<std::string> arguments() const {
    std::vector<std::string> all = change.arguments;
    if (all.empty()) all = {"--implementation", change.implementation};
    if (!fault.empty()) all.insert(all.end(), {"--fault", fault});
    if (!variation.empty()) all.insert(all.end(), {"--variation", variation});
    return all;
  }
};

using Verdicts = std::map<std::string, TestRecord>;

class Trial {
 public:
  explicit Trial(const TrialRequest& request) : request_(request) {
    for (const ListedTest& test : request.tests) by_name_[test.name] = &test;
  }

  Tried try_change(const ListedChange& change) {
    Tried result;
    result.change = change;
    try {
      if (change.is_variation())
        try_variation(result);
      else
        try_fault(result);
    } catch (const CannotTry& cannot) {
      result.not_tried = cannot.reason;
    }
    return result;
  }

 private:
  void try_fault(Tried& result) {
    for (const std::string& requirement : result.change.requirements)
      result.detections.push_back(detect(result.change, requirement));
    if (std::ranges::all_of(result.detections, [](const Detection& each) {
          return each.outcome == Detection::Outcome::kNotVisible;
        }))
      throw CannotTry{result.detections.front().reason};
  }

  void try_variation(Tried& result) {
    const ListedChange& variation = result.change;
    const std::vector<std::string> all = tests_of(nullptr, Depth::kQuick, Level::kQuality);
    const Verdicts without = verdicts({variation, "", ""}, Depth::kQuick, all);
    Verdicts varied;
    try {
      varied = verdicts_of_run(variation);
    } catch (const CannotTry& cannot) {
      // Without any verdict, the variation must not count as free of false alarms.
      result.alarms.push_back(
          {.test = "all tests", .verdict = Verdict::kInternalError, .message = cannot.reason});
    }
    for (const auto& [name, record] : varied) {
      result.passed += record.verdict == Verdict::kPass;
      result.passed_in_part += record.verdict == Verdict::kPass && !record.unobserved.empty();
      result.unobserved += record.verdict == Verdict::kNotObservable;
      if (record.is_bad() && !without.at(name).is_bad() && !is_violated(variation, *by_name_.at(name)))
        result.alarms.push_back(bad_test(record, Depth::kQuick));
    }
    for (const ListedChange& fault : request_.behind) {
      Detection detection = detect_behind(variation, fault, without, varied);
      for (const Invisible& each : kInvisible)
        if (detection.outcome == Detection::Outcome::kNotVisible && each.variation == variation.name &&
            each.fault == fault.name)
          detection.reason = each.reason;
      result.detections.push_back(std::move(detection));
    }
  }

  // Judges the variation as a user would: failures are repeated, and crashes are compared with controls.
  // Throws CannotTry.
  Verdicts verdicts_of_run(const ListedChange& variation) const {
    const Subject subject{variation, "", variation.name};
    RunRequest run;
    run.suite_program = request_.suite_program;
    run.more_options = subject.arguments();
    run.name = subject.label();
    std::ranges::copy_if(request_.tests, std::back_inserter(run.tests),
                         [](const ListedTest& test) { return test.from <= Depth::kQuick; });
    run.depth = Depth::kQuick;
    run.limits = {request_.seconds_per_test};
    run.output = request_.scratch / subject.label();
    fs::create_directories(run.output);
    const RunResult result = run_implementation(run, [](const Progress&) {});
    if (result.status != RunStatus::kComplete)
      throw CannotTry{result.reason.empty() ? "interrupted" : result.reason};
    Verdicts verdicts;
    for (const TestRecord& record : result.tests) verdicts[record.name] = record;
    return verdicts;
  }

  // Looks for a test that names the requirement and detects the fault. The fault is not visible if no such
  // test passes without it.
  Detection detect(const ListedChange& fault, const std::string& requirement) {
    ListedChange only = fault;
    only.requirements = {requirement};
    bool one_passes = false;
    std::string why_none_passes;
    for (const Depth depth : {Depth::kQuick, Depth::kFull}) {
      std::vector<std::string> tests = tests_of(&only, depth, fault.level);
      Verdicts without = verdicts({fault, "", ""}, depth, tests);
      for (const auto& [name, record] : without) {
        one_passes = one_passes || record.verdict == Verdict::kPass;
        why_none_passes = fmt::format("without the fault, {} is {}: {}", name, text_of(record.verdict).word,
                                      record.message);
      }
      std::erase_if(tests, [&](const std::string& name) { return without[name].verdict != Verdict::kPass; });
      if (tests.empty()) continue;
      const Verdicts with = run({fault, fault.name, ""}, depth, tests, true);
      for (const std::string& name : tests) {
        const auto record = with.find(name);
        if (record == with.end() || !is_detection(record->second.verdict, fault.level)) continue;
        return {requirement, Detection::Outcome::kDetected, bad_test(record->second, depth), ""};
      }
    }
    if (one_passes || why_none_passes.empty()) return {.subject = requirement};
    return {requirement, Detection::Outcome::kNotVisible, {}, why_none_passes};
  }

  static bool is_detection(Verdict verdict, Level level) {
    return is_failure(verdict) || (level == Level::kQuality && verdict == Verdict::kQualityWarning);
  }

  Detection detect_behind(const ListedChange& variation, const ListedChange& fault, const Verdicts& without,
                          const Verdicts& varied) {
    // Tests that detect the fault without the variation, and pass with the variation alone. Tests that are
    // decided only in part, or not until the fault occurs, may detect the fault behind the variation; tests
    // that pass in full must.
    std::vector<std::string> tests, undecided;
    std::set<std::string> in_full;
    Detection detection{fault.name,
                        Detection::Outcome::kNotVisible,
                        {},
                        fmt::format("no test detects it on {} itself", variation.implementation)};
    for (const auto& [name, record] : verdicts({variation, fault.name, ""}, Depth::kQuick,
                                               tests_of(&fault, Depth::kQuick, Level::kQuality))) {
      const auto alone = varied.find(name);
      if (!is_failure(record.verdict) || without.at(name).is_bad() || alone == varied.end()) continue;
      const bool passes = alone->second.verdict == Verdict::kPass;
      if (passes)
        tests.push_back(name);
      else if (alone->second.verdict == Verdict::kNotObservable)
        undecided.push_back(name);
      if (passes && alone->second.unobserved.empty())
        in_full.insert(name);
      else if (in_full.empty())
        detection.reason =
            fmt::format("{} is not observed in full: {}", name, unobserved_part(alone->second));
    }
    if (in_full.empty()) tests.insert(tests.end(), undecided.begin(), undecided.end());
    if (tests.empty()) return detection;
    const Verdicts both = verdicts({variation, fault.name, variation.name}, Depth::kQuick, tests);
    const auto detecting =
        std::ranges::find_if(both, [](const auto& each) { return is_failure(each.second.verdict); });
    if (detecting != both.end())
      return {fault.name, Detection::Outcome::kDetected, bad_test(detecting->second, Depth::kQuick), ""};
    if (in_full.empty()) return detection;
    // A fault that also affects explicit vertices may prevent the proof of the only capture that is left.
    // Then every test is not-observable, and the fault is not visible.
    const auto is_undecided = [&](const auto& entry) {
      return entry.second.verdict == Verdict::kNotObservable || !in_full.contains(entry.first);
    };
    const auto shown = both.find(*in_full.begin());
    if (shown == both.end() || !std::ranges::all_of(both, is_undecided))
      detection.outcome = Detection::Outcome::kSurvives;
    else
      detection.reason = fmt::format("with the fault, {}: {}", shown->first, unobserved_part(shown->second));
    return detection;
  }

  static std::string unobserved_part(const TestRecord& record) {
    return record.unobserved.empty() ? record.message : "without " + record.unobserved;
  }

  BadTest bad_test(const TestRecord& record, Depth depth) const {
    return {record.name, by_name_.at(record.name)->level, depth, record.verdict, record.message};
  }

  // True if the test decides a requirement that the change violates.
  static bool is_violated(const ListedChange& change, const ListedTest& test) {
    return std::ranges::any_of(test.requirements, [&](const RequirementId& named) {
      return std::ranges::any_of(change.requirements,
                                 [&](const std::string& violated) { return named.decides(violated); });
    });
  }

  // Returns the tests of this level and above that decide a requirement that the change violates (null: all).
  std::vector<std::string> tests_of(const ListedChange* change, Depth depth, Level level) const {
    std::vector<std::string> names;
    for (const ListedTest& test : request_.tests)
      if (test.from <= depth && test.level >= level && (!change || is_violated(*change, test)))
        names.push_back(test.name);
    return names;
  }

  // Returns the verdicts of the tests on the subject. Each test runs once.
  Verdicts verdicts(const Subject& subject, Depth depth, const std::vector<std::string>& tests) {
    std::shared_ptr<Kept> kept;
    {
      const std::lock_guard lock(mutex_);
      std::shared_ptr<Kept>& place = kept_[{subject.label(), depth}];
      if (!place) place = std::make_shared<Kept>();
      kept = place;
    }
    const std::lock_guard lock(kept->mutex);  // so that no test runs twice
    std::vector<std::string> missing;
    std::ranges::copy_if(tests, std::back_inserter(missing),
                         [&](const std::string& name) { return !kept->verdicts.contains(name); });
    if (!missing.empty()) kept->verdicts.merge(run(subject, depth, missing, false));
    Verdicts wanted;
    for (const std::string& name : tests)
      if (const auto each = kept->verdicts.find(name); each != kept->verdicts.end()) wanted.insert(*each);
    return wanted;
  }

  static TestRecord record_of(const std::string& name, Verdict verdict, const std::string& message) {
    TestRecord record;
    record.name = name;
    record.verdict = verdict;
    record.message = message;
    return record;
  }

  // Runs the tests in this order, in a new process after each test that kills the process. If `until_bad` is
  // set, ends behind the first test that fails. Throws CannotTry if no test begins.
  Verdicts run(const Subject& subject, Depth depth, const std::vector<std::string>& tests,
               bool until_bad) const {
    Verdicts verdicts;
    std::size_t next = 0;
    int deaths = 0;
    bool is_bad = false;
    std::string latest_end;
    const std::vector<std::string> arguments = subject.arguments();
    const Pool pool{
        .command =
            [&] {
              std::vector<std::string> command = {request_.suite_program.string(), "--depth", name_of(depth)};
              command.insert(command.end(), arguments.begin(), arguments.end());
              return command;
            },
        .log = request_.scratch / fmt::format("{}-{}.log", subject.label(), name_of(depth)),
        .limits = {request_.seconds_per_test},
        .each =
            [&](const Event& event) {
              const auto* const finished = std::get_if<TestFinished>(&event);
              if (!finished) return;
              verdicts[finished->record.name] = finished->record;
              is_bad = is_bad || is_failure(finished->record.verdict);
            },
        .ended =
            [&](const WorkerRun& run) {
              latest_end = run.cannot_start.empty() ? describe(run.ending) : run.cannot_start;
              if (!run.died_in_job()) return;
              ++deaths;
              is_bad = true;
              verdicts[run.in_flight] = record_of(
                  run.in_flight, run.hung ? Verdict::kTimeout : Verdict::kCrash, describe(run.ending));
            }};
    pool.run([&]() -> std::optional<Job> {
      if (next == tests.size() || deaths == kMostDeaths || (until_bad && is_bad)) return std::nullopt;
      return Job{.kind = "test", .name = tests[next++]};
    });
    if (interrupted) throw CannotTry{"interrupted"};  // the interruption has killed the process
    if (verdicts.empty())
      throw CannotTry{fmt::format("with {} no test begins: {}", fmt::join(arguments, " "), latest_end)};
    for (const std::string& name : tests)
      if (!until_bad && !verdicts.contains(name))
        verdicts[name] =
            record_of(name, Verdict::kInternalError, "not run: too many tests before it ended the process");
    return verdicts;
  }

  struct Kept {
    std::mutex mutex;
    Verdicts verdicts;
  };

  const TrialRequest& request_;
  std::map<std::string, const ListedTest*> by_name_;
  std::mutex mutex_;  // protects kept_
  std::map<std::pair<std::string, Depth>, std::shared_ptr<Kept>> kept_;
};

std::vector<ListedChange> list(const fs::path& program, const std::string& question) {
  if (!fs::exists(program))
    throw CannotStart(fmt::format(
        "'{}' is missing. In a checkout ./evalcts faults builds it; what is installed has no faults",
        program.string()));
  const fs::path file = fs::temp_directory_path() / fmt::format("evalcts-faults-{}.json", getpid());
  ChildProcess child({program.string(), question, file.string()}, "");
  const std::optional<Ending> ending = child.wait(60);
  std::optional<std::vector<ListedChange>> changes = parse_changes(read_file(file));
  fs::remove(file);
  if (!changes)
    throw std::runtime_error(fmt::format("'{}' does not list its faults ({})", program.string(),
                                         ending ? describe(*ending) : "it takes too long"));
  return *std::move(changes);
}

}  // namespace

std::vector<Tried> try_all(const TrialRequest& request,
                           const std::function<void(std::size_t done, const std::string& name)>& progress) {
  Trial trial(request);
  std::vector<std::optional<Tried>> results(request.changes.size());
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < results.size() && !interrupted; i = next++) {
      const ListedChange& change = request.changes[i];
      progress(done, change.name);
      try {
        Tried tried = trial.try_change(change);
        // The result of a variation that an interruption cut short would count as good.
        if (!interrupted || !change.is_variation()) results[i] = std::move(tried);
      } catch (...) {
        next = results.size();  // no further change is tried
        throw;
      }
      ++done;
    }
  };
  std::vector<std::future<void>> workers;
  for (int i = 0; i < request.jobs; ++i) workers.push_back(std::async(std::launch::async, work));
  for (std::future<void>& worker : workers) worker.get();
  std::vector<Tried> all;
  for (std::optional<Tried>& result : results)
    if (result) all.push_back(*std::move(result));
  return all;
}

std::vector<ListedChange> list_faults(const fs::path& program) { return list(program, "--list-faults"); }
std::vector<ListedChange> list_variations(const fs::path& program) {
  return list(program, "--list-variations");
}

}  // namespace evalcts::faults
