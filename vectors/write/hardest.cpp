// Searches all floats of an interval for the values closest to a rounding midpoint, except ties.
#include "hardest.h"

#include <reference/filter.h>
#include <reference/rounding.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace evalcts::vectors {
namespace {

using reference::Rational;

// The number of significant bits that a binary64 has more than a binary32, their mask, and the first of them.
constexpr int kExtraBits = 29;
constexpr std::uint64_t kExtra = (std::uint64_t{1} << kExtraBits) - 1,
                        kMiddle = std::uint64_t{1} << (kExtraBits - 1);
// Maximum distance of the nearest binary64 from the midpoint, in ulps of binary64.
constexpr std::int64_t kNear = 1 << 10;

bool is_near(double value) {
  const auto extra = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(value) & kExtra);
  return std::abs(extra - static_cast<std::int64_t>(kMiddle)) <= kNear;
}

// Returns the distance of x from the midpoint of the adjacent binary32, in ulps of binary32.
Rational distance_to_middle(const Rational& x) {
  const double middle =
      std::bit_cast<double>((std::bit_cast<std::uint64_t>(x.to_double()) & ~kExtra) | kMiddle);
  return abs(x - Rational(middle)) / reference::ulp(x);
}

struct Candidate {
  Rational distance;
  float argument;
};

}  // namespace

std::vector<float> hardest_arguments(const reference::Curve& curve, float low, float high,
                                     std::size_t count) {
  constexpr std::size_t kBlock = 4096;
  const reference::Filter filter(curve);
  const reference::BernsteinForm exact(curve);
  std::vector<Candidate> candidates;
  std::array<double, kBlock> arguments;
  std::array<reference::Enclosure, kBlock> enclosures;
  const auto end = std::bit_cast<std::uint32_t>(high);
  for (auto first = std::bit_cast<std::uint32_t>(low); first < end; first += kBlock) {
    const std::size_t size = std::min<std::size_t>(kBlock, end - first);
    for (std::size_t k = 0; k < size; ++k) {
      arguments[k] = std::bit_cast<float>(static_cast<std::uint32_t>(first + k));
    }
    filter.enclose({{arguments.data(), size}}, {}, {enclosures.data(), size});
    for (std::size_t k = 0; k < size; ++k) {
      if (!is_near(enclosures[k].high)) continue;
      const Rational value = exact.evaluate(reference::Argument::coordinate(arguments[k]));
      Rational distance = distance_to_middle(value);
      if (!distance.is_zero()) candidates.push_back({std::move(distance), static_cast<float>(arguments[k])});
    }
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.argument < b.argument;
  });
  std::vector<float> result;
  for (const Candidate& candidate : candidates) {
    if (result.size() == count) break;
    result.push_back(candidate.argument);
  }
  return result;
}

}  // namespace evalcts::vectors
