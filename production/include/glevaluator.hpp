// A header-only C++20 interface to glevaluator.h: owners of contexts and plans, and spans instead of pointers
// with sizes. It throws no exceptions and needs neither exceptions nor run-time type information. Functions
// return the glev_result of the functions in glevaluator.h, which documents arguments, values and errors;
// glevGetResultString names a result. If they cannot allocate memory, they return OUT_OF_MEMORY.
#ifndef GLEVALUATOR_HPP_
#define GLEVALUATOR_HPP_

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include <glevaluator.h>

namespace glevaluator {

// The types of values, and their tokens GLEV_FLOAT and GLEV_DOUBLE.
template <class T>
concept Real = std::is_same_v<T, float> || std::is_same_v<T, double>;
template <Real T>
inline constexpr glev_enum kTypeOf = std::is_same_v<T, float> ? GLEV_FLOAT : GLEV_DOUBLE;

// Owns an object of the library. If it could not be made, get() is null and result() is the reason.
template <class Object, class Release>
class Owner {
 public:
  glev_result result() const noexcept { return object_ != nullptr ? GLEV_SUCCESS : reason_; }
  explicit operator bool() const noexcept { return object_ != nullptr; }
  Object* get() const noexcept { return object_.get(); }

 protected:
  Owner() noexcept = default;
  // `make` writes the object and returns the result.
  template <class Make>
  explicit Owner(const Make& make) noexcept {
    Object* object = nullptr;
    const glev_result result = make(&object);
    object_.reset(object);
    if (object == nullptr) reason_ = result;
  }

 private:
  std::unique_ptr<Object, Release> object_;
  glev_result reason_ = GLEV_ERROR_INVALID_ARGUMENT;
};

struct DestroyContext {
  void operator()(glev_context* context) const noexcept { glevDestroyContext(context); }
};
class Context : public Owner<glev_context, DestroyContext> {
 public:
  explicit Context(const glev_context_info* info = nullptr) noexcept
      : Owner([&](glev_context** context) { return glevCreateContext(info, context); }) {}
};

struct ReleasePlan {
  void operator()(glev_plan* plan) const noexcept { glevReleasePlan(plan); }
};
// A reference to a plan; copies share the plan.
class Plan : public Owner<glev_plan, ReleasePlan> {
 public:
  Plan() noexcept = default;
  // Makes a plan of the maps of one dimension, 1 or 2 (glevCreatePlan).
  Plan(const Context& context, std::size_t dimension) noexcept
      : Owner([&](glev_plan** plan) {
          if (!context) return GLEV_ERROR_INVALID_ARGUMENT;
          glev_plan_info info{};
          info.size = sizeof info;
          info.dimension = dimension;
          return glevCreatePlan(context.get(), &info, plan);
        }) {}
  // Makes a plan of one map, without a context (glevCreatePlanFromMap).
  explicit Plan(const glev_map_info& info) noexcept
      : Owner([&](glev_plan** plan) { return glevCreatePlanFromMap(&info, plan); }) {}

  Plan(const Plan& other) noexcept
      : Owner([&](glev_plan** plan) {
          *plan = other.get();
          if (other) glevRetainPlan(*plan);
          return other.result();
        }) {}
  Plan(Plan&&) noexcept = default;
  Plan& operator=(const Plan& other) noexcept { return *this = Plan(other); }
  Plan& operator=(Plan&&) noexcept = default;

  std::size_t components(glev_attribute attribute) const noexcept {
    return get() == nullptr ? 0 : glevGetPlanComponents(get(), attribute);
  }
};

// Scratch memory that can be reused by consecutive calls. It grows if necessary.
class Scratch {
 public:
  // Returns false if there is no memory.
  bool reserve(std::size_t size) noexcept {
    if (size <= size_) return true;
    memory_.reset(new (std::nothrow) std::byte[size]);
    size_ = memory_ != nullptr ? size : 0;
    return memory_ != nullptr;
  }
  void* data() const noexcept { return memory_.get(); }
  std::size_t size() const noexcept { return size_; }

