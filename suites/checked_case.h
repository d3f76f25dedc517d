// A case whose checks are written next to the commands whose answers they check.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "maps.h"

namespace evalcts {

// Records commands and, with them, checks of their answers. check() runs the case in a fresh context, then
// the checks in the order of recording.
class CheckedCase : public gl::Case {
 public:
  CheckedCase(Test& t, std::string identity) : gl::Case(std::move(identity)), t_(t) {}
  // Begins with these commands, and with their identity.
  CheckedCase(Test& t, gl::Case commands) : gl::Case(std::move(commands)), t_(t) {}

  // See Test.
  bool can_call(gl::EntryPoint command) { return t_.can_call(command); }
  bool can_query_grid(GLenum name) { return t_.can_query_grid(name); }

  // Failures of the checks that are recorded after this call violate these requirements, see Test::decide.
  void decide(std::vector<RequirementId> requirements) {
    expect([&t = t_, requirements = std::move(requirements)](CheckedTrace&) { t.decide(requirements); });
  }

  // Records GetError and expects the error, or one of the two.
  void expect_error(GLenum error);
  void expect_error(GLenum one, GLenum other);
  void expect_no_error() { expect_error(GL_NO_ERROR); }
  // Records IsEnabled and expects its answer.
  void expect_enabled(GLenum cap, bool on) { expect_result(IsEnabled(cap), on); }
  // Records queries of the whole map, or of its orders (one, or two for a two-dimensional target), and
  // expects these answers. Queries floats in place of doubles if GetMapdv is missing, which is recorded as
  // not observed.
  void expect_map(const Map& map, bool doubles = false);
  void expect_orders(GLenum target, const std::vector<GLint>& orders);
  // Records the queries of evalcts::query_everything(); expect_unchanged() expects the same answers as
  // `before`.
  std::vector<gl::Ref> query_everything() { return evalcts::query_everything(t_, *this); }
  void expect_unchanged(const std::vector<gl::Ref>& before) { expect_same(before, query_everything()); }

  // Record the checks of CheckedTrace with the same names.
  void expect_result(gl::Ref command, std::int64_t expected);
  template <class T>
  void expect_values(gl::Ref query, const std::vector<T>& expected) {
    expect([=](CheckedTrace& checked) { checked.expect_values(query, expected); });
  }
  void expect_values(gl::Ref query, const std::vector<double>& expected) {
    expect_values<double>(query, expected);
  }
  // `relative`: the largest accepted relative error; the default is single precision as GL promises it.
  void expect_values_near(gl::Ref query, const std::vector<double>& expected, double relative = 1e-5);
  void expect_same(gl::Ref before, gl::Ref after);
  void expect_same(const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after);
  // Records any other check.
  void expect(std::function<void(CheckedTrace&)> check) { checks_.push_back(std::move(check)); }

  CheckedTrace check() const;

 private:
  Test& t_;
  std::vector<std::function<void(CheckedTrace&)>> checks_;
};

}  // namespace evalcts
