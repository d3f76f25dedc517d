// The parts of a test that each depth leaves out, chosen by the test's name, so that the choice is the same
// in every run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <evalcts/gl/delivery.h>
#include <evalcts/results/depth.h>
#include <evalcts/results/hash.h>

namespace evalcts {

class Schedule {
 public:
  explicit Schedule(std::string_view test) : turn_(fnv1a<std::uint32_t>(test)) {}

  // The least depth of each of `count` tests that differ in a parameter: quick for a few of them, full for
  // the rest. The more deliveries each goes through, and the more expensive they are, the fewer.
  std::vector<Depth> of_parameters(std::size_t count, const std::vector<gl::Delivery>& deliveries) const;

  // The least depth of the test through each of the deliveries; `from` is that of the test itself.
  std::vector<Depth> of_deliveries(Depth from, const std::vector<gl::Delivery>& deliveries) const;

  // True if further captures check what the first one shows of a case with so many primitives: in every test
  // at thorough depth, otherwise in one of 32, and not with many primitives, because another capture of the
  // same case costs a library far more than the case.
  bool is_cross_checked(Depth depth, std::size_t primitives) const;

 private:
  std::uint32_t turn_;
};

}  // namespace evalcts
