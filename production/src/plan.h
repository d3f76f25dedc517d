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

// One for each dimension: a one-dimensional map is a surface of degree 0 in v.
struct glev_plan {
 public:
  // The state of one dimension.
  struct Source {
    std::span<const glev::Map, glev::kSlots> maps;
    std::span<const bool, glev::kSlots> enabled;
    std::array<glev::Grid, 2> grid;  // u, v
    bool automatic_normals;          // where there is a vertex map
  };

  // Of the enabled maps, those that are not outranked. Null without memory. One reference.
  static glev_plan* Create(const glev::Allocator& allocator, const Source& source);

  void Retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
  void Release() const;

  // 0 without a map.
  int components(glev::Attribute attribute) const { return surface(attribute).components; }
  const glev::Surface& surface(glev::Attribute attribute) const {
    return surfaces_[static_cast<std::size_t>(attribute)];
  }

  // Normals are computed from the vertex map; there is no normal map then.
  bool automatic_normals() const { return automatic_normals_; }
  // The derivative of the vertex map by the normalised coordinate of a direction, up to a positive factor.
  // Absent in a direction of degree 0, where it is zero.
  const glev::Surface& tangent(int direction) const { return tangents_[direction]; }

  const glev::Grid& grid(int direction) const { return grid_[direction]; }

 private:
  glev_plan(const glev::Allocator& allocator, std::size_t bytes, const std::array<glev::Grid, 2>& grid)
      : allocator_(allocator), bytes_(bytes), grid_(grid) {}

  mutable std::atomic<std::size_t> references_{1};
  glev::Allocator allocator_;
  std::size_t bytes_;  // of the one block that holds the plan and its coefficients
  std::array<glev::Grid, 2> grid_;
  std::array<glev::Surface, glev::kAttributes> surfaces_;
  bool automatic_normals_ = false;
  std::array<glev::Surface, 2> tangents_;
};
