// The output of `evalcts ulp`, made from the content of ulp.json (reports/schema/ulp-2.schema.json).
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::cli {

// Returns an error of ulp.json, in which infinity is null.
double error_in(const nlohmann::json& value);

// Returns the table of one implementation for the terminal, and its inputs with the largest errors. If
// `with_target`, rows are named with their targets.
std::string table_text(const nlohmann::json& implementation, bool with_target);

// Returns the table of all implementations as comma-separated values (RFC 4180).
std::string table_csv(const nlohmann::json& ulp);

// Return pictures in SVG: the largest condition-aware error of curves of ordinary data by order, and the
// largest error in ULP along a curve. Empty if no implementation was measured.
std::string errors_by_order(const nlohmann::json& ulp);
std::string errors_by_argument(const nlohmann::json& ulp);

}  // namespace evalcts::cli
