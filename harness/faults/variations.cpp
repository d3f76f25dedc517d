// Runs the suite against variations, and against typical faults behind them.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>

#include <evalcts/runner/interruption.h>
#include "suite_runs.h"

namespace evalcts::faults {
namespace {

constexpr int kMostDeathsOfOne = 60;  // children that may die while the tests run on one implementation
constexpr Depth kTriedDepth = Depth::kQuick;

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

using Verdicts = std::map<std::string, TestRecord>;

class VariationTrial {
 public:
  explicit VariationTrial(const TableRequest& request) : request_(request) {
    for (const ListedTest& test : request.tests) {
      if (test.from > kTriedDepth) continue;
      all_.push_back(test.name);
      requirements_[test.name] = test.requirements;
    }
  }

  TriedVariation try_variation(const ListedFault& variation) {
    TriedVariation result;
    result.variation = variation;
    const Verdicts& unvaried = unmodified(variation);
    if (unvaried.empty()) {
      result.reason = fmt::format("{} does not start", variation.implementation);
      return result;
    }
    const std::vector<std::string> varied_arguments = {"--variation", variation.name};
    const Verdicts varied = run_all(variation, variation.name, varied_arguments, all_);
    // Without any verdict, the variation must not count as free of false alarms.
    if (varied.empty() && !interrupted)
      result.alarms.push_back({"all tests", Verdict::kInternalError, "the suite did not begin in its time"});
    for (const auto& [name, record] : varied) {
      result.passed += record.verdict == Verdict::kPass;
      result.passed_in_part += record.verdict == Verdict::kPass && !record.unobserved.empty();
      result.unobserved += record.verdict == Verdict::kNotObservable;
      if (record.is_bad() && !unvaried.at(name).is_bad() && !is_violated(variation, name))
        result.alarms.push_back({name, record.verdict, record.message});
    }
    for (const ListedFault& fault : request_.faults) {
      if (interrupted) break;
      result.detections.push_back(detect(variation, fault, varied));
      DetectionBehind& detection = result.detections.back();
      for (const Invisible& each : kInvisible)
        if (detection.outcome == DetectionBehind::Outcome::kNotVisible && each.variation == variation.name &&
            each.fault == fault.name)
          detection.reason = each.reason;
    }
    return result;
  }

 private:
  DetectionBehind detect(const ListedFault& variation, const ListedFault& fault, const Verdicts& varied) {
    // Tests that detect the fault without the variation, and pass with the variation alone. Tests that are
    // decided only in part, or not until the fault occurs, may detect the fault behind the variation; tests
    // that pass in full must.
    std::vector<std::string> tests, undecided;
    std::set<std::string> in_full;
    DetectionBehind detection{fault.name, DetectionBehind::Outcome::kNotVisible, "",
                              fmt::format("no test detects it on {} itself", variation.implementation)};
    for (const auto& [name, record] : with_fault(variation, fault)) {
      const auto found = varied.find(name);
      if (!record.is_bad() || unmodified(variation).at(name).is_bad() || found == varied.end()) continue;
      const TestRecord& alone = found->second;
      const bool passes = alone.verdict == Verdict::kPass;
      if (passes)
        tests.push_back(name);
      else if (alone.verdict == Verdict::kNotObservable)
        undecided.push_back(name);
      if (passes && alone.unobserved.empty())
        in_full.insert(name);
      else if (in_full.empty())
        detection.reason = fmt::format("{} is not observed in full: {}", name, unobserved_part(alone));
    }
    if (in_full.empty()) tests.insert(tests.end(), undecided.begin(), undecided.end());
    if (tests.empty()) return detection;
    const Verdicts both = run_all(variation, variation.name + "-" + fault.name,
                                  {"--fault", fault.name, "--variation", variation.name}, tests);
    for (const auto& [name, record] : both)
      if (detection.test.empty() && record.is_bad()) {
        detection.outcome = DetectionBehind::Outcome::kDetected;
        detection.test = name;
      }
    if (!detection.test.empty() || in_full.empty()) return detection;
    // A fault that also affects explicit vertices may prevent the proof of the only capture that is left.
    // Then every test is not-observable, and the fault is not visible.
    const auto is_undecided = [&](const auto& entry) {
      return entry.second.verdict == Verdict::kNotObservable || !in_full.contains(entry.first);
    };
    const auto shown = both.find(*in_full.begin());
    if (shown == both.end() || !std::ranges::all_of(both, is_undecided))
      detection.outcome = DetectionBehind::Outcome::kSurvives;
    else
      detection.reason = fmt::format("with the fault, {}: {}", shown->first, unobserved_part(shown->second));
    return detection;
  }

  static std::string unobserved_part(const TestRecord& record) {
    return record.unobserved.empty() ? record.message : "without " + record.unobserved;
  }

  // True if the test decides a requirement that the fault (or variation) violates.
  bool is_violated(const ListedFault& fault, const std::string& test) const {
    return std::ranges::any_of(requirements_.at(test), [&](const RequirementId& named) {
      return std::ranges::any_of(fault.requirements,
                                 [&](const std::string& wanted) { return named.decides(wanted); });
    });
  }

