#include <fmt/format.h>
#include <reference/rounding.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include <evalcts/vectors/pipe.h>
#include "lint/numbers.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

// Returns the error in the values; empty if there is none.
std::string wrong_values(const json& components, const std::vector<double>& got) {
  for (std::size_t c = 0; c < got.size(); ++c) {
    const json& accept = components[c]["accept"];
    if (accept.is_null()) continue;
    if (got[c] >= number(accept[0]) && got[c] <= number(accept[1])) continue;
    return fmt::format("component {}: {} ({:a}) is not between {} and {}; nearest is {}", c, got[c], got[c],
                       accept[0].get<std::string>(), accept[1].get<std::string>(),
                       components[c]["float"].get<std::string>());
  }
  return {};
}

// The method of computing normals is open (EV-AUTON-METHOD), and what the rounded components that are
// compared with are off is nothing beside that.
constexpr double kMethodAllowance = 2e-3, kRounding = 0x1p-50;

std::string wrong_normal(const json& entry, const std::vector<double>& got) {
  const json &normal = entry["normal"], &accept = entry["accept"];
  if (normal.is_null() || accept.is_null()) return {};
  const double bound = number(accept["bound"]) + kMethodAllowance + kRounding;
  const auto is_within = [&](double sign) {
    for (std::size_t c = 0; c < 3; ++c)
      if (!(std::abs(got[c] - sign * number(normal[c]["double"])) <= bound)) return false;
    return true;
  };
  if (is_within(1) || (accept["either_sign"] && is_within(-1))) return {};
  return fmt::format("({}, {}, {}) is not within {} of ({}, {}, {})", got[0], got[1], got[2], bound,
                     number(normal[0]["double"]), number(normal[1]["double"]), number(normal[2]["double"]));
}

void measure(const json& entry, const std::vector<double>& got, Score& score) {
  for (std::size_t c = 0; c < got.size(); ++c) {
    const json& component = entry["components"][c];
    if (component["accept"].is_null()) continue;
    ++score.values;
    const auto value = static_cast<float>(got[c]);
    if (value == number(component["float"])) ++score.correctly_rounded;
    const double ulp = reference::ulp_distance(value, rational(component["exact"]));
    if (ulp <= score.largest_ulp) continue;
    score.largest_ulp = ulp;
    score.largest_id = entry["id"];
  }
}

// One answer in words; empty if it is all right.
std::string judge_one(const json& entry, const std::vector<double>& got, Score& score) {
  const bool is_normal = entry.contains("derivatives");
  const std::size_t expected = is_normal ? 3 : entry["components"].size();
  if (got.size() != expected) return fmt::format("{} numbers in the place of {}", got.size(), expected);
  if (is_normal) return wrong_normal(entry, got);
  measure(entry, got, score);
  return wrong_values(entry["components"], got);
}

}  // namespace

Answers read_answers(std::istream& lines) {
  Answers answers;
  std::string line;
  for (std::size_t count = 1; std::getline(lines, line); ++count) {
    std::istringstream words(line);
    std::string id, word;
    if (!(words >> id) || id.front() == '#') continue;
    std::vector<double> numbers;
    bool good = true, skipped = false;
    while (words >> word) {
      char* end = nullptr;
      numbers.push_back(std::strtod(word.c_str(), &end));
      if (word == "skip")
        skipped = true;
      else if (end == word.c_str() || *end != '\0')
        good = false;
    }
    if (skipped ? numbers.size() != 1 : !good || numbers.empty()) {
      answers.malformed.push_back(
          fmt::format("line {}: \"{}\" is not an id and numbers or \"skip\"", count, line.substr(0, 60)));
      continue;
    }
    if (skipped) numbers.clear();
    if (!answers.of.emplace(id, std::move(numbers)).second) answers.answered_twice.push_back(id);
  }
  return answers;
}

Score judge(const json& file, Answers& answers) {
  Score score;
  score.kind = file["kind"];
  for (const json& entry : file["cases"]) {
    ++score.cases;
    const auto found = answers.of.find(entry["id"]);
    if (found == answers.of.end()) {
      score.missing.push_back(entry["id"]);
      continue;
    }
    const std::vector<double> got = std::move(found->second);
    answers.of.erase(found);
    if (got.empty()) {
      ++score.skipped;
      continue;
    }
    std::string message = judge_one(entry, got, score);
    for (const std::string flag : entry["flags"]) {
      Score::Count& count = score.by_flag[flag];
      ++count.answered;
      if (!message.empty()) ++count.wrong;
    }
    if (!message.empty()) score.wrong.push_back({entry["id"], std::move(message)});
  }
  return score;
}

}  // namespace evalcts::vectors
