// Writes, reads and merges the results of shards.
#include "rounding_results.h"

#include <fmt/format.h>

#include <fstream>
#include <iostream>

namespace rounding {

using nlohmann::json;

namespace {

constexpr char kFormat[] = "glevaluator-rounding-1";

json to_json(const std::map<std::string, Result>& results, bool with_digest) {
  json out = json::object();
  for (const auto& [name, result] : results) {
    json& entry = out[name] = {{"values", result.values}, {"wrong", result.wrong}};
    if (with_digest) entry["digest"] = fmt::format("{:016x}", result.digest);
    if (result.wrong != 0) entry["first_wrong"] = {{"item", result.first_item}, {"text", result.first_wrong}};
  }
  return out;
}

Result result_from(const json& entry) {
  Result result;
  entry.at("values").get_to(result.values);
  entry.at("wrong").get_to(result.wrong);
  if (entry.contains("digest")) result.digest = std::stoull(entry["digest"].get<std::string>(), nullptr, 16);
  if (result.wrong == 0) return result;
  entry.at("first_wrong").at("item").get_to(result.first_item);
  entry.at("first_wrong").at("text").get_to(result.first_wrong);
  return result;
}

}  // namespace

json to_json(const Task& task, const std::map<std::string, Result>& results) {
  json what = {
      {"kind", task.kind}, {"version", GLEV_VERSION_STRING}, {"targets", task.targets}, {"seed", task.seed}};
  if (task.kind != "sweep") what["values"] = task.values;
  if (task.kind != "digest") what["filter"] = task.filter;
  if (task.kind == "sweep") what["interval"] = {task.from, task.to};
  return {{"format", kFormat},
          {"task", what},
          {"shard", task.shard},
          {"shards", task.shards},
          {"results", to_json(results, task.kind != "check")}};
}

json merged(const std::vector<std::string>& files) {
  json whole;
  std::map<std::string, Result> results;
  std::map<std::uint64_t, std::string> files_of_shards;
  for (const std::string& file : files) try {
      std::ifstream stream(file);
      const json part = json::parse(stream);
      if (part.at("format") != kFormat) throw WrongUse(file + ": its format is not " + kFormat);
      if (whole.is_null()) whole = part;
      for (const char* const same : {"task", "shards"})
        if (part.at(same) != whole.at(same))
          throw WrongUse(fmt::format("{} has the {} {}, but {} has {}; merge the shards of one task", file,
                                     same, part[same].dump(), files.front(), whole[same].dump()));
      const auto [earlier, is_new] = files_of_shards.emplace(part.at("shard"), file);
      if (!is_new)
        throw WrongUse(fmt::format("{} and {} are both shard {}; leave one of them out", earlier->second,
                                   file, earlier->first));
      for (const auto& [name, entry] : part.at("results").items()) results[name].add(result_from(entry));
    } catch (const WrongUse&) {
      throw;
    } catch (const std::exception&) {
      throw WrongUse(file + ": is not the result of a shard that has ended; run that shard again");
    }
  const std::uint64_t shards = whole["shards"];
  std::string missing;
  for (std::uint64_t shard = 1; shard <= shards; ++shard)
    if (!files_of_shards.contains(shard)) missing += fmt::format(" {}/{}", shard, shards);
  if (!missing.empty()) throw WrongUse("shards are missing:" + missing);
  whole["shard"] = whole["shards"] = 1;
  whole["results"] = to_json(results, whole["task"]["kind"] != "check");
  return whole;
}

int print(const json& result) {
  std::cout << result.dump(1) << std::endl;
  std::uint64_t values = 0, wrong = 0;
  for (const auto& [name, entry] : result.at("results").items()) {
    values += entry["values"].get<std::uint64_t>();
    wrong += entry["wrong"].get<std::uint64_t>();
    if (entry.contains("first_wrong"))
      std::cerr << name << ": " << entry["first_wrong"]["text"].get<std::string>() << "\n";
  }
  std::cerr << fmt::format("{} values, {} wrong\n", values, wrong);
  if (!std::cout) throw WrongUse("the result cannot be written");
  return wrong > 0 ? 1 : 0;
}

}  // namespace rounding
