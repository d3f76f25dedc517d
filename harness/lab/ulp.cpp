// `evalcts ulp`: measures the accuracy table. Implementations are measured one after the other, each by
// several workers, because libraries disturb each other in one process and may crash.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <variant>

#include <evalcts/accuracy_page.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/reports.h>

#include <reference/bernstein.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/profile.h>
#include <evalcts/accuracy/report.h>
#include <evalcts/accuracy/search.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/cli/default_implementations.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/event_file.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/job_reader.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>
#include "lab.h"
#include "ulp.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kDefaultTarget = "vertex_3";
constexpr double kSecondsForAPicture = 60;
constexpr int kMostSegmentsOfRows = 1 << 24;

std::vector<std::string> targets_of(const UlpOptions& options) {
  return options.targets.empty() ? std::vector<std::string>{kDefaultTarget} : options.targets;
}

bool is_float(double x) { return static_cast<double>(static_cast<float>(x)) == x && !std::isinf(x); }

// Returns the error in the domain; empty if there is none.
std::string wrong_domain(const UlpOptions& options) {
  const std::vector<double>& ends = options.domain;
  if (ends.size() % 2 != 0) return "--domain takes two numbers, u1,u2, or four, u1,u2,v1,v2";
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    for (const double end : {ends[i], ends[i + 1]})
      if (!is_float(end)) return fmt::format("--domain: {} is not a finite float", hexadecimal(end));
    if (ends[i] == ends[i + 1])
      return fmt::format("--domain: the ends {} and {} are equal", ends[i], ends[i + 1]);
  }
  return {};
}

// Returns the domain of the options, if there is one. A single interval applies to both directions.
std::optional<accuracy::Domain> domain_of(const UlpOptions& options) {
  const std::vector<double>& ends = options.domain;
  if (ends.empty()) return std::nullopt;
  return accuracy::Domain{ends[0], ends[1], ends[ends.size() - 2], ends[ends.size() - 1]};
}

std::vector<accuracy::RowRequest> chosen_rows(const UlpOptions& options) {
  std::vector<accuracy::RowRequest> rows;
  for (const std::string& target : targets_of(options))
    for (const accuracy::Class& what : accuracy::table_classes())
      if (is_chosen(what.name(), options.filter))
        rows.push_back({what, target, options.values.value_or(kValuesOfRow), options.seed, domain_of(options),
                        options.segments > 0 ? std::optional(options.segments) : std::nullopt});
  return rows;
}

// --- the worker, which opens one implementation

// Each class of maps of each target is a job, and so is each profile.
constexpr char kRow[] = "row", kProfile[] = "profile";

// Runs the jobs of standard input, whose names are numbers of rows or profiles.
int work(const UlpOptions& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  JobReader jobs;
  EventFile events(options.worker);
  const auto report = [&](const Event& event) { events.write(to_line(event)); };
  const auto write = [&](const accuracy::Line& line) { events.write(accuracy::to_text(line) + "\n"); };
  std::unique_ptr<accuracy::Subject> subject;
  try {
    subject = accuracy::open_subject(implementation_of(options));
  } catch (const CannotStart& reason) {
    report(CannotOpen{reason.what()});
    return kWrongUse;
  }
  const ImplementationInfo info = subject->info();
  write(info);
  // Writes the line that `measure` returns, or `otherwise` with the reason why there is none.
  const auto write_measured = [&](std::size_t order, const auto& measure, const auto& otherwise) {
    try {
      if (info.max_eval_order > 0 && static_cast<GLint>(order) > info.max_eval_order)
        throw NotObservable(fmt::format("GL_MAX_EVAL_ORDER is {}", info.max_eval_order));
      write(measure());
    } catch (const NotObservable& reason) {
      write(otherwise(reason.what()));
    } catch (const gl::MissingEntryPoint& missing) {
      write(otherwise(missing.what()));
    }
  };
  const auto measure_row = [&](const accuracy::RowRequest& request) {
    // A subject without targets is measured only once.
    if (!subject->has_targets() && request.target != targets_of(options).front()) return;
    const auto measure = [&] {
      const accuracy::Errors sample = accuracy::measure(*subject, request, interrupted);
      accuracy::Errors errors = sample;
      const std::uint64_t climbed = options.climb.value_or(options.values.value_or(kValuesOfRow));
      accuracy::climb(*subject, request, climbed, errors, interrupted);
      return accuracy::row_of(request, *subject, errors, sample, climbed);
    };
    write_measured(static_cast<std::size_t>(std::max(request.what.uorder, request.what.vorder)), measure,
                   [&](const char* why) { return accuracy::not_measured(request, why); });
  };
  const auto measure_profile = [&](const accuracy::ProfileCurve& curve) {
    write_measured(
        curve.points.size(),
        [&] { return accuracy::measure_profile(*subject, targets_of(options).front(), curve); },
        [&](const char* why) {
          return accuracy::Profile{curve.name, why, {}, {}};
        });
  };
  const std::vector<accuracy::RowRequest> rows = chosen_rows(options);
  while (const std::optional<std::string> line = jobs.next()) {
    const Job job = parse_job(*line).value();
    report(JobStarted{job.name});
    const std::size_t number = std::stoul(job.data);
    if (job.kind == kRow)
      measure_row(rows.at(number));
    else
      measure_profile(accuracy::profile_curves().at(number));
    report(JobEnded{});
  }
  report(RunEnded{});
  return kNothingUnexpected;
}

