// Section 5 of the requirements: Map1 and Map2 raise the error of each condition once and change nothing, not
// even the values of the valid direction.
#include <fmt/format.h>

#include <cmath>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "rejection.h"

namespace evalcts::suite_map_errors {
namespace {

// --- Rules of both dimensions ----------------------------------------------------------------------------

const auto kEachForm = combine(kForms).by(gl::list_deliveries());
const auto kEachTargetForm = [](bool two) { return combine(target_forms(two)).by(gl::list_deliveries()); };

void judge_targets(Test& t, bool two, bool doubles, const std::vector<GLenum>& bad) {
  std::vector<Map> maps;
  for (const GLenum target : bad) {
    maps.push_back(legal_map(target_in(two, GL_MAP1_VERTEX_4)));
    maps.back().target = target;
  }
  judge_rejected(t, "invalid targets", maps, doubles);
}

EVALCTS_TEST_PAIR(Map1Errors.BadTarget, Map2Errors.BadTarget, kMust,
                  decide("EV-MAP1-ERR-TARGET", "EV-MAP2-ERR-TARGET"),
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"), kEachForm)
(Test& t, bool two, const Form& form) {
  std::vector<GLenum> bad = {
      0,          two ? 0x0DAFu : 0x0D8Fu, two ? 0x0DB9u : 0x0D99u, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF,
      0xFFFFFFFFu};
  bad.insert(bad.end(), targets(!two).begin(), targets(!two).end());
  judge_targets(t, two, form.doubles, bad);
};

// Targets whose values are similar to valid ones, for libraries that examine part of the value only. There
// are no display lists, unlike in the test above, in which libraries that lose errors in lists fail.
EVALCTS_TEST_PAIR(Map1Errors.BadTargetOfSimilarNumber, Map2Errors.BadTargetOfSimilarNumber, kMust,
                  decide("EV-MAP1-ERR-TARGET", "EV-MAP2-ERR-TARGET"),
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"), combine(kForms))
(Test& t, bool two, const Form& form) {
  judge_targets(t, two, form.doubles,
                two ? std::vector<GLenum>{0x0DA0, 0x0DBF, 0x0DC0, 0x10DB0, 0x10DB8, 0x80000DB7}
                    : std::vector<GLenum>{0x0D9A, 0x0D9F, 0x0DA0, 0x10D90, 0x10D98, 0x80000D97});
};

// +0 and -0 are equal ends of a domain. The specification does not say so explicitly (U-ZERO-SIGN).
EVALCTS_TEST_PAIR(Map1Errors.ZeroOfEitherSign, Map2Errors.ZeroOfEitherSign, kQuality,
                  decide("EV-MAP1-ERR-DOMAIN", "EV-MAP2-ERR-UDOMAIN"), decide(nullptr, "EV-MAP2-ERR-VDOMAIN"),
                  kEachForm)
(Test& t, bool two, const Form& form) {
  std::vector<Map> maps;
  for (const Direction& direction : directions(two)) {
    Map& map = maps.emplace_back(legal_map(target_in(two, GL_MAP1_VERTEX_3)));
    map.*direction.first = 0.0;
    map.*direction.last = -0.0;
  }
  judge_rejected(t, "from +0 to -0", maps, form.doubles);
};

// A rejected Map between Begin and End does not affect the primitive.
EVALCTS_TEST_PAIR(Map1Errors.PrimitiveUndisturbed, Map2Errors.PrimitiveUndisturbed, kMust,
                  decide("EV-MAP1-ERR-BEGINEND", "EV-MAP2-ERR-BEGINEND"),
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"),
                  decide("EV-BE-IGNORED/1-D", "EV-BE-IGNORED/2-D"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  gl::Case c(two ? "EvalCoord2, Map2, EvalCoord2, Vertex" : "EvalCoord, Map1, EvalCoord, Vertex");
  define_and_enable(c, two ? make_map2(GL_MAP2_VERTEX_3, 2, 2, {1, 2, 3, 4, 5, 6, -7, 8, -9, 2.5, 0.25, -1})
                           : make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6, -7, 8, -9}));
  c.Begin(GL_LINE_STRIP);  // shows whether all vertices belong to one primitive, unlike points
  eval_coord(c, two, 0.25, 0.75);
  define(c, legal_map(form.target), form.doubles);
  eval_coord(c, two, 0.75, 0.5);
  c.Vertex3f(1, 2, 3);
  c.End();
  t.judge_vertices(c, kPosition);
};

// Calls `call` with maps that are illegal by their order, stride or domain, in each direction.
void for_each_illegal(GLenum target, const std::function<void(const Map&)>& call) {
  const Map legal = legal_map(target);
  for (const Direction& direction : directions(legal.two)) {
    Map bad = legal;
    bad.*direction.order = 0;
    call(bad);
    bad = legal;
    bad.*direction.stride = 0;
    call(bad);
    bad = legal;
    bad.*direction.last = bad.*direction.first;
    call(bad);
  }
}

// Evaluations after a rejected call of each kind use the map of the last legal call.
EVALCTS_TEST_PAIR(Map1Errors.EvaluatesAsBefore, Map2Errors.EvaluatesAsBefore, kMust,
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"),
                  [](bool two) { return combine(visible_target_forms(two)).by(gl::list_deliveries()); })
(Test& t, bool two, const TargetForm& form) {
  gl::Case c(fmt::format("refused for {}, target, Begin/End, evaluated after each",
                         two ? "orders, strides, domains" : "order, stride, domain"));
  define(c, random_map(t, form.target, two ? Orders{3, 4} : Orders{4}));
  enable_visibly(c, form.target);
  const std::vector<At> three = {{0, 0}, {0.3125, 0.75}, {1, 1}};
  const auto draw = [&](const std::vector<At>& points) {
    c.GetError();
    c.Begin(GL_POINTS);
    for (const auto& [u, v] : points) eval_coord(c, two, u, v, form.doubles);
    c.End();
  };
  const auto evaluate_after = [&](const Map& bad) {
    define(c, bad, form.doubles);
    draw(three);
  };
  for_each_illegal(form.target, evaluate_after);
  Map of_other_dimension = legal_map(form.target);
  of_other_dimension.target = targets(!two)[static_cast<std::size_t>(form.target - targets(two)[0])];
  evaluate_after(of_other_dimension);
  c.Begin(GL_POINTS);
  define(c, legal_map(form.target), form.doubles);
  c.End();
  draw(two ? std::vector<At>{{0.6875, 0.125}} : three);
  t.judge_vertices(c, attribute_of(form.target));
};

// A legal call after rejected ones takes effect, and the error is reported once.
EVALCTS_TEST_PAIR(Map1Errors.LegalCallAfterwards, Map2Errors.LegalCallAfterwards, kMust,
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  std::vector<double> coefficients;
  for (int i = 0; i < 2 * gl::components_of(form.target); ++i) coefficients.push_back(i - 1.5);
  const Map map = two ? over(random_map(t, form.target, {3, 2}, 16, 5), {-4, 4}, {9, 8})
                      : make_map1(form.target, -4, 4, 6, coefficients);
  gl::Case c(fmt::format("rejected for {}, then legal",
                         two ? "orders, strides and domains" : "order, stride and domain"));
  for_each_illegal(form.target, [&](const Map& bad) { define(c, bad, form.doubles); });
  define(c, map, form.doubles);
  c.GetError();  // the legal call does not clear the error
  c.GetError();
  query_map(t, c, map.target, form.doubles);
  t.judge(c);
};

// Changes of a legal map that leave it legal, unusual as they are; EV-MAP-NOERR-OTHER lists them.
std::vector<std::function<void(Map&)>> legal_changes(bool two) {
  std::vector<std::function<void(Map&)>> changes = {
      [](Map& m) { m.ustride = 300; },
      [](Map& m) { m.uorder = m.vorder = 1, m.ustride = 4000; },
      [](Map& m) { m.u1 = 1, m.u2 = 0; },
      [](Map& m) { m.u1 = 1, m.u2 = 0, m.uorder = 1; },
      [](Map& m) { m.u1 = -1e6, m.u2 = -1e5; },
      [](Map& m) { m.u1 = -0x1p31, m.u2 = 0x1p31; },
      [](Map& m) { m.u1 = std::nextafter(1.0f, 2.0f), m.u2 = 1; },
      [](Map&) {},  // all points are equal
      [](Map& m) {
        for (std::size_t i = 0; i < m.points.size(); ++i) m.points[i] = i % 2 ? -0.0 : std::ldexp(1.0, -140);
      }};
  if (!two) return changes;
  const std::function<void(Map&)> of_surfaces[] = {
      [](Map& m) { m.vstride = 300; }, [](Map& m) { m.ustride = 270, m.vstride = 300; },
      [](Map& m) { m.uorder = m.vorder = 1, m.ustride = 4000, m.vstride = 4090; },
      // With order 1 the stride is not used, however large it is (U-STRIDE-HUGE).
      [](Map& m) { m.uorder = 1, m.ustride = kHighest; }, [](Map& m) { m.vorder = 1, m.vstride = kHighest; },
      [](Map& m) { m.v1 = 1, m.v2 = 0; }, [](Map& m) { m.u1 = m.v1 = 7, m.u2 = m.v2 = -2; },
      // The domain of v is that of u reversed.
      [](Map& m) { m.u1 = 0, m.u2 = 1, m.v1 = 1, m.v2 = 0; }, [](Map& m) { m.v1 = -3, m.v2 = -2; },
      [](Map& m) { m.v1 = 0x1p31, m.v2 = -0x1p31; },
      [](Map& m) { m.v1 = 1, m.v2 = std::nextafter(1.0f, 2.0f); }};
  changes.insert(changes.end(), std::begin(of_surfaces), std::end(of_surfaces));
  return changes;
}

EVALCTS_TEST_PAIR(Map1Errors.NoOtherCondition, Map2Errors.NoOtherCondition, kMust,
                  decide("EV-MAP-NOERR-OTHER/1-D", "EV-MAP-NOERR-OTHER/2-D"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  gl::Case c(
      "large strides, reversed, negative, large and narrow domains, repeated points, negative zeros, "
      "subnormals");
  int count = 0;
  for (const auto& change : legal_changes(two)) {
    // The order alternates, so that the query shows if the call was silently ignored.
    Map map = legal_map(form.target);
    map.uorder = 2 + count++ % 2;
    change(map);
    define(c, with_room(map), form.doubles);
    c.GetError();
    c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(map.orders().size()));
  }
  t.judge(c);
};

// --- One-dimensional maps --------------------------------------------------------------------------------

// Judges legal_map() of this order with each of the values of the parameter.
void judge_values(Test& t, const TargetForm& form, const char* identity, int Map::*parameter,
                  const std::vector<int>& values, int order = 3) {
  std::vector<Map> maps;
  for (const int value : values) {
    Map& map = maps.emplace_back(legal_map(form.target));
    map.uorder = order;
    map.*parameter = value;
  }
  judge_rejected(t, identity, maps, form.doubles);
}

EVALCTS_TEST(Map1Errors, OrderTooLow, kMust, "EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  judge_values(t, form, "orders 0, -1, -64, the lowest int", &Map::uorder, {0, -1, -64, kLowest});
};

EVALCTS_TEST(Map1Errors, OrderTooHigh, kMust, "EV-MAP1-ERR-ORDER-HIGH", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  for (const int order : orders_too_high(t)) judge_values(t, form, "order above MAX", &Map::uorder, {order});
};

// Orders of which products with k, a stride or the size of a value wrap at 16, 31 or 32 bits. A library that
// reads the points leaves the array, behind which is no memory. There are no display lists, because a library
// may copy the points before it checks the arguments.
constexpr int kWrapping[] = {1 << 16, 1 << 28, 1 << 29, 1 << 30, (1 << 30) + 1, kHighest};

EVALCTS_TEST_PAIR(Map1Errors.OrdersThatWrap, Map2Errors.OrdersThatWrap, kMust,
                  decide("EV-MAP-ERR-WRAP/1-D", "EV-MAP-ERR-WRAP/2-D"),
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"),
                  [](bool two) { return combine(target_forms(two)); })
(Test& t, bool two, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  const auto map = [=](int uorder, int vorder) {
    return [=](gl::Case& c) {
      const std::vector<GLfloat> points(static_cast<std::size_t>(4 * k));
      const std::vector<GLdouble> doubles(points.begin(), points.end());
      if (two)
        form.doubles ? c.Map2d(form.target, 0, 1, k, uorder, 0, 1, k, vorder, doubles)
                     : c.Map2f(form.target, 0, 1, k, uorder, 0, 1, k, vorder, points);
      else
        form.doubles ? c.Map1d(form.target, 0, 1, k, uorder, doubles)
                     : c.Map1f(form.target, 0, 1, k, uorder, points);
    };
  };
  std::vector<Calls> calls;
  for (const int order : kWrapping) {
    if (order <= t.order_limit()) continue;
    calls.push_back(map(order, 2));
    if (!two) continue;
    calls.push_back(map(2, order));
    calls.push_back(map(order, order));
  }
  if (calls.empty()) throw NotObservable("MAX_EVAL_ORDER is so high that no product wraps");
  judge_rejected(t, "orders of which a product wraps", calls, two ? Prepared::kEverything : Prepared::kMaps1);
};

// Returns strides that are too small for `k` components. Display lists get no negative ones, because a
// library that copies the points before it checks the arguments would read memory before the array, with an
// unpredictable outcome.
std::vector<int> strides_below(int k, const Test& t) {
  if (t.is_delivered_in_lists()) return {k - 1, 0};
  return {k - 1, 0, -1, -17, kLowest};
}

EVALCTS_TEST(Map1Errors, StrideBelowK, kMust, "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  judge_values(t, form, "strides below k", &Map::ustride, strides_below(gl::components_of(form.target), t));
};

EVALCTS_TEST(Map1Errors, StrideBelowKAtEveryOrder, kMust, "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms(kCurves)))
(Test& t, const TargetForm& form) {
  std::vector<Map> maps;
  for (int order = 1; order <= t.max_order(); ++order) {
    Map& map = maps.emplace_back(legal_map(form.target));
    map.uorder = order;
    map.ustride = gl::components_of(form.target) - 1;
  }
  judge_rejected(t, "stride k - 1, orders 1 to MAX", maps, form.doubles);
};

EVALCTS_TEST(Map1Errors, StrideBelowKAtOrder1, kMust, "EV-MAP1-ERR-STRIDE-ORDER1", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  std::vector<int> strides = strides_below(gl::components_of(form.target), t);
  std::erase_if(strides, [](int stride) { return stride < -1; });
  judge_values(t, form, "order 1, strides below k", &Map::ustride, strides, 1);
};

EVALCTS_TEST(Map1Errors, EqualDomainEnds, kMust, "EV-MAP1-ERR-DOMAIN", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  std::vector<Map> maps;
  for (const int order : {1, 3, 2, 8})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      if ((order == 2 || order == 8) && end != 1) continue;
      Map& map = maps.emplace_back(legal_map(form.target));
      map.uorder = order;
      map.u1 = map.u2 = end;
    }
  judge_rejected(t, "both ends 0, 1, -2.5, 1e6; orders 1, 3, 2 and 8", maps, form.doubles);
};

EVALCTS_TEST(Map1Errors, BetweenBeginAndEnd, kMust, "EV-MAP1-ERR-BEGINEND", "EV-MAP1-ERR-NOEFFECT",
             kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  std::vector<Calls> bad;
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    for (const bool after_vertex : {false, true})
      bad.push_back(in_primitive(mode, after_vertex, defining(legal_map(form.target), form.doubles)));
  judge_rejected(t, "in every primitive, first and after Vertex", bad, Prepared::kMaps1);
};

// If several conditions hold, any of their errors is accepted.
EVALCTS_TEST(Map1Errors, SeveralAtOnce, kMust, "EV-MAP-ERR-ANY/1-D", "EV-MAP1-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  const auto spoiled = [](GLenum target, int order, int stride, double u2) {
    Map map = legal_map(GL_MAP1_VERTEX_4);
    map.target = target;
    map.uorder = order;
    map.ustride = stride;
    map.u2 = u2;
    return map;
  };
  judge_rejected(
      t, "target or order, stride, domain; order, stride and domain; order too high and stride",
      {spoiled(GL_MAP2_VERTEX_4, 0, 4, 1), spoiled(GL_TEXTURE_2D, 3, 0, 1), spoiled(0, 3, 4, 0),
       spoiled(GL_MAP1_VERTEX_4, -1, 1, 0), spoiled(GL_MAP1_VERTEX_4, orders_too_high(t).front(), 1, 1)},
      form.doubles);
  judge_rejected(t, "target, between Begin and End",
                 {in_primitive(GL_LINES, false, defining(spoiled(GL_MAP2_VERTEX_4, 3, 4, 1), form.doubles))},
                 Prepared::kMaps1);
};

// Calls are rejected in the same way while an earlier error has not been queried.
EVALCTS_TEST(Map1Errors, RefusedWhileAnErrorWaits, kMust, "EV-MAP1-ERR-NOEFFECT",
             combine(target_forms(kCurves)))
(Test& t, const TargetForm& form) {
  gl::Case c("refused for order, stride, domain, target and once more order");
  prepare(c, Prepared::kMaps1, true);
  take_snapshot(t, c);
  const auto rejected = [&](const std::function<void(Map&)>& spoil) {
    Map bad = legal_map(form.target);
    spoil(bad);
    define(c, bad, form.doubles);
  };
  rejected([](Map& m) { m.uorder = 0; });
  rejected([](Map& m) { m.ustride = gl::components_of(m.target) - 1; });
  rejected([](Map& m) { m.u2 = m.u1; });
  rejected([](Map& m) { m.target = GL_TEXTURE_2D; });
  rejected([](Map& m) { m.uorder = 0; });
  // Distributed implementations may keep several errors (GL 2.1 section 2.5).
  for (int i = 0; i < 5; ++i) c.GetError();
  take_snapshot(t, c);
  t.judge(c);
};

// --- Two-dimensional maps --------------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Map2Errors.UOrder, Map2Errors.VOrder, kMust,
                  decide("EV-MAP2-ERR-UORDER", "EV-MAP2-ERR-VORDER"), "EV-MAP2-ERR-NOEFFECT",
                  kEachTargetForm(kSurfaces))
(Test& t, bool along_v, const TargetForm& form) {
  const Direction& direction = along_v ? kV : kU;
  std::vector<Map> too_low;
  for (const int order : {0, -1, -64, kLowest})
    too_low.emplace_back(legal_map(form.target)).*direction.order = order;
  judge_rejected(t, "orders 0, -1, -64, the lowest int", too_low, form.doubles);

  for (const int order : orders_too_high(t)) {
    Map too_high = legal_map(form.target);
    too_high.uorder = too_high.vorder = 1;
    too_high.*direction.order = order;
    too_high.*direction.stride = 4;
    judge_rejected(t, "order above MAX", {too_high}, form.doubles);
  }
};

EVALCTS_TEST_PAIR(Map2Errors.UStride, Map2Errors.VStride, kMust,
                  decide("EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-VSTRIDE"), "EV-MAP2-ERR-NOEFFECT",
                  kEachTargetForm(kSurfaces))
(Test& t, bool along_v, const TargetForm& form) {
  const Direction& direction = along_v ? kV : kU;
  // Strides are rejected even if the order in their direction is 1, so that they are not used. Negative ones
  // are passed with order 1 only, because a library that reads more points would read before the array.
  std::vector<Map> bad;
  for (const int stride : strides_below(gl::components_of(form.target), t))
    for (const auto& [order, other] : {std::pair{3, 2}, {1, 2}, {1, 1}}) {
      if (stride < 0 && order > 1) continue;
      Map& map = bad.emplace_back(legal_map(form.target));
      map.uorder = map.vorder = other;
      map.*direction.order = order;
      map.*direction.stride = stride;
    }
  judge_rejected(t, "strides below k", bad, form.doubles);
};

EVALCTS_TEST_PAIR(Map2Errors.UDomain, Map2Errors.VDomain, kMust,
                  decide("EV-MAP2-ERR-UDOMAIN", "EV-MAP2-ERR-VDOMAIN"), "EV-MAP2-ERR-NOEFFECT",
                  kEachTargetForm(kSurfaces))
(Test& t, bool along_v, const TargetForm& form) {
  const Direction& direction = along_v ? kV : kU;
  std::vector<Map> bad;
  for (const int order : {1, 2, 3})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      Map& map = bad.emplace_back(legal_map(form.target));
      map.uorder = map.vorder = order;
      map.*direction.first = map.*direction.last = end;
    }
  judge_rejected(t, "both ends 0, 1, -2.5, 1e6; orders 1x1, 2x2 and 3x3", bad, form.doubles);
};

