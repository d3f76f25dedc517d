// Writes and reads lists of changes as JSON, and writes the outcomes of trials as JSON and Markdown.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>

#include <evalcts/faults/trial.h>
#include <evalcts/results/json_object.h>

namespace evalcts::faults {
namespace {

using nlohmann::json;

json to_json(const ListedChange& change) {
  return {{"name", change.name},
          {"implementation", change.implementation},
          {"level", name_of(change.level)},
          {"requirements", fmt::format("{}", fmt::join(change.requirements, " "))},
          {"what", change.what},
          {"kind", change.kind}};
}

json to_json(const Detection& detection) {
  json out = {{"id", detection.subject}, {"detected", detection.is_detected()}};
  if (detection.is_detected())
    out.update({{"test", detection.first.test},
                {"test_level", name_of(detection.first.level)},
                {"depth", name_of(detection.first.depth)},
                {"verdict", text_of(detection.first.verdict).word},
                {"message", detection.first.message}});
  return out;
}

// True if `requirement` is `id` or a half of `id`.
bool belongs_to(const std::string& requirement, const std::string& id) {
  return requirement == id || requirement.starts_with(id + "/");
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string alarms_of(const Tried& tried) {
  if (!tried.not_tried.empty()) return "not tried: " + tried.not_tried;
  std::string text = tried.alarms.empty() ? "none" : "";
  for (const BadTest& alarm : tried.alarms)
    text += fmt::format("{}**{}** {}", text.empty() ? "" : ", ", text_of(alarm.verdict).word, alarm.test);
  return text;
}

}  // namespace

bool Tried::is_good() const {
  return not_tried.empty() && alarms.empty() && std::ranges::none_of(detections, [](const Detection& each) {
           return each.outcome == Detection::Outcome::kSurvives;
         });
}

FaultTable make_table(std::vector<Tried> faults, const std::vector<std::string>& decided) {
  FaultTable table;
  for (const std::string& id : decided) {
    FaultTable::Row row{id, {}};
    for (const Tried& tried : faults)
      if (std::ranges::any_of(tried.detections, [&](const Detection& each) {
            return belongs_to(each.subject, id) && each.outcome != Detection::Outcome::kNotVisible;
          }))
        row.faults.push_back(tried.change.name);
    table.requirements.push_back(std::move(row));
  }
  table.faults = std::move(faults);
  return table;
}

std::string as_markdown(const FaultTable& table) {
  std::map<std::string, const Tried*> by_name;
  for (const Tried& tried : table.faults) by_name[tried.change.name] = &tried;
  std::string text =
      "# Faults\n\nInjected faults, one at a time, and the test that detects each.\n\n"
      "| requirement | fault | level | in | detected by | at depth |\n| --- | --- | --- | --- | --- | --- "
      "|\n";
  for (const FaultTable::Row& row : table.requirements) {
    if (row.faults.empty()) text += fmt::format("| {} | none | | | | |\n", row.requirement);
    for (const std::string& name : row.faults) {
      const ListedChange& fault = by_name.at(name)->change;
      for (const Detection& each : by_name.at(name)->detections)
        if (belongs_to(each.subject, row.requirement))
          text += fmt::format("| {} | {}: {} | {} | {} | {} | {} |\n", each.subject, name, fault.what,
                              name_of(fault.level), fault.implementation,
                              each.is_detected()                                ? each.first.test
                              : each.outcome == Detection::Outcome::kNotVisible ? each.reason
                                                                                : "**nothing**",
                              each.is_detected() ? name_of(each.first.depth) : "");
    }
  }
  return text;
}

std::string as_markdown(const std::vector<Tried>& variations) {
  std::string text =
      "# Variations\n\nConforming implementations that differ from those that the suite was developed with, "
      "and what the tests say of them, at quick depth. No test may fail. Typical faults behind a variation "
      "have to be detected as far as they are visible. Tests of requirements that a variation violates may "
      "fail.\n\n"
      "| variation | in front of | passes | in part | not observable | false alarms | faults detected | not "
      "visible | surviving |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Tried& tried : variations) {
    std::map<Detection::Outcome, std::string> faults;
    for (const Detection& each : tried.detections) {
      std::string& names = faults[each.outcome];
      names += (names.empty() ? "" : " ") + each.subject;
      if (each.outcome == Detection::Outcome::kNotVisible) names += fmt::format(" ({})", each.reason);
    }
    text += fmt::format("| {}: {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", tried.change.name,
                        tried.change.what, tried.change.implementation, tried.passed, tried.passed_in_part,
                        tried.unobserved, alarms_of(tried), faults[Detection::Outcome::kDetected],
                        faults[Detection::Outcome::kNotVisible], faults[Detection::Outcome::kSurvives]);
  }
  return text;
}

std::string to_text(const FaultTable& table) {
  json faults = json::array(), requirements = json::array();
  for (const Tried& tried : table.faults) {
    json fault = to_json(tried.change);
    fault["outcome"] = !tried.not_tried.empty() ? "not-tried" : tried.is_good() ? "detected" : "survives";
    fault["reason"] = tried.not_tried;
    fault["requirements"] = json::array();
    for (const Detection& each : tried.detections) fault["requirements"].push_back(to_json(each));
    faults.push_back(std::move(fault));
  }
  for (const FaultTable::Row& row : table.requirements)
    requirements.push_back({{"id", row.requirement}, {"faults", row.faults}});
  return json{{"format", "evalcts-faults-2"},
              {"status", table.is_complete ? "complete" : "interrupted"},
              {"faults", faults},
              {"requirements", requirements}}
             .dump(1, ' ', false, json::error_handler_t::replace) +
         "\n";
}

std::string to_text(const std::vector<ListedChange>& changes) {
  json all = json::array();
  for (const ListedChange& change : changes) {
    all.push_back(to_json(change));
    all.back()["arguments"] = change.arguments;
  }
  return json{{"faults", all}}.dump(1) + "\n";
}

std::optional<std::vector<ListedChange>> parse_changes(const std::string& text) {
  const json value = parse_json(text);
  if (!value.is_object() || !value.contains("faults")) return std::nullopt;
  std::vector<ListedChange> changes;
  JsonObject(value, "faults").each_object("faults", [&](const JsonObject& in) {
    changes.push_back({in.text("name"), in.text("implementation"), in.texts("arguments"),
                       in.word("level", level_named).value_or(Level::kMust),
                       words_of(in.text("requirements")), in.text("what"), in.text("kind")});
  });
  return changes;
}

}  // namespace evalcts::faults
