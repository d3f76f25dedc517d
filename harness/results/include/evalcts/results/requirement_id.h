// The name of a requirement, as tests and faults give it.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace evalcts {

// A requirement, or the half of it that is about maps of one dimension: "EV-MAP1-COPY", "EV-API-ENTRY/1-D".
struct RequirementId {
  std::string id;
  int dimension = 0;  // 1 or 2 for one half; 0 for the whole requirement

  RequirementId() = default;
  // Reads what text() writes.
  RequirementId(std::string_view text);
  RequirementId(const std::string& text) : RequirementId(std::string_view(text)) {}
  RequirementId(const char* text) : RequirementId(std::string_view(text)) {}

  std::string text() const;
  // True if a test of this requirement decides `wanted`: the same requirement, or one that this is a half of.
  bool decides(const RequirementId& wanted) const;

  auto operator<=>(const RequirementId&) const = default;
};

std::vector<std::string> texts_of(const std::vector<RequirementId>& ids);

}  // namespace evalcts
