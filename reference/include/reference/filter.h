// Correctly rounded evaluation for bulk work. An enclosure in double-double arithmetic with a proven bound
// (reference/filter/PROOF.md) is computed for many arguments at a time. If the bound cannot decide, exact
// integers are used.
//
// Maps and arguments, inside or outside the domain, have the same meaning as in bernstein.h. Constructors
// throw std::invalid_argument if an order is outside 1..kMaxOrder, std::domain_error if a domain is empty or
// a domain end or control value is not finite. Const member functions may be called from several threads at
// once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <reference/bernstein_form.h>

namespace evalcts::reference {

// An enclosure of a value V: |V - (high + low)| <= error. If the error is infinite, high and low have no
// meaning.
struct Enclosure {
  double high, low;
  double error;
};

// Many arguments along one direction: coordinates, or indices of grid points (Argument::grid()) as doubles.
struct Arguments {
  struct Grid {
    std::int64_t segments;
    double first, last;
  };
  std::span<const double> values;
  std::optional<Grid> grid = std::nullopt;
};

// The filter for one component of a map.
class Filter {
 public:
  explicit Filter(const Surface& surface);
  Filter(Filter&&) noexcept;
  Filter& operator=(Filter&&) noexcept;
  ~Filter();

  // Computes one enclosure for each pair of arguments; v may be empty if the map is of order 1 in v. A
  // non-finite argument gives an infinite error. Throws std::invalid_argument if the sizes differ, or if a
  // grid has less than one segment.
  void enclose(const Arguments& u, const Arguments& v, std::span<Enclosure> results) const;

  // Compute the correctly rounded values that the enclosures decide. decided[k] is 1, or 0 if results[k] has
  // no meaning. Throw the exceptions of enclose().
  void to_float(const Arguments& u, const Arguments& v, std::span<float> results,
                std::span<std::uint8_t> decided) const;
  void to_double(const Arguments& u, const Arguments& v, std::span<double> results,
                 std::span<std::uint8_t> decided) const;

 private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

// The filter with the exact method behind it: round_to_float() and round_to_double() of each value.
class CorrectlyRounded {
 public:
  explicit CorrectlyRounded(const Surface& surface);

  // Return the number of values that the exact method decided. Throw the exceptions of Filter, and
  // std::domain_error if an argument is not finite.
  std::size_t to_float(const Arguments& u, const Arguments& v, std::span<float> results) const;
  std::size_t to_double(const Arguments& u, const Arguments& v, std::span<double> results) const;

 private:
  Filter filter_;
  BernsteinForm exact_;
};

// For tests and benchmarks. filter_targets() returns Highway's names of the instruction sets that the filter
// can use on this machine, the best one first. use_filter_target() selects one of them; an empty name selects
// the best. Throws std::invalid_argument for any other name.
std::vector<std::string> filter_targets();
void use_filter_target(const std::string& name);

}  // namespace evalcts::reference
