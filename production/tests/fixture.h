// The fixture of most tests: a context whose vertices are recorded, and queries of all of its state.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

#include <glevaluator.h>

namespace glev_tests {

constexpr int kMax = 64;  // MAX_EVAL_ORDER
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr unsigned kSeed = 20240117;  // seed of random data

// The nine kinds of maps, by offset from COLOR_4, with the number of values of a control point.
struct TargetRow {
  glev_enum offset;
  int components;
};
inline constexpr TargetRow kTargetRows[] = {{0, 4}, {1, 1}, {2, 3}, {3, 1}, {4, 2},
                                            {5, 3}, {6, 4}, {7, 3}, {8, 4}};

struct Recording {
  std::vector<glev_enum> begun;
  std::vector<glev_vertex> vertices;
  int ended = 0;

  glev_sink make_sink() {
    return {sizeof(glev_sink), this,
            [](void* user, glev_enum mode) { static_cast<Recording*>(user)->begun.push_back(mode); },
            [](void* user, const glev_vertex* v) { static_cast<Recording*>(user)->vertices.push_back(*v); },
            [](void* user) { ++static_cast<Recording*>(user)->ended; }};
  }
};

class ContextTest : public ::testing::Test {
 protected:
  ContextTest() {
    EXPECT_EQ(glevCreateContext(nullptr, &gl), GLEV_SUCCESS);
    const glev_sink sink = recording.make_sink();
    EXPECT_EQ(glevSetSink(gl, &sink), GLEV_SUCCESS);
  }
  ~ContextTest() override { glevDestroyContext(gl); }

  // Returns all queryable state as numbers. Must be called outside Begin/End and NewList/EndList. Does not
  // change the error flag.
  std::vector<double> query_state() const {
    std::vector<double> state;
    std::vector<double> values(64 * 64 * 4);
    const auto add = [&](std::size_t count) {
      state.insert(state.end(), values.begin(), values.begin() + count);
    };
    for (const TargetRow& row : kTargetRows) {
      for (int dimension : {1, 2}) {
        const glev_enum target = (dimension == 1 ? GLEV_MAP1_COLOR_4 : GLEV_MAP2_COLOR_4) + row.offset;
        state.push_back(glevIsEnabled(gl, target));
        glevGetMapdv(gl, target, GLEV_ORDER, values.data());
        const auto points = static_cast<std::size_t>(dimension == 1 ? values[0] : values[0] * values[1]);
        add(dimension);
        glevGetMapdv(gl, target, GLEV_DOMAIN, values.data());
        add(2 * dimension);
        glevGetMapdv(gl, target, GLEV_COEFF, values.data());
        add(points * row.components);
      }
    }
    state.push_back(glevIsEnabled(gl, GLEV_AUTO_NORMAL));
    const std::pair<glev_enum, std::size_t> names[] = {
        {GLEV_LIST_BASE, 1},        {GLEV_LIST_INDEX, 1},
        {GLEV_LIST_MODE, 1},        {GLEV_ATTRIB_STACK_DEPTH, 1},
        {GLEV_MAP1_GRID_DOMAIN, 2}, {GLEV_MAP1_GRID_SEGMENTS, 1},
        {GLEV_MAP2_GRID_DOMAIN, 4}, {GLEV_MAP2_GRID_SEGMENTS, 2},
        {GLEV_CURRENT_COLOR, 4},    {GLEV_CURRENT_INDEX, 1},
        {GLEV_CURRENT_NORMAL, 3},   {GLEV_EDGE_FLAG, 1},
        {GLEV_ACTIVE_TEXTURE, 1},   {GLEV_CURRENT_TEXTURE_COORDS, 4},
    };
    for (const auto& [name, count] : names) {
      glevGetDoublev(gl, name, values.data());
      add(count);
    }
    const auto active = static_cast<glev_enum>(state[state.size() - 5]);
    for (glev_enum unit = 0; unit < GLEV_TEXTURE_UNITS; ++unit) {
      glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
      glevGetDoublev(gl, GLEV_CURRENT_TEXTURE_COORDS, values.data());
      add(4);
    }
    glevActiveTexture(gl, active);
    return state;
  }

  // Expects exactly one error.
  void expect_error(glev_enum error) const {
    EXPECT_EQ(glevGetError(gl), error);
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_NO_ERROR));
  }

  // Expects that the call records this error and has no other effect.
  void expect_rejected(glev_enum error, const std::function<void()>& call) const {
    const std::vector<double> before = query_state();
    const std::size_t vertices = recording.vertices.size();
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_NO_ERROR)) << "left over";
    call();
    expect_error(error);
    EXPECT_EQ(query_state(), before);
    EXPECT_EQ(recording.vertices.size(), vertices);
  }

  // Expects the same between Begin and End.
  void expect_rejected_in_primitive(glev_enum error, const std::function<void()>& call) const {
    expect_rejected(error, [&] {
      glevBegin(gl, GLEV_POINTS);
      call();
      glevEnd(gl);
    });
  }

  void expect_accepted(const std::function<void()>& call) const {
    call();
    expect_error(GLEV_NO_ERROR);
  }

  // Returns the vertices that a call emits between Begin and End.
  template <class Call>
  const std::vector<glev_vertex>& draw(const Call& call) {
    recording = {};
    glevBegin(gl, GLEV_POINTS);
    call();
    glevEnd(gl);
    return recording.vertices;
  }
  template <class Call>
  glev_vertex one_vertex(const Call& call) {
    draw(call);
    EXPECT_EQ(recording.vertices.size(), 1u);
    return recording.vertices.empty() ? glev_vertex{} : recording.vertices.front();
  }
  // Returns the first components of the positions of all recorded vertices.
  std::vector<float> recorded_positions(int components = 4) const {
    std::vector<float> positions;
    for (const glev_vertex& vertex : recording.vertices) {
      positions.insert(positions.end(), vertex.position, vertex.position + components);
      EXPECT_TRUE(components == 4 || vertex.position[3] == 1);
    }
    return positions;
  }

  glev_context* gl = nullptr;
  Recording recording;
};

template <std::size_t kCount>
std::vector<float> values_of(const float (&values)[kCount]) {
  return {values, values + kCount};
}

using Floats = std::vector<float>;

inline std::uint32_t float_bits(float x) { return std::bit_cast<std::uint32_t>(x); }

template <class Real>
std::vector<std::uint64_t> bits_of(const std::vector<Real>& values) {
  using Word = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  std::vector<std::uint64_t> bits;
  for (Real value : values) bits.push_back(std::bit_cast<Word>(value));
  return bits;
}

// Calls test(gl) with a new context for each instruction set of this machine.
template <class Test>
void on_every_instruction_set(const Test& test) {
  for (std::size_t i = 0; const char* name = glevGetTargetName(i); ++i) {
    SCOPED_TRACE(name);
    const glev_context_info info = {sizeof info, nullptr, name};
    glev_context* gl = nullptr;
    ASSERT_EQ(glevCreateContext(&info, &gl), GLEV_SUCCESS);
    test(gl);
    glevDestroyContext(gl);
  }
}

// The outputs of a batch or a mesh. The batch or mesh refers to this object.
class Outputs {
 public:
  template <class Call>
  Outputs(Call& call, std::initializer_list<glev_attribute_output> outputs) : outputs_(outputs) {
    call.outputs = outputs_.data();
    call.output_count = outputs_.size();
  }
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

 private:
  std::vector<glev_attribute_output> outputs_;
};

}  // namespace glev_tests