// Strides of k - 1 are rejected whatever the orders.
EVALCTS_TEST(Map2Errors, StridesAtManyOrders, kMust, "EV-MAP2-ERR-USTRIDE", "EV-MAP2-ERR-VSTRIDE",
             "EV-MAP2-ERR-NOEFFECT", combine(target_forms(kSurfaces)))
(Test& t, const TargetForm& form) {
  std::vector<Map> bad;
  for (const Direction& direction : {kU, kV})
    for (const auto& [uorder, vorder] :
         {std::pair{2, 2}, {1, 8}, {8, 1}, {4, 5}, {8, 8}, {t.max_order(), 2}}) {
      Map& map = bad.emplace_back(legal_map(form.target));
      map.uorder = uorder;
      map.vorder = vorder;
      map.*direction.stride = gl::components_of(form.target) - 1;
    }
  judge_rejected(t, "orders 2x2, 1x8, 8x1, 4x5, 8x8, MAXx2", bad, form.doubles);
};

void judge_rejected_in(Test& t, const TargetForm& form, const std::string& identity,
                       const std::vector<GLenum>& modes) {
  std::vector<Calls> bad;
  for (const GLenum mode : modes)
    for (const bool after_vertex : {false, true})
      bad.push_back(in_primitive(mode, after_vertex, defining(legal_map(form.target), form.doubles)));
  judge_rejected(t, identity, bad);
}