// --- evaluation of one input

int replay(const UlpOptions& options) {
  if (const std::string wrong = wrong_points(options); !wrong.empty()) return wrong_use(wrong);
  if (options.at.size() != options.orders.size())
    return wrong_use("a single input needs --at u, or --at u,v for a surface");
  for (const double x : options.at)
    if (!is_float(x)) return wrong_use(fmt::format("{:a} is not a finite float", x));
  const bool two_dimensional = options.orders.size() == 2;
  if (options.implementations.size() > 1)
    return wrong_use("a single input is measured on one implementation: give only one");

  accuracy::Input input;
  input.two_dimensional = two_dimensional;
  input.uorder = options.orders[0];
  if (two_dimensional) input.vorder = options.orders[1];
  input.points = options.points;
  input.domain = domain_of(options).value_or(accuracy::kUnitDomain);
  input.segments = options.segments;
  input.u = static_cast<float>(options.at[0]);
  if (two_dimensional) input.v = static_cast<float>(options.at[1]);
  const reference::Evaluation exact =
      reference::evaluate_with_magnitude(input.surface(), input.argument_u(), input.argument_v());
  try {
    const auto subject = accuracy::open_subject(implementation_of(options));
    const float right = reference::round_to_float(exact.value);
    for (const std::string& target : targets_of(options)) {
      const float got = accuracy::replay(*subject, target, input);
      std::cout << fmt::format(
          "{}, {}: {} ({}), correctly rounded {} ({})\nexact value {}: error {} ULP, condition-aware {}\n",
          subject->info().name, target, hexadecimal(got), accuracy::bits(got), hexadecimal(right),
          accuracy::bits(right), reference::describe(exact.value),
          exact.value.is_zero() ? "no" : fmt::format("{:.6g}", reference::ulp_distance(got, exact.value)),
          exact.magnitude.is_zero()
              ? "none"
              : fmt::format("{:.6g}", reference::condition_distance(got, exact.value, exact.magnitude)));
    }
  } catch (const CannotStart& reason) {
    return wrong_use(reason.what());
  } catch (const NotObservable& reason) {
    return wrong_use(reason.what());
  }
  return kNothingUnexpected;
}

// --- output

std::string in_hex(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(hexadecimal(value));
  return fmt::format("{}", fmt::join(texts, ","));
}

std::string argument_of(const accuracy::Input& input) {
  return in_hex(input.two_dimensional ? std::vector<double>{input.u, input.v} : std::vector<double>{input.u});
}

std::vector<std::string> how_to_replay(const UlpOptions& options, const std::string& implementation,
                                       const accuracy::Row& row, const accuracy::Input& input) {
  std::vector<std::string> command = {options.program, "ulp"};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.insert(command.end(), {option, value});
  };
  add("--implementation", implementation);
  add("--library", options.library.empty() ? "" : fs::absolute(options.library).lexically_normal().string());
  add("--context", options.context);
  add("--target", row.target);
  add("--orders", input.two_dimensional ? fmt::format("{},{}", input.uorder, input.vorder)
                                        : std::to_string(input.uorder));
  // A value that begins with '-' must be in the same word as its option.
  command.push_back("--points=" + in_hex(input.points));
  add("--at", argument_of(input));
  if (input.domain != accuracy::kUnitDomain)
    command.push_back("--domain=" + in_hex({input.domain.begin(), input.domain.end()}));
  if (input.segments > 0) add("--segments", std::to_string(input.segments));
  return command;
}

