// Tests that every instruction set of this machine gives the same bits, for single points and for many.
#include "batches.h"

namespace glev_tests {
namespace {

// Returns the bits of the results of maps of both dimensions: by single calls, batches and meshes, in float
// and double.
std::vector<std::uint64_t> everything_of(const char* target, unsigned seed, int least_order, int most_order) {
  Recording recording;
  glev_context* gl = nullptr;
  const glev_context_info info = {sizeof info, nullptr, target};
  EXPECT_EQ(glevCreateContext(&info, &gl), GLEV_SUCCESS) << target;
  if (gl == nullptr) return {};
  const glev_sink sink = recording.make_sink();
  glevSetSink(gl, &sink);

  Chance chance(seed);
  const auto points = [&](int n, int m, int components) {
    // Half of the data is such that evaluation in double is exact.
    const bool is_exact = chance.whole(0, 1) == 1;
    std::vector<float> values = chance.next_points(static_cast<std::size_t>(n) * m * components);
    for (float& value : values) value = is_exact ? std::round(8 * value) : value;
    return values;
  };
  const auto order = [&] { return chance.whole(least_order, most_order); };
  for (glev_enum target_of : {GLEV_MAP1_COLOR_4, GLEV_MAP1_NORMAL, GLEV_MAP1_TEXTURE_COORD_1,
                              GLEV_MAP1_TEXTURE_COORD_2, GLEV_MAP1_VERTEX_3}) {
    const int components = kTargetRows[target_of - GLEV_MAP1_COLOR_4].components;
    const glev_enum second = target_of - GLEV_MAP1_COLOR_4 + GLEV_MAP2_COLOR_4;
    const float u1 = chance.one_of({0.0F, 0.0F, -0.3F, 1.0F}), u2 = u1 + chance.one_of({1.0F, 0.7F});
    const int n = order(), m = order();
    glevMap1f(gl, target_of, u1, u2, components, n, points(n, 1, components).data());
    glevMap2f(gl, second, u1, u2, components * m, n, 0, 1, components, m, points(n, m, components).data());
    glevEnable(gl, target_of);
    glevEnable(gl, second);
  }
  glevMapGrid1f(gl, 16, 0, 1);
  glevMapGrid2f(gl, 16, 0, 1, 3, -0.1F, 1.2F);

  std::vector<float> u, v;
  for (int i = 0; i < 37; ++i) {
    u.push_back(i % 5 == 0   ? chance.between(-1, 2)
                : i % 7 == 0 ? static_cast<float>(i % 9) / 8
                             : chance.next_float());
    v.push_back(chance.next_float());
  }
  std::vector<std::uint64_t> bits;
  const auto add = [&](const auto& values) {
    const auto more = bits_of(values);
    bits.insert(bits.end(), more.begin(), more.end());
  };
  {
    const Plan curve(gl, 1), surface(gl, 2);
    for (glev_attribute attribute : kEveryAttribute) {
      add(evaluate_scattered(curve, attribute, u));
      add(evaluate_scattered(surface, attribute, u, v));
      add(evaluate_scattered<double>(curve, attribute, u));
      add(evaluate_grid(curve, attribute, {-1, 19}));
      add(evaluate_grid(surface, attribute, {0, 16, -1, 3}));
      add(evaluate_grid<double>(surface, attribute, {3, 5, -1, 3}));
    }
    // Double results have their own code path on grids that span the domain.
    glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points(4, 4, 3).data());
    glevMapGrid2f(gl, 30, 0, 1, 7, 0, 1);
    const Plan spanned(gl, 2);
    add(evaluate_grid<double>(spanned, GLEV_ATTRIBUTE_VERTEX, {0, 30, 0, 7}));
  }
  glevBegin(gl, GLEV_POINTS);
  for (std::size_t i = 0; i < u.size(); ++i) {
    glevEvalCoord1f(gl, u[i]);
    glevEvalCoord2f(gl, u[i], v[i]);
  }
  glevEnd(gl);
  glevEvalMesh2(gl, GLEV_FILL, 0, 5, 0, 3);
  for (const glev_vertex& vertex : recording.vertices) {
    for (glev_attribute attribute : kEveryAttribute) add(attribute_of(vertex, attribute));
  }
  glevDestroyContext(gl);
  return bits;
}

void expect_same_bits_everywhere(unsigned seed, int least_order, int most_order) {
  const std::vector<std::uint64_t> best = everything_of(nullptr, seed, least_order, most_order);
  for (std::size_t i = 0; const char* target = glevGetTargetName(i); ++i)
    ASSERT_TRUE(everything_of(target, seed, least_order, most_order) == best)
        << target << ", orders " << least_order << " to " << most_order << ", seed " << seed;
}

TEST(InstructionSets, GiveTheSameBitsForEveryOrder) {
  for (int order : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 17, 31, 64})
    expect_same_bits_everywhere(kSeed, order, order);
}

TEST(InstructionSets, GiveTheSameBitsForLowOrders) {
  for (unsigned seed = 0; seed < 60; ++seed) expect_same_bits_everywhere(seed, 1, 5);
}

TEST(InstructionSets, HaveNames) {
  std::vector<std::string> names;
  for (std::size_t i = 0; const char* name = glevGetTargetName(i); ++i) names.emplace_back(name);
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.back(), "baseline");
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(std::count(names.begin(), names.end(), names[i]), 1);
  for (std::size_t index : {names.size(), names.size() + 1, SIZE_MAX})
    EXPECT_EQ(glevGetTargetName(index), nullptr);
}

TEST(InstructionSets, OfOtherNamesAreRefused) {
  for (const char* name : {"", " ", "AVX", "avx2", "AVX2 ", "AVX3x", "NEON?", "best"}) {
    int marker = 0;
    auto* gl = reinterpret_cast<glev_context*>(&marker);
    const glev_context_info info = {sizeof info, nullptr, name};
    EXPECT_EQ(glevCreateContext(&info, &gl), GLEV_ERROR_INVALID_ARGUMENT) << name;
    EXPECT_EQ(gl, nullptr);
  }
}

}  // namespace
}  // namespace glev_tests
