// Writes results and events as JSON. Optional fields that are empty are omitted.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <tuple>

#include <evalcts/results/json.h>
#include <evalcts/results/serialization.h>

namespace evalcts {
namespace {

using nlohmann::json;

// JSON has no infinity.
json number(double value) { return std::isfinite(value) ? json(value) : json(); }

std::string dumped(const json& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace) + "\n";
}

// Sets a member unless the value is empty.
template <class T>
void set(json& object, const char* member, const std::optional<T>& value) {
  if (value) object[member] = *value;
}
void set(json& object, const char* member, const std::string& value) {
  if (!value.empty()) object[member] = value;
}
void set(json& object, const char* member, bool value) {
  if (value) object[member] = true;
}
void set(json& object, const char* member, const char* value) = delete;

void set_distances(json& object, const Failure& failure) {
  if (failure.ulp) object["ulp"] = number(*failure.ulp);
  if (failure.condition_aware) object["condition_aware"] = number(*failure.condition_aware);
}

// Five digits are enough for a picture. JSON has no infinities: they become null.
json rounded(float value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}

json to_json(const std::vector<PlottedPrimitive>& primitives) {
  json out = json::array();
  for (const PlottedPrimitive& primitive : primitives) {
    json positions = json::array();
    for (const auto& position : primitive.positions)
      for (const float coordinate : position) positions.push_back(rounded(coordinate));
    out.push_back({{"mode", primitive.mode}, {"positions", std::move(positions)}});
  }
  return out;
}

json to_json(const PlottedPixels& pixels) {
  return {{"x", pixels.x},
          {"y", pixels.y},
          {"width", pixels.width},
          {"height", pixels.height},
          {"expected", pixels.expected},
          {"captured", pixels.captured}};
}

json to_json(const Plot& plot) {
  json out = {{"captured", to_json(plot.captured)}};
  if (plot.expected) out["expected"] = to_json(*plot.expected);
  for (const PlottedPixels& pixels : plot.pixels) out["pixels"].push_back(to_json(pixels));
  set(out, "cut", plot.is_cut);
  return out;
}

json to_json(const Failure& failure) {
  json out = {{"case", failure.case_identity}, {"message", failure.message},   {"what", failure.what},
              {"expected", failure.expected},  {"captured", failure.captured}, {"calls", failure.calls}};
  if (!failure.difference.kind.empty()) out["difference"] = failure.difference.text();
  set(out, "exact", failure.exact);
  set(out, "capture", failure.capture);
  set_distances(out, failure);
  if (failure.plot) out["plot"] = to_json(*failure.plot);
  return out;
}

json to_json(const Accuracy& accuracy) {
  return {{"values", accuracy.values},
          {"max_ulp", number(accuracy.ulp.error)},
          {"max_condition_aware", number(accuracy.condition_aware.error)},
          {"incorrectly_rounded", accuracy.not_correctly_rounded},
          {"all_terms_zero", accuracy.all_terms_zero},
          {"all_terms_zero_wrong", accuracy.all_terms_zero_wrong},
          {"not_judged", accuracy.not_judged},
          {"worst", accuracy.ulp.where},
          {"worst_exact", accuracy.ulp.exact},
          {"worst_condition_aware", accuracy.condition_aware.where}};
}

json to_json(const Crash& crash) {
  json out = {{"call", crash.call}, {"commands_before", crash.commands_before}};
  if (!crash.frames.empty()) out["frames"] = crash.frames;
  return out;
}

json to_json(const TestRecord& test) {
  json out = {{"name", test.name},
              {"requirements", texts_of(test.requirements)},
              {"level", name_of(test.level)},
              {"verdict", text_of(test.verdict).word},
              {"message", test.message},
              {"expected_by_baseline", test.expected_by_baseline},
              {"baseline_reason", test.baseline_reason}};
  if (!test.known_bugs.empty()) out["known_bugs"] = test.known_bugs;
  set(out, "source", test.source);
  if (!test.violated.empty()) out["violated"] = texts_of(test.violated);
  set(out, "cases", test.cases);
  set(out, "failed_cases", test.failed_cases);
  set(out, "seed", test.seed);
  set(out, "seconds", test.seconds);
  if (!test.mismatches.empty()) out["mismatches"] = test.mismatches;
  if (!test.signature_of_all.empty()) out["signature_of_all"] = test.signature_of_all;
  out["failures"] = json::array();
  for (const Failure& failure : test.failures) out["failures"].push_back(to_json(failure));
  set(out, "capture", test.capture);
  set(out, "unobserved", test.unobserved);
  if (!test.left_out.empty()) out["left_out"] = test.left_out;
  if (test.crash) out["crash"] = to_json(*test.crash);
  if (!test.failures.empty()) {
    // The fields of the first failing case are repeated at the level of the test.
    const Failure& first = test.failures.front();
    out["calls"] = first.calls;
    out["expected"] = first.expected;
    out["captured"] = first.captured;
    set(out, "capture", first.capture);
    set_distances(out, first);
  }
  if (test.accuracy) out["accuracy"] = to_json(*test.accuracy);
  if (!test.readings.empty()) out["readings"] = test.readings;
  set(out, "also_in_fresh_context", test.also_in_fresh_context);
  set(out, "history", test.history);
  set(out, "history_case", test.history_case);
  set(out, "flake", test.flake);
  if (test.again)
    out["again"] = {{"verdict", text_of(test.again->verdict).word}, {"message", test.again->message}};
  set(out, "rerun", test.rerun);
  set(out, "debug", test.debug);
  set(out, "reproducer", test.reproducer);
  return out;
}

json to_json(const Bug& bug) {
  json out = {{"id", bug.id},
              {"title", bug.title},
              {"cause", bug.cause},
              {"requirements", texts_of(bug.requirements)},
              {"clause", bug.clause},
              {"level", name_of(bug.level)},
              {"verdict", text_of(bug.verdict).word},
              {"failure", to_json(bug.failure)},
              {"tests", bug.tests},
              {"explains", texts_of(bug.explains)}};
  if (const json commands = json::parse(bug.commands, nullptr, false); !commands.is_discarded())
    out["commands"] = commands;
  set(out, "why_not_reduced", bug.why_not_reduced);
  set(out, "outside_evaluators", bug.outside_evaluators);
  set(out, "known", bug.known);
  set(out, "known_in", bug.known_in);
  set(out, "breaks_real_programs", bug.breaks_real_programs);
  return out;
}

json to_json(const CaptureRecord& capture) {
  json out = {{"name", capture.name}, {"available", capture.available}, {"reason", capture.reason}};
  set(out, "shows", capture.shows);
  return out;
}

json to_json(const ImplementationRecord& implementation) {
  json out = {{"name", implementation.name}};
  set(out, "kind", implementation.kind);
  set(out, "library", implementation.library);
  set(out, "context_library", implementation.context_library);
  set(out, "vendor", implementation.vendor);
  set(out, "renderer", implementation.renderer);
  set(out, "version", implementation.version);
  set(out, "machine", implementation.machine);
  set(out, "note", implementation.note);
  set(out, "max_eval_order", implementation.max_eval_order);
  if (!implementation.files.empty()) out["files"] = implementation.files;
  if (!implementation.captures.empty()) out["captures"] = json::array();
  for (const CaptureRecord& capture : implementation.captures) out["captures"].push_back(to_json(capture));
  return out;
}

json to_json(const std::vector<ListedTest>& tests) {
  json out = json::array();
  for (const ListedTest& test : tests)
    out.push_back({{"name", test.name},
                   {"requirements", texts_of(test.requirements)},
                   {"level", name_of(test.level)},
                   {"from", name_of(test.from)},
                   {"source", test.source}});
  return out;
}

}  // namespace

