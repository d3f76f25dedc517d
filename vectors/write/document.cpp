// Formats a file of vectors.
#include "document.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace evalcts::vectors {

Document::Document(std::string kind, std::string description)
    : kind_(std::move(kind)), description_(std::move(description)), notes_(Json::object()) {}

void Document::explain(const std::string& flag, const std::string& meaning) {
  if (notes_.contains(flag) && as_text(notes_[flag]) != meaning)
    throw std::logic_error(fmt::format("{}: two meanings of '{}'", kind_, flag));
  notes_[flag] = meaning;
}

void Document::add(const std::string& id, const Names& requirements, const Names& flags,
                   const Json& content) {
  for (const std::string& flag : flags)
    if (!notes_.contains(flag)) throw std::logic_error(fmt::format("{}: no note on '{}'", kind_, flag));
  Json line = {{"id", id},
               {"requirements", requirements},
               {"flags", flags},
               {"level", "must"},
               {"since", kFirstVersion}};
  line.update(content);
  if (!ids_.insert(id).second) throw std::logic_error(fmt::format("the id '{}' occurs twice", id));
  cases_.push_back(line.dump(-1, ' ', true));
}

std::string Document::text() const {
  Json head = {
      {"format", kFormat}, {"schemaVersion", kSchemaVersion}, {"generatorVersion", kGeneratorVersion},
      {"kind", kind_},     {"description", description_},     {"numberOfTests", cases_.size()},
      {"notes", notes_}};
  std::string text = head.dump(1, ' ', true);
  text.erase(text.rfind('\n'));
  text += ",\n \"cases\": [\n";
  for (std::size_t i = 0; i < cases_.size(); ++i) text += cases_[i] + (i + 1 < cases_.size() ? ",\n" : "\n");
  return text + "]}\n";
}

}  // namespace evalcts::vectors
