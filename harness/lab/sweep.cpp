// `evalcts ulp --sweep`: evaluates at every float of an interval, resumes from a checkpoint, and may use
// several processes. `evalcts ulp --merge`: merges the shards of a sweep.
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
#include <utility>
#include <variant>

#include <reference/bernstein.h>

#include <evalcts/accuracy/checkpoint.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/results/files.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include "ulp.h"
#include "world.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

// Returns the checkpoint file of the options. By default, its name contains a checksum of the identity, so
// that sweeps of different maps have different files.
fs::path file_of(const UlpOptions& options, const accuracy::SweepIdentity& identity) {
  if (!options.checkpoint.empty()) return options.checkpoint;
  const std::string text = accuracy::to_text(identity);
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return (options.output.empty() ? places().output : fs::path(options.output)) /
         fmt::format("sweep-{}-{:08x}.json", options.label.empty() ? identity.kind : options.label,
                     crc.checksum());
}

// Returns the command that evaluates the input of an error again.
std::string replay_line(const UlpOptions& options, const accuracy::SweepTask& task, int component, float at) {
  const accuracy::Map& map = task.map.map;
  std::vector<std::string> command = {options.program, "ulp"}, points, orders = {std::to_string(map.uorder)};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.insert(command.end(), {option, value});
  };
  if (task.map.two_dimensional) orders.push_back(std::to_string(map.vorder));
  for (std::size_t i = static_cast<std::size_t>(component); i < map.points.size(); i += map.components)
    points.push_back(hexadecimal(map.points[i]));
  const std::string swept = hexadecimal(at), other = hexadecimal(task.map.other);
  add("--implementation", implementation_of(options).name);
  add("--library", options.library.empty() ? "" : fs::absolute(options.library).lexically_normal().string());
  add("--context", options.context);
  add("--target", task.map.target);
  add("--orders", fmt::format("{}", fmt::join(orders, ",")));
  command.push_back(fmt::format("--points={}", fmt::join(points, ",")));
  command.push_back("--at=" + (!task.map.two_dimensional ? swept
                               : task.map.along_v        ? other + "," + swept
                                                         : swept + "," + other));
  return "  " + shell_line(command) + "\n";
}

// Returns a description of a largest error, followed by the command that reproduces it if `options`
// is not null.
std::string in_words(const accuracy::Checkpoint& sweep, const accuracy::SweepResult::Largest& found,
                     const char* unit, const UlpOptions* options) {
  const auto largest = accuracy::largest_error(sweep.identity.task, found);
  if (!largest) return {};
  using accuracy::bits;
  return fmt::format("largest{}: {:.6g} {}, at {}: {} ({}), correctly rounded {} ({}); exact {}\n{}",
                     sweep.is_proven() ? " (proven)" : " so far", largest->error, unit,
                     hexadecimal(largest->at), hexadecimal(largest->got), bits(largest->got),
                     hexadecimal(largest->right), bits(largest->right), largest->exact,
                     options ? replay_line(*options, sweep.identity.task, found.component, largest->at) : "");
}

std::string in_words(const accuracy::Checkpoint& sweep, const UlpOptions* options) {
  const accuracy::SweepResult& result = sweep.state.result;
  const double values = std::max(1.0, static_cast<double>(result.values));
  return fmt::format(
             "{} values: {} not correctly rounded ({:.4g} %), {} of them not finite where the right result "
             "is; {} of {} exact zeros wrong\n",
             result.values, result.not_correctly_rounded,
             100 * static_cast<double>(result.not_correctly_rounded) / values, result.not_finite,
             result.zeros_wrong, result.zeros) +
         in_words(sweep, result.ulp, "ULP", options) +
         in_words(sweep, result.condition_aware, "relative to the condition", options) +
         fmt::format(
             "digest {:016x}; {:.1f} s, {:.1f} million values a second, {} of them by the exact route\n",
             result.digest, sweep.seconds, values / sweep.seconds / 1e6, result.decided_exactly);
}

