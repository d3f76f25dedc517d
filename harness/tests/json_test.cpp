// Tests that JSON values and strings cannot be compared by accident (json.h).
#include <evalcts/results/json.h>

#include <gtest/gtest.h>

namespace evalcts {
namespace {

using nlohmann::json;

template <class A, class B>
constexpr bool kCanBeCompared = requires(const A& a, const B& b) {
  a == b;
}
|| requires(const A& a, const B& b) { a != b; };

static_assert(kCanBeCompared<json, json> && kCanBeCompared<json, int> && kCanBeCompared<json, bool>);
static_assert(!kCanBeCompared<json, std::string> && !kCanBeCompared<std::string, json>);
static_assert(!kCanBeCompared<json, std::string_view> && !kCanBeCompared<std::string_view, json>);
static_assert(!kCanBeCompared<nlohmann::ordered_json, std::string>);

TEST(Json, TextIsThatOfStringsOnly) {
  EXPECT_EQ(as_text(json("pass")), "pass");
  EXPECT_EQ(as_text(nlohmann::ordered_json("pass")), "pass");
  for (const json& value : {json(), json(1), json(true), json::array({"pass"}), json("")})
    EXPECT_EQ(as_text(value), "") << value;
}

}  // namespace
}  // namespace evalcts
