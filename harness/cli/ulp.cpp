// `evalcts ulp`: the accuracy table. Each implementation is measured in a process of its own, since libraries
// do not share one well and may crash; it writes one line of JSON for each row.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include <evalcts/accuracy_page.h>
#include <evalcts/reports.h>

#include <reference/bernstein.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/profile.h>
#include <evalcts/accuracy/search.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include "default_implementations.h"
#include "places.h"
#include "terminal.h"
#include "ulp.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kDefaultTarget = "vertex_3";
constexpr double kSecondsForAPicture = 60;

std::vector<std::string> targets_of(const UlpOptions& options) {
  return options.targets.empty() ? std::vector<std::string>{kDefaultTarget} : options.targets;
}

bool is_float(double x) { return static_cast<double>(static_cast<float>(x)) == x && !std::isinf(x); }

std::vector<accuracy::RowRequest> chosen_rows(const UlpOptions& options) {
  std::vector<accuracy::RowRequest> rows;
  for (const std::string& target : targets_of(options))
    for (const accuracy::Class& what : accuracy::table_classes())
      if (is_chosen(what.name(), options.filter))
        rows.push_back({what, target, options.values.value_or(kValuesOfRow), options.seed});
  return rows;
}

// ---- The process that measures

json info_as_json(const ImplementationInfo& info) {
  json entry = {{"kind", info.name}, {"max_eval_order", info.max_eval_order}};
  for (const auto& [name, value] : {std::pair{"library", &info.library},
                                    {"vendor", &info.vendor},
                                    {"renderer", &info.renderer},
                                    {"version", &info.version}})
    if (!value->empty()) entry[name] = *value;
  return entry;
}

int measure_rows(const UlpOptions& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::ofstream file(options.rows);
  const auto write = [&](const json& line) { file << line.dump() << std::endl; };
  try {
    const auto subject = accuracy::open_subject(implementation_of(options));
    const ImplementationInfo info = subject->info();
    write({{"implementation", info_as_json(info)}});
    for (const accuracy::RowRequest& request : chosen_rows(options)) {
      // What has no targets is measured once.
      if (!subject->has_targets() && request.target != targets_of(options).front()) break;
      const int order = std::max(request.what.uorder, request.what.vorder);
      if (info.max_eval_order > 0 && order > info.max_eval_order) {
        write(accuracy::row_as_json(request, fmt::format("GL_MAX_EVAL_ORDER is {}", info.max_eval_order)));
        continue;
      }
      try {
        const accuracy::Errors sample = accuracy::measure(*subject, request, interrupted);
        accuracy::Errors errors = sample;
        const std::uint64_t climbed = options.climb.value_or(options.values.value_or(kValuesOfRow));
        accuracy::climb(*subject, request, climbed, errors, interrupted);
        write(accuracy::row_as_json(request, *subject, errors, sample, climbed));
      } catch (const NotObservable& reason) {
        write(accuracy::row_as_json(request, reason.what()));
      } catch (const gl::MissingEntryPoint& missing) {
        write(accuracy::row_as_json(request, missing.what()));
      }
    }
    for (const accuracy::ProfileCurve& curve : accuracy::profile_curves()) {
      if (interrupted) break;
      const auto not_measured = [&](const std::string& why) {
        write({{"profile", {{"name", curve.name}, {"not_measured", why}}}});
      };
      if (info.max_eval_order > 0 && static_cast<int>(curve.points.size()) > info.max_eval_order) {
        not_measured(fmt::format("GL_MAX_EVAL_ORDER is {}", info.max_eval_order));
        continue;
      }
      try {
        write({{"profile", accuracy::profile_as_json(*subject, targets_of(options).front(), curve)}});
      } catch (const NotObservable& reason) {
        not_measured(reason.what());
      } catch (const gl::MissingEntryPoint& missing) {
        not_measured(missing.what());
      }
    }
  } catch (const CannotStart& reason) {
    write({{"cannot_start", reason.what()}});
  }
  return file ? kNothingUnexpected : kWrongUse;
}

// ---- One input