// Returns the map of the options, or an error message.
std::variant<accuracy::SweptMap, std::string> map_of(const UlpOptions& options) {
  std::size_t product = 1;
  for (const int order : options.orders) product *= static_cast<std::size_t>(std::max(order, 0));
  UlpOptions one_component = options;  // one component, for a check that applies to each of them
  one_component.points.resize(std::min<std::size_t>(product, reference::kMaxOrder * reference::kMaxOrder));
  if (options.orders.empty() || options.points.empty() ||
      options.points.size() % std::max<std::size_t>(product, 1) != 0)
    return "--sweep needs --orders N or N,M, and that number of --points per component";
  if (const std::string wrong = wrong_points(one_component); !wrong.empty()) return wrong;
  for (const double x : options.points)
    if (static_cast<double>(static_cast<float>(x)) != x || !std::isfinite(x))
      return hexadecimal(x) + " is not a finite float";

  accuracy::SweptMap map;
  map.two_dimensional = options.orders.size() == 2;
  if (options.targets.size() > 1) return "--sweep measures one --target: give only one";
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
    return fmt::format("{} has {} components: --points takes one number per control point, or that many",
                       map.target, map.map.components);
  map.map.points = options.points;
  if (given == 1) {  // the given component stands for all
    map.map.points.clear();
    for (const double x : options.points) map.map.points.insert(map.map.points.end(), map.map.components, x);
  }
  if (map.two_dimensional != (options.fixed_u || options.fixed_v) || (options.fixed_u && options.fixed_v))
    return "a surface is swept along one argument: --u or --v says where the other one stands; a curve has "
           "none";
  map.along_v = options.fixed_u.has_value();
  map.other = map.along_v ? *options.fixed_u : options.fixed_v.value_or(0);
  if (!std::isfinite(map.other)) return "--u and --v must be finite floats";
  return map;
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
    const accuracy::Checkpoint whole = accuracy::merged(files);
    const fs::path file = file_of(options, whole.identity);
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    if (fs::exists(file))
      return wrong_use(fmt::format(
          "{} exists already: move it away, or choose another file with --checkpoint", file.string()));
    accuracy::write_checkpoint(file, whole);
    std::cout << in_words(whole, nullptr) << fmt::format("complete: {}\n", file.string());
    return kNothingUnexpected;
  } catch (const std::runtime_error& problem) {
    return wrong_use(problem.what());
  }
}

