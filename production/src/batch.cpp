// Batches: arrays of arguments through a plan into memory of the caller.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "production/src/plan.h"
#include "production/src/row.h"

namespace {

using glev::Attribute;
using glev::kAttributes;

// `count` > 0 elements of `element` bytes, `stride` bytes from one to the next.
struct Stream {
  const std::byte* begin = nullptr;
  std::size_t count = 0, stride = 0, element = 0;

  // In so many bytes, and in the address space, whatever the caller claims.
  bool FitsInto(std::size_t bytes) const {
    const std::size_t room = std::min<std::size_t>(bytes, UINTPTR_MAX - first_byte());
    if (element > room) return false;
    return stride == 0 || count - 1 <= (room - element) / stride;
  }
  // Only after FitsInto: nothing overflows then.
  std::uintptr_t first_byte() const { return reinterpret_cast<std::uintptr_t>(begin); }
  std::uintptr_t past_last_byte() const { return first_byte() + (count - 1) * stride + element; }
};

// b is an output, so its stride is positive. With different strides any overlap of the extents counts.
bool ShareBytes(const Stream& a, const Stream& b) {
  if (a.past_last_byte() <= b.first_byte() || b.past_last_byte() <= a.first_byte()) return false;
  if (a.stride != b.stride) return true;
  // Interleaved: compare offsets within one stride.
  const Stream& low = a.first_byte() <= b.first_byte() ? a : b;
  const Stream& high = &low == &a ? b : a;
  const std::size_t offset = (high.first_byte() - low.first_byte()) % a.stride;
  return offset < low.element || offset + high.element > a.stride;
}

struct Output {
  bool wanted = false;
  std::byte* data = nullptr;
  Stream stream;
};

glev_result ReadOutput(const glev_output* given, std::size_t count, std::size_t map_components,
                       std::size_t most_components, Output* output, std::size_t* bytes) {
  glev_output copy;
  if (!glev::ReadStruct(given, &copy)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (map_components == 0) return GLEV_ERROR_NO_MAP;
  if (copy.components < map_components || copy.components > most_components)
    return GLEV_ERROR_INVALID_ARGUMENT;
  const std::size_t element = copy.components * sizeof(float);
  if (copy.stride < element || (copy.data == nullptr && count != 0)) return GLEV_ERROR_INVALID_ARGUMENT;
  *bytes = copy.data_size;
  *output = {true,
             static_cast<std::byte*>(copy.data),
             {static_cast<std::byte*>(copy.data), count, copy.stride, element}};
  return GLEV_SUCCESS;
}

template <class Real>
void EvaluateAll(const glev_plan& plan, const Stream& u, const std::array<Output, kAttributes>& outputs) {
  const glev::Row row(plan, 0.0);
  for (int a = 0; a < kAttributes; ++a) {
    const Output& output = outputs[a];
    if (!output.wanted) continue;
    for (std::size_t i = 0; i < u.count; ++i) {
      Real argument;
      std::memcpy(&argument, u.begin + i * u.stride, sizeof argument);
      std::array<float, 4> value;
      glev::RoundTo(value, row.At(static_cast<Attribute>(a), static_cast<double>(argument)));
      std::memcpy(output.data + i * output.stream.stride, value.data(), output.stream.element);
    }
  }
}

}  // namespace

size_t glevGetScratchSize1(const glev_plan*, const glev_batch1*) { return 0; }

glev_result glevEvaluate1(const glev_plan* plan, const glev_batch1* given) {
  glev_batch1 batch;
  if (plan == nullptr || !glev::ReadStruct(given, &batch)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (batch.u_type != GLEV_FLOAT && batch.u_type != GLEV_DOUBLE) return GLEV_ERROR_INVALID_ARGUMENT;
  if (batch.u == nullptr && batch.count != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  if (batch.scratch == nullptr && batch.scratch_size != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  const Stream u = {static_cast<const std::byte*>(batch.u), batch.count, batch.u_stride,
                    batch.u_type == GLEV_FLOAT ? sizeof(float) : sizeof(double)};

  const std::array<const glev_output*, kAttributes> wanted = {batch.vertex, batch.color, batch.normal,
                                                              batch.texcoord};
  std::array<Output, kAttributes> outputs;
  std::array<std::size_t, kAttributes> bytes{};
  for (int a = 0; a < kAttributes; ++a) {
    if (wanted[a] == nullptr) continue;
    const auto attribute = static_cast<Attribute>(a);
    const glev_result result = ReadOutput(wanted[a], batch.count, plan->components(attribute),
                                          attribute == Attribute::kNormal ? 3 : 4, &outputs[a], &bytes[a]);
    if (result != GLEV_SUCCESS) return result;
  }
  if (batch.count == 0) return GLEV_SUCCESS;

  if (!u.FitsInto(batch.u_size)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  for (int a = 0; a < kAttributes; ++a) {
    if (outputs[a].wanted && !outputs[a].stream.FitsInto(bytes[a])) return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  for (int a = 0; a < kAttributes; ++a) {
    if (!outputs[a].wanted) continue;
    if (ShareBytes(u, outputs[a].stream)) return GLEV_ERROR_OVERLAP;
    for (int b = 0; b < a; ++b) {
      if (outputs[b].wanted && ShareBytes(outputs[b].stream, outputs[a].stream)) return GLEV_ERROR_OVERLAP;
    }
  }

  if (batch.u_type == GLEV_FLOAT) {
    EvaluateAll<float>(*plan, u, outputs);
  } else {
    EvaluateAll<double>(*plan, u, outputs);
  }
  return GLEV_SUCCESS;
}
