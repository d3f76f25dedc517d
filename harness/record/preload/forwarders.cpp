// The exported commands of the GL: each is recorded or counted, and passed on.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "commands.h"
#include "real_commands.h"
#include "recorder.h"

namespace evalcts::record {
namespace {

// Returns true if the command has one of the prefixes.
template <class... Prefixes>
constexpr bool begins(int number, Prefixes... prefixes) {
  return (short_name(number).starts_with(prefixes) || ...);
}

constexpr CommandClass class_of(int number) {
  if (begins(number, "Vertex2", "Vertex3", "Vertex4", "Eval", "Begin", "End", "Get", "Is", "Flush",
             "Finish") &&
      number != kGetError && number != kEndList)
    return CommandClass::kDrawing;
  if (begins(number, "Color", "Normal", "TexCoord", "MultiTexCoord", "Index", "EdgeFlag", "SecondaryColor",
             "FogCoord"))
    return CommandClass::kCurrentValue;
  return CommandClass::kState;
}

// --- arrays

// An array that a command reads: rows of pieces.
struct Array {
  const std::byte* data = nullptr;
  std::uint64_t bytes = kUnknown;  // with the gaps between the pieces; kNull and kUnknown as in the file
  std::uint64_t rows = 0, row_stride = 0, pieces = 0, stride = 0, piece = 0;  // in bytes