namespace {

// Returns the sweep of the options, or an error message.
std::variant<accuracy::SweepTask, std::string> task_of(const UlpOptions& options) {
  auto map = map_of(options);
  if (const auto* const wrong = std::get_if<std::string>(&map)) return *wrong;
  if (!options.at.empty()) return "--sweep does not take --at: it goes --from one float --to another";
  if (options.implementations.size() > 1) return "--sweep measures one implementation: give only one";
  if (!(options.from <= options.to) || !std::isfinite(options.from) || !std::isfinite(options.to))
    return "--from and --to must be finite floats, in ascending order";
  accuracy::SweepTask task{std::get<accuracy::SweptMap>(std::move(map)), options.from, options.to};
  if (!options.shard.empty()) {
    const Shard shard = *Shard::parse(options.shard, "/");
    task.shard = shard.number - 1;
    task.shards = shard.count;
  }
  return task;
}

std::string headline(const UlpOptions& options, const accuracy::SweepTask& task,
                     const ImplementationInfo& info, const World* world) {
  std::vector<std::string> points;
  for (const double point : task.map.map.points) points.push_back(hexadecimal(point));
  return fmt::format("{}: {} {}, {}order {}, control points {}, every float from {} to {}{}{}{}\n",
                     options.label.empty() ? info.name : options.label, clean(info.renderer),
                     clean(info.version), task.map.is_plain_curve() ? "" : task.map.target + ", ",
                     fmt::join(options.orders, " x "), fmt::join(points, ","), hexadecimal(task.from),
                     hexadecimal(task.to),
                     !task.map.two_dimensional ? ""
                     : task.map.along_v        ? " for v, u = " + hexadecimal(task.map.other)
                                               : " for u, v = " + hexadecimal(task.map.other),
                     task.shards > 1 ? ", shard " + options.shard : "",
                     world && world->size() > 1 ? fmt::format(", {} processes", world->size()) : "");
}

// Runs the sweep as rank 0, which keeps the checkpoint, and returns an exit code. Sets `world` to null once
// lead() has been called. Throws CannotStart, NotObservable, BadCheckpoint.
int sweep_here(const UlpOptions& options, const accuracy::SweepTask& task, int jobs, World*& world) {
  const accuracy::StreamSource source = accuracy::stream_source(implementation_of(options));
  if (source.info.max_eval_order > 0 && std::ranges::max(options.orders) > source.info.max_eval_order)
    return wrong_use(fmt::format("its GL_MAX_EVAL_ORDER is {}", source.info.max_eval_order));
  accuracy::Checkpoint sweep{accuracy::identity_of(task, source.info),
                             {accuracy::BlockSet(task.blocks()), {}}};
  const fs::path file = file_of(options, sweep.identity);
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (access((file.has_parent_path() ? file.parent_path() : fs::path(".")).c_str(), W_OK) != 0)
    return wrong_use(fmt::format("cannot write {}", file.string()));

  ProgressLine line;
  if (fs::exists(file)) {
    sweep = accuracy::read_checkpoint(file, sweep.identity);
    line.print(fmt::format("{}: {} of {} blocks were done before\n", file.string(), sweep.state.done.size(),
                           task.blocks_of_shard()));
  }
  line.print(headline(options, task, source.info, world));
  const auto start = std::chrono::steady_clock::now();
  const auto here = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double seconds_before = sweep.seconds;
  const std::int64_t done_before = sweep.state.done.size();
  const auto checkpoint_now = [&](const accuracy::SweepState& now) {
    const double seconds = here();
    accuracy::write_checkpoint(file, {sweep.identity, now, seconds_before + seconds});
    const auto done = static_cast<double>(now.done.size() - done_before);
    const auto left = static_cast<double>(task.blocks_of_shard() - now.done.size());
    line.show("sweep",
              fmt::format("{:.1f} %, {:.1f} million values a second, {:.0f} s left",
                          100.0 * static_cast<double>(now.done.size()) /
                              static_cast<double>(std::max<std::int64_t>(1, task.blocks_of_shard())),
                          done * accuracy::kBlock / seconds / 1e6, done > 0 ? left * seconds / done : 0.0));
  };
  if (!sweep.is_complete()) {
    if (world) {
      std::exchange(world, nullptr)
          ->lead(sweep.identity, source, jobs, sweep.state, interrupted, checkpoint_now);
    } else {
      accuracy::sweep(task, source, jobs, sweep.state, interrupted, checkpoint_now);
    }
  }
  sweep.seconds = seconds_before + here();
  line.print(in_words(sweep, &options));
  line.print(fmt::format("{}: {}\n", sweep.status(), file.string()));
  if (sweep.is_complete()) return kNothingUnexpected;
  return wrong_use("interrupted; the same command resumes the sweep");
}

}  // namespace

int sweep(const UlpOptions& options) {
  if (join_world == nullptr && processes_of_environment() > 1) {
    become("evalcts-lab-mpi");
    return wrong_use(
        "mpirun started several processes, but this evalcts was built without MPI: install libopenmpi-dev "
        "and openmpi-bin, and rebuild it");
  }
  std::unique_ptr<World> world;
  // Only rank 0 prints an error message.
  const auto said_once = [&](const std::string& words) {
    return !world || world->rank() == 0 ? wrong_use(words) : kWrongUse;
  };
  try {
    if (join_world != nullptr) world = join_world();
  } catch (const CannotStart& reason) {
    return said_once(reason.what());
  }
  // All processes have the same options, so an error here occurs in each of them.
  const auto given = task_of(options);
  if (const auto* const wrong = std::get_if<std::string>(&given)) return said_once(*wrong);
  const auto& task = std::get<accuracy::SweepTask>(given);
  const int jobs = options.jobs.value_or(world && world->size() > 1 ? 1 : usual_jobs());
  stop_when_asked();
  if (world && world->rank() > 0) {
    world->serve(
        task, [&] { return accuracy::stream_source(implementation_of(options)); }, jobs);
    return kNothingUnexpected;
  }
  // Dismisses the other ranks, which wait for orders, if this function returns without having called lead().
  struct Dismissal {
    World* others;
    ~Dismissal() {
      if (others != nullptr) others->dismiss();
    }
  } dismissal{world.get()};
  try {
    return sweep_here(options, task, jobs, dismissal.others);
  } catch (const CannotStart& reason) {
    return said_once(reason.what());
  } catch (const NotObservable& reason) {
    return said_once(reason.what());
  } catch (const accuracy::BadCheckpoint& reason) {
    return said_once(reason.what());
  }
}

}  // namespace evalcts::cli
