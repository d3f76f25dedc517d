// JSON Schemas (draft 7), validated by valijson.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace evalcts {

class JsonSchema {
 public:
  explicit JsonSchema(const nlohmann::json& text);
  ~JsonSchema();

  // Returns the first violation, preceded by its place as a JSON pointer, as in "/map/points/0: ..."; empty
  // if there is none.
  std::string complaint(const nlohmann::json& value) const;

 private:
  struct Parsed;
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace evalcts
