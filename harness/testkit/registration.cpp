#include <evalcts/testkit/registration.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include <evalcts/gl/tokens.h>
#include <evalcts/results/hash.h>

namespace evalcts {
namespace {

// Of so many tests one goes through display lists at that depth.
constexpr std::size_t kListsAtQuick = 9, kListsAtFull = 3;

// At most so many parameters of a test at quick depth: if it has no deliveries, if it has, and if they are
// sparing.
constexpr std::size_t kParametersAtQuick = 3, kDeliveredAtQuick = 2, kSparingAtQuick = 1;

// Tests, or, for each, one through each of several deliveries. Those are made when all_tests() is asked for:
// most processes of a run have no use for thousands.
struct Registered {
  TestInfo info;
  std::shared_ptr<const std::vector<gl::Delivery>> deliveries;
};

std::vector<Registered>& registry() {
  static std::vector<Registered> tests;
  return tests;
}

// The least depth of each of `count` tests that differ in a parameter: quick for a few of them, in turn by
// the name of the test, full for the others. The more deliveries each goes through, and the dearer, the
// fewer.
class Turns {
 public:
  Turns(const TestInfo& info, std::size_t count, const std::vector<gl::Delivery>& deliveries) {
    const std::size_t most = deliveries.empty()           ? kParametersAtQuick
                             : deliveries.front().sparing ? kSparingAtQuick
                                                          : kDeliveredAtQuick;
    step_ = (count + most - 1) / most;
    next_ = step_ ? fnv1a<std::uint32_t>(info.full_name()) % step_ : 0;
  }
  Depth next() { return next_++ % step_ == 0 ? Depth::quick : Depth::full; }

 private:
  std::size_t next_ = 0, step_ = 0;
};

// The requirement of two dimensions that a one-dimensional test decides when it is lifted; empty: none.
std::string in_two_dimensions(std::string_view requirement) {
  std::string id(requirement);
  if (id == "EV-COORD-DIM1") return "EV-COORD-DIM2";
  if (id == "EV-MAP1-ZEROPOW" || id == "EV-MAP1-COMPORDER") return "EV-MAP2-BEZIER";
  if (id == "EV-MAP1-STRIDE") return "EV-MAP2-ADDRESS";
  if (id.starts_with("EV-MAP1-")) return id.replace(0, 8, "EV-MAP2-");
  if (id.ends_with("/1-D")) return id.replace(id.size() - 4, 4, "/2-D");
  return {};
}

std::string with_2_for_1(std::string name) {
  for (const auto& [one, two] : {std::pair{"Map1", "Map2"}, std::pair{"MAP1", "MAP2"}})
    for (std::size_t at = name.find(one); at != std::string::npos; at = name.find(one))
      name.replace(at, 4, two);
  return name;
}

// The same characters for the rest of the process.
std::string_view kept(const std::string& text) {
  static std::set<std::string> all;
  return *all.insert(text).first;
}

// What a test decides that goes through display lists.
std::string_view requirement_of(gl::Lists lists) {
  switch (lists) {
    case gl::Lists::executed:
      return "EV-DL-COMPEXEC";
    case gl::Lists::nested:
      return "EV-DL-NESTED";
    case gl::Lists::repeated:
      return "EV-DL-REPEAT";
    case gl::Lists::split:
      return "EV-DL-SPLIT";
    default:
      return "EV-DL-EXECUTE";
  }
}

void add(const TestInfo& info, const std::vector<gl::Delivery>& deliveries, std::vector<TestInfo>& tests) {
  const auto uses_lists = [](const gl::Delivery& delivery) { return delivery.lists != gl::Lists::none; };
  const auto is_other = [&](const gl::Delivery& delivery) {
    return !uses_lists(delivery) && !delivery.is_plain();
  };
  const auto count = [&](const auto& kind) {
    return static_cast<std::size_t>(std::ranges::count_if(deliveries, kind));
  };
  const std::size_t turn = fnv1a<std::uint32_t>(info.full_name()), lists = count(uses_lists),
                    others = count(is_other);
  std::size_t list = 0, other = 0;
  for (const gl::Delivery& delivery : deliveries) {
    TestInfo delivered = info.by(delivery);
    if (uses_lists(delivery)) {
      const bool in_turn = list++ == turn / kListsAtQuick % lists;
      delivered.from = !in_turn                    ? Depth::thorough
                       : turn % kListsAtQuick == 0 ? info.from
                       : turn % kListsAtFull == 0  ? Depth::full
                                                   : Depth::thorough;
    } else if (is_other(delivery) && other++ != turn % others) {
      delivered.from = delivery.sparing ? Depth::thorough : Depth::full;
    }
    tests.push_back(std::move(delivered));
  }
}

}  // namespace

TestInfo TestInfo::by(const gl::Delivery& delivery) const {
  TestInfo delivered = *this;
  if (!delivery.name.empty()) delivered.name += "/" + delivery.name;
  delivered.body = [body = body, delivery](Test& t) {
    t.deliver_by(delivery);
    body(t);
  };
  if (delivery.lifted) delivered.lift();
  if (delivery.lists != gl::Lists::none) delivered.requirements.push_back(requirement_of(delivery.lists));
  return delivered;
}

void TestInfo::lift() {
  suite = with_2_for_1(suite);
  name = with_2_for_1(name);
  const std::vector<std::string_view> of_one = std::exchange(requirements, {});
  for (const std::string_view requirement : of_one) {
    const std::string lifted = in_two_dimensions(requirement);
    if (!lifted.empty() && std::ranges::count(requirements, lifted) == 0)
      requirements.push_back(kept(lifted));
  }
}

std::string parameter_name(GLenum token) {
  const std::string name = gl::token_name(token);
  return name.starts_with("GL_") ? name.substr(3) : name;
}

Registration register_tests(const TestInfo& info, const std::vector<gl::Delivery>& deliveries,
                            std::vector<std::pair<std::string, std::function<void(Test&)>>> bodies) {
  Turns turns(info, bodies.size(), deliveries);
  const auto shared =
      deliveries.empty() ? nullptr : std::make_shared<const std::vector<gl::Delivery>>(deliveries);
  for (auto& [name, body] : bodies) {
    TestInfo test = info;
    test.body = std::move(body);
    if (!name.empty()) {
      test.name += "/" + name;
      test.from = turns.next();
    }
    registry().push_back({std::move(test), shared});
  }
  return {};
}

const std::vector<TestInfo>& all_tests() {
  static const std::vector<TestInfo> sorted = [] {
    std::vector<TestInfo> tests;
    for (const auto& [info, deliveries] : registry()) {
      if (deliveries) {
        add(info, *deliveries, tests);
      } else {
        tests.push_back(info);
      }
    }
    std::ranges::sort(tests, {}, [](const TestInfo& info) { return std::tie(info.suite, info.name); });
    return tests;
  }();
  return sorted;
}

}  // namespace evalcts