int replay(const UlpOptions& options) {
  const auto wrong_use = [](const std::string& words) {
    std::cerr << "evalcts: " << words << "\n";
    return kWrongUse;
  };
  if (const std::string wrong = wrong_points(options); !wrong.empty()) return wrong_use(wrong);
  if (options.at.size() != options.orders.size())
    return wrong_use("one input has --at u, or u,v for a surface");
  for (const double x : options.at)
    if (!is_float(x)) return wrong_use(fmt::format("{:a} is no finite float", x));
  const bool two_dimensional = options.orders.size() == 2;
  if (options.implementations.size() > 1) return wrong_use("one input is for one implementation");

  accuracy::Input input;
  input.two_dimensional = two_dimensional;
  input.uorder = options.orders[0];
  if (two_dimensional) input.vorder = options.orders[1];
  input.points = options.points;
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
          "{}, {}: {} ({}), correctly rounded {} ({})\nexact value {}: error {} ULP, {} beside the "
          "condition\n",
          subject->info().name, target, accuracy::hex(got), accuracy::bits(got), accuracy::hex(right),
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

// ---- What comes of it

std::string joined(const json& strings) {
  return fmt::format("{}", fmt::join(strings.get<std::vector<std::string>>(), ","));
}

std::vector<std::string> how_to_replay(const UlpOptions& options, const std::string& implementation,
                                       const json& row, const json& worst) {
  std::vector<std::string> command = {options.program, "ulp"};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.insert(command.end(), {option, value});
  };
  add("--implementation", implementation);
  add("--library", options.library.empty() ? "" : fs::absolute(options.library).lexically_normal().string());
  add("--context", options.context);
  if (row.contains("target")) add("--target", row["target"]);
  add("--orders", fmt::format("{}", fmt::join(worst["orders"].get<std::vector<int>>(), ",")));
  // A value that begins with '-' has to stand in the same word.
  command.push_back("--points=" + joined(worst["points"]));
  add("--at", joined(worst["at"]));
  return command;
}

std::string number(const json& value) {
  return value.is_null() ? "inf" : fmt::format("{:.4g}", value.get<double>());
}

double share(const json& row) {
  const double values = row["values"];
  return values > 0 ? row["not_correctly_rounded"].get<double>() / values : 0;
}

// The row's name, with its target where there are several.
std::string name_of(const json& row, bool with_target) {
  return row["name"].get<std::string>() +
         (with_target && row.contains("target") ? "/" + row["target"].get<std::string>() : "");
}

std::string worst_in_words(const json& row, const char* which, const char* unit) {
  const json& worst = row[which];
  std::string replay = shell_line(worst["replay"].get<std::vector<std::string>>());
  return fmt::format("  {} {}, at {}: {} ({}), correctly rounded {} ({}); exact {}\n    {}\n",
                     number(worst["error"]), unit, joined(worst["at"]),
                     worst["got"]["value"].get<std::string>(), worst["got"]["bits"].get<std::string>(),
                     worst["right"]["value"].get<std::string>(), worst["right"]["bits"].get<std::string>(),
                     worst["exact"].get<std::string>(), replay);
}

// What the largest error is known from; no search proves that there is no larger one.
std::string found_by(const json& row, const char* which) {
  return row.contains(which) ? row[which]["found_by"].get<std::string>() : "-";
}

