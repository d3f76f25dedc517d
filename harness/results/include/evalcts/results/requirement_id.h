// Defines the IDs by which tests and faults name requirements.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace evalcts {

// The ID of a requirement ("EV-MAP1-COPY"), or of the half of it that is about one-dimensional or
// two-dimensional maps ("EV-API-ENTRY/1-D").
struct RequirementId {
  std::string_view id;  // kept until the process ends
  int dimension = 0;    // 1 or 2 for one half; 0 for the whole requirement

  RequirementId() = default;
  // Reads what text() writes.
  RequirementId(std::string_view text);
  RequirementId(const std::string& text) : RequirementId(std::string_view(text)) {}
  RequirementId(const char* text) : RequirementId(std::string_view(text)) {}

  std::string text() const;
  // True if a test of this requirement decides `wanted`, that is, if `wanted` is the same ID, or the whole
  // requirement of which this ID is a half.
  bool decides(const RequirementId& wanted) const;

  auto operator<=>(const RequirementId&) const = default;
};

std::vector<std::string> texts_of(const std::vector<RequirementId>& ids);

}  // namespace evalcts
