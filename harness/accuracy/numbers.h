// Numbers in the JSON of accuracy tables and sweeps. Exact numbers are hexadecimal text, and infinity is
// null.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::accuracy {

nlohmann::json number_as_json(double value);  // null unless finite
nlohmann::json float_as_json(float value);    // {"value": "0x1.8p+0", "bits": "0x3fc00000"}
nlohmann::json hex_as_json(const std::vector<double>& values);

// Throw std::invalid_argument or nlohmann::json::exception if the value does not have the format.
double number_from(const nlohmann::json& value);  // null is infinity
float float_from(const nlohmann::json& value);    // by its bits
double hex_from(const nlohmann::json& value);
std::vector<double> hex_list_from(const nlohmann::json& value);

}  // namespace evalcts::accuracy
