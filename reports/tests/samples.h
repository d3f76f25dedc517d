// Records for the tests: read from tests/sample, or built here where JSON text cannot hold what is wanted.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

#include "harness/results/json.h"

namespace evalcts::reports {

inline nlohmann::json read_sample(const std::string& name) {
  std::ifstream in(std::string(EVALCTS_REPORTS_SAMPLES) + "/" + name);
  if (!in) throw std::runtime_error("no sample " + name);
  return nlohmann::json::parse(in);
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// results-osmesa.json as it could have been before: with a regression, a fix, a new and a vanished test
// since.
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

// Everything that could break out of HTML, XML or a terminal: markup, quotes, the end of a CDATA section,
// template tags, control characters, a C1 control, a noncharacter, an encoded surrogate, a lone lead byte.
inline std::string hostile_text() {
  return std::string("<script>alert(1)</script> \" ' & ]]> --> {{name}} {{{name}}} ") + std::string("\0", 1) +
         "\x01\x1b[31m\x7f \xC2\x9B \xEF\xBF\xBF \xED\xA0\x80 \xC3\xA9 \xFF\xC3";
}

// Hostile text in every place where a record holds text.
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
          {"depth", text},
          {"implementation",
           {{"name", text},
            {"library", text},
            {"vendor", text},
            {"renderer", text},
            {"version", text},
            {"machine", text},
            {"note", text},
            {"files", {text}},
            {"captures", {{{"name", text}, {"available", false}, {"reason", text}}}}}},
          {"tests",
           {test("A." + text, "fail"), test("B." + text, "not-observable"),
            test("C." + text, "quality-warning"), test("D." + text, "pass"), test("E." + text, "crash")}}};
}

inline nlohmann::json hostile_requirements() {
  const std::string text = hostile_text();
  return {{"requirements",
           {{{"id", text}, {"section", text}, {"text", text}, {"source", text}, {"since", text}}}}};
}

}  // namespace evalcts::reports
