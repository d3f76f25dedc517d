// Helpers for tests of plans: batches and meshes into memory that shows which bytes were written.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <type_traits>
#include <vector>

#include "fixture.h"

namespace glev_tests {

constexpr glev_attribute kEveryAttribute[] = {GLEV_ATTRIBUTE_VERTEX, GLEV_ATTRIBUTE_COLOR,
                                              GLEV_ATTRIBUTE_NORMAL, GLEV_ATTRIBUTE_TEXCOORD};

// Returns the values of an attribute of a vertex; three for a normal.
inline Floats attribute_of(const glev_vertex& vertex, glev_attribute attribute) {
  switch (attribute) {
    case GLEV_ATTRIBUTE_VERTEX:
      return values_of(vertex.position);
    case GLEV_ATTRIBUTE_COLOR:
      return values_of(vertex.color);
    case GLEV_ATTRIBUTE_NORMAL:
      return values_of(vertex.normal);
    case GLEV_ATTRIBUTE_TEXCOORD:
      return values_of(vertex.texcoord[0]);
    default:
      return {};
  }
}

// A plan of the enabled maps of a context.
class Plan {
 public:
  Plan(glev_context* gl, std::size_t dimension) {
    const glev_plan_info info = {sizeof info, dimension};
    EXPECT_EQ(glevCreatePlan(gl, &info, &plan_), GLEV_SUCCESS);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  ~Plan() { glevReleasePlan(plan_); }
  operator const glev_plan*() const { return plan_; }

 private:
  glev_plan* plan_ = nullptr;
};

// A block of bytes, filled with a poison value.
class Memory {
 public:
  static constexpr unsigned char kPoisonByte = 0xCD;

  explicit Memory(std::size_t size) : bytes_(size, kPoisonByte) {}

  unsigned char* data() { return bytes_.data(); }
  std::size_t size() const { return bytes_.size(); }
  bool operator==(const Memory&) const = default;
  bool is_untouched() const { return *this == Memory(size()); }

  // Returns an output with all bytes from `offset` on.
  glev_output make_output(std::size_t offset, std::size_t stride, std::size_t components, glev_enum type = 0,
                          std::size_t row_stride = 0) {
    return {sizeof(glev_output), data() + offset, size() - offset, stride, components, type, row_stride, 0};
  }
  template <class Value>
  void put(std::size_t offset, const Value* values, std::size_t count) {
    std::memcpy(data() + offset, values, count * sizeof(Value));
  }
  void poison(std::size_t offset, std::size_t count) {
    std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), count, kPoisonByte);
  }
  // Returns the first byte that differs, for messages; size() if there is none.
  std::size_t mismatch(const Memory& other) const {
    return static_cast<std::size_t>(std::mismatch(bytes_.begin(), bytes_.end(), other.bytes_.begin()).first -
                                    bytes_.begin());
  }

 private:
  std::vector<unsigned char> bytes_;
};

template <class Real>
constexpr glev_enum kTypeOf = sizeof(Real) == sizeof(double) ? GLEV_DOUBLE : GLEV_FLOAT;

template <class Real>
glev_input input_of(const std::vector<Real>& arguments) {
  if (arguments.empty()) return {};
  return {arguments.data(), arguments.size() * sizeof(Real), sizeof(Real)};
}

// Returns an output with all values of a vector: packed elements, or elements `apart` values apart.
template <class Real>
glev_output output_to(std::vector<Real>& values, std::size_t components, std::size_t apart = 0) {
  const std::size_t stride = std::max(apart, components) * sizeof(Real);
  return {sizeof(glev_output),
          values.data(),
          values.size() * sizeof(Real),
          stride,
          components,
          kTypeOf<Real>,
          0,
          0};
}

// Evaluates one attribute at scattered arguments, packed. `v` is for plans of dimension 2.
template <class Result = float, class Real>
std::vector<Result> evaluate_scattered(const glev_plan* plan, glev_attribute attribute,
                                       const std::vector<Real>& u, const std::vector<Real>& v = {},
                                       glev_precision precision = GLEV_CORRECTLY_ROUNDED) {
  const std::size_t components = glevGetPlanComponents(plan, attribute);
  std::vector<Result> results(u.size() * components);
  const glev_output output = output_to(results, components);
  glev_batch batch = {sizeof batch, u.size(), kTypeOf<Real>, precision, input_of(u), input_of(v), nullptr, 0};
  const Outputs outputs(batch, {{attribute, &output}});
  EXPECT_EQ(glevEvaluate(plan, &batch), GLEV_SUCCESS);
  return results;
}

