// Builds a file of vectors.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/json.h>
#include "dice.h"

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
  // these members. Throws std::logic_error for a flag without a meaning.
  void add(const std::string& id, const Names& requirements, const Names& flags, const Json& content);

  const std::string& kind() const { return kind_; }
  std::size_t size() const { return cases_.size(); }
  // Returns the text of the file, with each case on its own line. Throws std::logic_error if two cases have
  // the same id.
  std::string text() const;

 private:
  std::string kind_, description_;
  Json notes_;
  std::vector<std::string> ids_, cases_;
};

// A group of cases about one property. All have the name of the theme as a flag, and ids made from the kind,
// the theme and a number. Each theme draws random data from its own dice, so that new themes, and new cases
// at the end of a theme, change no other case.
class Theme {
 public:
  Theme(Document& document, const std::string& name, const std::string& meaning, Names requirements);

  Dice& dice() { return dice_; }
  void add(const Json& content, const Names& more_requirements = {}, const Names& more_flags = {});
  int count() const { return count_; }

 private:
  Document& document_;
  std::string name_;
  Names requirements_;
  Dice dice_;
  int count_ = 0;
};

}  // namespace evalcts::vectors
