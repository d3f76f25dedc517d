// Writes one file for each kind of vectors.
#include <evalcts/vectors/write.h>

#include <fmt/format.h>

#include <stdexcept>

#include <evalcts/results/files.h>
#include "normals.h"
#include "suite_cases.h"

namespace evalcts::vectors {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNormals = "auto_normal";
constexpr const char* kValues[] = {"map1_eval", "map2_eval", "grid", kNormals};

struct SequenceKind {
  const char *name, *description;
};
constexpr SequenceKind kSequences[] = {
    {"errors", "Which errors commands raise, and that a command which raises one does nothing else."},
    {"get_map", "The answers to queries."},
    {"state", "Sequences of commands: errors, answers to queries, and the vertices that are drawn."}};

// Returns the members of a case that follow from its map and arguments.
Json content_of(const std::string& kind, const Json& entry) {
  const Problem problem = problem_of(entry);
  if (kind != kNormals)
    return value_case(problem, entry.contains("intermediate") ? Detail::kIntermediate : Detail::kNone);
  if (problem.map.target != GL_MAP2_VERTEX_3 && problem.map.target != GL_MAP2_VERTEX_4)
    throw std::invalid_argument("only surfaces of vertices have automatic normals");
  return normal_case(problem);
}

// Returns the file with its answers computed. Throws std::runtime_error, whose message names the case.
Document computed(const std::string& kind, const fs::path& path) {
  std::string place = path.string();
  try {
    const Json file = Json::parse(read_file(path));
    Document document(kind, file.at("description"));
    for (const auto& note : file.at("notes").items()) document.explain(note.key(), note.value());
    for (const Json& entry : file.at("cases")) {
      const std::string id = entry.at("id");
      place = fmt::format("{}: {}", path.string(), id);
      document.add(id, entry.at("requirements"), entry.at("flags"), content_of(kind, entry));
    }
    return document;
  } catch (const std::exception& problem) {
    throw std::runtime_error(fmt::format("{}: {}", place, problem.what()));
  }
}

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names(std::begin(kValues), std::end(kValues));
    for (const SequenceKind& kind : kSequences) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

void write_all(const fs::path& inputs, const fs::path& folder,
               const std::function<std::vector<SuiteCase>()>& cases_of_suite,
               const std::function<void(const WrittenFile&)>& wrote) {
  const auto path_in = [](const fs::path& parent, const std::string& kind) {
    return parent / (kind + ".json");
  };
  const auto write = [&](const Document& document) {
    const std::string text = document.text();
    write_atomically(path_in(folder, document.kind()), text);
    wrote({document.kind(), document.size(), text.size()});
  };
  for (const char* const kind : kValues) write(computed(kind, path_in(inputs, kind)));
  const std::vector<SuiteCase> cases = cases_of_suite();
  for (const auto& [name, description] : kSequences) write(sequences(name, description, cases));
}

}  // namespace evalcts::vectors
