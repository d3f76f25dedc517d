// Tests that glevEvaluatePatches has the bits of batches and meshes of a plan of each patch, in memory
// between guard pages.
#include <cfenv>
#include <cmath>

#include "exact.h"
#include "guarded.h"
#include "nets.h"

namespace glev_tests {
namespace {

using Side = Guarded::Side;

// The points of a call.
struct Points {
  glev_grid_kind kind = GLEV_GRID_UNIFORM;
  glev_precision precision = GLEV_CORRECTLY_ROUNDED;
  int u_segments = 7, v_segments = 7;
  std::vector<double> u, v;  // arguments of LISTS and SCATTERED
  std::vector<glev_uint> patch;
  bool is_double = true;
  const char* target = nullptr;

  bool is_uniform() const { return kind == GLEV_GRID_UNIFORM; }
  bool is_scattered() const { return kind == GLEV_GRID_SCATTERED; }
  std::size_t columns() const { return is_uniform() ? static_cast<std::size_t>(u_segments) + 1 : u.size(); }
  std::size_t rows() const {
    return is_uniform()                  ? static_cast<std::size_t>(v_segments) + 1
           : is_scattered() || v.empty() ? 1
                                         : v.size();
  }
};

class Patches : public ::testing::Test {
 protected:
  // Makes a plan of one patch; with as_curve, of a MAP1 map.
  static glevaluator::Plan plan_of(const Net& net, std::size_t p, const Points& points, bool normals,
                                   bool as_curve) {
    Net own = net;
    own.count = 1;
    own.is_double = true;
    own.stride = {};
    // Points of one or two components are padded with zeros, which do not affect the others.
    own.components = std::max(net.components, 3);
    own.values.assign(own.values_of_patch(), 0);
    for (int c = 0; c < net.components; ++c) {
      auto to = static_cast<std::size_t>(c);
      for (const double value : net.points_of(p, to)) {
        own.values[to] = value;
        to += static_cast<std::size_t>(own.components);
      }
    }
    const glev_patches patches = own.describe(own.values.data());
    glev_map_info info{};
    info.size = sizeof info;
    info.target = (as_curve ? GLEV_MAP1_VERTEX_3 : GLEV_MAP2_VERTEX_3) + (net.components == 4 ? 1 : 0);
    info.map = &patches;
    info.u_segments = std::max(points.u_segments, 1);
    info.v_segments = as_curve ? 0 : std::max(points.v_segments, 1);
    info.auto_normal = normals;
    info.instruction_set = points.target;
    const glevaluator::Plan plan(info);
    EXPECT_EQ(plan.result(), GLEV_SUCCESS);
    return plan;
  }

  // Returns the expected results of one patch, elements of four values.
  template <class Real>
  static std::vector<Real> expect(const Net& net, std::size_t p, const Points& points,
                                  const OutputLayout& wanted, bool as_curve, const std::vector<double>& u,
                                  const std::vector<double>& v) {
    const bool is_normal = wanted.attribute == GLEV_ATTRIBUTE_NORMAL;
    const glevaluator::Plan plan = plan_of(net, p, points, is_normal, as_curve);
    const std::size_t of_map = is_normal ? 3 : static_cast<std::size_t>(std::max(net.components, 3)),
                      of_net = is_normal ? 3 : static_cast<std::size_t>(net.components);
    const auto scattered = [&]<class Argument>(Argument) {
      const std::vector<Argument> all_u(u.begin(), u.end()), all_v(v.begin(), as_curve ? v.begin() : v.end());
      return evaluate_scattered<Real>(plan.get(), wanted.attribute, all_u, all_v, points.precision);
    };
    const std::vector<Real> values =
        points.is_uniform()
            ? evaluate_grid<Real>(plan.get(), wanted.attribute, {0, points.u_segments, 0, points.v_segments},
                                  points.precision)
        : points.is_double ? scattered(double{})
                           : scattered(float{});
    const bool is_vertex = wanted.attribute == GLEV_ATTRIBUTE_VERTEX;
    std::vector<Real> elements;
    for (std::size_t e = 0; e < values.size() / of_map; ++e) {
      for (std::size_t k = 0; k < 4; ++k)
        elements.push_back(k < of_net ? values[e * of_map + k] : Real(k == 3 && is_vertex));
    }
    return elements;
  }

