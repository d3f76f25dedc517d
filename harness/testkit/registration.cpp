// The registry of tests. Combines the parameters of a test with its deliveries, and derives names,
// requirements and depths.
#include <evalcts/testkit/registration.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <tuple>

#include <evalcts/gl/lift.h>
#include <evalcts/gl/tokens.h>
#include "schedule.h"

namespace evalcts {
namespace {

// A test with one combination of its parameters, and its deliveries. all_tests() makes a test for each
// delivery when it is called, because most processes of a run do not need thousands of tests.
struct Registered {
  TestInfo info;  // its name does not contain the parameters
  std::array<std::string, 2> parameters;
  std::shared_ptr<const std::vector<gl::Delivery>> deliveries;  // may be empty
};

std::vector<Registered>& registry() {
  static std::vector<Registered> tests;
  return tests;
}

// The tests of replace_tests(); empty: all_tests() returns the registered tests.
std::vector<TestInfo>& replacing_tests() {
  static std::vector<TestInfo> tests;
  return tests;
}

std::map<std::string, std::string>& lifted_suites() {
  static std::map<std::string, std::string> suites;
  return suites;
}

// Requirements for one dimension, and the requirement that lifted tests decide instead.
constexpr std::pair<const char*, const char*> kInTwoDimensions[] = {
    {"EV-MAP1-BEZIER", "EV-MAP2-BEZIER"},       {"EV-MAP1-COMPORDER", "EV-MAP2-BEZIER"},
    {"EV-MAP1-DOMAIN", "EV-MAP2-DOMAIN"},       {"EV-MAP1-EXTRAPOLATE", "EV-MAP2-EXTRAPOLATE"},
    {"EV-MAP1-ORDER-ONE", "EV-MAP2-ORDER-ONE"}, {"EV-MAP1-PADDING", "EV-MAP2-PADDING"},
    {"EV-MAP1-REVERSED", "EV-MAP2-REVERSED"},   {"EV-MAP1-STRIDE", "EV-MAP2-ADDRESS"},
    {"EV-MAP1-ZEROPOW", "EV-MAP2-BEZIER"}};

// Returns the requirements that a test decides if it is lifted to two dimensions.
std::vector<RequirementId> in_two_dimensions(const std::vector<RequirementId>& of_one) {
  std::vector<RequirementId> of_two;
  for (RequirementId requirement : of_one) {
    const auto counterpart =
        std::ranges::find(kInTwoDimensions, requirement.id, &std::pair<const char*, const char*>::first);
    if (requirement.dimension == 1) {
      requirement.dimension = 2;
    } else if (counterpart != std::end(kInTwoDimensions)) {
      requirement = counterpart->second;
    } else {
      continue;
    }
    if (std::ranges::count(of_two, requirement) == 0) of_two.push_back(requirement);
  }
  return of_two;
}

// Returns the requirement that a test decides if it goes through display lists.
const char* requirement_of(gl::Lists lists) {
  switch (lists) {
    case gl::Lists::kExecuted:
      return "EV-DL-COMPEXEC";
    case gl::Lists::kNested:
      return "EV-DL-NESTED";
    case gl::Lists::kRepeated:
      return "EV-DL-REPEAT";
    case gl::Lists::kSplit:
      return "EV-DL-SPLIT";
    default:
      return "EV-DL-EXECUTE";
  }
}

std::string joined(std::initializer_list<std::string> parts) {
  std::string name;
  for (const std::string& part : parts)
    if (!part.empty()) name += (name.empty() ? "" : "/") + part;
  return name;
}

// Returns the test through the delivery.
TestInfo delivered(const Registered& test, const gl::Delivery& delivery) {
  TestInfo info = test.info;
  info.parameters = test.parameters[delivery.lifted ? 1 : 0];
  info.delivery = delivery.name;
  info.uses_lists = delivery.lists != gl::Lists::kNone;
  info.name = joined({info.name, info.parameters, info.delivery});
  if (delivery.lifted) {
    const auto suite = lifted_suites().find(info.suite);
    if (suite != lifted_suites().end()) info.suite = suite->second;
    info.requirements = in_two_dimensions(info.requirements);
  }
  if (info.uses_lists) info.requirements.emplace_back(requirement_of(delivery.lists));
  info.body = [&body = test.info.body, &delivery](Test& t) {  // the registry keeps both
    t.deliver_by(delivery);
    body(t);
  };
  return info;
}

void add(const Registered& test, std::vector<TestInfo>& tests) {
  TestInfo undelivered = test.info;
  undelivered.parameters = test.parameters[0];
  undelivered.name = joined({undelivered.name, undelivered.parameters});
  if (test.deliveries->empty()) {
    tests.push_back(std::move(undelivered));
    return;
  }
  const std::vector<Depth> depths =
      Schedule(undelivered.full_name()).of_deliveries(test.info.from, *test.deliveries);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    tests.push_back(delivered(test, (*test.deliveries)[i]));
    tests.back().from = depths[i];
  }
}

// Returns the parts of a name, which '/' separates.
std::vector<std::string_view> parts_of(std::string_view name) {
  std::vector<std::string_view> parts;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.size());
    parts.push_back(name.substr(0, end));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return parts;
}

