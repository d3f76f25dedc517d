// Checks the structure of a file of vectors: the schema, and the counts that a schema cannot express.
#include <fmt/format.h>

#include <map>

#include <evalcts/vectors/json_schema.h>
#include <evalcts/vectors/lint.h>
#include "schema_text.h"
#include "write/problem.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

[[noreturn]] void complain(const std::string& where, const std::string& what) {
  throw Malformed(fmt::format("{}: {}", where, what));
}

const json& file_schema() {
  static const json kSchema = parse_json(kSchemaText);
  return kSchema;
}

// The schema of a file without its cases. The cases are validated one by one by the definition of their kind,
// so that messages begin with the id of the case.
const JsonSchema& head_schema() {
  static const JsonSchema kSchema([] {
    json head = file_schema();
    head.erase("oneOf");
    return head;
  }());
  return kSchema;
}

const JsonSchema& case_schema(const std::string& kind, const json& entry) {
  static const std::map<std::string, JsonSchema> kSchemas = [] {
    std::map<std::string, JsonSchema> all;
    for (const char* name : {"map1_eval", "map2_eval", "grid1", "grid2", "auto_normal", "sequence"})
      all.try_emplace(name, json{{"allOf", {{{"$ref", fmt::format("#/definitions/{}", name)}}}},
                                 {"definitions", file_schema()["definitions"]}});
    return all;
  }();
  if (kind == "grid") return kSchemas.at(entry.contains("v") ? "grid2" : "grid1");
  const auto found = kSchemas.find(kind);
  return found == kSchemas.end() ? kSchemas.at("sequence") : found->second;
}

// Checks the counts that follow from the target of the map, for cases that have a map.
void check_counts(const json& entry, const std::string& id) {
  const std::string target = entry["map"]["target"];
  const auto k = static_cast<std::size_t>(problem_of(entry).map.components());
  if (entry.contains("components") && entry["components"].size() != k)
    complain(id, fmt::format("'components' has {} entries for {} components", entry["components"].size(), k));
  if (entry.contains("quotients") && !target.ends_with("VERTEX_4")) complain(id, "quotients without w");
  if (!entry.contains("derivatives")) return;
  for (const char* direction : {"u", "v"})
    if (entry["derivatives"][direction].size() != k)
      complain(id, fmt::format("'derivatives/{}' has {} entries for {} components", direction,
                               entry["derivatives"][direction].size(), k));
  if (entry["m"].is_null() && !entry["normal"].is_null()) complain(id, "a normal without m");
}

}  // namespace

void check_structure(const json& file) {
  json head = file;
  const bool has_cases = file.is_object() && file.contains("cases") && file["cases"].is_array();
  if (has_cases && !file["cases"].empty()) head["cases"] = json::array({nullptr});
  if (const std::string complaint = head_schema().complaint(head); !complaint.empty())
    throw Malformed("file" + complaint);
  for (std::size_t i = 0; i < file["cases"].size(); ++i) {
    const json& entry = file["cases"][i];
    const bool has_id = entry.is_object() && entry.contains("id") && entry["id"].is_string();
    const std::string id = has_id ? entry["id"].get<std::string>() : fmt::format("case {}", i + 1);
    if (const std::string complaint = case_schema(file["kind"], entry).complaint(entry); !complaint.empty())
      throw Malformed(id + complaint);
    if (!entry.contains("map")) continue;
    try {
      check_counts(entry, id);
    } catch (const std::invalid_argument& problem) {
      complain(id, problem.what());
    }
  }
}

}  // namespace evalcts::vectors
