// Section 5 of the requirements: each condition on Map1 and Map2 raises its error once and changes nothing,
// in particular not just one of the two directions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include <evalcts/testkit/registration.h>

#include "refusal.h"

namespace evalcts::suite_map_errors {
namespace {

// --- Rules of both dimensions ----------------------------------------------------------------------------

// `legal` is a target of the right dimension.
template <class Map>
void expect_targets_refused(Test& t, bool doubles, GLenum legal, std::span<const GLenum> targets) {
  for (const GLenum target : targets) {
    Map map = legal_map<Map>(legal);
    map.target = target;
    expect_refused(t, gl::token_name(target), map, doubles, {GL_INVALID_ENUM});
  }
}

// Calls `call` with maps that are illegal in each way but the target, direction by direction.
template <class Map, class Call>
void for_each_illegal(GLenum target, const Call& call) {
  for (const Direction<Map>& direction : directions<Map>()) {
    Map bad = legal_map<Map>(target);
    bad.*direction.order = 0;
    call(bad);
    bad = legal_map<Map>(target);
    bad.*direction.stride = 0;
    call(bad);
    bad = legal_map<Map>(target);
    bad.*direction.last = bad.*direction.first;
    call(bad);
  }
}

// What is evaluated after a rejected call of each kind is what the last legal call defined. `evaluate` and,
// after the last of them, `evaluate_last` draw points; `namesake` is the target of the other dimension.
template <class Map>
void expect_evaluates_as_before(Test& t, const TargetForm& form, const std::string& identity, const Map& map,
                                GLenum namesake, const Calls& evaluate, const Calls& evaluate_last) {
  gl::Case c(identity);
  define(c, map);
  enable_visibly(c, form.target);
  const auto draw = [&](const Calls& points) {
    c.GetError();
    c.Begin(GL_POINTS);
    points(c);
    c.End();
  };
  const auto evaluate_after = [&](const Map& bad) {
    define(c, bad, form.doubles);
    draw(evaluate);
  };
  for_each_illegal<Map>(form.target, evaluate_after);
  Map bad = legal_map<Map>(form.target);
  bad.target = namesake;
  evaluate_after(bad);
  c.Begin(GL_POINTS);
  define(c, legal_map<Map>(form.target), form.doubles);
  c.End();
  draw(evaluate_last);
  t.expect_emission(c, attribute_of(form.target));
}

// An error reported once is gone, and the next legal call works.
template <class Map>
void expect_legal_call_afterwards(Test& t, const TargetForm& form, const std::string& identity,
                                  const Map& map) {
  gl::Case c(identity);
  for_each_illegal<Map>(form.target, [&](const Map& bad) { define(c, bad, form.doubles); });
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

}  // namespace

// --- One-dimensional maps --------------------------------------------------------------------------------

EVALCTS_TEST(Map1Errors, BadTarget, must, "EV-MAP1-ERR-TARGET", "EV-MAP1-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  std::vector<GLenum> bad = {0, 0x0D8F, 0x0D99, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF, 0xFFFFFFFFu};
  bad.insert(bad.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  expect_targets_refused<Map1>(t, form.doubles, GL_MAP1_VERTEX_4, bad);
};

// Whatever part of the number is looked at. (Apart from the test above: those who lose the error in display
// lists fail it in other cases then.)
EVALCTS_TEST(Map1Errors, BadTargetOfSimilarNumber, must, "EV-MAP1-ERR-TARGET", "EV-MAP1-ERR-NOEFFECT",
             combine(kForms))
(Test& t, const Form& form) {
  constexpr GLenum kBad[] = {0x0D9Au, 0x0D9Fu, 0x0DA0u, 0x10D90u, 0x10D98u, 0x80000D97u};
  expect_targets_refused<Map1>(t, form.doubles, GL_MAP1_VERTEX_4, kBad);
};

EVALCTS_TEST(Map1Errors, OrderTooLow, must, "EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const int order : {0, -1, -64, kLowest}) {
    Map1 map = legal_map<Map1>(form.target);
    map.order = order;
    expect_refused(t, fmt::format("order {}", order), map, form.doubles, {GL_INVALID_VALUE});
  }
};

EVALCTS_TEST(Map1Errors, OrderTooHigh, must, "EV-MAP1-ERR-ORDER-HIGH", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const int limit = t.gl().max_eval_order;
  for (const int order : orders_too_high(t)) {
    Map1 map = legal_map<Map1>(form.target);
    map.order = order;
    map.points.assign(static_cast<std::size_t>(order) * static_cast<std::size_t>(map.stride), 0.5);
    expect_refused(
        t, order < 0x101 ? fmt::format("order MAX+{}", order - limit) : fmt::format("order {}", order), map,
        form.doubles, {GL_INVALID_VALUE});
  }
};

EVALCTS_TEST(Map1Errors, StrideBelowK, must, "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1, -17, kLowest}) {
    Map1 map = legal_map<Map1>(form.target);
    map.stride = stride;
    expect_refused(t, fmt::format("stride {}", stride), map, form.doubles, {GL_INVALID_VALUE});
  }
};

EVALCTS_TEST(Map1Errors, StrideBelowKAtEveryOrder, must, "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()))
(Test& t, const TargetForm& form) {
  gl::Case c("stride k - 1, orders 1 to MAX");
  prepare(c, Prepared::maps1, false);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  std::vector<gl::Ref> errors;
  for (int order = 1; order <= t.max_order(); ++order) {
    Map1 map = legal_map<Map1>(form.target);
    map.order = order;
    map.stride = gl::components_of(form.target) - 1;
    define(c, map, form.doubles);
    errors.push_back(c.GetError());
  }
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_error(error, {GL_INVALID_VALUE});
  expect_unchanged(played, before, after);
};

EVALCTS_TEST(Map1Errors, StrideBelowKAtOrder1, must, "EV-MAP1-ERR-STRIDE-ORDER1", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1}) {
    Map1 map = legal_map<Map1>(form.target);
    map.order = 1;
    map.stride = stride;
    expect_refused(t, fmt::format("order 1 stride {}", stride), map, form.doubles, {GL_INVALID_VALUE});
  }
};