// null counts as infinite
double error_of(const json& row, const char* which) {
  const json& value = row[which];
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

std::string in_words(const json& entry, bool with_target, bool verbose) {
  std::string text = entry["name"].get<std::string>() + ":";
  for (const char* part : {"vendor", "renderer", "version"})
    if (entry.contains(part)) text += " " + clean(entry[part].get<std::string>());
  text += "\n";
  if (entry.contains("reason")) text += fmt::format("  {}\n", clean(entry["reason"].get<std::string>()));
  if (entry["rows"].empty()) return text;
  text += fmt::format("{:<27} {:>8} {:>9} {:>10} {:>10} {:>10} {:>10} {:>6} {:>13}  {}\n", "maps", "values",
                      "misround.", "max ULP", "mean ULP", "max cond.", "mean cond.", "nonfin", "zeros wrong",
                      "largest found by");
  const json* largest[2] = {nullptr, nullptr};
  constexpr const char* kMaxima[2] = {"max_ulp", "max_condition_aware"};
  constexpr std::pair<const char*, const char*> kWorst[2] = {
      {"worst_ulp", "ULP"}, {"worst_condition_aware", "beside the condition"}};
  for (const json& row : entry["rows"]) {
    if (row.contains("not_measured")) {
      text += fmt::format("{:<27} not measured: {}\n", name_of(row, with_target),
                          row["not_measured"].get<std::string>());
      continue;
    }
    const std::uint64_t zeros = row["zeros"]["values"], zeros_wrong = row["zeros"]["wrong"];
    text += fmt::format("{:<27} {:>8} {:>7.2f} % {:>10} {:>10} {:>10} {:>10} {:>6} {:>13}  {}\n",
                        name_of(row, with_target), row["values"].get<std::uint64_t>(), 100 * share(row),
                        number(row["max_ulp"]), number(row["mean_ulp"]), number(row["max_condition_aware"]),
                        number(row["mean_condition_aware"]), row["not_finite"].get<std::uint64_t>(),
                        zeros == 0 ? "-" : fmt::format("{} of {}", zeros_wrong, zeros),
                        found_by(row, "worst_ulp") + ", " + found_by(row, "worst_condition_aware"));
    for (int i = 0; i < 2; ++i) {
      if (!row.contains(kWorst[i].first)) continue;
      if (verbose) text += worst_in_words(row, kWorst[i].first, kWorst[i].second);
      // Near the end of the range floats are coarser than that unit, whatever was computed.
      if (i == 1 && as_text(row["data"]) == "extreme") continue;
      if (largest[i] == nullptr || error_of(row, kMaxima[i]) > error_of(*largest[i], kMaxima[i]))
        largest[i] = &row;
    }
  }
  for (int i = 0; i < 2 && !verbose; ++i)
    if (largest[i] != nullptr)
      text += "worst in " + name_of(*largest[i], with_target) + ":\n" +
              worst_in_words(*largest[i], kWorst[i].first, kWorst[i].second);
  return text;
}

std::string quoted_for_gnuplot(const fs::path& path) {
  std::string quoted;
  for (const char c : path.string()) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted;
}

// gnuplot's picture of a script; none where that is not here.
std::optional<std::string> drawn(const fs::path& output, const std::string& script) {
  const fs::path commands = output / "ulp-picture.gnuplot", picture = output / "ulp-picture.svg";
  write_atomically(commands, fmt::format("set output '{}'\n", quoted_for_gnuplot(picture)) + script);
  std::error_code error;
  fs::remove(picture, error);
  ChildProcess gnuplot({"/usr/bin/env", "gnuplot", "--default-settings", commands.string()}, "");
  const std::optional<Ending> ending = gnuplot.wait(kSecondsForAPicture);
  std::ifstream stream(picture);
  const std::string svg((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  fs::remove(commands, error);
  fs::remove(picture, error);
  if (!ending || ending->signalled || ending->value != 0) return std::nullopt;
  return svg;
}

// ---- The process that asks for it

struct Measurement {
  std::string implementation, name;
  fs::path rows, log;
  std::unique_ptr<ChildProcess> child = nullptr;
  std::optional<Ending> ending = std::nullopt;
};

std::vector<json> lines_of(const fs::path& file) {
  std::vector<json> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (json value = json::parse(line, nullptr, false); value.is_object()) lines.push_back(std::move(value));
  return lines;
}

void start(Measurement& measurement, const UlpOptions& options) {
  std::error_code error;
  fs::remove(measurement.rows, error);
  fs::remove(measurement.log, error);
  std::vector<std::string> command = {
      fs::read_symlink("/proc/self/exe").string(),
      "ulp",
      "--rows",
      measurement.rows.string(),
      "--seed",
      std::to_string(options.seed),
      "--values",
      std::to_string(options.values.value_or(kValuesOfRow)),
      "--climb",
      std::to_string(options.climb.value_or(options.values.value_or(kValuesOfRow)))};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.push_back(option + "=" + value);
  };
  add("--implementation", measurement.implementation);
  add("--library", options.library);
  add("--context", options.context);
  add("--filter", options.filter);
  for (const std::string& target : options.targets) add("--target", target);
  measurement.child = std::make_unique<ChildProcess>(command, measurement.log.string());
}

// The implementation's part of the document. Files that have nothing more to say are removed.
json result_of(const Measurement& measurement, const UlpOptions& options) {
  json entry = {{"name", measurement.name},
                {"status", "complete"},
                {"rows", json::array()},
                {"profiles", json::array()}};
  for (json& line : lines_of(measurement.rows)) {
    if (line.contains("implementation")) {
      entry.update(line["implementation"]);
    } else if (line.contains("cannot_start")) {
      entry["status"] = "not-started";
      entry["reason"] = line["cannot_start"];
    } else if (line.contains("profile")) {
      entry["profiles"].push_back(std::move(line["profile"]));
    } else {
      for (const char* which : {"worst_ulp", "worst_condition_aware", "worst_zero"})
        if (line.contains(which))
          line[which]["replay"] = how_to_replay(options, measurement.implementation, line, line[which]);
      entry["rows"].push_back(std::move(line));
    }
  }
  const bool well = measurement.ending && !measurement.ending->signalled && measurement.ending->value == 0;
  if (interrupted) {
    // The row in flight is lost with its process.
    entry["status"] = "interrupted";
    entry["reason"] = "interrupted; these rows were finished";
  } else if (!well) {
    entry["status"] = "crashed";
    entry["reason"] =
        fmt::format("the process ended with {}; its output: {}",
                    measurement.ending ? describe(*measurement.ending) : "nothing", measurement.log.string());
  }
  std::error_code error;
  fs::remove(measurement.rows, error);
  if (as_text(entry["status"]) != "crashed") fs::remove(measurement.log, error);
  return entry;
}

// Sweeps in the folder belong to the page: what they say is proven. What is none is left out, with a word.
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
          "evalcts: '{}' is left out of the page: it is no sweep that 'evalcts ulp --sweep' has written\n",
          file.path().string());
    }
  }
  std::vector<json> sweeps;
  for (auto& [name, sweep] : by_name) sweeps.push_back(std::move(sweep));
  return sweeps;
}

