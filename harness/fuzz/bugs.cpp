// Reduces the failing cases of a run in workers, and groups the failing tests by the minimal
// programs.
#include <evalcts/fuzz/bugs.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <tuple>

#include <evalcts/fuzz/known_programs.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/display_lists.h>
#include <evalcts/results/files.h>
#include <evalcts/results/hash.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/interruption.h>
#include "death.h"
#include "excerpt.h"

namespace evalcts::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOfText = 80;       // columns of a requirement's text in a title
constexpr int kMostAttemptsOfDeath = 60;      // candidates for the reduction of a crash; each needs a process
constexpr double kSecondsOfDeath = 10;        // time limit for the reduction of a crash
constexpr double kSecondsOfHang = 2;          // time limit of a candidate for a hang
constexpr double kSecondsOfCase = 30;         // time limit of a reducing process without an event
constexpr double kSecondsOfProof = 10;        // time limit of the program of a known bug
constexpr std::size_t kMostTestsOfPlace = 3;  // tests that die at one place, of which one has to be reduced
constexpr double kShareOfLargeCase = 0.05;    // share of the time for one case that draws very much
constexpr std::size_t kReducedOfBaselineBug = 3;  // tests of each bug that the baseline names

bool is_to_be_explained(const TestRecord& test) {
  return is_failure(test.verdict) && !test.also_in_fresh_context;
}

std::string without_digits(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  return text;
}

// Returns the family of a test, "Mesh.LastIsExact" for "Mesh1.LastIsExact/LINE/Executed".
std::string family_of(const std::string& test) { return without_digits(test.substr(0, test.find('/'))); }

// Returns the known bugs that the baseline names for an expected failure, the most specific one first.
std::vector<const KnownBug*> bugs_of_baseline(const TestRecord& test) {
  std::vector<const KnownBug*> bugs;
  for (const std::string& id : test.known_bugs)
    if (const KnownBug* const bug = find_known_bug(id)) bugs.push_back(bug);
  return bugs;
}

Difference recorded_death(const TestRecord& test) {
  return {test.verdict == Verdict::kTimeout ? Difference::kHang : Difference::kCrash, test.place_of_death(),
          ""};
}

// Returns the first of them that is proven, for a crash or hang at the same place, or has no program that
// could prove it; null if there is none.
const KnownBug* accepted_bug(const TestRecord& test, const Proofs& proofs) {
  for (const KnownBug* const bug : bugs_of_baseline(test)) {
    if (bug->programs.empty()) return bug;
    const auto proof = proofs.find(bug->id);
    if (proof == proofs.end()) continue;
    if (!is_death(test.verdict) || proof->second.failure.difference == recorded_death(test)) return bug;
  }
  return nullptr;
}

// Returns the known bug that explains the test; null if there is none. If the test was reduced, its minimal
// program decides, unless the baseline names a bug without a program.
const KnownBug* known_bug_behind(const TestRecord& test, const Finding* minimal, const Proofs& proofs) {
  if (minimal && !minimal->known.empty()) return find_known_bug(minimal->known);
  const KnownBug* const accepted = accepted_bug(test, proofs);
  return minimal && accepted && !accepted->programs.empty() ? nullptr : accepted;
}

bool draws_very_much(const FailingCase& failing) {
  return !failing.commands.empty() && vertices_of(gl::parse_case(failing.commands)) > kMostVertices;
}

// Reduces failing cases in workers, and crashes by running each candidate in a separate process.
class BugSearch {
 public:
  BugSearch(const RunResult& run, const BugRequest& request,
            const std::function<void(std::size_t, std::size_t)>& progress)
      : run_(run), request_(request), progress_(progress) {}

