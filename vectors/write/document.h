// Builds a file of vectors.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// JSON whose members keep the order of their insertion.
using Json = nlohmann::ordered_json;

inline constexpr const char* kFormat = "evalcts-vectors-1";
// Version of the schema. The second number is incremented if members are added.
inline constexpr const char* kSchemaVersion = "1.1";
// Incremented with each change of the cases of values and normals.
inline constexpr const char* kGeneratorVersion = "3";

// The value of `since` of a case whose answers all versions of GL require.
inline constexpr const char* kFirstVersion = "1.0";

using Names = std::vector<std::string>;

class Document {
 public:
  Document(std::string kind, std::string description);

  // Adds the meaning of a flag to the notes. Throws std::logic_error if it already has another meaning.
  void explain(const std::string& flag, const std::string& meaning);
  // Adds a case with the members of `content`. "level" is "must" and "since" is "1.0" unless `content` has
  // these members. Throws std::logic_error for a flag without a meaning and an id that occurs twice.
  void add(const std::string& id, const Names& requirements, const Names& flags, const Json& content);

  const std::string& kind() const { return kind_; }
  std::size_t size() const { return cases_.size(); }
  // Returns the text of the file, with each case on its own line.
  std::string text() const;

 private:
  std::string kind_, description_;
  Json notes_;
  std::set<std::string> ids_;
  std::vector<std::string> cases_;
};

}  // namespace evalcts::vectors
