// Section 5 of the requirements for Map2: each condition raises its error once and changes nothing, in
// particular not just one of the two directions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suites/refusal.h"

namespace evalcts::suite_map2_errors {
namespace {

// A legal map, to be spoiled by the test. Memory for much more than it needs stands behind it, so that a
// library which checks late reads nothing that it must not.
Map2 legal_map(GLenum target) {
  Map2 map;
  map.target = target;
  map.ustride = 12, map.vstride = 4;
  map.uorder = 2, map.vorder = 3;
  map.points.assign(4096, 0.5);
  return map;
}

// One of the two directions of a map: where its parameters lie.
struct Direction {
  int Map2::*order;
  int Map2::*stride;
  double Map2::*first;
  double Map2::*last;
};
constexpr Direction kU = {&Map2::uorder, &Map2::ustride, &Map2::u1, &Map2::u2};
constexpr Direction kV = {&Map2::vorder, &Map2::vstride, &Map2::v1, &Map2::v2};

Calls defining(const Map2& map, bool doubles) {
  return [map, doubles](gl::Case& c) { define(c, map, doubles); };
}

void expect_refused_orders(Test& t, const TargetForm& form, const Direction& direction) {
  std::vector<Calls> too_low;
  for (const int order : {0, -1, -64, kLowest}) {
    Map2 map = legal_map(form.target);
    map.*direction.order = order;
    too_low.push_back(defining(map, form.doubles));
  }
  expect_refused(t, "orders 0, -1, -64, the lowest int", too_low, {GL_INVALID_VALUE});

  std::vector<Calls> too_high;
  for (const int order : orders_too_high(t)) {
    Map2 map = legal_map(form.target);
    (direction.order == kU.order ? map.vorder : map.uorder) = 1;
    map.*direction.order = order;
    map.*direction.stride = 4;
    map.points.assign(static_cast<std::size_t>(order) * 4 + 64, 0.5);
    too_high.push_back(defining(map, form.doubles));
  }
  expect_refused(t, "orders MAX+1, MAX+2, MAX+100, 0x101, 0x10001", too_high, {GL_INVALID_VALUE});
}

void expect_refused_strides(Test& t, const TargetForm& form, const Direction& direction) {
  // Also where the order in this direction is 1 and the stride never used. Negative strides come only so:
  // with more points they would lead before the array.
  std::vector<Calls> bad;
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1, -17, kLowest})
    for (const auto& [order, other] : {std::pair{3, 2}, {1, 2}, {1, 1}}) {
      if (stride < 0 && order > 1) continue;
      Map2 map = legal_map(form.target);
      map.uorder = map.vorder = other;
      map.*direction.order = order;
      map.*direction.stride = stride;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "strides k-1, 0, -1, -17, the lowest int", bad, {GL_INVALID_VALUE});
}

void expect_refused_domains(Test& t, const TargetForm& form, const Direction& direction) {
  std::vector<Calls> bad;
  for (const int order : {1, 2, 3})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      Map2 map = legal_map(form.target);
      map.uorder = map.vorder = order;
      map.*direction.first = map.*direction.last = end;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "both ends 0, 1, -2.5, 1e6; orders 1x1, 2x2 and 3x3", bad, {GL_INVALID_VALUE});
}

}  // namespace