// Returns the name of the row; if `with_target`, its target is appended.
std::string name_of(const accuracy::Row& row, bool with_target) {
  return row.what.name() + (with_target && !row.target.empty() ? "/" + row.target : "");
}

using WorstResult = std::optional<accuracy::WorstResult>;

std::string worst_in_words(const WorstResult& result, const char* unit) {
  const accuracy::Worst& worst = result->worst;
  return fmt::format("  {:.4g} {}, at {}: {} ({}), correctly rounded {} ({}); exact {}\n    {}\n",
                     worst.error, unit, argument_of(worst.input), hexadecimal(worst.got),
                     accuracy::bits(worst.got), hexadecimal(worst.right), accuracy::bits(worst.right),
                     worst.exact, shell_line(result->replay));
}

// Returns the name of the search that found the largest error. No search proves that there is no larger one.
const char* found_by(const WorstResult& result) {
  return !result ? "-" : result->worst.climbed ? "climbing" : "sample";
}

std::string in_words(const accuracy::MeasuredImplementation& entry, bool with_target, bool verbose) {
  std::string text = entry.name + ":";
  if (entry.info)
    for (const std::string* part : {&entry.info->vendor, &entry.info->renderer, &entry.info->version})
      if (!part->empty()) text += " " + clean(*part);
  text += "\n";
  if (!entry.reason.empty()) text += fmt::format("  {}\n", clean(entry.reason));
  if (entry.rows.empty()) return text;
  text += fmt::format("{:<27} {:>8} {:>9} {:>10} {:>10} {:>10} {:>10} {:>6} {:>13}  {}\n", "maps", "values",
                      "misround.", "max ULP", "mean ULP", "max cond.", "mean cond.", "nonfin", "zeros wrong",
                      "largest found by");
  struct Kind {
    double accuracy::Row::*maximum;
    WorstResult accuracy::Row::*worst;
    const char* unit;
    const accuracy::Row* largest = nullptr;
  };
  Kind kinds[] = {{&accuracy::Row::max_ulp, &accuracy::Row::worst_ulp, "ULP"},
                  {&accuracy::Row::max_condition_aware, &accuracy::Row::worst_condition_aware,
                   "relative to the condition"}};
  for (const accuracy::Row& row : entry.rows) {
    if (!row.not_measured.empty()) {
      text += fmt::format("{:<27} not measured: {}\n", name_of(row, with_target), row.not_measured);
      continue;
    }
    const double share =
        row.values > 0 ? static_cast<double>(row.not_correctly_rounded) / static_cast<double>(row.values) : 0;
    text +=
        fmt::format("{:<27} {:>8} {:>7.2f} % {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>6} {:>13}  {}, {}\n",
                    name_of(row, with_target), row.values, 100 * share, row.max_ulp, row.mean_ulp,
                    row.max_condition_aware, row.mean_condition_aware, row.not_finite,
                    row.zeros.values == 0 ? "-" : fmt::format("{} of {}", row.zeros.wrong, row.zeros.values),
                    found_by(row.worst_ulp), found_by(row.worst_condition_aware));
    for (Kind& kind : kinds) {
      if (!(row.*kind.worst)) continue;
      if (verbose) text += worst_in_words(row.*kind.worst, kind.unit);
      // Near the limits of the range, even the spacing of floats exceeds the unit of the condition-aware
      // error.
      if (&kind == &kinds[1] && row.what.data == "extreme") continue;
      if (!kind.largest || row.*kind.maximum > kind.largest->*kind.maximum) kind.largest = &row;
    }
  }
  for (const Kind& kind : kinds)
    if (kind.largest && !verbose)
      text += "worst in " + name_of(*kind.largest, with_target) + ":\n" +
              worst_in_words(kind.largest->*kind.worst, kind.unit);
  return text;
}

std::string quoted_for_gnuplot(const fs::path& path) {
  std::string quoted;
  for (const char c : path.string()) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted;
}

