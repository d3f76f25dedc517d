// Implements JsonSchema with valijson.
#include <evalcts/vectors/json_schema.h>

#include <fmt/format.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include <evalcts/results/json.h>

namespace evalcts {

using nlohmann::json;
using valijson::adapters::NlohmannJsonAdapter;

struct JsonSchema::Parsed {
  valijson::Schema schema;
};

JsonSchema::JsonSchema(const json& text) : parsed_(std::make_unique<Parsed>()) {
  valijson::SchemaParser().populateSchema(NlohmannJsonAdapter(text), parsed_->schema);
}
JsonSchema::~JsonSchema() = default;

std::string JsonSchema::complaint(const json& value) const {
  // It keeps the compiled regular expressions, whose compilation takes most of the time of a validation.
  thread_local valijson::Validator validator;
  valijson::ValidationResults results;
  // Without results the validator stops at the first violation and describes none.
  if (validator.validate(parsed_->schema, NlohmannJsonAdapter(value), nullptr)) return {};
  validator.validate(parsed_->schema, NlohmannJsonAdapter(value), &results);
  valijson::ValidationResults::Error error;
  if (!results.popError(error)) return ": not valid";
  // The innermost violation comes first. Its context is "<root>", "[map]", "[points]", "[0]"; from
  // valijson 1.1 on, names are in quotes: "[\"map\"]".
  json::json_pointer place;
  for (std::size_t i = 1; i < error.context.size(); ++i) {
    const std::string step = error.context[i].substr(1, error.context[i].size() - 2);
    place.push_back(step.starts_with('"') ? parse_json(step).get<std::string>() : step);
  }
  std::string given = value.at(place).dump();
  if (given.size() > 60) given = given.substr(0, 57) + "...";
  return fmt::format("{}: {}: {}", place.to_string(), error.description, given);
}

}  // namespace evalcts
