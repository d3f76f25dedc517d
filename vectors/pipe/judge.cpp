// Judges the answers of another program: answers to shipped cases by their stored results, answers to random
// cases by estimates or, if these do not decide, by exact arithmetic.
#include <fmt/format.h>
#include <reference/normal.h>
#include <reference/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/vectors/pipe.h>
#include "estimate.h"
#include "question.h"
#include "write/normals.h"
#include "write/numbers.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

// Returns a message about the first value that is not accepted, or an empty string.
std::string wrong_values(const json& components, const std::vector<double>& got) {
  for (std::size_t c = 0; c < got.size(); ++c) {
    const json& accept = components[c]["accept"];
    if (accept.is_null()) continue;
    if (got[c] >= number(accept[0]) && got[c] <= number(accept[1])) continue;
    return fmt::format("component {}: {} ({}) is not between {} and {}; nearest is {}", c, got[c],
                       evalcts::hexadecimal(got[c]), accept[0].get<std::string>(),
                       accept[1].get<std::string>(), components[c]["float"].get<std::string>());
  }
  return {};
}

// The specification leaves the method of computing normals open (EV-AUTON-METHOD). The rounding error of the
// components to which normals are compared is negligible.
constexpr double kMethodAllowance = 2e-3, kRounding = 0x1p-50;

// Returns the largest error of a component of a normal, of either sign if the case allows it; infinity if
// one is NaN.
double error_of_normal(const std::vector<double>& got, const std::array<double, 3>& normal,
                       bool either_sign) {
  const auto error_of = [&](double sign) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(got[c] - sign * normal[c]);
      if (std::isnan(error)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, error);
    }
    return largest;
  };
  return either_sign ? std::min(error_of(1), error_of(-1)) : error_of(1);
}

std::array<double, 3> normal_of(const json& entry) {
  const json& normal = entry["normal"];
  return {number(normal[0]["double"]), number(normal[1]["double"]), number(normal[2]["double"])};
}

double error_of_normal(const std::vector<double>& got, const json& entry) {
  return error_of_normal(got, normal_of(entry), entry["accept"]["either_sign"]);
}

std::string wrong_normal(const json& entry, const std::vector<double>& got) {
  const json& accept = entry["accept"];
  if (entry["normal"].is_null() || accept.is_null()) return {};
  const double bound = number(accept["bound"]) + kMethodAllowance + kRounding;
  if (error_of_normal(got, entry) <= bound) return {};
  const auto [x, y, z] = normal_of(entry);
  return fmt::format("({}, {}, {}) is not within {} of ({}, {}, {})", got[0], got[1], got[2], bound, x, y, z);
}

// --- Quality

constexpr const char* kNormalTarget = "GL_AUTO_NORMAL";
// The least bound of the accuracy rule for normals, 10*eps.
constexpr double kLeastNormalBound = 10 * 0x1p-30 * 10738;

// Returns the error of a normal as a multiple of the bound of single precision.
double multiple_of(double error, double bound) {
  return error / reference::normal_quality_bound(reference::Rational(bound)).to_double();
}

// Returns the bound of single precision for values: 2^-24 * 2(n + 2) times the magnitude, but at least times
// the least normal number. `degrees`: n, for surfaces n + m.
long double quality_bound(int degrees, long double magnitude) {
  return 0x1p-24L * 2 * (degrees + 2) * std::max(magnitude, 0x1p-126L);
}

bool is_at_end(const json& argument, const json& first, const json& last) {
  return number(argument) == number(first) || number(argument) == number(last);
}

// Adds the quality of the answer to a case of type "f" at a coordinate to the score.
void assess(const json& entry, const std::vector<double>& got, Score& score) {
  const json &map = entry["map"], &domain = map["domain"];
  if (as_text(map["type"]) != "f" || entry["u"].is_object()) return;
  const bool two = entry.contains("v");
  const std::size_t degrees = map["points"].size() - 1 + (two ? map["points"][0].size() - 1 : 0);
  const bool is_corner =
      is_at_end(entry["u"], domain[0], domain[1]) && (!two || is_at_end(entry["v"], domain[2], domain[3]));
  Score::Quality& quality = score.quality[map["target"]];
  for (std::size_t c = 0; c < got.size(); ++c) {
    const json& component = entry["components"][c];
    if (component["accept"].is_null()) continue;
    double multiple = std::numeric_limits<double>::infinity();
    if (std::isfinite(got[c])) {
      const double error = abs(reference::Rational(got[c]) - rational(component["exact"])).to_double();
      const long double bound =
          quality_bound(static_cast<int>(degrees), rational(component["magnitude"]).to_double());
      if (!is_corner || error == 0) multiple = static_cast<double>(error / bound);
    }
    quality.add(multiple, entry["id"]);
  }
}

