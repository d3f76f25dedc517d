// Adds cases with their IDs to themes, and formats the file.
#include "document.h"

#include <fmt/format.h>

#include <algorithm>
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
  ids_.push_back(id);
  cases_.push_back(line.dump(-1, ' ', true));
}

std::string Document::text() const {
  Names sorted = ids_;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    throw std::logic_error(fmt::format("the id '{}' occurs twice", *twice));

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

Theme::Theme(Document& document, const std::string& name, const std::string& meaning, Names requirements)
    : document_(document),
      name_(name),
      requirements_(std::move(requirements)),
      dice_(document.kind() + "." + name) {
  document.explain(name, meaning);
}

void Theme::add(const Json& content, const Names& more_requirements, const Names& more_flags) {
  Names requirements = requirements_, flags = {name_};
  for (const std::string& id : more_requirements)
    if (std::ranges::find(requirements, id) == requirements.end()) requirements.push_back(id);
  flags.insert(flags.end(), more_flags.begin(), more_flags.end());
  ++count_;
  document_.add(fmt::format("{}.{}.{}", document_.kind(), name_, count_), requirements, flags, content);
}

}  // namespace evalcts::vectors
