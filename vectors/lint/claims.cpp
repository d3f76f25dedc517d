// Checks that a case has the property of its theme, and that a case about the ends of a grid distinguishes an
// exact end from a computed one.
#include "claims.h"

#include <fmt/format.h>
#include <reference/component.h>

#include <functional>
#include <map>
#include <memory>

#include <evalcts/gl/tokens.h>
#include "lint/themes.h"
#include "lint/value_case.h"
#include "write/numbers.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

bool is_accepted(const json& accept, const Rational& x) {
  return accept.is_null() || (x >= Rational(number(accept[0])) && x <= Rational(number(accept[1])));
}

// Returns true if the exact value at another argument in the direction is not accepted, in some component.
bool shows(const json& entry, bool along_v, double argument) {
  Problem problem = problem_of(entry);
  (along_v ? *problem.v : problem.u) = Argument::coordinate(argument);
  const auto map = std::make_shared<const Map>(problem.map);
  for (int c = 0; c < map->components(); ++c) {
    const Rational value = exact(reference::Component(reference::Sample(map, c, problem.u, problem.v)));
    if (!is_accepted(entry["components"][static_cast<std::size_t>(c)]["accept"], value)) return true;
  }
  return false;
}

// Returns N * du + from with du = (to - from)/N and N = `segments`, with each operation rounded to the type;
// if `fused`, the product is not rounded.
double counted_end(int segments, double from, double to, Type type, bool fused) {
  const Rational step = rounded(Rational(rounded(Rational(to) - from, type)) / segments, type);
  const Rational way = step * segments;
  return rounded((fused ? way : Rational(rounded(way, type))) + from, type);
}

// Returns true if the case is at the first or last point of a grid and distinguishes its exact argument:
// steps from the other end, in the precision of the type and in single precision, fused or not, lead to
// another argument, at which the value is not accepted.
bool tells_exact_end(const json& entry, bool last) {
  for (const bool along_v : {false, true}) {
    if (along_v && !entry.contains("v")) continue;
    const json& point = entry[along_v ? "v" : "u"];
    const int segments = point["segments"];
    if (point["index"] != (last ? segments : 0)) continue;
    const double first = number(point["first"]), end = number(point["last"]);
    bool all = true;
    for (const Type type : {Type::kSingle, problem_of(entry).type})
      for (const bool fused : {false, true}) {
        const double counted = last ? counted_end(segments, first, end, type, fused)
                                    : counted_end(segments, end, first, type, fused);
        all = all && counted != (last ? end : first) && shows(entry, along_v, counted);
      }
    if (all) return true;
  }
  return false;
}

using Holds = std::function<bool(const json& entry)>;

const std::map<std::string, Holds>& claims_of_requirements() {
  const Holds first = [](const json& entry) { return tells_exact_end(entry, false); };
  const Holds last = [](const json& entry) { return tells_exact_end(entry, true); };
  const Holds any = [=](const json& entry) { return first(entry) || last(entry); };
  static const std::map<std::string, Holds> kClaims = {{"EV-POINT-EXACT-0", first},
                                                       {"EV-POINT-EXACT-N", last},
                                                       {"EV-MESH1-EXACT-0", first},
                                                       {"EV-MESH1-EXACT-N", last},
                                                       {"EV-MESH2-EXACT", any}};
  return kClaims;
}

}  // namespace

std::string broken_claim(const json& entry) {
  if (!entry.contains("map")) return {};
  if (const std::string theme = broken_theme(entry); !theme.empty())
    return fmt::format("does not have the property that its theme '{}' claims", theme);
  if (!entry.contains("components")) return {};
  for (const std::string requirement : entry["requirements"]) {
    const auto found = claims_of_requirements().find(requirement);
    if (found != claims_of_requirements().end() && !found->second(entry))
      return fmt::format("claims {}, but accepts a result that violates it", requirement);
  }
  return {};
}

}  // namespace evalcts::vectors