  bool has_bytes() const { return bytes < kUnknown; }
  std::byte* put_into(std::byte* at) const {
    at = put(at, static_cast<std::uint32_t>(bytes));
    if (!has_bytes()) return at;
    if (piece < stride || pieces * stride < row_stride) std::memset(at, 0, bytes);
    for (std::uint64_t row = 0; row < rows; ++row)
      for (std::uint64_t i = 0; i < pieces; ++i)
        std::memcpy(at + row * row_stride + i * stride, data + row * row_stride + i * stride, piece);
    return at + bytes;
  }
};

constexpr std::uint64_t components_of(GLenum target, GLenum first_target) {
  constexpr std::uint64_t kComponents[] = {4, 1, 3, 1, 2, 3, 4, 3, 4};  // from MAP1_COLOR_4 to MAP1_VERTEX_4
  return target - first_target < std::size(kComponents) ? kComponents[target - first_target] : 0;
}

// Returns the control points of a map, if the GL reads them. It does not read the gaps between the points.
template <class T>
Array points_of_map(const T* points, std::uint64_t components, std::uint64_t v_order, std::uint64_t v_stride,
                    std::uint64_t u_order, std::uint64_t u_stride) {
  const std::uint64_t bytes = ((u_order - 1) * u_stride + (v_order - 1) * v_stride + components) * sizeof(T);
  if (bytes >= kUnknown) return {};
  return {reinterpret_cast<const std::byte*>(points),
          bytes,
          u_order,
          u_stride * sizeof(T),
          v_order,
          v_stride * sizeof(T),
          components * sizeof(T)};
}

template <class T>
Array array_of(const Writer& of, GLenum target, T u1, T u2, GLint stride, GLint order, const T* points) {
  const std::uint64_t k = components_of(target, GL_MAP1_COLOR_4);
  if (of.is_in_primitive || k == 0 || u1 == u2 || stride < static_cast<std::int64_t>(k) || order < 1 ||
      order > of.max_order)
    return {};
  return points_of_map(points, k, order, stride, 1, 0);
}

template <class T>
Array array_of(const Writer& of, GLenum target, T u1, T u2, GLint u_stride, GLint u_order, T v1, T v2,
               GLint v_stride, GLint v_order, const T* points) {
  const std::uint64_t k = components_of(target, GL_MAP2_COLOR_4);
  const auto least = static_cast<std::int64_t>(k);
  if (of.is_in_primitive || k == 0 || u1 == u2 || v1 == v2 || u_stride < least || v_stride < least ||
      u_order < 1 || v_order < 1 || u_order > of.max_order || v_order > of.max_order)
    return {};
  return points_of_map(points, k, v_order, v_stride, u_order, u_stride);
}

// The names of CallLists.
inline Array array_of(const Writer&, GLsizei count, GLenum type, const void* names) {
  constexpr std::uint64_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 2, 3, 4};  // from BYTE to 4_BYTES
  if (count < 0 || type < GL_BYTE || type > GL_4_BYTES) return {};
  const std::uint64_t bytes = count * kSizes[type - GL_BYTE];
  if (bytes >= kUnknown) return {};
  return {static_cast<const std::byte*>(names), bytes, 1, bytes, 1, bytes, bytes};
}

// Returns the number of elements that a command whose name ends with v reads: the digit in the name, or 1.
constexpr std::size_t elements_of(int number) {
  std::size_t elements = 1;
  for (const char each : short_name(number))
    if (each >= '1' && each <= '4') elements = static_cast<std::size_t>(each - '0');
  return elements;
}

constexpr bool has_fixed_array(int number) { return short_name(number).ends_with("v"); }

// Returns an array of constant size.
template <int kNumber, class T>
std::byte* put_fixed(std::byte* at, const T* data) {
  constexpr auto kBytes = static_cast<std::uint32_t>(elements_of(kNumber) * sizeof(T));
  if (data == nullptr) return put(at, kNull);
  at = put(at, kBytes);
  std::memcpy(at, data, kBytes);
  return at + kBytes;
}

// --- recording

// Returns the writer of this thread if the command is recorded, otherwise null.
template <int kNumber>
inline Writer* writer_for() {
  Writer* const current = writer;
  if (current == nullptr || !current->records || !is_active.load(std::memory_order_relaxed)) return nullptr;
  constexpr CommandClass kClass = class_of(kNumber);
  if (__builtin_expect(is_limited_to_frames, 0) && current->leaves_out(kClass)) return nullptr;
  return current;
}

// Follows primitives and display lists.
template <int kNumber, class... P>
inline void follow(P... arguments) {
  if constexpr (kNumber != kBegin && kNumber != kEnd && kNumber != kNewList && kNumber != kEndList) return;
  Writer* const current = writer;
  if (current == nullptr) return;
  if constexpr (kNumber == kBegin || kNumber == kEnd)
    current->is_in_primitive = kNumber == kBegin && current->list_mode != GL_COMPILE;
  else if constexpr (kNumber == kNewList)
    current->list_mode = std::get<1>(std::tuple(arguments...));
  else if constexpr (kNumber == kEndList)
    current->list_mode = 0;
}

// The last parameter of a command is its only pointer.
template <class... P>
using Last = std::tuple_element_t<sizeof...(P) - 1, std::tuple<P...>>;

template <int kNumber, class... P>
inline void record(P... arguments) {
  Writer* const of = writer_for<kNumber>();
  if (of == nullptr) return;
  constexpr std::size_t kFixed = (sizeof(std::uint16_t) + ... + kFixedSize<P>);
  std::size_t bytes = kFixed;
  Array array;
  constexpr bool kReads = [] {
    if constexpr (sizeof...(P) == 0)
      return false;
    else
      return std::is_pointer_v<Last<P...>> && std::is_const_v<std::remove_pointer_t<Last<P...>>>;
  }();
  if constexpr (kReads && has_fixed_array(kNumber)) {
    constexpr std::size_t kElements = elements_of(kNumber);
    bytes += kElements * sizeof(std::remove_pointer_t<Last<P...>>);
  } else if constexpr (kReads) {
    if ((std::get<sizeof...(P) - 1>(std::tuple(arguments...))) == nullptr)
      array.bytes = kNull;
    else
      array = array_of(*of, arguments...);
    if (array.has_bytes()) bytes += array.bytes;
  }
  std::byte* at = of->reserve(bytes);
  if (at == nullptr) return;
  at = put(at, static_cast<std::uint16_t>(kNumber));
  [[maybe_unused]] const auto put_one = [&]<class T>(T value) {
    if constexpr (!std::is_pointer_v<T>)
      at = put_parameter(at, value);
    else if constexpr (!std::is_const_v<std::remove_pointer_t<T>>)
      at = put(at, value == nullptr ? kNull : std::uint32_t{0});
    else if constexpr (has_fixed_array(kNumber))
      at = put_fixed<kNumber>(at, value);
    else
      at = array.put_into(at);
  };
  (put_one(arguments), ...);
  of->commit(at);
}

// Converts a component. GL 2.1, table 2.9: integer colors and normals are mapped to [-1, 1] or [0, 1].
template <bool kIsNormalized, class T>
double converted(T value) {
  constexpr double kLargest = static_cast<double>((std::uint64_t{1} << (8 * sizeof(T))) - 1);
  if constexpr (!kIsNormalized)
    return value;
  else if constexpr (std::is_signed_v<T>)
    return (2.0 * value + 1.0) / kLargest;
  else
    return value / kLargest;
}

// Records a form of a command as the form with doubles.
template <int kNumber, class... P>
inline void record_converted(P... arguments) {
  constexpr int kAs = recorded_as(kNumber);
  Writer* const of = writer_for<kAs>();
  if (of == nullptr) return;
  constexpr bool kIsNormalized = begins(kAs, "Color", "Normal");
  constexpr bool kHasUnit = begins(kAs, "MultiTexCoord");
  constexpr std::size_t kElements = elements_of(kAs);
  std::byte* at =
      of->reserve(sizeof(std::uint16_t) + kHasUnit * sizeof(std::uint32_t) + kElements * sizeof(double));
  if (at == nullptr) return;
  at = put(at, static_cast<std::uint16_t>(kAs));
  const auto put_one = [&]<class T>(T value) {
    if constexpr (std::is_pointer_v<T>)
      for (std::size_t i = 0; i < kElements; ++i) at = put(at, converted<kIsNormalized>(value[i]));
    else if constexpr (kHasUnit && std::is_same_v<T, GLenum>)
      at = put(at, value);
    else
      at = put(at, converted<kIsNormalized>(value));
  };
  (put_one(arguments), ...);
  of->commit(at);
}

template <int kNumber, class Function>
struct Forward;

template <int kNumber, class Result, class... P>
struct Forward<kNumber, Result(P...)> {
  static Result call(P... arguments) {
    if constexpr (kNumber >= kAliasesEnd) {
      count(kNumber - kAliasesEnd);
    } else if constexpr (kNumber < kRecordedEnd || kNumber >= kConvertedEnd) {
      record<recorded_as(kNumber)>(arguments...);
      follow<recorded_as(kNumber)>(arguments...);
    } else {
      record_converted<kNumber>(arguments...);
    }
    if constexpr (kNumber == kFlush || kNumber == kFinish)
      if (writer != nullptr && writer->ends_frames_by_flush) note_frame();
    return real<Result(P...)>(kNumber)(arguments...);
  }
};

// Types of the result and of the parameters of a command.
template <class Function>
struct Signature;
template <class R, class... P>
struct Signature<R(P...)> {
  using Result = R;
  template <std::size_t kIndex>
  using Parameter = std::tuple_element_t<kIndex, std::tuple<P...>>;
};

}  // namespace
}  // namespace evalcts::record

