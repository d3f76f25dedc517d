// `evalcts ulp --sweep`: every float of an interval, from where a checkpoint says that it ended; in one
// process or in several. `evalcts ulp --merge`: the shards of a sweep together.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <variant>

#include <reference/bernstein.h>

#include <evalcts/accuracy/checkpoint.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/results/files.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include "places.h"
#include "terminal.h"
#include "ulp.h"
#include "world.h"

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

// `ulp` and `condition_aware`: what follows the largest errors.
std::string sweep_in_words(const json& checkpoint, const std::string& ulp,
                           const std::string& condition_aware) {
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
  text += largest_in_words(checkpoint, "worst_ulp", "ULP") + ulp;
  text += largest_in_words(checkpoint, "worst_condition_aware", "beside the condition") + condition_aware;
  text += fmt::format("digest {}; {:.1f} s, {:.1f} million values a second, {} of them by the exact route\n",
                      result["digest"].get<std::string>(), seconds, values / seconds / 1e6,
                      result["decided_exactly"].get<std::uint64_t>());
  return text;
}

// The command that evaluates the input of an error again.
std::string replay_line(const UlpOptions& options, const accuracy::SweepTask& task, const json& largest) {
  if (largest.is_null()) return {};
  const accuracy::Map& map = task.map.map;
  std::vector<std::string> command = {options.program, "ulp"}, points, orders = {std::to_string(map.uorder)};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.insert(command.end(), {option, value});
  };
  if (task.map.two_dimensional) orders.push_back(std::to_string(map.vorder));
  for (std::size_t i = largest.value("component", 0); i < map.points.size(); i += map.components)
    points.push_back(accuracy::hex(map.points[i]));
  const std::string at = largest["at"], other = accuracy::hex(task.map.other);
  add("--implementation", implementation_of(options).name);
  add("--library", options.library.empty() ? "" : fs::absolute(options.library).lexically_normal().string());
  add("--context", options.context);
  add("--target", task.map.target);
  add("--orders", fmt::format("{}", fmt::join(orders, ",")));
  command.push_back(fmt::format("--points={}", fmt::join(points, ",")));
  command.push_back("--at=" + (!task.map.two_dimensional ? at
                               : task.map.along_v        ? other + "," + at
                                                         : at + "," + other));
  return "  " + shell_line(command) + "\n";
}

// The map of the options; a message where there is none.
std::variant<accuracy::SweptMap, std::string> map_of(const UlpOptions& options) {
  std::size_t product = 1;
  for (const int order : options.orders) product *= static_cast<std::size_t>(std::max(order, 0));
  UlpOptions one_component = options;  // for what is said of all of them
  one_component.points.resize(std::min<std::size_t>(product, reference::kMaxOrder * reference::kMaxOrder));
  if (options.orders.empty() || options.points.empty() ||
      options.points.size() % std::max<std::size_t>(product, 1) != 0)
    return "--sweep has --orders N or N,M, and as many --points for each component";
  if (const std::string wrong = wrong_points(one_component); !wrong.empty()) return wrong;
  for (const double x : options.points)
    if (static_cast<double>(static_cast<float>(x)) != x || !std::isfinite(x))
      return fmt::format("{:a} is no finite float", x);

  accuracy::SweptMap map;
  map.two_dimensional = options.orders.size() == 2;
  if (options.targets.size() > 1) return "--sweep is for one --target";
  const std::size_t given = options.points.size() / product;
  if (!options.targets.empty()) {
    map.target = options.targets.front();
  } else if (given <= 4) {
    map.target = fmt::format("texture_coord_{}", given);
  }
  map.map.components = gl::components_of(accuracy::target_of(map.target, map.two_dimensional));
  map.map.uorder = options.orders[0];
  if (map.two_dimensional) map.map.vorder = options.orders[1];
  if (given != 1 && given != static_cast<std::size_t>(map.map.components))
    return fmt::format("{} has {} components: --points are one number for each control point, or so many",
                       map.target, map.map.components);
  map.map.points = options.points;
  if (given == 1) {  // all components alike
    map.map.points.clear();
    for (const double x : options.points) map.map.points.insert(map.map.points.end(), map.map.components, x);
  }
  if (map.two_dimensional != (options.fixed_u || options.fixed_v) || (options.fixed_u && options.fixed_v))
    return "a surface is swept along one argument: --u or --v says where the other one stands; a curve has "
           "none";
  map.along_v = options.fixed_u.has_value();
  map.other = map.along_v ? *options.fixed_u : options.fixed_v.value_or(0);
  if (!std::isfinite(map.other)) return "--u and --v are finite floats";
  return map;
}

// What the environment says of its processes, this program cannot do: the one that can takes its place.
std::string become_mpi_program() {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "evalcts-mpi";
  if (!fs::exists(program))
    return "mpirun has started several of these, and this evalcts was built without MPI: install "
           "libopenmpi-dev and "
           "openmpi-bin, and build it anew";
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  return "cannot start " + program.string();
}

int number_in(const char* variable) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? 0 : std::atoi(value);
}

}  // namespace

