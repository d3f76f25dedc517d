// Plans: the data that evaluation needs, immutable, shared by reference count, self-contained.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "allocator.h"
#include "bernstein.h"
#include "kernels.h"
#include "map.h"
#include "normal.h"
#include "parameter.h"
#include "prepared_map.h"
#include "target.h"

// One for each dimension: a one-dimensional map is a surface of degree 0 in v.
struct glev_plan {
 public:
  // The state of one dimension.
  struct Source {
    int dimension;
    std::span<const glev::Map, glev::kSlots> maps;
    std::span<const bool, glev::kSlots> enabled;
    std::array<glev::Grid, 2> grid;  // u, v
    bool automatic_normals;          // where there is a vertex map
    bool tangents;                   // likewise; automatic normals have them anyway
    const glev::Kernels* kernels;
  };

  // Makes a plan of the enabled maps that are not outranked, with one reference. Null without memory.
  static glev_plan* create(const glev::Allocator& allocator, const Source& source);
  // Makes one in memory of the caller, of bytes_for bytes and aligned to a cache line, which nobody releases.
  static std::size_t bytes_for(const Source& source);
  static glev_plan* create_at(void* memory, const Source& source) {
    return create_at(memory, bytes_for(source), {}, source);
  }

  void retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
  void release() const;
  // The holder of the only reference may change the grid.
  bool has_one_reference() const { return references_.load(std::memory_order_acquire) == 1; }
  void set_grid(const std::array<glev::Grid, 2>& grid) { grid_ = grid; }

  // 0 without a map.
  int components(glev::Attribute attribute) const { return surface(attribute).components; }
  const glev::Surface& surface(glev::Attribute attribute) const { return map(attribute).surface; }
  const glev::PreparedMap& map(glev::Attribute attribute) const {
    return maps_[static_cast<std::size_t>(attribute)];
  }

  bool has_vertices_only() const { return has_vertices_only_; }
  // Evaluates one call after another; null where there is more than vertices to evaluate, or that is no way.
  glev::EvaluatesDirectly direct() const { return direct_; }
  // The map of cubics for that function.
  const glev::DirectMap& direct_map() const { return direct_map_; }
  // Normals are computed from the vertex map; there is no normal map then.
  bool automatic_normals() const { return automatic_normals_; }
  // The derivative of the vertex map by the normalised coordinate of a direction, without the factor degree.
  // Absent in a direction of degree 0, where it is zero.
  const glev::Surface& tangent(int direction) const { return tangents_[direction]; }
  // The bounds of automatic normals.
  const glev::NormalBounds& normal_bounds() const { return normal_bounds_; }
  // The derivative by u or v is that times this.
  double tangent_factor(int direction) const;
  // 0 without tangents.
  std::size_t tangent_components() const {
    return dimension_ == 2 ? components(glev::Attribute::kVertex) : 0;
  }

  int dimension() const { return dimension_; }

  const glev::Grid& grid(int direction) const { return grid_[direction]; }
  const glev::Kernels& kernels() const { return *kernels_; }

 private:
  static glev_plan* create_at(void* memory, std::size_t bytes, const glev::Allocator& allocator,
                              const Source& source);
  glev_plan(const glev::Allocator& allocator, std::size_t bytes, const Source& source)
      : allocator_(allocator),
        bytes_(bytes),
        dimension_(source.dimension),
        grid_(source.grid),
        kernels_(source.kernels) {}

  mutable std::atomic<std::size_t> references_{1};
  glev::Allocator allocator_;
  std::size_t bytes_;  // of the one block that holds the plan and its coefficients
  int dimension_;
  std::array<glev::Grid, 2> grid_;
  const glev::Kernels* kernels_;
  std::array<glev::PreparedMap, glev::kAttributes> maps_;
  glev::DirectMap direct_map_;
  glev::EvaluatesDirectly direct_ = nullptr;
  bool automatic_normals_ = false, has_vertices_only_ = false;
  std::array<glev::Surface, 2> tangents_;
  glev::NormalBounds normal_bounds_;
};

namespace glev {

// Writes four values of an attribute that has a map, correctly rounded; components that the map does not have
// are those of (0, 0, 0, 1). Needs the default floating-point environment.
inline void values_at(const glev_plan& plan, Attribute attribute, const GridArgument& u,
                      const GridArgument& v, float* values) {
  const PreparedMap& map = plan.map(attribute);
  plan.kernels().point(map, u, v, values);
  for (int k = map.surface.components; k < 4; ++k) values[k] = k == 3 ? 1 : 0;
}

}  // namespace glev
