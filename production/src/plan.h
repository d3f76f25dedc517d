// Plans: the data that evaluation needs. They are immutable, reference-counted and self-contained.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "allocator.h"
#include "bernstein.h"
#include "kernels.h"
#include "map.h"
#include "mutation_point.h"
#include "normal.h"
#include "parameter.h"
#include "prepared_map.h"
#include "target.h"

// A plan of one dimension. One-dimensional maps are surfaces of degree 0 in v.
struct glev_plan {
 public:
  // The state of one dimension from which a plan is made.
  struct Source {
    int dimension;
    std::span<const glev::Map, glev::kSlots> maps;
    std::span<const bool, glev::kSlots> enabled;
    std::array<glev::Grid, 2> grid;  // u, v
    bool automatic_normals;          // if there is a vertex map
    bool derivatives;                // if there is a vertex map
    const glev::Kernels* kernels;
  };

  // Makes a plan of the enabled maps that have precedence, with one reference. Returns null if there is no
  // memory.
  static glev_plan* create(const glev::Allocator& allocator, const Source& source);
  // Makes a plan in memory of the caller: bytes_for() bytes, aligned to a cache line. The plan must not be
  // released.
  static std::size_t bytes_for(const Source& source);
  static glev_plan* create_at(void* memory, const Source& source) {
    return create_at(memory, bytes_for(source), {}, source);
  }

  void retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
  void release() const;
  // The owner of the only reference may change the grid.
  bool has_one_reference() const { return references_.load(std::memory_order_acquire) == 1; }
  void set_grid(const std::array<glev::Grid, 2>& grid) { grid_ = grid; }

  // Returns the number of components; 0 without a map.
  int components(glev::Attribute attribute) const { return surface(attribute).components; }
  const glev::Surface& surface(glev::Attribute attribute) const { return map(attribute).surface; }
  const glev::PreparedMap& map(glev::Attribute attribute) const {
    return maps_[static_cast<std::size_t>(attribute)];
  }

  bool has_vertices_only() const { return has_vertices_only_; }
  // Returns the function for consecutive single calls; null if the plan has other attributes than vertices,
  // or if its map cannot be evaluated in this way.
  glev::EvaluatesDirectly direct() const { return direct_; }
  // Returns true if normals are computed from the vertex map. The plan then has no normal map.
  bool automatic_normals() const { return automatic_normals_; }
  // Returns the surface of the derivative by a normalised coordinate, without its factor, if the plan has
  // automatic normals.
  const glev::Surface& tangent(int direction) const { return tangents_[direction]; }
  // Returns the bounds on the errors of automatic normals.
  const glev::NormalBounds& normal_bounds() const { return normal_bounds_; }
  // Returns the control points of the vertex map, v fastest, if the plan has derivatives; otherwise null.
  const double* points() const { return points_; }
  // Returns the number of components of derivatives; 0 if there are none.
  std::size_t derivative_components() const {
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
  std::size_t bytes_;  // size of the block that holds the plan and its coefficients
  int dimension_;
  std::array<glev::Grid, 2> grid_;
  const glev::Kernels* kernels_;
  std::array<glev::PreparedMap, glev::kAttributes> maps_;
  glev::EvaluatesDirectly direct_ = nullptr;
  bool automatic_normals_ = false, has_vertices_only_ = false;
  const double* points_ = nullptr;
  std::array<glev::Surface, 2> tangents_;
  glev::NormalBounds normal_bounds_;
};

namespace glev {

// Writes four values of an attribute that has a map, correctly rounded; components that the map does not have
// are those of (0, 0, 0, 1). Requires the default floating-point environment.
inline void values_at(const glev_plan& plan, Attribute attribute, const GridArgument& u,
                      const GridArgument& v, float* values) {
  const PreparedMap& map = plan.map(attribute);
  GLEV_AT(evaluate_point, plan.kernels().point(map, u, v, values));
  for (int k = map.surface.components; k < 4; ++k) values[k] = k == 3 ? 1 : 0;
}

}  // namespace glev
