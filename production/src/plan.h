// What evaluation needs and nothing else: immutable, shared by reference count, self-contained.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "production/src/allocator.h"
#include "production/src/bernstein.h"
#include "production/src/map.h"
#include "production/src/parameter.h"
#include "production/src/target.h"

struct glev_plan {
 public:
  // Of the enabled one-dimensional maps, those that are not outranked. Null without memory. One reference.
  static glev_plan* Create1(const glev::Allocator& allocator, std::span<const glev::Map, glev::kSlots> maps,
                            std::span<const bool, glev::kSlots> enabled, const glev::Grid& grid);

  void Retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
  void Release() const;

  // 0 without a map.
  int components(glev::Attribute attribute) const { return curve(attribute).components; }
  const glev::Grid& grid() const { return grid_; }

  // All four values of an attribute that has a map, the missing ones (0,0,0,1)'s, rounded to float once.
  // Argument: double or GridArgument.
  template <class Argument>
  void Evaluate(glev::Attribute attribute, const Argument& argument, float* result) const {
    const glev::Curve& c = curve(attribute);
    std::array<double, 4> value = {0, 0, 0, 1};
    glev::Evaluate(c, glev::Locate(c.domain, argument), value.data());
    for (std::size_t k = 0; k < value.size(); ++k) result[k] = static_cast<float>(value[k]);
  }

 private:
  glev_plan(const glev::Allocator& allocator, std::size_t bytes, const glev::Grid& grid)
      : allocator_(allocator), bytes_(bytes), grid_(grid) {}
  const glev::Curve& curve(glev::Attribute attribute) const {
    return curves_[static_cast<std::size_t>(attribute)];
  }

  mutable std::atomic<std::size_t> references_{1};
  glev::Allocator allocator_;
  std::size_t bytes_;  // of the one block that holds the plan and its coefficients
  glev::Grid grid_;
  std::array<glev::Curve, glev::kAttributes> curves_;
};
