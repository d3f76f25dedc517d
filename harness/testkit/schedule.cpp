// Implements Schedule by the hash of the test's name.
#include "schedule.h"

#include <algorithm>

namespace evalcts {
namespace {

// At quick and full depth, one of this number of tests goes through display lists.
constexpr std::size_t kListsAtQuick = 9, kListsAtFull = 3;

// Maximum number of parameters of a test at quick depth: without deliveries, with deliveries, and with
// sparing ones.
constexpr std::size_t kParametersAtQuick = 3, kDeliveredAtQuick = 2, kSparingAtQuick = 1;

bool uses_lists(const gl::Delivery& delivery) { return delivery.lists != gl::Lists::kNone; }
bool is_other(const gl::Delivery& delivery) { return !uses_lists(delivery) && !delivery.is_plain(); }

}  // namespace

std::vector<Depth> Schedule::of_parameters(std::size_t count,
                                           const std::vector<gl::Delivery>& deliveries) const {
  const std::size_t most = deliveries.empty()           ? kParametersAtQuick
                           : deliveries.front().sparing ? kSparingAtQuick
                                                        : kDeliveredAtQuick;
  const std::size_t step = (count + most - 1) / most;
  std::vector<Depth> depths(count, Depth::kFull);
  for (std::size_t i = 0; i < count; ++i)
    if ((turn_ % step + i) % step == 0) depths[i] = Depth::kQuick;
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
    } else if (is_other(delivery) && other++ != other_in_turn) {
      depths.push_back(delivery.sparing ? Depth::kThorough : Depth::kFull);
    } else {
      depths.push_back(from);
    }
  }
  return depths;
}

bool Schedule::is_cross_checked(Depth depth, std::size_t primitives) const {
  constexpr std::uint32_t kOneOf = 32;
  constexpr std::size_t kManyPrimitives = 64;
  return depth == Depth::kThorough || (turn_ % kOneOf == 0 && primitives <= kManyPrimitives);
}

}  // namespace evalcts