void assess_normal(const json& entry, const std::vector<double>& got, Score& score) {
  const json& accept = entry["accept"];
  if (entry["normal"].is_null() || accept.is_null() || as_text(entry["map"]["type"]) != "f" ||
      entry["u"].is_object())
    return;
  score.quality[kNormalTarget].add(multiple_of(error_of_normal(got, entry), number(accept["bound"])),
                                   entry["id"]);
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

// Returns a message about a wrong answer, or an empty string if it conforms. Adds its accuracy to the score.
std::string judge_one(const json& entry, const std::vector<double>& got, Score& score) {
  const bool is_normal = entry.contains("derivatives");
  const std::size_t expected = is_normal ? 3 : entry["components"].size();
  if (got.size() != expected) return fmt::format("{} numbers instead of {}", got.size(), expected);
  if (is_normal) {
    assess_normal(entry, got, score);
    return wrong_normal(entry, got);
  }
  measure(entry, got, score);
  assess(entry, got, score);
  return wrong_values(entry["components"], got);
}

// --- Random cases

// Answers are accepted without exact arithmetic up to this fraction of a lower bound on the accepted error.
// The rest is much more than the gap between floats at the ends of the acceptance interval.
constexpr long double kSurePart = 0.9L;
// Exact arithmetic decides if the relative distance of a value from a limit is smaller.
constexpr long double kMargin = 0x1p-16L;

// Returns the gap between the floats around a value, or half of it next to a power of two.
long double least_gap(long double value) {
  int exponent = 0;
  const long double fraction = std::frexp(std::abs(value), &exponent);
  return std::ldexp(fraction < 0.5L + kMargin ? 0.5L : 1.0L, std::max(exponent - 24, -149));
}

enum class Verdict { kAccepted, kNotJudged, kUnsure };

Verdict judge_surely(const Estimate& estimate, double got, int operations, int range, double largest_ulp) {
  const auto& [value, magnitude, error, reach] = estimate;
  const long double limit = std::ldexp(1.0L, range);
  if (reach > limit * (1 + kMargin)) return Verdict::kNotJudged;
  if (reach > limit * (1 - kMargin)) return Verdict::kUnsure;
  const long double least = 0x1p-30L * 10738 * operations * magnitude;
  if (!(std::abs(got - value) + error <= kSurePart * least)) return Verdict::kUnsure;
  // The exact value has to round to the same float wherever it lies.
  if (static_cast<float>(value - error) != static_cast<float>(value + error)) return Verdict::kUnsure;
  // An error that may be the largest one is measured exactly.
  const long double distance = std::abs(static_cast<float>(got) - value) + error;
  return distance > largest_ulp * least_gap(value) * (1 - kMargin) ? Verdict::kUnsure : Verdict::kAccepted;
}

bool is_at_end(const Argument& argument, const Direction& domain) {
  return argument.coordinate() == domain.first || argument.coordinate() == domain.last;
}

// Returns true if the values are certainly accepted, and measures them; false if exact arithmetic has to
// decide. The accuracy rule applies to the domains of all random cases.
bool accepts_surely(const Problem& problem, const std::vector<double>& got, const std::string& id,
                    Score& score) {
  const auto estimates = estimate(problem);
  if (!estimates || got.size() != estimates->size()) return false;
  const Map& map = problem.map;
  const int n = map.u.order - 1, m = map.v.order - 1;
  const int operations = problem.v ? n * m + 5 * (n + m) + 4 : 5 * n + 4;
  const int range = reference::guaranteed_range(map.target, kNewestVersion);
  std::vector<Verdict> verdicts;
  for (std::size_t c = 0; c < got.size(); ++c) {
    verdicts.push_back(judge_surely((*estimates)[c], got[c], operations, range, score.largest_ulp));
    if (verdicts.back() == Verdict::kUnsure) return false;
  }
  const bool is_assessed = problem.type == Type::kSingle && !problem.u.is_grid();
  const bool is_corner =
      is_assessed && is_at_end(problem.u, map.u) && (!problem.v || is_at_end(*problem.v, map.v));
  for (std::size_t c = 0; c < got.size(); ++c) {
    if (verdicts[c] == Verdict::kNotJudged) continue;
    const auto& [value, magnitude, error, reach] = (*estimates)[c];
    ++score.values;
    if (static_cast<float>(got[c]) == static_cast<float>(value)) ++score.correctly_rounded;
    if (!is_assessed) continue;
    const long double difference = std::abs(got[c] - value);
    const double multiple = is_corner && difference > error
                                ? std::numeric_limits<double>::infinity()
                                : static_cast<double>(difference / quality_bound(n + m, magnitude));
    score.quality[std::string(gl::token_name(map.target))].add(multiple, id);
  }
  return true;
}

// The same for a normal. It is accepted if its error is within the method allowance alone, and as good as
// single precision if it is within the part of that bound that does not depend on the case.
bool accepts_normal_surely(const Problem& problem, const std::vector<double>& got, const std::string& id,
                           Score& score) {
  const auto estimate = estimate_normal(problem);
  if (!estimate || got.size() != 3) return false;
  const Map& map = problem.map;
  const bool either_sign = (map.u.first > map.u.last) != (map.v.first > map.v.last);
  const double error = error_of_normal(got, estimate->normal, either_sign);
  if (problem.type != Type::kSingle || problem.u.is_grid()) return error <= kMethodAllowance;
  const double multiple = multiple_of(error + estimate->error, kLeastNormalBound);
  if (!(multiple <= 1)) return false;
  score.quality[kNormalTarget].add(multiple, id);
  return true;
}

std::string judge_random_case(const RandomCases& cases, const std::vector<double>& got, Score& score) {
  const Problem& problem = cases.problem();
  const bool is_sure = cases.is_normal() ? accepts_normal_surely(problem, got, cases.id(), score)
                                         : accepts_surely(problem, got, cases.id(), score);
  if (is_sure) return {};
  nlohmann::json entry = cases.is_normal() ? normal_case(problem) : value_case(problem);
  entry["id"] = cases.id();
  return judge_one(entry, got, score);
}

}  // namespace

