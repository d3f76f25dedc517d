// Bernstein polynomials in float with compile-time order and number of components. The compiler vectorizes
// the loops over arguments. This file is compiled for the machine, with -O3.
#include <array>
#include <cmath>
#include <cstddef>

#include "models.h"
#include "side.h"

namespace evalcts::bench {
namespace {

template <int kOrder>
constexpr std::array<float, kOrder> kBinomials = [] {
  std::array<float, kOrder> result{};
  double binomial = 1;
  for (int i = 0; i < kOrder; ++i) {
    result[i] = static_cast<float>(binomial);
    binomial = binomial * (kOrder - 1 - i) / (i + 1);
  }
  return result;
}();

// GCC needs a pragma to unroll loops of 30 iterations, and does not vectorize outer loops.
template <int kOrder, int kComponents>
void evaluate(const float* __restrict points, const float* __restrict u, std::size_t count,
              float* __restrict results) {
  for (std::size_t i = 0; i < count; ++i) {
    const float t = u[i], s = 1 - t;
    float sum[kComponents], power = 1;
    for (int k = 0; k < kComponents; ++k) sum[k] = points[k];
#pragma GCC unroll 64
    for (int j = 1; j < kOrder; ++j) {
      power *= t;
      const float weight = power * kBinomials<kOrder>[j];
#pragma GCC unroll 4
      for (int k = 0; k < kComponents; ++k) sum[k] = sum[k] * s + weight * points[j * kComponents + k];
    }
    for (int k = 0; k < kComponents; ++k) results[i * kComponents + k] = sum[k];
  }
}

// Returns the value of each Bernstein polynomial at t.
template <int kOrder>
std::array<float, kOrder> basis(float t) {
  std::array<float, kOrder> result;
  float power = 1;
  for (int j = 0; j < kOrder; ++j, power *= t) result[j] = power * kBinomials<kOrder>[j];
  power = 1;
  for (int j = kOrder - 1; j >= 0; --j, power *= 1 - t) result[j] *= power;
  return result;
}

template <int kOrder>
std::array<float, kOrder> derivatives(float t) {
  const std::array<float, kOrder - 1> lower = basis<kOrder - 1>(t);
  std::array<float, kOrder> result{};
  for (int j = 0; j < kOrder - 1; ++j) {
    result[j] -= lower[j];
    result[j + 1] += lower[j];
  }
  return result;
}

// Computes the control points of the curve of one row.
template <int kOrder, int kComponents>
void contract(const float* points, const std::array<float, kOrder>& weights, float* curve) {
  for (int i = 0; i < kOrder * kComponents; ++i) curve[i] = 0;
  for (int j = 0; j < kOrder; ++j) {
    for (int i = 0; i < kOrder * kComponents; ++i)
      curve[i] += weights[j] * points[j * kOrder * kComponents + i];
  }
}

// Computes a bicubic row of positions and unit normals, from the values and derivatives of the polynomials in
// u at each column.
void normals(const float* __restrict p, const float* __restrict q, const float* __restrict values,
             const float* __restrict slopes, std::size_t columns, float* __restrict results) {
  for (std::size_t i = 0; i < columns; ++i) {
    float at[3] = {}, along_u[3] = {}, along_v[3] = {};
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      const float b = values[j * columns + i], d = slopes[j * columns + i];
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k) {
        at[k] += b * p[3 * j + k];
        along_u[k] += d * p[3 * j + k];
        along_v[k] += b * q[3 * j + k];
      }
    }
    const float x = along_u[1] * along_v[2] - along_u[2] * along_v[1];
    const float y = along_u[2] * along_v[0] - along_u[0] * along_v[2];
    const float z = along_u[0] * along_v[1] - along_u[1] * along_v[0];
    const float scale = 1 / std::sqrt(x * x + y * y + z * z);
    for (int k = 0; k < 3; ++k) results[6 * i + k] = at[k];
    results[6 * i + 3] = x * scale;
    results[6 * i + 4] = y * scale;
    results[6 * i + 5] = z * scale;
  }
}

MeshSide with_normals(const Mesh& mesh) {
  const std::size_t columns = mesh.columns;
  std::vector<float> values(4 * columns), slopes(4 * columns);
  for (std::size_t i = 0; i < columns; ++i) {
    const std::array<float, 4> b = basis<4>(mesh.u(static_cast<int>(i)));
    const std::array<float, 4> d = derivatives<4>(mesh.u(static_cast<int>(i)));
    for (std::size_t j = 0; j < 4; ++j) {
      values[j * columns + i] = b[j];
      slopes[j * columns + i] = d[j];
    }
  }
  return [&mesh, values, slopes, columns](int row, int rows, float* results) {
    for (int j = row; j < row + rows; ++j, results += columns * 6) {
      float p[12], q[12];
      contract<4, 3>(mesh.points.data(), basis<4>(mesh.v(j)), p);
      contract<4, 3>(mesh.points.data(), derivatives<4>(mesh.v(j)), q);
      normals(p, q, values.data(), slopes.data(), columns, results);
    }
  };
}

