// `evalcts ulp`: measures the errors of implementations. Implementations are measured one after the other,
// each by several workers, because libraries disturb each other in one process and may crash.
#include "ulp.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <iostream>
#include <limits>
#include <map>

#include <reference/rounding.h>

#include <evalcts/accuracy/table.h>
#include <evalcts/backends/mesa_build.h>
#include <evalcts/cli/default_implementations.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/results/event_file.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/job_reader.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>
#include "lab.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

struct UlpOptions {
  std::vector<std::string> names;  // empty: the default implementations
  ImplementationOptions common;    // the other options that choose implementations
  std::string label;
  std::vector<std::string> targets = {"vertex_3"};
  std::string filter;  // selects classes of maps; empty: all
  std::uint64_t values = 20'000;
  std::uint32_t seed = 1;
  std::optional<int> jobs;
  std::string output;  // empty: the default folder
  // One input to evaluate, in place of random maps.
  std::vector<int> orders;
  std::vector<double> points, at, domain;
  int segments = 0;
  std::string events;   // the file of the events, if this process is a worker
  std::string command;  // the typed command
  std::string program;  // evalcts as the user typed it
};

std::vector<accuracy::RowRequest> rows_of(const UlpOptions& options) {
  std::vector<accuracy::RowRequest> rows;
  for (const std::string& target : options.targets)
    for (const accuracy::Class& what : accuracy::table_classes())
      if (is_chosen(what.name(), options.filter))
        rows.push_back({what, target, options.values, options.seed});
  return rows;
}

std::vector<std::string> in_hex(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(hexadecimal(value));
  return texts;
}

std::string bits(float value) { return fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(value)); }

// --- JSON (reports/schema/ulp-2.schema.json)

json float_json(float value) { return {{"value", hexadecimal(value)}, {"bits", bits(value)}}; }
json error_json(double error) { return std::isfinite(error) ? json(error) : json(nullptr); }

json orders_json(int uorder, int vorder, bool two_dimensional) {
  return two_dimensional ? json{uorder, vorder} : json{uorder};
}

json to_json(const accuracy::Worst& worst) {
  const accuracy::Input& input = worst.input;
  const auto dimensions = [&](const std::vector<double>& one, const std::vector<double>& two) {
    return in_hex(input.two_dimensional ? two : one);
  };
  const auto& [u1, u2, v1, v2] = input.domain;
  json out = {{"error", error_json(worst.error)},
              {"found_by", worst.climbed ? "climbing" : "sample"},
              {"orders", orders_json(input.uorder, input.vorder, input.two_dimensional)},
              {"points", in_hex(input.points)},
              {"at", dimensions({input.u}, {input.u, input.v})},
              {"got", float_json(worst.got)},
              {"right", float_json(worst.right)},
              {"exact", worst.exact}};
  if (input.domain != accuracy::kUnitDomain) out["domain"] = dimensions({u1, u2}, {u1, u2, v1, v2});
  if (input.segments > 0) out["segments"] = input.segments;
  return out;
}

json to_json(const ImplementationInfo& info) {
  json out = {{"kind", info.name}, {"max_eval_order", info.max_eval_order}};
  for (const auto& [name, text] : {std::pair{"library", &info.library},
                                   {"vendor", &info.vendor},
                                   {"renderer", &info.renderer},
                                   {"version", &info.version}})
    if (!text->empty()) out[name] = *text;
  return out;
}

json header_of(const accuracy::RowRequest& request) {
  const accuracy::Class& what = request.what;
  return {{"name", what.name()},
          {"orders", orders_json(what.uorder, what.vorder, what.vorder > 0)},
          {"data", what.data},
          {"target", request.target}};
}

json row_json(accuracy::Subject& subject, const accuracy::RowRequest& request) {
  accuracy::Errors errors = measure(subject, request, interrupted);
  climb(subject, request, errors, interrupted);
  json row = header_of(request);
  if (!subject.has_targets()) row.erase("target");
  if (!subject.capture().empty()) row["capture"] = subject.capture();
  row["values"] = errors.values;
  row["not_correctly_rounded"] = errors.not_correctly_rounded;
  row["not_finite"] = errors.not_finite;
  row["mean_ulp"] = error_json(errors.mean(errors.sum_of_ulp));
  row["mean_condition_aware"] = error_json(errors.mean(errors.sum_of_condition_aware));
  row["zeros"] = errors.zeros;
  row["zeros_wrong"] = errors.zeros_wrong;
  for (const auto& [unit, worst] :
       {std::pair{"ulp", &errors.ulp}, {"condition_aware", &errors.condition_aware}}) {
    row[std::string("max_") + unit] = error_json(std::max(worst->error, 0.0));
    if (worst->error >= 0) row[std::string("worst_") + unit] = to_json(*worst);
  }
  return row;
}