  // Runs the programs of the known bugs that the baseline names.
  const Proofs& prove_bugs_of_baseline() {
    std::set<const KnownBug*> named;
    for (const TestRecord& test : run_.tests)
      if (is_to_be_explained(test))
        for (const KnownBug* const bug : bugs_of_baseline(test)) named.insert(bug);
    std::vector<std::string> to_prove;
    for (const KnownBug& bug : known_bugs()) {
      if (!named.contains(&bug) || bug.programs.empty()) continue;
      if (!bug.dies()) {
        to_prove.push_back(bug.id);
        continue;
      }
      for (const KnownProgram& known : known_programs()) {
        if (known.bug != bug.id || interrupted) continue;
        const std::optional<Difference> death = run_alone(known.program, kSecondsOfProof);
        if (!death || !death->is_like(known.record.difference)) continue;
        Finding& proof = proofs_[bug.id] = finding_of_death(known.program, *death, max_eval_order());
        proof.known = bug.id;
        break;
      }
    }
    std::size_t next = 0;
    run_jobs(
        [&]() -> std::optional<Job> {
          if (next == to_prove.size() || seconds_left() <= 0) return std::nullopt;
          return Job{
              .kind = "prove-bug", .name = to_prove[next++], .data = fmt::format("{}", seconds_left())};
        },
        [&](const Reduction& proof) {
          if (proof.minimal) proofs_[proof.test] = *proof.minimal;
        });
    return proofs_;
  }

  // Reduces the failures that the proofs do not explain.
  std::map<std::string, Reduction> reduce_all() {
    const std::vector<const TestRecord*> tests = in_order();
    total_ = tests.size();
    std::vector<FailingCase> cases;
    std::vector<const TestRecord*> deaths;
    for (const TestRecord* test : tests) {
      if (is_death(test->verdict))
        deaths.push_back(test);
      else
        cases.push_back({test->name,
                         test->failures.empty() ? Difference() : test->failures.front().difference,
                         commands_of(*test)});
    }
    // Cases that draw very much take long and come last, because smaller cases have often shown their cause
    // by then.
    std::stable_partition(cases.begin(), cases.end(),
                          [](const FailingCase& each) { return !draws_very_much(each); });
    reduce(cases);
    // A library that reads out of bounds may crash or not, depending on the contents of memory, so cases
    // whose process died get a second attempt.
    std::erase_if(cases, [this](const FailingCase& each) { return reductions_.contains(each.test); });
    if (!cases.empty() && !interrupted && seconds_left() > 0) reduce(cases);
    for (const FailingCase& each : cases)
      if (!reductions_.contains(each.test))
        take({each.test, {}, interrupted || seconds_left() <= 0 ? kOutOfTime : kDiedOnTheWay});
    reduce_deaths(deaths);
    return reductions_;
  }

 private:
  // Returns the commands of the first failing case as JSON; empty if the case cannot be stored as JSON.
  std::string commands_of(const TestRecord& test) const {
    const auto found = run_.failing_cases.find(test.name);
    return found == run_.failing_cases.end() ? std::string() : found->second;
  }

