// The outputs of batches: reads their descriptions, and checks the memory of the caller.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "structures.h"
#include "target.h"

namespace glev {

// A layout in memory: patches * rows * columns > 0 elements of `element` bytes. Consecutive elements are
// `stride` bytes apart, rows `row_stride` and patches `patch_stride`.
struct Stream {
  const std::byte* begin;
  std::size_t columns, rows, stride, row_stride, element, patches, patch_stride;

  // Returns true if the elements fit into `bytes` bytes and into the address space.
  bool fits_into(std::size_t bytes) const {
    const std::size_t room = std::min<std::size_t>(bytes, UINTPTR_MAX - first_byte());
    if (element > room) return false;
    std::size_t left = room - element;
    const auto take = [&left](std::size_t count, std::size_t step) {
      std::size_t distance;
      if (__builtin_mul_overflow(count - 1, step, &distance) || distance > left) return false;
      left -= distance;
      return true;
    };
    return take(columns, stride) && take(rows, row_stride) && take(patches, patch_stride);
  }
  // The functions below require fits_into(), after which nothing overflows.
  std::uintptr_t first_byte() const { return reinterpret_cast<std::uintptr_t>(begin); }
  std::size_t bytes_of_patch() const { return (rows - 1) * row_stride + (columns - 1) * stride + element; }
  std::uintptr_t past_last_byte() const {
    return first_byte() + (patches - 1) * patch_stride + bytes_of_patch();
  }
};

// Returns true if two rows share bytes. They have the strides and columns of `first` and are `offset` bytes
// apart.
inline bool rows_share_bytes(const Stream& first, const Stream& second, std::size_t offset) {
  if (offset >= (first.columns - 1) * first.stride + first.element) return false;
  if (first.columns == 1) return true;
  const std::size_t column = offset / first.stride, rest = offset % first.stride;
  return rest < first.element || (rest + second.element > first.stride && column + 1 < first.columns);
}

// Returns true if two patches of the same shape, `offset` bytes apart, share bytes.
inline bool patches_share_bytes(const Stream& low, const Stream& high, std::size_t offset) {
  if (low.rows == 1) return rows_share_bytes(low, high, offset);
  // A row of `high` begins in a row of `low`, or in the padding after it, and may reach into the next one.
  const std::size_t row = offset / low.row_stride, rest = offset % low.row_stride;
  if (row >= low.rows) return false;
  return rows_share_bytes(low, high, rest) ||
         (row + 1 < low.rows && rows_share_bytes(high, low, low.row_stride - rest));
}

// Returns true if a and the output b share bytes. b has a positive stride, because it is an output. If
// layouts differ, any overlap of their extents counts.
inline bool share_bytes(const Stream& a, const Stream& b) {
  if (a.past_last_byte() <= b.first_byte() || b.past_last_byte() <= a.first_byte()) return false;
  if (a.stride != b.stride || a.columns != b.columns || a.rows != b.rows || a.row_stride != b.row_stride ||
      a.patches != b.patches || a.patch_stride != b.patch_stride)
    return true;
  const Stream& low = a.first_byte() <= b.first_byte() ? a : b;
  const Stream& high = &low == &a ? b : a;
  const std::size_t offset = high.first_byte() - low.first_byte();
  if (a.patches == 1) return patches_share_bytes(low, high, offset);
  const std::size_t patch = offset / a.patch_stride, rest = offset % a.patch_stride;
  return patches_share_bytes(low, high, rest) ||
         (patch + 1 < a.patches && patches_share_bytes(high, low, a.patch_stride - rest));
}

// Returns the layout of scratch memory, limited to the address space.
inline Stream claim(void* memory, std::size_t bytes) {
  Stream claimed = {static_cast<std::byte*>(memory), 1, 1, 1, 0, bytes, 1, 0};
  if (!claimed.fits_into(SIZE_MAX)) claimed.element = UINTPTR_MAX - claimed.first_byte();
  return claimed;
}

// ---- Outputs

constexpr int kFirstDerivative = kAttributes, kOutputs = kAttributes + 5;
static_assert(kFirstDerivative == GLEV_ATTRIBUTE_TANGENT_U && kOutputs == GLEV_ATTRIBUTE_SECOND_VV + 1);

struct Output {
  bool is_double;
  int components;
  std::byte* data;
  std::size_t bytes;
  Stream stream;

  std::byte* address_of(std::size_t column, std::size_t row) const {
    return data + column * stream.stride + row * stream.row_stride;
  }
  // Return the elements of one patch, or of one row of a patch.
  Output patch(std::size_t number) const {
    Output part = *this;
    part.data += number * stream.patch_stride;
    part.stream.patches = 1;
    return part;
  }
  Output row(std::size_t number) const {
    Output part = *this;
    part.data += number * stream.row_stride;
    part.stream.rows = 1;
    return part;
  }
  // Returns `columns` * `rows` consecutive elements of a single row as a mesh.
  Output mesh(std::size_t first, std::size_t columns, std::size_t rows) const {
    Output part = this->columns(first, columns);
    part.stream.rows = rows;
    part.stream.row_stride = columns * stream.stride;
    return part;
  }
  // Returns `count` elements of a single row.
  Output columns(std::size_t first, std::size_t count) const {
    Output part = *this;
    part.data += first * stream.stride;
    part.stream.columns = count;
    return part;
  }
};

// A set of attributes, in ascending order.
class AttributeSet {
 public:
  class Iterator {
   public:
    explicit Iterator(unsigned left) : left_(left) {}
    unsigned operator*() const { return static_cast<unsigned>(std::countr_zero(left_)); }
    Iterator& operator++() {
      left_ &= left_ - 1;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    unsigned left_;
  };

