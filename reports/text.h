// Numbers and Markdown as all reports show them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/results/text.h>

namespace evalcts::reports {

// Four significant digits: "0.5", "123.4", "1.234e+09"; "unknown" without a value.
std::string number(std::optional<double> value);

// "123.4 ULP, condition-aware 5.6"; empty when neither is known.
std::string distance(std::optional<double> ulp, std::optional<double> condition_aware);

// "1 test", "3 tests".
std::string count(std::uint64_t n, std::string_view noun);

std::string join(const std::vector<std::string>& parts, std::string_view separator);

// A Markdown code span of the text, on one line, cut to `most` columns. Its fence is longer than any in the
// text, so that nothing in it is markup, a link or a mention.
std::string markdown_code(const std::string& text, std::size_t most = 200);

// The same for a cell of a table: a bar becomes a slash, because a bar ends the cell even in code, and no
// escape for it works everywhere.
std::string markdown_cell(std::string text);

}  // namespace evalcts::reports