  // Expects the right bytes of an output.
  template <class Real>
  static void expect_bytes(const Net& net, const Points& points, const OutputLayout& wanted,
                           std::vector<unsigned char>& bytes) {
    const std::size_t columns = points.columns(), rows = points.rows();
    const auto put = [&](std::size_t at, const Real* element) {
      std::memcpy(bytes.data() + at, element, wanted.element());
    };
    // The derivatives of curves are those of a MAP2 map.
    const bool as_curve =
        !points.is_uniform() && net.order[1] == 1 && wanted.attribute == GLEV_ATTRIBUTE_VERTEX;
    if (points.is_scattered()) {
      for (std::size_t i = 0; i < columns; ++i) {
        const double v = points.v.empty() ? 0.5 : points.v[i];
        put(wanted.place(i),
            expect<Real>(net, points.patch[i], points, wanted, as_curve, {points.u[i]}, {v}).data());
      }
      return;
    }
    for (std::size_t p = 0; p < net.count; ++p) {
      std::vector<double> u, v;
      for (std::size_t j = 0; j < rows && !points.is_uniform(); ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
          u.push_back(points.u[i]);
          v.push_back(points.v.empty() ? 0.5 : points.v[j]);
        }
      }
      const std::vector<Real> elements = expect<Real>(net, p, points, wanted, as_curve, u, v);
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i)
          put(wanted.place(i, j, p), &elements[4 * (j * columns + i)]);
      }
    }
  }

  // Evaluates between guard pages and compares all bytes.
  static void check(const Net& net, const Points& points, OutputLayouts& wanted, Side side) {
    Guarded control(net.bytes(), side), memory(wanted.bytes(), side);
    net.write(control.data());
    control.make_read_only();
    const glev_patches patches = net.describe(control.data());
    const std::size_t size = points.is_double ? sizeof(double) : sizeof(float);
    const auto write = [&](const std::vector<double>& values, Guarded& to) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto single = static_cast<float>(values[i]);
        std::memcpy(to.data() + i * size, points.is_double ? static_cast<const void*>(&values[i]) : &single,
                    size);
      }
      to.make_read_only();
    };
    Guarded u(points.u.size() * size, side), v(points.v.size() * size, side),
        numbers(points.patch.size() * sizeof(glev_uint), side);
    write(points.u, u);
    write(points.v, v);
    if (!points.patch.empty()) std::memcpy(numbers.data(), points.patch.data(), numbers.size());
    numbers.make_read_only();
    glev_patch_grid grid{};
    grid.size = sizeof grid;
    grid.kind = points.kind;
    grid.precision = points.precision;
    grid.target = points.target;
    if (points.is_uniform()) {
      grid.u_segments = points.u_segments;
      grid.v_segments = points.v_segments;
    } else {
      grid.type = points.is_double ? GLEV_DOUBLE : GLEV_FLOAT;
      grid.u_count = points.u.size();
      grid.u = {u.data(), u.size(), size};
      if (!points.v.empty()) grid.v = {v.data(), v.size(), size};
      if (!points.is_scattered()) grid.v_count = points.v.size();
      if (points.is_scattered()) grid.patch = {numbers.data(), numbers.size(), sizeof(glev_uint)};
    }
    const std::vector<glev_attribute_output>& list = wanted.describe(memory.data());
    Guarded scratch(glevGetPatchScratchSize(&patches, &grid), side);
    ASSERT_NE(scratch.size(), 0u);
    ASSERT_EQ(glevEvaluatePatches(&patches, &grid, list.data(), list.size(), scratch.data(), scratch.size()),
              GLEV_SUCCESS);
    std::vector<unsigned char> expected(wanted.bytes(), Guarded::kPoisonByte);
    for (const OutputLayout& own : wanted) {
      own.is_double ? expect_bytes<double>(net, points, own, expected)
                    : expect_bytes<float>(net, points, own, expected);
    }
    const std::vector<unsigned char> got = memory.bytes();
    const auto differs = std::mismatch(got.begin(), got.end(), expected.begin()).first - got.begin();
    EXPECT_EQ(got, expected) << "byte " << differs << ", order " << net.order[0] << " x " << net.order[1]
                             << ", " << net.components << " components, " << net.count << " patches, "
                             << (points.target == nullptr ? "best" : points.target);
  }

  // Vertices alone are evaluated in another way than with other outputs.
  std::vector<OutputLayout> choose_outputs(const Net& net) {
    std::vector<OutputLayout> outputs;
    const bool has_others = chance_.whole(0, 1) == 1;
    for (glev_attribute attribute :
         {GLEV_ATTRIBUTE_VERTEX, GLEV_ATTRIBUTE_NORMAL, GLEV_ATTRIBUTE_TANGENT_U, GLEV_ATTRIBUTE_TANGENT_V,
          GLEV_ATTRIBUTE_SECOND_UU, GLEV_ATTRIBUTE_SECOND_UV, GLEV_ATTRIBUTE_SECOND_VV}) {
      const bool is_normal = attribute == GLEV_ATTRIBUTE_NORMAL;
      if (is_normal && net.components < 3) continue;
      if (!outputs.empty() && !(has_others && chance_.whole(0, 1) == 1)) continue;
      const int components = is_normal ? 3 : chance_.whole(net.components, 4);
      outputs.push_back({attribute, static_cast<std::size_t>(components), chance_.whole(0, 2) == 0});
    }
    return outputs;
  }

  void check_random(const Net& net, Points points) {
    points.target = choose_target();
    const std::size_t patches = points.is_scattered() ? 1 : net.count;
    OutputLayouts wanted(chance_, choose_outputs(net), {points.columns(), points.rows(), patches},
                         !points.is_scattered());
    check(net, points, wanted, chance_.one_of({Side::kBegin, Side::kEnd}));
  }

  const char* choose_target() {
    std::vector<const char*> names = {nullptr};
    while (glevGetTargetName(names.size() - 1) != nullptr)
      names.push_back(glevGetTargetName(names.size() - 1));
    return chance_.one_of(names);
  }

  std::vector<double> choose_arguments(std::size_t count, bool are_double) {
    std::vector<double> arguments;
    for (std::size_t i = 0; i < count; ++i) {
      const double random = chance_.next_double(), near = chance_.between(-0.5F, 1.5F);
      const double argument = chance_.one_of({0.0, 1.0, 0.5, 0.25, random, random, near});
      arguments.push_back(are_double ? argument : static_cast<float>(argument));
    }
    return arguments;
  }

  Chance chance_;
};

