// Section 5 of the requirements for Map1: each condition raises its error once and changes nothing.
#include <fmt/format.h>

#include <cmath>

#include "suites/refusal.h"

namespace evalcts::suite_map1_errors {
namespace {

// A legal map, to be spoiled by the test. Memory for order 65 at any stride used here stands behind it, so
// that a library which checks late reads nothing that it must not.
Map1 legal_map(GLenum target) {
  Map1 map;
  map.target = target;
  map.stride = std::max(gl::components_of(target), 1);
  map.order = 3;
  map.points.assign(4096, 0.5);
  return map;
}

void expect_refused(Test& t, const std::string& identity, const Calls& bad_call,
                    std::initializer_list<GLenum> allowed) {
  expect_refused(t, identity, std::vector{bad_call}, allowed, Prepared::maps1);
}

void expect_refused(Test& t, const std::string& identity, const Map1& bad, bool doubles,
                    std::initializer_list<GLenum> allowed) {
  expect_refused(
      t, identity, [&](gl::Case& c) { define(c, bad, doubles); }, allowed);
}

}  // namespace

EVALCTS_LISTED_TESTS(Map1Errors, BadTarget, kForms, const Form& form, must, "EV-MAP1-ERR-TARGET",
                     "EV-MAP1-ERR-NOEFFECT") {
  std::vector<GLenum> bad = {0, 0x0D8F, 0x0D99, GL_TEXTURE_2D, GL_AUTO_NORMAL, GL_COEFF, 0xFFFFFFFFu};
  bad.insert(bad.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  for (const GLenum target : bad) {
    Map1 map = legal_map(GL_MAP1_VERTEX_4);
    map.target = target;
    expect_refused(t, gl::token_name(target), map, form.doubles, {GL_INVALID_ENUM});
  }
}

// Whatever part of the number is looked at. (Apart from the test above: those who lose the error in display
// lists fail it in other cases then.)
EVALCTS_TESTS(Map1Errors, BadTargetOfSimilarNumber, kForms, const Form& form, must, "EV-MAP1-ERR-TARGET",
              "EV-MAP1-ERR-NOEFFECT") {
  for (const GLenum target : {0x0D9Au, 0x0D9Fu, 0x0DA0u, 0x10D90u, 0x10D98u, 0x80000D97u}) {
    Map1 map = legal_map(GL_MAP1_VERTEX_4);
    map.target = target;
    expect_refused(t, gl::token_name(target), map, form.doubles, {GL_INVALID_ENUM});
  }
}

EVALCTS_LISTED_TESTS(Map1Errors, OrderTooLow, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-ORDER-LOW", "EV-MAP1-ERR-NOEFFECT") {
  for (const int order : {0, -1, -64, std::numeric_limits<int>::min()}) {
    Map1 map = legal_map(form.target);
    map.order = order;
    expect_refused(t, fmt::format("order {}", order), map, form.doubles, {GL_INVALID_VALUE});
  }
}

EVALCTS_LISTED_TESTS(Map1Errors, OrderTooHigh, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-ORDER-HIGH", "EV-MAP1-ERR-NOEFFECT") {
  const int limit = t.gl().max_eval_order;
  for (const int order : orders_too_high(t)) {
    Map1 map = legal_map(form.target);
    map.order = order;
    map.points.assign(static_cast<std::size_t>(order) * static_cast<std::size_t>(map.stride), 0.5);
    expect_refused(
        t, order < 0x101 ? fmt::format("order MAX+{}", order - limit) : fmt::format("order {}", order), map,
        form.doubles, {GL_INVALID_VALUE});
  }
}

EVALCTS_LISTED_TESTS(Map1Errors, StrideBelowK, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT") {
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1, -17, std::numeric_limits<int>::min()}) {
    Map1 map = legal_map(form.target);
    map.stride = stride;
    expect_refused(t, fmt::format("stride {}", stride), map, form.doubles, {GL_INVALID_VALUE});
  }
}

EVALCTS_TESTS(Map1Errors, StrideBelowKAtEveryOrder, target_forms(), const TargetForm& form, must,
              "EV-MAP1-ERR-STRIDE", "EV-MAP1-ERR-NOEFFECT") {
  gl::Case c("stride k - 1, orders 1 to MAX");
  prepare(c, Prepared::maps1, false);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  std::vector<gl::Ref> errors;
  for (int order = 1; order <= t.max_order(); ++order) {
    Map1 map = legal_map(form.target);
    map.order = order;
    map.stride = gl::components_of(form.target) - 1;
    define(c, map, form.doubles);
    errors.push_back(c.GetError());
  }
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_error(error, {GL_INVALID_VALUE});
  expect_unchanged(played, before, after);
}

EVALCTS_LISTED_TESTS(Map1Errors, StrideBelowKAtOrder1, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-STRIDE-ORDER1", "EV-MAP1-ERR-NOEFFECT") {
  for (const int stride : {gl::components_of(form.target) - 1, 0, -1}) {
    Map1 map = legal_map(form.target);
    map.order = 1;
    map.stride = stride;
    expect_refused(t, fmt::format("order 1 stride {}", stride), map, form.doubles, {GL_INVALID_VALUE});
  }
}

