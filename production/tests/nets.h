// Random arrays of patches, for tests of glevEvaluatePatches.
#pragma once

#include <glevaluator.hpp>

#include "batches.h"

namespace glev_tests {

// An array of patches with a random layout, in memory of exactly the required size.
struct Net {
  std::array<int, 2> order = {4, 4};
  int components = 3;
  bool is_double = false;
  std::size_t count = 3;
  std::array<double, 4> domain = {0, 1, 0, 1};
  std::vector<double> values;           // without padding, v fastest
  std::array<std::size_t, 3> stride{};  // strides of v, u and patches, in bytes; 0 as in glev_patches

  std::size_t values_of_patch() const {
    return static_cast<std::size_t>(order[0]) * static_cast<std::size_t>(order[1] * components);
  }
  std::size_t element() const {
    return static_cast<std::size_t>(components) * (is_double ? sizeof(double) : sizeof(float));
  }
  std::array<std::size_t, 3> strides() const {
    const std::size_t v = stride[0] != 0 ? stride[0] : element(),
                      u = stride[1] != 0 ? stride[1] : v * static_cast<std::size_t>(order[1]);
    return {v, u, stride[2] != 0 ? stride[2] : u * static_cast<std::size_t>(order[0])};
  }
  std::size_t bytes() const {
    const auto [v, u, patch] = strides();
    return count == 0 ? 0
                      : (count - 1) * patch + static_cast<std::size_t>(order[0] - 1) * u +
                            static_cast<std::size_t>(order[1] - 1) * v + element();
  }
  void write(unsigned char* to) const {
    const auto [v, u, patch] = strides();
    const double* from = values.data();
    for (std::size_t p = 0; p < count; ++p) {
      for (int i = 0; i < order[0]; ++i) {
        for (int j = 0; j < order[1]; ++j) {
          unsigned char* at =
              to + p * patch + static_cast<std::size_t>(i) * u + static_cast<std::size_t>(j) * v;
          for (int k = 0; k < components; ++k, ++from) {
            const auto single = static_cast<float>(*from);
            if (is_double) std::memcpy(at, from, sizeof *from), at += sizeof *from;
            if (!is_double) std::memcpy(at, &single, sizeof single), at += sizeof single;
          }
        }
      }
    }
  }
  // Returns a component of the control points of a patch, as the library reads them.
  std::vector<double> points_of(std::size_t patch, std::size_t component) const {
    std::vector<double> points;
    for (std::size_t k = component; k < values_of_patch(); k += static_cast<std::size_t>(components)) {
      const double value = values[patch * values_of_patch() + k];
      points.push_back(is_double ? value : static_cast<float>(value));
    }
    return points;
  }
  // Evaluates one attribute of all patches, packed; `points` is the number of points of a patch.
  template <class Real = float>
  std::vector<Real> evaluate(const glev_patch_grid& grid, glev_attribute attribute,
                             std::size_t points) const {
    std::vector<unsigned char> control(bytes()), scratch;
    write(control.data());
    const glev_patches patches = describe(control.data());
    const auto own = static_cast<std::size_t>(attribute == GLEV_ATTRIBUTE_NORMAL ? 3 : components);
    std::vector<Real> results(count * points * own, Real(77));
    const glev_output output = output_to(results, own);
    const glev_attribute_output outputs = {attribute, &output};
    scratch.resize(glevGetPatchScratchSize(&patches, &grid));
    EXPECT_EQ(glevEvaluatePatches(&patches, &grid, &outputs, 1, scratch.data(), scratch.size()),
              GLEV_SUCCESS);
    return results;
  }
  glev_patches describe(const void* points) const {
    glev_patches patches{};
    patches.size = sizeof patches;
    patches.count = count;
    patches.components = static_cast<std::size_t>(components);
    patches.uorder = order[0];
    patches.vorder = order[1];
    patches.type = is_double ? GLEV_DOUBLE : GLEV_FLOAT;
    patches.points = points;
    patches.points_size = bytes();
    patches.v_stride = stride[0];
    patches.u_stride = stride[1];
    patches.patch_stride = stride[2];
    patches.u1 = domain[0], patches.u2 = domain[1], patches.v1 = domain[2], patches.v2 = domain[3];
    return patches;
  }
};

enum class NetData { kRandom, kSymmetric, kDecimal, kDegenerate, kExtreme };

inline Net choose_net(Chance& chance, int most_order, NetData data) {
  Net net;
  net.order = {chance.whole(1, most_order), chance.whole(1, most_order)};
  net.components = chance.whole(1, 4);
  net.is_double = chance.whole(0, 2) == 0;
  net.count = static_cast<std::size_t>(chance.whole(1, 20));
  if (chance.whole(0, 3) == 0) net.domain = {chance.between(-2, 2), chance.between(3, 4), 1, 0};
  if (chance.whole(0, 5) == 0) net.domain = {0, 0, 0, 0};
  const std::size_t values = net.values_of_patch();
  for (std::size_t p = 0; p < net.count; ++p) {
    for (std::size_t k = 0; k < values; ++k) {
      double value = net.is_double ? 4 * chance.next_double() - 2 : chance.between(-2, 2);
      if (data == NetData::kSymmetric) value = chance.whole(-3, 3) * 0.25;
      if (data == NetData::kDecimal) value = static_cast<float>(chance.whole(-300, 300) * 0.01);
      if (data == NetData::kDegenerate) value = k % 5 == 0 ? 0 : static_cast<double>(p);
      if (data == NetData::kExtreme)
        value = chance.one_of({0.0, -0.0, kInfinity, kNaN, 0x1p-149, 0x1p127, -1.5, 3e38, 0x1p-130});
      net.values.push_back(value);
    }
  }
  const auto gap = [&] { return static_cast<std::size_t>(chance.one_of({0, 0, 1, 4, 12})); };
  switch (chance.whole(0, 3)) {
    case 0:  // with padding
      net.stride[0] = net.element() + gap();
      net.stride[1] = net.stride[0] * static_cast<std::size_t>(net.order[1]) + gap();
      net.stride[2] = net.stride[1] * static_cast<std::size_t>(net.order[0]) + gap();
      break;
    case 1:  // u fastest
      net.stride[1] = net.element() + gap();
      net.stride[0] = net.stride[1] * static_cast<std::size_t>(net.order[0]) + gap();
      net.stride[2] = net.stride[0] * static_cast<std::size_t>(net.order[1]) + gap();
      break;
    case 2:  // patches fastest
      net.stride[2] = net.element() + gap();
      net.stride[0] = net.stride[2] * net.count + gap();
      net.stride[1] = net.stride[0] * static_cast<std::size_t>(net.order[1]) + gap();
      break;
  }
  return net;
}

}  // namespace glev_tests
