// Implements the helpers that the parts of the page share: verdicts, rows, links and percentages.
#include "view.h"

#include <fmt/format.h>

namespace evalcts::reports::view {
namespace {

// `kept`: further characters that need no encoding.
std::string percent_encoded(const std::string& text, std::string_view kept = "") {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-";
  std::string out;
  for (const char c : text) {
    if (kPlain.find(c) != std::string_view::npos || kept.find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

}  // namespace

void set_verdict(data& out, Verdict verdict) {
  out.set("name", std::string(text_of(verdict).label));
  out.set("symbol", std::string(text_of(verdict).symbol));
}

const char* class_of(Verdict verdict) {
  return is_bad(verdict)                       ? "bad"
         : verdict == Verdict::kQualityWarning ? "notice"
         : verdict == Verdict::kPass           ? "good"
                                               : "none";
}

void add_row(data& rows, const char* term, const std::string& value, bool code) {
  if (value.empty()) return;
  data row;
  row.set("term", term);
  row.set("value", value);
  row.set("code", code);
  rows << row;
}

std::string link(const std::vector<std::pair<std::string, std::string>>& state) {
  std::string out;
  for (const auto& [name, value] : state)
    out += fmt::format("{}{}={}", out.empty() ? '#' : '&', name, percent_encoded(value));
  return out;
}

std::string link_to_file(const std::string& path) { return percent_encoded(path, "/"); }

std::string link_to_test(const std::string& name) { return link({{"at", "open=" + name}}); }

std::string share(const Accuracy& accuracy) {
  if (accuracy.values == 0) return "unknown";
  const double ratio =
      static_cast<double>(accuracy.not_correctly_rounded) / static_cast<double>(accuracy.values);
  return fmt::format("{:.3g} % ({})", 100 * ratio, accuracy.not_correctly_rounded);
}

}  // namespace evalcts::reports::view