std::string to_text(const std::vector<ListedTest>& tests) { return dumped({{"tests", to_json(tests)}}, -1); }

std::string to_text(const RunResult& result) {
  json out = {{"format", "evalcts-results-1"},
              {"evalcts_version", result.evalcts_version},
              {"reason", result.reason},
              {"command", result.command},
              {"implementation", to_json(result.implementation)},
              {"tests", json::array()}};
  if (result.status) out["status"] = name_of(*result.status);
  if (!result.suite_command.empty()) out["suite_command"] = result.suite_command;
  set(out, "started", result.started);
  set(out, "seconds", result.seconds);
  set(out, "host", result.host);
  set(out, "timeout", result.timeout);
  set(out, "memory", result.memory);
  if (result.depth) out["depth"] = name_of(*result.depth);
  set(out, "filter", result.filter);
  set(out, "seed", result.seed);
  set(out, "pass", std::string(name_of(result.pass)));
  if (result.shard) out["shard"] = result.shard->text();
  set(out, "baseline", result.baseline);
  if (!result.stale_baseline_entries.empty()) out["stale_baseline_entries"] = result.stale_baseline_entries;
  set(out, "strict", result.strict);
  if (result.confirmed_by_group) out["confirmed_by_group"] = result.confirmed_by_group;
  if (!result.readings.empty()) out["readings"] = result.readings;
  json& summary = out["summary"] = json::object();
  for (std::size_t i = 0; i < kVerdicts; ++i)
    if (result.counts[i]) summary[std::string(text_of(static_cast<Verdict>(i)).word)] = result.counts[i];
  for (const TestRecord& test : result.tests) out["tests"].push_back(to_json(test));
  if (!result.bugs.empty()) out["bugs"] = json::array();
  for (const Bug& bug : result.bugs) out["bugs"].push_back(to_json(bug));
  set(out, "bugs_note", result.bugs_note);
  return dumped(out, 1);
}