EVALCTS_TEST(Map1Errors, EqualDomainEnds, must, "EV-MAP1-ERR-DOMAIN", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const int order : {1, 3, 2, 8})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      if ((order == 2 || order == 8) && end != 1) continue;
      Map1 map = legal_map<Map1>(form.target);
      map.order = order;
      map.u1 = map.u2 = end;
      expect_refused(t, fmt::format("u1 = u2 = {}, order {}", end, order), map, form.doubles,
                     {GL_INVALID_VALUE});
    }
};

// +0 and -0 are equal, which the text does not say in so many words (U-ZERO-SIGN).
EVALCTS_TEST(Map1Errors, ZeroOfEitherSign, quality, "EV-MAP1-ERR-DOMAIN",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  Map1 map = legal_map<Map1>(GL_MAP1_VERTEX_3);
  map.u1 = 0.0;
  map.u2 = -0.0;
  expect_refused(t, "u1 = +0 u2 = -0", map, form.doubles, {GL_INVALID_VALUE});
};

EVALCTS_TEST(Map1Errors, BetweenBeginAndEnd, must, "EV-MAP1-ERR-BEGINEND", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    for (const char* after : {"nothing", "Vertex"}) {
      if ((mode % 2 == 0) == (after[0] == 'V') && mode != GL_TRIANGLES) continue;
      expect_refused<Map1>(t, fmt::format("{} after {}", gl::primitive_name(mode), after),
                           [&](gl::Case& c) {
                             c.Begin(mode);
                             if (after[0] == 'V') c.Vertex3f(1, 2, 3);
                             define(c, legal_map<Map1>(form.target), form.doubles);
                             c.End();
                           },
                           {GL_INVALID_OPERATION});
    }
};

