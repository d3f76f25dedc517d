// Tests that JSON values and strings cannot be compared by accident (json.h).
#include <evalcts/results/json.h>

#include <gtest/gtest.h>

namespace evalcts {
namespace {

using nlohmann::json;

template <class A, class B>
constexpr bool can_be_compared = requires(const A& a, const B& b) {
  a == b;
}
|| requires(const A& a, const B& b) { a != b; };

static_assert(can_be_compared<json, json> && can_be_compared<json, int> && can_be_compared<json, bool>);
static_assert(!can_be_compared<json, std::string> && !can_be_compared<std::string, json>);
static_assert(!can_be_compared<json, std::string_view> && !can_be_compared<std::string_view, json>);
static_assert(!can_be_compared<nlohmann::ordered_json, std::string>);

TEST(Json, TextIsThatOfStringsOnly) {
  EXPECT_EQ(as_text(json("pass")), "pass");
  EXPECT_EQ(as_text(nlohmann::ordered_json("pass")), "pass");
  for (const json& value : {json(), json(1), json(true), json::array({"pass"}), json("")})
    EXPECT_EQ(as_text(value), "") << value;
}

}  // namespace
}  // namespace evalcts
