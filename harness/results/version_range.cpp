// Parses ranges such as "Mesa 22.3 or newer", and compares version numbers component by component.
#include <evalcts/results/version_range.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace evalcts {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Reads "22.3.6" at the start of the text; text after the numbers ("-devel", " (git-...)") is ignored.
std::vector<unsigned> leading_numbers(std::string_view text) {
  constexpr std::size_t kMostDigits = 9;
  std::vector<unsigned> numbers;
  std::size_t i = 0;
  while (i < text.size() && is_digit(text[i])) {
    unsigned number = 0;
    for (std::size_t digits = 0; i < text.size() && is_digit(text[i]) && digits < kMostDigits; ++i, ++digits)
      number = number * 10 + static_cast<unsigned>(text[i] - '0');
    numbers.push_back(number);
    if (i + 1 >= text.size() || text[i] != '.' || !is_digit(text[i + 1])) break;
    ++i;
  }
  return numbers;
}

// Returns a negative number, zero or a positive number if the version is older than the bound, equal in the
// bound's components, or newer.
int compare(const std::vector<unsigned>& version, const std::vector<unsigned>& bound) {
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const unsigned component = i < version.size() ? version[i] : 0;
    if (component != bound[i]) return component < bound[i] ? -1 : 1;
  }
  return 0;
}

}  // namespace

VersionRange::VersionRange(std::string text) : text_(std::move(text)) {
  constexpr std::string_view kTo = " to ", kNewer = " or newer", kOlder = " or older";
  const std::string_view all = text_;
  const std::size_t to = all.find(kTo);
  const bool newer = all.ends_with(kNewer), older = all.ends_with(kOlder);
  if (to == std::string_view::npos && !newer && !older) return;

  const auto digit = std::find_if(all.begin(), all.end(), is_digit);
  const auto start = static_cast<std::size_t>(digit - all.begin());
  const Numbers first = leading_numbers(all.substr(start));
  const Numbers second = to == std::string_view::npos ? first : leading_numbers(all.substr(to + kTo.size()));
  if (start == 0 || first.empty() || second.empty() || to < start)
    throw std::invalid_argument(fmt::format(
        "'{}' is not a range of versions: expected 'NAME A to B', 'NAME A or newer' or 'NAME A or older'",
        text_));
  product_ = all.substr(0, start);
  if (!older) first_ = first;
  if (!newer) last_ = second;
}

bool VersionRange::contains(std::string_view version) const {
  if (product_.empty()) return version.find(text_) != std::string_view::npos;
  const std::size_t at = version.find(product_);
  if (at == std::string_view::npos) return false;
  const Numbers numbers = leading_numbers(version.substr(at + product_.size()));
  return !numbers.empty() && (!first_ || compare(numbers, *first_) >= 0) &&
         (!last_ || compare(numbers, *last_) <= 0);
}

}  // namespace evalcts