constexpr NetData kAllData[] = {NetData::kRandom, NetData::kRandom, NetData::kSymmetric, NetData::kDecimal,
                                NetData::kDegenerate};

TEST_F(Patches, UniformGridsHaveTheBitsOfMeshes) {
  for (int k = 0; k < 400 && !HasFailure(); ++k) {
    Points points;
    points.precision = chance_.one_of({GLEV_CORRECTLY_ROUNDED, GLEV_CORRECTLY_ROUNDED, GLEV_FAST});
    points.u_segments = chance_.one_of({0, 1, 2, 3, 4, 6, 7, 8, 12, 16, 20, 24, 33});
    points.v_segments = chance_.one_of({0, 1, 2, 3, 4, 6, 7, 8, 9, 12, 20, 70});
    check_random(choose_net(chance_, k % 8 == 0 ? 9 : 4, chance_.one_of(kAllData)), points);
  }
}

TEST_F(Patches, ListsHaveTheBitsOfBatches) {
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    const Net net = choose_net(chance_, k % 8 == 0 ? 9 : 4, chance_.one_of(kAllData));
    Points points;
    points.kind = GLEV_GRID_LISTS;
    points.is_double = chance_.whole(0, 1) == 1;
    points.u = choose_arguments(static_cast<std::size_t>(chance_.whole(1, 20)), points.is_double);
    points.v = choose_arguments(static_cast<std::size_t>(chance_.whole(net.order[1] == 1 ? 0 : 1, 9)),
                                points.is_double);
    check_random(net, points);
  }
}

TEST_F(Patches, ScatteredPointsHaveTheBitsOfBatches) {
  for (int k = 0; k < 150 && !HasFailure(); ++k) {
    const Net net = choose_net(chance_, k % 8 == 0 ? 9 : 4, chance_.one_of(kAllData));
    Points points;
    points.kind = GLEV_GRID_SCATTERED;
    points.is_double = chance_.whole(0, 1) == 1;
    points.u = choose_arguments(static_cast<std::size_t>(chance_.whole(1, 40)), points.is_double);
    if (net.order[1] > 1 || chance_.whole(0, 1) == 1)
      points.v = choose_arguments(points.u.size(), points.is_double);
    glev_uint patch = 0;
    for (std::size_t i = 0; i < points.u.size(); ++i) {
      if (chance_.whole(0, 2) != 0)
        patch = static_cast<glev_uint>(chance_.whole(0, static_cast<int>(net.count) - 1));
      points.patch.push_back(patch);
    }
    check_random(net, points);
  }
}