// Returns the picture that gnuplot draws from the script; none if gnuplot is missing or fails.
std::optional<std::string> drawn(const fs::path& output, const std::string& script) {
  const fs::path commands = output / "ulp-picture.gnuplot", picture = output / "ulp-picture.svg";
  write_atomically(commands, fmt::format("set output '{}'\n", quoted_for_gnuplot(picture)) + script);
  std::error_code error;
  fs::remove(picture, error);
  ChildProcess gnuplot({"/usr/bin/env", "gnuplot", "--default-settings", commands.string()}, "");
  const std::optional<Ending> ending = gnuplot.wait(kSecondsForAPicture);
  const std::string svg = read_file(picture);
  fs::remove(commands, error);
  fs::remove(picture, error);
  if (!ending || ending->signalled || ending->value != 0) return std::nullopt;
  return svg;
}

// --- the process that starts the workers

std::vector<std::string> worker_command(const UlpOptions& options, const std::string& implementation) {
  std::vector<std::string> command = {
      fs::read_symlink("/proc/self/exe").string(),
      "ulp",
      "--seed",
      std::to_string(options.seed),
      "--values",
      std::to_string(options.values.value_or(kValuesOfRow)),
      "--climb",
      std::to_string(options.climb.value_or(options.values.value_or(kValuesOfRow)))};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.push_back(option + "=" + value);
  };
  add("--implementation", implementation);
  add("--library", options.library);
  add("--context", options.context);
  add("--filter", options.filter);
  if (!options.domain.empty()) add("--domain", in_hex(options.domain));
  if (options.segments > 0) add("--segments", std::to_string(options.segments));
  for (const std::string& target : options.targets) add("--target", target);
  return command;
}

std::vector<Job> jobs_of(const UlpOptions& options) {
  std::vector<Job> jobs;
  for (const accuracy::RowRequest& request : chosen_rows(options))
    jobs.push_back({.kind = kRow,
                    .name = request.what.name() + "/" + request.target,
                    .data = std::to_string(jobs.size())});
  const std::size_t rows = jobs.size();
  for (const accuracy::ProfileCurve& curve : accuracy::profile_curves())
    jobs.push_back({.kind = kProfile, .name = curve.name, .data = std::to_string(jobs.size() - rows)});
  return jobs;
}

// Sorts the measured rows and profiles into the order of the requests, and adds the commands that replay
// inputs. A row or profile in which a process died is not measured.
void complete(accuracy::MeasuredImplementation& entry, const UlpOptions& options,
              const std::string& implementation, const std::map<std::string, std::string>& deaths) {
  std::vector<accuracy::Row> rows;
  for (const accuracy::RowRequest& request : chosen_rows(options)) {
    const auto found = std::ranges::find_if(entry.rows, [&](const accuracy::Row& row) {
      return row.what.name() == request.what.name() && (row.target.empty() || row.target == request.target);
    });
    const auto death = deaths.find(request.what.name() + "/" + request.target);
    if (death != deaths.end()) {
      rows.push_back(accuracy::not_measured(request, death->second));
    } else if (found != entry.rows.end()) {
      rows.push_back(std::move(*found));
      entry.rows.erase(found);
    }
  }
  for (accuracy::Row& row : rows)
    for (WorstResult* const worst : {&row.worst_ulp, &row.worst_condition_aware, &row.worst_zero})
      if (*worst) (*worst)->replay = how_to_replay(options, implementation, row, (*worst)->worst.input);
  entry.rows = std::move(rows);
  std::vector<accuracy::Profile> profiles;
  for (const accuracy::ProfileCurve& curve : accuracy::profile_curves())
    if (const auto death = deaths.find(curve.name); death != deaths.end())
      profiles.push_back({curve.name, death->second, {}, {}});
    else
      for (accuracy::Profile& profile : entry.profiles)
        if (profile.curve == curve.name) profiles.push_back(std::move(profile));
  entry.profiles = std::move(profiles);
}