EVALCTS_LISTED_TESTS(Map2Errors, BadTarget, kForms, const Form& form, must, "EV-MAP2-ERR-TARGET",
                     "EV-MAP2-ERR-NOEFFECT") {
  std::vector<GLenum> bad = {0, 0x0DAF, 0x0DB9, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF, 0xFFFFFFFFu};
  bad.insert(bad.end(), gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  for (const GLenum target : bad)
    expect_refused(t, gl::token_name(target), {defining(legal_map(target), form.doubles)}, {GL_INVALID_ENUM});
}

// Whatever part of the number is looked at.
EVALCTS_TESTS(Map2Errors, BadTargetOfSimilarNumber, kForms, const Form& form, must, "EV-MAP2-ERR-TARGET",
              "EV-MAP2-ERR-NOEFFECT") {
  for (const GLenum target : {0x0DA0u, 0x0DBFu, 0x0DC0u, 0x10DB0u, 0x10DB8u, 0x80000DB7u})
    expect_refused(t, gl::token_name(target), {defining(legal_map(target), form.doubles)}, {GL_INVALID_ENUM});
}

EVALCTS_LISTED_TESTS(Map2Errors, UOrder, target_forms2(), const TargetForm& form, must, "EV-MAP2-ERR-UORDER",
                     "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_orders(t, form, kU);
}

EVALCTS_LISTED_TESTS(Map2Errors, VOrder, target_forms2(), const TargetForm& form, must, "EV-MAP2-ERR-VORDER",
                     "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_orders(t, form, kV);
}

EVALCTS_LISTED_TESTS(Map2Errors, UStride, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_strides(t, form, kU);
}

EVALCTS_LISTED_TESTS(Map2Errors, VStride, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-VSTRIDE", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_strides(t, form, kV);
}

// k - 1 is too little whatever the orders are.
EVALCTS_TESTS(Map2Errors, StridesAtManyOrders, target_forms2(), const TargetForm& form, must,
              "EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-VSTRIDE") {
  std::vector<Calls> bad;
  for (const Direction& direction : {kU, kV})
    for (const auto& [uorder, vorder] :
         {std::pair{2, 2}, {1, 8}, {8, 1}, {4, 5}, {8, 8}, {t.max_order(), 2}}) {
      Map2 map = legal_map(form.target);
      map.uorder = uorder;
      map.vorder = vorder;
      map.*direction.stride = gl::components_of(form.target) - 1;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "orders 2x2, 1x8, 8x1, 4x5, 8x8, MAXx2", bad, {GL_INVALID_VALUE});
}

EVALCTS_LISTED_TESTS(Map2Errors, UDomain, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-UDOMAIN", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_domains(t, form, kU);
}

EVALCTS_LISTED_TESTS(Map2Errors, VDomain, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-VDOMAIN", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_domains(t, form, kV);
}

// +0 and -0 are equal, which the text does not say in so many words (U-ZERO-SIGN).
EVALCTS_LISTED_TESTS(Map2Errors, ZeroOfEitherSign, kForms, const Form& form, quality, "EV-MAP2-ERR-UDOMAIN",
                     "EV-MAP2-ERR-VDOMAIN") {
  for (const Direction& direction : {kU, kV}) {
    Map2 map = legal_map(GL_MAP2_VERTEX_3);
    map.*direction.first = 0.0;
    map.*direction.last = -0.0;
    expect_refused(t, direction.order == kU.order ? "u1 = +0 u2 = -0" : "v1 = +0 v2 = -0",
                   {defining(map, form.doubles)}, {GL_INVALID_VALUE});
  }
}

namespace {

void expect_refused_in(Test& t, const TargetForm& form, const std::string& identity,
                       const std::vector<GLenum>& modes) {
  std::vector<Calls> bad;
  for (const GLenum mode : modes)
    for (const bool after_vertex : {false, true})
      bad.push_back([&form, mode, after_vertex](gl::Case& c) {
        c.Begin(mode);
        if (after_vertex) c.Vertex3f(1, 2, 3);
        define(c, legal_map(form.target), form.doubles);
        c.End();
      });
  expect_refused(t, identity, bad, {GL_INVALID_OPERATION});
}

}  // namespace

EVALCTS_LISTED_TESTS(Map2Errors, BetweenBeginAndEnd, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_in(t, form, "in POINTS, TRIANGLES, QUAD_STRIP, POLYGON; first and after Vertex",
                    {GL_POINTS, GL_TRIANGLES, GL_QUAD_STRIP, GL_POLYGON});
}
EVALCTS_TESTS(Map2Errors, BetweenBeginAndEndElsewhere, target_forms2(), const TargetForm& form, must,
              "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT") {
  expect_refused_in(t, form, "in the other primitives; first and after Vertex",
                    {GL_LINES, GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS});
}

// The primitive goes on as if the refused command had not been there.
EVALCTS_LISTED_TESTS(Map2Errors, PrimitiveUndisturbed, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT", "EV-BE-IGNORED/2-D") {
  gl::Case c("EvalCoord2, Map2, EvalCoord2, Vertex");
  define(c, make_map2(GL_MAP2_VERTEX_3, 2, 2, {1, 2, 3, 4, 5, 6, -7, 8, -9, 2.5, 0.25, -1}));
  c.Enable(GL_MAP2_VERTEX_3);
  c.Begin(GL_LINE_STRIP);  // of points nobody could tell whether they are of one primitive
  evaluate2(c, 0.25, 0.75);
  define(c, legal_map(form.target), form.doubles);
  evaluate2(c, 0.75, 0.5);
  c.Vertex3f(1, 2, 3);
  c.End();
  t.expect_emission(c, kPosition);
}

// What is evaluated after a refused call of each kind is what the last legal call defined.
EVALCTS_LISTED_TESTS(Map2Errors, EvaluatesAsBefore, visible_target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-NOEFFECT") {
  gl::Case c("refused for orders, strides, domains, target, Begin/End, evaluated after each");
  define(c, random_map2(t, form.target, 3, 4));
  enable_visibly(c, form.target);
  const auto evaluate_after = [&](const Map2& bad) {
    define(c, bad, form.doubles);
    c.GetError();
    c.Begin(GL_POINTS);
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.3125, 0.75}, {1.0, 1.0}})
      evaluate2(c, u, v, form.doubles);
    c.End();
  };
  for (const Direction& direction : {kU, kV}) {
    Map2 bad = legal_map(form.target);
    bad.*direction.order = 0;
    evaluate_after(bad);
    bad = legal_map(form.target);
    bad.*direction.stride = 0;
    evaluate_after(bad);
    bad = legal_map(form.target);
    bad.*direction.last = bad.*direction.first;
    evaluate_after(bad);
  }
  Map2 bad = legal_map(form.target);
  bad.target = form.target - gl::kMap2Targets[0] + gl::kMap1Targets[0];  // the MAP1 namesake
  evaluate_after(bad);
  c.Begin(GL_POINTS);
  define(c, legal_map(form.target), form.doubles);
  c.End();
  c.GetError();
  c.Begin(GL_POINTS);
  evaluate2(c, 0.6875, 0.125, form.doubles);
  c.End();
  t.expect_emission(c, attribute_of(form.target));
}