void Score::Quality::add(double multiple, const std::string& id_of_case) {
  ++values;
  if (!(multiple <= 1)) ++worse;
  if (multiple <= largest) return;
  largest = multiple;
  id = id_of_case;
}

void Score::Quality::add(const Quality& other) {
  values += other.values;
  worse += other.worse;
  if (other.largest <= largest) return;
  largest = other.largest;
  id = other.id;
}

std::string quality_in_words(const std::vector<Score>& scores) {
  std::map<std::string, Score::Quality> all;
  for (const Score& score : scores)
    for (const auto& [target, quality] : score.quality)
      if (quality.values > 0) all[target].add(quality);
  if (all.empty()) return {};
  std::string worse;
  std::size_t good = 0;
  for (const auto& [target, quality] : all) {
    if (quality.worse == 0) {
      ++good;
      continue;
    }
    const std::string largest = std::isinf(quality.largest)
                                    ? std::string("a corner is not its control point or a result not finite")
                                    : fmt::format("{:.3g} times the bound", quality.largest);
    worse += fmt::format("{} {} ({} of {} values; {} in {})", worse.empty() ? "; not for" : ",", target,
                         quality.worse, quality.values, largest, quality.id);
  }
  return fmt::format("quality: as good as single precision for {} of {} targets{}", good, all.size(), worse);
}

bool read_answer(std::istream& lines, Answers& answers) {
  std::string line;
  if (!std::getline(lines, line)) return false;
  ++answers.lines;
  constexpr const char* kSpace = " \t\r";
  const std::size_t first = line.find_first_not_of(kSpace);
  if (first == std::string::npos || line[first] == '#') return true;
  const std::size_t end_of_id = std::min(line.find_first_of(kSpace, first), line.size());
  std::vector<double> numbers;
  bool is_good = true, is_skipped = false;
  for (std::size_t at = line.find_first_not_of(kSpace, end_of_id); at < line.size();) {
    const std::size_t end_of_word = std::min(line.find_first_of(kSpace, at), line.size());
    char* end = nullptr;
    numbers.push_back(std::strtod(line.c_str() + at, &end));
    if (line.compare(at, end_of_word - at, "skip") == 0)
      is_skipped = true;
    else if (end != line.c_str() + end_of_word)
      is_good = false;
    at = line.find_first_not_of(kSpace, end_of_word);
  }
  if (is_skipped ? numbers.size() != 1 : !is_good || numbers.empty()) {
    answers.malformed.push_back(fmt::format("line {}: \"{}\" is not an id and numbers or \"skip\"",
                                            answers.lines, line.substr(0, 60)));
    return true;
  }
  if (is_skipped) numbers.clear();
  const std::string id = line.substr(first, end_of_id - first);
  if (!answers.of.emplace(id, std::move(numbers)).second) answers.answered_twice.push_back(id);
  return true;
}

Answers read_answers(std::istream& lines) {
  Answers answers;
  while (read_answer(lines, answers)) {
  }
  return answers;
}

// Takes the answer with this id. If it is missing or skipped, returns no numbers and counts it in the score.
static std::vector<double> take_answer(Answers& answers, const std::string& id, Score& score) {
  auto answer = answers.of.extract(id);
  if (answer.empty())
    score.missing.push_back(id);
  else if (answer.mapped().empty())
    ++score.skipped;
  else
    return std::move(answer.mapped());
  return {};
}

Score judge_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::istream& lines,
                   Answers& answers) {
  Score score;
  score.kind = kind;
  RandomCases cases(kind, seed);
  for (; score.cases < count; ++score.cases) {
    cases.draw();
    while (!answers.of.contains(cases.id()) && read_answer(lines, answers)) continue;
    const std::vector<double> got = take_answer(answers, cases.id(), score);
    if (got.empty()) continue;
    std::string message = judge_random_case(cases, got, score);
    if (!message.empty()) score.wrong.push_back({cases.id(), message + "\n    " + question(cases)});
  }
  return score;
}

Score judge(const json& file, Answers& answers) {
  Score score;
  score.kind = file["kind"];
  for (const json& entry : file["cases"]) {
    ++score.cases;
    const std::vector<double> got = take_answer(answers, entry["id"], score);
    if (got.empty()) continue;
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