// --- the worker, which opens one implementation

constexpr char kProfile[] = "profile";

// Runs the jobs of standard input: a row, whose number is the data of the job, or the profile. Writes a line
// {"implementation": ...}, and {"row" or "profile": ...} for each job.
int work(const UlpOptions& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  JobReader jobs;
  EventFile events(options.events);
  const auto report = [&](const Event& event) { events.write(to_line(event)); };
  const auto write = [&](const char* what, const json& value) {
    events.write(json{{what, value}}.dump() + "\n");
  };
  ImplementationOptions implementation = options.common;
  if (!options.names.empty()) implementation.name = options.names.front();
  std::unique_ptr<accuracy::Subject> subject;
  try {
    subject = accuracy::open_subject(implementation);
  } catch (const CannotStart& reason) {
    report(CannotOpen{reason.what()});
    return kWrongUse;
  }
  const ImplementationInfo info = subject->info();
  write("implementation", to_json(info));
  const std::vector<accuracy::RowRequest> rows = rows_of(options);
  const auto measure_row = [&](std::size_t number) {
    const accuracy::RowRequest& request = rows.at(number);
    // A subject without targets is measured only once.
    if (!subject->has_targets() && request.target != options.targets.front()) return;
    json row = header_of(request);
    try {
      if (info.max_eval_order > 0 && std::max(request.what.uorder, request.what.vorder) > info.max_eval_order)
        throw NotObservable(fmt::format("GL_MAX_EVAL_ORDER is {}", info.max_eval_order));
      row = row_json(*subject, request);
    } catch (const NotObservable& reason) {
      row["not_measured"] = reason.what();
    } catch (const gl::MissingEntryPoint& missing) {
      row["not_measured"] = missing.what();
    }
    row["number"] = number;
    write("row", row);
  };
  const auto measure_profile = [&] {
    json profile = json::array();
    try {
      for (const double error : accuracy::measure_profile(*subject, options.targets.front()))
        profile.push_back(error_json(error));
      write(kProfile, profile);
    } catch (const NotObservable&) {
    } catch (const gl::MissingEntryPoint&) {
    }
  };
  while (const std::optional<std::string> line = jobs.next()) {
    const Job job = parse_job(*line).value();
    report(JobStarted{job.name});
    job.kind == kProfile ? measure_profile() : measure_row(std::stoul(job.data));
    report(JobEnded{});
  }
  report(RunEnded{});
  return kNothingUnexpected;
}

// --- the process that starts the workers

// Returns the command that evaluates the input of one of the worst results again.
std::vector<std::string> replay_of(const UlpOptions& options, const ImplementationOptions& implementation,
                                   const json& row, const json& worst) {
  std::vector<std::string> command = {options.program, "ulp"};
  const std::vector<std::string> chosen = implementation.words();
  command.insert(command.end(), chosen.begin(), chosen.end());
  if (row.contains("target")) command.insert(command.end(), {"--target", row["target"]});
  // A value that begins with '-' must be in the same word as its option.
  for (const char* const list : {"points", "at", "domain"})
    if (worst.contains(list))
      command.push_back(
          fmt::format("--{}={}", list, fmt::join(worst[list].get<std::vector<std::string>>(), ",")));
  command.push_back(fmt::format("--orders={}", fmt::join(worst["orders"].get<std::vector<int>>(), ",")));
  if (worst.contains("segments")) command.push_back("--segments=" + worst["segments"].dump());
  return command;
}

