// Formats the table of errors as text and as comma-separated values.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include "ulp.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

std::string text_in(const json& value) { return clean(std::string(as_text(value))); }

std::vector<std::string> texts_in(const json& list) { return list.get<std::vector<std::string>>(); }

std::string name_of(const json& row, bool with_target) {
  return text_in(row["name"]) + (with_target && row.contains("target") ? "/" + text_in(row["target"]) : "");
}

// Returns how the largest error was found. No search proves that there is no larger one.
std::string found_by(const json& row, const char* worst) {
  return row.contains(worst) ? text_in(row[worst]["found_by"]) : "-";
}

std::string row_text(const json& row, bool with_target) {
  const std::string name = name_of(row, with_target);
  if (row.contains("not_measured"))
    return fmt::format("{:<27} not measured: {}\n", name, text_in(row["not_measured"]));
  const auto values = row["values"].get<double>(), wrong = row["not_correctly_rounded"].get<double>();
  const auto zeros = row["zeros"].get<int>();
  return fmt::format("{:<27} {:>8} {:>7.2f} % {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>6} {:>13}  {}, {}\n",
                     name, values, values > 0 ? 100 * wrong / values : 0, error_in(row["max_ulp"]),
                     error_in(row["mean_ulp"]), error_in(row["max_condition_aware"]),
                     error_in(row["mean_condition_aware"]), row["not_finite"].get<int>(),
                     zeros == 0 ? "-" : fmt::format("{} of {}", row["zeros_wrong"].get<int>(), zeros),
                     found_by(row, "worst_ulp"), found_by(row, "worst_condition_aware"));
}

std::string worst_text(const json& worst, const char* unit) {
  const json &got = worst["got"], &right = worst["right"];
  return fmt::format("  {:.4g} {}, at {}: {} ({}), correctly rounded {} ({}); exact {}\n    {}\n",
                     error_in(worst["error"]), unit, fmt::join(texts_in(worst["at"]), ","),
                     as_text(got["value"]), as_text(got["bits"]), as_text(right["value"]),
                     as_text(right["bits"]), as_text(worst["exact"]), shell_line(texts_in(worst["replay"])));
}

}  // namespace

double error_in(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

std::string table_text(const json& implementation, bool with_target) {
  std::string text = text_in(implementation["name"]) + ":";
  for (const char* const part : {"vendor", "renderer", "version"})
    if (implementation.contains(part)) text += " " + text_in(implementation[part]);
  text += "\n";
  if (implementation.contains("reason")) text += fmt::format("  {}\n", text_in(implementation["reason"]));
  const json& rows = implementation["rows"];
  if (rows.empty()) return text;
  text += fmt::format("{:<27} {:>8} {:>9} {:>10} {:>10} {:>10} {:>10} {:>6} {:>13}  {}\n", "maps", "values",
                      "misround.", "max ULP", "mean ULP", "max cond.", "mean cond.", "nonfin", "zeros wrong",
                      "largest found by");
  for (const json& row : rows) text += row_text(row, with_target);
  for (const auto& [which, unit] :
       {std::pair{"worst_ulp", "ULP"}, {"worst_condition_aware", "relative to the condition"}}) {
    const json* largest = nullptr;
    for (const json& row : rows) {
      // Near the limits of the range, the spacing of floats exceeds the unit of the condition-aware error.
      if (!row.contains(which) || (which[6] == 'c' && as_text(row["data"]) == "extreme")) continue;
      if (!largest || error_in(row[which]["error"]) > error_in((*largest)[which]["error"])) largest = &row;
    }
    if (largest)
      text += fmt::format("worst in {}:\n{}", name_of(*largest, with_target),
                          worst_text((*largest)[which], unit));
  }
  return text;
}

std::string table_csv(const json& ulp) {
  constexpr const char* kColumns[] = {
      "values",     "not_correctly_rounded", "not_finite",           "max_ulp",
      "mean_ulp",   "max_condition_aware",   "mean_condition_aware", "zeros",
      "zeros_wrong"};
  std::string text =
      fmt::format("implementation,maps,target,{},max_ulp_found_by,max_condition_aware_found_by\n",
                  fmt::join(kColumns, ","));
  for (const json& implementation : ulp["implementations"]) {
    std::string name;
    for (const char c : as_text(implementation["name"])) name += c == '"' ? "\"\"" : std::string(1, c);
    if (name.find_first_of(",\"\r\n") != std::string::npos) name = fmt::format("\"{}\"", name);
    for (const json& row : implementation["rows"]) {
      if (row.contains("not_measured")) continue;
      text += fmt::format("{},{},{}", name, as_text(row["name"]), row.value("target", ""));
      for (const char* const column : kColumns)
        text += "," + (row[column].is_null() ? "inf" : row[column].dump());
      text += fmt::format(",{},{}\n", found_by(row, "worst_ulp"), found_by(row, "worst_condition_aware"));
    }
  }
  return text;
}

}  // namespace evalcts::cli
