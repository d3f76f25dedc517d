// A case with the checks on its answers, each written where its command is.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "maps.h"

namespace evalcts {

// Commands are recorded as in any case. What is expected of their answers is recorded with them; check()
// runs the case and checks in the order of recording.
class CheckedCase : public gl::Case {
 public:
  CheckedCase(Test& t, std::string identity) : gl::Case(std::move(identity)), t_(t) {}
  // Goes on after these commands.
  CheckedCase(Test& t, gl::Case commands) : gl::Case(std::move(commands)), t_(t) {}

  // The checks that are recorded from now on decide these requirements, see Test::decide.
  void decide(std::vector<RequirementId> requirements) {
    expect([&t = t_, requirements = std::move(requirements)](Played&) { t.decide(requirements); });
  }

  // Records GetError, which gives this, or one of both.
  void expect_error(GLenum error);
  void expect_error(GLenum one, GLenum other);
  void expect_no_error() { expect_error(GL_NO_ERROR); }
  // Records IsEnabled.
  void expect_enabled(GLenum cap, bool on) { expect_result(IsEnabled(cap), on); }
  // Records the queries of the map, or of its order, as many as `orders` has.
  void expect_map(const Map& map, bool doubles = false);
  void expect_orders(GLenum target, const std::vector<GLint>& orders);
  // Records the queries of all state; it is what it was.
  std::vector<gl::Ref> query_everything() { return evalcts::query_everything(t_, *this); }
  void expect_unchanged(const std::vector<gl::Ref>& before) { expect_same(before, query_everything()); }

  // The same as for Played.
  void expect_result(gl::Ref command, std::int64_t expected);
  template <class T>
  void expect_values(gl::Ref query, const std::vector<T>& expected) {
    expect([=](Played& played) { played.expect_values(query, expected); });
  }
  void expect_values(gl::Ref query, const std::vector<double>& expected) {
    expect_values<double>(query, expected);
  }
  // To single precision, or as far as `relative` says.
  void expect_values_near(gl::Ref query, const std::vector<double>& expected, double relative = 1e-5);
  void expect_same(gl::Ref before, gl::Ref after);
  void expect_same(const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after);
  // Any other check.
  void expect(std::function<void(Played&)> check) { checks_.push_back(std::move(check)); }

  Played check() const;

 private:
  Test& t_;
  std::vector<std::function<void(Played&)>> checks_;
};

}  // namespace evalcts
