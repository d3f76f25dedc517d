// Counts, sorts and labels the tests of a run, and derives signatures and requirements from their records.
#include <evalcts/results/hash.h>
#include <evalcts/results/run_result.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include <evalcts/results/text.h>

namespace evalcts {

std::vector<RequirementId> TestRecord::blamed() const {
  if (!is_bad()) return {};
  return violated.empty() ? requirements : violated;
}

std::vector<RequirementId> TestRecord::hidden() const {
  std::vector<RequirementId> hidden;
  if (is_bad() && !violated.empty())
    std::ranges::copy_if(requirements, std::back_inserter(hidden),
                         [&](const RequirementId& id) { return std::ranges::count(violated, id) == 0; });
  return hidden;
}

int TestRecord::severity() const {
  const int rank = static_cast<int>(verdict), shift = static_cast<int>(kBadVerdicts);
  if (is_bad()) return is_expected_failure() ? rank + shift : rank;
  return is_unexpected_pass() ? 2 * shift : rank + shift + 1;
}

std::string TestRecord::place_of_death() const {
  if (!crash) return {};
  if (verdict == Verdict::kCrash) return crash->group();
  return verdict == Verdict::kTimeout ? crash->command() : std::string();
}

std::string Crash::command() const { return call.substr(0, call.find('(')); }

std::string Crash::group() const {
  constexpr std::size_t kFramesOfGroup = 3;
  if (frames.empty()) return command();
  // A function of the C library that copies bytes crashes in many places, so the group begins at its caller.
  std::size_t first = 0;
  while (first + 1 < frames.size() && frames[first].starts_with("libc.so")) ++first;
  // A recursion may be more or less deep.
  std::vector<std::string> distinct;
  std::unique_copy(frames.begin() + static_cast<std::ptrdiff_t>(first), frames.end(),
                   std::back_inserter(distinct));
  distinct.resize(std::min(distinct.size(), kFramesOfGroup));
  return fmt::format("{}", fmt::join(distinct, " < "));
}

std::string TestRecord::signature() const {
  if (!signature_of_all.empty()) return signature_of_all;
  std::vector<std::string> identities = mismatches;
  std::ranges::sort(identities);
  auto hash = fnv1a<std::uint64_t>("");
  for (const std::string& identity : identities) hash = fnv1a(identity + '\n', hash);
  return fmt::format("{}-{:016x}", identities.size(), hash);
}

void TestRecord::shorten_mismatches() {
  std::ranges::sort(mismatches);
  if (mismatches.size() <= kMostMismatches) return;
  signature_of_all = signature();
  mismatches.resize(kMostMismatches);
  mismatches.shrink_to_fit();
}

const char* name_of(RunStatus status) {
  return status == RunStatus::kComplete      ? "complete"
         : status == RunStatus::kInterrupted ? "interrupted"
                                             : "not-started";
}

std::optional<RunStatus> status_named(const std::string& name) {
  for (const RunStatus status : {RunStatus::kComplete, RunStatus::kInterrupted, RunStatus::kNotStarted})
    if (name == name_of(status)) return status;
  return std::nullopt;
}

const char* name_of(Pass pass) { return pass == Pass::kReuseContext ? "reuse-context" : ""; }

std::optional<Pass> pass_named(const std::string& name) {
  for (const Pass pass : {Pass::kFreshContexts, Pass::kReuseContext})
    if (name == name_of(pass)) return pass;
  return std::nullopt;
}

std::string Shard::text() const { return fmt::format("{}-of-{}", number, count); }

std::optional<Shard> Shard::parse(const std::string& text, const std::string& separator) {
  constexpr std::uint32_t kMostShards = 1'000'000;
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) return std::nullopt;
  Shard shard;
  const char *const middle = text.data() + at, *const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), middle, shard.number);
  const auto count = std::from_chars(middle + separator.size(), end, shard.count);
  if (number.ec != std::errc() || number.ptr != middle || count.ec != std::errc() || count.ptr != end ||
      shard.number < 1 || shard.number > shard.count || shard.count > kMostShards)
    return std::nullopt;
  return shard;
}

std::uint64_t RunResult::total() const {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t RunResult::unexpected_count() const {
  if (tests.empty()) return std::accumulate(counts.begin(), counts.begin() + kBadVerdicts, std::uint64_t{0});
  return std::ranges::count_if(tests, &TestRecord::is_unexpected);
}

std::uint64_t RunResult::expected_failure_count() const {
  return std::ranges::count_if(tests, &TestRecord::is_expected_failure);
}

void RunResult::summarize() {
  counts = {};
  std::map<std::string, std::set<std::string>> found;
  for (const TestRecord& test : tests) {
    ++counts[static_cast<std::size_t>(test.verdict)];
    for (const auto& [text, reading] : test.readings) found[text].insert(reading);
  }
  readings.clear();
  for (const auto& [text, all] : found) readings[text] = {all.begin(), all.end()};
}

const Bug* RunResult::bug_of(const std::string& test) const {
  for (const Bug& bug : bugs)
    if (std::ranges::binary_search(bug.tests, test)) return &bug;
  return nullptr;
}

std::string RunResult::heading(const std::string& unnamed) const {
  const std::string name = implementation.name.empty() ? unnamed : one_line(implementation.name);
  return pass == Pass::kFreshContexts ? name : name + ", one shared context";
}

std::string RunResult::file_label() const {
  std::string label = implementation.name;
  if (shard) label += "." + shard->text();
  if (pass != Pass::kFreshContexts) label += std::string(".") + name_of(pass);
  return label;
}

}  // namespace evalcts