  std::vector<std::string> tests_of(const ListedFault& fault) const {
    std::vector<std::string> names;
    std::ranges::copy_if(all_, std::back_inserter(names),
                         [&](const std::string& test) { return is_violated(fault, test); });
    return names;
  }

  const Verdicts& unmodified(const ListedFault& variation) {
    return kept("unmodified-" + variation.implementation,
                [&] { return run_all(variation, "unmodified-" + variation.implementation, {}, all_); });
  }

  // Returns the verdicts on the variation's implementation with the fault, without the variation.
  const Verdicts& with_fault(const ListedFault& variation, const ListedFault& fault) {
    const std::string label = variation.implementation + "-" + fault.name;
    return kept(label, [&] { return run_all(variation, label, {"--fault", fault.name}, tests_of(fault)); });
  }

  // Returns the verdicts kept under the label. The first caller computes them by `find`; other threads wait.
  template <class Find>
  const Verdicts& kept(const std::string& label, Find find) {
    std::shared_ptr<Kept> entry;
    {
      const std::lock_guard lock(mutex_);
      std::shared_ptr<Kept>& place = kept_[label];
      if (!place) place = std::make_shared<Kept>();
      entry = place;
    }
    std::call_once(entry->once, [&] { entry->verdicts = find(); });
    return entry->verdicts;
  }

  Verdicts run_all(const ListedFault& variation, const std::string& label,
                   const std::vector<std::string>& more, std::vector<std::string> left) const {
    std::vector<std::string> arguments = arguments_of(variation);
    arguments.insert(arguments.end(), more.begin(), more.end());
    Verdicts verdicts;
    for (int deaths = 0; !left.empty() && deaths < kMostDeathsOfOne && !interrupted; ++deaths) {
      const WorkerRun run = run_in_child(request_, label, arguments, kTriedDepth, left);
      if (run.records.empty() && run.in_flight.empty()) break;
      verdicts.insert(run.records.begin(), run.records.end());
      if (!run.in_flight.empty()) {
        TestRecord& record = verdicts[run.in_flight];
        record.name = run.in_flight;
        record.verdict = run.hung ? Verdict::kTimeout : Verdict::kCrash;
        record.message = describe(run.ending);
      }
      std::erase_if(left, [&](const std::string& name) { return verdicts.contains(name); });
    }
    for (const std::string& name : left) {
      if (verdicts.empty() || interrupted) break;
      verdicts[name].verdict = Verdict::kInternalError;
      verdicts[name].message = "not run: too many tests before it ended the process";
    }
    return verdicts;
  }

  struct Kept {
    std::once_flag once;
    Verdicts verdicts;
  };

  const TableRequest& request_;
  std::vector<std::string> all_;  // the names of all tests that run
  std::map<std::string, std::vector<RequirementId>> requirements_;
  std::mutex mutex_;  // protects kept_
  std::map<std::string, std::shared_ptr<Kept>> kept_;
};

std::string alarms_of(const TriedVariation& tried) {
  if (!tried.reason.empty()) return "not tried: " + tried.reason;
  std::string text = tried.alarms.empty() ? "none" : "";
  for (const FalseAlarm& alarm : tried.alarms)
    text += fmt::format("{}**{}** {}", text.empty() ? "" : ", ", text_of(alarm.verdict).word, alarm.test);
  return text;
}

}  // namespace

bool TriedVariation::is_good() const {
  return alarms.empty() && std::ranges::none_of(detections, [](const DetectionBehind& each) {
           return each.outcome == DetectionBehind::Outcome::kSurvives;
         });
}

std::vector<TriedVariation> try_variations(
    const TableRequest& request, const std::vector<ListedFault>& variations,
    const std::function<void(std::size_t done, const std::string& variation)>& progress) {
  VariationTrial trial(request);
  return try_each<TriedVariation>(variations, request.jobs, progress,
                                  [&](const ListedFault& variation) -> std::optional<TriedVariation> {
                                    TriedVariation result = trial.try_variation(variation);
                                    if (interrupted) return std::nullopt;  // the result is incomplete
                                    return result;
                                  });
}

std::string as_markdown(const std::vector<TriedVariation>& variations) {
  std::string text =
      "# Variations\n\nConforming implementations that differ from those that the suite was developed with, "
      "and what the tests say of them, at quick depth. No test may fail. Typical faults behind a variation "
      "have to be detected as far as they are visible. Tests of requirements that a variation violates may "
      "fail.\n\n"
      "| variation | in front of | passes | in part | not observable | false alarms | faults detected | not "
      "visible | surviving |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const TriedVariation& tried : variations) {
    std::map<DetectionBehind::Outcome, std::string> faults;
    for (const DetectionBehind& each : tried.detections) {
      std::string& names = faults[each.outcome];
      names += (names.empty() ? "" : " ") + each.fault;
      if (each.outcome == DetectionBehind::Outcome::kNotVisible) names += fmt::format(" ({})", each.reason);
    }
    text += fmt::format(
        "| {}: {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", tried.variation.name, tried.variation.what,
        tried.variation.implementation, tried.passed, tried.passed_in_part, tried.unobserved,
        alarms_of(tried), faults[DetectionBehind::Outcome::kDetected],
        faults[DetectionBehind::Outcome::kNotVisible], faults[DetectionBehind::Outcome::kSurvives]);
  }
  return text;
}

}  // namespace evalcts::faults
