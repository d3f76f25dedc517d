// Compares, reads and writes the identities of differences.
#include <evalcts/results/difference.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace evalcts {

bool Difference::is_like(const Difference& other) const {
  const auto agree = [](const std::string& a, const std::string& b) {
    return a.empty() || b.empty() || a == b;
  };
  const auto begins = [](const std::string& a, const std::string& b) { return b.starts_with(a + " "); };
  return kind == other.kind && agree(relation, other.relation) &&
         (agree(place, other.place) || begins(place, other.place) || begins(other.place, place));
}

Difference Difference::completed_by(const Difference& other) const {
  return {kind, place.size() < other.place.size() ? other.place : place,
          relation.empty() ? other.relation : relation};
}

std::string Difference::text() const { return kind + "; " + place + "; " + relation; }

std::optional<Difference> parse_difference(const std::string& text) {
  const std::size_t first = text.find("; ");
  const std::size_t second = first == std::string::npos ? first : text.find("; ", first + 2);
  if (second == std::string::npos) return std::nullopt;
  return Difference{text.substr(0, first), text.substr(first + 2, second - first - 2),
                    text.substr(second + 2)};
}

std::string kind_of(const std::string& named) {
  const std::size_t colon = named.rfind(": ");
  const std::string what = colon == std::string::npos ? named : named.substr(colon + 2);
  if (what == "glGetError") return Difference::kError;
  if (what.starts_with("glGet") || what.starts_with("glIs")) return Difference::kAnswer;
  if (what == "number of vertices" || what == "primitives") return Difference::kVertices;
  for (const std::string_view attribute : {"position", "color", "normal", "texture coordinate"})
    if (what.starts_with(attribute)) return std::string(attribute);
  return {};
}

std::string relation_of(double captured, double lowest, double highest) {
  if (std::isnan(captured)) return "not a number";
  constexpr double kNear = 0.01;
  const double distance = std::max(captured - highest, lowest - captured);
  const double scale = std::max(1.0, std::min(std::abs(lowest), std::abs(highest)));
  return std::isfinite(scale) && distance <= kNear * scale ? "near" : "far";
}

std::string relation_of_errors(const std::string& captured, const std::string& expected) {
  constexpr std::string_view kNone = "GL_NO_ERROR";
  if (expected == kNone) return "spurious " + captured;
  return captured == kNone ? "missing " + expected : captured + " instead of " + expected;
}

}  // namespace evalcts
