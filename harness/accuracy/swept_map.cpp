// Correctly rounded values, enclosures and magnitudes of a swept map.
#include <evalcts/accuracy/swept_map.h>

#include <cmath>

#include <reference/rounding.h>

namespace evalcts::accuracy {
namespace {

using reference::Argument, reference::Curve, reference::Surface;

std::vector<double> component_of(const SweptMap& map, int component) {
  std::vector<double> points;
  for (std::size_t i = component; i < map.map.points.size(); i += map.map.components)
    points.push_back(map.map.points[i]);
  return points;
}

Surface surface_of(const Map& map, const std::vector<double>& points) {
  return {points.data(), map.vorder, 1, map.uorder, map.vorder, 0, 1, 0, 1};
}

// Control point i of the curve along the swept argument is a curve in the other argument. Returns the control
// points of the latter.
std::vector<double> across(const SweptMap& map, const std::vector<double>& points, int i) {
  std::vector<double> own;
  const int others = map.along_v ? map.map.uorder : map.map.vorder;
  for (int j = 0; j < others; ++j)
    own.push_back(map.along_v ? points[j * map.map.vorder + i] : points[i * map.map.vorder + j]);
  return own;
}

// Returns SUM |B_i(u)| * points[i].
double sum_of_terms(const std::vector<double>& points, double u) {
  const auto order = static_cast<int>(points.size());
  const double s = std::abs(1 - u), t = std::abs(u);
  double sum = points[0], binomial = 1, power = 1;
  for (int i = 1; i < order; ++i) {
    binomial = binomial * (order - i) / i;
    power *= t;
    sum = sum * s + binomial * power * points[i];
  }
  return sum;
}

std::vector<double> absolute(std::vector<double> points) {
  for (double& point : points) point = std::abs(point);
  return points;
}

}  // namespace

SweptMap::SweptMap(std::vector<double> points) {
  map.uorder = static_cast<int>(points.size());
  map.points = std::move(points);
}

SweptPolynomial::SweptPolynomial(const SweptMap& map, int component)
    : along_v_(map.along_v),
      other_(map.other),
      reduced_(true),
      exact_(surface_of(map.map, component_of(map, component))) {
  const std::vector<double> points = component_of(map, component);
  std::vector<double> along;
  const int order = map.along_v ? map.map.vorder : map.map.uorder;
  for (int i = 0; i < order; ++i) {
    const std::vector<double> own = across(map, points, i);
    const Curve curve = {own.data(), 1, static_cast<int>(own.size()), 0, 1};
    const reference::Rational value = reference::evaluate(curve, Argument::coordinate(other_));
    along.push_back(reference::round_to_double(value));
    reduced_ = reduced_ && std::isfinite(along.back()) && reference::Rational(along.back()) == value;
    magnitudes_.push_back(sum_of_terms(absolute(own), other_));
  }
  if (reduced_) {
    const Curve curve = {along.data(), 1, order, 0, 1};
    right_.emplace(curve);
    filter_.emplace(curve);
    line_ = ExactLine::of(along);
  } else {
    right_.emplace(surface_of(map.map, points));
    filter_.emplace(surface_of(map.map, points));
  }
}

std::size_t SweptPolynomial::to_float(const std::vector<double>& u, std::vector<float>& rights) const {
  if (line_ && std::abs(u.front()) <= line_->reach() && std::abs(u.back()) <= line_->reach()) {
    for (std::size_t i = 0; i < u.size(); ++i) rights[i] = line_->to_float(static_cast<float>(u[i]));
    return 0;
  }
  if (reduced_) return right_->to_float({u}, rights);
  const std::vector<double> others(u.size(), other_);
  return along_v_ ? right_->to_float({others}, {u}, rights) : right_->to_float({u}, {others}, rights);
}

void SweptPolynomial::enclose(const std::vector<double>& u,
                              std::vector<reference::Enclosure>& enclosures) const {
  if (reduced_) return filter_->enclose({u}, {}, enclosures);
  const std::vector<double> others(u.size(), other_);
  along_v_ ? filter_->enclose({others}, {u}, enclosures) : filter_->enclose({u}, {others}, enclosures);
}

reference::Evaluation SweptPolynomial::exactly(float u) const {
  return along_v_ ? exact_.evaluate_with_magnitude(Argument::coordinate(other_), Argument::coordinate(u))
                  : exact_.evaluate_with_magnitude(Argument::coordinate(u), Argument::coordinate(other_));
}

double SweptPolynomial::magnitude(double u) const { return sum_of_terms(magnitudes_, u); }

}  // namespace evalcts::accuracy