 private:
  std::unique_ptr<std::byte[]> memory_;
  std::size_t size_ = 0;
};

// The outputs of a call, at most one for each attribute. They refer to memory of the caller.
class Outputs {
 public:
  Outputs() noexcept = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  // Adds a packed array of elements of `components` values.
  template <Real T>
  Outputs& add(glev_attribute attribute, std::span<T> values, std::size_t components) noexcept {
    return add(attribute,
               make(values.data(), values.size_bytes(), components * sizeof(T), components, kTypeOf<T>));
  }
  // Adds a member of an array of structures, such as add(GLEV_ATTRIBUTE_NORMAL, vertices, &Vertex::normal).
  template <class Vertex, Real T, std::size_t kComponents>
  Outputs& add(glev_attribute attribute, std::span<Vertex> vertices,
               T (Vertex::*member)[kComponents]) noexcept {
    if (vertices.empty()) return add(attribute, make(nullptr, 0, sizeof(Vertex), kComponents, kTypeOf<T>));
    auto* const first = reinterpret_cast<std::byte*>(&(vertices.front().*member));
    const auto before = static_cast<std::size_t>(first - reinterpret_cast<std::byte*>(vertices.data()));
    return add(attribute,
               make(first, vertices.size_bytes() - before, sizeof(Vertex), kComponents, kTypeOf<T>));
  }
  // Adds an output of any layout. The call fails if there are more outputs than attributes.
  Outputs& add(glev_attribute attribute, const glev_output& output) noexcept {
    const std::size_t place = count_ < kMost ? count_ : kMost - 1;
    outputs_[place] = output;
    list_[place] = {attribute, &outputs_[place]};
    if (count_ < kMost) ++count_;
    return *this;
  }

  const glev_attribute_output* data() const noexcept { return list_.data(); }
  std::size_t size() const noexcept { return count_; }

 private:
  // One more than the number of attributes: the last output then repeats an attribute, which is an error.
  static constexpr std::size_t kMost = 10;

  static glev_output make(void* data, std::size_t size, std::size_t stride, std::size_t components,
                          glev_enum type) noexcept {
    glev_output output{};
    output.size = sizeof output;
    output.data = data;
    output.data_size = size;
    output.stride = stride;
    output.components = components;
    output.type = type;
    return output;
  }

