// Tests glevEvaluate with curves and surfaces: for all layouts, points have the bits of EvalCoord, and other
// bytes do not change.
#include <limits>

#include "batches.h"

namespace glev_tests {
namespace {

class ScatteredPoints : public ContextTest {
 protected:
  template <class Real>
  std::vector<glev_vertex> eval_coords(std::size_t dimension, const std::vector<Real>& u,
                                       const std::vector<Real>& v) {
    return draw([&] {
      for (std::size_t i = 0; i < u.size(); ++i) {
        if constexpr (std::is_same_v<Real, float>) {
          dimension == 1 ? glevEvalCoord1f(gl, u[i]) : glevEvalCoord2f(gl, u[i], v[i]);
        } else {
          dimension == 1 ? glevEvalCoord1d(gl, u[i]) : glevEvalCoord2d(gl, u[i], v[i]);
        }
      }
    });
  }

  // Returns an argument inside the domains, near their ends, outside, or non-finite.
  template <class Real>
  Real choose_argument() {
    using Limits = std::numeric_limits<Real>;
    switch (chance_.whole(0, 24)) {
      case 0:
        return chance_.one_of<Real>(
            {0, -0.0F, 1, 0.5F, Limits::denorm_min(), -Limits::min(), 1 - Limits::epsilon()});
      case 1:
        return chance_.one_of<Real>({Limits::max(), Limits::lowest(), 1e19F, -1e6F, 17, -3});
      case 2:
        return chance_.one_of({Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()});
      case 3:
        return static_cast<Real>(3 * chance_.next_double() - 1);
      default:
        return static_cast<Real>(chance_.next_double());
    }
  }

  // The arguments, in a separate stream for each direction.
  template <class Real>
  struct Arguments {
    std::vector<unsigned char> bytes;
    glev_input input;
    std::vector<Real> values;
  };
  template <class Real>
  Arguments<Real> choose_arguments(std::size_t count) {
    const std::size_t stride = chance_.one_of<std::size_t>(
                          {sizeof(Real), sizeof(Real), 0, 2 * sizeof(Real), sizeof(Real) + 3, 1000}),
                      start = chance_.one_of<std::size_t>({0, 0, 1, 6});
    Arguments<Real> arguments;
    const std::size_t bytes = count == 0 ? 0 : (count - 1) * stride + sizeof(Real);
    arguments.bytes.assign(start + bytes, 0xFF);
    for (std::size_t i = 0; i < count; ++i) {
      const Real value = stride == 0 && i > 0 ? arguments.values[0] : choose_argument<Real>();
      arguments.values.push_back(value);
      std::memcpy(arguments.bytes.data() + start + i * stride, &value, sizeof value);
    }
    arguments.input = {arguments.bytes.data() + start, bytes, stride};
    return arguments;
  }