EVALCTS_LISTED_TESTS(Map2Errors, ActiveTexture, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-ACTIVETEX", "EV-MAP2-ERR-NOEFFECT", "EV-EXT-MT-RULE/2-D") {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  std::vector<GLenum> units = {GL_TEXTURE1};
  if (t.gl().texture_units > 2) units.push_back(GL_TEXTURE0 + static_cast<GLenum>(t.gl().texture_units) - 1);
  std::vector<Calls> bad;
  for (const GLenum unit : units)
    bad.push_back([&form, unit](gl::Case& c) {
      c.ActiveTexture(unit);
      define(c, legal_map(form.target), form.doubles);
      c.ActiveTexture(GL_TEXTURE0);  // the queries that follow are of unit 0 again
    });
  expect_refused(t, "TEXTURE1 and the last unit active", bad, {GL_INVALID_OPERATION});

  gl::Case unit("TEXTURE1 stays active");
  unit.ActiveTexture(GL_TEXTURE1);
  define(unit, legal_map(form.target), form.doubles);
  unit.GetError();
  const gl::Ref active = unit.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
  Played still = t.play(unit);
  still.expect_values(active, std::vector<GLint>{GL_TEXTURE1});

  // Back on TEXTURE0 the same call is legal: the rule concerns the unit that is active now.
  gl::Case c("TEXTURE1, then TEXTURE0 active");
  c.ActiveTexture(GL_TEXTURE1);
  c.ActiveTexture(GL_TEXTURE0);
  define(c, legal_map(form.target), form.doubles);
  const gl::Ref error = c.GetError();
  const gl::Ref order = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(2));
  Played played = t.play(c);
  played.expect_no_error(error);
  played.expect_values(order, std::vector<GLint>{2, 3});
}

