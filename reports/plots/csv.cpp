// The numbers of the accuracy page as comma-separated values (RFC 4180).
#include <fmt/format.h>

#include "evalcts/accuracy_page.h"
#include "text.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string field(const json& value) {
  if (value.is_null()) return "inf";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.17g}", value.get<double>());
  return value.is_string() ? field(value.get<std::string>()) : value.dump();
}

template <class... Fields>
void add_line(std::string& text, const Fields&... fields) {
  text += join({field(fields)...}, ",") + "\n";
}

template <class Each>
void for_rows(const json& ulp, const Each& each) {
  for (const json& entry : ulp.at("implementations"))
    for (const json& row : entry.at("rows"))
      if (!row.contains("not_measured")) each(entry.at("name"), row);
}

std::string found_by(const json& row, const char* which) {
  return row.contains(which) ? row.at(which).at("found_by").get<std::string>() : "-";
}

std::string words_of(const json& strings, const char* separator) {
  return join(strings.get<std::vector<std::string>>(), separator);
}

}  // namespace

std::string table_csv(const json& ulp) {
  std::string text =
      "implementation,maps,target,values,not_correctly_rounded,not_finite,max_ulp,mean_ulp,max_condition_"
      "aware,"
      "mean_condition_aware,zeros,zeros_wrong,without_terms,without_terms_wrong,proven,sample_max_ulp,"
      "sample_max_condition_aware,max_ulp_found_by,max_condition_aware_found_by\n";
  for_rows(ulp, [&](const json& name, const json& row) {
    const json &zeros = row.at("zeros"), &without = row.at("without_terms");
    add_line(text, name, row.at("name"), row.value("target", ""), row.at("values"),
             row.at("not_correctly_rounded"), row.at("not_finite"), row.at("max_ulp"), row.at("mean_ulp"),
             row.at("max_condition_aware"), row.at("mean_condition_aware"), zeros.at("values"),
             zeros.at("wrong"), without.at("values"), without.at("wrong"), row.at("proven"),
             row.at("sample_max_ulp"), row.at("sample_max_condition_aware"), found_by(row, "worst_ulp"),
             found_by(row, "worst_condition_aware"));
  });
  return text;
}

std::string histograms_csv(const json& ulp) {
  std::string text = "implementation,maps,target,error_up_to_ulp,results\n";
  for_rows(ulp, [&](const json& name, const json& row) {
    double edge = 0.5;
    const json& histogram = row.at("histogram");
    for (std::size_t bin = 0; bin < histogram.size(); ++bin, edge *= 2)
      add_line(text, name, row.at("name"), row.value("target", ""),
               bin + 1 == histogram.size() ? "inf" : fmt::format("{:g}", edge), histogram[bin]);
  });
  return text;
}

std::string worst_csv(const json& ulp) {
  std::string text =
      "implementation,maps,target,unit,error,proven,found_by,orders,points,at,got,right,exact,replay\n";
  for_rows(ulp, [&](const json& name, const json& row) {
    for (const auto& [which, unit] : {std::pair{"worst_ulp", "ULP"},
                                      {"worst_condition_aware", "condition-aware"},
                                      {"worst_zero", "condition-aware, of an exact zero"}}) {
      if (!row.contains(which)) continue;
      const json& worst = row.at(which);
      std::vector<std::string> orders;
      for (const json& order : worst.at("orders")) orders.push_back(order.dump());
      add_line(text, name, row.at("name"), row.value("target", ""), std::string(unit), worst.at("error"),
               row.at("proven"), worst.at("found_by"), join(orders, " "), words_of(worst.at("points"), " "),
               words_of(worst.at("at"), " "), worst.at("got").at("value"), worst.at("right").at("value"),
               worst.at("exact"), words_of(worst.at("replay"), " "));
    }
  });
  return text;
}

std::string profiles_csv(const json& ulp) {
  std::string text = "implementation,curve,u_from,u_to,max_ulp,max_condition_aware\n";
  for (const json& entry : ulp.at("implementations"))
    for (const json& profile : entry.at("profiles")) {
      if (profile.contains("not_measured")) continue;
      const json& by_ulp = profile.at("max_ulp");
      const auto width = 1 / static_cast<double>(by_ulp.size());
      for (std::size_t bin = 0; bin < by_ulp.size(); ++bin)
        add_line(text, entry.at("name"), profile.at("name"), json(static_cast<double>(bin) * width),
                 json(static_cast<double>(bin + 1) * width), by_ulp[bin],
                 profile.at("max_condition_aware").at(bin));
    }
  return text;
}

}  // namespace evalcts::reports
