// Writes one file for each kind of vectors.
#include <evalcts/vectors/write.h>

#include <fmt/format.h>

#include <evalcts/results/files.h>
#include "kinds.h"

namespace evalcts::vectors {
namespace {

struct ValueKind {
  const char* name;
  Document (*make)();
};
constexpr ValueKind kValues[] = {
    {"map1_eval", map1_eval}, {"map2_eval", map2_eval}, {"grid", grid}, {"auto_normal", auto_normal}};

struct SequenceKind {
  const char *name, *description;
};
constexpr SequenceKind kSequences[] = {
    {"errors", "Which errors commands raise, and that a command which raises one does nothing else."},
    {"get_map", "The answers to queries."},
    {"state", "Sequences of commands: errors, answers to queries, and the vertices that are drawn."}};

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const ValueKind& kind : kValues) names.emplace_back(kind.name);
    for (const SequenceKind& kind : kSequences) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

void write_all(const std::filesystem::path& folder,
               const std::function<std::vector<SuiteCase>()>& cases_of_suite,
               const std::function<void(const WrittenFile&)>& wrote) {
  const auto write = [&](const Document& document) {
    const std::string text = document.text();
    write_atomically(folder / fmt::format("{}.json", document.kind()), text);
    wrote({document.kind(), document.size(), text.size()});
  };
  for (const ValueKind& kind : kValues) write(kind.make());
  const std::vector<SuiteCase> cases = cases_of_suite();
  for (const auto& [name, description] : kSequences) write(sequences(name, description, cases));
}

}  // namespace evalcts::vectors