// The primitive goes on as if the refused command had not been there.
EVALCTS_TEST(Map1Errors, PrimitiveUndisturbed, must, "EV-MAP1-ERR-BEGINEND", "EV-MAP1-ERR-NOEFFECT",
             "EV-BE-IGNORED/1-D", combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("EvalCoord, Map1, EvalCoord, Vertex");
  define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6, -7, 8, -9}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_LINE_STRIP);  // of points nobody could tell whether they are of one primitive
  c.EvalCoord1f(0.25f);
  define(c, legal_map<Map1>(form.target), form.doubles);
  c.EvalCoord1f(0.75f);
  c.Vertex3f(1, 2, 3);
  c.End();
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(Map1Errors, EvaluatesAsBefore, must, "EV-MAP1-ERR-NOEFFECT",
             combine(visible_target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const auto evaluate_three = [&](gl::Case& c) {
    for (const double u : {0.0, 0.3125, 1.0}) evaluate(c, u, form.doubles);
  };
  expect_evaluates_as_before(
      t, form, "refused for order, stride, domain, target, Begin/End, evaluated after each",
      random_map(t, form.target, 4), form.target + 0x20, evaluate_three, evaluate_three);
};

// Several conditions at once: one of the matching errors, whichever.
EVALCTS_TEST(Map1Errors, SeveralAtOnce, must, "EV-MAP-ERR-ANY/1-D", "EV-MAP1-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  const auto spoiled = [](GLenum target, int order, int stride, double u2) {
    Map1 map = legal_map<Map1>(GL_MAP1_VERTEX_4);
    map.target = target;
    map.order = order;
    map.stride = stride;
    map.u2 = u2;
    return map;
  };
  expect_refused(t, "target and order", spoiled(GL_MAP2_VERTEX_4, 0, 4, 1), form.doubles,
                 {GL_INVALID_ENUM, GL_INVALID_VALUE});
  expect_refused(t, "target and stride", spoiled(GL_TEXTURE_2D, 3, 0, 1), form.doubles,
                 {GL_INVALID_ENUM, GL_INVALID_VALUE});
  expect_refused(t, "target and domain", spoiled(0, 3, 4, 0), form.doubles,
                 {GL_INVALID_ENUM, GL_INVALID_VALUE});
  expect_refused(t, "order, stride and domain", spoiled(GL_MAP1_VERTEX_4, -1, 1, 0), form.doubles,
                 {GL_INVALID_VALUE});
  expect_refused(t, "order too high and stride", spoiled(GL_MAP1_VERTEX_4, orders_too_high(t).front(), 1, 1),
                 form.doubles, {GL_INVALID_VALUE});
  expect_refused<Map1>(t, "target, between Begin and End",
                       [&](gl::Case& c) {
                         c.Begin(GL_LINES);
                         define(c, spoiled(GL_MAP2_VERTEX_4, 3, 4, 1), form.doubles);
                         c.End();
                       },
                       {GL_INVALID_ENUM, GL_INVALID_OPERATION});
};

// An error that nobody has asked for changes nothing about the calls that follow.
EVALCTS_TEST(Map1Errors, RefusedWhileAnErrorWaits, must, "EV-MAP1-ERR-NOEFFECT", combine(target_forms()))
(Test& t, const TargetForm& form) {
  gl::Case c("refused for order, stride, domain, target and once more order");
  prepare(c, Prepared::maps1, true);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  const auto refused = [&](const std::function<void(Map1&)>& spoil) {
    Map1 bad = legal_map<Map1>(form.target);
    spoil(bad);
    define(c, bad, form.doubles);
  };
  refused([](Map1& m) { m.order = 0; });
  refused([](Map1& m) { m.stride = gl::components_of(m.target) - 1; });
  refused([](Map1& m) { m.u2 = m.u1; });
  refused([](Map1& m) { m.target = GL_TEXTURE_2D; });
  refused([](Map1& m) { m.order = 0; });
  const gl::Ref error = c.GetError();
  // Distributed implementations may keep several flags (GL 2.1 §2.5).
  for (int i = 0; i < 4; ++i) c.GetError();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_VALUE, GL_INVALID_ENUM});
  expect_unchanged(played, before, after);
};

