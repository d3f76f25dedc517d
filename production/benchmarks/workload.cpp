// Generates the workloads.
#include "workload.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace evalcts::bench {
namespace {

constexpr std::size_t kArguments = 4096;  // arguments and results fit into the L2 cache

// Random numbers that are the same on every machine. The distributions of the standard library differ between
// libraries; the generator does not.
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}

  float uniform(double low, double high) {
    return static_cast<float>(low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0));
  }
  std::vector<float> uniform(std::size_t count, double low, double high) {
    std::vector<float> result(count);
    for (float& x : result) x = uniform(low, high);
    return result;
  }
  int integer(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<std::uint32_t>(high - low + 1));
  }

 private:
  std::mt19937 generator_;
};

Curve random_curve(int order, int components) {
  Random random(1);
  std::vector<float> points = random.uniform(static_cast<std::size_t>(order) * components, -1, 1);
  return {"Curve/order:" + std::to_string(order) + "/dim:" + std::to_string(components), order, components,
          std::move(points), random.uniform(kArguments, 0, 1)};
}

Mesh random_mesh(int order, int components, int side, int ring, bool normals) {
  Random random(1);
  const std::string name = "Mesh/order:" + std::to_string(order) + "/dim:" + std::to_string(components) +
                           (normals ? "/normals" : "") + (ring == side ? "/array" : "/ring");
  return {
      name, order, components, side,
      side, ring,  normals,    random.uniform(static_cast<std::size_t>(order) * order * components, -1, 1)};
}

// Returns a curve with the same polynomial in three components.
Curve hard_curve(const std::string& kind, const std::vector<double>& coefficients, std::vector<float> u) {
  const int order = static_cast<int>(coefficients.size());
  std::vector<float> points;
  for (const double c : coefficients) points.insert(points.end(), 3, static_cast<float>(c));
  return {"Hard/" + kind + "/order:" + std::to_string(order), order, 3, std::move(points), std::move(u)};
}

// Returns the coefficients of (1 - 2u)^n.
std::vector<double> power(int order) {
  std::vector<double> result(order);
  for (int i = 0; i < order; ++i) result[i] = i % 2 ? -1 : 1;
  return result;
}

std::vector<double> line(int order) {
  std::vector<double> result(order);
  for (int i = 0; i < order; ++i) result[i] = i;
  return result;
}

// Returns the coefficients of the product of u - j/order for j from 1 to order - 1, scaled to a largest
// coefficient of 1. Bernstein coefficients times binomial coefficients multiply like the coefficients of
// ordinary polynomials.
std::vector<double> roots(int order) {
  std::vector<double> scaled = {1};
  for (int j = 1; j < order; ++j) {
    const double root = static_cast<double>(j) / order;
    std::vector<double> next(scaled.size() + 1);
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      next[i] -= root * scaled[i];
      next[i + 1] += (1 - root) * scaled[i];
    }
    scaled = next;
  }
  double binomial = 1, largest = 0;
  for (int i = 0; i < order; ++i) {
    scaled[i] /= binomial;
    binomial *= static_cast<double>(order - 1 - i) / (i + 1);
    largest = std::max(largest, std::abs(scaled[i]));
  }
  for (double& c : scaled) c /= largest;
  return scaled;
}

std::vector<Curve> all_hard_curves() {
  Random random(2);
  const std::vector<float> u = random.uniform(kArguments, 0, 1);
  std::vector<Curve> result;
  for (const int order : {4, 10, 30}) result.push_back(hard_curve("power", power(order), u));
  result.push_back(hard_curve("roots", roots(30), u));

  std::vector<float> dyadic(kArguments);
  for (float& x : dyadic) x = static_cast<float>(random.integer(0, 1024)) / 1024;
  std::vector<double> integers(4);
  for (double& c : integers) c = random.integer(-9, 9);
  result.push_back(hard_curve("integers", integers, dyadic));

  for (const int order : {4, 10, 30}) result.push_back(hard_curve("line", line(order), u));
  std::vector<float> far = random.uniform(12, 0, 2e6);
  result.push_back({"Hard/offset/order:4", 4, 3, std::move(far), u});
  return result;
}

}  // namespace

const std::vector<Curve>& curves() {
  static const std::vector<Curve> kAll = {random_curve(4, 3), random_curve(4, 4), random_curve(10, 3),
                                          random_curve(30, 3)};
  return kAll;
}

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> kAll = {random_mesh(4, 3, 1024, 1024, false),
                                         random_mesh(4, 3, 1024, 16, false),
                                         random_mesh(4, 3, 1024, 16, true), random_mesh(8, 4, 512, 16, false),
                                         random_mesh(30, 4, 512, 16, false)};
  return kAll;
}

const std::vector<Curve>& hard_curves() {
  static const std::vector<Curve> kAll = all_hard_curves();
  return kAll;
}

}  // namespace evalcts::bench
