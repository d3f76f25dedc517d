// Writes, reads and merges checkpoints of sweeps.
#include <evalcts/accuracy/checkpoint.h>

#include <fmt/format.h>

#include <boost/crc.hpp>

#include <reference/rounding.h>

#include <evalcts/accuracy/table.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/results/files.h>
#include "checkpoint_json.h"
#include "numbers.h"

namespace evalcts::accuracy {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "evalcts-sweep-1";

std::string checksum_of(const json& checkpoint) {
  const std::string text = checkpoint.dump();
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

json largest_as_json(const SweepTask& task, const SweepResult::Largest& found) {
  const std::optional<LargestError> largest = largest_error(task, found);
  if (!largest) return nullptr;
  json value = {{"error", number_as_json(largest->error)},
                {"at", hexadecimal(largest->at)},
                {"number", found.number},
                {"got", float_as_json(largest->got)},
                {"right", float_as_json(largest->right)},
                {"exact", largest->exact}};
  if (task.map.map.components > 1) value["component"] = found.component;
  return value;
}

SweepResult::Largest largest_from(const json& value) {
  if (value.is_null()) return {};
  return {number_from(value.at("error")), value.at("number").get<std::int64_t>(), float_from(value.at("got")),
          value.value("component", 0)};
}

// Returns the member "map", which the file omits for a plain curve (SweptMap::is_plain_curve).
json map_as_json(const SweptMap& map) {
  json value = {{"target", map.target}, {"components", map.map.components}, {"orders", {map.map.uorder}}};
  if (map.two_dimensional) {
    value["orders"].push_back(map.map.vorder);
    value["swept"] = map.along_v ? "v" : "u";
    value["other"] = hexadecimal(map.other);
  }
  return value;
}

SweptMap map_from(const json& checkpoint) {
  std::vector<double> points = hex_list_from(checkpoint.at("points"));
  if (!checkpoint.contains("map")) return points;
  const json& value = checkpoint.at("map");
  SweptMap map;
  value.at("target").get_to(map.target);
  value.at("components").get_to(map.map.components);
  value.at("orders").at(0).get_to(map.map.uorder);
  map.two_dimensional = value.at("orders").size() == 2;
  if (map.two_dimensional) {
    value.at("orders").at(1).get_to(map.map.vorder);
    map.along_v = as_text(value.at("swept")) == "v";
    map.other = static_cast<float>(hex_from(value.at("other")));
  }
  map.map.points = std::move(points);
  return map;
}

// Returns the JSON of a file without its checksum. Throws std::invalid_argument if the checksum does not
// match.
json read_whole(const std::filesystem::path& file) {
  json checkpoint = json::parse(read_file(file), nullptr, false);
  if (!checkpoint.is_object() || !checkpoint.contains("checksum"))
    throw std::invalid_argument("incomplete JSON");
  const json checksum = checkpoint["checksum"];
  checkpoint.erase("checksum");
  if (as_text(checksum) != checksum_of(checkpoint)) throw std::invalid_argument("its checksum is wrong");
  return checkpoint;
}

// Calls each(name, count) for the counts of a result, with their names in the file.
template <class Result, class Each>
void for_counts(Result& result, const Each& each) {
  each("values", result.values);
  each("decided_exactly", result.decided_exactly);
  each("not_correctly_rounded", result.not_correctly_rounded);
  each("not_finite", result.not_finite);
  each("zeros", result.zeros);
  each("zeros_wrong", result.zeros_wrong);
}

}  // namespace

namespace {

json to_json(const SweepIdentity& identity) {
  const SweepTask& task = identity.task;
  json implementation = {{"kind", identity.kind}};
  for (const auto& [name, value] : {std::pair{"library", &identity.library},
                                    {"vendor", &identity.vendor},
                                    {"renderer", &identity.renderer},
                                    {"version", &identity.gl_version}})
    if (!value->empty()) implementation[name] = *value;
  json out = {{"format", kFormat},
              {"evalcts_version", identity.evalcts_version},
              {"implementation", implementation},
              {"points", hex_as_json(task.map.map.points)},
              {"interval", {hexadecimal(task.from), hexadecimal(task.to)}},
              {"shard", fmt::format("{}/{}", task.shard + 1, task.shards)},
              {"block", kBlock}};
  if (!task.map.is_plain_curve()) out["map"] = map_as_json(task.map);
  return out;
}

// Throws json::exception, std::logic_error.
SweepIdentity identity_from(const json& checkpoint) {
  const json& implementation = checkpoint.at("implementation");
  const auto text = [&](const char* name) { return implementation.value(name, ""); };
  const json& interval = checkpoint.at("interval");
  SweepIdentity identity{checkpoint.at("evalcts_version"),
                         implementation.at("kind"),
                         text("library"),
                         text("vendor"),
                         text("renderer"),
                         text("version"),
                         {map_from(checkpoint), static_cast<float>(hex_from(interval.at(0))),
                          static_cast<float>(hex_from(interval.at(1)))}};
  const auto shard = checkpoint.at("shard").get<std::string>();
  const std::size_t slash = shard.find('/');
  SweepTask& task = identity.task;
  task.shard = std::stoll(shard.substr(0, slash)) - 1;
  task.shards = std::stoll(shard.substr(slash + 1));
  if (task.shards < 1 || task.shard < 0 || task.shard >= task.shards || checkpoint.at("block") != kBlock)
    throw std::invalid_argument("a shard or block that does not exist");
  return identity;
}

json to_json(const Checkpoint& checkpoint) {
  const SweepTask& task = checkpoint.identity.task;
  const SweepResult& found = checkpoint.state.result;
  json result = json::object();
  for_counts(found, [&](const char* name, std::uint64_t count) { result[name] = count; });
  result["histogram"] = found.histogram;
  result["worst_ulp"] = largest_as_json(task, found.ulp);
  result["worst_condition_aware"] = largest_as_json(task, found.condition_aware);
  result["digest"] = fmt::format("{:016x}", found.digest);
  json out = to_json(checkpoint.identity);
  out["status"] = checkpoint.status();
  out["proven"] = checkpoint.is_proven();
  out["blocks_done"] = checkpoint.state.done.ranges();
  out["result"] = result;
  out["seconds"] = checkpoint.seconds;
  return out;
}

}  // namespace

SweepIdentity identity_of(const SweepTask& task, const ImplementationInfo& info) {
  return {EVALCTS_VERSION, info.name, info.library, info.vendor, info.renderer, info.version, task};
}

std::string to_text(const SweepIdentity& identity) { return to_json(identity).dump(); }

std::optional<LargestError> largest_error(const SweepTask& task, const SweepResult::Largest& found) {
  if (found.error == 0) return std::nullopt;
  const float at = float_of(found.number);
  const reference::Rational exact = SweptPolynomial(task.map, found.component).exactly(at).value;
  return LargestError{found.error, at, found.got, reference::round_to_float(exact),
                      reference::describe(exact)};
}

bool Checkpoint::is_complete() const { return state.done.size() == identity.task.blocks_of_shard(); }

std::string with_checksum(json checkpoint) {
  checkpoint["checksum"] = checksum_of(checkpoint);
  return checkpoint.dump(1) + "\n";
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  write_atomically(file, with_checksum(to_json(checkpoint)));
}

namespace {

// Reads the finished blocks and the result. Throws json::exception, std::logic_error.
SweepState state_from(const json& checkpoint, const SweepTask& task) {
  SweepState state{BlockSet(task.blocks()), {}};
  for (const json& range : checkpoint.at("blocks_done"))
    for (auto block = range.at(0).get<std::int64_t>(); block <= range.at(1).get<std::int64_t>(); ++block) {
      if (block < 0 || block >= task.blocks() || !task.mine(block))
        throw std::invalid_argument("blocks that do not exist");
      state.done.insert(block);
    }
  const json& result = checkpoint.at("result");
  for_counts(state.result, [&](const char* name, std::uint64_t& count) { result.at(name).get_to(count); });
  result.at("histogram").get_to(state.result.histogram);
  state.result.ulp = largest_from(result.at("worst_ulp"));
  state.result.condition_aware = largest_from(result.at("worst_condition_aware"));
  state.result.digest = std::stoull(result.at("digest").get<std::string>(), nullptr, 16);
  return state;
}

}  // namespace

Checkpoint read_checkpoint(const std::filesystem::path& file, const SweepIdentity& identity) {
  json checkpoint;
  const auto damaged = [&](const char* how) {
    return BadCheckpoint(fmt::format(
        "{} is damaged ({}); it was not modified: move it away to start again, or name another file "
        "with --checkpoint",
        file.string(), how));
  };
  try {
    checkpoint = read_whole(file);
  } catch (const std::invalid_argument& problem) {
    throw damaged(problem.what());
  }
  const json asked = to_json(identity);
  for (const auto& [name, value] : asked.items())
    if (const json& other = checkpoint.value(name, json()); other != value)
      throw BadCheckpoint(
          fmt::format("{} is of another sweep: its {} is {}, not {}; name another file with --checkpoint, or "
                      "move it away",
                      file.string(), name, other.dump(), value.dump()));
  // A file with an additional member belongs to another sweep, too.
  if (checkpoint.contains("map") && !asked.contains("map"))
    throw BadCheckpoint(
        fmt::format("{} is of another sweep: of another kind of map; name another file with "
                    "--checkpoint, or move it away",
                    file.string()));
  try {
    return {identity, state_from(checkpoint, identity.task), checkpoint.at("seconds").get<double>()};
  } catch (const json::exception& problem) {
    throw damaged(problem.what());
  } catch (const std::logic_error& problem) {
    throw damaged(problem.what());
  }
}

Checkpoint merged(const std::vector<std::filesystem::path>& files) {
  std::optional<Checkpoint> whole;  // identity of the first file, but without shards
  json first;
  std::vector<bool> seen;
  for (const std::filesystem::path& file : files) {
    const auto rejected = [&](const std::string& why) {
      return BadCheckpoint(fmt::format("{} {}; nothing was written", file.string(), why));
    };
    try {
      const json checkpoint = read_whole(file);
      if (checkpoint.value("format", "") != kFormat) throw rejected("is not a sweep");
      const SweepIdentity own = identity_from(checkpoint);
      const SweepState part = state_from(checkpoint, own.task);
      if (part.done.size() != own.task.blocks_of_shard())
        throw rejected("is unfinished: run its command again to complete it");
      const std::string shard = checkpoint.at("shard");
      if (!whole) {
        first = checkpoint;
        seen.assign(static_cast<std::size_t>(own.task.shards), false);
        whole.emplace(Checkpoint{own, {BlockSet(own.task.blocks()), {}}, 0});
        whole->identity.task.shard = 0;
        whole->identity.task.shards = 1;
      }
      for (const char* name :
           {"format", "evalcts_version", "implementation", "points", "map", "interval", "block"})
        if (checkpoint.value(name, json()) != first.value(name, json()))
          throw rejected(fmt::format("is of another sweep: its {} is {}, not {}", name,
                                     checkpoint.value(name, json()).dump(),
                                     first.value(name, json()).dump()));
      if (own.task.shards != static_cast<std::int64_t>(seen.size()))
        throw rejected(fmt::format("is shard {}, but the others are of {}", shard, seen.size()));
      if (seen[static_cast<std::size_t>(own.task.shard)])
        throw rejected(fmt::format("is shard {} a second time", shard));
      seen[static_cast<std::size_t>(own.task.shard)] = true;
      for (std::int64_t block = 0; block < own.task.blocks(); ++block)
        if (part.done.contains(block)) whole->state.done.insert(block);
      whole->state.result.add(part.result);
      whole->seconds += checkpoint.at("seconds").get<double>();
    } catch (const json::exception& problem) {
      throw rejected(fmt::format("is damaged ({})", problem.what()));
    } catch (const std::logic_error& problem) {
      throw rejected(fmt::format("is damaged ({})", problem.what()));
    }
  }
  std::string missing;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!seen[i]) missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", i + 1, seen.size());
  if (!missing.empty())
    throw BadCheckpoint(fmt::format("shards are missing: {}; nothing was written", missing));
  return *std::move(whole);
}

}  // namespace evalcts::accuracy