// Measures an implementation, which the report calls `name`, in several workers. Their log is kept only if a
// process dies.
accuracy::MeasuredImplementation measure(const UlpOptions& options, const std::string& implementation,
                                         const std::string& name, const fs::path& output,
                                         ProgressLine& line) {
  using Status = accuracy::MeasuredImplementation::Status;
  accuracy::MeasuredImplementation entry;
  entry.name = name;
  const fs::path log = output / fmt::format("log-ulp-{}.txt", name);
  std::error_code error;
  fs::remove(log, error);
  const std::vector<Job> jobs = jobs_of(options);
  std::map<std::string, std::string> deaths;  // what happened, by job
  std::size_t next = 0, done = 0;
  const auto take = [&](const Event& event) {
    if (std::holds_alternative<JobEnded>(event))
      line.show(name, fmt::format("{} of {}", ++done, jobs.size()));
    const auto* const other = std::get_if<OtherEvent>(&event);
    std::optional<accuracy::Line> measured = other ? accuracy::parse_line(other->line) : std::nullopt;
    if (!measured) return;
    if (auto* const info = std::get_if<ImplementationInfo>(&*measured))
      entry.info = std::move(*info);
    else if (auto* const profile = std::get_if<accuracy::Profile>(&*measured))
      entry.profiles.push_back(std::move(*profile));
    else
      entry.rows.push_back(std::get<accuracy::Row>(*std::move(measured)));
  };
  const auto take_end = [&](const WorkerRun& run) {
    if (run.complete || interrupted) return;
    const Limits limits;
    if (!run.cannot_start.empty()) {
      if (entry.info || entry.status == Status::kCrashed) return;  // another worker has started
      entry.status = Status::kNotStarted;
      entry.reason = run.cannot_start;
      return;
    }
    entry.status = Status::kCrashed;
    entry.reason = fmt::format("{}; its output: {}", describe(run), log.string());
    if (!run.in_flight.empty()) deaths[run.in_flight] = describe(run);
  };
  // A row may take any time, so no process counts as hung.
  Pool{.command = [&] { return worker_command(options, implementation); },
       .log = log,
       .limits = {.seconds_per_test = std::numeric_limits<double>::infinity()},
       .workers = static_cast<std::size_t>(options.jobs.value_or(usual_jobs())),
       .each = take,
       .ended = take_end}
      .run([&] { return next < jobs.size() ? std::optional(jobs[next++]) : std::nullopt; });
  if (entry.status == Status::kNotStarted && entry.info) {
    entry.status = Status::kComplete;
    entry.reason.clear();
  }
  if (interrupted) {
    // The unfinished rows are lost.
    entry.status = Status::kInterrupted;
    entry.reason = "interrupted; these rows were finished";
  }
  complete(entry, options, implementation, deaths);
  if (entry.status != Status::kCrashed) fs::remove(log, error);
  return entry;
}

// Returns the sweeps in the folder, whose proven results are shown on the page. Prints a warning
// for other files.
std::vector<json> sweeps_in(const fs::path& output) {
  std::map<std::string, json> by_name;
  std::error_code error;
  for (const fs::directory_entry& file : fs::directory_iterator(output, error)) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("sweep-") || file.path().extension() != ".json") continue;
    std::ifstream stream(file.path());
    json sweep = json::parse(stream, nullptr, false);
    if (reports::is_sweep(sweep)) {
      by_name[name] = std::move(sweep);
    } else {
      std::cerr << fmt::format(
          "evalcts: '{}' is left out of the page: it was not written by 'evalcts ulp --sweep'\n",
          file.path().string());
    }
  }
  std::vector<json> sweeps;
  for (auto& [name, sweep] : by_name) sweeps.push_back(std::move(sweep));
  return sweeps;
}

// Writes the page, and returns a line with its path.
std::string write_page(const fs::path& output, const json& document) {
  bool draws = true;
  const auto draw = [&](const std::string& script) -> std::optional<std::string> {
    if (!draws) return std::nullopt;
    auto svg = drawn(output, script);
    draws = svg.has_value();
    return svg;
  };
  const fs::path file = output / "accuracy.html";
  write_atomically(file, reports::accuracy_html(document, sweeps_in(output), draw));
  return fmt::format("page: {}{}\n", file.string(),
                     draws ? "" : " (without pictures: no working gnuplot was found, package gnuplot-nox)");
}

// Writes the page of an existing measurement again.
int page_again(const UlpOptions& options) {
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const auto wrong = [&](const std::string& why) {
    return wrong_use(fmt::format("'{}': {}; --page takes the ulp.json that 'evalcts ulp' has written",
                                 options.page, clean(why)));
  };
  std::ifstream stream(options.page);
  if (!stream) return wrong("cannot be read");
  const json document = json::parse(stream, nullptr, false);
  if (!document.is_object()) return wrong("no JSON object");
  const FolderLock lock = claim(output, "evalcts ulp");
  try {
    std::cout << write_page(output, document);
  } catch (const json::exception& error) {
    return wrong(error.what());
  } catch (const FormatError& error) {
    return wrong(error.what());
  }
  return kNothingUnexpected;
}

}  // namespace