EVALCTS_TEST(Map1Errors, LegalCallAfterwards, must, "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  std::vector<double> coefficients;
  for (int i = 0; i < 2 * gl::components_of(form.target); ++i) coefficients.push_back(i - 1.5);
  expect_legal_call_afterwards(t, form, "refused for order, stride and domain, then legal",
                               make_map1(form.target, -4, 4, 6, coefficients));
};

// What is no error: EV-MAP-NOERR-OTHER names the conditions.
EVALCTS_TEST(Map1Errors, NoOtherCondition, must, "EV-MAP-NOERR-OTHER/1-D",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const auto expect_accepted = [&](const std::string& identity, const std::function<void(Map1&)>& change) {
    Map1 map = legal_map<Map1>(form.target);
    change(map);
    gl::Case c(identity);
    define(c, map, form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref order = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
    Played played = t.play(c);
    played.expect_no_error(error);
    played.expect_values(order, map.orders());
  };
  expect_accepted("stride far larger than needed", [](Map1& m) { m.stride = 1000; });
  expect_accepted("order 1 with a large stride", [](Map1& m) { m.order = 1, m.stride = 4000; });
  expect_accepted("u1 > u2", [](Map1& m) { m.u1 = 1, m.u2 = 0; });
  expect_accepted("u1 > u2, order 1", [](Map1& m) { m.u1 = 1, m.u2 = 0, m.order = 1; });
  expect_accepted("negative domain", [](Map1& m) { m.u1 = -1e6, m.u2 = -1e5; });
  expect_accepted("large domain", [](Map1& m) { m.u1 = -0x1p31, m.u2 = 0x1p31; });
  expect_accepted("domain of one ULP", [](Map1& m) {
    m.u2 = std::nextafterf(0.0f, 1.0f) + 1;
    m.u1 = std::nextafterf(1.0f, 2.0f);
  });
  expect_accepted("repeated points", [](Map1&) {});
  expect_accepted("negative zeros and subnormals", [](Map1& m) {
    for (std::size_t i = 0; i < m.points.size(); ++i) m.points[i] = i % 2 ? -0.0 : std::ldexp(1.0, -140);
  });
};

// --- Two-dimensional maps --------------------------------------------------------------------------------

namespace {

void expect_refused_orders(Test& t, const TargetForm& form, const Direction<Map2>& direction) {
  std::vector<Calls> too_low;
  for (const int order : {0, -1, -64, kLowest}) {
    Map2 map = legal_map<Map2>(form.target);
    map.*direction.order = order;
    too_low.push_back(defining(map, form.doubles));
  }
  expect_refused(t, "orders 0, -1, -64, the lowest int", too_low, {GL_INVALID_VALUE});

  std::vector<Calls> too_high;
  for (const int order : orders_too_high(t)) {
    Map2 map = legal_map<Map2>(form.target);
    (direction.order == kU.order ? map.vorder : map.uorder) = 1;
    map.*direction.order = order;
    map.*direction.stride = 4;
    map.points.assign(static_cast<std::size_t>(order) * 4 + 64, 0.5);
    too_high.push_back(defining(map, form.doubles));
  }
  expect_refused(t, "orders MAX+1, MAX+2, MAX+100, 0x101, 0x10001", too_high, {GL_INVALID_VALUE});
}

void expect_refused_strides(Test& t, const TargetForm& form, const Direction<Map2>& direction) {
  // Also where the order in this direction is 1 and the stride never used. Negative strides come only so:
  // with more points they would lead before the array.
  std::vector<Calls> bad;
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1, -17, kLowest})
    for (const auto& [order, other] : {std::pair{3, 2}, {1, 2}, {1, 1}}) {
      if (stride < 0 && order > 1) continue;
      Map2 map = legal_map<Map2>(form.target);
      map.uorder = map.vorder = other;
      map.*direction.order = order;
      map.*direction.stride = stride;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "strides k-1, 0, -1, -17, the lowest int", bad, {GL_INVALID_VALUE});
}

