// Reads the catalogue of requirements and ambiguous passages, and writes it as JSON for `evalcts list`.
#include <evalcts/results/requirements.h>

#include <algorithm>

#include <evalcts/results/json_object.h>
#include "requirements_data.h"  // generated: kRequirements

namespace evalcts {
namespace {

using nlohmann::json;

constexpr const char* kAmbiguityLists[] = {"contradictions", "undefined"};

Requirement read_requirement(const json& value, const JsonObject& in, std::size_t place) {
  Requirement out;
  out.id = in.text("id");
  if (out.id.empty()) throw FormatError(in.path("id") + " is missing");
  out.section = in.text("section");
  out.text = in.text("text");
  out.source = in.text("source");
  out.since = in.text("since");
  out.observation = in.text("observation");
  out.severity = in.text("severity");
  out.level = in.text("level");
  if (const auto quote = in.object("quote")) out.quote = {quote->text("text"), quote->text("source")};
  out.inferred = in.boolean("inferred");
  out.place = place;
  if (const auto reason = value.find("undecidable"); reason != value.end()) {
    if (reason->is_object()) {
      const JsonObject halves(*reason, in.path("undecidable"));
      halves.each_key(
          [&](const std::string& key, const std::string& half) { out.undecidable[half] = halves.text(key); });
    } else {
      for (const char* half : {"1-D", "2-D"}) out.undecidable[half] = in.text("undecidable");
    }
  }
  return out;
}

Ambiguity read_ambiguity(const JsonObject& in, Ambiguity::Kind kind) {
  Ambiguity out;
  out.kind = kind;
  const std::pair<const char*, std::string Ambiguity::*> members[] = {
      {"id", &Ambiguity::id},
      {"section", &Ambiguity::section},
      {"where", &Ambiguity::where},
      {"conflict", &Ambiguity::conflict},
      {"change", &Ambiguity::change},
      {"slip", &Ambiguity::slip},
      {"take", &Ambiguity::take},
      {"why", &Ambiguity::why},
      {"situation", &Ambiguity::situation},
      {"may_assert", &Ambiguity::may_assert},
      {"must_not_assert", &Ambiguity::must_not_assert}};
  for (const auto& [name, member] : members) out.*member = in.text(name);
  if (const auto readings = in.object("readings"))
    readings->each_key(
        [&](const std::string& key, const std::string& name) { out.readings[name] = readings->text(key); });
  return out;
}

}  // namespace

const std::string& Ambiguity::text() const {
  for (const std::string* text : {&conflict, &change, &slip})
    if (!text->empty()) return *text;
  return situation;
}

const Requirement* Catalogue::find(const RequirementId& id) const {
  const auto found = std::ranges::find(requirements, id.id, &Requirement::id);
  return found == requirements.end() ? nullptr : &*found;
}

const Ambiguity* Catalogue::find_ambiguity(const std::string& id) const {
  const auto found = std::ranges::find(ambiguities, id, &Ambiguity::id);
  return found == ambiguities.end() ? nullptr : &*found;
}

std::vector<const Ambiguity*> Catalogue::interpretations() const {
  std::vector<const Ambiguity*> all;
  for (const Ambiguity& ambiguity : ambiguities)
    if (!ambiguity.readings.empty()) all.push_back(&ambiguity);
  return all;
}

Catalogue Catalogue::parse(const std::string& text) {
  const json data = parse_json(text);
  if (data.is_discarded()) throw FormatError("the requirements are not valid JSON");
  Catalogue out;
  const JsonObject in(data, "");
  in.each("requirements", [&](const json& item, const std::string& where) {
    out.requirements.push_back(read_requirement(item, JsonObject(item, where), out.requirements.size()));
  });
  for (const auto kind : {Ambiguity::Kind::kContradiction, Ambiguity::Kind::kUndefined})
    in.each_object(kAmbiguityLists[static_cast<std::size_t>(kind)],
                   [&](const JsonObject& item) { out.ambiguities.push_back(read_ambiguity(item, kind)); });
  return out;
}

const Catalogue& catalogue() {
  static const Catalogue kShipped = Catalogue::parse(kRequirements);
  return kShipped;
}

std::string catalogue_as_json() { return parse_json(kRequirements).dump(1); }

std::string interpretations_as_json() {
  const json data = parse_json(kRequirements);
  json all = json::array();
  for (const char* list : kAmbiguityLists)
    for (const json& entry : data[list])
      if (entry.contains("readings")) all.push_back(entry);
  return json{{"interpretations", all}}.dump(1);
}

}  // namespace evalcts