// clang-format off
#define EVALCTS_P(i) Signature::Parameter<i> p##i
#define EVALCTS_PARAMETERS_0
#define EVALCTS_PARAMETERS_1 EVALCTS_P(0)
#define EVALCTS_PARAMETERS_2 EVALCTS_PARAMETERS_1, EVALCTS_P(1)
#define EVALCTS_PARAMETERS_3 EVALCTS_PARAMETERS_2, EVALCTS_P(2)
#define EVALCTS_PARAMETERS_4 EVALCTS_PARAMETERS_3, EVALCTS_P(3)
#define EVALCTS_PARAMETERS_5 EVALCTS_PARAMETERS_4, EVALCTS_P(4)
#define EVALCTS_PARAMETERS_6 EVALCTS_PARAMETERS_5, EVALCTS_P(5)
#define EVALCTS_PARAMETERS_7 EVALCTS_PARAMETERS_6, EVALCTS_P(6)
#define EVALCTS_PARAMETERS_8 EVALCTS_PARAMETERS_7, EVALCTS_P(7)
#define EVALCTS_PARAMETERS_9 EVALCTS_PARAMETERS_8, EVALCTS_P(8)
#define EVALCTS_PARAMETERS_10 EVALCTS_PARAMETERS_9, EVALCTS_P(9)
#define EVALCTS_PARAMETERS_11 EVALCTS_PARAMETERS_10, EVALCTS_P(10)
#define EVALCTS_ARGUMENTS_0
#define EVALCTS_ARGUMENTS_1 p0
#define EVALCTS_ARGUMENTS_2 EVALCTS_ARGUMENTS_1, p1
#define EVALCTS_ARGUMENTS_3 EVALCTS_ARGUMENTS_2, p2
#define EVALCTS_ARGUMENTS_4 EVALCTS_ARGUMENTS_3, p3
#define EVALCTS_ARGUMENTS_5 EVALCTS_ARGUMENTS_4, p4
#define EVALCTS_ARGUMENTS_6 EVALCTS_ARGUMENTS_5, p5
#define EVALCTS_ARGUMENTS_7 EVALCTS_ARGUMENTS_6, p6
#define EVALCTS_ARGUMENTS_8 EVALCTS_ARGUMENTS_7, p7
#define EVALCTS_ARGUMENTS_9 EVALCTS_ARGUMENTS_8, p8
#define EVALCTS_ARGUMENTS_10 EVALCTS_ARGUMENTS_9, p9
#define EVALCTS_ARGUMENTS_11 EVALCTS_ARGUMENTS_10, p10
// clang-format on