  std::array<glev_output, kMost> outputs_{};
  std::array<glev_attribute_output, kMost> list_{};
  std::size_t count_ = 0;
};

template <class T>
glev_input make_input(std::span<const T> values) noexcept {
  return values.empty() ? glev_input{} : glev_input{values.data(), values.size_bytes(), sizeof(T)};
}

// ---- Plans

// Calls glevEvaluate with the arguments u and, for plans of dimension 2, as many arguments v.
template <Real T>
[[nodiscard]] glev_result evaluate(const Plan& plan, std::span<const T> u, std::span<const T> v,
                                   const Outputs& outputs,
                                   glev_precision precision = GLEV_CORRECTLY_ROUNDED) noexcept {
  if (!v.empty() && v.size() != u.size()) return GLEV_ERROR_INVALID_ARGUMENT;
  glev_batch batch{};
  batch.size = sizeof batch;
  batch.count = u.size();
  batch.type = kTypeOf<T>;
  batch.precision = precision;
  batch.u = make_input(u);
  batch.v = make_input(v);
  batch.outputs = outputs.data();
  batch.output_count = outputs.size();
  return glevEvaluate(plan.get(), &batch);
}

// Calls glevEvaluateMesh for the points i1 to i2 and j1 to j2 of the grid. Sets the outputs and the scratch
// memory of the mesh.
[[nodiscard]] inline glev_result evaluate_mesh(const Plan& plan, glev_mesh mesh, const Outputs& outputs,
                                               Scratch& scratch) noexcept {
  mesh.size = sizeof mesh;
  mesh.outputs = outputs.data();
  mesh.output_count = outputs.size();
  if (!scratch.reserve(glevGetMeshScratchSize(plan.get(), &mesh))) return GLEV_ERROR_OUT_OF_MEMORY;
  mesh.scratch = scratch.data();
  mesh.scratch_size = scratch.size();
  return glevEvaluateMesh(plan.get(), &mesh);
}

// ---- Patches

// Returns patches of uorder * vorder control points without padding, v fastest, as many as the values are
// sufficient for. Callers may then set other strides and domains.
template <Real T>
glev_patches make_patches(std::span<const T> values, std::size_t components, int uorder,
                          int vorder) noexcept {
  glev_patches patches{};
  patches.size = sizeof patches;
  patches.components = components;
  patches.uorder = uorder;
  patches.vorder = vorder;
  patches.type = kTypeOf<T>;
  patches.points = values.data();
  patches.points_size = values.size_bytes();
  if (components >= 1 && components <= 4 && uorder >= 1 && uorder <= 64 && vorder >= 1 && vorder <= 64)
    patches.count = values.size() / (components * static_cast<std::size_t>(uorder * vorder));
  return patches;
}

inline glev_patch_grid make_uniform_grid(int u_segments, int v_segments) noexcept {
  glev_patch_grid grid{};
  grid.size = sizeof grid;
  grid.kind = GLEV_GRID_UNIFORM;
  grid.u_segments = u_segments;
  grid.v_segments = v_segments;
  return grid;
}

// Returns a grid whose edges have their own numbers of segments, in the order v = v1, u = u2, v = v2, u = u1
// (GLEV_GRID_EDGES).
inline glev_patch_grid make_edge_grid(int u_segments, int v_segments,
                                      const std::array<int, 4>& edge_segments) noexcept {
  glev_patch_grid grid = make_uniform_grid(u_segments, v_segments);
  grid.kind = GLEV_GRID_EDGES;
  for (std::size_t edge = 0; edge < 4; ++edge) grid.edge_segments[edge] = edge_segments[edge];
  return grid;
}

template <Real T>
glev_patch_grid make_list_grid(std::span<const T> u, std::span<const T> v) noexcept {
  glev_patch_grid grid{};
  grid.size = sizeof grid;
  grid.kind = GLEV_GRID_LISTS;
  grid.type = kTypeOf<T>;
  grid.u_count = u.size();
  grid.v_count = v.size();
  grid.u = make_input(u);
  grid.v = make_input(v);
  return grid;
}

// Returns a grid with one point for each element of `patch`. The call fails if `u` or `v` is shorter.
template <Real T>
glev_patch_grid make_scattered_grid(std::span<const glev_uint> patch, std::span<const T> u,
                                    std::span<const T> v) noexcept {
  glev_patch_grid grid{};
  grid.size = sizeof grid;
  grid.kind = GLEV_GRID_SCATTERED;
  grid.type = kTypeOf<T>;
  grid.u_count = patch.size();
  grid.u = make_input(u);
  grid.v = make_input(v);
  grid.patch = make_input(patch);
  return grid;
}

[[nodiscard]] inline glev_result evaluate(const glev_patches& patches, const glev_patch_grid& grid,
                                          const Outputs& outputs, Scratch& scratch) noexcept {
  if (!scratch.reserve(glevGetPatchScratchSize(&patches, &grid))) return GLEV_ERROR_OUT_OF_MEMORY;
  return glevEvaluatePatches(&patches, &grid, outputs.data(), outputs.size(), scratch.data(), scratch.size());
}

// ---- Indices

// Returns the triangles of patches of columns * rows points. Callers may then set other modes, windings and
// shared vertices.
inline glev_indices make_indices(std::size_t columns, std::size_t rows, std::size_t patches = 1) noexcept {
  glev_indices indices{};
  indices.size = sizeof indices;
  indices.mode = GLEV_FILL;
  indices.columns = columns;
  indices.rows = rows;
  indices.patches = patches;
  indices.type = GLEV_UNSIGNED_INT;
  return indices;
}

// Returns the triangles of patches that are evaluated on this grid, from make_uniform_grid or make_edge_grid.
inline glev_indices make_indices(const glev_patch_grid& grid, std::size_t patches = 1) noexcept {
  glev_indices indices = make_indices(static_cast<std::size_t>(grid.u_segments) + 1,
                                      static_cast<std::size_t>(grid.v_segments) + 1, patches);
  for (std::size_t edge = 0; edge < 4; ++edge) indices.edge_segments[edge] = grid.edge_segments[edge];
  return indices;
}

template <class Vertex>
void share_vertices(glev_indices& indices, std::span<const Vertex> vertices) noexcept {
  indices.vertices = vertices.data();
  indices.vertices_size = vertices.size_bytes();
  indices.vertex_stride = indices.vertex_bytes = sizeof(Vertex);
}

// Writes the indices to `numbers`, whose size must be at least glevGetIndexCount.
template <class Index>
requires std::is_same_v<Index, std::uint8_t> || std::is_same_v<Index, std::uint16_t> ||
    std::is_same_v<Index, std::uint32_t>
[[nodiscard]] glev_result get_indices(glev_indices indices, std::span<Index> numbers,
                                      Scratch& scratch) noexcept {
  indices.type = sizeof(Index) == 1   ? GLEV_UNSIGNED_BYTE
                 : sizeof(Index) == 2 ? GLEV_UNSIGNED_SHORT
                                      : GLEV_UNSIGNED_INT;
  indices.data = numbers.data();
  indices.data_size = numbers.size_bytes();
  if (!scratch.reserve(glevGetIndexScratchSize(&indices))) return GLEV_ERROR_OUT_OF_MEMORY;
  indices.scratch = scratch.data();
  indices.scratch_size = scratch.size();
  return glevGetIndices(&indices);
}

}  // namespace glevaluator

#endif  // GLEVALUATOR_HPP_
