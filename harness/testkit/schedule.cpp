// Implements Schedule by the hash of the test's name.
#include "schedule.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace evalcts {
namespace {

// At quick and full depth, one of this number of tests goes through display lists.
constexpr std::size_t kListsAtQuick = 9, kListsAtFull = 3;

// Returns the dimension with which the name of a parameter begins, "1-D" for "1-D_U"; empty if there is none.
std::string_view dimension_in(std::string_view name) {
  return name.starts_with("1-D") || name.starts_with("2-D") ? name.substr(0, 3) : std::string_view();
}

bool uses_lists(const gl::Delivery& delivery) { return delivery.lists != gl::Lists::kNone; }
bool is_other(const gl::Delivery& delivery) { return !uses_lists(delivery) && !delivery.is_plain(); }

}  // namespace

std::vector<Depth> Schedule::of_parameters(const std::vector<std::string>& names) const {
  std::vector<Depth> depths(names.size(), Depth::kFull);
  for (const std::string_view dimension : {"1-D", "2-D", ""}) {
    std::vector<std::size_t> alike;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (dimension_in(names[i]) == dimension) alike.push_back(i);
    if (!alike.empty()) depths[alike[turn_ % alike.size()]] = Depth::kQuick;
  }
  return depths;
}

std::vector<Depth> Schedule::of_deliveries(Depth from, const std::vector<gl::Delivery>& deliveries) const {
  const auto in_turn = [&](auto kind, std::size_t turn) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(deliveries, kind));
    return count > 0 ? turn % count : 0;
  };
  const std::size_t list_in_turn = in_turn(uses_lists, turn_ / kListsAtQuick);
  const std::size_t other_in_turn = in_turn(is_other, turn_);
  const Depth from_with_lists = turn_ % kListsAtQuick == 0  ? from
                                : turn_ % kListsAtFull == 0 ? Depth::kFull
                                                            : Depth::kThorough;
  std::vector<Depth> depths;
  std::size_t list = 0, other = 0;
  for (const gl::Delivery& delivery : deliveries) {
    if (uses_lists(delivery)) {
      depths.push_back(list++ == list_in_turn ? from_with_lists : Depth::kThorough);
    } else if (delivery.is_plain() || other++ == other_in_turn) {
      depths.push_back(from);
    } else {  // no injected fault needs it at full depth for each combination
      depths.push_back(from == Depth::kQuick && !delivery.sparing ? Depth::kFull : Depth::kThorough);
    }
  }
  return depths;
}

bool Schedule::is_cross_checked(Depth depth, std::size_t primitives) const {
  constexpr std::uint32_t kOneOf = 32;
  constexpr std::size_t kManyPrimitives = 64;
  return depth == Depth::kThorough || (turn_ % kOneOf == 0 && primitives <= kManyPrimitives);
}

void add_missing_pairs(std::vector<Scheduled>& tests) {
  // Maps each pair to the tests of quick and full depth that have it. A single value is represented as a pair
  // with the empty text. The third element is true if the test uses no display lists.
  using Pair = std::tuple<std::string_view, std::string_view, bool>;
  std::map<Pair, std::vector<std::size_t>> with_pair;
  std::vector<std::vector<Pair>> pairs(tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const std::vector<std::string_view>& values = tests[i].values;
    if (tests[i].from > Depth::kFull) continue;
    const auto add = [&](std::string_view first, std::string_view second) {
      pairs[i].emplace_back(std::min(first, second), std::max(first, second), false);
      if (!tests[i].uses_lists) pairs[i].emplace_back(std::min(first, second), std::max(first, second), true);
    };
    for (auto second = values.begin(); second != values.end(); ++second) {
      add({}, *second);
      for (auto first = values.begin(); first != second; ++first) add(*first, *second);
    }
    for (const std::string_view part : tests[i].delivery)
      pairs[i].emplace_back(std::string_view(), part, false);
    for (const Pair& pair : pairs[i]) with_pair[pair].push_back(i);
  }
  std::set<Pair> present;
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (tests[i].from == Depth::kQuick) present.insert(pairs[i].begin(), pairs[i].end());
  const auto gain = [&](std::size_t i) {
    return std::ranges::count_if(pairs[i], [&](const Pair& pair) { return !present.contains(pair); });
  };
  for (const auto& [pair, candidates] : with_pair) {
    if (present.contains(pair)) continue;
    // The hash decides between tests that add equally many pairs.
    const std::size_t best = std::ranges::max(candidates, {}, [&](std::size_t i) {
      return std::pair(gain(i), fnv1a<std::uint32_t>(tests[i].name));
    });
    tests[best].from = Depth::kQuick;
    present.insert(pairs[best].begin(), pairs[best].end());
  }
}

}  // namespace evalcts
