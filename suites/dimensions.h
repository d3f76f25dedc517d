// A macro that registers one body as two tests that differ in one choice, usually between one and two
// dimensions or between u and v. The body receives the choice as a bool.
//
//   EVALCTS_TEST_PAIR(Metamorphic.ReversedCurve, Metamorphic.ReversedSurface, kMust,
//                     decide("EV-NUM-SYMMETRY/1-D", "EV-NUM-SYMMETRY/2-D"), by(in_lists()))
//   (Test& t, bool two) { ... };
//
// The parameters are the same for both tests, or returned by a function of the choice:
//
//   EVALCTS_TEST_PAIR(Map1State.EnableUntouched, Map2State.EnableUntouched, kMust, ...,
//                     [](bool two) { return combine(target_forms(two)).by(gl::list_deliveries()); })
//   (Test& t, bool two, const TargetForm& form) { ... };
#pragma once

#include <concepts>
#include <functional>
#include <string>

#include <evalcts/testkit/registration.h>

namespace evalcts {

// The requirement that each of the two tests decides, or null. A requirement that is given to
// EVALCTS_TEST_PAIR without decide() is decided by both tests.
struct Decided {
  const char* one;
  const char* two;
};
constexpr Decided decide(const char* one, const char* two) { return {one, two}; }

template <class... P>
class PairDeclaration {
 public:
  PairDeclaration(TestDeclaration<P...> one, TestDeclaration<P...> two)
      : one_(std::move(one)), two_(std::move(two)) {}

  Registration operator<<(const std::function<void(Test&, bool, const P&...)>& body) const {
    one_ << [body](Test& t, const P&... parameters) { body(t, false, parameters...); };
    return two_ << [body](Test& t, const P&... parameters) { body(t, true, parameters...); };
  }

 private:
  TestDeclaration<P...> one_, two_;
};

// The arguments of EVALCTS_TEST_PAIR after the level, for one of the two tests.
template <class Part>
const Part& part_of(bool /*two*/, const Part& part) {
  return part;
}
inline const char* part_of(bool two, const Decided& decided) { return two ? decided.two : decided.one; }
template <std::invocable<bool> Function>
auto part_of(bool two, const Function& parameters_of) {
  return parameters_of(two);
}
template <class... Parts>
auto declare_pair(const char* one, const char* two, Level level, const char* file, int line, Parts... parts) {
  const auto declare_one_of = [&](bool second) {
    const std::string full_name = second ? two : one;
    const std::size_t dot = full_name.find('.');
    return declare(test_info(full_name.substr(0, dot), full_name.substr(dot + 1), level, file, line),
                   part_of(second, parts)...);
  };
  return PairDeclaration(declare_one_of(false), declare_one_of(true));
}

#define EVALCTS_JOIN_EXPANDED(a, b) a##b
#define EVALCTS_JOIN(a, b) EVALCTS_JOIN_EXPANDED(a, b)
// Usage: EVALCTS_TEST_PAIR(Suite.One, Suite.Two, level, decide("ID", "ID")..., parameters)
//        (Test& t, bool two, const P& parameter...) { body };
#define EVALCTS_TEST_PAIR(one, two, level, ...)                                            \
  [[maybe_unused]] static const ::evalcts::Registration EVALCTS_JOIN(pair_, __COUNTER__) = \
      ::evalcts::declare_pair(#one, #two, ::evalcts::Level::level, __FILE__, __LINE__, __VA_ARGS__) << []

}  // namespace evalcts
