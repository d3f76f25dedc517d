// Tests the fast path of consecutive EvalCoord calls between Begin and End: results are those of the first
// call, and it is used only if it is permitted.
#include <cfenv>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "batches.h"

namespace glev_tests {
namespace {

class DirectCalls : public ContextTest {
 protected:
  Chance chance;

  Floats random_points(std::size_t count) {
    Floats points;
    const float scale = std::ldexp(1.0F, chance.whole(-70, 70));
    for (std::size_t i = 0; i < count; ++i) {
      const float value = chance.one_of({chance.between(-2, 2), chance.between(-2, 2), 0.0F, 1.0F, 1e-30F});
      points.push_back(value * scale);
    }
    return points;
  }
  // Returns the ends of the domain, arguments far outside, subnormal and random ones.
  Floats choose_arguments() {
    Floats u = {0, 1, -0.0F, 0x1p-149F, -0x1p-130F, 0x1p-126F, 1.5F, -3, 1e38F};
    for (int i = 0; i < 60; ++i) u.push_back(chance.between(0, 1));
    return u;
  }

  void define_line(glev_enum target = GLEV_MAP1_VERTEX_3) const {
    const float points[][3] = {{1, 2, 3}, {3, 2, 3}};
    glevMap1f(gl, target, 0, 1, 3, 2, &points[0][0]);
    glevEnable(gl, target);
  }
};

TEST_F(DirectCalls, CurvesAreThoseOfBatches) {
  for (int trial = 0; trial < 300; ++trial) {
    const int components = chance.whole(3, 4), order = chance.one_of({1, 2, 3, 4, 4, 5, 8, 20});
    const glev_enum target = components == 3 ? GLEV_MAP1_VERTEX_3 : GLEV_MAP1_VERTEX_4;
    const Floats points = random_points(static_cast<std::size_t>(components * order));
    const float end = chance.one_of({1.0F, 1.0F, 0.3F, -2.0F});
    glevDisable(gl, GLEV_MAP1_VERTEX_4);
    glevMap1f(gl, target, 0, end, components, order, points.data());
    glevEnable(gl, target);
    const Floats u = choose_arguments();
    draw([&] {
      for (const float argument : u) glevEvalCoord1f(gl, argument);
    });
    const Plan plan(gl, 1);
    EXPECT_EQ(bits_of(recorded_positions(components)),
              bits_of(evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, u)))
        << "order " << order << ", components " << components << ", to " << end;
  }
}

TEST_F(DirectCalls, SurfacesAreThoseOfBatches) {
  for (int trial = 0; trial < 300; ++trial) {
    const int components = chance.whole(3, 4);
    const int n = chance.one_of({4, 4, 1, 2, 7}), m = chance.one_of({4, 4, 1, 3, 9});
    const glev_enum target = components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
    const Floats points = random_points(static_cast<std::size_t>(components * n * m));
    const float end = chance.one_of({1.0F, 1.0F, 0.7F, -4.0F});
    glevDisable(gl, GLEV_MAP2_VERTEX_4);
    glevMap2f(gl, target, 0, end, components * m, n, -1, 1, components, m, points.data());
    glevEnable(gl, target);
    const Floats u = choose_arguments(), v(u.rbegin(), u.rend());
    draw([&] {
      for (std::size_t i = 0; i < u.size(); ++i) glevEvalCoord2f(gl, u[i], v[i]);
    });
    const Plan plan(gl, 2);
    EXPECT_EQ(bits_of(recorded_positions(components)),
              bits_of(evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, u, v)))
        << n << " x " << m << ", components " << components << ", to " << end;
  }
}

// The floating-point environment may change after Begin, too.
TEST_F(DirectCalls, InWhateverEnvironment) {
  Floats points;
  for (int i = 0; i < 12; ++i) points.push_back(i % 3 == 1 ? 0 : chance.between(-2, 2));
  // With flush-to-zero, both ends of the interval of a subnormal result would become zero.
  const Floats small = {-0x1p-90F, -0x1p-80F, 0x1p-95F, 0x1p-90F, 0x1p-80F, -0x1p-95F};
  const Floats u = choose_arguments();
  const auto evaluate = [&](const std::function<void()>& change) {
    std::vector<std::uint64_t> bits;
    for (const Floats& control : {points, small}) {
      glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, static_cast<int>(control.size() / 3), control.data());
      glevEnable(gl, GLEV_MAP1_VERTEX_3);
      std::fenv_t before;
      std::fegetenv(&before);
      draw([&] {
        glevEvalCoord1f(gl, 0.25F);
        change();
        for (const float argument : u) glevEvalCoord1f(gl, argument);
        for (int i = 0; i < 50; ++i) glevEvalCoord1d(gl, 0.5 + (i - 25) * std::ldexp(1.0, -52 + i % 20));
        std::fesetenv(&before);
      });
      const auto more = bits_of(recorded_positions());
      bits.insert(bits.end(), more.begin(), more.end());
    }
    return bits;
  };
  const auto expected = evaluate([] {});
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    EXPECT_EQ(evaluate([&] { std::fesetround(rounding); }), expected) << rounding;
#if defined(__SSE2__)
  for (const unsigned control : {0x9F80U, 0x1FC0U, 0x9FC0U, 0xFFC0U})
    EXPECT_EQ(evaluate([&] { _mm_setcsr(control); }), expected) << std::hex << control;
#endif
}

TEST_F(DirectCalls, HaveNoEffectWithoutAPrimitiveOrAMapAndAreCompiled) {
  define_line();
  const auto evaluate = [&] {
    for (int i = 0; i < 3; ++i) glevEvalCoord1f(gl, 0.5F);
  };
  EXPECT_EQ(draw(evaluate).size(), 3u);
  evaluate();
  EXPECT_EQ(recording.vertices.size(), 3u);
  glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
  draw(evaluate);
  glevEndList(gl);
  recording = {};
  glevCallList(gl, 1);
  EXPECT_EQ(recording.vertices.size(), 3u);
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  EXPECT_EQ(draw(evaluate).size(), 0u);
}

TEST_F(DirectCalls, FromCallbacks) {
  struct State {
    glev_context* gl;
    int calls = 0;
    std::vector<float> x;
  } state{gl, 0, {}};
  define_line();
  // Evaluates again within a callback, then ends the primitive and disables its map.
  const glev_sink sink = {sizeof sink, &state, nullptr,
                          [](void* user, const glev_vertex* vertex) {
                            auto* self = static_cast<State*>(user);
                            self->x.push_back(vertex->position[0]);
                            if (++self->calls == 2) glevEvalCoord1f(self->gl, 1);
                            if (self->calls == 2 || self->calls == 3) self->x.push_back(vertex->position[0]);
                            if (self->calls == 5) {
                              glevEnd(self->gl);
                              glevDisable(self->gl, GLEV_MAP1_VERTEX_3);
                            }
                          },
                          nullptr};
  glevSetSink(gl, &sink);
  glevBegin(gl, GLEV_POINTS);
  for (int i = 0; i < 8; ++i) glevEvalCoord1f(gl, 0.5F);
  EXPECT_EQ(state.x, (std::vector<float>{2, 2, 3, 3, 2, 2, 2}));
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord1f(gl, 0.5F);
  glevEnd(gl);
  EXPECT_EQ(state.calls, 5);
  expect_error(GLEV_NO_ERROR);
}

}  // namespace
}  // namespace glev_tests
