// Writes one file for each kind of vectors.
#include <evalcts/vectors/write.h>

#include <fmt/format.h>

#include <stdexcept>

#include <evalcts/results/files.h>
#include "kinds.h"

namespace evalcts::vectors {
namespace {

struct Kind {
  const char* name;
  Document (*make)();
};

constexpr Kind kAll[] = {
    {"map1_eval", map1_eval}, {"map2_eval", map2_eval}, {"grid", grid},  {"auto_normal", auto_normal},
    {"errors", errors},       {"get_map", get_map},     {"state", state}};

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> list;
    for (const Kind& kind : kAll) list.emplace_back(kind.name);
    return list;
  }();
  return kNames;
}

std::string text_of(const std::string& kind) {
  for (const auto& [name, make] : kAll)
    if (kind == name) return make().text();
  throw std::invalid_argument(fmt::format("unknown kind '{}'", kind));
}

void write_all(const std::filesystem::path& folder, const std::function<void(const Written&)>& wrote) {
  for (const auto& [name, make] : kAll) {
    const Document document = make();
    const std::string text = document.text();
    write_atomically(folder / fmt::format("{}.json", name), text);
    wrote({name, document.size(), text.size()});
  }
}

}  // namespace evalcts::vectors
