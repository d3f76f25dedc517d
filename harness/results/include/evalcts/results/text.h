// Text of unknown origin, made safe to show.
#pragma once

#include <string>

namespace evalcts {

// Valid UTF-8 that XML 1.0 allows and a terminal does not act on: what is not UTF-8, U+0080..U+009F, U+FFFE
// and U+FFFF become U+FFFD; U+0000..U+001F and U+007F become U+2400..U+2421, but newline and tab stay.
std::string clean(const std::string& text);

// Line breaks and tabs become spaces.
std::string one_line(std::string text);

// At most `columns` code points; a cut is marked by "...". Clean text only; columns >= 3.
std::string cut(const std::string& text, std::size_t columns);

}  // namespace evalcts