EVALCTS_TEST(Map2Errors, BetweenBeginAndEnd, kMust, "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT",
             kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) {
  judge_rejected_in(t, form, "in POINTS, TRIANGLES, QUAD_STRIP, POLYGON; first and after Vertex",
                    {GL_POINTS, GL_TRIANGLES, GL_QUAD_STRIP, GL_POLYGON});
};
EVALCTS_TEST(Map2Errors, BetweenBeginAndEndElsewhere, kMust, "EV-MAP2-ERR-BEGINEND", "EV-MAP2-ERR-NOEFFECT",
             combine(target_forms(kSurfaces)))
(Test& t, const TargetForm& form) {
  judge_rejected_in(t, form, "in the other primitives; first and after Vertex",
                    {GL_LINES, GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS});
};

// If several conditions hold, any of their errors is accepted.
EVALCTS_TEST(Map2Errors, SeveralAtOnce, kMust, "EV-MAP-ERR-ANY/2-D", "EV-MAP2-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  const auto spoiled = [](const std::function<void(Map&)>& spoil) {
    Map map = legal_map(GL_MAP2_VERTEX_4);
    spoil(map);
    return map;
  };
  const int too_high = orders_too_high(t).front();
  judge_rejected(t, "target or order, stride, domain; both directions",
                 {spoiled([](Map& m) { m.target = GL_MAP1_VERTEX_4, m.uorder = 0; }),
                  spoiled([](Map& m) { m.target = GL_MAP1_VERTEX_4, m.vorder = -1; }),
                  spoiled([](Map& m) { m.target = GL_TEXTURE_2D, m.ustride = 0; }),
                  spoiled([](Map& m) { m.target = 0, m.vstride = 0; }),
                  spoiled([](Map& m) { m.target = 0x0DB9, m.u2 = m.u1; }),
                  spoiled([](Map& m) { m.target = GL_AUTO_NORMAL, m.v2 = m.v1; }),
                  spoiled([](Map& m) { m.uorder = 0, m.vorder = 0; }),
                  spoiled([](Map& m) { m.ustride = 0, m.vstride = 3; }),
                  spoiled([](Map& m) { m.u2 = m.u1, m.v2 = m.v1; }),
                  spoiled([](Map& m) { m.uorder = -1, m.vstride = 1; }),
                  spoiled([](Map& m) { m.ustride = 1, m.v2 = m.v1; }),
                  spoiled([&](Map& m) { m.uorder = 1, m.vorder = too_high, m.u2 = m.u1; }),
                  spoiled([&](Map& m) { m.uorder = too_high, m.vorder = 1, m.ustride = 1, m.v2 = m.v1; })},
                 form.doubles);
  std::vector<Calls> inside;
  for (const Map& map :
       {spoiled([](Map& m) { m.target = GL_MAP1_VERTEX_4; }), spoiled([](Map& m) { m.vorder = 0; })})
    inside.push_back(in_primitive(GL_LINES, false, defining(map, form.doubles)));
  judge_rejected(t, "target or order, between Begin and End", inside);
};

}  // namespace
}  // namespace evalcts::suite_map_errors
