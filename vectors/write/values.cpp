// Writes the exact value, its roundings, its acceptance interval and intermediate results of a case about
// values.
#include "values.h"

#include <fmt/format.h>
#include <reference/rounding.h>

#include <stdexcept>
#include <utility>

#include <evalcts/gl/tokens.h>
#include "text.h"

namespace evalcts::vectors {

using reference::Acceptance;
using reference::Sample;

namespace {

// The last version (10 * major + minor) that guarantees smaller ranges.
constexpr int kBefore2 = 15;

int range_of(const Map& map) { return reference::guaranteed_range(map.target, kNewestVersion); }

Json accept(const Rational& exact, const std::optional<Rational>& bound) {
  const std::optional<Interval> interval = bound ? accepted(exact, *bound) : std::nullopt;
  if (!interval) return nullptr;
  return Json::array({hexadecimal(interval->low), hexadecimal(interval->high)});
}

Json rounded_both_ways(const Rational& exact) {
  return {{"float", hexadecimal(reference::round_to_float(exact))},
          {"double", hexadecimal(reference::round_to_double(exact))}};
}

Json as_json(const Acceptance& value) {
  Json entry = {{"exact", fraction(value.exact)}, {"magnitude", fraction(value.magnitude)}};
  entry.update(rounded_both_ways(value.exact));
  entry["accept"] = accept(value.exact, value.must_applies ? std::optional(value.bound) : std::nullopt);
  return entry;
}

Json quotient(const Acceptance& x, const Acceptance& w) {
  const Rational exact = x.exact / w.exact;
  Json entry = {{"exact", fraction(exact)}};
  entry.update(rounded_both_ways(exact));
  const bool applies = x.must_applies && w.must_applies;
  entry["accept"] =
      accept(exact, applies ? reference::quotient_bound(x.exact, x.bound, w.exact, w.bound) : std::nullopt);
  return entry;
}

Rational normalised(const Argument& u, const Direction& direction) {
  return (u.value() - Rational(direction.first)) / (Rational(direction.last) - Rational(direction.first));
}

// Returns B_0 ... B_n at t, by their recurrence.
std::vector<Rational> basis(int order, const Rational& t) {
  std::vector<Rational> values{1};
  while (static_cast<int>(values.size()) < order) {
    std::vector<Rational> next(values.size() + 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      next[i] += (1 - t) * values[i];
      next[i + 1] += t * values[i];
    }
    values = std::move(next);
  }
  return values;
}

// Returns the rows of de Casteljau's triangle for the first component of a curve.
Json de_casteljau(const Map& map, const Rational& t) {
  std::vector<Rational> row;
  for (int i = 0; i < map.u.order; ++i)
    row.emplace_back(map.points[static_cast<std::size_t>(i * map.components())]);
  Json rows = Json::array({fractions(row)});
  while (row.size() > 1) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) row[i] = (1 - t) * row[i] + t * row[i + 1];
    row.pop_back();
    rows.push_back(fractions(row));
  }
  return rows;
}

Json intermediate(const Problem& problem) {
  const Rational uh = normalised(problem.u, problem.map.u);
  Json steps = {{"uh", fraction(uh)}};
  if (!problem.v) {
    steps["basis_u"] = fractions(basis(problem.map.u.order, uh));
    steps["de_casteljau"] = de_casteljau(problem.map, uh);
    return steps;
  }
  const Rational vh = normalised(*problem.v, problem.map.v);
  steps["vh"] = fraction(vh);
  steps["basis_u"] = fractions(basis(problem.map.u.order, uh));
  steps["basis_v"] = fractions(basis(problem.map.v.order, vh));
  return steps;
}

}  // namespace

Json hexadecimals(const Values& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(hexadecimal(value));
  return list;
}

Json fractions(const std::vector<Rational>& values) {
  Json list = Json::array();
  for (const Rational& value : values) list.push_back(fraction(value));
  return list;
}

Json map_as_json(const Map& map, Type type) {
  Values domain{map.u.first, map.u.last};
  if (map.is_two_dimensional()) domain.insert(domain.end(), {map.v.first, map.v.last});

  auto next = map.points.begin();
  const auto point = [&] {
    const auto first = next;
    next += map.components();
    return hexadecimals({first, next});
  };
  Json points = Json::array();
  for (int i = 0; i < map.u.order; ++i) {
    if (!map.is_two_dimensional()) {
      points.push_back(point());
      continue;
    }
    Json row = Json::array();
    for (int j = 0; j < map.v.order; ++j) row.push_back(point());
    points.push_back(std::move(row));
  }
  return {{"target", gl::token_name(map.target)},
          {"type", type == Type::kSingle ? "f" : "d"},
          {"domain", hexadecimals(domain)},
          {"points", std::move(points)}};
}

Json argument_as_json(const Argument& argument) {
  if (!argument.is_grid()) return hexadecimal(argument.coordinate());
  return {{"segments", argument.segments()},
          {"first", hexadecimal(argument.first())},
          {"last", hexadecimal(argument.last())},
          {"index", argument.index()},
          {"exact", fraction(argument.value())}};
}

bool needs_gl_2(const Sample& sample) {
  const int before = reference::guaranteed_range(sample.map().target, kBefore2);
  return before != range_of(sample.map()) && !must_applies(reference::Component(sample), before) &&
         must_applies(reference::Component(sample), range_of(sample.map()));
}

Json entry_of(const Sample& sample) { return as_json(acceptance(sample, range_of(sample.map()))); }

Json value_case(const Problem& problem, Detail detail) {
  Json content = {{"level", "advisory"}, {"since", kFirstVersion}};
  content["map"] = map_as_json(problem.map, problem.type);
  for (const auto& [name, argument] : {std::pair("u", std::optional(problem.u)), std::pair("v", problem.v)}) {
    if (argument) content[name] = argument_as_json(*argument);
  }

  const auto map = std::make_shared<const Map>(problem.map);
  std::vector<Acceptance> values;
  Json components = Json::array();
  for (int c = 0; c < map->components(); ++c) {
    const Sample sample(map, c, problem.u, problem.v);
    values.push_back(acceptance(sample, range_of(*map)));
    components.push_back(as_json(values.back()));
    if (!components.back()["accept"].is_null()) content["level"] = "must";
    if (needs_gl_2(sample)) content["since"] = "2.0";
  }
  content["components"] = std::move(components);
  const bool is_rational = map->target == GL_MAP1_VERTEX_4 || map->target == GL_MAP2_VERTEX_4;
  if (is_rational && !values[3].exact.is_zero()) {
    Json quotients = Json::array();
    for (std::size_t c = 0; c < 3; ++c) quotients.push_back(quotient(values[c], values[3]));
    content["quotients"] = std::move(quotients);
  }
  if (detail == Detail::kIntermediate) content["intermediate"] = intermediate(problem);
  return content;
}

}  // namespace evalcts::vectors
