// Records for the tests: read from tests/sample, or built here if a JSON file cannot contain them.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/files.h>
#include <evalcts/results/json.h>
#include <evalcts/results/serialization.h>
#include "evalcts/reports.h"

namespace evalcts::reports {

inline nlohmann::json read_sample(const std::string& name) {
  return parse_json(read_file(std::string(EVALCTS_REPORTS_SAMPLES) + "/" + name));
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Returns an earlier version of results-osmesa.json: since then there are a regression, a fix, a new and a
// vanished test.
inline nlohmann::json earlier_sample() {
  nlohmann::json record = read_sample("results-osmesa.json");
  record["status"] = "complete";
  record["implementation"]["version"] = "4.5 (Compatibility Profile) Mesa 21.0.0";
  nlohmann::json& tests = record["tests"];
  for (nlohmann::json& test : tests) {
    if (as_text(test["name"]) == "Map1Values.Bezier/TEXTURE_COORD_1/d") test["verdict"] = "pass";
    if (as_text(test["name"]) == "Map1Values.Bezier/TEXTURE_COORD_1/f") test["verdict"] = "fail";
    if (as_text(test["name"]) == "Map2Output.HugeGrid") test["name"] = "Map2Output.OnceWas";
  }
  return record;
}

// Returns everything that could break out of HTML, XML or a terminal: markup, quotes, the end of a CDATA
// section, template tags, control characters, a C1 control, a noncharacter, an encoded surrogate, and a lone
// lead byte.
inline std::string hostile_text() {
  return std::string("<script>alert(1)</script> \" ' & ]]> --> {{name}} {{{name}}} ") + std::string("\0", 1) +
         "\x01\x1b[31m\x7f \xC2\x9B \xEF\xBF\xBF \xED\xA0\x80 \xC3\xA9 \xFF\xC3";
}

// Returns a record with hostile_text() in every place where a record has text.
inline nlohmann::json hostile_record() {
  using nlohmann::json;
  const std::string text = hostile_text();
  const json failure = {{"case", text},     {"message", text}, {"what", text},    {"expected", text},
                        {"captured", text}, {"exact", text},   {"capture", text}, {"calls", {text, text}}};
  const auto test = [&](const std::string& name, const char* verdict) {
    return json{{"name", name},
                {"requirements", {text}},
                {"level", "must"},
                {"verdict", verdict},
                {"message", text},
                {"baseline_reason", text},
                {"failures", {failure}},
                {"rerun", text},
                {"debug", text},
                {"reproducer", text},
                {"accuracy", {{"values", 1}, {"worst", text}}}};
  };
  return {{"format", "evalcts-results-1"},
          {"evalcts_version", text},
          {"status", "interrupted"},
          {"reason", text},
          {"command", text},
          {"depth", "quick"},
          {"implementation",
           {{"name", text},
            {"library", text},
            {"context_library", text},
            {"vendor", text},
            {"renderer", text},
            {"version", text},
            {"machine", text},
            {"note", text},
            {"files", {text}},
            {"captures", {{{"name", text}, {"available", false}, {"reason", text}}}}}},
          {"tests",
           {test("A." + text, "fail"), test("B." + text, "not-observable"),
            test("C." + text, "quality-warning"), test("D." + text, "pass"), test("E." + text, "crash")}},
          {"bugs",
           {{{"id", text},
             {"title", text},
             {"cause", text},
             {"requirements", {text}},
             {"clause", text},
             {"level", "must"},
             {"verdict", "fail"},
             {"failure", failure},
             {"commands", {{text, {{text, {text}}}}}},
             {"why_not_reduced", text},
             {"tests", {"A." + text}},
             {"explains", {text}},
             {"known", text},
             {"known_in", text}}}},
          {"bugs_note", text}};
}

inline nlohmann::json hostile_requirements() {
  const std::string text = hostile_text();
  return {{"requirements",
           {{{"id", text}, {"section", text}, {"text", text}, {"source", text}, {"since", text}}}}};
}

// The following functions have the suffix _of and make the report of this name from records in JSON.
struct JsonOptions {
  std::vector<nlohmann::json> before;
  std::vector<std::vector<std::string>> files;
  std::string sources;
};

inline std::vector<RunResult> results_of(const std::vector<nlohmann::json>& records) {
  std::vector<RunResult> out;
  for (const nlohmann::json& record : records) out.push_back(read_run_result(record));
  return out;
}
inline Catalogue catalogue_of(const nlohmann::json& json) {
  using Handling = nlohmann::json::error_handler_t;
  return json.is_null() ? Catalogue() : Catalogue::parse(json.dump(-1, ' ', false, Handling::replace));
}
inline std::string html_of(const std::vector<nlohmann::json>& results, const nlohmann::json& catalogue,
                           const JsonOptions& options = {}) {
  return html(results_of(results), catalogue_of(catalogue),
              {.before = results_of(options.before),
               .history = {},
               .files = options.files,
               .sources = options.sources});
}
inline std::string junit_of(const nlohmann::json& result) { return junit(read_run_result(result)); }
inline std::string terminal_of(const nlohmann::json& result, const nlohmann::json& catalogue, bool colour,
                               bool verbose, std::size_t lines = 0, std::size_t columns = 0) {
  return terminal_summary(read_run_result(result), catalogue_of(catalogue), colour, verbose, lines, columns);
}
inline std::string terminal_line_of(const nlohmann::json& result, bool colour) {
  return terminal_line(read_run_result(result), colour);
}
inline std::string markdown_of(const std::vector<nlohmann::json>& results,
                               const std::vector<nlohmann::json>& before = {}) {
  return markdown_summary(results_of(results), results_of(before));
}
inline std::string table_of(const std::vector<nlohmann::json>& results, const nlohmann::json& catalogue) {
  return requirements_table(results_of(results), catalogue_of(catalogue));
}
inline std::vector<RunResult> merge_of(const std::vector<nlohmann::json>& results) {
  return merge_shards(results_of(results));
}
inline Changes changes_of(const std::vector<nlohmann::json>& results,
                          const std::vector<nlohmann::json>& before) {
  return changes(results_of(results), results_of(before));
}

}  // namespace evalcts::reports