std::string to_line(const Job& job) {
  json out = {{"job", job.kind}, {"name", job.name}};
  set(out, "cases", job.cases);
  set(out, "traces_cases", job.traces_cases);
  set(out, "runs_control", job.runs_control);
  set(out, "data", job.data);
  return dumped(out, -1);
}

std::string to_line(const Event& event) {
  struct Writer {
    json operator()(const JobStarted& start) const { return {{"event", "start"}, {"name", start.name}}; }
    json operator()(const JobEnded&) const { return {{"event", "done"}}; }
    json operator()(const CaseStarted& start) const {
      json event = {
          {"event", "case"}, {"case", start.identity}, {"calls", start.calls}, {"commands", start.commands}};
      if (start.is_control) event["control"] = true;
      return event;
    }
    json operator()(const CaseFailed& failed) const {
      return {{"event", "failing-case"}, {"name", failed.test}, {"commands", failed.commands}};
    }
    json operator()(const TestFinished& result) const {
      return {{"event", "result"}, {"record", to_json(result.record)}};
    }
    json operator()(const TestsListed& listing) const {
      // Many tests have the same properties, so the names are in groups.
      std::map<std::tuple<std::vector<RequirementId>, Level, Depth, std::string>,
               std::vector<std::string_view>>
          groups;
      for (const ListedTest& test : listing.tests)
        groups[{test.requirements, test.level, test.from, test.source}].push_back(test.name);
      json out = json::array();
      for (const auto& [properties, names] : groups) {
        const auto& [requirements, level, from, source] = properties;
        out.push_back({{"requirements", texts_of(requirements)},
                       {"level", name_of(level)},
                       {"from", name_of(from)},
                       {"source", source},
                       {"names", names}});
      }
      return {{"event", "tests"}, {"groups", std::move(out)}};
    }
    json operator()(const Description& description) const {
      return {{"event", "description"},
              {"implementation", to_json(description.implementation)},
              {"all_captures", description.captures}};
    }
    json operator()(const CaptureRecord& capture) const {
      return {{"event", "capture"}, {"capture", to_json(capture)}};
    }
    json operator()(const CannotOpen& why) const {
      return {{"event", "cannot-open"}, {"reason", why.reason}};
    }
    json operator()(const Crashed& crashed) const {
      return {{"event", "crash"}, {"crash", to_json(crashed.crash)}};
    }
    json operator()(const RunEnded&) const { return {{"event", "end"}}; }
    json operator()(const OtherEvent& other) const { return json::parse(other.line, nullptr, false); }
  };
  return dumped(std::visit(Writer(), event), -1);
}

}  // namespace evalcts