EVALCTS_LISTED_TESTS(Map1Errors, EqualDomainEnds, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-DOMAIN", "EV-MAP1-ERR-NOEFFECT") {
  for (const int order : {1, 3, 2, 8})
    for (const double end : {0.0, 1.0, -2.5, 1e6}) {
      if ((order == 2 || order == 8) && end != 1) continue;
      Map1 map = legal_map(form.target);
      map.order = order;
      map.u1 = map.u2 = end;
      expect_refused(t, fmt::format("u1 = u2 = {}, order {}", end, order), map, form.doubles,
                     {GL_INVALID_VALUE});
    }
}

// +0 and -0 are equal, which the text does not say in so many words (U-ZERO-SIGN).
EVALCTS_LISTED_TESTS(Map1Errors, ZeroOfEitherSign, kForms, const Form& form, quality, "EV-MAP1-ERR-DOMAIN") {
  Map1 map = legal_map(GL_MAP1_VERTEX_3);
  map.u1 = 0.0;
  map.u2 = -0.0;
  expect_refused(t, "u1 = +0 u2 = -0", map, form.doubles, {GL_INVALID_VALUE});
}

EVALCTS_LISTED_TESTS(Map1Errors, BetweenBeginAndEnd, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-BEGINEND", "EV-MAP1-ERR-NOEFFECT") {
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    for (const char* after : {"nothing", "Vertex"}) {
      if ((mode % 2 == 0) == (after[0] == 'V') && mode != GL_TRIANGLES) continue;
      expect_refused(t, fmt::format("{} after {}", gl::primitive_name(mode), after),
                     [&](gl::Case& c) {
                       c.Begin(mode);
                       if (after[0] == 'V') c.Vertex3f(1, 2, 3);
                       define(c, legal_map(form.target), form.doubles);
                       c.End();
                     },
                     {GL_INVALID_OPERATION});
    }
}

// The primitive goes on as if the refused command had not been there.
EVALCTS_LISTED_TESTS(Map1Errors, PrimitiveUndisturbed, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-BEGINEND", "EV-MAP1-ERR-NOEFFECT", "EV-BE-IGNORED/1-D") {
  gl::Case c("EvalCoord, Map1, EvalCoord, Vertex");
  define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6, -7, 8, -9}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_LINE_STRIP);  // of points nobody could tell whether they are of one primitive
  c.EvalCoord1f(0.25f);
  define(c, legal_map(form.target), form.doubles);
  c.EvalCoord1f(0.75f);
  c.Vertex3f(1, 2, 3);
  c.End();
  t.expect_emission(c, kPosition);
}

// What is evaluated after a refused call of each kind is what the last legal call defined.
EVALCTS_LISTED_TESTS(Map1Errors, EvaluatesAsBefore, visible_target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-NOEFFECT") {
  gl::Case c("refused for order, stride, domain, target, Begin/End, evaluated after each");
  define(c,
         make_map1(form.target, 0, 1, gl::components_of(form.target),
                   random_values(t.random(), static_cast<std::size_t>(4 * gl::components_of(form.target)))));
  enable_visibly(c, form.target);
  const auto evaluate_some = [&] {
    c.GetError();
    c.Begin(GL_POINTS);
    for (const double u : {0.0, 0.3125, 1.0}) evaluate(c, u, form.doubles);
    c.End();
  };
  Map1 bad = legal_map(form.target);
  bad.order = 0;
  define(c, bad, form.doubles);
  evaluate_some();
  bad = legal_map(form.target);
  bad.stride = 0;
  define(c, bad, form.doubles);
  evaluate_some();
  bad = legal_map(form.target);
  bad.u2 = bad.u1;
  define(c, bad, form.doubles);
  evaluate_some();
  bad = legal_map(form.target);
  bad.target = form.target + 0x20;  // the MAP2 namesake
  define(c, bad, form.doubles);
  evaluate_some();
  c.Begin(GL_POINTS);
  define(c, legal_map(form.target), form.doubles);
  c.End();
  evaluate_some();
  t.expect_emission(c, attribute_of(form.target));
}

EVALCTS_LISTED_TESTS(Map1Errors, ActiveTexture, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-ACTIVETEX", "EV-MAP1-ERR-NOEFFECT", "EV-EXT-MT-RULE/1-D") {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  expect_refused(t, "TEXTURE1 active",
                 [&](gl::Case& c) {
                   c.ActiveTexture(GL_TEXTURE1);
                   define(c, legal_map(form.target), form.doubles);
                   c.ActiveTexture(GL_TEXTURE0);  // the queries that follow are of unit 0 again
                 },
                 {GL_INVALID_OPERATION});

  if (t.gl().texture_units > 2)
    expect_refused(t, "the last unit active",
                   [&](gl::Case& c) {
                     c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(t.gl().texture_units) - 1);
                     define(c, legal_map(form.target), form.doubles);
                     c.ActiveTexture(GL_TEXTURE0);
                   },
                   {GL_INVALID_OPERATION});

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
  const Map1 map = legal_map(form.target);
  define(c, map, form.doubles);
  const gl::Ref error = c.GetError();
  const gl::Ref order = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
  Played played = t.play(c);
  played.expect_no_error(error);
  played.expect_values(order, std::vector<GLint>{map.order});
}