// ... whatever command made it active.
EVALCTS_LISTED_TESTS(Map2Errors, ActiveTextureOfPopAttrib, kForms, const Form& form, must,
                     "EV-MAP2-ERR-ACTIVETEX") {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_TEXTURE_COORD_2, GL_MAP2_INDEX}) {
    gl::Case c(label(target));
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE1);
    c.PopAttrib();
    define(c, legal_map(target), form.doubles);
    const gl::Ref none = c.GetError();
    const gl::Ref defined = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2));
    c.ActiveTexture(GL_TEXTURE1);
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE0);
    c.PopAttrib();
    Map2 refused = legal_map(target);
    refused.uorder = 5;
    define(c, refused, form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref kept = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2));
    Played played = t.play(c);
    played.expect_no_error(none);
    played.expect_error(error, {GL_INVALID_OPERATION});
    for (const gl::Ref order : {defined, kept}) played.expect_values(order, std::vector<GLint>{2, 3});
  }
}

// Several conditions at once: one of the matching errors, whichever.
EVALCTS_LISTED_TESTS(Map2Errors, SeveralAtOnce, kForms, const Form& form, must, "EV-MAP-ERR-ANY/2-D",
                     "EV-MAP2-ERR-NOEFFECT") {
  const auto spoiled = [&](const std::function<void(Map2&)>& spoil) {
    Map2 map = legal_map(GL_MAP2_VERTEX_4);
    spoil(map);
    return defining(map, form.doubles);
  };
  expect_refused(t, "target and order, stride or domain",
                 {spoiled([](Map2& m) { m.target = GL_MAP1_VERTEX_4, m.uorder = 0; }),
                  spoiled([](Map2& m) { m.target = GL_MAP1_VERTEX_4, m.vorder = -1; }),
                  spoiled([](Map2& m) { m.target = GL_TEXTURE_2D, m.ustride = 0; }),
                  spoiled([](Map2& m) { m.target = 0, m.vstride = 0; }),
                  spoiled([](Map2& m) { m.target = 0x0DB9, m.u2 = m.u1; }),
                  spoiled([](Map2& m) { m.target = GL_AUTO_NORMAL, m.v2 = m.v1; })},
                 {GL_INVALID_ENUM, GL_INVALID_VALUE});
  const int too_high = orders_too_high(t).front();
  expect_refused(t, "both directions, several values",
                 {spoiled([](Map2& m) { m.uorder = 0, m.vorder = 0; }),
                  spoiled([](Map2& m) { m.ustride = 0, m.vstride = 3; }),
                  spoiled([](Map2& m) { m.u2 = m.u1, m.v2 = m.v1; }),
                  spoiled([](Map2& m) { m.uorder = -1, m.vstride = 1; }),
                  spoiled([](Map2& m) { m.ustride = 1, m.v2 = m.v1; }),
                  spoiled([&](Map2& m) { m.uorder = 1, m.vorder = too_high, m.u2 = m.u1; }),
                  spoiled([&](Map2& m) { m.uorder = too_high, m.vorder = 1, m.ustride = 1, m.v2 = m.v1; })},
                 {GL_INVALID_VALUE});
  expect_refused(t, "target or order, between Begin and End", {[&](gl::Case& c) {
                   c.Begin(GL_LINES);
                   spoiled([](Map2& m) { m.target = GL_MAP1_VERTEX_4; })(c);
                   c.End();
                 }},
                 {GL_INVALID_ENUM, GL_INVALID_OPERATION});
  expect_refused(t, "order, between Begin and End", {[&](gl::Case& c) {
                   c.Begin(GL_LINES);
                   spoiled([](Map2& m) { m.vorder = 0; })(c);
                   c.End();
                 }},
                 {GL_INVALID_VALUE, GL_INVALID_OPERATION});
}

