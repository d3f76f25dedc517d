#include "fixtures.h"

namespace evalcts {

std::vector<gl::Delivery> in_lists() { return gl::without(gl::kRepetition, gl::list_deliveries()); }

std::vector<gl::Delivery> without_lists() {
  return gl::sparing(gl::without(gl::kLists, gl::curve_deliveries()));
}

void set_current_values(gl::Case& c, const CurrentValues& values) {
  const auto& [color, normal] = values;
  c.Color4f(color[0], color[1], color[2], color[3]);
  c.Normal3f(normal[0], normal[1], normal[2]);
  c.TexCoord4f(5, 6, 7, 8);
}

void evaluate_some(gl::Case& c) {
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.375f, 0.8125f, 1.0f}) c.EvalCoord1f(u);
  c.End();
}

void enable_light(gl::Case& c, const std::vector<float>& position) {
  c.Enable(GL_LIGHTING);
  c.Enable(GL_LIGHT0);
  c.Lightfv(GL_LIGHT0, GL_POSITION, position);
}

void expect_query_refused(Test& t, gl::Case c, gl::Ref query, std::initializer_list<GLenum> allowed) {
  const gl::Ref first = c.GetError(), second = c.GetError();
  Played played = t.play(c);
  played.expect_error(first, allowed);
  played.expect_no_error(second);
  played.expect_nothing_written(query);
}

}  // namespace evalcts