  template <class Real>
  void expect_bits_of_eval_coord(std::size_t dimension, std::size_t count) {
    const Plan plan(gl, dimension);
    const auto u = choose_arguments<Real>(count), v = choose_arguments<Real>(count);
    OutputLayouts layouts(chance_, choose_outputs(chance_, plan), {count}, false);
    Memory memory(layouts.bytes() + kSlack);
    const auto& outputs = layouts.describe(memory.data());
    // FAST makes no difference to curves.
    const glev_precision precision =
        dimension == 1 ? chance_.one_of({GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) : GLEV_CORRECTLY_ROUNDED;
    const glev_batch batch = {sizeof batch,   count,         kTypeOf<Real>,
                              precision,      u.input,       dimension == 2 ? v.input : glev_input{},
                              outputs.data(), outputs.size()};
    ASSERT_EQ(glevEvaluate(plan, &batch), GLEV_SUCCESS);
    const Memory expected = expected_memory(layouts, eval_coords(dimension, u.values, v.values), count);
    ASSERT_TRUE(memory == expected) << "dimension " << dimension << ", " << count << " points, byte "
                                    << memory.mismatch(expected) << " of " << memory.size();
  }

  void expect_bits_of_eval_coord_for_all_counts(int most_order, int repetitions) {
    for (int k = 0; k < repetitions; ++k) {
      define_maps(gl, chance_, most_order);
      enable_maps(gl, chance_);
      for (std::size_t count = 0; count <= 40; ++count) {
        for (std::size_t dimension : {1, 2}) {
          expect_bits_of_eval_coord<float>(dimension, count);
          expect_bits_of_eval_coord<double>(dimension, count);
          if (HasFatalFailure()) return;
        }
      }
    }
  }

  Chance chance_;
};

TEST_F(ScatteredPoints, HaveTheBitsOfEvalCoord) { expect_bits_of_eval_coord_for_all_counts(5, 6); }

TEST_F(ScatteredPoints, OfHighOrdersToo) { expect_bits_of_eval_coord_for_all_counts(12, 2); }

TEST_F(ScatteredPoints, WithAutomaticNormalsToo) {
  glevEnable(gl, GLEV_AUTO_NORMAL);
  expect_bits_of_eval_coord_for_all_counts(4, 2);
}

// The results are unspecified, but equal in all deliveries, and do not affect other components.
TEST_F(ScatteredPoints, OfMapsThatAreNotFiniteToo) {
  for (double bad : {kInfinity, -kInfinity, kNaN}) {
    define_maps(gl, chance_, 5);
    enable_maps(gl, chance_);
    std::vector<double> points(48, 1);
    points[static_cast<std::size_t>(chance_.whole(0, 47))] = bad;
    glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
    glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 16, points.data());
    glevMap2d(gl, GLEV_MAP2_COLOR_4, bad, 1, 16, 3, 0, 1, 4, 3, points.data());
    glevMap1d(gl, GLEV_MAP1_COLOR_4, 0, bad, 4, 3, points.data());
    for (std::size_t count : {1, 5, 33}) {
      for (std::size_t dimension : {1, 2}) expect_bits_of_eval_coord<double>(dimension, count);
    }
  }
}

TEST_F(ScatteredPoints, MayBeWrittenBetweenTheirArguments) {
  const Floats points = chance_.next_points(12);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, points.data());
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  const Plan plan(gl, 1);
  std::vector<std::array<float, 4>> elements(40);  // an argument and a position
  std::vector<float> u;
  for (auto& element : elements) {
    element[0] = chance_.next_float();
    u.push_back(element[0]);
  }
  const std::size_t bytes = elements.size() * 16;
  const glev_output vertex = {sizeof vertex, elements[0].data() + 1, bytes - 4, 16, 3, 0, 0, 0};
  glev_batch batch = {
      sizeof batch, u.size(), GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, {elements[0].data(), bytes, 16},
      {},           nullptr,  0};
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  ASSERT_EQ(glevEvaluate(plan, &batch), GLEV_SUCCESS);
  const std::vector<glev_vertex> one_by_one = eval_coords<float>(1, u, {});
  for (std::size_t i = 0; i < u.size(); ++i) {
    const float* const p = one_by_one[i].position;
    EXPECT_EQ(elements[i], (std::array{u[i], p[0], p[1], p[2]})) << i;
  }
}

// Products of control points and binomial coefficients overflow although results do not.
TEST_F(ScatteredPoints, OfControlPointsNearTheLargestDoubleAreStillRight) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const double points[] = {0, kMost, 2};
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 3, points);
  glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, 1, 3, 0, 1, 1, 1, points);
  for (glev_enum target : {GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP2_TEXTURE_COORD_1, GLEV_MAP1_VERTEX_3}) {
    glevEnable(gl, target);
  }
  const Plan curve(gl, 1), surface(gl, 2);
  const std::vector<double> u = {0x1p-1000, 0, 0x1p-1020, 0x1p-990, 0x1p-1015};
  const Floats got = evaluate_scattered(curve, GLEV_ATTRIBUTE_TEXCOORD, u);
  EXPECT_EQ(evaluate_scattered(surface, GLEV_ATTRIBUTE_TEXCOORD, u, u), got);
  const std::vector<glev_vertex> one_by_one = eval_coords<double>(1, u, {});
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto value = static_cast<float>(2 * u[i] * kMost);  // 2 u^2 is negligible
    EXPECT_EQ(got[i], value) << u[i];
    EXPECT_EQ(one_by_one[i].texcoord[0][0], value) << u[i];
  }
}

}  // namespace
}  // namespace glev_tests
