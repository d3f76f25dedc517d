// Implements DeathConfirmation.
#include "death_confirmation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace evalcts {
namespace {

constexpr std::size_t kSameCrashes = 3;  // confirmed crashes after which others like them are not confirmed
constexpr double kSlow = 0.1;  // part of the time in which a test gave no answer that it needs alone

std::string place_of(const WorkerRun& run) { return run.crash->call + "\n" + run.crash->group(); }

// True for a crash in a command that defines or queries a map. No control is needed to blame evaluators for
// it, because a control has no such commands.
bool is_in_map_command(const WorkerRun& run) {
  if (!run.crash || run.hung || run.over_memory) return false;
  return std::ranges::any_of(std::array{"glMap", "glGetMap", "glGetnMap"},
                             [&](const char* name) { return run.crash->call.starts_with(name); });
}

}  // namespace

void DeathConfirmation::confirm_and_record(const std::vector<WorkerRun>& deaths) {
  std::vector<const WorkerRun*> first, like_others, rest;
  std::map<std::string, std::size_t> chosen;
  for (const WorkerRun& run : deaths) {
    if (!request_.is_second_pass() && (hangs_like_another(run) || has_enough_like_it(run, chosen)))
      like_others.push_back(&run);
    else
      first.push_back(&run);
  }
  confirm(first);
  for (const WorkerRun* run : like_others)
    if (interrupted || !(run->hung ? record_as_same_hang(*run) : record_as_same_crash(*run)))
      rest.push_back(run);
  confirm(rest);
}

// True if an earlier test hung at the same place.
bool DeathConfirmation::hangs_like_another(const WorkerRun& run) {
  return run.hung && run.crash && !run.crash->call.empty() &&
         !hangs_.try_emplace(place_of(run), run.in_flight).second;
}

// True if enough other tests with the same crash in a map command have been confirmed or chosen to be
// confirmed. Otherwise counts this one in `chosen`, by place.
bool DeathConfirmation::has_enough_like_it(const WorkerRun& run,
                                           std::map<std::string, std::size_t>& chosen) const {
  if (!is_in_map_command(run)) return false;
  const auto same = same_crashes_.find(place_of(run));
  const std::size_t confirmed = same == same_crashes_.end() ? 0 : same->second.confirmed;
  std::size_t& chosen_here = chosen[place_of(run)];
  if (confirmed + chosen_here >= kSameCrashes) return true;
  ++chosen_here;
  return false;
}

// Records a hang like that of a test that hung again alone. Returns false if that test did not.
bool DeathConfirmation::record_as_same_hang(const WorkerRun& run) {
  const std::string& representative = hangs_.at(place_of(run));
  if (!hung_alone_.contains(representative)) return false;
  const Verdict verdict = records_.find(representative)->verdict;
  records_.add(
      run.in_flight, verdict,
      fmt::format("{}{}; as in {}, which was run again alone",
                  verdict == Verdict::kNotObservable ? "pipeline: " : "", describe(run), representative),
      {}, run.crash);
  return true;
}

// Records a crash like those of tests that crashed again alone. Returns false if too few did, or one did not.
bool DeathConfirmation::record_as_same_crash(const WorkerRun& run) {
  const SameCrashes& same = same_crashes_[place_of(run)];
  if (same.others > 0 || same.confirmed < kSameCrashes) return false;
  records_.add(run.in_flight, Verdict::kCrash,
               fmt::format("{}; as in {} tests that were run again alone", describe(run), same.confirmed), {},
               run.crash);
  return true;
}

// Runs each of these tests alone in a new process, with its cases traced to get the calls, and records it.
void DeathConfirmation::confirm(const std::vector<const WorkerRun*>& dead) {
  const auto jobs = static_cast<std::size_t>(request_.jobs);
  for (std::size_t begin = 0; begin < dead.size(); begin += jobs) {
    const std::size_t end = std::min(begin + jobs, dead.size());
    std::vector<std::string> names;
    for (std::size_t i = begin; i < end; ++i) names.push_back(dead[i]->in_flight);
    progress_({"confirming", records_.size(), request_.tests.size(), names.front()});
    const std::vector<WorkerRun> alone =
        interrupted ? std::vector<WorkerRun>(names.size()) : processes_.run_alone(names, true);
    for (std::size_t i = begin; i < end; ++i) record_as_alone(*dead[i], alone[i - begin]);
  }
}

