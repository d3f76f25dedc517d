// Tests glevEvaluateMesh: for all grids, ranges and layouts, points have the bits of EvalPoint, and other
// bytes do not change.
#include <climits>

#include "batches.h"
#include "ledger.h"

namespace glev_tests {
namespace {

struct GridCase {
  int segments;
  double u1, u2;
};

// Grids: over the domain [0, 1] or reversed, with one segment, over other intervals, with equal ends, with
// many segments, and with extreme ends.
constexpr GridCase kGridCases[] = {{8, 0, 1},      {7, 1, 0},       {1, 0, 1},
                                   {5, 0.25, 0.8}, {3, -1, 4.7},    {11, 0.3, 0.3},
                                   {64, 0, 1},     {INT_MAX, 0, 1}, {2, 1e-300, 1e10}};

class GridPoints : public ContextTest {
 protected:
  void set_grids(const GridCase& u, const GridCase& v) {
    glevMapGrid1d(gl, u.segments, u.u1, u.u2);
    glevMapGrid2d(gl, u.segments, u.u1, u.u2, v.segments, v.u1, v.u2);
  }

  std::vector<glev_vertex> eval_points(std::size_t dimension, const Range& range) {
    return draw([&] {
      for (std::int64_t j = range.j1; j <= range.j2; ++j) {
        for (std::int64_t i = range.i1; i <= range.i2; ++i) {
          dimension == 1 ? glevEvalPoint1(gl, static_cast<int>(i))
                         : glevEvalPoint2(gl, static_cast<int>(i), static_cast<int>(j));
        }
      }
    });
  }

  void expect_bits_of_eval_point(std::size_t dimension, const Range& range) {
    const Plan plan(gl, dimension);
    const std::size_t columns = range.columns(), rows = range.rows();
    OutputLayouts layouts(chance_, choose_outputs(chance_, plan), {columns, rows}, dimension == 2);
    Memory memory(layouts.bytes() + kSlack);
    const auto& outputs = layouts.describe(memory.data());
    glev_mesh mesh = mesh_of(range);
    mesh.outputs = outputs.data();
    mesh.output_count = outputs.size();
    // The scratch memory has exactly the required size and any alignment.
    const std::size_t scratch_size = glevGetMeshScratchSize(plan, &mesh),
                      start = static_cast<std::size_t>(chance_.whole(0, 70));
    Memory scratch(start + scratch_size + 64);
    mesh.scratch = scratch.data() + start;
    mesh.scratch_size = scratch_size;
    ASSERT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
    const Memory expected = expected_memory(layouts, eval_points(dimension, range), columns);
    ASSERT_TRUE(memory == expected) << "dimension " << dimension << ", " << columns << " x " << rows
                                    << " from " << range.i1 << ", " << range.j1 << ", byte "
                                    << memory.mismatch(expected) << " of " << memory.size();
    scratch.poison(start, scratch_size);
    ASSERT_TRUE(scratch.is_untouched());
  }

  // Returns a range of at most `most` indices: inside the grid, across its ends, or far away.
  std::pair<int, int> choose_range(int segments, int most) {
    const int count = chance_.whole(0, most);
    const std::int64_t first = chance_.one_of<std::int64_t>(
        {0, 0, -3, chance_.whole(0, segments), std::int64_t{segments} - count + 1, -count / 2, INT_MIN,
         std::int64_t{INT_MAX} - count + 1, -1000000});
    if (count == 0) return {chance_.one_of({1, 0, INT_MAX}), chance_.one_of({-1, INT_MIN})};
    const std::int64_t i1 = std::min(first, std::int64_t{INT_MAX} - count + 1);
    return {static_cast<int>(i1), static_cast<int>(i1 + count - 1)};
  }

  void expect_bits_of_eval_point_everywhere(int most_order) {
    for (const GridCase& u : kGridCases) {
      for (const GridCase& v : kGridCases) {
        define_maps(gl, chance_, most_order);
        enable_maps(gl, chance_);
        // The map has the domain [0, 1], because grids that span the domain have their own code path.
        std::vector<float> points = chance_.next_points(16 * 3);
        glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
        glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, points.data());
        set_grids(u, v);
        const auto [i1, i2] = choose_range(u.segments, 40);
        const auto [j1, j2] = choose_range(v.segments, 6);
        expect_bits_of_eval_point(1, {i1, i2});
        expect_bits_of_eval_point(2, {i1, i2, j1, j2});
        if (HasFatalFailure()) return;
      }
    }
  }

