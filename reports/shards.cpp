#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <tuple>

#include "evalcts/reports.h"
#include "reports/record.h"
#include "reports/text.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

struct Shard {
  std::uint32_t number = 0, count = 0;  // from 1
};

// What stands in the file names, too: nobody has a million machines.
Shard read_shard(const std::string& text) {
  const auto bad = [&text] { return FormatError(fmt::format("shard: \"{}\" is no K-of-N", text)); };
  const std::size_t of = text.find("-of-");
  if (of == std::string::npos) throw bad();
  Shard shard;
  const char *const middle = text.data() + of, *const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), middle, shard.number);
  const auto count = std::from_chars(middle + 4, end, shard.count);
  if (number.ec != std::errc() || number.ptr != middle || count.ec != std::errc() || count.ptr != end ||
      shard.number < 1 || shard.number > shard.count || shard.count > 1'000'000)
    throw bad();
  return shard;
}

// Of the shards of one run, by number.
using Shards = std::map<std::uint32_t, const json*>;

// The K-th shard has every N-th test from the K-th on.
json tests_in_order(const Shards& shards) {
  json tests = json::array();
  bool more = true;
  for (std::size_t i = 0; more; ++i) {
    more = false;
    for (const auto& [number, shard] : shards) {
      const auto found = shard->find("tests");
      if (found == shard->end() || i >= found->size()) continue;
      tests.push_back((*found)[i]);
      more = true;
    }
  }
  return tests;
}

json merge(const Shards& shards, std::uint32_t count) {
  // One that has started knows the library.
  const auto started = std::find_if(shards.begin(), shards.end(), [](const auto& shard) {
    return shard.second->value("status", "") != "not-started";
  });
  json out = *(started == shards.end() ? shards.begin() : started)->second;
  const Record first = read_record(out);
  out.erase("shard");
  if (started != shards.end()) out["status"] = "complete";
  out["reason"] = "";
  std::map<std::string, std::set<std::string>> readings;
  std::set<std::string> stale;
  for (const auto& [number, shard] : shards) {
    const Record record = read_record(*shard);
    for (const auto member : {&Implementation::vendor, &Implementation::renderer, &Implementation::version})
      if (record.implementation.*member != first.implementation.*member && record.status != "not-started")
        throw FormatError(fmt::format("the shards of {} judged different libraries: \"{}\" and \"{}\"",
                                      record.heading("(unnamed)"), first.implementation.*member,
                                      record.implementation.*member));
    for (const auto& [text, followed] : record.readings)
      readings[text].insert(followed.begin(), followed.end());
    stale.insert(record.stale_baseline_entries.begin(), record.stale_baseline_entries.end());
    if (!record.complete() && out["reason"].get<std::string>().empty()) {
      if (started != shards.end()) out["status"] = "interrupted";
      out["reason"] = fmt::format("shard {} of {}: {}", number, count,
                                  record.reason.empty() ? "not complete" : record.reason);
    }
  }
  out["tests"] = tests_in_order(shards);
  json summary = json::object();
  for (const json& test : out["tests"]) {
    const std::string verdict = test.value("verdict", "internal-error");
    summary[verdict] = summary.value(verdict, 0) + 1;
  }
  out["summary"] = summary;
  out.erase("readings");
  if (!readings.empty()) out["readings"] = readings;
  out.erase("stale_baseline_entries");
  if (!stale.empty()) out["stale_baseline_entries"] = stale;

  std::vector<std::string> missing;
  for (std::uint32_t number = 1; number <= count && missing.size() < 20; ++number)
    if (!shards.contains(number)) missing.push_back(std::to_string(number));
  if (!missing.empty()) {
    out["status"] = "interrupted";
    out["reason"] = fmt::format("of {} shards these are missing: {}{}", count, join(missing, ", "),
                                shards.size() + missing.size() < count ? ", ..." : "");
  }
  return out;
}

}  // namespace

std::vector<json> merge_shards(const std::vector<json>& results) {
  // A record that is whole is a group of its own.
  using Key = std::tuple<std::string, std::string, std::string, std::uint64_t, std::uint32_t>;
  struct Group {
    Key key;
    std::set<std::string> origins;
    Shards shards;
    const json* whole = nullptr;
  };
  std::vector<Group> groups;
  for (const json& result : results) {
    const Record record = read_record(result);
    if (record.shard.empty()) {
      groups.push_back({{}, {}, {}, &result});
      continue;
    }
    const Shard shard = read_shard(record.shard);
    const Key key{record.implementation.name, record.pass, record.depth, record.seed.value_or(0),
                  shard.count};
    // Each shard may come from a folder of its own, but what comes from one folder belongs together.
    const auto find = [&](bool same_origin) {
      return std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
        return !group.whole && group.key == key && !group.shards.contains(shard.number) &&
               group.origins.contains(record.origin) == same_origin;
      });
    };
    auto group = find(true);
    if (group == groups.end()) group = find(false);
    if (group == groups.end()) group = groups.insert(group, Group{key, {}, {}, nullptr});
    group->origins.insert(record.origin);
    group->shards.emplace(shard.number, &result);
  }
  std::vector<json> out;
  for (const Group& group : groups)
    out.push_back(group.whole ? *group.whole : merge(group.shards, std::get<4>(group.key)));
  return out;
}

}  // namespace evalcts::reports