ImplementationOptions implementation_of(const UlpOptions& options) {
  return {options.implementations.empty() ? "" : options.implementations.front(), options.library,
          options.context};
}

std::string wrong_points(const UlpOptions& options) {
  std::size_t points = 1;
  for (const int order : options.orders) {
    if (order < 1 || order > reference::kMaxOrder)
      return fmt::format("--orders must be from 1 to {}", reference::kMaxOrder);
    points *= static_cast<std::size_t>(order);
  }
  if (options.orders.empty() || options.points.size() != points)
    return "a single map needs --orders N or N,M and that number of --points";
  for (const double x : options.points)
    if (!is_float(x)) return fmt::format("{:a} is not a finite float", x);
  return {};
}

namespace {

std::vector<std::string> own_subject_names() {
  std::vector<std::string> names;
  for (const accuracy::SubjectKind& kind : accuracy::own_subjects()) names.push_back(kind.name);
  return names;
}

int ulp(const UlpOptions& options) {
  if (!options.worker.empty()) return work(options);
  if (options.sweep) return sweep(options);
  if (!options.merge.empty()) return merge(options);
  if (options.digest) return digest(options);
  if (!options.page.empty()) return page_again(options);
  if (const std::string wrong = wrong_domain(options); !wrong.empty()) return wrong_use(wrong);
  if (!options.orders.empty() || !options.points.empty() || !options.at.empty()) return replay(options);

  if (options.segments > kMostSegmentsOfRows || (options.segments & (options.segments - 1)) != 0)
    return wrong_use(
        fmt::format("--segments {}: random maps are measured on grids of 2^k segments, with k up to 24",
                    options.segments));

  std::vector<std::string> known = own_subject_names();
  for (const ImplementationKind& kind : implementation_kinds()) known.push_back(kind.name);
  for (const std::string& name : options.implementations)
    if (std::find(known.begin(), known.end(), name) == known.end())
      return wrong_use(
          fmt::format("unknown implementation '{}'; known are: {}", name, fmt::join(known, ", ")));
  std::vector<std::string> names = options.implementations;
  const bool own_library = !options.library.empty() || !options.context.empty();
  if (own_library && names.empty()) names.emplace_back();
  if ((own_library || !options.label.empty()) && names.size() != 1)
    return wrong_use("--library, --context and --name can be used with one implementation only");
  const bool named = !names.empty();
  if (!named) {
    names = default_implementations();
    for (const std::string& own : own_subject_names()) names.push_back(own);
  }
  if (chosen_rows(options).empty())
    return wrong_use(fmt::format("no class of maps matches '{}'; without --filter all of them are measured",
                                 options.filter));
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts ulp");

  stop_when_asked();
  ProgressLine line;
  const bool with_target = targets_of(options).size() > 1;
  accuracy::Report report{options.command, false, options.seed, targets_of(options), {}};
  int code = kNothingUnexpected;
  const auto label_of = [&](const std::string& name) {
    return !options.label.empty() ? options.label : name.empty() ? "library" : name;
  };
  for (const std::string& name : names) {
    using Status = accuracy::MeasuredImplementation::Status;
    accuracy::MeasuredImplementation& entry =
        report.implementations.emplace_back(measure(options, name, label_of(name), output, line));
    line.print(in_words(entry, with_target, options.verbose) + "\n");
    if (entry.status == Status::kCrashed) code = std::max(code, kUnexpected);
    if (entry.status == Status::kNotStarted && named) code = std::max(code, kWrongUse);
  }
  report.interrupted = interrupted;
  if (interrupted) code = kWrongUse;
  const json document = accuracy::to_json(report);
  write_atomically(output / "ulp.json", document.dump(1) + "\n");
  write_atomically(output / "ulp.csv", reports::table_csv(document));
  write_atomically(output / "ulp-profiles.csv", reports::profiles_csv(document));
  write_atomically(output / "ulp-histograms.csv", reports::histograms_csv(document));
  write_atomically(output / "ulp-worst.csv", reports::worst_csv(document));
  line.print(write_page(output, document));
  line.print(fmt::format("seed {}; all results: {}, {} and three more CSV files\n", options.seed,
                         (output / "ulp.json").string(), (output / "ulp.csv").string()));
  if (interrupted) std::cerr << "evalcts: interrupted; the measurements so far are in the output folder\n";
  return code;
}

std::function<int()> define_ulp(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<UlpOptions>();
  options->program = call.program;
  options->command = call.command;
  add_repeatable(app, "--implementation", options->implementations,
                 fmt::format("implementation to measure, or one of {}; may be repeated (default: osmesa or, "
                             "without OSMesa, egl, and all that need no library)",
                             fmt::join(own_subject_names(), ", ")));
  app.add_option("--library", options->library, "shared library to measure instead of the system's");
  app.add_option("--context", options->context, "interface that creates the contexts, as for run");
  app.add_option("--name", options->label, "label in the output (default: the implementation's name)");
  add_repeatable(app, "--target", options->targets, "kind of map; may be repeated (default: vertex_3)")
      ->check(CLI::IsMember(accuracy::target_names()));
  app.add_option("--filter", options->filter,
                 "measure only the classes of maps that match GoogleTest patterns, such as 'curve/4/*'");
  app.add_option(
         "--values", options->values,
         "number of values per row of the table (default: 20000) or in the digest (default: 10000000)")
      ->check(CLI::Range(1.0, 1e15));
  app.add_option("--climb", options->climb,
                 "number of further evaluations per row that search for larger errors, starting from the "
                 "largest ones found (default: that of --values)")
      ->check(CLI::Range(0.0, 1e15));  // needed because the parser reads -1 as 2^64 - 1
  app.add_option("--seed", options->seed, "seed of maps and arguments (default: 1)");
  app.add_option("--jobs", options->jobs,
                 "number of processes that measure an implementation in parallel (default: one per core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for ulp.json and ulp.csv");
  app.add_flag("--verbose", options->verbose, "print the inputs with the largest errors of every row");
  app.add_option("--orders", options->orders,
                 "measure a single input instead: order of a curve, or uorder,vorder of a surface")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--points", options->points,
                 "control points of the single input or the sweep; for a surface, v varies fastest")
      ->delimiter(',');
  app.add_option("--at", options->at, "argument of the single input: u, or u,v")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--domain", options->domain,
                 "domain u1,u2 or u1,u2,v1,v2 of the maps or the single input (default: [0,1], or the domain "
                 "of the class: shifted, reversed, narrow, huge)")
      ->delimiter(',')
      ->expected(2, 4);
  app.add_option(
         "--segments", options->segments,
         "number of grid segments over the domain; the maps (2^k segments) or the single input are evaluated "
         "at points of this grid")
      ->check(positive_number);
  app.add_flag("--sweep", options->sweep,
               "measure one map, given by --orders and --points, at every float of an interval");
  app.add_option("--u", options->fixed_u, "fixed u of a surface that is swept along v");
  app.add_option("--v", options->fixed_v, "fixed v of a surface that is swept along u");
  app.add_flag(
      "--digest", options->digest,
      "print one line that identifies many results on random maps, of production or another implementation");
  app.add_option("--merge", options->merge, "join the result files of all shards of a sweep");
  app.add_option("--page", options->page,
                 "write the page of an earlier ulp.json again, with the sweeps in the output folder");
  app.add_option("--from", options->from, "first argument of the sweep (default: 0)");
  app.add_option("--to", options->to, "last argument of the sweep (default: 1)");
  add_shard(app, options->shard, "K/N: measure only every N-th block of the sweep, starting with the K-th");
  app.add_option(
      "--checkpoint", options->checkpoint,
      "file that stores the state of a sweep and from which it is resumed (default: in the output folder)");
  app.add_option("--worker", options->worker)->group("");
  return [options] { return ulp(*options); };
}

}  // namespace

const Command kUlpCommand = {kUlp.name, kUlp.description,
                             R"(  $ evalcts ulp --implementation osmesa --filter 'curve/4/*'
  $ evalcts ulp --implementation osmesa --orders 2 --points=0.25,0.75 --at 0.375
  $ evalcts ulp --sweep --implementation production --orders 2 --points=0.25,0.75 --to 0x1p-4)",
                             define_ulp};

}  // namespace evalcts::cli