// Measures an implementation in several workers, and returns its entry of ulp.json. The log of the workers is
// kept only if one of them dies. A row in which one dies is not measured.
json measure_implementation(const UlpOptions& options, const ImplementationOptions& implementation,
                            const std::string& name, const fs::path& output, ProgressLine& line) {
  json entry = {{"name", name}, {"status", "complete"}};
  const fs::path log = output / fmt::format("log-ulp-{}.txt", name);
  std::error_code error;
  fs::remove(log, error);
  const std::vector<accuracy::RowRequest> requests = rows_of(options);
  std::vector<json> rows(requests.size());
  std::vector<Job> jobs;
  for (const accuracy::RowRequest& request : requests)
    jobs.push_back({.kind = "row",
                    .name = request.what.name() + "/" + request.target,
                    .data = std::to_string(jobs.size())});
  jobs.push_back({.kind = kProfile, .name = kProfile});
  std::size_t next = 0, done = 0;
  const auto take = [&](const Event& event) {
    if (std::holds_alternative<JobEnded>(event))
      line.show(name, fmt::format("{} of {}", ++done, jobs.size()));
    const auto* const other = std::get_if<OtherEvent>(&event);
    json measured = other ? json::parse(other->line, nullptr, false) : json();
    if (!measured.is_object()) return;
    if (measured.contains("implementation")) {
      entry.update(measured["implementation"]);
    } else if (measured.contains(kProfile)) {
      entry[kProfile] = measured[kProfile];
    } else {
      json& row = measured["row"];
      json& own = rows.at(row["number"].get<std::size_t>());
      row.erase("number");
      for (const char* const which : {"worst_ulp", "worst_condition_aware"})
        if (row.contains(which)) row[which]["replay"] = replay_of(options, implementation, row, row[which]);
      own = std::move(row);
    }
  };
  const auto take_end = [&](const WorkerRun& run) {
    if (run.complete || interrupted) return;
    if (!run.cannot_start.empty()) {
      if (entry.contains("kind") || as_text(entry["status"]) == "crashed") return;  // another one has started
      entry["status"] = "not-started";
      entry["reason"] = run.cannot_start;
      return;
    }
    entry["status"] = "crashed";
    entry["reason"] = fmt::format("{}; its output: {}", describe(run), log.string());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (jobs[i].name != run.in_flight) continue;
      rows[i] = header_of(requests[i]);
      rows[i]["not_measured"] = describe(run);
    }
  };
  std::vector<std::string> command = {fs::read_symlink("/proc/self/exe").string(), "ulp"};
  // The option is one word here: as two, it would start the worker of this program elsewhere.
  ImplementationOptions here = implementation;
  if (!here.worker.empty()) command.push_back("--worker=" + std::exchange(here.worker, ""));
  for (const std::string& word : here.words()) command.push_back(word);
  for (const std::string& target : options.targets) command.push_back("--target=" + target);
  command.push_back("--filter=" + options.filter);
  command.push_back(fmt::format("--values={}", options.values));
  command.push_back(fmt::format("--seed={}", options.seed));
  // A row may take any time, so no process counts as hung.
  Pool{.command = [&] { return command; },
       .log = log,
       .limits = {.seconds_per_test = std::numeric_limits<double>::infinity()},
       .workers = static_cast<std::size_t>(options.jobs.value_or(usual_jobs())),
       .each = take,
       .ended = take_end}
      .run([&] { return next < jobs.size() ? std::optional(jobs[next++]) : std::nullopt; });
  if (as_text(entry["status"]) == "not-started" && entry.contains("kind")) {
    entry["status"] = "complete";
    entry.erase("reason");
  }
  if (interrupted) {
    entry["status"] = "interrupted";
    entry["reason"] = "interrupted; these rows were finished";
  }
  entry["rows"] = json::array();
  for (json& row : rows)
    if (!row.is_null()) entry["rows"].push_back(std::move(row));
  if (as_text(entry["status"]) != "crashed") fs::remove(log, error);
  return entry;
}

// --- evaluation of one input

bool is_float(double x) { return static_cast<double>(static_cast<float>(x)) == x && !std::isinf(x); }

