// Section 5 of the requirements: Map1 and Map2 are errors while a texture unit other than TEXTURE0 is active.

#include <evalcts/testkit/registration.h>

#include "checked_case.h"
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
  const auto last_unit = static_cast<GLenum>(GL_TEXTURE0 + t.gl().texture_units - 1);
  std::vector<Calls> bad = {in_unit(GL_TEXTURE1, defining(map, form.doubles))};
  if (t.gl().texture_units > 2) bad.push_back(in_unit(last_unit, defining(map, form.doubles)));
  if (two) {
    expect_rejected(t, "TEXTURE1 and the last unit active", bad, {GL_INVALID_OPERATION});
  } else {
    expect_rejected(t, "TEXTURE1 active", {bad[0]}, {GL_INVALID_OPERATION}, Prepared::kMaps1);
    if (bad.size() > 1)
      expect_rejected(t, "the last unit active", {bad[1]}, {GL_INVALID_OPERATION}, Prepared::kMaps1);
  }

  CheckedCase unit(t, "TEXTURE1 stays active");
  unit.ActiveTexture(GL_TEXTURE1);
  define(unit, map, form.doubles);
  unit.GetError();
  unit.expect_values(unit.GetIntegerv(GL_ACTIVE_TEXTURE, gl::out<GLint>(1)), {GL_TEXTURE1});
  unit.check();

  CheckedCase c(t, "TEXTURE1, then TEXTURE0 active");
  c.ActiveTexture(GL_TEXTURE1);
  c.ActiveTexture(GL_TEXTURE0);
  define(c, map, form.doubles);
  c.expect_no_error();
  c.expect_orders(form.target, map.orders());
  c.check();
};

// PopAttrib makes the unit active: TEXTURE0 first, so that the definition succeeds, then TEXTURE1.
EVALCTS_TEST_PAIR(Map1Errors.ActiveTextureOfPopAttrib, Map2Errors.ActiveTextureOfPopAttrib, kMust,
                  decide("EV-MAP1-ERR-ACTIVETEX", "EV-MAP2-ERR-ACTIVETEX"),
                  combine(kForms).by(gl::list_deliveries()))
(Test& t, bool two, const Form& form) {
  require_texture_units(t);
  for (const GLenum one : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_INDEX}) {
    const Map map = legal_map(target_in(two, one));
    CheckedCase c(t, label(map.target));
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE1);
    c.PopAttrib();
    define(c, map, form.doubles);
    c.expect_no_error();
    c.expect_orders(map.target, map.orders());
    c.ActiveTexture(GL_TEXTURE1);
    c.PushAttrib(GL_TEXTURE_BIT);
    c.ActiveTexture(GL_TEXTURE0);
    c.PopAttrib();
    Map rejected = map;
    rejected.uorder = 5;
    define(c, rejected, form.doubles);
    c.expect_error(GL_INVALID_OPERATION);
    c.expect_orders(map.target, map.orders());
    c.check();
  }
};

}  // namespace
}  // namespace evalcts::suite_map_errors_of_units