struct Range {
  int i1, i2, j1 = 0, j2 = 0;
  std::size_t columns() const { return i1 > i2 ? 0 : static_cast<std::size_t>(i2) - i1 + 1; }
  std::size_t rows() const { return j1 > j2 ? 0 : static_cast<std::size_t>(j2) - j1 + 1; }
  std::size_t count() const { return columns() * rows(); }
};

// Returns a mesh of these points, without outputs and scratch memory.
inline glev_mesh mesh_of(const Range& range, glev_precision precision = GLEV_CORRECTLY_ROUNDED) {
  return {sizeof(glev_mesh), range.i1, range.i2, range.j1, range.j2, precision, nullptr, 0, nullptr, 0};
}

// Evaluates a mesh with scratch memory of exactly the required size.
inline void evaluate_mesh(const glev_plan* plan, glev_mesh mesh) {
  std::vector<unsigned char> scratch(glevGetMeshScratchSize(plan, &mesh));
  mesh.scratch = scratch.data();
  mesh.scratch_size = scratch.size();
  EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
}

// One attribute at points of the grid, packed, or so many values apart with `between` between them.
template <class Result = float>
std::vector<Result> evaluate_grid(const glev_plan* plan, glev_attribute attribute, const Range& range,
                                  glev_precision precision = GLEV_CORRECTLY_ROUNDED, std::size_t apart = 0,
                                  Result between = 0) {
  const std::size_t components = glevGetPlanComponents(plan, attribute);
  std::vector<Result> results(range.count() * std::max(apart, components), between);
  const glev_output output = output_to(results, components, apart);
  glev_mesh mesh = mesh_of(range, precision);
  const Outputs outputs(mesh, {{attribute, &output}});
  evaluate_mesh(plan, mesh);
  return results;
}

// Random maps and arguments, the same on every machine.
class Chance {
 public:
  explicit Chance(unsigned seed = kSeed) : engine_(seed) {}

  // Returns an integer from `least` to `most`.
  int whole(int least, int most) {
    return least + static_cast<int>(engine_() % (static_cast<std::uint64_t>(most) - least + 1));
  }
  template <class List>
  auto one_of(const List& list) {
    return std::data(list)[engine_() % std::size(list)];
  }
  template <class Value>
  Value one_of(std::initializer_list<Value> list) {
    return list.begin()[engine_() % list.size()];
  }
  // Return numbers in [0, 1) with 24 and 53 bits.
  float next_float() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  double next_double() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  float between(float least, float most) { return least + next_float() * (most - least); }