// Returns the error in the options of the input; empty if there is none.
std::string wrong_input(const UlpOptions& options) {
  std::size_t points = 1;
  for (const int order : options.orders) {
    if (order < 1 || order > reference::kMaxOrder)
      return fmt::format("--orders must be from 1 to {}", reference::kMaxOrder);
    points *= static_cast<std::size_t>(order);
  }
  if (options.orders.empty() || options.points.size() != points)
    return "a single input needs --orders N or N,M and that number of --points";
  if (options.at.size() != options.orders.size())
    return "a single input needs --at u, or --at u,v for a surface";
  for (const auto* const values : {&options.points, &options.at, &options.domain})
    for (const double x : *values)
      if (!is_float(x)) return fmt::format("{} is not a finite float", hexadecimal(x));
  if (!options.domain.empty() && options.domain.size() != 2 * options.orders.size())
    return "--domain takes u1,u2 for a curve, and u1,u2,v1,v2 for a surface";
  for (std::size_t i = 0; i < options.domain.size(); i += 2)
    if (options.domain[i] == options.domain[i + 1]) return "--domain: the ends of an interval are equal";
  return {};
}

int replay(const UlpOptions& options, const std::vector<ImplementationOptions>& implementations) {
  if (const std::string wrong = wrong_input(options); !wrong.empty()) return wrong_use(wrong);
  if (implementations.size() != 1)
    return wrong_use("a single input is measured on one implementation; name one");
  accuracy::Input input{.uorder = options.orders[0],
                        .two_dimensional = options.orders.size() == 2,
                        .points = options.points,
                        .u = static_cast<float>(options.at[0]),
                        .segments = options.segments};
  if (input.two_dimensional) {
    input.vorder = options.orders[1];
    input.v = static_cast<float>(options.at[1]);
  }
  std::ranges::copy(options.domain, input.domain.begin());
  const reference::Evaluation exact = input.evaluate(reference::BernsteinForm(input.surface()));
  const float right = reference::round_to_float(exact.value);
  try {
    const auto subject = accuracy::open_subject(implementations.front());
    for (const std::string& target : options.targets) {
      const float got = accuracy::replay(*subject, target, input);
      std::cout << fmt::format(
          "{}, {}: {} ({}), correctly rounded {} ({})\nexact value {}: error {} ULP, condition-aware {}\n",
          subject->info().name, target, hexadecimal(got), bits(got), hexadecimal(right), bits(right),
          reference::describe(exact.value),
          exact.value.is_zero() ? "no" : fmt::format("{:.6g}", reference::ulp_distance(got, exact.value)),
          exact.magnitude.is_zero()
              ? "none"
              : fmt::format("{:.6g}", reference::condition_distance(got, exact.value, exact.magnitude)));
    }
  } catch (const NotObservable& reason) {
    return wrong_use(reason.what());
  }
  return kNothingUnexpected;
}

// --- the command

// Returns the implementations to measure. Throws CannotStart if a name is unknown.
std::vector<ImplementationOptions> chosen_implementations(const UlpOptions& options) {
  const std::vector<std::string>& own = accuracy::own_subjects();
  std::vector<ImplementationOptions> chosen = completed(options.names, options.common);
  if (chosen.empty()) {
    for (const std::string& name : default_implementations()) chosen.push_back({name});
    for (const std::string& name : own) chosen.push_back({name});
  }
  for (const ImplementationOptions& each : chosen) {
    const auto has_name = [&](const ImplementationKind& kind) { return kind.name == each.name; };
    if (!each.name.empty() && std::ranges::find(own, each.name) == own.end() &&
        std::ranges::none_of(implementation_kinds(), has_name))
      throw CannotStart(
          fmt::format("unknown implementation '{}'; see 'evalcts list implementations'; others are {}",
                      each.name, fmt::join(own, ", ")));
  }
  return chosen;
}

