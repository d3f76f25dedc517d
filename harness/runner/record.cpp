#include "harness/runner/record.h"

#include <cmath>

#include "harness/results/json.h"

namespace evalcts {
namespace {

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json to_json(const Failure& failure) {
  nlohmann::json json = {{"case", failure.case_identity}, {"message", failure.message},
                         {"what", failure.what},          {"expected", failure.expected},
                         {"captured", failure.captured},  {"calls", failure.calls}};
  if (!failure.exact.empty()) json["exact"] = failure.exact;
  if (failure.ulp) json["ulp"] = number(*failure.ulp);
  if (failure.condition_aware) json["condition_aware"] = number(*failure.condition_aware);
  if (!failure.capture.empty()) json["capture"] = failure.capture;
  return json;
}

nlohmann::json to_json(const Accuracy& accuracy) {
  nlohmann::json json = {{"values", accuracy.values},
                         {"max_ulp", number(accuracy.ulp.error)},
                         {"max_condition_aware", number(accuracy.condition_aware.error)},
                         {"incorrectly_rounded", accuracy.not_correctly_rounded},
                         {"all_terms_zero", accuracy.all_terms_zero},
                         {"all_terms_zero_wrong", accuracy.all_terms_zero_wrong},
                         {"not_judged", accuracy.not_judged}};
  json["worst"] = accuracy.ulp.where;
  json["worst_exact"] = accuracy.ulp.exact;
  json["worst_condition_aware"] = accuracy.condition_aware.where;
  return json;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::quality_warning:
      return "quality-warning";
    case Verdict::not_supported:
      return "not-supported";
    case Verdict::not_observable:
      return "not-observable";
    case Verdict::skipped:
      return "skipped";
    case Verdict::crash:
      return "crash";
    case Verdict::timeout:
      return "timeout";
    case Verdict::internal_error:
      return "internal-error";
  }
  return "internal-error";
}

nlohmann::json to_json(const Record& record) {
  nlohmann::json json = {{"name", record.name},
                         {"requirements", record.requirements},
                         {"level", name_of(record.level)},
                         {"verdict", name_of(record.verdict)},
                         {"message", record.message},
                         {"cases", record.cases},
                         {"failed_cases", record.failed_cases},
                         {"seconds", record.seconds},
                         {"seed", record.seed},
                         {"expected_by_baseline", false},
                         {"baseline_reason", ""}};
  if (!record.mismatches.empty()) json["mismatches"] = record.mismatches;
  nlohmann::json failures = nlohmann::json::array();
  for (const Failure& failure : record.failures) failures.push_back(to_json(failure));
  json["failures"] = failures;
  if (!record.failures.empty()) {
    // The first failing case stands for the test.
    for (const char* member : {"calls", "expected", "captured", "ulp", "condition_aware", "capture"})
      if (failures.front().contains(member)) json[member] = failures.front()[member];
  }
  if (!json.contains("capture") && !record.captures.empty()) json["capture"] = record.captures.front();
  if (!record.readings.empty()) json["readings"] = record.readings;
  if (record.accuracy) json["accuracy"] = to_json(*record.accuracy);
  return json;
}

}  // namespace evalcts
