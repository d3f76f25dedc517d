#include "view.h"

#include <fmt/format.h>

#include <algorithm>

namespace evalcts::reports::view {
namespace {

std::string plain(const std::string& text) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-";
  std::string out;
  for (const char c : text) {
    if (kPlain.find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("~{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

}  // namespace

void set_verdict(data& out, Verdict verdict) {
  out.set("word", std::string(text_of(verdict).word));
  out.set("symbol", std::string(text_of(verdict).symbol));
}

void set_name(data& out, const std::string& name) {
  std::string html;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find_first_of("./", begin), name.size() - 1) + 1;
    if (begin > 0) html += "<wbr>";
    html += kainjow::mustache::html_escape(name.substr(begin, end - begin));
    begin = end;
  }
  out.set("name", name);
  out.set("name_html", html);
}

void add_row(data& rows, const char* term, const std::string& value, bool code) {
  if (value.empty()) return;
  data row;
  row.set("term", term);
  row.set("value", value);
  row.set("code", code);
  rows << row;
}

std::string test_anchor(const std::string& name) { return "test-" + plain(name); }

std::string requirement_anchor(const std::string& id) { return "requirement-" + plain(id); }

std::string share(const Accuracy& accuracy) {
  if (accuracy.values == 0) return "unknown";
  const double ratio =
      static_cast<double>(accuracy.not_correctly_rounded) / static_cast<double>(accuracy.values);
  return fmt::format("{:.3g} % ({})", 100 * ratio, accuracy.not_correctly_rounded);
}

std::string baseline_note(const TestRecord& test) {
  if (test.is_expected_failure()) return "expected";
  return test.is_unexpected_pass() ? "unexpected" : "";
}

}  // namespace evalcts::reports::view