  double seconds_left() const {
    return request_.seconds - std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  // True if the baseline expects failures of known bugs only with the known failing cases.
  bool compares_failing_cases() const {
    return run_.seed == 1 && run_.depth.value_or(Depth::kFull) != Depth::kThorough;
  }

  // Returns the failing tests to reduce: first one of each group with the same likeness_of(), then the second
  // of each, and so on. Tests of a known bug that the baseline names are left out, except the first few if
  // the failing cases were not compared.
  std::vector<const TestRecord*> in_order() const {
    std::map<std::string, std::size_t> seen;
    std::vector<std::pair<std::size_t, const TestRecord*>> order;
    for (const TestRecord& test : run_.tests)
      if (is_to_be_explained(test)) order.emplace_back(seen[likeness_of(test)]++, &test);
    std::ranges::stable_sort(order, {}, &std::pair<std::size_t, const TestRecord*>::first);
    std::vector<const TestRecord*> tests;
    std::map<const KnownBug*, std::size_t> of_baseline;
    for (const auto& [number, test] : order) {
      const KnownBug* const accepted = accepted_bug(*test, proofs_);
      if (!accepted || (!compares_failing_cases() && of_baseline[accepted]++ < kReducedOfBaselineBug))
        tests.push_back(test);
    }
    return tests;
  }

  void take(const Reduction& reduction) {
    reductions_[reduction.test] = reduction;
    progress_(reductions_.size(), total_);
  }

  // Runs the jobs that `next` returns in workers, and calls `take_result` with their results.
  void run_jobs(const std::function<std::optional<Job>()>& next,
                const std::function<void(const Reduction&)>& take_result) const {
    Pool{
        .command = [this] { return request_.suite_command; },
        .log = request_.scratch / "reduce.log",
        .limits = {kSecondsOfCase, request_.limits.memory},
        .workers = static_cast<std::size_t>(std::max(request_.jobs, 1)),
        .each =
            [&](const Event& event) {
              const auto* other = std::get_if<OtherEvent>(&event);
              if (const std::optional<Reduction> result = other ? parse_reduction(other->line) : std::nullopt)
                take_result(*result);
            }}
        .run(next);
  }

  void reduce(const std::vector<FailingCase>& cases) {
    std::size_t next = 0;
    run_jobs(
        [&]() -> std::optional<Job> {
          for (; next < cases.size(); ++next) {
            FailingCase failing = cases[next];
            const double share =
                draws_very_much(failing) ? kShareOfLargeCase * request_.seconds : request_.seconds;
            failing.seconds = std::min(share, seconds_left());
            if (failing.seconds > 0) {
              ++next;
              return Job{.kind = "reduce", .name = failing.test, .data = to_text(failing)};
            }
            take({failing.test, {}, kOutOfTime});
          }
          return std::nullopt;
        },
        [this](const Reduction& reduction) { take(reduction); });
  }

  // --- crashes and hangs

  // Runs the program in a separate process. Returns the death of the library, if it dies.
  std::optional<Difference> run_alone(const gl::Case& program, double patience) const {
    return fuzz::death_of(run_program(request_.suite_command, program, request_.scratch / "alone.log",
                                      {patience, request_.limits.memory}));
  }

  // Reduces one test for each place at which the library dies, and tries up to kMostTestsOfPlace tests.
  void reduce_deaths(const std::vector<const TestRecord*>& deaths) {
    std::map<std::string, std::size_t> attempts;
    for (const TestRecord* test : deaths) {
      if (interrupted) return;
      const std::string place = test->place_of_death().empty() ? std::string() : recorded_death(*test).text();
      if (!place.empty() && attempts[place]++ >= kMostTestsOfPlace) {
        take({test->name, {}, kSamePlace});
        continue;
      }
      const Reduction reduction = reduce_death(*test);
      if (reduction.minimal) attempts[place] = kMostTestsOfPlace;
      take(reduction);
    }
  }

  Reduction reduce_death(const TestRecord& test) {
    const auto not_reduced = [&](const std::string& why) { return Reduction{test.name, {}, why}; };
    if (seconds_left() <= 0) return not_reduced(kOutOfTime);
    if (commands_of(test).empty())
      return not_reduced("the case in which the library died has no plain form as data");
    gl::Case program;
    try {
      program = only_specified(gl::parse_case(commands_of(test)));
    } catch (const std::invalid_argument& error) {
      return not_reduced(error.what());
    }
    const double patience =
        test.verdict == Verdict::kTimeout ? kSecondsOfHang : request_.limits.seconds_per_test;
    const Clock::time_point begin = Clock::now();
    const auto is_over = [&] {
      return interrupted || seconds_left() <= 0 ||
             std::chrono::duration<double>(Clock::now() - begin).count() > kSecondsOfDeath;
    };
    std::optional<Finding> finding = fuzz::reduce_death(
        program, recorded_death(test),
        [&](const gl::Case& candidate) { return is_over() ? std::nullopt : run_alone(candidate, patience); },
        deaths_, kMostAttemptsOfDeath, max_eval_order());
    if (!finding)
      return not_reduced(is_over() ? kOutOfTime
                                   : "the commands that the executable specification has do not show it");
    finding->failure.message = test.message;
    return {test.name, *std::move(finding), ""};
  }

  int max_eval_order() const {
    return static_cast<int>(std::clamp<std::int64_t>(run_.implementation.max_eval_order.value_or(8), 8, 64));
  }

  const RunResult& run_;
  const BugRequest& request_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  const Clock::time_point begin_ = Clock::now();
  std::map<std::string, Reduction> reductions_;
  std::size_t total_ = 0;
  std::vector<Finding> deaths_;  // minimal programs in which the library died
  Proofs proofs_;
};

// --- grouping

std::string id_of(const std::string& requirement, const std::string& cause) {
  return fmt::format("{}-{:04x}", requirement, fnv1a<std::uint32_t>(cause) & 0xFFFFu);
}

// Returns the requirements that a bad test violates; for other tests, all requirements of the test.
std::vector<RequirementId> requirements_to_report(const TestRecord& test) {
  return test.is_bad() ? test.blamed() : test.requirements;
}

// Returns the requirement that a bug is reported for: the first violated one of most tests; `of_program` if
// no test violates one.
std::string requirement_of(const std::string& of_program, const std::vector<const TestRecord*>& tests) {
  std::map<std::string, std::size_t> times;
  for (const TestRecord* test : tests)
    if (const std::vector<RequirementId> violated = requirements_to_report(*test); !violated.empty())
      ++times[std::string(violated.front().id)];
  if (times.empty()) return of_program;
  return std::ranges::max_element(times, {}, [](const auto& each) { return each.second; })->first;
}

// A group of failing tests with the same bug.
struct Group {
  std::vector<const TestRecord*> tests;
  std::optional<Finding> minimal;  // the smallest minimal program of the tests
  std::string why_not_reduced;
  std::string cause;
  const KnownBug* known = nullptr;
};

// Replaces `minimal` by `other` if `other` is smaller. Returns true if it was replaced.
bool keep_smaller(std::optional<Finding>& minimal, const Finding& other) {
  const auto size = [](const Finding& finding) {
    return std::tuple(finding.outside_evaluators, finding.program.commands().size(),
                      gl::to_text_if_possible(finding.program).size());
  };
  if (minimal && size(*minimal) <= size(other)) return false;
  minimal = other;
  return true;
}

// Returns the GL command in which most of the tests die, "glMap1f"; empty if none dies in a known command.
std::string command_of_deaths(const std::vector<const TestRecord*>& tests) {
  std::map<std::string, std::size_t> times;
  for (const TestRecord* test : tests)
    if (is_death(test->verdict) && test->crash && !test->crash->command().empty())
      ++times[test->crash->command()];
  const auto most = std::ranges::max_element(times, {}, [](const auto& each) { return each.second; });
  return most == times.end() ? std::string() : most->first;
}

Bug bug_from(const Group& group) {
  Bug bug;
  bug.cause = group.cause;
  bug.why_not_reduced = group.minimal ? "" : group.why_not_reduced;
  std::set<RequirementId> explained;
  bug.level = Level::kQuality;
  bug.verdict = Verdict::kPass;
  for (const TestRecord* test : group.tests) {
    bug.tests.push_back(test->name);
    const std::vector<RequirementId> violated = requirements_to_report(*test);
    explained.insert(violated.begin(), violated.end());
    bug.level = std::max(bug.level, test->level);
    bug.verdict = std::min(bug.verdict, test->verdict);
    bug.breaks_real_programs = bug.breaks_real_programs || test->name.starts_with("RealPrograms.");
  }
  std::ranges::sort(bug.tests);
  bug.explains = {explained.begin(), explained.end()};
  const std::string requirement =
      requirement_of(group.minimal ? group.minimal->requirement : "", group.tests);
  bug.requirements = {requirement};
  const Requirement* const entry = catalogue().find(requirement);
  if (entry) bug.clause = entry->source;
  bug.id = id_of(requirement, bug.cause);
  if (group.minimal) {
    bug.title = group.minimal->title;
    bug.failure = group.minimal->failure;
    bug.failure.calls = gl::program_of(group.minimal->program);
    bug.failure.case_identity = "minimal program";
    bug.commands = gl::to_text_if_possible(group.minimal->program);
    bug.outside_evaluators = group.minimal->outside_evaluators;
  } else {
    const TestRecord& first = *group.tests.front();
    if (!first.failures.empty()) bug.failure = first.failures.front();
    if (bug.failure.message.empty()) bug.failure.message = first.message;
    bug.title = fmt::format("{} {}: {}", family_of(first.name),
                            first.verdict == Verdict::kCrash     ? "crashes"
                            : first.verdict == Verdict::kTimeout ? "hangs"
                                                                 : "fails",
                            cut(one_line(entry ? entry->text : first.message), kMostOfText));
  }
  const std::string command = command_of_deaths(group.tests);
  if (!command.empty())
    bug.title =
        fmt::format("{} {}{}", command, bug.verdict == Verdict::kTimeout ? "hangs" : "crashes",
                    group.minimal && gl::uses_lists(group.minimal->program) ? " in a display list" : "");
  if (const KnownBug* const known = group.known) {
    bug.known = known->id;
    bug.outside_evaluators = bug.outside_evaluators || known->outside_evaluators;
    bug.known_in = known->affects.text();
    bug.id = id_of(std::string(known->requirements.front().id), known->id);
    bug.title = known->title;
    bug.requirements = known->requirements;
    bug.clause = known->clause;
  }
  return bug;
}

}  // namespace

