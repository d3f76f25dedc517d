// Writes get_map.json: answers to queries of maps.
#include <algorithm>

#include <evalcts/gl/targets.h>
#include <evalcts/gl/tokens.h>
#include "kinds.h"
#include "sequences.h"

namespace evalcts::vectors {
namespace {

constexpr GLenum kQueries[] = {GL_ORDER, GL_DOMAIN, GL_COEFF};

int k_of(GLenum target) { return gl::components_of(target); }
// Returns the number of values of the answer.
std::size_t values_of(const Map& map, GLenum query) {
  const std::size_t dimensions = map.is_two_dimensional() ? 2 : 1;
  if (query == GL_ORDER) return dimensions;
  if (query == GL_DOMAIN) return 2 * dimensions;
  return map.points.size();
}

// Appends GetMapfv, GetMapdv or GetMapiv (form 0, 1, 2) with room for `spare` more values than the answer
// has.
void ask(gl::Case& c, int form, const Map& map, GLenum query, std::size_t spare = 2) {
  const std::size_t room = values_of(map, query) + spare;
  if (form == 0) c.GetMapfv(map.target, query, gl::out<GLfloat>(room));
  if (form == 1) c.GetMapdv(map.target, query, gl::out<GLdouble>(room));
  if (form == 2) c.GetMapiv(map.target, query, gl::out<GLint>(room));
}
// Returns true if every documented interpretation gives the same answer: integer queries of colours and
// normals have two (C-GETMAPIV-NORM).
bool is_certain(int form, GLenum target, GLenum query) {
  const bool is_normalized = target == GL_MAP1_COLOR_4 || target == GL_MAP2_COLOR_4 ||
                             target == GL_MAP1_NORMAL || target == GL_MAP2_NORMAL;
  return !(form == 2 && query == GL_COEFF && is_normalized);
}
void ask_everything(gl::Case& c, const Map& map) {
  for (const GLenum query : kQueries)
    for (int form = 0; form < 3; ++form)
      if (is_certain(form, map.target, query)) ask(c, form, map, query);
}

Names order_and_domain(GLenum target) {
  return reference::is_map2_target(target)
             ? Names{"EV-GETMAP-ORDER2", "EV-GETMAP-DOMAIN2", "EV-GETMAP-COEFF2", "EV-GETMAP-COUNT"}
             : Names{"EV-GETMAP-ORDER1", "EV-GETMAP-DOMAIN1", "EV-GETMAP-COEFF1", "EV-GETMAP-COUNT"};
}

void initial(Document& document) {
  Theme theme(document, "initial", "maps that were never defined", {"EV-GETMAP-DISABLED", "EV-INIT-DOMAIN"});
  const auto initial_requirement = [](GLenum target) -> Names {
    const int i = static_cast<int>(reference::is_map2_target(target) ? target - GL_MAP2_COLOR_4
                                                                     : target - GL_MAP1_COLOR_4);
    const char* const point = i == 0   ? "EV-INIT-COEFF-COLOR"
                              : i == 1 ? "EV-INIT-COEFF-INDEX"
                              : i == 2 ? "EV-INIT-COEFF-NORMAL"
                              : i <= 6 ? "EV-INIT-COEFF-TEX"
                                       : "EV-INIT-COEFF-VERTEX";
    return {point, reference::is_map2_target(target) ? "EV-INIT-ORDER2" : "EV-INIT-ORDER1"};
  };
  for (const GLenum target : gl::all_targets())
    for (int form = 0; form < 3; ++form) {
      gl::Case c;
      for (const GLenum query : kQueries)
        if (is_certain(form, target, query)) ask(c, form, reference::initial_map(target), query);
      theme.add(sequence(c), initial_requirement(target));
    }
}

void defined(Document& document) {
  Theme theme(document, "defined",
              "order, domain and control points as they were given, by f and d forms of both commands",
              {"EV-API-FD", "EV-GETMAP-FLOAT", "EV-GETMAP-DISABLED"});
  Dice& dice = theme.dice();
  for (const GLenum target : gl::all_targets())
    for (const Type type : kTypes)
      for (int i = 0; i < 2; ++i) {
        const Direction u{dice.between(1, 6), 2, i == 0 ? 5.0 : -1.0};
        const Direction v =
            reference::is_map2_target(target) ? Direction{dice.between(1, 4), -3, 0.5} : Direction{};
        const Map map{target, u, v, numbered(u.order * v.order * k_of(target), dice.between(-20, 20))};
        gl::Case c;
        define(c, type, map);
        ask_everything(c, map);
        theme.add(sequence(c), order_and_domain(target));
      }
}

void reals(Document& document) {
  Theme theme(document, "all-bits",
              "floats with all their bits, subnormal, huge and -0 among them, come back unchanged",
              {"EV-GETMAP-FLOAT"});
  Dice& dice = theme.dice();
  for (const GLenum target : gl::all_targets()) {
    const auto value = [&] {
      const int least = dice.one_in(3) ? -149 : -20;
      const int most = dice.one_in(3) ? 127 : 20;
      const double some = of_magnitude(dice, Type::kSingle, least, most);
      return dice.one_in(6) ? -0.0 : some;
    };
    Map map{target, {3, 0x1.2p-100, 0x1.fffffep+30}, {}, {}};
    if (reference::is_map2_target(target)) map.v = {2, -0x1.000002p+0, 0x1p-126};
    while (static_cast<int>(map.points.size()) < map.u.order * map.v.order * k_of(target))
      map.points.push_back(value());
    for (const Type type : kTypes) {
      gl::Case c;
      define(c, type, map);
      for (const GLenum query : {GL_DOMAIN, GL_COEFF})
        for (const int form : {0, 1}) ask(c, form, map, query);
      theme.add(sequence(c));
    }
  }

  Theme doubles(document, "double-only",
                "doubles that no float holds: they come back as they are, or as one of the adjacent floats",
                {"EV-GETMAP-DOUBLE"});
  for (const GLenum target : gl::all_targets()) {
    Map map{target, {2, 0.1, 0.7}, {}, {}};
    if (reference::is_map2_target(target)) map.v = {2, -0.3, 1.0 / 3};
    while (static_cast<int>(map.points.size()) < map.u.order * map.v.order * k_of(target))
      map.points.push_back(full(doubles.dice(), Type::kReal));
    gl::Case c;
    define(c, Type::kReal, map);
    for (const GLenum query : {GL_DOMAIN, GL_COEFF})
      for (const int form : {0, 1}) ask(c, form, map, query);
    doubles.add(sequence(c));
  }
}

void integers(Document& document) {
  Theme rounding(document, "rounding", "GetMapiv rounds to the nearest integer", {"EV-GETMAP-ROUND"});
  Theme halves(document, "halves", "GetMapiv halfway between two integers: either is accepted",
               {"EV-GETMAP-ROUND"});
  Theme saturating(document, "saturating", "GetMapiv of values beyond the range of int: the nearest int",
                   {"EV-GETMAP-SATURATE"});
  // These themes include colours and normals, for which the specification makes no exception, with a flag for
  // implementations that scale them.
  constexpr double kBetween[] = {1.4, -1.6, 2.51, -0.25, 0.49, 1e6 + 0.75, 123456.25, -7.9};
  constexpr double kHalves[] = {0.5, -0.5, 1.5, 2.5, -3.5, 8388607.5};
  constexpr double kBeyond[] = {1e20, -1e20, 0x1p31, -0x1p31, 0x1p127, -0x1p100, 2147483520, 4e9};
  document.explain("normalized-reading",
                   "colours or normals as integers: by the text they are rounded like all others; "
                   "an implementation may map [-1, 1] to the whole range, skip these if yours does");
  for (const GLenum target : gl::all_targets()) {
    const int kind = static_cast<int>(reference::is_map2_target(target) ? target - GL_MAP2_COLOR_4
                                                                        : target - GL_MAP1_COLOR_4);
    const Names flags = kind == 0 || kind == 2 ? Names{"normalized-reading"} : Names{};
    const auto add = [&](Theme& theme, const auto& values) {
      const Type type = kTypes[theme.count() % 2];
      // The map has as many points as there are values.
      Map map{target, {static_cast<int>(std::size(values)), 0, 1}, {}, {}};
      map.u.first = rounded(values[0], type);
      map.u.last = rounded(values[1], type);
      for (int i = 0; i < map.u.order * k_of(target); ++i)
        map.points.push_back(rounded(values[static_cast<std::size_t>(i) % std::size(values)], type));
      gl::Case c;
      define(c, type, map);
      ask(c, 2, map, GL_COEFF);
      ask(c, 2, map, GL_DOMAIN);
      theme.add(sequence(c), {}, flags);
    };
    add(rounding, kBetween);
    add(halves, kHalves);
    add(saturating, kBeyond);
  }
}

void strides(Document& document) {
  Theme theme(document, "stride", "points with padding between them, which does not come back",
              {"EV-MAP1-STRIDE", "EV-MAP1-PADDING", "EV-GETMAP-COEFF1"});
  for (const GLenum target : gl::kMap1Targets)
    for (const int more : {0, 1, 13}) {
      const int k = k_of(target), stride = k + more;
      const Type type = kTypes[theme.count() % 2];
      gl::Case c;
      map1(c, type, target, 0, 1, stride, 3, numbered(2 * stride + k));
      query_all(c, target, 3 * k);
      theme.add(sequence(c));
    }

  Theme layouts(
      document, "layout",
      "nets in rows of u, in rows of v, with padding, overlapping: the answer is in rows of v, packed",
      {"EV-MAP2-ADDRESS", "EV-MAP2-STRIDE-FREE", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-UNITS",
       "EV-GETMAP-COEFF2"});
  for (const GLenum target : gl::kMap2Targets)
    for (const auto& [uorder, vorder] : {std::pair(2, 3), std::pair(3, 2), std::pair(3, 3)}) {
      const int k = k_of(target);
      const std::pair<int, int> kStrides[] = {
          {k * vorder, k}, {k, k * uorder}, {k * vorder + 2, k}, {k + 1, (k + 1) * uorder}, {k, k}};
      for (std::size_t i = 0; i < 5; i += uorder == vorder ? 1 : 2) {
        const auto [ustride, vstride] = kStrides[i];
        const Type type = kTypes[layouts.count() % 2];
        gl::Case c;
        map2(c, type, target, 0, 1, ustride, uorder, 0, 1, vstride, vorder,
             numbered((uorder - 1) * ustride + (vorder - 1) * vstride + k));
        query_all(c, target, uorder * vorder * k);
        layouts.add(sequence(c), uorder == vorder ? Names{"EV-GETMAP-COEFF2-SQUARE"} : Names{});
      }
    }
}

void histories(Document& document) {
  Theme redefined(document, "redefined", "a map defined again, with a lower and a higher order",
                  {"EV-MAP1-REPLACE", "EV-MAP2-REPLACE"});
  for (const GLenum target : gl::all_targets()) {
    gl::Case c;
    int first = 1;
    for (const int order : {3, 1, 5}) {
      Map map{target, {order, 0.5, first + 1.0}, {}, {}};
      if (reference::is_map2_target(target)) map.v = {6 - order, -1, 2.0 * first};
      map.points = numbered(map.u.order * map.v.order * k_of(target), 10 * first++);
      define(c, kTypes[order / 2 % 2], map);
      query_all(c, target, static_cast<int>(map.points.size()));
    }
    redefined.add(sequence(c));
  }

  Theme separate(
      document, "separate", "all maps defined differently, then all queried",
      {"EV-MAP1-INDEP", "EV-MAP1-VS-MAP2", "EV-GETMAP-NOSIDE", "EV-MAP1-NOENABLE", "EV-MAP2-NOENABLE"});
  for (const bool backwards : {false, true}) {
    std::vector<GLenum> targets = gl::all_targets();
    if (backwards) std::reverse(targets.begin(), targets.end());
    gl::Case c;
    for (const GLenum target : targets) {
      const int first = static_cast<int>(target % 100);
      define(c, Type::kSingle, {target, {2, 0, first + 1.0}, {}, numbered(2 * k_of(target), first)});
    }
    for (const GLenum target : gl::all_targets()) {
      query_all(c, target, 2 * k_of(target));
      c.IsEnabled(target);
    }
    separate.add(sequence(c));
  }

  Theme unit(document, "other-unit", "queries while another texture unit is active", {"EV-GETMAP-NOUNIT"});
  Theme list(document, "in-list", "maps defined by a display list; queries are never put into one",
             {"EV-DL-GETMAP", "EV-DL-POINTS-COPIED", "EV-DL-DOUBLE"});
  for (const GLenum target : gl::all_targets()) {
    const Map map{target, {2, 3, 4}, {}, numbered(2 * k_of(target))};
    gl::Case c;
    define(c, Type::kSingle, map);
    c.ActiveTexture(GL_TEXTURE1);
    query_all(c, target, 2 * k_of(target));
    unit.add(sequence(c));

    gl::Case d;
    d.NewList(5, GL_COMPILE);
    define(d, kTypes[list.count() % 2], map);
    query_all(d, target, k_of(target));
    d.EndList();
    query_all(d, target, k_of(target));
    d.CallList(5);
    query_all(d, target, 2 * k_of(target));
    list.add(sequence(d));
  }
}

void compiled_strides(Document& document) {
  Theme theme(document, "list-stride", "maps with padding between their points, defined by a display list",
              {"EV-DL-STRIDE-KEPT", "EV-DL-POINTS-COPIED"});
  for (const GLenum target : gl::all_targets())
    for (const GLenum mode : {GL_COMPILE, GL_COMPILE_AND_EXECUTE}) {
      const int k = k_of(target);
      const Type type = kTypes[theme.count() / 2 % 2];
      gl::Case c;
      c.NewList(7, mode);
      if (reference::is_map2_target(target))
        map2(c, type, target, 0, 1, k + 1, 2, 0, 1, 2 * k + 5, 3, numbered(k + 1 + 2 * (2 * k + 5) + k));
      else
        map1(c, type, target, 0, 1, k + 2, 3, numbered(2 * (k + 2) + k));
      c.EndList();
      query_all(c, target, (reference::is_map2_target(target) ? 6 : 3) * k);
      c.CallList(7);
      query_all(c, target, (reference::is_map2_target(target) ? 6 : 3) * k);
      theme.add(sequence(c));
    }
}

void high_orders(Document& document) {
  document.explain("order-above-8", "where MAX_EVAL_ORDER is at least the order of each map");
  Theme theme(document, "high-order", "orders from 9 to 64 are accepted and come back",
              {"EV-MAP1-ORDER-ALL", "EV-MAP2-ORDER-ALL", "EV-GETMAP-COUNT"});
  constexpr std::pair<int, int> kOrders[] = {{9, 1}, {16, 9}, {30, 2}, {31, 3}, {33, 1}, {64, 2}};
  for (const GLenum target : gl::all_targets())
    for (std::size_t i = 0; i < 6; ++i) {
      const auto [larger, smaller] = kOrders[i];
      const bool along_v = reference::is_map2_target(target) && i % 2 == 1;
      Map map{target, {along_v ? smaller : larger, 0, 1}, {}, {}};
      if (reference::is_map2_target(target)) map.v.order = along_v ? larger : smaller;
      map.points = numbered(map.u.order * map.v.order * k_of(target));
      gl::Case c;
      define(c, kTypes[theme.count() % 2], map);
      ask(c, 2, map, GL_ORDER);
      ask(c, static_cast<int>(i % 2), map, GL_COEFF);
      theme.add(sequence(c), {}, {"order-above-8"});
    }
}

}  // namespace

Document get_map() {
  Document document("get_map", "What GetMap answers: orders, domains, control points.");
  initial(document);
  defined(document);
  reals(document);
  integers(document);
  strides(document);
  histories(document);
  compiled_strides(document);
  high_orders(document);
  return document;
}

}  // namespace evalcts::vectors
