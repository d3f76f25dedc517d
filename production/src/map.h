// The specification of one map, which Map1 and Map2 set and GetMap returns.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "allocator.h"
#include "parameter.h"
#include "target.h"

namespace glev {

// Arguments of Map1 and Map2 for one direction. Defaults: the v of a one-dimensional map.
struct MapDirection {
  double u1 = 0, u2 = 1;
  glev_int stride = 0;  // in values
  glev_int order = 1;
};

// Copies control points of any strides; see copy_points().
template <int kComponents, class Real>
void copy_spread_points(const MapDirection& u, const MapDirection& v, const Real* points, double* out) {
  // Adjacent values of i are copied together, because they share cache lines if the stride of v is the larger
  // one.
  constexpr std::ptrdiff_t kTogether = 4;
  for (std::ptrdiff_t first = 0; first < u.order; first += kTogether) {
    const std::ptrdiff_t end = std::min<std::ptrdiff_t>(first + kTogether, u.order);
    for (std::ptrdiff_t j = 0; j < v.order; ++j) {
      for (std::ptrdiff_t i = first; i < end; ++i) {
        const Real* const point = points + i * u.stride + j * v.stride;
        for (int k = 0; k < kComponents; ++k) out[(i * v.order + j) * kComponents + k] = point[k];
      }
    }
  }
}

// Copies the control points without padding, v fastest. Point (i, j) begins i * u.stride + j * v.stride
// values after `points`. Floats become doubles of the same value.
template <class Real>
void copy_points(int components, const MapDirection& u, const MapDirection& v, const Real* points,
                 double* out) {
  if (v.stride == components && u.stride == v.order * components) {
    const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(u.order) * u.stride;
    for (std::ptrdiff_t k = 0; k < count; ++k) out[k] = points[k];
    return;
  }
  static constexpr std::array kOf = {copy_spread_points<1, Real>, copy_spread_points<2, Real>,
                                     copy_spread_points<3, Real>, copy_spread_points<4, Real>};
  kOf[static_cast<std::size_t>(components - 1)](u, v, points, out);
}

class Map {
 public:
  Map() = default;
  void free(const Allocator& allocator) { storage_.free(allocator); }

  // Replaces the map. Returns false, and changes nothing, if there is no memory.
  template <class Real>
  bool define(const Allocator& allocator, int components, const MapDirection& u, const MapDirection& v,
              const Real* points) {
    if (!storage_.reserve(allocator, static_cast<std::size_t>(u.order) * v.order * components)) return false;
    copy_points(components, u, v, points, storage_.data());
    defined_ = true;
    order_[0] = u.order;
    order_[1] = v.order;
    domain_[0] = {u.u1, u.u2};
    domain_[1] = {v.u1, v.u2};
    return true;
  }

  // Replaces the map by control points without padding that the caller owns.
  void refer_to(const double* points, int components, std::array<int, 2> order,
                const std::array<Domain, 2>& domain) {
    defined_ = true;
    kept_elsewhere_ = points;
    components_ = components;
    for (int d : {0, 1}) {
      order_[d] = order[d];
      domain_[d] = domain[d];
    }
  }

  // Returns the number of components, which the slot determines unless refer_to() was called.
  int components(int slot) const { return components_ != 0 ? components_ : kSlotTable[slot].components; }
  // Direction 0 is u, 1 is v.
  int order(int direction) const { return order_[direction]; }
  const Domain& domain(int direction) const { return domain_[direction]; }
  // Returns order(0) * order(1) points without padding, v fastest. `slot`: slot of this map, which determines
  // the initial point.
  const double* points(int slot) const {
    if (kept_elsewhere_ != nullptr) return kept_elsewhere_;
    return defined_ ? storage_.data() : kSlotTable[slot].initial.data();
  }

 private:
  bool defined_ = false;
  int order_[2] = {1, 1};
  Domain domain_[2];
  DoubleBuffer storage_;
  const double* kept_elsewhere_ = nullptr;
  int components_ = 0;
};

}  // namespace glev