// True if the control of the case in which the test died alone, without evaluators, also ends the process.
bool DeathConfirmation::dies_with_explicit_vertices(const std::string& test, const WorkerRun& alone) const {
  const auto cases = alone.cases.find(test);
  if (is_in_map_command(alone) || cases == alone.cases.end() || cases->second.empty()) return false;
  const WorkerRun control = processes_.run_in_turn(
      {{.kind = "test", .name = test, .cases = cases->second.size(), .runs_control = true}},
      SuiteProcesses::Like::kAlone);
  return !interrupted && control.died_in_job();
}

void DeathConfirmation::count_crash(const WorkerRun& dead, const WorkerRun& alone) {
  if (!is_in_map_command(dead)) return;
  SameCrashes& same = same_crashes_[place_of(dead)];
  if (is_in_map_command(alone) && place_of(alone) == place_of(dead))
    ++same.confirmed;
  else
    ++same.others;
}

// Records the test in which `dead` ended, given its run alone in a new process:
//   it did not begin: not confirmed
//   it only needs more time than it had: as it was judged alone
//   it dies again: confirmed, unless the controls die as well
//   it passes or fails: a search for its history decides whether it depends on earlier tests or is a flake
void DeathConfirmation::record_as_alone(const WorkerRun& dead, const WorkerRun& alone) {
  const std::string& test = dead.in_flight;
  const Verdict verdict = verdict_of_death(dead);
  const std::string how = describe(dead.hung && alone.hung ? alone : dead);  // alone it had the whole limit
  if (interrupted) {
    records_.add(test, verdict, how + "; not confirmed, the run was interrupted", {}, dead.crash);
    return;
  }
  if (!alone.began_a_job()) {
    records_.add(test, verdict, how + "; not confirmed, because no test began in a new process", {},
                 dead.crash);
    return;
  }
  const auto result = alone.records.find(test);
  const bool has_record = result != alone.records.end();
  const double patience = dead.limits.seconds_per_test;
  // It had a part of the time only, and other processes may have taken it.
  const bool had_little_time = dead.hung && patience < request_.limits.seconds_per_test && has_record;
  if (had_little_time && result->second.seconds.value_or(0) > kSlow * patience) {
    records_.add(TestFinished{result->second});  // the test was only slow
    return;
  }
  if (alone.hung) hung_alone_.insert(test);
  count_crash(dead, alone);
  if (alone.died_in_job()) {
    const std::string last_case = alone.last_case ? alone.last_case->identity : "";
    if (alone.last_case && alone.last_case->is_control)
      records_.add(test, Verdict::kNotObservable, fmt::format("pipeline: {} in '{}'", how, last_case));
    else if (dies_with_explicit_vertices(test, alone))
      records_.add(test, Verdict::kNotObservable,
                   fmt::format("pipeline: {} in '{}', also with explicit vertices instead of evaluations",
                               how, last_case));
    else
      records_.add(test, verdict, how + "; confirmed alone in a new process", alone.last_case, dead.crash);
    return;
  }
  const bool fails_alone = has_record && result->second.verdict == Verdict::kFail;
  TestRecord& record =
      records_.add(test, verdict, how + (fails_alone ? "; fails alone" : "; passes alone"), {}, dead.crash);
  const History history = histories_.find_history(record, dead.finished);
  const bool is_reproduced = history.quality != History::Quality::kNotReproduced;
  if (!is_reproduced && had_little_time) {
    TestRecord judged = result->second;
    if (fails_alone) judged.message += fmt::format("; once, {}", describe(dead));
    records_.add(TestFinished{std::move(judged)});
    return;
  }
  add_history(record, history, dead.finished.size());
  record.flake = !is_reproduced && !fails_alone;
  if (!is_reproduced && has_record) record.again = {result->second.verdict, result->second.message};
}

}  // namespace evalcts