  Chance chance_;
};

TEST_F(GridPoints, HaveTheBitsOfEvalPoint) {
  for (int k = 0; k < 3; ++k) expect_bits_of_eval_point_everywhere(5);
}

TEST_F(GridPoints, OfHighOrdersToo) { expect_bits_of_eval_point_everywhere(10); }

TEST_F(GridPoints, WithAutomaticNormalsToo) {
  glevEnable(gl, GLEV_AUTO_NORMAL);
  expect_bits_of_eval_point_everywhere(4);
}

TEST_F(GridPoints, OfAnyNumberOfColumns) {
  define_maps(gl, chance_, 4);
  enable_maps(gl, chance_);
  set_grids({70, 0, 1}, {3, 0, 1});
  for (int columns = 0; columns <= 70; ++columns) {
    expect_bits_of_eval_point(1, {0, columns - 1});
    expect_bits_of_eval_point(2, {-1, columns - 2, 1, 2});
    if (HasFatalFailure()) return;
  }
}

// u (1 - u) is zero at both ends, with any number of segments.
TEST_F(GridPoints, AtTheEndsAreExact) {
  const float arch[] = {0, 0, 0, 1, 1, 1, 0, 0, 0};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 3, arch);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (int n = 1; n <= 130; ++n) {
    glevMapGrid1f(gl, n, 0, 1);
    const Floats points = evaluate_grid(Plan(gl, 1), GLEV_ATTRIBUTE_VERTEX, {0, n, 0, 0});
    EXPECT_TRUE(points.front() == 0 && points.back() == 0) << n << " segments";
  }
}

TEST_F(GridPoints, OfGridsThatAreNotFiniteDoNoHarm) {
  for (double bad : {kInfinity, -kInfinity, kNaN, 1.7e308}) {
    define_maps(gl, chance_, 4);
    enable_maps(gl, chance_);
    for (const GridCase& u : {GridCase{5, bad, 1}, {5, 0, bad}, {5, bad, -bad}, {5, bad, bad}}) {
      set_grids(u, {4, 0, 1});
      expect_bits_of_eval_point(1, {-2, 12});
      expect_bits_of_eval_point(2, {-2, 12, 0, 3});
      set_grids({4, 0, 1}, u);
      expect_bits_of_eval_point(2, {-2, 12, 0, 3});
      if (HasFatalFailure()) return;
    }
  }
}

// ---- Scratch memory

class Scratch : public GridPoints {
 protected:
  Scratch() {
    define_maps(gl, chance_, 6);
    enable_maps(gl, chance_);
    set_grids({20, 0, 1}, {20, 0, 1});
  }
};

TEST_F(Scratch, DependsOnTheColumnsAlone) {
  const Plan plan(gl, 2);
  glev_mesh mesh = mesh_of({0, 9, 0, 9});
  const std::size_t size = glevGetMeshScratchSize(plan, &mesh);
  EXPECT_GT(size, 0u);
  mesh = mesh_of({5, 14, -7, 900});
  EXPECT_EQ(glevGetMeshScratchSize(plan, &mesh), size);
  const glev_output output{};  // outputs do not change the size
  const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &output}});
  EXPECT_EQ(glevGetMeshScratchSize(plan, &mesh), size);
  mesh = mesh_of({0, 999, 0, 9});
  EXPECT_GT(glevGetMeshScratchSize(plan, &mesh), size);
  // All indices: 2^32 columns.
  mesh = mesh_of({INT_MIN, INT_MAX, INT_MIN, INT_MAX});
  EXPECT_GE(glevGetMeshScratchSize(plan, &mesh), std::size_t{1} << 35);
}

TEST_F(Scratch, OneByteLessIsTooSmall) {
  for (std::size_t dimension : {1, 2}) {
    const Plan plan(gl, dimension);
    glev_mesh mesh = mesh_of({0, 9, 0, dimension == 1 ? 0 : 9});
    Memory memory(4096), scratch(glevGetMeshScratchSize(plan, &mesh));
    const glev_output color = memory.make_output(0, 16, 4);
    const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_COLOR, &color}});
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size() - 1;
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_ERROR_BUFFER_TOO_SMALL);
    mesh.scratch = nullptr;
    mesh.scratch_size = 0;
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_ERROR_BUFFER_TOO_SMALL);
    EXPECT_TRUE(memory.is_untouched());
    EXPECT_TRUE(scratch.is_untouched());
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size();
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
  }
}

TEST_F(Scratch, IsNotNeededForNoPoints) {
  const Plan plan(gl, 2);
  Memory memory(100);
  const glev_output color = memory.make_output(0, 16, 4);
  for (const Range& range : {Range{1, 0, 0, 3}, {0, 3, 1, 0}, {INT_MAX, INT_MIN, INT_MAX, INT_MIN}}) {
    glev_mesh mesh = mesh_of(range);
    const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_COLOR, &color}});
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
  }
  EXPECT_TRUE(memory.is_untouched());
}

