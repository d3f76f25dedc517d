// Implements CheckedCase: adds commands to a case and keeps their checks until the case has run.
#include "checked_case.h"

namespace evalcts {

void CheckedCase::expect_error(GLenum error) {
  const gl::Ref asked = GetError();
  expect([=](CheckedTrace& checked) { checked.expect_error(asked, {error}); });
}

void CheckedCase::expect_error(GLenum one, GLenum other) {
  if (one == other) return expect_error(one);
  const gl::Ref asked = GetError();
  expect([=](CheckedTrace& checked) { checked.expect_error(asked, {one, other}); });
}

void CheckedCase::expect_map(const Map& map, bool doubles) {
  doubles = doubles && can_call(gl::EntryPoint::GetMapdv);
  const MapQuery query = query_map(*this, map.target, t_.max_order(), doubles);
  expect([=](CheckedTrace& checked) { evalcts::expect_map(checked, query, map, doubles); });
}

void CheckedCase::expect_orders(GLenum target, const std::vector<GLint>& orders) {
  expect_values(GetMapiv(target, GL_ORDER, gl::out<GLint>(orders.size())), orders);
}

void CheckedCase::expect_result(gl::Ref command, std::int64_t expected) {
  expect([=](CheckedTrace& checked) { checked.expect_result(command, expected); });
}

void CheckedCase::expect_values_near(gl::Ref query, const std::vector<double>& expected, double relative) {
  expect([=](CheckedTrace& checked) { checked.expect_values_near(query, expected, relative); });
}

void CheckedCase::expect_same(gl::Ref before, gl::Ref after) {
  expect([=](CheckedTrace& checked) { checked.expect_same(before, after); });
}

void CheckedCase::expect_same(const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after) {
  expect([=](CheckedTrace& checked) { evalcts::expect_unchanged(checked, before, after); });
}

CheckedTrace CheckedCase::check() const {
  CheckedTrace checked = t_.play(*this);
  for (const auto& check : checks_) check(checked);
  return checked;
}

}  // namespace evalcts
