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
#include <string_view>

#include <evalcts/testkit/registration.h>

namespace evalcts {

// The requirement that each of the two tests decides, or null. A requirement that is given to
// EVALCTS_TEST_PAIR without decide() is decided by both tests.
struct Decided {
  const char* one;
  const char* two;
};
constexpr Decided decide(const char* one, const char* two) { return {one, two}; }

template <class One, class Two>
class PairDeclaration {
 public:
  PairDeclaration(One one, Two two) : one_(std::move(one)), two_(std::move(two)) {}

  template <class Body>
  Registration operator<<(Body body) const {
    one_ << [body](Test& t, const auto&... parameters) { body(t, false, parameters...); };
    return two_ << [body](Test& t, const auto&... parameters) { body(t, true, parameters...); };
  }

 private:
  One one_;
  Two two_;
};

// Returns the test info of "Suite.Name", without requirements.
inline TestInfo test_info(std::string_view full_name, Level level) {
  const std::size_t dot = full_name.find('.');
  return {std::string(full_name.substr(0, dot)), std::string(full_name.substr(dot + 1)), {}, level, nullptr};
}

template <class... P>
auto declare_pair(TestInfo one, TestInfo two, const Parameters<P...>& parameters) {
  return PairDeclaration(declare(std::move(one), parameters), declare(std::move(two), parameters));
}
template <std::invocable<bool> Function>
auto declare_pair(TestInfo one, TestInfo two, const Function& parameters_of) {
  return PairDeclaration(declare(std::move(one), parameters_of(false)),
                         declare(std::move(two), parameters_of(true)));
}
template <class... More>
auto declare_pair(TestInfo one, TestInfo two, const Decided& decided, const More&... more) {
  if (decided.one) one.requirements.emplace_back(decided.one);
  if (decided.two) two.requirements.emplace_back(decided.two);
  return declare_pair(std::move(one), std::move(two), more...);
}
template <class... More>
auto declare_pair(TestInfo one, TestInfo two, const char* requirement, const More&... more) {
  return declare_pair(std::move(one), std::move(two), Decided{requirement, requirement}, more...);
}
inline auto declare_pair(TestInfo one, TestInfo two) {
  return declare_pair(std::move(one), std::move(two), Parameters<>());
}

#define EVALCTS_JOIN_EXPANDED(a, b) a##b
#define EVALCTS_JOIN(a, b) EVALCTS_JOIN_EXPANDED(a, b)
// Usage: EVALCTS_TEST_PAIR(Suite.One, Suite.Two, level, decide("ID", "ID")..., parameters)
//        (Test& t, bool two, const P& parameter...) { body };
#define EVALCTS_TEST_PAIR(one, two, level, ...)                                                 \
  [[maybe_unused]] static const ::evalcts::Registration EVALCTS_JOIN(pair_, __COUNTER__) =      \
      ::evalcts::declare_pair(::evalcts::test_info(#one, ::evalcts::Level::level),              \
                              ::evalcts::test_info(#two, ::evalcts::Level::level), __VA_ARGS__) \
      << []

}  // namespace evalcts
