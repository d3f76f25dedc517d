// Replaces control characters and malformed UTF-8, and shortens text by code points.
#include <evalcts/results/text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <evalcts/results/json.h>

namespace evalcts {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

constexpr double kLeastUsual = 1e-30;  // smaller values are the tolerance around 0

bool continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Returns the text with decimal numbers in place of hexadecimal ones, and without those in parentheses, which
// repeat the number before them.
std::string in_decimal(std::string text) {
  for (std::size_t at = text.find("0x"); at != std::string::npos; at = text.find("0x", at + 1)) {
    const std::size_t begin = at > 0 && text[at - 1] == '-' ? at - 1 : at;
    char* after = nullptr;
    const double value = std::strtod(text.c_str() + begin, &after);
    std::size_t end = static_cast<std::size_t>(after - text.c_str());
    if (text.substr(begin, end - begin).find('p') == std::string::npos) continue;  // a token
    if (begin >= 2 && text.compare(begin - 2, 2, " (") == 0 && text[end] == ')') {
      text.erase(begin - 2, end + 1 - (begin - 2));
      at = begin - 2;
    } else {
      const float single = static_cast<float>(value);
      text.replace(begin, end - begin,
                   single == value ? fmt::format("{}", single) : fmt::format("{}", value));
      at = begin;
    }
  }
  return text;
}

}  // namespace

std::string clean(const std::string& text) {
  const auto is_plain = [](char c) { return (c >= ' ' && c < 0x7F) || c == '\n' || c == '\t'; };
  if (std::ranges::all_of(text, is_plain)) return text;
  // The JSON library repairs UTF-8 when it writes; reading it back undoes only its escapes.
  using nlohmann::json;
  const std::string valid =
      parse_json(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
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

std::string in_plain_numbers(const std::string& text) {
  double low = 0, high = 0;
  int end = 0;
  if (!text.starts_with('[') || std::sscanf(text.c_str(), "[%lf, %lf]%n", &low, &high, &end) != 2 ||
      end == 0 || !std::isfinite(high - low))
    return in_decimal(text);
  const double middle = low / 2 + high / 2, half = high / 2 - low / 2;
  const std::string rest = in_decimal(text.substr(static_cast<std::size_t>(end)));
  if (half == 0) return fmt::format("{:.9g}{}", middle, rest);
  if (low <= 0 && high >= 0 && half < kLeastUsual) return "0" + rest;
  if (std::abs(middle) < half * 1e-3) return fmt::format("0 +- {:.1g}{}", half, rest);
  // The digits that the half width leaves certain, and one more.
  const int digits = std::clamp(static_cast<int>(std::log10(std::abs(middle) / half)) + 2, 1, 17);
  return fmt::format("{:.{}g} +- {:.1g}{}", middle, digits, half, rest);
}

std::string plain_error(double error) {
  if (error > 0x1p24) return "more than 2^24";
  if (error < 1e4) return fmt::format("{:.4g}", error);
  const double unit = std::pow(10, std::floor(std::log10(error)) - 3);
  std::string digits = fmt::format("{:.0f}", std::round(error / unit) * unit);
  for (std::size_t i = digits.size() - 3; i > 0 && i < digits.size(); i -= 3) digits.insert(i, ",");
  return digits;
}

std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  if (n == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", n, one) : fmt::format("{} {}", n, many);
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 5;
  const std::size_t shown = std::min(names.size(), kMostNames);
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(shown);
  return fmt::format("{}{}", fmt::join(names.begin(), end, ", "),
                     shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

}  // namespace evalcts
