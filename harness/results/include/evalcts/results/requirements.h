// The requirements and the ambiguous passages of the specification, which are stored as
// data in suites/requirements.json.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <evalcts/results/documents.h>
#include <evalcts/results/requirement_id.h>

namespace evalcts {

struct Requirement {
  std::string id, section, text, source, since, observation, severity, level;
  Quote quote;            // from one of the sources; empty: none
  bool inferred = false;  // no single sentence states it
  // Reasons why no test can decide the half "1-D" or "2-D", by half. A half that is not listed
  // can be decided.
  std::map<std::string, std::string> undecidable;
  std::size_t place = 0;  // position in the catalogue
};

// A passage of the specification that has several readings, or leaves something undefined.
struct Ambiguity {
  enum class Kind { kContradiction, kUndefined };
  Kind kind = Kind::kContradiction;
  std::string id, section;
  std::string where;                                   // the documents that contain the passage
  std::string conflict, change, slip, take, why;       // contradiction: the difference, choice and reason
  std::string situation, may_assert, must_not_assert;  // undefined: the condition, and limits of assertions
  std::map<std::string, std::string> readings;         // the accepted readings, with their meanings

  // Returns the description of the ambiguity.
  const std::string& text() const;
};

struct Catalogue {
  std::vector<Requirement> requirements;
  std::vector<Ambiguity> ambiguities;  // contradictions first

  // Returns the requirement that `id` names, or a half of which it names; null if there is none.
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
// Returns the ambiguities with more than one accepted reading as JSON, {"interpretations": [...]}.
std::string interpretations_as_json();

}  // namespace evalcts