// An ifunc would need neither numbers nor names of parameters, but the dynamic linker warns of those in
// preloaded libraries.
#define EVALCTS_EXPORT(name, parameters)                                                   \
  namespace evalcts::record::of_##name {                                                   \
    using Signature = record::Signature<decltype(::gl##name)>;                             \
    extern "C" __attribute__((visibility("default")))                                      \
    Signature::Result gl##name(EVALCTS_PARAMETERS_##parameters) {                          \
      return Forward<k##name, decltype(::gl##name)>::call(EVALCTS_ARGUMENTS_##parameters); \
    }                                                                                      \
  }
#define RECORDED(name, parameters) EVALCTS_EXPORT(name, parameters)
#include <recorded.def>
#undef RECORDED
#define X(name, recorded, parameters) EVALCTS_EXPORT(name, parameters)
EVALCTS_CONVERTED(X)
EVALCTS_ALIASES(X)
#undef X
#define COUNTED(name, parameters) EVALCTS_EXPORT(name, parameters)
#include <counted.def>
#undef COUNTED

// Only the addresses of these functions are used here.
extern "C" {
#define X(name) void name();
EVALCTS_WINDOW_SYSTEMS(X)
#undef X
}

void* const evalcts::record::kForwarders[kFunctions] = {
#define RECORDED(name, parameters) reinterpret_cast<void*>(&::gl##name),
#include <recorded.def>
#undef RECORDED
#define X(name, recorded, parameters) reinterpret_cast<void*>(&::gl##name),
    EVALCTS_CONVERTED(X) EVALCTS_ALIASES(X)
#undef X
#define COUNTED(name, parameters) reinterpret_cast<void*>(&::gl##name),
#include <counted.def>
#undef COUNTED
#define X(name) reinterpret_cast<void*>(&name),
        EVALCTS_WINDOW_SYSTEMS(X)
#undef X
};