std::unique_ptr<World> (*join_world)() = nullptr;

int processes_of_environment() {
  int most = 1;
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    most = std::max(most, number_in(variable));
  return most;
}

int merge(const UlpOptions& options) {
  try {
    std::vector<fs::path> files(options.merge.begin(), options.merge.end());
    const json whole = accuracy::merged(files);
    const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
    const std::string label =
        options.label.empty() ? whole["implementation"]["kind"].get<std::string>() : options.label;
    json identity = whole;
    for (const char* name : {"status", "proven", "blocks_done", "result", "seconds"}) identity.erase(name);
    const fs::path file =
        options.checkpoint.empty() ? output / usual_name(label, identity) : fs::path(options.checkpoint);
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    if (fs::exists(file)) {
      std::cerr << fmt::format(
          "evalcts: {} is there already: move it away, or name another file with --checkpoint\n",
          file.string());
      return kWrongUse;
    }
    accuracy::write_checkpoint(file, whole);
    std::cout << sweep_in_words(whole, {}, {}) << fmt::format("complete: {}\n", file.string());
    return kNothingUnexpected;
  } catch (const std::runtime_error& problem) {
    std::cerr << fmt::format("evalcts: {}\n", problem.what());
    return kWrongUse;
  }
}

int sweep(const UlpOptions& options) {
  if (join_world == nullptr && processes_of_environment() > 1) {
    const std::string why_not = become_mpi_program();
    std::cerr << fmt::format("evalcts: {}\n", why_not);
    return kWrongUse;
  }
  std::unique_ptr<World> world;
  const auto wrong_use = [&](const std::string& words) {
    if (!world || world->rank() == 0) std::cerr << "evalcts: " << words << "\n";
    return kWrongUse;
  };
  try {
    if (join_world != nullptr) world = join_world();
  } catch (const CannotStart& reason) {
    return wrong_use(reason.what());
  }
  // What is wrong here is wrong in every process.
  auto map = map_of(options);
  if (const auto* const wrong = std::get_if<std::string>(&map)) return wrong_use(*wrong);
  if (!options.at.empty()) return wrong_use("--sweep has no --at: it goes --from one float --to another");
  if (options.implementations.size() > 1) return wrong_use("--sweep is for one implementation");
  if (!(options.from <= options.to) || !std::isfinite(options.from) || !std::isfinite(options.to))
    return wrong_use("--from and --to are finite floats, in this order");

  accuracy::SweepTask task{std::get<accuracy::SweptMap>(std::move(map)), options.from, options.to};
  if (!options.shard.empty()) {
    const Shard shard = *Shard::parse(options.shard, "/");
    task.shard = shard.number - 1;
    task.shards = shard.count;
  }
  const int jobs = options.jobs.value_or(world && world->size() > 1 ? 1 : usual_jobs());
  stop_when_asked();
  if (world && world->rank() > 0) {
    world->serve(
        task, [&] { return accuracy::stream_source(implementation_of(options)); }, jobs);
    return kNothingUnexpected;
  }
  // The others wait for orders, whatever happens here.
  struct Dismissal {
    World* others;
    ~Dismissal() {
      if (others != nullptr) others->dismiss();
    }
  } dismissal{world.get()};
  ProgressLine line;
  try {
    const accuracy::StreamSource source = accuracy::stream_source(implementation_of(options));
    if (source.info.max_eval_order > 0 &&
        *std::max_element(options.orders.begin(), options.orders.end()) > source.info.max_eval_order)
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
    line.print(
        fmt::format("{}: {} {}, {}order {}, control points {}, every float from {} to {}{}{}\n", label,
                    clean(source.info.renderer), clean(source.info.version),
                    task.map.is_plain_curve() ? "" : task.map.target + ", ", fmt::join(options.orders, " x "),
                    fmt::join(identity["points"].get<std::vector<std::string>>(), ","),
                    accuracy::hex(task.from), accuracy::hex(task.to),
                    !task.map.two_dimensional ? ""
                    : task.map.along_v        ? " for v, u = " + accuracy::hex(task.map.other)
                                              : " for u, v = " + accuracy::hex(task.map.other),
                    (task.shards > 1 ? ", shard " + options.shard : "") +
                        (world && world->size() > 1 ? fmt::format(", {} processes", world->size()) : "")));
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
    if (state.done.size() < task.blocks_of_shard()) {
      if (world) {
        dismissal.others = nullptr;
        world->lead(task, identity, source, jobs, state, interrupted, checkpoint_now);
      } else {
        accuracy::sweep(task, source, jobs, state, interrupted, checkpoint_now);
      }
    }
    const json last = accuracy::checkpoint_of(
        task, identity, state,
        before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    line.print(sweep_in_words(last, replay_line(options, task, last["result"]["worst_ulp"]),
                              replay_line(options, task, last["result"]["worst_condition_aware"])));
    line.print(fmt::format("{}: {}\n", last["status"].get<std::string>(), file.string()));
    if (as_text(last["status"]) == "complete") return kNothingUnexpected;
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
