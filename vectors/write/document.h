// A file of vectors while it is made.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/json.h>
#include "dice.h"

namespace evalcts::vectors {

// Members stay in the order in which they are put in.
using Json = nlohmann::ordered_json;

inline constexpr const char* kFormat = "evalcts-vectors-1";
// Version of the schema: the second number is raised if members are added.
inline constexpr const char* kSchemaVersion = "1.1";
// Raised with each change of the cases.
inline constexpr const char* kGeneratorVersion = "2";

// The first version of the GL that demands the answers of a case, and of a case that any version demands.
inline constexpr const char* kFirstVersion = "1.0";

using Names = std::vector<std::string>;

class Document {
 public:
  Document(std::string kind, std::string description);

  // Adds the meaning of a flag to the notes. Explaining it again with other words throws std::logic_error.
  void explain(const std::string& flag, const std::string& meaning);
  // Adds a case of level "must" that holds from GL 1.0 on, unless `content` has other values of "level" and
  // "since". Throws std::logic_error for a flag that is not explained and an id that is there already.
  void add(const std::string& id, const Names& requirements, const Names& flags, const Json& content);

  const std::string& kind() const { return kind_; }
  std::size_t size() const { return cases_.size(); }
  // The file: one case a line.
  std::string text() const;

 private:
  std::string kind_, description_;
  Json notes_;
  std::vector<std::string> ids_, cases_;
};

// Cases about one thing. Its name is a flag of all of them and, with a running number, their id; random data
// is drawn from dice of its own. Themes can so be added and lengthened at their ends, and no other case
// changes.
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
