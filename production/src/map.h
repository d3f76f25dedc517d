// The specification of one map: what Map1 and Map2 set and GetMap answers.
#pragma once

#include <cstddef>

#include "production/src/allocator.h"
#include "production/src/parameter.h"
#include "production/src/target.h"

namespace glev {

class Map {
 public:
  enum class Type { kFloat, kDouble };

  Map() = default;
  void Free(const Allocator& allocator) { storage_.Free(allocator); }

  // Replaces everything. Point i begins i * stride values after points. False, and nothing changed, without
  // memory.
  template <class Real>
  bool Define(const Allocator& allocator, int components, Domain domain, std::ptrdiff_t stride, int order,
              const Real* points) {
    if (!storage_.Reserve(allocator, static_cast<std::size_t>(order) * components)) return false;
    double* out = storage_.data();
    for (int i = 0; i < order; ++i) {
      for (int k = 0; k < components; ++k) *out++ = points[i * stride + k];
    }
    defined_ = true;
    type_ = sizeof(Real) == sizeof(float) ? Type::kFloat : Type::kDouble;
    order_[0] = order;
    domain_[0] = domain;
    return true;
  }

  // direction 0 is u, 1 is v
  int order(int direction) const { return order_[direction]; }
  const Domain& domain(int direction) const { return domain_[direction]; }
  // What the control points were given as; a float is kept as the double of the same value.
  Type type() const { return type_; }
  // order(0) * order(1) points without padding, v fastest. slot: where this map lives, for its initial point.
  const double* points(int slot) const {
    return defined_ ? storage_.data() : kSlotTable[slot].initial.data();
  }

 private:
  bool defined_ = false;
  Type type_ = Type::kFloat;
  int order_[2] = {1, 1};
  Domain domain_[2];
  DoubleBuffer storage_;
};

}  // namespace glev
