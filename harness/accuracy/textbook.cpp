// Textbook algorithms, for comparison. On a surface, polynomials in v give the control points of a polynomial
// in u. This file is compiled without contraction, so that the results are the same on every machine with
// IEEE arithmetic.
#include <algorithm>
#include <array>

#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {
namespace {

constexpr int kMaxOrder = 64;

// An algorithm that returns SUM C(n,i) t^i (1-t)^(n-i) R_i, n = order - 1, for the control values `points`.
// It may overwrite `points`.
template <class Real>
using Polynomial = Real (*)(std::span<Real> points, Real t);

template <class Real>
Real de_casteljau(std::span<Real> points, Real t) {
  const Real s = 1 - t;
  for (std::size_t left = points.size() - 1; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) points[i] = s * points[i] + t * points[i + 1];
  return points[0];
}

// Horner's scheme in s = 1 - t; binomial coefficients and powers of t are computed incrementally.
template <class Real>
Real horner(std::span<Real> points, Real t) {
  const Real s = 1 - t;
  const auto order = static_cast<int>(points.size());
  Real sum = points[0], binomial = 1, power = 1;
  for (int i = 1; i < order; ++i) {
    binomial = binomial * static_cast<Real>(order - i) / static_cast<Real>(i);
    power *= t;
    sum = sum * s + binomial * power * points[i];
  }
  return sum;
}

template <class Real>
Real sum_of_terms(std::span<Real> points, Real t) {
  const Real s = 1 - t;
  const auto order = static_cast<int>(points.size());
  std::array<Real, kMaxOrder> power_of_s;
  power_of_s[0] = 1;
  for (int i = 1; i < order; ++i) power_of_s[i] = power_of_s[i - 1] * s;
  Real sum = 0, binomial = 1, power = 1;
  for (int i = 0; i < order; ++i) {
    sum += binomial * power * power_of_s[order - 1 - i] * points[i];
    binomial = binomial * static_cast<Real>(order - 1 - i) / static_cast<Real>(i + 1);
    power *= t;
  }
  return sum;
}

template <class Real>
class Textbook final : public Subject {
 public:
  Textbook(std::string name, Polynomial<Real> polynomial) : polynomial_(polynomial) {
    info_.name = std::move(name);
    info_.max_eval_order = kMaxOrder;
  }
  ImplementationInfo info() const override { return info_; }
  bool has_targets() const override { return false; }

  std::vector<float> evaluate(GLenum, const Map& map, std::span<const float> u,
                              std::span<const float> v) override {
    const int stride = map.components;
    std::vector<float> results(u.size() * static_cast<std::size_t>(stride));
    std::array<Real, kMaxOrder> row, column;
    for (std::size_t a = 0; a < u.size(); ++a) {
      for (int k = 0; k < map.components; ++k) {
        for (int i = 0; i < map.uorder; ++i) {
          for (int j = 0; j < map.vorder; ++j)
            row[j] = static_cast<Real>(map.points[(i * map.vorder + j) * stride + k]);
          column[i] = v.empty() ? row[0]
                                : polynomial_({row.data(), static_cast<std::size_t>(map.vorder)},
                                              fraction(map, v[a], 2));
        }
        results[a * stride + k] = static_cast<float>(
            polynomial_({column.data(), static_cast<std::size_t>(map.uorder)}, fraction(map, u[a], 0)));
      }
    }
    return results;
  }

 private:
  // Returns the fraction of the domain whose ends begin at map.domain[end].
  static Real fraction(const Map& map, float u, std::size_t end) {
    const double first = map.domain[end], last = map.domain[end + 1];
    if (map.segments > 0)
      return static_cast<Real>(grid_index(u, first, last, map.segments)) / static_cast<Real>(map.segments);
    return (static_cast<Real>(u) - static_cast<Real>(first)) /
           (static_cast<Real>(last) - static_cast<Real>(first));
  }

  Polynomial<Real> polynomial_;
  ImplementationInfo info_;
};

}  // namespace

std::unique_ptr<Subject> make_textbook(const std::string& name) {
  if (name == "casteljau-float") return std::make_unique<Textbook<float>>(name, de_casteljau<float>);
  if (name == "casteljau-double") return std::make_unique<Textbook<double>>(name, de_casteljau<double>);
  if (name == "horner-float") return std::make_unique<Textbook<float>>(name, horner<float>);
  if (name == "horner-double") return std::make_unique<Textbook<double>>(name, horner<double>);
  if (name == "sum-float") return std::make_unique<Textbook<float>>(name, sum_of_terms<float>);
  if (name == "sum-double") return std::make_unique<Textbook<double>>(name, sum_of_terms<double>);
  return nullptr;
}

}  // namespace evalcts::accuracy