std::string likeness_of(const TestRecord& test) {
  const std::vector<RequirementId> violated = requirements_to_report(test);
  const std::string_view requirement = violated.empty() ? "" : violated.front().id;
  std::string what = is_death(test.verdict) ? std::string(text_of(test.verdict).word) : "";
  if (what.empty() && !test.failures.empty()) {
    const Failure& failure = test.failures.front();
    what =
        failure.difference.kind.empty() ? failure.what : failure.difference.kind + failure.difference.place;
  }
  return fmt::format("{}; {}; {}", family_of(test.name), without_digits(std::string(requirement)), what);
}

std::vector<Bug> bugs_of(const RunResult& run, const std::map<std::string, Reduction>& reductions,
                         const Proofs& proofs) {
  std::map<std::string, Group> groups;  // by the ID of the known bug, the place of death, or the cause
  // Adds the test to its group, and returns the key of the group.
  const auto add = [&](const TestRecord& test, const std::string& cause, const Finding* minimal,
                       const std::string& why) {
    const KnownBug* const known = known_bug_behind(test, minimal, proofs);
    const std::string place = test.place_of_death();
    const std::string key = known           ? "known: " + known->id
                            : place.empty() ? cause
                                            : fmt::format("{} at {}", text_of(test.verdict).word, place);
    Group& group = groups[key];
    group.known = known;
    group.tests.push_back(&test);
    if (const auto proof = known ? proofs.find(known->id) : proofs.end(); proof != proofs.end()) {
      group.minimal = proof->second;  // the program of the register
      group.cause = proof->second.cause;
    } else if ((minimal && keep_smaller(group.minimal, *minimal)) || group.cause.empty()) {
      group.cause = cause;
    }
    if (group.why_not_reduced.empty()) group.why_not_reduced = why;
    return key;
  };
  std::map<std::string, std::string> of_likeness;               // key of a reduced test, by likeness_of()
  std::map<std::string, std::string> of_place;                  // the same, by crash or hang and its place
  std::vector<std::pair<const TestRecord*, std::string>> left;  // tests not reduced, with the reason
  for (const TestRecord& test : run.tests) {
    if (!is_to_be_explained(test)) continue;
    const auto found = reductions.find(test.name);
    if (found == reductions.end() || !found->second.minimal) {
      const bool is_named = accepted_bug(test, proofs) != nullptr;
      left.emplace_back(&test, found != reductions.end() ? found->second.why_not
                               : is_named                ? std::string()
                                                         : std::string(kOutOfTime));
      continue;
    }
    const Finding& minimal = *found->second.minimal;
    const std::string key = add(test, minimal.cause, &minimal, "");
    of_likeness.try_emplace(likeness_of(test), key);
    if (!test.place_of_death().empty()) of_place.try_emplace(recorded_death(test).text(), key);
  }
  for (const auto& [test, why] : left) {
    const auto alike = of_likeness.find(likeness_of(*test));
    const auto same_place =
        test->place_of_death().empty() ? of_place.end() : of_place.find(recorded_death(*test).text());
    if (!accepted_bug(*test, proofs) && same_place != of_place.end())
      groups.at(same_place->second).tests.push_back(test);
    else if (!accepted_bug(*test, proofs) && test->place_of_death().empty() && alike != of_likeness.end() &&
             (why == kOutOfTime || why == kDiedOnTheWay))
      groups.at(alike->second).tests.push_back(test);
    else
      add(*test, "not reduced; " + likeness_of(*test), nullptr, why);
  }
  std::vector<Bug> bugs;
  for (const auto& [key, group] : groups) bugs.push_back(bug_from(group));
  sort_by_importance(bugs);
  return bugs;
}

