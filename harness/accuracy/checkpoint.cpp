#include <evalcts/accuracy/checkpoint.h>

#include <fmt/format.h>

#include <bit>
#include <boost/crc.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <reference/rounding.h>

#include <evalcts/accuracy/table.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/interruption.h>

namespace evalcts::accuracy {
namespace {

using nlohmann::json;

std::string checksum_of(const json& checkpoint) {
  const std::string text = checkpoint.dump();
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

json hex_points(const std::vector<double>& points) {
  json all = json::array();
  for (const double point : points) all.push_back(hex(point));
  return all;
}

json largest_as_json(const SweepTask& task, const SweepResult::Largest& largest) {
  if (largest.error == 0) return nullptr;
  const float u = float_of(largest.number);
  const reference::Rational exact = SweptPolynomial(task.map, largest.component).exactly(u).value;
  const float right = reference::round_to_float(exact);
  json value = {{"error", std::isfinite(largest.error) ? json(largest.error) : json(nullptr)},
                {"at", hex(u)},
                {"number", largest.number},
                {"got", {{"value", hex(largest.got)}, {"bits", bits(largest.got)}}},
                {"right", {{"value", hex(right)}, {"bits", bits(right)}}},
                {"exact", reference::describe(exact)}};
  if (task.map.map.components > 1) value["component"] = largest.component;
  return value;
}

SweepResult::Largest largest_from(const json& value) {
  if (value.is_null()) return {};
  const auto number = value.at("got").at("bits").get<std::string>();
  return {
      value.at("error").is_null() ? std::numeric_limits<double>::infinity() : value.at("error").get<double>(),
      value.at("number").get<std::int64_t>(),
      std::bit_cast<float>(static_cast<std::uint32_t>(std::stoul(number, nullptr, 16))),
      value.value("component", 0)};
}

// Nothing of what is a curve of one component as texture coordinate.
json map_as_json(const SweptMap& map) {
  json value = {{"target", map.target}, {"components", map.map.components}, {"orders", {map.map.uorder}}};
  if (map.two_dimensional) {
    value["orders"].push_back(map.map.vorder);
    value["swept"] = map.along_v ? "v" : "u";
    value["other"] = hex(map.other);
  }
  return value;
}

// strtod, since std::stod refuses subnormal numbers.
double number_from(const json& value) {
  const auto text = value.get<std::string>();
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw std::invalid_argument("no number: " + text);
  return x;
}

SweptMap map_from(const json& checkpoint) {
  std::vector<double> points;
  for (const json& point : checkpoint.at("points")) points.push_back(number_from(point));
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
    map.other = static_cast<float>(number_from(value.at("other")));
  }
  map.map.points = std::move(points);
  return map;
}

// Its JSON without the checksum, which fits.
json read_whole(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  json checkpoint = json::parse(content, nullptr, false);
  if (!checkpoint.is_object() || !checkpoint.contains("checksum"))
    throw std::invalid_argument("no whole JSON");
  const json checksum = checkpoint["checksum"];
  checkpoint.erase("checksum");
  if (as_text(checksum) != checksum_of(checkpoint)) throw std::invalid_argument("its checksum does not fit");
  return checkpoint;
}

// The names of the counts in a file.
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

json identity_of(const SweepTask& task, const ImplementationInfo& info) {
  json implementation = {{"kind", info.name}};
  for (const auto& [name, value] : {std::pair{"library", &info.library},
                                    {"vendor", &info.vendor},
                                    {"renderer", &info.renderer},
                                    {"version", &info.version}})
    if (!value->empty()) implementation[name] = *value;
  json identity = {{"format", "evalcts-sweep-1"},
                   {"evalcts_version", EVALCTS_VERSION},
                   {"implementation", implementation},
                   {"points", hex_points(task.map.map.points)},
                   {"interval", {hex(task.from), hex(task.to)}},
                   {"shard", fmt::format("{}/{}", task.shard + 1, task.shards)},
                   {"block", kBlock}};
  if (!task.map.is_plain_curve()) identity["map"] = map_as_json(task.map);
  return identity;
}

json checkpoint_of(const SweepTask& task, const json& identity, const SweepState& state, double seconds) {
  const bool complete = state.done.size() == task.blocks_of_shard();
  json result = json::object();
  for_counts(state.result, [&](const char* name, std::uint64_t count) { result[name] = count; });
  result["histogram"] = state.result.histogram;
  result["worst_ulp"] = largest_as_json(task, state.result.ulp);
  result["worst_condition_aware"] = largest_as_json(task, state.result.condition_aware);
  result["digest"] = fmt::format("{:016x}", state.result.digest);
  json checkpoint = identity;
  checkpoint["status"] = complete ? "complete" : "unfinished";
  checkpoint["proven"] = complete && task.shards == 1;
  checkpoint["blocks_done"] = state.done.ranges();
  checkpoint["result"] = result;
  checkpoint["seconds"] = seconds;
  return checkpoint;
}

void write_checkpoint(const std::filesystem::path& file, json checkpoint) {
  checkpoint["checksum"] = checksum_of(checkpoint);
  write_atomically(file, checkpoint.dump(1) + "\n");
}

namespace {

// The blocks and the result. Throws json::exception, std::logic_error.
SweepState state_from(const json& checkpoint, const SweepTask& task) {
  SweepState state{BlockSet(task.blocks()), {}};
  for (const json& range : checkpoint.at("blocks_done"))
    for (auto block = range.at(0).get<std::int64_t>(); block <= range.at(1).get<std::int64_t>(); ++block) {
      if (block < 0 || block >= task.blocks() || !task.mine(block))
        throw std::invalid_argument("blocks that there are not");
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

Resumed read_checkpoint(const std::filesystem::path& file, const SweepTask& task, const json& identity) {
  json checkpoint;
  const auto damaged = [&](const char* how) {
    return BadCheckpoint(fmt::format(
        "{} is damaged ({}); it is left as it is: move it away to begin anew, or name another file "
        "with --checkpoint",
        file.string(), how));
  };
  try {
    checkpoint = read_whole(file);
  } catch (const std::invalid_argument& problem) {
    throw damaged(problem.what());
  }
  for (const auto& [name, value] : identity.items())
    if (const json& other = checkpoint.value(name, json()); other != value)
      throw BadCheckpoint(
          fmt::format("{} is of another sweep: its {} is {}, not {}; name another file with --checkpoint, or "
                      "move it away",
                      file.string(), name, other.dump(), value.dump()));
  // What is now only in the file.
  if (checkpoint.contains("map") && !identity.contains("map"))
    throw BadCheckpoint(
        fmt::format("{} is of another sweep: of another kind of map; name another file with "
                    "--checkpoint, or move it away",
                    file.string()));
  try {
    return {state_from(checkpoint, task), checkpoint.at("seconds").get<double>()};
  } catch (const json::exception& problem) {
    throw damaged(problem.what());
  } catch (const std::logic_error& problem) {
    throw damaged(problem.what());
  }
}

json merged(const std::vector<std::filesystem::path>& files) {
  json whole;  // of the first, as if it were the only one
  SweepTask task;
  std::optional<SweepState> state;
  double seconds = 0;
  std::vector<bool> seen;
  for (const std::filesystem::path& file : files) {
    const auto refused = [&](const std::string& why) {
      return BadCheckpoint(fmt::format("{} {}; nothing was written", file.string(), why));
    };
    try {
      const json checkpoint = read_whole(file);
      if (checkpoint.value("format", "") != "evalcts-sweep-1") throw refused("is no sweep");
      SweepTask own{map_from(checkpoint), static_cast<float>(number_from(checkpoint.at("interval").at(0))),
                    static_cast<float>(number_from(checkpoint.at("interval").at(1)))};
      const auto shard = checkpoint.at("shard").get<std::string>();
      const std::size_t slash = shard.find('/');
      own.shard = std::stoll(shard.substr(0, slash)) - 1;
      own.shards = std::stoll(shard.substr(slash + 1));
      if (own.shards < 1 || own.shard < 0 || own.shard >= own.shards || checkpoint.at("block") != kBlock)
        throw std::invalid_argument("a shard or block that there is not");
      SweepState part = state_from(checkpoint, own);
      if (part.done.size() != own.blocks_of_shard())
        throw refused("is unfinished: its command goes on with it");
      json identity;
      for (const char* name :
           {"format", "evalcts_version", "implementation", "points", "map", "interval", "block"})
        if (checkpoint.contains(name)) identity[name] = checkpoint[name];
      if (!state) {
        whole = identity;
        task = own;
        task.shard = 0;
        task.shards = 1;
        seen.assign(static_cast<std::size_t>(own.shards), false);
        state.emplace(SweepState{BlockSet(task.blocks()), {}});
      }
      for (const char* name :
           {"format", "evalcts_version", "implementation", "points", "map", "interval", "block"})
        if (identity.value(name, json()) != whole.value(name, json()))
          throw refused(fmt::format("is of another sweep: its {} is {}, not {}", name,
                                    identity.value(name, json()).dump(), whole.value(name, json()).dump()));
      if (own.shards != static_cast<std::int64_t>(seen.size()))
        throw refused(fmt::format("is shard {}: the others are of {}", shard, seen.size()));
      if (seen[static_cast<std::size_t>(own.shard)])
        throw refused(fmt::format("is shard {} once more", shard));
      seen[static_cast<std::size_t>(own.shard)] = true;
      for (std::int64_t block = 0; block < task.blocks(); ++block)
        if (part.done.contains(block)) state->done.insert(block);
      state->result.add(part.result);
      seconds += checkpoint.at("seconds").get<double>();
    } catch (const json::exception& problem) {
      throw refused(fmt::format("is damaged ({})", problem.what()));
    } catch (const std::logic_error& problem) {
      throw refused(fmt::format("is damaged ({})", problem.what()));
    }
  }
  std::string missing;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!seen[i]) missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", i + 1, seen.size());
  if (!missing.empty())
    throw BadCheckpoint(fmt::format("shards are missing: {}; nothing was written", missing));
  whole["shard"] = "1/1";
  return checkpoint_of(task, whole, *state, seconds);
}

}  // namespace evalcts::accuracy