void expect_refused_domains(Test& t, const TargetForm& form, const Direction<Map2>& direction) {
  std::vector<Calls> bad;
  for (const int order : {1, 2, 3})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      Map2 map = legal_map<Map2>(form.target);
      map.uorder = map.vorder = order;
      map.*direction.first = map.*direction.last = end;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "both ends 0, 1, -2.5, 1e6; orders 1x1, 2x2 and 3x3", bad, {GL_INVALID_VALUE});
}

}  // namespace

EVALCTS_TEST(Map2Errors, BadTarget, must, "EV-MAP2-ERR-TARGET", "EV-MAP2-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  std::vector<GLenum> bad = {0, 0x0DAF, 0x0DB9, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF, 0xFFFFFFFFu};
  bad.insert(bad.end(), gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  expect_targets_refused<Map2>(t, form.doubles, GL_MAP2_VERTEX_4, bad);
};

// Whatever part of the number is looked at.
EVALCTS_TEST(Map2Errors, BadTargetOfSimilarNumber, must, "EV-MAP2-ERR-TARGET", "EV-MAP2-ERR-NOEFFECT",
             combine(kForms))
(Test& t, const Form& form) {
  constexpr GLenum kBad[] = {0x0DA0u, 0x0DBFu, 0x0DC0u, 0x10DB0u, 0x10DB8u, 0x80000DB7u};
  expect_targets_refused<Map2>(t, form.doubles, GL_MAP2_VERTEX_4, kBad);
};

EVALCTS_TEST(Map2Errors, UOrder, must, "EV-MAP2-ERR-UORDER", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_orders(t, form, kU); };

EVALCTS_TEST(Map2Errors, VOrder, must, "EV-MAP2-ERR-VORDER", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_orders(t, form, kV); };

EVALCTS_TEST(Map2Errors, UStride, must, "EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_strides(t, form, kU); };

EVALCTS_TEST(Map2Errors, VStride, must, "EV-MAP2-ERR-VSTRIDE", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_strides(t, form, kV); };

// k - 1 is too little whatever the orders are.
EVALCTS_TEST(Map2Errors, StridesAtManyOrders, must, "EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-VSTRIDE",
             combine(target_forms2()))
(Test& t, const TargetForm& form) {
  std::vector<Calls> bad;
  for (const Direction<Map2>& direction : {kU, kV})
    for (const auto& [uorder, vorder] :
         {std::pair{2, 2}, {1, 8}, {8, 1}, {4, 5}, {8, 8}, {t.max_order(), 2}}) {
      Map2 map = legal_map<Map2>(form.target);
      map.uorder = uorder;
      map.vorder = vorder;
      map.*direction.stride = gl::components_of(form.target) - 1;
      bad.push_back(defining(map, form.doubles));
    }
  expect_refused(t, "orders 2x2, 1x8, 8x1, 4x5, 8x8, MAXx2", bad, {GL_INVALID_VALUE});
};

EVALCTS_TEST(Map2Errors, UDomain, must, "EV-MAP2-ERR-UDOMAIN", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_domains(t, form, kU); };

EVALCTS_TEST(Map2Errors, VDomain, must, "EV-MAP2-ERR-VDOMAIN", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) { expect_refused_domains(t, form, kV); };

// +0 and -0 are equal, which the text does not say in so many words (U-ZERO-SIGN).
EVALCTS_TEST(Map2Errors, ZeroOfEitherSign, quality, "EV-MAP2-ERR-UDOMAIN", "EV-MAP2-ERR-VDOMAIN",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  for (const Direction<Map2>& direction : {kU, kV}) {
    Map2 map = legal_map<Map2>(GL_MAP2_VERTEX_3);
    map.*direction.first = 0.0;
    map.*direction.last = -0.0;
    expect_refused(t, direction.order == kU.order ? "u1 = +0 u2 = -0" : "v1 = +0 v2 = -0",
                   {defining(map, form.doubles)}, {GL_INVALID_VALUE});
  }
};

namespace {

void expect_refused_in(Test& t, const TargetForm& form, const std::string& identity,
                       const std::vector<GLenum>& modes) {
  std::vector<Calls> bad;
  for (const GLenum mode : modes)
    for (const bool after_vertex : {false, true})
      bad.push_back([&form, mode, after_vertex](gl::Case& c) {
        c.Begin(mode);
        if (after_vertex) c.Vertex3f(1, 2, 3);
        define(c, legal_map<Map2>(form.target), form.doubles);
        c.End();
      });
  expect_refused(t, identity, bad, {GL_INVALID_OPERATION});
}

}  // namespace

EVALCTS_TEST(Map2Errors, BetweenBeginAndEnd, must, "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  expect_refused_in(t, form, "in POINTS, TRIANGLES, QUAD_STRIP, POLYGON; first and after Vertex",
                    {GL_POINTS, GL_TRIANGLES, GL_QUAD_STRIP, GL_POLYGON});
};
EVALCTS_TEST(Map2Errors, BetweenBeginAndEndElsewhere, must, "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()))
(Test& t, const TargetForm& form) {
  expect_refused_in(t, form, "in the other primitives; first and after Vertex",
                    {GL_LINES, GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS});
};

// The primitive goes on as if the refused command had not been there.
EVALCTS_TEST(Map2Errors, PrimitiveUndisturbed, must, "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT",
             "EV-BE-IGNORED/2-D", combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("EvalCoord2, Map2, EvalCoord2, Vertex");
  define(c, make_map2(GL_MAP2_VERTEX_3, 2, 2, {1, 2, 3, 4, 5, 6, -7, 8, -9, 2.5, 0.25, -1}));
  c.Enable(GL_MAP2_VERTEX_3);
  c.Begin(GL_LINE_STRIP);  // of points nobody could tell whether they are of one primitive
  evaluate2(c, 0.25, 0.75);
  define(c, legal_map<Map2>(form.target), form.doubles);
  evaluate2(c, 0.75, 0.5);
  c.Vertex3f(1, 2, 3);
  c.End();
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(Map2Errors, EvaluatesAsBefore, must, "EV-MAP2-ERR-NOEFFECT",
             combine(visible_target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  expect_evaluates_as_before(
      t, form, "refused for orders, strides, domains, target, Begin/End, evaluated after each",
      random_map2(t, form.target, 3, 4), form.target - gl::kMap2Targets[0] + gl::kMap1Targets[0],
      [&](gl::Case& c) {
        for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.3125, 0.75}, {1.0, 1.0}})
          evaluate2(c, u, v, form.doubles);
      },
      [&](gl::Case& c) { evaluate2(c, 0.6875, 0.125, form.doubles); });
};

// Several conditions at once: one of the matching errors, whichever.
EVALCTS_TEST(Map2Errors, SeveralAtOnce, must, "EV-MAP-ERR-ANY/2-D", "EV-MAP2-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  const auto spoiled = [&](const std::function<void(Map2&)>& spoil) {
    Map2 map = legal_map<Map2>(GL_MAP2_VERTEX_4);
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
};

EVALCTS_TEST(Map2Errors, LegalCallAfterwards, must, "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  Map2 map = random_map2(t, form.target, 3, 2, 16, 5);
  map.u1 = -4, map.u2 = 4, map.v1 = 9, map.v2 = 8;
  expect_legal_call_afterwards(t, form, "refused for orders, strides and domains, then legal", map);
};

// What is no error: EV-MAP-NOERR-OTHER names the conditions.
EVALCTS_TEST(Map2Errors, NoOtherCondition, must, "EV-MAP-NOERR-OTHER/2-D",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c(
      "large strides, reversed, negative, large and narrow domains, repeated points, negative zeros, "
      "subnormals");
  std::vector<std::pair<gl::Ref, gl::Ref>> answers;
  std::vector<std::vector<GLint>> orders;
  const auto expect_accepted = [&](const std::function<void(Map2&)>& change) {
    // Other orders each time, so that the query tells a silently ignored call.
    Map2 map = legal_map<Map2>(form.target);
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
  expect_accepted([](Map2& m) { m.uorder = 1, m.ustride = kHighest; });
  expect_accepted([](Map2& m) { m.vorder = 1, m.vstride = kHighest; });
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
};

}  // namespace evalcts::suite_map_errors
