// Writes one file for each kind of vectors.
#include <evalcts/vectors/write.h>

#include <fmt/format.h>

#include <evalcts/results/files.h>
#include "kinds.h"

namespace evalcts::vectors {
namespace {

struct Kind {
  const char* name;
  std::function<Document(const std::vector<SuiteCase>&)> make;
};

// Returns a kind of sequences.
Kind of_suite(const char* name, const char* description) {
  return {name, [=](const std::vector<SuiteCase>& cases) { return sequences(name, description, cases); }};
}
// Returns a kind that needs no cases of the suite.
Kind of_values(const char* name, Document (*make)()) {
  return {name, [=](const std::vector<SuiteCase>&) { return make(); }};
}

const std::vector<Kind>& all() {
  static const std::vector<Kind> kAll = {
      of_values("map1_eval", map1_eval),
      of_values("map2_eval", map2_eval),
      of_values("grid", grid),
      of_values("auto_normal", auto_normal),
      of_suite("errors",
               "Which errors commands raise, and that a command which raises one does nothing else."),
      of_suite("get_map", "The answers to queries."),
      of_suite("state",
               "Sequences of commands: errors, answers to queries, and the vertices that are drawn.")};
  return kAll;
}

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> list;
    for (const Kind& kind : all()) list.emplace_back(kind.name);
    return list;
  }();
  return kNames;
}

void write_all(const std::filesystem::path& folder, const std::vector<SuiteCase>& cases,
               const std::function<void(const Written&)>& wrote) {
  for (const Kind& kind : all()) {
    const Document document = kind.make(cases);
    const std::string text = document.text();
    write_atomically(folder / fmt::format("{}.json", kind.name), text);
    wrote({kind.name, document.size(), text.size()});
  }
}

}  // namespace evalcts::vectors