  void insert(unsigned attribute) { bits_ |= 1U << attribute; }
  bool contains(unsigned attribute) const { return (bits_ >> attribute & 1) != 0; }
  bool is_only(unsigned attribute) const { return bits_ == 1U << attribute; }
  bool has_derivatives() const { return bits_ >> kFirstDerivative != 0; }
  Iterator begin() const { return Iterator(bits_); }
  Iterator end() const { return Iterator(0); }

 private:
  unsigned bits_ = 0;
};

// The outputs of all attributes. Those that are not wanted have no values, because small batches would spend
// much of their time there.
struct Outputs {
  AttributeSet wanted;
  std::array<Output, kOutputs> all;

  const Output& operator[](unsigned attribute) const { return all[attribute]; }
};

// The numbers of elements of outputs.
struct Shape {
  std::size_t columns, rows = 1, patches = 1;
  bool has_rows = false, has_patches = false;

  bool is_empty() const { return columns == 0 || rows == 0 || patches == 0; }
};

inline glev_result read_output(const glev_output* given, const Shape& shape, std::size_t map_components,
                               std::size_t most_components, Output* output) {
  glev_output room;
  const glev_output* view;
  const glev_result result = view_struct(given, &room, &view);
  if (result != GLEV_SUCCESS) return result;
  const glev_output& copy = *view;
  if (map_components == 0) return GLEV_ERROR_NO_MAP;
  if (copy.components < map_components || copy.components > most_components)
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (copy.type != 0 && copy.type != GLEV_FLOAT && copy.type != GLEV_DOUBLE)
    return GLEV_ERROR_INVALID_ARGUMENT;
  const bool is_double = copy.type == GLEV_DOUBLE, is_empty = shape.is_empty();
  const std::size_t element = copy.components * (is_double ? sizeof(double) : sizeof(float));
  if (copy.stride < element || (copy.data == nullptr && !is_empty)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (!shape.has_rows && copy.row_stride != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  if (!shape.has_patches && copy.patch_stride != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  auto* const data = static_cast<std::byte*>(copy.data);
  Stream stream = {data, shape.columns, shape.rows, copy.stride, 0, element, shape.patches, 0};
  if (shape.has_rows && !is_empty) {
    // Rows and patches that are larger than the address space are rejected.
    if (shape.columns > SIZE_MAX / copy.stride) return GLEV_ERROR_BUFFER_TOO_SMALL;
    stream.row_stride = copy.row_stride != 0 ? copy.row_stride : shape.columns * copy.stride;
    if (stream.row_stride < (shape.columns - 1) * copy.stride + element) return GLEV_ERROR_INVALID_ARGUMENT;
  }
  if (shape.has_patches && !is_empty) {
    if (shape.rows > SIZE_MAX / stream.row_stride) return GLEV_ERROR_BUFFER_TOO_SMALL;
    stream.patch_stride = copy.patch_stride != 0 ? copy.patch_stride : shape.rows * stream.row_stride;
    if (stream.patch_stride < stream.bytes_of_patch()) return GLEV_ERROR_INVALID_ARGUMENT;
  }
  *output = {is_double, static_cast<int>(copy.components), data, copy.data_size, stream};
  return GLEV_SUCCESS;
}

// Returns the number of an enumerator. C programs may pass any number, which C++ must not read as an
// enumerator.
template <class Enum>
unsigned number_of(const Enum& enumerator) {
  unsigned number;
  static_assert(sizeof number == sizeof enumerator);
  std::memcpy(&number, &enumerator, sizeof number);
  return number;
}

inline bool is_precision(const glev_precision& precision) {
  return number_of(precision) == GLEV_CORRECTLY_ROUNDED || number_of(precision) == GLEV_FAST;
}

// Reads and checks outputs, except for memory. components_of(o) returns the number of components of attribute
// `o`, 0 if there is no map.
template <class ComponentsOf>
glev_result read_outputs(const ComponentsOf& components_of, const glev_attribute_output* given,
                         std::size_t count, const Shape& shape, Outputs* outputs) {
  if (given == nullptr && count != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned o = number_of(given[i].attribute);
    // Attributes must not repeat, so at most kOutputs are accepted.
    if (o >= kOutputs || outputs->wanted.contains(o)) return GLEV_ERROR_INVALID_ARGUMENT;
    const bool is_normal = o == static_cast<unsigned>(Attribute::kNormal);
    const glev_result result =
        read_output(given[i].output, shape, components_of(o), is_normal ? 3 : 4, &outputs->all[o]);
    if (result != GLEV_SUCCESS) return result;
    outputs->wanted.insert(o);
  }
  return GLEV_SUCCESS;
}

// Checks the sizes of outputs, and overlaps between outputs and with `others`, the other memory that is read
// or written.
template <std::size_t kOthers>
glev_result check_memory(const Outputs& outputs, const std::array<Stream, kOthers>& others) {
  for (const unsigned o : outputs.wanted) {
    if (!outputs[o].stream.fits_into(outputs[o].bytes)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  for (const unsigned a : outputs.wanted) {
    for (const Stream& other : others) {
      if (other.columns != 0 && share_bytes(other, outputs[a].stream)) return GLEV_ERROR_OVERLAP;
    }
    for (const unsigned b : outputs.wanted) {
      if (b < a && share_bytes(outputs[b].stream, outputs[a].stream)) return GLEV_ERROR_OVERLAP;
    }
  }
  return GLEV_SUCCESS;
}

}  // namespace glev
