// The public classes of the filter: they pass blocks of arguments to the kernels, and undecided values to the
// exact method.
#include <reference/filter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plan.h"

namespace evalcts::reference {
namespace {

constexpr std::size_t kBlock = 256;
static_assert(kBlock % kLanes == 0);

using Block = std::array<double, kBlock>;

// Copies the values and repeats the last one up to a multiple of kLanes, so that no lane reads undefined
// values.
void copy_padded(std::span<const double> values, Block& block) {
  std::copy(values.begin(), values.end(), block.begin());
  std::fill(block.begin() + values.size(), block.begin() + round_up_to_lanes(values.size()), values.back());
}

}  // namespace

struct Filter::Plan {
  Direction map_u, map_v;
  KernelPlan kernel;

  // Calls use(first, count, enclosures) for each block of arguments. `enclosures` is null if domain or grid
  // are outside the limits of the filter.
  template <typename Use>
  void for_each_block(const Arguments& u, const Arguments& v, std::size_t count, Use use) const {
    const bool has_v = !v.values.empty() || map_v.order > 1;
    if (u.values.size() != count || (has_v && v.values.size() != count)) {
      throw std::invalid_argument("as many arguments as results are needed");
    }
    KernelPlan plan = kernel;
    if (u.grid) {
      plan.u = direction_plan(map_u, u.grid);
      plan.u.applies = plan.u.applies && kernel.u.applies;
    }
    if (v.grid && has_v) plan.v = direction_plan(map_v, v.grid);
    const bool applies = plan.u.applies && plan.v.applies;
    alignas(64) Block us, vs{}, high, low, error;
    const EnclosureArrays enclosures{high.data(), low.data(), error.data()};
    for (std::size_t first = 0; first < count; first += kBlock) {
      const std::size_t size = std::min(kBlock, count - first);
      if (applies) {
        copy_padded(u.values.subspan(first, size), us);
        if (has_v) copy_padded(v.values.subspan(first, size), vs);
        enclose_kernel(plan, us.data(), vs.data(), size, enclosures);
      }
      use(first, size, applies ? &enclosures : nullptr);
    }
  }

  template <typename Float, typename Kernel>
  void round(const Arguments& u, const Arguments& v, std::span<Float> results,
             std::span<std::uint8_t> decided, Kernel kernel_function) const {
    if (decided.size() != results.size()) throw std::invalid_argument("as many marks as results are needed");
    alignas(64) std::array<Float, kBlock> rounded;
    alignas(64) Block marks;
    for_each_block(u, v, results.size(),
                   [&](std::size_t first, std::size_t size, const EnclosureArrays* enclosures) {
                     if (enclosures == nullptr) {
                       std::fill_n(decided.begin() + first, size, std::uint8_t{0});
                       return;
                     }
                     kernel_function(*enclosures, kernel.scale, size, rounded.data(), marks.data());
                     std::copy_n(rounded.begin(), size, results.begin() + first);
                     for (std::size_t k = 0; k < size; ++k) decided[first + k] = marks[k] != 0 ? 1 : 0;
                   });
  }
};

Filter::Filter(const Surface& surface)
    : plan_(std::make_unique<Plan>(Plan{surface.u, surface.v, kernel_plan(surface)})) {}
Filter::Filter(Filter&&) noexcept = default;
Filter& Filter::operator=(Filter&&) noexcept = default;
Filter::~Filter() = default;

void Filter::enclose(const Arguments& u, const Arguments& v, std::span<Enclosure> results) const {
  const double scale = plan_->kernel.scale;
  plan_->for_each_block(u, v, results.size(),
                        [&](std::size_t first, std::size_t size, const EnclosureArrays* enclosures) {
                          for (std::size_t k = 0; k < size; ++k) {
                            Enclosure& result = results[first + k];
                            result = {0, 0, std::numeric_limits<double>::infinity()};
                            if (enclosures == nullptr) continue;
                            result.high = enclosures->high[k] * scale;
                            result.low = enclosures->low[k] * scale;
                            // The added term covers underflow when the three numbers are scaled.
                            result.error = enclosures->error[k] * scale + 0x1p-1070;
                            if (!std::isfinite(result.high))
                              result = {0, 0, std::numeric_limits<double>::infinity()};
                          }
                        });
}

void Filter::to_float(const Arguments& u, const Arguments& v, std::span<float> results,
                      std::span<std::uint8_t> decided) const {
  plan_->round(u, v, results, decided, to_float_kernel);
}

void Filter::to_double(const Arguments& u, const Arguments& v, std::span<double> results,
                       std::span<std::uint8_t> decided) const {
  plan_->round(u, v, results, decided, to_double_kernel);
}

namespace {

// Returns the k-th argument.
Argument argument(const Arguments& arguments, std::size_t k) {
  if (!arguments.grid) return Argument::coordinate(arguments.values[k]);
  return Argument::grid(static_cast<std::int64_t>(arguments.values[k]), arguments.grid->segments,
                        arguments.grid->first, arguments.grid->last);
}

// Computes the results that the filter has not decided, by decide(u, v). Returns their number.
template <typename Float, typename Decide>
std::size_t decide_the_rest(const Arguments& u, const Arguments& v, std::span<Float> results,
                            std::span<const std::uint8_t> decided, Decide decide) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (decided[k] != 0) continue;
    ++count;
    results[k] = decide(argument(u, k), v.values.empty() ? Argument() : argument(v, k));
  }
  return count;
}

}  // namespace

CorrectlyRounded::CorrectlyRounded(const Surface& surface) : filter_(surface), exact_(surface) {}

std::size_t CorrectlyRounded::to_float(const Arguments& u, const Arguments& v,
                                       std::span<float> results) const {
  std::vector<std::uint8_t> decided(results.size());
  filter_.to_float(u, v, results, decided);
  return decide_the_rest<float>(
      u, v, results, decided, [this](const Argument& x, const Argument& y) { return exact_.to_float(x, y); });
}

std::size_t CorrectlyRounded::to_double(const Arguments& u, const Arguments& v,
                                        std::span<double> results) const {
  std::vector<std::uint8_t> decided(results.size());
  filter_.to_double(u, v, results, decided);
  return decide_the_rest<double>(u, v, results, decided, [this](const Argument& x, const Argument& y) {
    return exact_.to_double(x, y);
  });
}

}  // namespace evalcts::reference