// An error reported once is gone, and the next legal call works.
EVALCTS_LISTED_TESTS(Map2Errors, LegalCallAfterwards, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ERR-NOEFFECT") {
  gl::Case c("refused for orders, strides and domains, then legal");
  for (const Direction& direction : {kU, kV}) {
    Map2 bad = legal_map(form.target);
    bad.*direction.order = 0;
    define(c, bad, form.doubles);
    bad = legal_map(form.target);
    bad.*direction.stride = 0;
    define(c, bad, form.doubles);
    bad = legal_map(form.target);
    bad.*direction.last = bad.*direction.first;
    define(c, bad, form.doubles);
  }
  Map2 map = random_map2(t, form.target, 3, 2, 16, 5);
  map.u1 = -4, map.u2 = 4, map.v1 = 9, map.v2 = 8;
  define(c, map, form.doubles);
  const gl::Ref first = c.GetError();  // not cleared by the legal call
  const gl::Ref second = c.GetError();
  const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
  Played played = t.play(c);
  played.expect_error(first, {GL_INVALID_VALUE});
  // Distributed implementations may keep several flags (GL 2.1 §2.5).
  played.expect_error(second, {GL_NO_ERROR, GL_INVALID_VALUE});
  expect_map(played, query, map, form.doubles);
}

// What is no error: EV-MAP-NOERR-OTHER names the conditions.
EVALCTS_LISTED_TESTS(Map2Errors, NoOtherCondition, target_forms2(), const TargetForm& form, must,
                     "EV-MAP-NOERR-OTHER/2-D") {
  gl::Case c(
      "large strides, reversed, negative, large and narrow domains, repeated points, negative zeros, "
      "subnormals");
  std::vector<std::pair<gl::Ref, gl::Ref>> answers;
  std::vector<std::vector<GLint>> orders;
  const auto expect_accepted = [&](const std::function<void(Map2&)>& change) {
    // Other orders each time, so that the query tells a silently ignored call.
    Map2 map = legal_map(form.target);
    map.uorder = 2 + static_cast<int>(answers.size()) % 2;
    change(map);
    define(c, map, form.doubles);
    const gl::Ref error = c.GetError();
    answers.emplace_back(error, c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(2)));
    orders.push_back({map.uorder, map.vorder});
  };
  expect_accepted([](Map2& m) { m.ustride = 1000; });
  expect_accepted([](Map2& m) { m.vstride = 1000; });
  expect_accepted([](Map2& m) { m.ustride = 900, m.vstride = 1000; });
  expect_accepted([](Map2& m) { m.uorder = m.vorder = 1, m.ustride = 4000, m.vstride = 4090; });
  // Order 1: the stride is never used, however large (U-STRIDE-HUGE).
  expect_accepted([](Map2& m) { m.uorder = 1, m.ustride = std::numeric_limits<int>::max(); });
  expect_accepted([](Map2& m) { m.vorder = 1, m.vstride = std::numeric_limits<int>::max(); });
  expect_accepted([](Map2& m) { m.u1 = 1, m.u2 = 0; });
  expect_accepted([](Map2& m) { m.v1 = 1, m.v2 = 0; });
  expect_accepted([](Map2& m) { m.u1 = m.v1 = 7, m.u2 = m.v2 = -2; });
  // The two domains may be equal, and touch.
  expect_accepted([](Map2& m) { m.u1 = 0, m.u2 = 1, m.v1 = 1, m.v2 = 0; });
  expect_accepted([](Map2& m) { m.u1 = -1e6, m.u2 = -1e5, m.v1 = -3, m.v2 = -2; });
  expect_accepted([](Map2& m) { m.u1 = -0x1p31, m.u2 = 0x1p31, m.v1 = 0x1p31, m.v2 = -0x1p31; });
  expect_accepted([](Map2& m) { m.u1 = std::nextafterf(1.0f, 2.0f), m.u2 = 1; });
  expect_accepted([](Map2& m) { m.v1 = 1, m.v2 = std::nextafterf(1.0f, 2.0f); });
  expect_accepted([](Map2&) {});  // all points the same
  expect_accepted([](Map2& m) {
    for (std::size_t i = 0; i < m.points.size(); ++i) m.points[i] = i % 2 ? -0.0 : std::ldexp(1.0, -140);
  });
  Played played = t.play(c);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    played.expect_no_error(answers[i].first);
    played.expect_values(answers[i].second, orders[i]);
  }
}

}  // namespace evalcts::suite_map2_errors