  std::vector<float> next_points(std::size_t values) {
    std::vector<float> points(values);
    for (float& point : points) point = between(-2, 2);
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

// Defines maps of all four attributes in both dimensions, each with its own orders and domain.
inline void define_maps(glev_context* gl, Chance& chance, int most_order) {
  const auto end = [&](float near) { return near + chance.between(-0.25f, 0.25f); };
  for (const TargetRow& row : kTargetRows) {
    if (row.offset == GLEV_MAP1_INDEX - GLEV_MAP1_COLOR_4) continue;
    const int n = chance.whole(1, most_order), m = chance.whole(1, most_order);
    const bool reversed = chance.whole(0, 3) == 0;
    const std::vector<float> points = chance.next_points(static_cast<std::size_t>(n) * m * row.components);
    const float u1 = end(reversed), u2 = end(!reversed), v1 = end(0), v2 = end(1);
    glevMap1f(gl, GLEV_MAP1_COLOR_4 + row.offset, u1, u2, row.components, n, points.data());
    glevMap2f(gl, GLEV_MAP2_COLOR_4 + row.offset, u1, u2, row.components * m, n, v1, v2, row.components, m,
              points.data());
  }
}

// Enables one map of each attribute; for vertices and texture coordinates, it is chosen at random.
inline void enable_maps(glev_context* gl, Chance& chance) {
  for (glev_enum offset = 0; offset < 9; ++offset) {
    const bool is_on = offset == 0 || offset == 2 || chance.whole(0, 1) == 1;
    for (glev_enum first : {GLEV_MAP1_COLOR_4, GLEV_MAP2_COLOR_4}) {
      (is_on ? glevEnable : glevDisable)(gl, first + offset);
    }
  }
  for (glev_enum always :
       {GLEV_MAP1_VERTEX_3, GLEV_MAP2_VERTEX_3, GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP2_TEXTURE_COORD_1}) {
    glevEnable(gl, always);
  }
}

// An output, and its place in memory with others.
struct OutputLayout {
  glev_attribute attribute;
  std::size_t components;
  bool is_double = false;
  std::size_t offset = 0, stride = 0, row_stride = 0, patch_stride = 0;  // as in glev_output
  std::size_t row = 0, patch = 0;                                        // distances of rows and patches

  std::size_t element() const { return components * (is_double ? sizeof(double) : sizeof(float)); }
  std::size_t place(std::size_t i, std::size_t j = 0, std::size_t p = 0) const {
    return offset + i * stride + j * row + p * patch;
  }
};

struct Shape {
  std::size_t columns, rows = 1, patches = 1;
};

// Several outputs of `patches * rows * columns` elements with a random layout: interleaved or consecutive,
// with gaps, unaligned. The object contains pointers to its own members.
class OutputLayouts {
 public:
  // If `has_rows` is false, the layout has neither row strides nor patch strides.
  OutputLayouts(Chance& chance, std::vector<OutputLayout> outputs, const Shape& shape, bool has_rows)
      : layouts_(std::move(outputs)), shape_(shape) {
    for (std::size_t k = layouts_.size() - 1; k > 0; --k)
      std::swap(layouts_[k], layouts_[static_cast<std::size_t>(chance.whole(0, static_cast<int>(k)))]);
    const auto gap = [&] { return static_cast<std::size_t>(chance.one_of({0, 0, 0, 1, 2, 4, 7, 16})); };
    const bool is_interleaved = chance.whole(0, 1) == 1, has_strides = has_rows && chance.whole(0, 1) == 1;
    std::size_t at = gap(), common = 0;
    for (OutputLayout& own : layouts_) {
      own.offset = common;
      common += own.element() + gap();
    }
    const std::size_t row_gap = has_strides ? gap() : 0, patch_gap = has_strides ? gap() : 0;
    for (OutputLayout& own : layouts_) {
      own.offset = is_interleaved ? at + own.offset : at;
      own.stride = is_interleaved ? common : own.element() + gap();
      own.row = own.stride * shape.columns + row_gap;
      own.patch = own.row * shape.rows + patch_gap;
      if (has_strides) own.row_stride = own.row, own.patch_stride = shape.patches > 1 ? own.patch : 0;
      if (!is_interleaved) at += own.patch * shape.patches + gap();
      if (shape.columns * shape.rows * shape.patches != 0) bytes_ = std::max(bytes_, end_of(own));
    }
  }
  OutputLayouts(const OutputLayouts&) = delete;
  OutputLayouts& operator=(const OutputLayouts&) = delete;

  // Number of bytes up to the end of the last element.
  std::size_t bytes() const { return bytes_; }
  auto begin() const { return layouts_.begin(); }
  auto end() const { return layouts_.end(); }

  // Returns descriptions of the outputs in memory of bytes() bytes, of exactly the required sizes.
  const std::vector<glev_attribute_output>& describe(unsigned char* memory) {
    outputs_.clear();
    list_.clear();
    for (const OutputLayout& own : layouts_)
      outputs_.push_back({sizeof(glev_output), memory + own.offset,
                          bytes_ == 0 ? 0 : end_of(own) - own.offset, own.stride, own.components,
                          static_cast<glev_enum>(own.is_double ? GLEV_DOUBLE : GLEV_FLOAT), own.row_stride,
                          own.patch_stride});
    for (std::size_t k = 0; k < outputs_.size(); ++k) list_.push_back({layouts_[k].attribute, &outputs_[k]});
    return list_;
  }

 private:
  std::size_t end_of(const OutputLayout& own) const {
    return own.place(shape_.columns - 1, shape_.rows - 1, shape_.patches - 1) + own.element();
  }

  std::vector<OutputLayout> layouts_;
  Shape shape_;
  std::size_t bytes_ = 0;
  std::vector<glev_output> outputs_;
  std::vector<glev_attribute_output> list_;
};

// Returns outputs of all attributes with as many components as the maps of the plan, or more.
inline std::vector<OutputLayout> choose_outputs(Chance& chance, const glev_plan* plan) {
  std::vector<OutputLayout> outputs;
  for (glev_attribute attribute : kEveryAttribute) {
    const int of_map = static_cast<int>(glevGetPlanComponents(plan, attribute));
    const int most = chance.whole(0, 1) == 1 ? of_map : attribute == GLEV_ATTRIBUTE_NORMAL ? 3 : 4;
    outputs.push_back({attribute, static_cast<std::size_t>(chance.whole(of_map, most))});
  }
  return outputs;
}

// Number of bytes after the outputs, which must not change either.
constexpr std::size_t kSlack = 64;

// Returns the expected memory of these outputs: the attributes of the vertices, and poison between them.
inline Memory expected_memory(const OutputLayouts& layouts, const std::vector<glev_vertex>& vertices,
                              std::size_t columns) {
  Memory memory(layouts.bytes() + kSlack);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    for (const OutputLayout& own : layouts) {
      const Floats values = attribute_of(vertices[k], own.attribute);
      memory.put(own.place(k % columns, k / columns), values.data(), own.components);
    }
  }
  return memory;
}

}  // namespace glev_tests
