// Registers tests: one for each combination of parameters, each through one or several deliveries.
//
//   EVALCTS_TEST(Map1State, Copy, kMust, "EV-MAP1-COPY")(Test& t) { t.play(...); };
//
//   // "Map1Errors.StrideBelowK/MAP1_VERTEX_3" and so on, each unmodified and through display lists
//   EVALCTS_TEST(Map1Errors, StrideBelowK, kMust, "EV-MAP1-ERR-STRIDE",
//                combine(gl::kMap1Targets).by(gl::list_deliveries()))
//   (Test& t, GLenum target) { ... };
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <evalcts/gl/delivery.h>
#include <evalcts/results/requirement_id.h>
#include <evalcts/testkit/test.h>

namespace evalcts {

// The properties of a registered test, which are known without a run.
struct TestInfo {
  std::string suite;
  std::string name;
  std::vector<RequirementId> requirements;
  Level level;
  std::function<void(Test&)> body;
  Depth from = Depth::kQuick;  // the least depth that runs the test, unless a filter has its exact name
  // The parts of `name` for the parameters and the delivery. Both may be empty.
  std::string parameters = {}, delivery = {};
  bool uses_lists = false;  // true if the delivery does
  std::string source = {};  // see TestRecord

  std::string full_name() const { return suite + "." + name; }
  ListedTest listed() const { return {full_name(), requirements, level, from, source}; }
};

// Returns all tests, sorted by suite and name.
const std::vector<TestInfo>& all_tests();
// Makes all_tests() return these instead of the registered tests. Must be called before it.
void replace_tests(std::vector<TestInfo> tests);

// Returns the name of a parameter in the names of tests about maps of this dimension: "MAP1_VERTEX_3" for a
// token, which becomes "MAP2_VERTEX_3" in two dimensions; otherwise the member `name` of the parameter.
std::string parameter_name(GLenum token, int dimension);
template <class Parameter>
requires requires(const Parameter& p) { p.name; }
std::string parameter_name(const Parameter& parameter, int /*dimension*/) {
  return std::string(parameter.name);
}

// Combinations of parameters, in order, and the deliveries that each goes through.
template <class... P>
class Parameters {
 public:
  using Combination = std::tuple<P...>;

  explicit Parameters(std::vector<Combination> combinations = {}) requires(sizeof...(P) > 0)
      : combinations_(std::move(combinations)) {}
  Parameters() requires(sizeof...(P) == 0) : combinations_(1) {}

  // Returns each combination with each of these values.
  template <class Range>
  auto combine(const Range& values) const {
    return expand([&](const P&...) -> const Range& { return values; });
  }
  // Returns each combination with each of the values that `values_of` returns for the combination.
  template <class Function>
  auto expand(Function values_of) const {
    using Value = std::decay_t<decltype(*std::begin(std::apply(values_of, combinations_.front())))>;
    std::vector<std::tuple<P..., Value>> all;
    for (const Combination& combination : combinations_) {
      const auto& values = std::apply(values_of, combination);
      for (const auto& value : values) all.push_back(std::tuple_cat(combination, std::tuple<Value>(value)));
    }
    Parameters<P..., Value> expanded(std::move(all));
    return std::move(expanded).by(deliveries_);
  }
  // Returns the combinations for which `holds` returns true.
  template <class Function>
  Parameters filter(Function holds) const {
    Parameters kept = *this;
    std::erase_if(kept.combinations_, [&](const Combination& each) { return !std::apply(holds, each); });
    return kept;
  }
  // Makes one test for each delivery. Of each test, quick depth runs one combination, through the plain
  // deliveries and one other delivery without display lists. Full depth runs all combinations in this way,
  // and that of quick depth through all deliveries without display lists, unless they are sparing; thorough
  // depth runs all combinations through all deliveries. Besides, one delivery through display lists runs for
  // every ninth test at quick depth and every third at full depth. A hash of the test's name makes these
  // choices. Further tests are then moved to quick depth until it has pairwise coverage in each suite: every
  // value, every pair of values of two parameters, every evaluation command and every form of display lists
  // that full depth has.
  Parameters by(std::vector<gl::Delivery> deliveries) const {
    Parameters delivered = *this;
    delivered.deliveries_ = std::move(deliveries);
    return delivered;
  }

