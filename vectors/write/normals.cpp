// Writes the exact derivatives, the normal and its acceptance of a case about automatic normals.
#include "normals.h"

#include <reference/normal.h>

#include "text.h"

namespace evalcts::vectors {
namespace {

using reference::AutomaticNormal;
using reference::Surface;
using reference::Vector;

constexpr int kEnclosureBits = 80;

// Returns dq/duh x dq/dvh, or nothing if w is zero.
std::optional<Vector> exact(const AutomaticNormal& normal, const std::vector<Surface>& surfaces) {
  if (surfaces.size() == 4 && reference::evaluate(surfaces[3], normal.u, normal.v).is_zero()) return {};
  return reference::normal_vector(surfaces, normal.u, normal.v);
}

Json unit_vector(const Vector& m) {
  const auto enclosures = reference::unit_vector(m, kEnclosureBits);
  const auto floats = reference::rounded_unit_vector(m);
  const auto doubles = reference::rounded_unit_vector_to_double(m);
  Json components = Json::array();
  for (std::size_t c = 0; c < 3; ++c)
    components.push_back(
        {{"enclosure", Json::array({fraction(enclosures[c].low), fraction(enclosures[c].high)})},
         {"float", hexadecimal(floats[c])},
         {"double", hexadecimal(doubles[c])}});
  return components;
}

Json accept(const AutomaticNormal& normal) {
  const auto acceptance = reference::acceptance(normal);
  if (!acceptance || !acceptance->must_applies || !acceptance->bound) return nullptr;
  const Map& map = *normal.map;
  // The bound is computed in binary64, whose last bits may differ between machines. Rounded up to binary32 it
  // is the same on all of them.
  return {{"bound", hexadecimal(round_up(*acceptance->bound))},
          {"either_sign", (map.u.first > map.u.last) != (map.v.first > map.v.last)}};
}

}  // namespace

Json entry_of(const AutomaticNormal& normal) {
  const std::optional<Vector> m = exact(normal, normal.map->surfaces());
  return {{"m", m ? fractions({m->begin(), m->end()}) : Json()},
          {"normal", m && !reference::is_degenerate(*m) ? unit_vector(*m) : Json()},
          {"accept", accept(normal)}};
}

namespace {

Json derivatives_of(const AutomaticNormal& normal) {
  std::vector<Rational> u, v;
  for (const Surface& surface : normal.map->surfaces()) {
    const reference::Jet jet = reference::jet(surface, normal.u, normal.v);
    u.push_back(jet.u);
    v.push_back(jet.v);
  }
  return {{"u", fractions(u)}, {"v", fractions(v)}};
}

}  // namespace

Json normal_case(const Problem& problem) {
  Json content = {{"level", "must"},
                  {"map", map_as_json(problem.map, problem.type)},
                  {"u", argument_as_json(problem.u)},
                  {"v", argument_as_json(*problem.v)}};
  const AutomaticNormal normal{std::make_shared<const Map>(problem.map), problem.u, *problem.v};
  content["derivatives"] = derivatives_of(normal);
  content.update(entry_of(normal));
  if (content["accept"].is_null()) content["level"] = "advisory";
  return content;
}

}  // namespace evalcts::vectors
