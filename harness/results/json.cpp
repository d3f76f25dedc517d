#include <evalcts/results/json.h>

namespace evalcts {

nlohmann::json parse_json(std::string_view text) { return nlohmann::json::parse(text, nullptr, false); }

}  // namespace evalcts
