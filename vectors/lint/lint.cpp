// Checks the structure, IDs, requirements and flags of a file of vectors, and the claims of its cases.
#include <evalcts/vectors/lint.h>

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "claims.h"

namespace evalcts::vectors {

using nlohmann::json;

namespace {

// Returns "ID: " for the case that contains the byte, or an empty string before the first case.
std::string place_of(const std::string& text, std::size_t byte) {
  constexpr std::string_view kBegin = "{\"id\":\"";
  const std::size_t begin = text.rfind(kBegin, byte);
  if (begin == std::string::npos) return "";
  const std::size_t id = begin + kBegin.size(), end = text.find('"', id);
  return end == std::string::npos ? "" : text.substr(id, end - id) + ": ";
}

}  // namespace

Report lint(const std::string& text, const std::set<std::string>& requirements) {
  json file;
  try {
    file = json::parse(text);
  } catch (const json::parse_error& error) {
    throw Malformed(fmt::format("{}no JSON: {}", place_of(text, error.byte), error.what()));
  }
  check_structure(file);

  Report report{file["kind"], file["cases"].size(), file["notes"].size(), {}};
  const auto find = [&](const std::string& id, const std::string& what) {
    report.findings.push_back(fmt::format("{}: {}", id, what));
  };
  if (file["numberOfTests"] != report.cases)
    find("numberOfTests", fmt::format("{} for {} cases", file["numberOfTests"].dump(), report.cases));
  std::set<std::string> ids;
  std::map<std::string, std::size_t> uses;
  for (const json& entry : file["cases"]) {
    const std::string id = entry["id"];
    if (!ids.insert(id).second) find(id, "the id occurs twice");
    if (!id.starts_with(report.kind + "."))
      find(id, fmt::format("an id of another kind than {}", report.kind));
    for (const std::string requirement : entry["requirements"])
      if (!requirements.contains(requirement))
        find(id, fmt::format("no requirement is called {}", requirement));
    if (const std::string broken = broken_claim(entry); !broken.empty()) find(id, broken);
    for (const std::string flag : entry["flags"]) {
      ++uses[flag];
      if (!file["notes"].contains(flag)) find(id, fmt::format("the flag '{}' has no note", flag));
    }
  }
  for (const auto& note : file["notes"].items())
    if (!uses.contains(note.key())) find("notes", fmt::format("no case has the flag '{}'", note.key()));
  return report;
}

}  // namespace evalcts::vectors
