// Describes the verdicts of the quality tests: single precision by map target, and equal bits.
#include "quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "text.h"

namespace evalcts::reports {
namespace {

bool decides(const TestRecord& test, std::string_view requirement) {
  return std::ranges::any_of(test.requirements,
                             [&](const RequirementId& id) { return id.text().starts_with(requirement); });
}

// The target that the test is about; empty if the test is not about the accuracy of one.
std::string target_of(const TestRecord& test) {
  if (test.level != Level::kQuality) return {};
  if (decides(test, "EV-AUTON-METHOD")) return "AUTO_NORMAL";
  const std::size_t slash = test.name.find('/');
  if (!decides(test, "EV-NUM-ACCURACY") || slash == std::string::npos) return {};
  return test.name.substr(slash + 1, test.name.find('/', slash + 1) - slash - 1);
}

// Requirements whose tests of level quality require equal bits, and the results that they compare.
constexpr std::pair<std::string_view, std::string_view> kEqualBits[] = {
    {"EV-API-V", "EvalCoord and its vector form"},
    {"EV-AUTON-SAMEVERTEX", "AUTO_NORMAL on and off"},
    {"EV-MESH1-SUBRANGE", "EvalMesh1 and its parts"},
    {"EV-MESH2-MODESAGREE", "EvalMesh2, its parts and its modes"},
    {"EV-NUM-DOMAINSHIFT", "a domain and the same domain moved"},
    {"EV-NUM-START", "the first control point and the value there"},
    {"EV-NUM-UNRELATEDMAPS", "maps with and without others"},
    {"EV-POINT-LIKEMESH", "EvalPoint and EvalMesh"}};

}  // namespace

std::string single_precision_in_words(const RunResult& record) {
  std::map<std::string, bool> is_good;  // by target
  for (const TestRecord& test : record.tests) {
    const std::string target = target_of(test);
    if (target.empty()) continue;
    if (test.verdict == Verdict::kPass) is_good.emplace(target, true);
    if (test.verdict == Verdict::kQualityWarning || test.verdict == Verdict::kFail) is_good[target] = false;
  }
  if (is_good.empty()) return {};
  std::vector<std::string> worse;
  for (const auto& [target, good] : is_good)
    if (!good) worse.push_back(target);
  std::string text = fmt::format("as good as single precision for {} of {}", is_good.size() - worse.size(),
                                 count(is_good.size(), "target"));
  if (!worse.empty()) text += "; not for " + join(worse, ", ");
  return text;
}

std::string equal_bits_in_words(const RunResult& record) {
  std::vector<std::string> compared;
  for (const auto& [requirement, results] : kEqualBits) {
    const auto warnings = std::ranges::count_if(record.tests, [&, id = requirement](const TestRecord& test) {
      return test.level == Level::kQuality && test.verdict == Verdict::kQualityWarning && decides(test, id);
    });
    if (warnings > 0)
      compared.push_back(fmt::format("{} ({})", results, count(static_cast<std::size_t>(warnings), "test")));
  }
  return compared.empty() ? "" : "not bit-identical: " + join(compared, ", ");
}

std::string memory_in_words(const RunResult& record) {
  std::vector<std::string> grows;
  for (const TestRecord& test : record.tests)
    if (test.verdict == Verdict::kQualityWarning && decides(test, "EV-CTX-UNBOUNDED"))
      grows.push_back(test.message);
  return join(grows, ", ");
}

std::vector<std::string> quality_in_words(const RunResult& record) {
  std::vector<std::string> lines = {single_precision_in_words(record), equal_bits_in_words(record),
                                    memory_in_words(record)};
  std::erase(lines, "");
  return lines;
}

}  // namespace evalcts::reports
