// Formats numbers, counts and Markdown code spans.
#include "text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace evalcts::reports {
std::string number(std::optional<double> value) { return value ? fmt::format("{:.4g}", *value) : "unknown"; }

std::string distance(std::optional<double> ulp, std::optional<double> condition_aware) {
  std::string out;
  if (ulp) out = number(ulp) + " ULP";
  if (condition_aware) out += (ulp ? ", condition-aware " : "condition-aware ") + number(condition_aware);
  return out;
}

std::string repetition(const TestRecord& test) {
  if (!test.again) return test.flake ? "flake" : "";
  return fmt::format("{}{} when run again",
                     test.flake                            ? "flake: "
                     : test.again->verdict == test.verdict ? "another "
                                                           : "",
                     text_of(test.again->verdict).word);
}

std::string count(std::uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

std::string markdown_code(const std::string& text, std::size_t most) {
  const std::string line = cut(one_line(text), most);
  std::size_t longest = 0, length = 0;
  for (const char c : line) {
    length = c == '`' ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  const std::string fence(longest + 1, '`');
  // GitHub and GitLab remove one space at either end.
  return longest || line.empty() ? fence + " " + line + " " + fence : fence + line + fence;
}

std::string markdown_cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return markdown_code(text);
}

}  // namespace evalcts::reports
