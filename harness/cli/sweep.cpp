// `evalcts ulp --sweep`: every float of an interval, from where a checkpoint says that it ended.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <chrono>
#include <cmath>
#include <iostream>

#include "harness/accuracy/checkpoint.h"
#include "harness/accuracy/table.h"
#include "harness/cli/terminal.h"
#include "harness/cli/ulp.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// A sweep of another map gets another file.
std::string usual_name(const std::string& label, const json& identity) {
  const std::string text = identity.dump();
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("sweep-{}-{:08x}.json", label, crc.checksum());
}

std::string largest_in_words(const json& checkpoint, const char* which, const char* unit) {
  const json& largest = checkpoint["result"][which];
  if (largest.is_null()) return {};
  return fmt::format(
      "largest{}: {} {}, at {}: {} ({}), correctly rounded {} ({}); exact {}\n",
      checkpoint["proven"].get<bool>() ? " (proven)" : " so far",
      largest["error"].is_null() ? "inf" : fmt::format("{:.6g}", largest["error"].get<double>()), unit,
      largest["at"].get<std::string>(), largest["got"]["value"].get<std::string>(),
      largest["got"]["bits"].get<std::string>(), largest["right"]["value"].get<std::string>(),
      largest["right"]["bits"].get<std::string>(), largest["exact"].get<std::string>());
}

std::string in_words(const json& checkpoint) {
  const json& result = checkpoint["result"];
  const double values = std::max(1.0, result["values"].get<double>());
  const double seconds = checkpoint["seconds"];
  std::string text = fmt::format(
      "{} values: {} not correctly rounded ({:.4g} %), {} of them not finite where the right result is; {} "
      "of {} "
      "exact zeros wrong\n",
      result["values"].get<std::uint64_t>(), result["not_correctly_rounded"].get<std::uint64_t>(),
      100 * result["not_correctly_rounded"].get<double>() / values, result["not_finite"].get<std::uint64_t>(),
      result["zeros_wrong"].get<std::uint64_t>(), result["zeros"].get<std::uint64_t>());
  text += largest_in_words(checkpoint, "worst_ulp", "ULP");
  text += largest_in_words(checkpoint, "worst_condition_aware", "beside the condition");
  text += fmt::format("digest {}; {:.1f} s, {:.1f} million values a second, {} of them by the exact route\n",
                      result["digest"].get<std::string>(), seconds, values / seconds / 1e6,
                      result["decided_exactly"].get<std::uint64_t>());
  return text;
}

}  // namespace

int sweep(const UlpOptions& options) {
  const auto wrong_use = [](const std::string& words) {
    std::cerr << "evalcts: " << words << "\n";
    return kWrongUse;
  };
  if (const std::string wrong = wrong_points(options); !wrong.empty()) return wrong_use(wrong);
  if (options.orders.size() != 1 || !options.at.empty())
    return wrong_use("--sweep is for curves: --orders N, as many --points, and no --at");
  if (options.implementations.size() > 1) return wrong_use("--sweep is for one implementation");
  if (!options.targets.empty()) return wrong_use("--sweep defines TEXTURE_COORD_1: it takes no --target");
  if (!(options.from <= options.to) || !std::isfinite(options.from) || !std::isfinite(options.to))
    return wrong_use("--from and --to are finite floats, in this order");

  accuracy::SweepTask task{options.points, options.from, options.to};
  if (!options.shard.empty()) {
    const auto [number, count] = *shard_of(options.shard);
    task.shard = static_cast<std::int64_t>(number) - 1;
    task.shards = static_cast<std::int64_t>(count);
  }
  stop_when_asked();
  ProgressLine line;
  try {
    const accuracy::StreamSource source = accuracy::stream_source(implementation_of(options));
    if (source.info.max_eval_order > 0 && options.orders[0] > source.info.max_eval_order)
      return wrong_use(fmt::format("GL_MAX_EVAL_ORDER is {} there", source.info.max_eval_order));
    const json identity = accuracy::identity_of(task, source.info);
    const std::string label = options.label.empty() ? source.info.name : options.label;
    const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
    const fs::path file =
        options.checkpoint.empty() ? output / usual_name(label, identity) : fs::path(options.checkpoint);
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    if (access((file.has_parent_path() ? file.parent_path() : fs::path(".")).c_str(), W_OK) != 0)
      return wrong_use(fmt::format("cannot write {}", file.string()));

    accuracy::SweepState state{accuracy::BlockSet(task.blocks()), {}};
    double before = 0;
    if (fs::exists(file)) {
      accuracy::Resumed resumed = accuracy::read_checkpoint(file, task, identity);
      state = std::move(resumed.state);
      before = resumed.seconds;
      line.print(fmt::format("{}: {} of {} blocks were done before\n", file.string(), state.done.size(),
                             task.blocks_of_shard()));
    }
    line.print(fmt::format("{}: {} {}, order {}, control points {}, every float from {} to {}{}\n", label,
                           source.info.renderer, source.info.version, options.orders[0],
                           fmt::join(identity["points"].get<std::vector<std::string>>(), ","),
                           accuracy::hex(task.from), accuracy::hex(task.to),
                           task.shards > 1 ? ", shard " + options.shard : ""));
    const auto start = std::chrono::steady_clock::now();
    const std::int64_t done_before = state.done.size();
    const auto checkpoint_now = [&](const accuracy::SweepState& now) {
      const double here = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      json checkpoint = accuracy::checkpoint_of(task, identity, now, before + here);
      accuracy::write_checkpoint(file, checkpoint);
      const auto done = static_cast<double>(now.done.size() - done_before);
      const auto left = static_cast<double>(task.blocks_of_shard() - now.done.size());
      line.show("sweep",
                fmt::format("{:.1f} %, {:.1f} million values a second, {:.0f} s left",
                            100.0 * static_cast<double>(now.done.size()) /
                                static_cast<double>(std::max<std::int64_t>(1, task.blocks_of_shard())),
                            done * accuracy::kBlock / here / 1e6, done > 0 ? left * here / done : 0.0));
      return checkpoint;
    };
    if (state.done.size() < task.blocks_of_shard())
      accuracy::sweep(task, source, options.jobs.value_or(usual_jobs()), state, interrupted, checkpoint_now);
    const json last = accuracy::checkpoint_of(
        task, identity, state,
        before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    line.print(in_words(last));
    line.print(fmt::format("{}: {}\n", last["status"].get<std::string>(), file.string()));
    if (last["status"] == "complete") return kNothingUnexpected;
    std::cerr << "evalcts: interrupted; the same command goes on from there\n";
    return kWrongUse;
  } catch (const CannotStart& reason) {
    return wrong_use(reason.what());
  } catch (const NotObservable& reason) {
    return wrong_use(reason.what());
  } catch (const accuracy::BadCheckpoint& reason) {
    return wrong_use(reason.what());
  }
}

}  // namespace evalcts::cli