// What to say of it.
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
  return fmt::format(
      "page: {}{}\n", file.string(),
      draws ? "" : " (without pictures: there is no gnuplot here that works, package gnuplot-nox)");
}

// The page of a measurement that is there already.
int page_again(const UlpOptions& options) {
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const auto wrong = [&](const std::string& why) {
    std::cerr << fmt::format("evalcts: '{}': {}; --page takes the ulp.json that 'evalcts ulp' has written\n",
                             options.page, clean(why));
    return kWrongUse;
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
      return fmt::format("--orders are from 1 to {}", reference::kMaxOrder);
    points *= static_cast<std::size_t>(order);
  }
  if (options.orders.empty() || options.points.size() != points)
    return "one map has --orders N or N,M and as many --points";
  for (const double x : options.points)
    if (!is_float(x)) return fmt::format("{:a} is no finite float", x);
  return {};
}

namespace {

std::vector<std::string> own_subject_names() {
  std::vector<std::string> names;
  for (const accuracy::SubjectKind& kind : accuracy::own_subjects()) names.push_back(kind.name);
  return names;
}

int ulp(const UlpOptions& options) {
  if (!options.rows.empty()) return measure_rows(options);
  if (options.sweep) return sweep(options);
  if (!options.merge.empty()) return merge(options);
  if (options.digest) return digest(options);
  if (!options.page.empty()) return page_again(options);
  if (!options.orders.empty() || !options.points.empty() || !options.at.empty()) return replay(options);

  const auto wrong_use = [](const std::string& words) {
    std::cerr << "evalcts: " << words << "\n";
    return kWrongUse;
  };
  std::vector<std::string> known = own_subject_names();
  for (const ImplementationKind& kind : implementation_kinds()) known.push_back(kind.name);
  for (const std::string& name : options.implementations)
    if (std::find(known.begin(), known.end(), name) == known.end())
      return wrong_use(
          fmt::format("there is no implementation '{}'; known are: {}", name, fmt::join(known, ", ")));
  std::vector<std::string> names = options.implementations;
  const bool own_library = !options.library.empty() || !options.context.empty();
  if (own_library && names.empty()) names.emplace_back();
  if ((own_library || !options.label.empty()) && names.size() != 1)
    return wrong_use("--library, --context and --name go with one implementation");
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
  std::vector<Measurement> all;
  for (const std::string& name : names) {
    const std::string label = !options.label.empty() ? options.label : name.empty() ? "library" : name;
    all.push_back({name, label, output / fmt::format("ulp-{}-{}.rows", label, all.size()),
                   output / fmt::format("log-ulp-{}-{}.txt", label, all.size())});
  }
  const std::size_t rows = 1 + chosen_rows(options).size() + accuracy::profile_curves().size();
  const auto jobs = static_cast<std::size_t>(options.jobs.value_or(usual_jobs()));
  std::size_t started = 0, ended = 0;
  while (ended < all.size() && !interrupted) {
    for (; started < all.size() && started - ended < jobs; ++started) start(all[started], options);
    for (std::size_t i = 0; i < started; ++i) {
      if (all[i].ending) continue;
      all[i].ending = all[i].child->wait(0.05);
      if (all[i].ending) ++ended;
      line.show(all[i].name,
                all[i].ending ? "done" : fmt::format("{} of {}", lines_of(all[i].rows).size(), rows));
    }
  }
  for (Measurement& measurement : all) measurement.child.reset();  // killed, where it still runs

  const bool with_target = targets_of(options).size() > 1;
  json document = {{"format", "evalcts-ulp-1"},
                   {"evalcts_version", EVALCTS_VERSION},
                   {"command", options.command},
                   {"status", interrupted ? "interrupted" : "complete"},
                   {"seed", options.seed},
                   {"targets", targets_of(options)},
                   {"curves", accuracy::profile_curves_as_json()},
                   {"implementations", json::array()}};
  int code = interrupted ? kWrongUse : kNothingUnexpected;
  for (const Measurement& measurement : all) {
    json entry = result_of(measurement, options);
    line.print(in_words(entry, with_target, options.verbose) + "\n");
    if (as_text(entry["status"]) == "crashed") code = std::max(code, kUnexpected);
    if (as_text(entry["status"]) == "not-started" && named) code = std::max(code, kWrongUse);
    document["implementations"].push_back(std::move(entry));
  }
  write_atomically(output / "ulp.json", document.dump(1) + "\n");
  write_atomically(output / "ulp.csv", reports::table_csv(document));
  write_atomically(output / "ulp-profiles.csv", reports::profiles_csv(document));
  write_atomically(output / "ulp-histograms.csv", reports::histograms_csv(document));
  write_atomically(output / "ulp-worst.csv", reports::worst_csv(document));
  line.print(write_page(output, document));
  line.print(fmt::format("seed {}; all of it: {}, {} and three more of comma-separated values\n",
                         options.seed, (output / "ulp.json").string(), (output / "ulp.csv").string()));
  if (interrupted) std::cerr << "evalcts: interrupted; what was measured is in the output folder\n";
  return code;
}

std::function<int()> define_ulp(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<UlpOptions>();
  options->program = call.program;
  options->command = call.command;
  add_repeatable(app, "--implementation", options->implementations,
                 fmt::format("what to measure, also {}; may be repeated (default: osmesa, or egl without it, "
                             "and all that need no library)",
                             fmt::join(own_subject_names(), ", ")));
  app.add_option("--library", options->library, "shared library instead of the usual one");
  app.add_option("--context", options->context, "what makes the contexts, as for run");
  app.add_option("--name", options->label, "label in the output, instead of the implementation's name");
  add_repeatable(app, "--target", options->targets, "kind of map; may be repeated (default: vertex_3)")
      ->check(CLI::IsMember(accuracy::target_names()));
  app.add_option("--filter", options->filter, "classes of maps: patterns as in GoogleTest, 'curve/4/*'");
  app.add_option("--values", options->values,
                 "of each row of the table (default: 20000), or of the digest (default: 10000000)")
      ->check(CLI::Range(1.0, 1e15));
  app.add_option("--climb", options->climb,
                 "results of each row that the search for worse inputs takes, from the worst of these on "
                 "(default: as many)")
      ->check(CLI::Range(0.0, 1e15));  // by itself the parser takes -1 for 2^64 - 1
  app.add_option("--seed", options->seed, "of maps and arguments");
  app.add_option("--jobs", options->jobs, "implementations side by side (default: one for each core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for ulp.json and ulp.csv");
  app.add_flag("--verbose", options->verbose, "the worst inputs of every row");
  app.add_option("--orders", options->orders, "one input instead: its order, or its two orders")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--points", options->points, "its control points, v fastest")->delimiter(',');
  app.add_option("--at", options->at, "its argument, or its two arguments")->delimiter(',')->expected(1, 2);
  app.add_flag("--sweep", options->sweep,
               "every float of an interval as argument of one map: --orders and --points");
  app.add_option("--u", options->fixed_u, "of a surface that is swept along v: its u");
  app.add_option("--v", options->fixed_v, "of a surface that is swept along u: its v");
  app.add_flag("--digest", options->digest,
               "one line for many results of production, or of another implementation, on random maps");
  app.add_option("--merge", options->merge,
                 "files of all shards of a sweep: makes one of them, as of a sweep without shards");
  app.add_option("--page", options->page,
                 "an earlier ulp.json: writes its page again, with the sweeps in the output folder");
  app.add_option("--from", options->from, "where the interval begins (default: 0)");
  app.add_option("--to", options->to, "where it ends (default: 1)");
  add_shard(app, options->shard, "K/N: every N-th block of the sweep, from the K-th on");
  app.add_option("--checkpoint", options->checkpoint,
                 "the file from which a sweep goes on, and its result (default: in the output folder)");
  app.add_option("--rows", options->rows)->group("");
  return [options] { return ulp(*options); };
}

}  // namespace

const Command kUlpCommand = {
    "ulp", "how far from the exact values? errors of implementations in ULP and beside their condition",
    R"(  $ evalcts ulp --implementation osmesa --filter 'curve/4/*'
  $ evalcts ulp --implementation osmesa --orders 2 --points=0.25,0.75 --at 0.375
  $ evalcts ulp --sweep --implementation production --orders 2 --points=0.25,0.75 --to 0x1p-4)",
    define_ulp};

}  // namespace evalcts::cli