int ulp(const UlpOptions& options) {
  if (!options.events.empty()) return work(options);
  const bool is_default = options.names.empty() && options.common.words().empty();
  const std::vector<ImplementationOptions> implementations = chosen_implementations(options);
  for (const ImplementationOptions& each : implementations) require_own_sources(each);
  const std::string& mesa = completed(options.common).mesa_build;
  if (!mesa.empty() && !uses_mesa_build(mesa)) {
    use_mesa_build(mesa);
    become(fs::read_symlink("/proc/self/exe").filename());  // again, with the environment for this Mesa
  }
  if (!options.orders.empty() || !options.points.empty() || !options.at.empty())
    return replay(options, implementations);
  if (!options.domain.empty() || options.segments != 0)
    return wrong_use(
        "--domain and --segments belong to a single input, which needs --orders, --points and --at");
  if (implementations.size() != 1 && (!options.common.library.empty() || !options.label.empty()))
    return wrong_use("--library and --name can be used with one implementation only");
  if (rows_of(options).empty())
    return wrong_use(fmt::format("no class of maps matches '{}'; without --filter all of them are measured",
                                 options.filter));
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts ulp");
  stop_when_asked();
  ProgressLine line;
  json document = {{"format", "evalcts-ulp-2"},       {"evalcts_version", EVALCTS_VERSION},
                   {"command", options.command},      {"seed", options.seed},
                   {"targets", options.targets},      {"curve", in_hex(accuracy::profile_curve())},
                   {"implementations", json::array()}};
  int code = kNothingUnexpected;
  for (const ImplementationOptions& each : implementations) {
    const std::string name = options.label.empty() ? each.label() : options.label;
    json entry = measure_implementation(options, each, name, output, line);
    line.print(table_text(entry, options.targets.size() > 1) + "\n");
    if (as_text(entry["status"]) == "crashed") code = std::max(code, kUnexpected);
    if (as_text(entry["status"]) == "not-started" && !is_default) code = std::max(code, kWrongUse);
    document["implementations"].push_back(std::move(entry));
  }
  document["status"] = interrupted ? "interrupted" : "complete";
  for (const auto& [file, content] :
       {std::pair<std::string, std::string>{"ulp.json", document.dump(1) + "\n"},
        {"ulp.csv", table_csv(document)},
        {"ulp-by-order.svg", errors_by_order(document)},
        {"ulp-by-argument.svg", errors_by_argument(document)}}) {
    if (content.empty())
      fs::remove(output / file);  // of an earlier measurement
    else
      write_atomically(output / file, content);
  }
  line.print(fmt::format(
      "seed {}; all results: {}; table: ulp.csv; pictures: ulp-by-order.svg, ulp-by-argument.svg\n",
      options.seed, (output / "ulp.json").string()));
  if (interrupted) return wrong_use("interrupted; the measurements so far are in the output folder");
  return code;
}

std::function<int()> define_ulp(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<UlpOptions>();
  options->program = call.program;
  options->command = call.command;
  add_implementations(app, options->names, options->common);
  app.add_option("--name", options->label, "label in the output (default: the implementation's name)");
  add_repeatable(app, "--target", options->targets, "kind of map; may be repeated (default: vertex_3)")
      ->check(CLI::IsMember(accuracy::target_names()));
  app.add_option("--filter", options->filter,
                 "measure only the classes of maps that match GoogleTest patterns, such as 'curve/4/*'");
  app.add_option("--values", options->values,
                 "number of values per row of the table, and of further ones that search for larger errors "
                 "(default: 20000)")
      ->check(CLI::Range(1.0, 1e15));  // needed because the parser reads -1 as 2^64 - 1
  app.add_option("--seed", options->seed, "seed of maps and arguments (default: 1)");
  app.add_option("--jobs", options->jobs,
                 "number of processes that measure an implementation in parallel (default: one per core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for the table and the pictures");
  app.add_option("--orders", options->orders,
                 "measure a single input instead: order of a curve, or uorder,vorder of a surface")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--points", options->points,
                 "control points of the single input; for a surface, v varies fastest")
      ->delimiter(',');
  app.add_option("--at", options->at, "argument of the single input: u, or u,v")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--domain", options->domain,
                 "domain u1,u2 or u1,u2,v1,v2 of the single input (default: [0,1])")
      ->delimiter(',')
      ->expected(2, 4);
  app.add_option(
         "--segments", options->segments,
         "number of grid segments over the domain; the single input is evaluated at the nearest point "
         "of this grid")
      ->check(positive_number);
  app.add_option("--events", options->events)->group("");
  return [options] { return ulp(*options); };
}

}  // namespace

const Command kUlpCommand = {kUlp.name, kUlp.description,
                             R"(  $ evalcts ulp --implementation osmesa --filter 'curve/4/*'
  $ evalcts ulp --implementation osmesa --orders 2 --points=0.25,0.75 --at 0.375)",
                             define_ulp};

}  // namespace evalcts::cli