namespace {

// Returns a sentence on the failing tests that have no minimal program of their own.
std::string note_on(const RunResult& run, const std::map<std::string, Reduction>& reductions,
                    const Proofs& proofs) {
  std::size_t tests = 0, named = 0, left = 0, late = 0, dead = 0;
  for (const TestRecord& test : run.tests) {
    if (!is_to_be_explained(test)) continue;
    ++tests;
    const auto found = reductions.find(test.name);
    if (accepted_bug(test, proofs) && (found == reductions.end() || !found->second.minimal)) {
      ++named;
      continue;
    }
    if (found != reductions.end() && found->second.why_not == kSamePlace) continue;
    const bool is_late = found == reductions.end() || found->second.why_not == kOutOfTime;
    const bool is_dead = !is_late && found->second.why_not == kDiedOnTheWay;
    late += is_late;
    dead += is_dead;
    left += !is_late && !is_dead && !found->second.minimal;
  }
  std::vector<std::string> notes;
  if (named > 0)
    notes.push_back(fmt::format(
        "the baseline attributes {} of {} failures to known bugs; these were not reduced", named, tests));
  if (left > 0)
    notes.push_back(fmt::format(
        "{} of {} failing tests could not be reduced to a minimal program and are grouped by requirement, by "
        "what differed and by their family",
        left, tests));
  if (dead > 0)
    notes.push_back(fmt::format("for {} of {} {}: they belong to the bugs of tests that fail alike", dead,
                                tests, kDiedOnTheWay));
  if (late > 0)
    notes.push_back(
        fmt::format("for {} of {} {} (--bug-seconds): they belong to the bugs of tests that fail alike", late,
                    tests, kOutOfTime));
  return fmt::format("{}", fmt::join(notes, "; "));
}

}  // namespace