// ... whatever command made it active.
EVALCTS_LISTED_TESTS(Map1Errors, ActiveTextureOfPopAttrib, kForms, const Form& form, must,
                     "EV-MAP1-ERR-ACTIVETEX") {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_INDEX}) {
    gl::Case c(label(target));
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE1);
    c.PopAttrib();
    define(c, legal_map(target), form.doubles);
    const gl::Ref none = c.GetError();
    const gl::Ref defined = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1));
    c.ActiveTexture(GL_TEXTURE1);
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE0);
    c.PopAttrib();
    Map1 refused = legal_map(target);
    refused.order = 5;
    define(c, refused, form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref kept = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1));
    Played played = t.play(c);
    played.expect_no_error(none);
    played.expect_error(error, {GL_INVALID_OPERATION});
    for (const gl::Ref order : {defined, kept})
      played.expect_values(order, std::vector<GLint>{legal_map(target).order});
  }
}

// Several conditions at once: one of the matching errors, whichever.
EVALCTS_LISTED_TESTS(Map1Errors, SeveralAtOnce, kForms, const Form& form, must, "EV-MAP-ERR-ANY/1-D",
                     "EV-MAP1-ERR-NOEFFECT") {
  const auto spoiled = [](GLenum target, int order, int stride, double u2) {
    Map1 map = legal_map(GL_MAP1_VERTEX_4);
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
  expect_refused(t, "target, between Begin and End",
                 [&](gl::Case& c) {
                   c.Begin(GL_LINES);
                   define(c, spoiled(GL_MAP2_VERTEX_4, 3, 4, 1), form.doubles);
                   c.End();
                 },
                 {GL_INVALID_ENUM, GL_INVALID_OPERATION});
}

// An error that nobody has asked for changes nothing about the calls that follow.
EVALCTS_TESTS(Map1Errors, RefusedWhileAnErrorWaits, target_forms(), const TargetForm& form, must,
              "EV-MAP1-ERR-NOEFFECT") {
  gl::Case c("refused for order, stride, domain, target and once more order");
  prepare(c, Prepared::maps1, true);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  const auto refused = [&](const std::function<void(Map1&)>& spoil) {
    Map1 bad = legal_map(form.target);
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
}

// An error reported once is gone, and the next legal call works.
EVALCTS_LISTED_TESTS(Map1Errors, LegalCallAfterwards, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ERR-NOEFFECT") {
  gl::Case c("refused for order, stride and domain, then legal");
  Map1 bad = legal_map(form.target);
  bad.order = 0;
  define(c, bad, form.doubles);
  bad = legal_map(form.target);
  bad.stride = 0;
  define(c, bad, form.doubles);
  bad = legal_map(form.target);
  bad.u2 = bad.u1;
  define(c, bad, form.doubles);
  std::vector<double> coefficients;
  for (int i = 0; i < 2 * gl::components_of(form.target); ++i) coefficients.push_back(i - 1.5);
  const Map1 map = make_map1(form.target, -4, 4, 6, coefficients);
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
EVALCTS_LISTED_TESTS(Map1Errors, NoOtherCondition, target_forms(), const TargetForm& form, must,
                     "EV-MAP-NOERR-OTHER/1-D") {
  const auto expect_accepted = [&](const std::string& identity, const Map1& map) {
    gl::Case c(identity);
    define(c, map, form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref order = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
    Played played = t.play(c);
    played.expect_no_error(error);
    played.expect_values(order, std::vector<GLint>{map.order});
  };
  Map1 map = legal_map(form.target);
  map.stride = 1000;
  expect_accepted("stride far larger than needed", map);
  map = legal_map(form.target);
  map.order = 1;
  map.stride = 4000;
  expect_accepted("order 1 with a large stride", map);
  map = legal_map(form.target);
  map.u1 = 1, map.u2 = 0;
  expect_accepted("u1 > u2", map);
  map.order = 1;
  expect_accepted("u1 > u2, order 1", map);
  map = legal_map(form.target);
  map.u1 = -1e6, map.u2 = -1e5;
  expect_accepted("negative domain", map);
  map = legal_map(form.target);
  map.u1 = -0x1p31, map.u2 = 0x1p31;
  expect_accepted("large domain", map);
  map = legal_map(form.target);
  map.u2 = std::nextafterf(0.0f, 1.0f) + 1;
  map.u1 = std::nextafterf(1.0f, 2.0f);
  expect_accepted("domain of one ULP", map);
  expect_accepted("repeated points", legal_map(form.target));
  map = legal_map(form.target);
  for (std::size_t i = 0; i < map.points.size(); ++i) map.points[i] = i % 2 ? -0.0 : std::ldexp(1.0, -140);
  expect_accepted("negative zeros and subnormals", map);
}

}  // namespace evalcts::suite_map1_errors
