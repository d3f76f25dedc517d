// Merges the results of the shards of a run.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kMostMissing = 20;  // greatest number of missing shards that are listed

// The shards of one run by number.
using Shards = std::map<std::uint32_t, const RunResult*>;

// Returns the tests in the order of an unsharded run: the K-th shard has every N-th test from the K-th on.
std::vector<TestRecord> tests_in_order(const Shards& shards) {
  std::vector<TestRecord> tests;
  bool more = true;
  for (std::size_t i = 0; more; ++i) {
    more = false;
    for (const auto& [number, shard] : shards) {
      if (i >= shard->tests.size()) continue;
      tests.push_back(shard->tests[i]);
      more = true;
    }
  }
  return tests;
}

// Returns the bugs of the shards, most important first. A bug that several shards found is listed once.
std::vector<Bug> bugs_of(const Shards& shards) {
  std::map<std::string, Bug> by_id;
  for (const auto& [number, shard] : shards)
    for (const Bug& bug : shard->bugs) {
      const auto [found, is_new] = by_id.try_emplace(bug.id, bug);
      if (is_new) continue;
      Bug whole = found->second;
      // Only a shard that reduced the bug has its program.
      if (!whole.is_reduced() && bug.is_reduced()) whole = bug;
      const auto add = [](auto& all, const auto& a, const auto& b) {
        all = a;
        all.insert(all.end(), b.begin(), b.end());
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
      };
      add(whole.tests, found->second.tests, bug.tests);
      add(whole.explains, found->second.explains, bug.explains);
      whole.level = std::max(found->second.level, bug.level);
      whole.verdict = std::min(found->second.verdict, bug.verdict);
      whole.breaks_real_programs = found->second.breaks_real_programs || bug.breaks_real_programs;
      found->second = std::move(whole);
    }
  std::vector<Bug> bugs;
  for (auto& [id, bug] : by_id) bugs.push_back(std::move(bug));
  sort_by_importance(bugs);
  return bugs;
}

RunResult merge(const Shards& shards, std::uint32_t count) {
  // Only shards that have started have the facts about the library.
  const auto started = std::find_if(shards.begin(), shards.end(),
                                    [](const auto& shard) { return shard.second->has_started(); });
  const bool any_started = started != shards.end();
  const RunResult& first = *(any_started ? started : shards.begin())->second;
  RunResult out = first;
  out.shard.reset();
  if (any_started) out.status = RunStatus::kComplete;
  out.reason.clear();
  std::set<std::string> stale, hosts;
  out.seconds.reset();
  for (const auto& [number, shard] : shards) {
    if (!shard->host.empty()) hosts.insert(shard->host);
    if (shard->started < out.started) out.started = shard->started;
    if (shard->seconds) out.seconds = out.seconds.value_or(0) + *shard->seconds;
    for (const auto member :
         {&ImplementationRecord::vendor, &ImplementationRecord::renderer, &ImplementationRecord::version})
      if (shard->implementation.*member != first.implementation.*member && shard->has_started())
        throw FormatError(fmt::format("the shards of {} judged different libraries: \"{}\" and \"{}\"",
                                      shard->heading("(unnamed)"), first.implementation.*member,
                                      shard->implementation.*member));
    stale.insert(shard->stale_baseline_entries.begin(), shard->stale_baseline_entries.end());
    if (shard->is_complete() || !out.reason.empty()) continue;
    if (any_started) out.status = RunStatus::kInterrupted;
    out.reason = fmt::format("shard {} of {}: {}", number, count,
                             shard->reason.empty() ? "not complete" : shard->reason);
  }
  out.host = join({hosts.begin(), hosts.end()}, ", ");
  out.bugs = bugs_of(shards);
  out.bugs_note.clear();
  for (const auto& [number, shard] : shards)
    if (!shard->bugs_note.empty())
      out.bugs_note += fmt::format("{}shard {} of {}: {}", out.bugs_note.empty() ? "" : "; ", number, count,
                                   shard->bugs_note);
  std::map<std::string, std::set<std::string>> readings;
  for (const auto& [number, shard] : shards)
    for (const auto& [text, followed] : shard->readings)
      readings[text].insert(followed.begin(), followed.end());
  out.tests = tests_in_order(shards);
  out.summarize();
  for (const auto& [text, followed] : readings) out.readings[text] = {followed.begin(), followed.end()};
  out.stale_baseline_entries = {stale.begin(), stale.end()};

  std::vector<std::string> missing;
  for (std::uint32_t number = 1; number <= count && missing.size() < kMostMissing; ++number)
    if (!shards.contains(number)) missing.push_back(std::to_string(number));
  if (!missing.empty()) {
    out.status = RunStatus::kInterrupted;
    out.reason = fmt::format("of {} shards these are missing: {}{}", count, join(missing, ", "),
                             shards.size() + missing.size() < count ? ", ..." : "");
  }
  return out;
}

}  // namespace

std::vector<RunResult> merge_shards(const std::vector<RunResult>& results) {
  using Key = std::tuple<std::string, Pass, std::optional<Depth>, std::uint64_t, std::uint32_t>;
  // A record without a shard number is a group of its own.
  struct Group {
    Key key;
    std::set<std::string> origins;
    Shards shards;
    const RunResult* whole = nullptr;
  };
  std::vector<Group> groups;
  for (const RunResult& result : results) {
    if (!result.shard) {
      groups.push_back({{}, {}, {}, &result});
      continue;
    }
    const Shard shard = *result.shard;
    const Key key{result.implementation.name, result.pass, result.depth, result.seed.value_or(0),
                  shard.count};
    // Shards of one folder belong together, but each shard may have a folder of its own.
    const auto find = [&](bool same_origin) {
      return std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
        return !group.whole && group.key == key && !group.shards.contains(shard.number) &&
               group.origins.contains(result.origin) == same_origin;
      });
    };
    auto group = find(true);
    if (group == groups.end()) group = find(false);
    if (group == groups.end()) group = groups.insert(group, Group{key, {}, {}, nullptr});
    group->origins.insert(result.origin);
    group->shards.emplace(shard.number, &result);
  }
  std::vector<RunResult> out;
  for (const Group& group : groups)
    out.push_back(group.whole ? *group.whole : merge(group.shards, std::get<4>(group.key)));
  return out;
}

}  // namespace evalcts::reports