void find_bugs(RunResult& run, const BugRequest& request,
               const std::function<void(std::size_t, std::size_t)>& progress) {
  std::map<std::string, Reduction> reductions;
  BugSearch search(run, request, progress);
  const Proofs proofs = search.prove_bugs_of_baseline();
  if (run.pass == Pass::kFreshContexts) {
    reductions = search.reduce_all();
  } else {
    for (const TestRecord& test : run.tests)
      reductions[test.name] = {test.name, {}, "it depends on what was run before in the same context"};
  }
  run.bugs = bugs_of(run, reductions, proofs);
  run.bugs_note = note_on(run, reductions, proofs);
}

void set_aside_shared_bugs(RunResult& result) {
  const auto is_shared = [](const Bug& bug) { return bug.outside_evaluators && bug.known.empty(); };
  std::map<std::string, std::string> titles;  // by test
  for (const Bug& bug : result.bugs)
    if (is_shared(bug))
      for (const std::string& test : bug.tests) titles.emplace(test, bug.title);
  for (const Bug& bug : result.bugs)
    if (!is_shared(bug))
      for (const std::string& test : bug.tests) titles.erase(test);
  std::erase_if(result.bugs, is_shared);
  for (TestRecord& test : result.tests) {
    const auto title = titles.find(test.name);
    if (title == titles.end()) continue;
    test.verdict = Verdict::kNotObservable;
    test.message = "pipeline: explicit vertices instead of evaluations show it as well: " + title->second;
  }
  result.summarize();
}

}  // namespace evalcts::fuzz
