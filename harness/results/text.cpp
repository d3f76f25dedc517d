// Replaces control characters and malformed UTF-8, and shortens text by code points.
#include <evalcts/results/text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include <evalcts/results/json.h>

namespace evalcts {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

bool continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::string clean(const std::string& text) {
  const auto is_plain = [](char c) { return (c >= ' ' && c < 0x7F) || c == '\n' || c == '\t'; };
  if (std::ranges::all_of(text, is_plain)) return text;
  // The JSON library repairs UTF-8 when it writes; reading it back undoes only its escapes.
  using nlohmann::json;
  const std::string valid =
      json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
  std::string out;
  out.reserve(valid.size());
  for (std::size_t i = 0; i < valid.size();) {
    const unsigned char c = valid[i];
    const std::string_view rest = std::string_view(valid).substr(i);
    if (c == '\n' || c == '\t') {
      out += valid[i++];
    } else if (c < 0x20 || c == 0x7F) {
      out += "\xE2\x90";  // U+2400 + c, U+2421 for DEL
      out += static_cast<char>(c == 0x7F ? 0xA1 : 0x80 + c);
      ++i;
    } else if (c == 0xC2 && static_cast<unsigned char>(rest[1]) < 0xA0) {  // U+0080..U+009F
      out += kReplacement;
      i += 2;
    } else if (rest.substr(0, 3) == "\xEF\xBF\xBE" || rest.substr(0, 3) == "\xEF\xBF\xBF") {
      out += kReplacement;
      i += 3;
    } else {
      out += valid[i++];
    }
  }
  return out;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return text;
}

std::string cut(const std::string& text, std::size_t columns) {
  std::size_t code_points = 0, keep = 0;  // keep: bytes of the first columns - 3 code points
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (continuation(text[i])) continue;
    if (code_points++ == columns - 3) keep = i;
  }
  return code_points <= columns ? text : text.substr(0, keep) + "...";
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 5;
  const std::size_t shown = std::min(names.size(), kMostNames);
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(shown);
  return fmt::format("{}{}", fmt::join(names.begin(), end, ", "),
                     shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

}  // namespace evalcts
