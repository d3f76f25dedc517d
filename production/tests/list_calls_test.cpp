// Tests CallLists and ListBase.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "lists_fixture.h"

namespace glev_tests {
namespace {

class ListCalls : public Lists {
 protected:
  // Returns the names of the lists that these offsets call with this base. Lists exist for all `names`.
  template <class Value>
  std::vector<float> called_indices(glev_enum type, glev_uint base, const std::vector<glev_uint>& names,
                                    const std::vector<Value>& offsets, int n) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      compile(names[i], [&] {
        glevIndexf(gl, static_cast<float>(i));
        glevVertex2f(gl, 0, 0);
      });
    }
    glevListBase(gl, base);
    std::vector<float> called;
    for (const bool compiled : {false, true}) {
      // The array is unaligned and has exactly the required size.
      const std::size_t bytes = offsets.size() * sizeof(Value);
      const auto memory = std::make_unique<unsigned char[]>(bytes + 1);
      std::memcpy(memory.get() + 1, offsets.data(), bytes);
      if (compiled) {
        compile(500, [&] { glevCallLists(gl, n, type, memory.get() + 1); });
        std::fill_n(memory.get(), bytes + 1, 0xEE);
      }
      recording = {};
      glevBegin(gl, GLEV_POINTS);
      if (compiled) {
        glevCallList(gl, 500);
      } else {
        glevCallLists(gl, n, type, memory.get() + 1);
      }
      glevEnd(gl);
      if (compiled) {
        EXPECT_EQ(recorded_indices(), called);
      }
      called = recorded_indices();
    }
    expect_error(GLEV_NO_ERROR);
    return called;
  }
};

TEST_F(ListCalls, EveryType) {
  const Floats all = {0, 1, 2};
  using Bytes = std::vector<unsigned char>;
  EXPECT_EQ(called_indices<signed char>(GLEV_BYTE, 200, {205, 199, 72}, {5, -1, -128}, 3), all);
  EXPECT_EQ(called_indices<unsigned char>(GLEV_UNSIGNED_BYTE, 0, {5, 255, 128}, {5, 255, 128}, 3), all);
  EXPECT_EQ(called_indices<std::int16_t>(GLEV_SHORT, 40000, {40300, 39999, 7232}, {300, -1, -32768}, 3), all);
  EXPECT_EQ(
      called_indices<std::uint16_t>(GLEV_UNSIGNED_SHORT, 1, {301, 65536, 32769}, {300, 65535, 32768}, 3),
      all);
  EXPECT_EQ(called_indices<int>(GLEV_INT, 10, {70010, 9, 0x8000000A}, {70000, -1, -2147483647 - 1}, 3), all);
  EXPECT_EQ(called_indices<glev_uint>(GLEV_UNSIGNED_INT, 10, {70010, 9, 0x8000000A},
                                      {70000, 0xFFFFFFFF, 0x80000000}, 3),
            all);
  EXPECT_EQ(called_indices<float>(GLEV_FLOAT, 10, {13, 9, 0x8000000A}, {3.75f, -0.5f, 0x1p31f}, 3), all);
  EXPECT_EQ(called_indices<unsigned char>(GLEV_2_BYTES, 1, {0x1235, 0xFF81, 3},
                                          Bytes{0x12, 0x34, 0xFF, 0x80, 0, 2}, 3),
            all);
  EXPECT_EQ(called_indices<unsigned char>(GLEV_3_BYTES, 1, {0x123457, 0xFF8002, 3},
                                          Bytes{0x12, 0x34, 0x56, 0xFF, 0x80, 1, 0, 0, 2}, 3),
            all);
  EXPECT_EQ(called_indices<unsigned char>(GLEV_4_BYTES, 1, {0x12345679, 0xFF800204, 3},
                                          Bytes{0x12, 0x34, 0x56, 0x78, 0xFF, 0x80, 2, 3, 0, 0, 0, 2}, 3),
            all);
}

TEST_F(ListCalls, NumbersThatAreNoNamesAreHarmless) {
  const std::vector<float> offsets = {NAN, INFINITY, -INFINITY, 1e30f, -1e30f, 1};
  EXPECT_EQ(called_indices<float>(GLEV_FLOAT, 10, {11}, offsets, 6), Floats{0});
}

TEST_F(ListCalls, OnlyNOfThem) {
  EXPECT_EQ(called_indices<int>(GLEV_INT, 0, {1, 2, 3}, {3, 2, 1}, 2), (Floats{2, 1}));
  EXPECT_EQ(called_indices<int>(GLEV_INT, 0, {1, 2, 3}, {3, 2, 1}, 0), Floats{});
}

TEST_F(ListCalls, CallListDoesNotUseTheBase) {
  compile(1, [&] { glevIndexf(gl, 1); });
  compile(11, [&] { glevIndexf(gl, 11); });
  glevListBase(gl, 10);
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 1);
}

TEST_F(ListCalls, TheBaseIsTheOneInForceWhenTheListIsCalled) {
  compile(1, [&] { glevIndexf(gl, 1); });
  compile(11, [&] { glevListBase(gl, 20); });
  compile(21, [&] { glevIndexf(gl, 21); });
  const unsigned char one[] = {1, 1};
  compile(2, [&] { glevCallLists(gl, 1, GLEV_UNSIGNED_BYTE, one); });
  glevCallList(gl, 2);
  EXPECT_EQ(current_index(), 1);
  glevListBase(gl, 10);
  glevCallLists(gl, 2, GLEV_UNSIGNED_BYTE, one);
  EXPECT_EQ(current_index(), 21) << "a list changes it for the next one";
}

TEST_F(ListCalls, BadArgumentsAreRefused) {
  compile(1, [&] { glevIndexf(gl, 9); });
  const int names[] = {1};
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevCallLists(gl, -1, GLEV_INT, names); });
  for (const glev_enum type : {0, 0x13FF, 0x140A, 0x140B}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevCallLists(gl, 1, type, names); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevCallLists(gl, 0, type, names); });
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevCallLists(gl, 1, GLEV_INT, nullptr); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevListBase(gl, 3); });
}

}  // namespace
}  // namespace glev_tests
