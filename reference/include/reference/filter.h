// The exact route for bulk work: an enclosure in double-double arithmetic first, with a proven bound
// (reference/filter/PROOF.md), many arguments at a time, and exact integers where the bound cannot decide.
//
// A map has the same meaning as in bernstein.h, and so have arguments, inside the domain or not. Constructors
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

// The value V lies in |V - (high + low)| <= error. An infinite error says nothing, neither do high and low
// then.
struct Enclosure {
  double high, low;
  double error;
};

// Many arguments along one direction: coordinates, or indices of the points of a grid (Argument::grid()), as
// doubles.
struct Arguments {
  struct Grid {
    std::int64_t segments;
    double first, last;
  };
  std::span<const double> values;
  std::optional<Grid> grid = std::nullopt;
};

// One component of a map.
class Filter {
 public:
  explicit Filter(const Curve& curve);
  explicit Filter(const Surface& surface);
  Filter(Filter&&) noexcept;
  Filter& operator=(Filter&&) noexcept;
  ~Filter();

  // One enclosure for each pair of values. A curve does not look at v. An argument that is not finite makes
  // an infinite error. Throw std::invalid_argument if the sizes differ (v: of surfaces), or if a grid has
  // less than one segment.
  void enclose(const Arguments& u, const Arguments& v, std::span<Enclosure> results) const;

  // The correctly rounded values, as far as the enclosures decide them. decided[k] is 1 or 0; results[k]
  // means nothing where it is 0. Throws as enclose() does.
  void to_float(const Arguments& u, const Arguments& v, std::span<float> results,
                std::span<std::uint8_t> decided) const;
  void to_double(const Arguments& u, const Arguments& v, std::span<double> results,
                 std::span<std::uint8_t> decided) const;

 private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

// The filter and the exact route behind it: round_to_float() and round_to_double() of each value.
class CorrectlyRounded {
 public:
  explicit CorrectlyRounded(const Curve& curve);
  explicit CorrectlyRounded(const Surface& surface);

  // Return how many values the exact route had to decide. Throw as Filter does, and std::domain_error if an
  // argument is not finite.
  std::size_t to_float(const Arguments& u, const Arguments& v, std::span<float> results) const;
  std::size_t to_double(const Arguments& u, const Arguments& v, std::span<double> results) const;
  // Of curves.
  std::size_t to_float(const Arguments& u, std::span<float> results) const {
    return to_float(u, {}, results);
  }
  std::size_t to_double(const Arguments& u, std::span<double> results) const {
    return to_double(u, {}, results);
  }

 private:
  Filter filter_;
  BernsteinForm exact_;
};

// The instruction sets that the filter can use here, the best one first, by Highway's names; the one to use
// from now on (an empty name: the best), for tests and benchmarks. Throws std::invalid_argument if it is not
// one of them.
std::vector<std::string> filter_targets();
void use_filter_target(const std::string& name);

}  // namespace evalcts::reference
