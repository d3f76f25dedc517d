// Formats numbers, counts and Markdown code spans.
#include "text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace evalcts::reports {
std::string distance(std::optional<double> ulp, std::optional<double> condition_aware) {
  std::string out;
  if (ulp) out = plain_error(*ulp) + " ULP";
  if (condition_aware)
    out += (ulp ? ", condition-aware " : "condition-aware ") + plain_error(*condition_aware);
  return out;
}

std::string repetition(const TestRecord& test) {
  if (!test.again) return test.flake ? "flake" : "";
  return fmt::format("{}{} when run again",
                     test.flake                            ? "flake: "
                     : test.again->verdict == test.verdict ? "another "
                                                           : "",
                     text_of(test.again->verdict).label);
}

std::string duration(double seconds) {
  const long long all = std::llround(seconds);
  if (all < 60) return fmt::format("{} s", all);
  return all < 3600 ? fmt::format("{} min {} s", all / 60, all % 60)
                    : fmt::format("{} h {} min", all / 3600, all / 60 % 60);
}

std::string time_of(const RunResult& result) {
  std::vector<std::string> parts;
  const std::string& start = result.started;  // 2026-11-28T11:27:22Z
  if (start.size() == 20) parts.push_back(start.substr(0, 10) + " " + start.substr(11, 5) + " UTC");
  if (result.seconds) parts.push_back(duration(*result.seconds));
  return join(parts, ", ");
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
