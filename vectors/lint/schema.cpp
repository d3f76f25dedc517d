#include "vectors/lint/lint.h"

#ifdef EVALCTS_HAS_VALIJSON

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace evalcts::vectors {

using valijson::adapters::NlohmannJsonAdapter;

bool has_schema_validator() { return true; }

std::string complaints_by_schema(const nlohmann::json& file, const nlohmann::json& schema) {
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(NlohmannJsonAdapter(schema), parsed);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(parsed, NlohmannJsonAdapter(file), &results)) return {};
  std::string words;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    words += words.empty() ? "" : "; ";
    for (const std::string& step : error.context) words += step;
    words += ": " + error.description;
    if (words.size() > 500) break;
  }
  return words.empty() ? "not valid" : words;
}

}  // namespace evalcts::vectors

#else

namespace evalcts::vectors {

bool has_schema_validator() { return false; }

std::string complaints_by_schema(const nlohmann::json&, const nlohmann::json&) { return {}; }

}  // namespace evalcts::vectors

#endif