  const std::vector<Combination>& combinations() const { return combinations_; }
  const std::vector<gl::Delivery>& deliveries() const { return deliveries_; }

 private:
  std::vector<Combination> combinations_;
  std::vector<gl::Delivery> deliveries_;  // empty: only the unmodified case
};

template <class Range>
auto combine(const Range& values) {
  return Parameters<>().combine(values);
}
inline Parameters<> by(std::vector<gl::Delivery> deliveries) {
  return Parameters<>().by(std::move(deliveries));
}

// The type of the variables that EVALCTS_TEST defines: `declaration << body` registers the tests
// and returns it.
struct Registration {};

// A test with one combination of its parameters.
struct Variant {
  std::array<std::string, 2> names;  // names of the parameters in one and in two dimensions; empty: none
  std::function<void(Test&)> body;
};
Registration register_tests(const TestInfo& info, const std::vector<gl::Delivery>& deliveries,
                            std::vector<Variant> variants);

// Makes lifted tests (deliveries in two dimensions) of the suite `of_one` belong to the suite `of_two`.
// Lifted tests of any other suite stay in their suite.
Registration lift_suite(const char* of_one, const char* of_two);
#define EVALCTS_LIFTED_SUITE(of_one, of_two)                              \
  [[maybe_unused]] static const ::evalcts::Registration of_one##_lifted = \
      ::evalcts::lift_suite(#of_one, #of_two)

// Returns the info of a test without requirements. `file` is a path below the folder suites.
TestInfo test_info(const std::string& suite, const std::string& name, Level level, const char* file,
                   int line);

template <class... P>
class TestDeclaration {
 public:
  using Body = std::function<void(Test&, const P&...)>;

  TestDeclaration(TestInfo info, Parameters<P...> parameters)
      : info_(std::move(info)), parameters_(std::move(parameters)) {}

  Registration operator<<(const Body& body) const {
    std::vector<Variant> variants;
    for (const auto& combination : parameters_.combinations()) {
      Variant& variant = variants.emplace_back();
      for (const int dimension : {1, 2}) {
        std::string& name = variant.names[static_cast<std::size_t>(dimension) - 1];
        std::apply(
            [&](const P&... p) { ((name += (name.empty() ? "" : "/") + parameter_name(p, dimension)), ...); },
            combination);
      }
      variant.body = [body, combination](Test& t) {
        std::apply([&](const P&... p) { body(t, p...); }, combination);
      };
    }
    return register_tests(info_, parameters_.deliveries(), std::move(variants));
  }

 private:
  TestInfo info_;
  Parameters<P...> parameters_;
};

// The arguments of EVALCTS_TEST after the level: requirement IDs, optionally followed by parameters.
inline void add_requirement(TestInfo& info, const char* requirement_or_null) {
  if (requirement_or_null) info.requirements.emplace_back(requirement_or_null);
}
template <class... P>
void add_requirement(TestInfo& /*info*/, const Parameters<P...>& /*parameters*/) {}
inline Parameters<> parameters_in() { return {}; }
template <class... P>
Parameters<P...> parameters_in(const Parameters<P...>& parameters) {
  return parameters;
}
template <class... More>
auto parameters_in(const char* /*requirement*/, const More&... more) {
  return parameters_in(more...);
}
// By value, so that literals of different lengths share an instantiation.
template <class... Parts>
auto declare(TestInfo info, Parts... parts) {
  (add_requirement(info, parts), ...);
  return TestDeclaration(std::move(info), parameters_in(parts...));
}

// Defines and registers tests:
// EVALCTS_TEST(suite, name, level, "ID"..., parameters)(Test& t, const P& parameter...) { body };
#define EVALCTS_TEST(suite, name, level, ...)                                                              \
  [[maybe_unused]] static const ::evalcts::Registration suite##_##name =                                   \
      ::evalcts::declare(::evalcts::test_info(#suite, #name, ::evalcts::Level::level, __FILE__, __LINE__), \
                         __VA_ARGS__)                                                                      \
      << []

}  // namespace evalcts
