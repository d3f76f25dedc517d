#include "harness/faults/fault_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "harness/runner/depth.h"
#include "harness/runner/runner.h"
#include "harness/runner/suite_child.h"

namespace evalcts::faults {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double kLook = 0.01;   // seconds between two looks at a child
constexpr int kMostDeaths = 20;  // of one sound run

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Whether a test that names `named` decides `wanted`: the same, or a half of it.
bool decides(const std::string& named, const std::string& wanted) {
  return named == wanted || named.starts_with(wanted + "/");
}

// What tells the suite program which implementation the fault is for.
std::vector<std::string> opening_of(const json& fault) {
  return fault.value("arguments", std::vector<std::string>{"--implementation", fault["implementation"]});
}

int rank(const std::string& level) { return level == "must" ? 2 : level == "interpretation" ? 1 : 0; }

struct CannotTry {
  std::string reason;
};

class Trial {
 public:
  explicit Trial(const TableRequest& request) : request_(request) {
    for (const json& test : request.tests) by_name_[test["name"]] = &test;
  }

  // What became of the fault.
  json try_fault(const json& fault) {
    json result = fault;
    result.erase("arguments");
    result["outcome"] = "caught";
    result["reason"] = "";
    result["requirements"] = json::array();
    try {
      for (const std::string& requirement : words_of(fault["requirements"])) {
        json cell = betray(fault, requirement);
        if (!cell["caught"]) result["outcome"] = "survives";
        result["requirements"].push_back(std::move(cell));
      }
    } catch (const CannotTry& cannot) {
      result["outcome"] = "not-tried";
      result["reason"] = cannot.reason;
    }
    return result;
  }

 private:
  // Looks for a test that names the requirement and catches the fault.
  json betray(const json& fault, const std::string& requirement) {
    json cell = {{"id", requirement}, {"caught", false}};
    for (const Depth depth : {Depth::quick, Depth::full}) {
      const std::vector<std::string> tests =
          sound_tests(fault, depth, tests_of(requirement, depth, fault["level"]));
      if (interrupted) throw CannotTry{"interrupted"};
      if (tests.empty()) continue;
      const json caught = catching(fault, depth, tests);
      if (!caught.is_null()) {
        cell.update(caught);
        return cell;
      }
    }
    return cell;
  }

  std::vector<std::string> tests_of(const std::string& requirement, Depth depth,
                                    const std::string& level) const {
    std::vector<std::string> names;
    for (const json& test : request_.tests) {
      if (depth_named(test["from"].get<std::string>()) > depth) continue;
      if (rank(test["level"]) < rank(level)) continue;
      for (const std::string named : test["requirements"])
        if (decides(named, requirement)) {
          names.push_back(test["name"]);
          break;
        }
    }
    return names;
  }

  // Those of the tests that pass without a fault.
  std::vector<std::string> sound_tests(const json& fault, Depth depth,
                                       const std::vector<std::string>& tests) {
    const std::string implementation = fault["implementation"];
    const std::lock_guard lock(mutex_);
    std::map<std::string, bool>& sound = sound_[{implementation, depth}];
    std::vector<std::string> missing;
    for (const std::string& test : tests)
      if (!sound.contains(test)) missing.push_back(test);
    for (int deaths = 0; !missing.empty() && deaths < kMostDeaths && !interrupted; ++deaths) {
      const ChildRun run = play(fault, "sound-" + implementation, depth, missing);
      if (run.records.empty() && run.in_flight.empty())
        throw CannotTry{fmt::format("{} does not start: {}", implementation, describe(run.ending))};
      for (const auto& [name, record] : run.records) sound[name] = as_text(record["verdict"]) == "pass";
      if (!run.in_flight.empty()) sound[run.in_flight] = false;
      std::erase_if(missing, [&](const std::string& name) { return sound.contains(name); });
    }
    std::vector<std::string> passing;
    for (const std::string& test : tests)
      if (sound[test]) passing.push_back(test);
    return passing;
  }

  // The first of the tests that catches the fault; null if none does.
  json catching(const json& fault, Depth depth, const std::vector<std::string>& tests) {
    const ChildRun run = play(fault, fault["name"], depth, tests);
    if (interrupted) throw CannotTry{"interrupted"};  // the death of the child says nothing then
    const bool quality = as_text(fault["level"]) == "quality";
    for (const std::string& name : run.finished) {
      const json& record = run.records.at(name);
      const std::string verdict = record["verdict"];
      if (verdict == "fail" || (quality && verdict == "quality-warning"))
        return caught(name, depth, verdict, record["message"]);
    }
    if (!run.in_flight.empty())
      return caught(run.in_flight, depth, run.hung ? "timeout" : "crash", describe(run.ending));
    if (run.records.empty() && !interrupted)
      throw CannotTry{fmt::format("with this fault nothing can be judged ({})", describe(run.ending))};
    return nullptr;
  }

