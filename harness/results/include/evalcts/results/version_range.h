// Parses the range of GL versions in the header of a baseline.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace evalcts {

// A range has one of four forms. The first three begin with the text before the number in GL_VERSION (here
// "Mesa"):
//   "Mesa 20.3 to 24.3"     both ends included
//   "Mesa 25.0 or newer"
//   "Mesa 22.3 or older"
//   "Mesa 22.3"             any text: contains the versions in which it occurs
// A version is compared in as many components as the bound has: 24.3.9 is not newer than 24.3.
class VersionRange {
 public:
  VersionRange() = default;  // contains every version
  // Throws std::invalid_argument, with a message for the user, if "to", "or newer" or "or older" is not
  // preceded by a number.
  explicit VersionRange(std::string text);

  // `version`: GL_VERSION, such as "4.5 (Compatibility Profile) Mesa 22.3.6".
  bool contains(std::string_view version) const;
  const std::string& text() const { return text_; }

 private:
  using Numbers = std::vector<unsigned>;

  std::string text_;
  std::string product_;  // "Mesa ", or empty if the whole text has to be part of the version
  std::optional<Numbers> first_, last_;
};

}  // namespace evalcts