// The sizes exceed memory, but not size_t.
TEST_F(Scratch, ExtremeRangesAreRefusedWithoutOverflow) {
  const Plan plan(gl, 2);
  Memory memory(4096), scratch(4096);
  for (const Range& range : {Range{INT_MIN, INT_MAX, 0, 0},
                             {0, 0, INT_MIN, INT_MAX},
                             {INT_MIN, INT_MAX, INT_MIN, INT_MAX},
                             {0, INT_MAX, 0, INT_MAX},
                             {INT_MIN, -1, -1, INT_MAX - 2}}) {
    for (std::size_t stride : {std::size_t{16}, std::size_t{1} << 31, SIZE_MAX / 2 + 1, SIZE_MAX}) {
      for (std::size_t row_stride : {std::size_t{0}, SIZE_MAX / 2, SIZE_MAX}) {
        for (std::size_t size : {memory.size(), SIZE_MAX}) {
          if (size == SIZE_MAX && stride <= SIZE_MAX / 2) continue;  // the points may fit into so much memory
          glev_output color = memory.make_output(0, stride, 4, 0, row_stride);
          color.data_size = size;
          glev_mesh mesh = mesh_of(range);
          const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_COLOR, &color}});
          mesh.scratch = scratch.data();
          mesh.scratch_size = scratch.size();
          EXPECT_NE(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
          mesh.scratch_size = SIZE_MAX;
          EXPECT_NE(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
        }
      }
    }
  }
  EXPECT_TRUE(memory.is_untouched());
  EXPECT_TRUE(scratch.is_untouched());
}

TEST(BatchMemory, EvaluationDoesNotAllocate) {
  Ledger ledger;
  const glev_allocator allocator = ledger.make_allocator();
  const glev_context_info info = {sizeof info, &allocator, nullptr};
  glev_context* gl = nullptr;
  ASSERT_EQ(glevCreateContext(&info, &gl), GLEV_SUCCESS);
  Chance chance;
  define_maps(gl, chance, 12);
  enable_maps(gl, chance);
  glevMapGrid2f(gl, 10, 0, 1, 10, 0.1F, 2);
  {
    const Plan curve(gl, 1), surface(gl, 2);
    const int requests = ledger.requests;
    ledger.refuse_from = 0;
    const std::vector<float> u = {0, 0.25F, 1, 7, 0.3F};
    for (glev_attribute attribute : kEveryAttribute) {
      for (glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
        evaluate_scattered(curve, attribute, u, {}, precision);
        evaluate_scattered<double>(surface, attribute, u, u, precision);
        evaluate_grid(curve, attribute, {0, 10}, precision);
        evaluate_grid(surface, attribute, {0, 10, 0, 10}, precision);
        evaluate_grid<double>(surface, attribute, {0, 10, 0, 10}, precision);
      }
    }
    EXPECT_EQ(ledger.requests, requests);
  }
  glevDestroyContext(gl);
  EXPECT_TRUE(ledger.out.empty());
}

// Sanitizers detect aligned stores to unaligned memory. Many results of the data are undecided in double.
TEST(UnalignedMeshes, AreTheSameOnEveryInstructionSet) {
  constexpr Range kRange = {0, 70, 0, 5};
  Chance chance;
  on_every_instruction_set([&](glev_context* gl) {
    for (const int order : {2, 3, 4, 6}) {
      for (const glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
        std::vector<float> points(static_cast<std::size_t>(order) * 4 * 3);
        for (float& point : points) point = static_cast<float>(chance.whole(-9, 9));
        glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, order, 0, 1, 3, 4, points.data());
        glevEnable(gl, GLEV_MAP2_VERTEX_3);
        glevMapGrid2f(gl, 1024, 0, 1, 1024, 0, 1);
        const Plan plan(gl, 2);
        const Floats aligned = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, kRange, precision);
        Memory memory(aligned.size() * sizeof(float) + 1);
        const glev_output output = memory.make_output(1, 3 * sizeof(float), 3, GLEV_FLOAT);
        glev_mesh mesh = mesh_of(kRange, precision);
        const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &output}});
        evaluate_mesh(plan, mesh);
        EXPECT_EQ(std::memcmp(memory.data() + 1, aligned.data(), aligned.size() * sizeof(float)), 0)
            << "order " << order << ", precision " << precision;
      }
    }
  });
}

}  // namespace
}  // namespace glev_tests
