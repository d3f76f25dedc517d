#include "harness/accuracy/checkpoint.h"

#include <fmt/format.h>

#include <bit>
#include <boost/crc.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include <reference/bernstein_form.h>
#include <reference/rounding.h>

#include "harness/accuracy/table.h"
#include "harness/runner/runner.h"

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
  const reference::Curve curve = {task.points.data(), 1, static_cast<int>(task.points.size()), 0, 1};
  const reference::Rational exact = reference::evaluate(curve, reference::Argument::coordinate(u));
  const float right = reference::round_to_float(exact);
  return {{"error", std::isfinite(largest.error) ? json(largest.error) : json(nullptr)},
          {"at", hex(u)},
          {"number", largest.number},
          {"got", {{"value", hex(largest.got)}, {"bits", bits(largest.got)}}},
          {"right", {{"value", hex(right)}, {"bits", bits(right)}}},
          {"exact", reference::describe(exact)}};
}

SweepResult::Largest largest_from(const json& value) {
  if (value.is_null()) return {};
  const auto number = value.at("got").at("bits").get<std::string>();
  return {
      value.at("error").is_null() ? std::numeric_limits<double>::infinity() : value.at("error").get<double>(),
      value.at("number").get<std::int64_t>(),
      std::bit_cast<float>(static_cast<std::uint32_t>(std::stoul(number, nullptr, 16)))};
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
  return {{"format", "evalcts-sweep-1"},
          {"evalcts_version", EVALCTS_VERSION},
          {"implementation", implementation},
          {"points", hex_points(task.points)},
          {"interval", {hex(task.from), hex(task.to)}},
          {"shard", fmt::format("{}/{}", task.shard + 1, task.shards)},
          {"block", kBlock}};
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

Resumed read_checkpoint(const std::filesystem::path& file, const SweepTask& task, const json& identity) {
  const auto damaged = [&](const std::string& how) {
    return BadCheckpoint(fmt::format(
        "{} is damaged ({}); it is left as it is: move it away to begin anew, or name another file "
        "with --checkpoint",
        file.string(), how));
  };
  std::ifstream stream(file, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  json checkpoint = json::parse(content, nullptr, false);
  if (!checkpoint.is_object() || !checkpoint.contains("checksum")) throw damaged("no whole JSON");
  const json checksum = checkpoint["checksum"];
  checkpoint.erase("checksum");
  if (checksum != checksum_of(checkpoint)) throw damaged("its checksum does not fit");
  for (const auto& [name, value] : identity.items())
    if (const json& other = checkpoint.value(name, json()); other != value)
      throw BadCheckpoint(
          fmt::format("{} is of another sweep: its {} is {}, not {}; name another file with --checkpoint, or "
                      "move it away",
                      file.string(), name, other.dump(), value.dump()));
  try {
    Resumed resumed{{BlockSet(task.blocks()), {}}, checkpoint.at("seconds").get<double>()};
    for (const json& range : checkpoint.at("blocks_done"))
      for (auto block = range.at(0).get<std::int64_t>(); block <= range.at(1).get<std::int64_t>(); ++block) {
        if (block < 0 || block >= task.blocks() || !task.mine(block))
          throw damaged("blocks that there are not");
        resumed.state.done.insert(block);
      }
    const json& result = checkpoint.at("result");
    for_counts(resumed.state.result,
               [&](const char* name, std::uint64_t& count) { result.at(name).get_to(count); });
    result.at("histogram").get_to(resumed.state.result.histogram);
    resumed.state.result.ulp = largest_from(result.at("worst_ulp"));
    resumed.state.result.condition_aware = largest_from(result.at("worst_condition_aware"));
    resumed.state.result.digest = std::stoull(result.at("digest").get<std::string>(), nullptr, 16);
    return resumed;
  } catch (const json::exception& problem) {
    throw damaged(problem.what());
  } catch (const std::logic_error& problem) {
    throw damaged(problem.what());
  }
}

}  // namespace evalcts::accuracy
