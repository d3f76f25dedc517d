// Makes text of unknown origin safe to show.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace evalcts {

// Returns valid UTF-8 that XML 1.0 allows and that contains no control codes for terminals: invalid UTF-8,
// U+0080..U+009F, U+FFFE and U+FFFF become U+FFFD; U+0000..U+001F and U+007F become U+2400..U+2421, but
// newline and tab stay.
std::string clean(const std::string& text);

// Returns the text with spaces in place of line breaks and tabs.
std::string one_line(std::string text);

// Returns at most `columns` code points of a clean text; a cut is marked by "...". columns >= 3.
std::string cut(const std::string& text, std::size_t columns);

// Returns what was expected or captured as a person writes it: numbers in decimal, an interval as its middle
// and half width, "0.5 +- 2e-5", or as "0" if no usual number but 0 lies in it.
std::string in_plain_numbers(const std::string& text);

// Returns an error in ULP or a condition-aware error with four significant digits: "0.5", "1,676,000".
// Returns "more than 2^24" for a larger one, because no bit of the value is right then.
std::string plain_error(double error);

// Returns "1 test" or "3 tests" for the noun "test". `many`: an irregular plural.
std::string count(std::uint64_t n, std::string_view one, std::string_view many = {});

// Returns the first names: "A, B, C, D, E and 3 more".
std::string first_of(const std::vector<std::string>& names);

}  // namespace evalcts
