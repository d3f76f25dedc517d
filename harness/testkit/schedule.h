// Chooses the parameters and deliveries that each depth runs. The choice depends only on the test's name, so
// that it is the same in every run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/gl/delivery.h>
#include <evalcts/results/depth.h>
#include <evalcts/results/hash.h>

namespace evalcts {

class Schedule {
 public:
  explicit Schedule(std::string_view test) : turn_(fnv1a<std::uint32_t>(test)) {}

  // Returns the least depth of each of the tests that differ in their parameters, which have these names:
  // quick for one of them, or for one of each dimension if the names begin with "1-D" and "2-D"; full for the
  // others.
  std::vector<Depth> of_parameters(const std::vector<std::string>& names) const;

  // Returns the least depth of the test through each of the deliveries; `from` is the least depth of
  // the test itself.
  std::vector<Depth> of_deliveries(Depth from, const std::vector<gl::Delivery>& deliveries) const;

  // True if further captures check the observation of the first capture of a case with this number of
  // primitives: in every test at thorough depth, otherwise in one of 32 tests and only for at most 64
  // primitives, because a capture costs a library far more than the case itself.
  bool is_cross_checked(Depth depth, std::size_t primitives) const;

 private:
  std::uint32_t turn_;
};

// The properties of a test that add_missing_pairs() uses.
struct Scheduled {
  std::string_view name;
  Depth from;
  std::vector<std::string_view> values;    // of the parameters
  std::vector<std::string_view> delivery;  // evaluation command and form of display lists, if any
  bool uses_lists = false;
};
// Moves tests of full depth to quick depth, so that together the tests of quick depth have every value, every
// pair of values of two parameters, every evaluation command and every form of display lists that a test of
// full depth has. A test through display lists covers values only if full depth has them in no other way,
// because libraries may have no lists. `tests`: all tests of a suite, in a fixed order.
void add_missing_pairs(std::vector<Scheduled>& tests);

}  // namespace evalcts
