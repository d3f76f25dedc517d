// Writes and reads faults and their table as JSON, and writes them as Markdown.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include <evalcts/faults/fault_table.h>
#include <evalcts/results/json_object.h>

namespace evalcts::faults {
namespace {

using nlohmann::json;

constexpr const char* kOutcomeNames[] = {"detected", "survives", "not-tried"};

json to_json(const ListedFault& fault) {
  return {{"name", fault.name},
          {"implementation", fault.implementation},
          {"level", name_of(fault.level)},
          {"requirements", fmt::format("{}", fmt::join(fault.requirements, " "))},
          {"what", fault.what},
          {"kind", fault.kind}};
}

json to_json(const Detection& detection) {
  json out = {{"id", detection.requirement}, {"detected", detection.detected}};
  if (detection.detected)
    out.update({{"test", detection.test},
                {"test_level", name_of(detection.test_level)},
                {"depth", name_of(detection.depth)},
                {"verdict", text_of(detection.verdict).word},
                {"message", detection.message}});
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

}  // namespace

FaultTable make_table(std::vector<TriedFault> faults, const std::vector<std::string>& decided) {
  FaultTable table;
  for (const std::string& id : decided) {
    FaultTable::Row row{id, {}};
    for (const TriedFault& tried : faults)
      if (std::ranges::any_of(tried.detections,
                              [&](const Detection& each) { return belongs_to(each.requirement, id); }))
        row.faults.push_back(tried.fault.name);
    table.requirements.push_back(std::move(row));
  }
  table.faults = std::move(faults);
  return table;
}

std::string as_markdown(const FaultTable& table) {
  std::map<std::string, const TriedFault*> by_name;
  for (const TriedFault& tried : table.faults) by_name[tried.fault.name] = &tried;
  std::string text =
      "# Faults\n\nInjected faults, one at a time, and the test that detects each.\n\n"
      "| requirement | fault | level | in | detected by | at depth |\n| --- | --- | --- | --- | --- | --- "
      "|\n";
  for (const FaultTable::Row& row : table.requirements) {
    if (row.faults.empty()) text += fmt::format("| {} | none | | | | |\n", row.requirement);
    for (const std::string& name : row.faults) {
      const auto& [fault, outcome, reason, detections] = *by_name.at(name);
      for (const Detection& each : detections)
        if (belongs_to(each.requirement, row.requirement))
          text += fmt::format("| {} | {}: {} | {} | {} | {} | {} |\n", each.requirement, name, fault.what,
                              name_of(fault.level), fault.implementation,
                              each.detected ? each.test : "**nothing**",
                              each.detected ? name_of(each.depth) : "");
    }
  }
  return text;
}

std::string to_text(const FaultTable& table) {
  json faults = json::array(), requirements = json::array();
  for (const TriedFault& tried : table.faults) {
    json fault = to_json(tried.fault);
    fault["outcome"] = kOutcomeNames[static_cast<std::size_t>(tried.outcome)];
    fault["reason"] = tried.reason;
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

std::string to_text(const std::vector<ListedFault>& faults) {
  json all = json::array();
  for (const ListedFault& fault : faults) {
    all.push_back(to_json(fault));
    all.back()["arguments"] = fault.arguments;
  }
  return json{{"faults", all}}.dump(1) + "\n";
}

std::optional<std::vector<ListedFault>> parse_faults(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  if (!value.is_object() || !value.contains("faults")) return std::nullopt;
  std::vector<ListedFault> faults;
  JsonObject(value, "faults").each_object("faults", [&](const JsonObject& in) {
    faults.push_back({in.text("name"), in.text("implementation"), in.texts("arguments"),
                      in.word("level", level_named).value_or(Level::kMust), words_of(in.text("requirements")),
                      in.text("what"), in.text("kind")});
  });
  return faults;
}

}  // namespace evalcts::faults
