// Text that is safe to show, and numbers the way all reports show them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace evalcts::reports {

// Valid UTF-8 that XML 1.0 allows and a terminal does not act on: what is not UTF-8, U+0080..U+009F, U+FFFE
// and U+FFFF become U+FFFD; U+0000..U+001F and U+007F become U+2400..U+2421, but newline and tab stay.
std::string clean(const std::string& text);

// Line breaks and tabs become spaces.
std::string one_line(std::string text);

// At most `columns` code points; a cut is marked by "...". Clean text only; columns >= 3.
std::string cut(const std::string& text, std::size_t columns);

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