  json caught(const std::string& test, Depth depth, const std::string& verdict,
              const std::string& message) const {
    return {{"caught", true},          {"test", test},
            {"depth", name_of(depth)}, {"test_level", (*by_name_.at(test))["level"]},
            {"verdict", verdict},      {"message", message}};
  }

  // One child; it has the fault, and stops at the first failure, where the label is the name of the fault.
  ChildRun play(const json& fault, const std::string& label, Depth depth,
                const std::vector<std::string>& tests) const {
    const fs::path list = request_.scratch / (label + ".txt"), events = request_.scratch / (label + ".jsonl");
    std::ofstream stream(list);
    for (const std::string& test : tests) stream << test << '\n';
    if (!stream.flush()) throw std::runtime_error(fmt::format("cannot write '{}'", list.string()));
    fs::remove(events);
    std::vector<std::string> command = {request_.suite_program.string(),
                                        "--depth",
                                        name_of(depth),
                                        "--tests",
                                        list.string(),
                                        "--records",
                                        events.string(),
                                        "--die-with-parent",
                                        "--gtest_brief=1"};
    for (const std::string& argument : opening_of(fault)) command.push_back(argument);
    if (label == as_text(fault["name"]))
      command.insert(command.end(), {"--fault", label, "--gtest_fail_fast"});
    SuiteChild child(command, events, request_.scratch / (label + ".log"), {request_.seconds_per_test});
    while (!child.look(kLook)) continue;
    return child.run();
  }

  const TableRequest& request_;
  std::map<std::string, const json*> by_name_;
  std::mutex mutex_;  // for what follows: the first to ask finds out, the others wait for it
  std::map<std::pair<std::string, Depth>, std::map<std::string, bool>> sound_;
};

}  // namespace

json try_faults(const TableRequest& request,
                const std::function<void(std::size_t done, const std::string& fault)>& progress) {
  Trial trial(request);
  std::vector<json> results(request.faults.size());
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < request.faults.size() && !interrupted;) {
      progress(done, request.faults[i]["name"]);
      results[i] = trial.try_fault(request.faults[i]);
      ++done;
    }
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < request.jobs; ++i) workers.emplace_back(work);
  workers.clear();
  json all = json::array();
  for (json& result : results)
    if (!result.is_null()) all.push_back(std::move(result));
  return all;
}

json faults_by_requirement(const json& faults, const std::vector<std::string>& decided) {
  json table = json::array();
  for (const std::string& id : decided) {
    json names = json::array();
    for (const json& fault : faults)
      for (const json& cell : fault["requirements"])
        if (as_text(cell["id"]) == id || cell["id"].get<std::string>().starts_with(id + "/")) {
          names.push_back(fault["name"]);
          break;
        }
    table.push_back({{"id", id}, {"faults", std::move(names)}});
  }
  return table;
}

std::string as_markdown(const json& table) {
  std::map<std::string, const json*> by_name;
  for (const json& fault : table["faults"]) by_name[fault["name"]] = &fault;
  std::string text =
      "# Faults\n\nWhat was broken on purpose, one defect at a time, and the test that betrays it.\n\n"
      "| requirement | fault | level | in | caught by | at depth |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const json& row : table["requirements"]) {
    const std::string id = row["id"];
    if (row["faults"].empty()) text += fmt::format("| {} | none | | | | |\n", id);
    for (const std::string name : row["faults"]) {
      const json& fault = *by_name.at(name);
      for (const json& cell : fault["requirements"]) {
        const std::string of_cell = cell["id"];
        if (of_cell != id && !of_cell.starts_with(id + "/")) continue;
        const std::string by = cell["caught"] ? cell["test"].get<std::string>() : "**nothing**";
        text += fmt::format("| {} | {}: {} | {} | {} | {} | {} |\n", of_cell, name,
                            fault["what"].get<std::string>(), fault["level"].get<std::string>(),
                            fault["implementation"].get<std::string>(), by, cell.value("depth", ""));
      }
    }
  }
  return text;
}

}  // namespace evalcts::faults
