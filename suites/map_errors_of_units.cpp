// Section 5 of the requirements: Map1 and Map2 are errors while a texture unit other than TEXTURE0 is active.

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "rejection.h"

namespace evalcts::suite_map_errors_of_units {
namespace {

Calls in_unit(GLenum unit, const Calls& calls) {
  return [=](gl::Case& c) {
    c.ActiveTexture(unit);
    calls(c);
    c.ActiveTexture(GL_TEXTURE0);  // so that the queries that follow ask unit 0
  };
}

// The unit that is active at the time of the call matters, and a rejected call leaves it active.
EVALCTS_TEST_PAIR(Map1Errors.ActiveTexture, Map2Errors.ActiveTexture, kMust,
                  decide("EV-MAP1-ERR-ACTIVETEX", "EV-MAP2-ERR-ACTIVETEX"),
                  decide("EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"),
                  decide("EV-EXT-MT-RULE/1-D", "EV-EXT-MT-RULE/2-D"),
                  [](bool two) { return combine(target_forms(two)).by(gl::list_deliveries()); })
(Test& t, bool two, const TargetForm& form) {
  require_texture_units(t);
  const Map map = legal_map(form.target);
  std::vector<Calls> bad;
  for (const GLenum unit : {static_cast<GLenum>(GL_TEXTURE1), last_unit(t)})
    bad.push_back(in_unit(unit, defining(map, form.doubles)));
  judge_rejected(t, "TEXTURE1 and the last unit active", bad, two ? Prepared::kEverything : Prepared::kMaps1);

  gl::Case c("TEXTURE1, which stays active, then TEXTURE0");
  c.ActiveTexture(GL_TEXTURE1);
  define(c, map, form.doubles);
  c.GetError();
  c.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1));
  c.ActiveTexture(GL_TEXTURE0);
  define(c, map, form.doubles);
  c.GetError();
  c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(map.orders().size()));
  t.judge(c);
};

// PopAttrib makes the unit active: TEXTURE0 first, so that the definition succeeds, then TEXTURE1.
EVALCTS_TEST_PAIR(Map1Errors.ActiveTextureOfPopAttrib, Map2Errors.ActiveTextureOfPopAttrib, kMust,
                  decide("EV-MAP1-ERR-ACTIVETEX", "EV-MAP2-ERR-ACTIVETEX"),
                  combine(kForms).by(gl::list_deliveries()))
(Test& t, bool two, const Form& form) {
  require_texture_units(t);
  for (const GLenum one : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_INDEX}) {
    const Map map = legal_map(target_in(two, one));
    gl::Case c(label(map.target));
    const auto define_and_ask = [&](int uorder) {
      Map again = map;
      again.uorder = uorder;
      define(c, again, form.doubles);
      c.GetError();
      c.GetMapiv(map.target, GL_ORDER, gl::out<GLint>(map.orders().size()));
    };
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE1);
    c.PopAttrib();
    define_and_ask(map.uorder);
    c.ActiveTexture(GL_TEXTURE1);
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE0);
    c.PopAttrib();
    define_and_ask(5);
    t.judge(c);
  }
};

}  // namespace
}  // namespace evalcts::suite_map_errors_of_units