constexpr char kSide[] = "constant_order";

template <int kOrder, int kComponents>
void add_order() {
  for (const Curve& curve : curves()) {
    if (curve.order != kOrder || curve.components != kComponents) continue;
    add(curve, kSide, [&curve]() -> CurveSide {
      return [&curve](float* results) {
        evaluate<kOrder, kComponents>(curve.points.data(), curve.u.data(), curve.u.size(), results);
      };
    });
  }
  for (const Mesh& mesh : meshes()) {
    if (mesh.order != kOrder || mesh.components != kComponents || mesh.normals) continue;
    add(mesh, kSide, Unit::kMesh, [&mesh]() -> MeshSide {
      std::vector<float> u(mesh.columns);
      for (int i = 0; i < mesh.columns; ++i) u[i] = mesh.u(i);
      return [&mesh, u](int row, int rows, float* results) {
        for (int j = row; j < row + rows; ++j, results += mesh.columns * kComponents) {
          float curve[kOrder * kComponents];
          contract<kOrder, kComponents>(mesh.points.data(), basis<kOrder>(mesh.v(j)), curve);
          evaluate<kOrder, kComponents>(curve, u.data(), u.size(), results);
        }
      };
    });
  }
}

// The basis at the points of the grid is computed once, like a plan. If `with_map`, it is computed for each
// patch.
template <int kOrder>
PatchSide patch_side(const Model& model, bool with_map) {
  const auto points = static_cast<std::size_t>(model.segments) + 1;
  struct Places {
    std::vector<float> u;
    std::vector<std::array<float, kOrder>> v;
  };
  const auto place = [points](Places& places) {
    for (std::size_t i = 0; i < points; ++i) {
      places.u[i] = static_cast<float>(i) / static_cast<float>(points - 1);
      places.v[i] = basis<kOrder>(places.u[i]);
    }
  };
  Places known = {std::vector<float>(points), std::vector<std::array<float, kOrder>>(points)};
  place(known);
  return [&model, with_map, place, places = std::move(known)](std::size_t patch, float* results) mutable {
    if (with_map) place(places);
    for (const std::array<float, kOrder>& weights : places.v) {
      float curve[kOrder * 3];
      contract<kOrder, 3>(model.patches[patch].data(), weights, curve);
      evaluate<kOrder, 3>(curve, places.u.data(), places.u.size(), results);
      results += places.u.size() * 3;
    }
  };
}

// Evaluates a block of ManyPatches, whose control points have v fastest.
void evaluate_block(const float* points, float* results) {
  constexpr std::size_t kPoints = ManyPatches::kSegments + 1;
  static const auto kPlaces = [] {
    std::array<std::array<float, 4>, kPoints> places;
    for (std::size_t i = 0; i < kPoints; ++i)
      places[i] = basis<4>(static_cast<float>(i) / static_cast<float>(kPoints - 1));
    return places;
  }();
  static const auto kU = [] {
    std::array<float, kPoints> u;
    for (std::size_t i = 0; i < kPoints; ++i) u[i] = static_cast<float>(i) / static_cast<float>(kPoints - 1);
    return u;
  }();
  for (std::size_t p = 0; p < ManyPatches::kBlock; ++p, points += ManyPatches::kValues) {
    for (const std::array<float, 4>& weights : kPlaces) {
      float curve[12];
      for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) {
          float sum = 0;
          for (int j = 0; j < 4; ++j)
            sum += weights[static_cast<std::size_t>(j)] * points[(4 * i + j) * 3 + k];
          curve[3 * i + k] = sum;
        }
      }
      evaluate<4, 3>(curve, kU.data(), kPoints, results);
      results += kPoints * 3;
    }
  }
}

[[maybe_unused]] const bool kRegistered = [] {
  add_many_patches(kSide, [] { return evaluate_block; });
  for (const Model& model : models()) {
    for (const bool with_map : {false, true}) {
      add(model, with_map ? "constant_order_with_map" : kSide, [&model, with_map] {
        return model.order == 2 ? patch_side<2>(model, with_map) : patch_side<4>(model, with_map);
      });
    }
  }
  add_order<4, 3>();
  add_order<4, 4>();
  add_order<8, 4>();
  add_order<10, 3>();
  add_order<30, 3>();
  add_order<30, 4>();
  for (const Mesh& mesh : meshes()) {
    if (mesh.normals) add(mesh, kSide, Unit::kMesh, [&mesh] { return with_normals(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
