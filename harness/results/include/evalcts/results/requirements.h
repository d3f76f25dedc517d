// The requirements and the ambiguous texts of the specification, as data (suites/requirements.json).
#pragma once

#include <map>
#include <string>
#include <vector>

#include <evalcts/results/requirement_id.h>

namespace evalcts {

struct Requirement {
  std::string id, section, text, source, since, observation, severity, level;
  bool inferred = false;  // no single sentence states it
  // Reasons why no test can decide the halves "1-D" and "2-D". Halves that are not listed can be decided.
  std::map<std::string, std::string> undecidable;
  std::size_t place = 0;  // in the catalogue
};

// A passage that has several readings, or leaves something undefined.
struct Ambiguity {
  enum class Kind { kContradiction, kUndefined };
  Kind kind = Kind::kContradiction;
  std::string id, section;
  std::string where;                                   // the documents
  std::string conflict, change, slip, take, why;       // contradictions: what differs, what is taken, why
  std::string situation, may_assert, must_not_assert;  // undefined: when, and what a test may do
  std::map<std::string, std::string> readings;         // accepted ones, with their meanings

  // Returns the description of the ambiguity.
  const std::string& text() const;
};

struct Catalogue {
  std::vector<Requirement> requirements;
  std::vector<Ambiguity> ambiguities;  // contradictions first

  // Returns the requirement with this ID, or the one that `id` is a half of; null if there is none.
  const Requirement* find(const RequirementId& id) const;
  const Ambiguity* find_ambiguity(const std::string& id) const;
  // Returns the ambiguities with more than one accepted reading.
  std::vector<const Ambiguity*> interpretations() const;

  // Reads {"requirements": [...], "contradictions": [...], "undefined": [...]}. Throws FormatError.
  static Catalogue parse(const std::string& text);
};

// Return the catalogue of this build, as types and as JSON text.
const Catalogue& catalogue();
std::string catalogue_as_json();
// Returns JSON, {"interpretations": [...]}: the entries of the catalogue that have readings.
std::string interpretations_as_json();

}  // namespace evalcts
