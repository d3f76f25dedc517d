// Section 5 of the requirements: Map1 and Map2 are errors while a texture unit other than TEXTURE0 is active.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "refusal.h"

namespace evalcts::suite_map_errors_of_units {
namespace {

void require_texture_units(const Test& t) {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
}

// The texture unit that is active at the time of the call decides, and a rejected call leaves it active.
template <class Map>
void expect_active_texture_decides(Test& t, const TargetForm& form) {
  const Map map = legal_map<Map>(form.target);
  gl::Case unit("TEXTURE1 stays active");
  unit.ActiveTexture(GL_TEXTURE1);
  define(unit, map, form.doubles);
  unit.GetError();
  const gl::Ref active = unit.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
  Played still = t.play(unit);
  still.expect_values(active, std::vector<GLint>{GL_TEXTURE1});

  gl::Case c("TEXTURE1, then TEXTURE0 active");
  c.ActiveTexture(GL_TEXTURE1);
  c.ActiveTexture(GL_TEXTURE0);
  define(c, map, form.doubles);
  const gl::Ref error = c.GetError();
  const gl::Ref order = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(map.orders().size()));
  Played played = t.play(c);
  played.expect_no_error(error);
  played.expect_values(order, map.orders());
}

// The same for a unit that PopAttrib made active.
template <class Map>
void expect_popped_texture_decides(Test& t, bool doubles, std::initializer_list<GLenum> targets) {
  require_texture_units(t);
  for (const GLenum target : targets) {
    const Map map = legal_map<Map>(target);
    const auto query_orders = [&](gl::Case& c) {
      return c.GetMapiv(target, GL_ORDER, gl::out<GLint>(map.orders().size()));
    };
    gl::Case c(label(target));
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE1);
    c.PopAttrib();
    define(c, map, doubles);
    const gl::Ref none = c.GetError();
    const gl::Ref defined = query_orders(c);
    c.ActiveTexture(GL_TEXTURE1);
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE0);
    c.PopAttrib();
    Map refused = map;
    refused.*directions<Map>()[0].order = 5;
    define(c, refused, doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref kept = query_orders(c);
    Played played = t.play(c);
    played.expect_no_error(none);
    played.expect_error(error, {GL_INVALID_OPERATION});
    for (const gl::Ref orders : {defined, kept}) played.expect_values(orders, map.orders());
  }
}

}  // namespace

EVALCTS_TEST(Map1Errors, ActiveTexture, must, "EV-MAP1-ERR-ACTIVETEX", "EV-MAP1-ERR-NOEFFECT",
             "EV-EXT-MT-RULE/1-D", combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  require_texture_units(t);
  expect_refused<Map1>(t, "TEXTURE1 active",
                       [&](gl::Case& c) {
                         c.ActiveTexture(GL_TEXTURE1);
                         define(c, legal_map<Map1>(form.target), form.doubles);
                         c.ActiveTexture(GL_TEXTURE0);  // the queries that follow are of unit 0 again
                       },
                       {GL_INVALID_OPERATION});

  if (t.gl().texture_units > 2)
    expect_refused<Map1>(t, "the last unit active",
                         [&](gl::Case& c) {
                           c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(t.gl().texture_units) - 1);
                           define(c, legal_map<Map1>(form.target), form.doubles);
                           c.ActiveTexture(GL_TEXTURE0);
                         },
                         {GL_INVALID_OPERATION});

  expect_active_texture_decides<Map1>(t, form);
};

EVALCTS_TEST(Map1Errors, ActiveTextureOfPopAttrib, must, "EV-MAP1-ERR-ACTIVETEX",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_popped_texture_decides<Map1>(t, form.doubles,
                                      {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_INDEX});
};

EVALCTS_TEST(Map2Errors, ActiveTexture, must, "EV-MAP2-ERR-ACTIVETEX", "EV-MAP2-ERR-NOEFFECT",
             "EV-EXT-MT-RULE/2-D", combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  require_texture_units(t);
  std::vector<GLenum> units = {GL_TEXTURE1};
  if (t.gl().texture_units > 2) units.push_back(GL_TEXTURE0 + static_cast<GLenum>(t.gl().texture_units) - 1);
  std::vector<Calls> bad;
  for (const GLenum unit : units)
    bad.push_back([&form, unit](gl::Case& c) {
      c.ActiveTexture(unit);
      define(c, legal_map<Map2>(form.target), form.doubles);
      c.ActiveTexture(GL_TEXTURE0);  // the queries that follow are of unit 0 again
    });
  expect_refused(t, "TEXTURE1 and the last unit active", bad, {GL_INVALID_OPERATION});

  expect_active_texture_decides<Map2>(t, form);
};

EVALCTS_TEST(Map2Errors, ActiveTextureOfPopAttrib, must, "EV-MAP2-ERR-ACTIVETEX",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_popped_texture_decides<Map2>(t, form.doubles,
                                      {GL_MAP2_VERTEX_3, GL_MAP2_TEXTURE_COORD_2, GL_MAP2_INDEX});
};

}  // namespace evalcts::suite_map_errors_of_units