// Compares with the oracle in integers.
TEST_F(Patches, VerticesAreCorrectlyRounded) {
  for (int k = 0; k < 60; ++k) {
    Net net = choose_net(chance_, 4, chance_.one_of(kAllData));
    net.domain = {0, 1, 0, 1};
    const int segments = chance_.one_of({3, 7, 8});
    const auto components = static_cast<std::size_t>(net.components),
               side = static_cast<std::size_t>(segments) + 1;
    const Floats results =
        net.evaluate(glevaluator::make_uniform_grid(segments, segments), GLEV_ATTRIBUTE_VERTEX, side * side);
    for (std::size_t at = 0; at < results.size(); ++at) {
      const std::size_t point = at / components, p = point / (side * side);
      const Rational u(point % side, segments), v(point / side % side, segments);
      const float nearest =
          nearest_float(exact_point(net.points_of(p, at % components), net.order, u, v).value);
      ASSERT_EQ(float_bits(results[at]), float_bits(nearest))
          << "patch " << p << " of " << net.count << ", (" << u << ", " << v << ")";
    }
  }
}

// All values but those of row or column 149 of 150 are floats; these are ties. With GLEV_FAST, this holds on
// the boundary. A single patch is evaluated as a mesh.
TEST_F(Patches, TiesOfOneRowOrColumnAreRounded) {
  constexpr int kSegments = 150, kTie = 149, kStep = 112601;
  static_assert(kTie % 2 == 1 && kStep % 2 == 1 && kTie * kStep > 1 << 24 &&
                (kTie - 1) * kStep + 8 < 1 << 24);
  for (int k = 0; k < 8; ++k) {
    const bool is_row = k % 2 == 0, is_fast = k / 2 % 2 == 1;
    Net net;
    net.order = is_row ? std::array{2, 4} : std::array{4, 2};
    net.components = 1;
    net.count = k < 4 ? 1 : 8;
    for (int e = 0; e < 8 * static_cast<int>(net.count); ++e)
      net.values.push_back(kSegments / 3 * kStep * (is_row ? e % 4 : e / 2 % 4) +
                           8 * (is_row ? e / 4 % 2 : e % 2));
    glev_patch_grid grid =
        is_row ? glevaluator::make_uniform_grid(2, kSegments) : glevaluator::make_uniform_grid(kSegments, 2);
    grid.precision = is_fast ? GLEV_FAST : GLEV_CORRECTLY_ROUNDED;
    const Floats results = net.evaluate(grid, GLEV_ATTRIBUTE_VERTEX, 3 * (kSegments + 1));
    for (int at = 0; at < static_cast<int>(results.size()); ++at) {
      const int along = (is_row ? at / 3 : at) % (kSegments + 1), across = is_row ? at % 3 : at / 151 % 3;
      if (is_fast && across == 1) continue;
      EXPECT_EQ(results[static_cast<std::size_t>(at)], static_cast<float>(along * kStep + 4 * across))
          << along << ", " << across << ", case " << k;
    }
  }
}

// NaN, infinities, subnormal and huge numbers in a component do not affect other components.
TEST_F(Patches, ExtremeComponentsHaveNoInfluenceOnOthers) {
  for (int k = 0; k < 100; ++k) {
    Net net = choose_net(chance_, 4, NetData::kRandom);
    net.components = 3;
    net.stride = {};
    net.values.clear();
    for (std::size_t e = 0; e < net.count * net.values_of_patch() / 3; ++e) {
      net.values.push_back(chance_.between(-1, 1));
      net.values.push_back(chance_.one_of({kNaN, kInfinity, 3e38, 0x1p-149, 0.0}));
      net.values.push_back(chance_.between(-1, 1) * 0x1p-140);
    }
    Net without = net;
    for (std::size_t e = 1; e < without.values.size(); e += 3) without.values[e] = 1;
    Floats results = net.evaluate(glevaluator::make_uniform_grid(7, 7), GLEV_ATTRIBUTE_VERTEX, 64),
           others = without.evaluate(glevaluator::make_uniform_grid(7, 7), GLEV_ATTRIBUTE_VERTEX, 64);
    for (std::size_t e = 1; e < results.size(); e += 3) results[e] = others[e] = 0;
    ASSERT_EQ(bits_of(results), bits_of(others)) << "case " << k;
  }
}

TEST_F(Patches, DoNotDependOnTheCallersRoundingMode) {
  Net net;
  net.count = 11;
  for (std::size_t e = 0; e < net.count * net.values_of_patch(); ++e)
    net.values.push_back(chance_.between(-1, 1));
  const auto evaluate = [&] {
    return bits_of(net.evaluate(glevaluator::make_uniform_grid(7, 7), GLEV_ATTRIBUTE_VERTEX, 64));
  };
  const auto nearest = evaluate();
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const auto results = evaluate();
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(results, nearest) << mode;
  }
}

}  // namespace
}  // namespace glev_tests
