// Results of invalid calls, and changes that make outputs invalid, for tests of misuse.
#pragma once

#include <cstddef>

#include "batches.h"

namespace glev_tests {

constexpr glev_result kInvalid = GLEV_ERROR_INVALID_ARGUMENT, kTooSmall = GLEV_ERROR_BUFFER_TOO_SMALL,
                      kWrongSize = GLEV_ERROR_STRUCTURE_SIZE, kOverlap = GLEV_ERROR_OVERLAP;

// A change of an output of several elements, three floats each, and the result of a call with it.
struct OutputMisuse {
  glev_result result;
  const char* what;
  void (*change)(glev_output&);
};
inline constexpr OutputMisuse kOutputMisuses[] = {
    {kWrongSize, "size 0", [](glev_output& output) { output.size = 0; }},
    {kWrongSize, "size below that of the first version",
     [](glev_output& output) { output.size = offsetof(glev_output, patch_stride) - 1; }},
    {kInvalid, "no data", [](glev_output& output) { output.data = nullptr; }},
    {kInvalid, "no components", [](glev_output& output) { output.components = 0; }},
    {kInvalid, "5 components", [](glev_output& output) { output.components = 5, output.stride = 100; }},
    {kInvalid, "all components", [](glev_output& output) { output.components = SIZE_MAX; }},
    {kInvalid, "2^62 components", [](glev_output& output) { output.components = SIZE_MAX / 4 + 1; }},
    {kInvalid, "no stride", [](glev_output& output) { output.stride = 0; }},
    {kInvalid, "short stride", [](glev_output& output) { output.stride = 11; }},
    {kInvalid, "short stride of doubles",
     [](glev_output& output) { output.type = GLEV_DOUBLE, output.stride = 23; }},
    {kInvalid, "type 0x1404", [](glev_output& output) { output.type = 0x1404; }},
    {kInvalid, "type 0x1409", [](glev_output& output) { output.type = 0x1409; }},
    {kInvalid, "type 1", [](glev_output& output) { output.type = 1; }},
    {kInvalid, "type 0x140B", [](glev_output& output) { output.type = 0x140B; }},
    {kInvalid, "type 2^32 - 1", [](glev_output& output) { output.type = 0xFFFFFFFF; }},
    {kTooSmall, "no bytes", [](glev_output& output) { output.data_size = 0; }},
    {kTooSmall, "bytes for less than an element", [](glev_output& output) { output.data_size = 11; }},
    {kTooSmall, "large stride", [](glev_output& output) { output.stride = SIZE_MAX / 2; }},
    {kTooSmall, "large stride and size",
     [](glev_output& output) { output.stride = SIZE_MAX / 2, output.data_size = SIZE_MAX; }},
};

// Gives an enumeration a value that it may not have.
template <class Enumeration>
void set_number(Enumeration& to, int number) {
  static_assert(sizeof to == sizeof number);
  std::memcpy(&to, &number, sizeof number);
}

}  // namespace glev_tests