// Moves tests to quick depth until each suite of the sorted tests has pairwise coverage (see schedule.h).
void add_missing_pairs(std::vector<TestInfo>& tests) {
  for (auto begin = tests.begin(); begin != tests.end();) {
    const auto end =
        std::find_if(begin, tests.end(), [&](const TestInfo& info) { return info.suite != begin->suite; });
    std::vector<Scheduled> suite;
    for (auto test = begin; test != end; ++test)
      suite.push_back(
          {test->name, test->from, parts_of(test->parameters), parts_of(test->delivery), test->uses_lists});
    add_missing_pairs(suite);
    for (const Scheduled& test : suite) (begin++)->from = test.from;
  }
}

}  // namespace

std::string parameter_name(GLenum token, int dimension) {
  const std::string name = gl::token_name(dimension == 2 ? gl::in_two_dimensions(token) : token);
  return name.starts_with("GL_") ? name.substr(3) : name;
}

TestInfo test_info(const std::string& suite, const std::string& name, Level level, const char* file,
                   int line) {
  const std::string path = file;
  TestInfo info{suite, name, {}, level, nullptr};
  info.source = path.substr(std::min(path.rfind("suites/"), path.size())) + ":" + std::to_string(line);
  return info;
}

Registration register_tests(const TestInfo& info, const std::vector<gl::Delivery>& deliveries,
                            std::vector<Variant> variants) {
  const auto shared = std::make_shared<const std::vector<gl::Delivery>>(deliveries);
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.names[0]);
  const std::vector<Depth> depths = Schedule(info.full_name()).of_parameters(names);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    TestInfo test = info;
    test.body = std::move(variants[i].body);
    test.from = depths[i];
    registry().push_back({std::move(test), std::move(variants[i].names), shared});
  }
  return {};
}

Registration lift_suite(const char* of_one, const char* of_two) {
  lifted_suites()[of_one] = of_two;
  return {};
}

void replace_tests(std::vector<TestInfo> tests) { replacing_tests() = std::move(tests); }

const std::vector<TestInfo>& all_tests() {
  if (!replacing_tests().empty()) return replacing_tests();
  static const std::vector<TestInfo> kSorted = [] {
    std::vector<TestInfo> tests;
    std::size_t count = 0;
    for (const Registered& test : registry()) count += std::max<std::size_t>(test.deliveries->size(), 1);
    tests.reserve(count);
    for (const Registered& test : registry()) add(test, tests);
    std::vector<TestInfo*> order;
    for (TestInfo& info : tests) order.push_back(&info);
    std::ranges::sort(order, {}, [](const TestInfo* info) { return std::tie(info->suite, info->name); });
    std::vector<TestInfo> sorted;
    sorted.reserve(order.size());
    for (TestInfo* info : order) sorted.push_back(std::move(*info));
    add_missing_pairs(sorted);
    return sorted;
  }();
  return kSorted;
}

}  // namespace evalcts
