// Tests that glevEvaluatePatches, glevGetPatchScratchSize and glevCreatePlanFromMap reject each invalid
// member with the right result, without writing anything.
#include <climits>
#include <functional>

#include "ledger.h"
#include "misuse.h"
#include "nets.h"

namespace glev_tests {
namespace {

constexpr std::size_t kPatches = 3;

constexpr glev_grid_kind kAllKinds[] = {GLEV_GRID_UNIFORM, GLEV_GRID_LISTS, GLEV_GRID_SCATTERED,
                                        GLEV_GRID_EDGES};

// Valid calls with each kind of grid, which tests make invalid.
class PatchMisuse : public ::testing::Test {
 protected:
  static constexpr std::size_t kOrder = 3, kPoints = 4;

  struct Call {
    glev_patches patches{};
    glev_patch_grid grid{};
    glev_output vertex{}, tangent{};
    std::vector<glev_attribute_output> outputs;
    const glev_patches* patches_at = &patches;
    const glev_patch_grid* grid_at = &grid;
    const glev_attribute_output* outputs_at = nullptr;
    std::size_t output_count = 2;
    void* scratch = nullptr;
    std::size_t scratch_size = 0;
  };
  using Change = std::function<void(Call&)>;

  PatchMisuse() {
    for (std::size_t k = 0; k < std::size(control_); ++k) control_[k] = static_cast<float>(k % 7);
  }

  void fill(Call& call, glev_grid_kind kind, Memory& memory, Memory& scratch) {
    call.patches = glevaluator::make_patches<float>(control_, 3, kOrder, kOrder);
    constexpr int kSegments = kPoints - 1;
    const std::span<const float> arguments(arguments_);
    switch (kind) {
      case GLEV_GRID_UNIFORM:
        call.grid = glevaluator::make_uniform_grid(kSegments, 1);
        break;
      case GLEV_GRID_EDGES:
        call.grid = glevaluator::make_edge_grid(kSegments, 2, {2, 2, 2, 2});
        break;
      case GLEV_GRID_LISTS:
        call.grid = glevaluator::make_list_grid(arguments, arguments.first(2));
        break;
      case GLEV_GRID_SCATTERED:
        call.grid =
            glevaluator::make_scattered_grid(std::span<const glev_uint>(numbers_), arguments, arguments);
    }
    call.vertex = memory.make_output(0, 24, 3);
    call.tangent = memory.make_output(12, 24, 3);
    call.outputs = {{GLEV_ATTRIBUTE_VERTEX, &call.vertex}, {GLEV_ATTRIBUTE_TANGENT_V, &call.tangent}};
    call.outputs_at = call.outputs.data();
    call.scratch = scratch.data();
    call.scratch_size = scratch.size();
  }

  static glev_result evaluate(const Call& call) {
    return glevEvaluatePatches(call.patches_at, call.grid_at, call.outputs_at, call.output_count,
                               call.scratch, call.scratch_size);
  }

  // Changes a legal call and expects its result. `has_no_size`: the scratch size is 0, because the patches or
  // the grid are rejected.
  void expect(glev_result expected, glev_grid_kind kind, const char* what, const Change& change,
              bool has_no_size = false) {
    SCOPED_TRACE(testing::Message() << what << ", kind " << kind);
    Memory memory(2048), scratch(1 << 16);
    Call call;
    fill(call, kind, memory, scratch);
    change(call);
    EXPECT_EQ(evaluate(call), expected);
    EXPECT_EQ(memory.is_untouched(), expected != GLEV_SUCCESS);
    EXPECT_TRUE(expected == GLEV_SUCCESS || scratch.is_untouched());
    if (has_no_size) {
      EXPECT_EQ(glevGetPatchScratchSize(call.patches_at, call.grid_at), 0u);
    }
  }
  void expect_all(glev_result expected, const char* what, const Change& change) {
    for (glev_grid_kind kind : kAllKinds) expect(expected, kind, what, change);
  }
  void expect_none(glev_grid_kind kind, const char* what, const Change& change) {
    expect(kInvalid, kind, what, change, true);
  }
  void expect_none(const char* what, const Change& change, glev_result expected = kInvalid) {
    for (glev_grid_kind kind : kAllKinds) expect(expected, kind, what, change, true);
  }

  float control_[kPatches * kOrder * kOrder * 3];
  float arguments_[kPoints] = {0, 0.25F, 0.5F, 1};
  glev_uint numbers_[kPoints] = {2, 0, 0, 1};
};

TEST_F(PatchMisuse, LegalCallsSucceed) {
  expect_all(GLEV_SUCCESS, "nothing", [](Call&) {});
  expect_all(GLEV_SUCCESS, "one output", [](Call& call) { call.output_count = 1; });
  expect_all(GLEV_SUCCESS, "fast", [](Call& call) { call.grid.precision = GLEV_FAST; });
  expect_all(GLEV_SUCCESS, "the last target", [](Call& call) {
    for (std::size_t i = 0; glevGetTargetName(i) != nullptr; ++i) call.grid.target = glevGetTargetName(i);
  });
  expect_all(GLEV_SUCCESS, "exactly enough scratch",
             [](Call& call) { call.scratch_size = glevGetPatchScratchSize(&call.patches, &call.grid); });
  expect_all(GLEV_SUCCESS, "a domain", [](Call& call) { call.patches.u1 = 2, call.patches.v2 = -1; });
}

TEST_F(PatchMisuse, OfPatches) {
  expect_none("null", [](Call& call) { call.patches_at = nullptr; });
  expect_none(
      "size 0", [](Call& call) { call.patches.size = 0; }, kWrongSize);
  expect_none(
      "size - 1", [](Call& call) { --call.patches.size; }, kWrongSize);
  for (std::size_t components : {std::size_t{0}, std::size_t{5}, SIZE_MAX})
    expect_none("components", [&](Call& call) { call.patches.components = components; });
  for (int order : {0, -1, 65, INT_MAX, INT_MIN}) {
    expect_none("uorder", [&](Call& call) { call.patches.uorder = order; });
    expect_none("vorder", [&](Call& call) { call.patches.vorder = order; });
  }
  for (glev_enum type : {0, GLEV_INT, 1}) expect_none("type", [&](Call& call) { call.patches.type = type; });
  expect_none("u1 = u2", [](Call& call) { call.patches.u1 = call.patches.u2 = 1; });
  expect_none("v1 = v2", [](Call& call) { call.patches.v1 = call.patches.v2 = -2; });
  expect_none("infinite u1 = u2", [](Call& call) { call.patches.u1 = call.patches.u2 = kInfinity; });
  expect_all(GLEV_SUCCESS, "NaN is equal to nothing",
             [](Call& call) { call.patches.u1 = call.patches.u2 = kNaN; });
}

TEST_F(PatchMisuse, OfControlPoints) {
  expect_all(kInvalid, "null", [](Call& call) { call.patches.points = nullptr; });
  expect_all(kTooSmall, "no bytes", [](Call& call) { call.patches.points_size = 0; });
  expect_all(kTooSmall, "one byte less", [](Call& call) { --call.patches.points_size; });
  expect_all(kTooSmall, "doubles", [](Call& call) { call.patches.type = GLEV_DOUBLE; });
  expect_all(kTooSmall, "one patch more", [](Call& call) { ++call.patches.count; });
  expect_all(kTooSmall, "all patches", [](Call& call) { call.patches.count = SIZE_MAX; });
  for (auto member : {&glev_patches::u_stride, &glev_patches::v_stride, &glev_patches::patch_stride}) {
    for (std::size_t stride : {SIZE_MAX, SIZE_MAX / 2 + 1}) {
      expect_all(kTooSmall, "large stride", [&](Call& call) { call.patches.*member = stride; });
      expect_all(kTooSmall, "large stride and size", [&](Call& call) {
        call.patches.*member = stride;
        call.patches.points_size = SIZE_MAX;
      });
    }
    expect_all(GLEV_SUCCESS, "stride 1", [&](Call& call) {
      call.patches.u_stride = call.patches.v_stride = call.patches.patch_stride = 36;
      call.patches.*member = 1;
    });
  }
  // The sizes are exactly those that are needed.
  expect_all(GLEV_SUCCESS, "exactly", [](Call& call) {
    call.patches.u_stride = 4, call.patches.v_stride = 20, call.patches.patch_stride = 8;
    call.patches.points_size = 2 * 8 + 2 * 4 + 2 * 20 + 12;
  });
  expect_all(kTooSmall, "one byte less", [](Call& call) {
    call.patches.u_stride = 4, call.patches.v_stride = 20, call.patches.patch_stride = 8;
    call.patches.points_size = 2 * 8 + 2 * 4 + 2 * 20 + 11;
  });
}

TEST_F(PatchMisuse, OfGrids) {
  expect_none("null", [](Call& call) { call.grid_at = nullptr; });
  expect_none(
      "size 0", [](Call& call) { call.grid.size = 0; }, kWrongSize);
  expect_none(
      "size of an earlier version - 1",
      [](Call& call) { call.grid.size = offsetof(glev_patch_grid, edge_segments) - 1; }, kWrongSize);
  for (int number : {4, -1, INT_MAX}) {
    expect_none("kind", [&](Call& call) { set_number(call.grid.kind, number); });
    expect_none("precision", [&](Call& call) { set_number(call.grid.precision, number); });
  }
  for (const char* name : {"", "AVX", "no such machine"})
    expect_none("target", [&](Call& call) { call.grid.target = name; });
  for (glev_grid_kind kind : {GLEV_GRID_UNIFORM, GLEV_GRID_EDGES}) {
    expect_none(kind, "negative", [](Call& call) { call.grid.u_segments = -1; });
    expect_none(kind, "negative", [](Call& call) { call.grid.v_segments = INT_MIN; });
    expect_none(kind, "u_count", [](Call& call) { call.grid.u_count = 1; });
    expect_none(kind, "v_count", [](Call& call) { call.grid.v_count = 1; });
    expect_none(kind, "type", [](Call& call) { call.grid.type = GLEV_FLOAT; });
    for (auto member : {&glev_patch_grid::u, &glev_patch_grid::v, &glev_patch_grid::patch}) {
      expect_none(kind, "data", [&](Call& call) { (call.grid.*member).data = arguments_; });
      expect_none(kind, "bytes", [&](Call& call) { (call.grid.*member).data_size = 1; });
      expect_none(kind, "stride", [&](Call& call) { (call.grid.*member).stride = 1; });
    }
  }
  for (int segments : {0, 1}) {
    expect_none(GLEV_GRID_EDGES, "no inner points", [&](Call& call) { call.grid.u_segments = segments; });
    expect_none(GLEV_GRID_EDGES, "no inner points", [&](Call& call) { call.grid.v_segments = segments; });
  }
  for (int edge = 0; edge < 4; ++edge) {
    for (int segments : {0, -1, INT_MIN}) {
      expect_none(GLEV_GRID_EDGES, "an edge without segments",
                  [&](Call& call) { call.grid.edge_segments[edge] = segments; });
    }
    for (glev_grid_kind kind : {GLEV_GRID_UNIFORM, GLEV_GRID_LISTS, GLEV_GRID_SCATTERED})
      expect_none(kind, "an edge", [&](Call& call) { call.grid.edge_segments[edge] = 1; });
  }
  expect_none(GLEV_GRID_EDGES, "the size of an earlier version",
              [](Call& call) { call.grid.size = offsetof(glev_patch_grid, edge_segments); });
  expect(GLEV_SUCCESS, GLEV_GRID_UNIFORM, "the size of an earlier version", [](Call& call) {
    call.grid.size = offsetof(glev_patch_grid, edge_segments);
    call.grid.edge_segments[0] = 1;
  });
  expect(kTooSmall, GLEV_GRID_EDGES, "too many points",
         [](Call& call) { call.grid.edge_segments[2] = INT_MAX; });
  for (glev_grid_kind kind : {GLEV_GRID_LISTS, GLEV_GRID_SCATTERED}) {
    expect_none(kind, "u_segments", [](Call& call) { call.grid.u_segments = 1; });
    expect_none(kind, "v_segments", [](Call& call) { call.grid.v_segments = 1; });
    for (glev_enum type : {0, GLEV_INT})
      expect_none(kind, "type", [&](Call& call) { call.grid.type = type; });
    for (auto member : {&glev_patch_grid::u, &glev_patch_grid::v}) {
      expect(kInvalid, kind, "no data", [&](Call& call) { (call.grid.*member).data = nullptr; });
      expect(kTooSmall, kind, "no bytes", [&](Call& call) { (call.grid.*member).data_size = 0; });
      expect(kTooSmall, kind, "far apart",
             [&](Call& call) { (call.grid.*member).stride = (call.grid.*member).data_size = SIZE_MAX; });
      expect(GLEV_SUCCESS, kind, "the same one",
             [&](Call& call) { (call.grid.*member).stride = 0, (call.grid.*member).data_size = 4; });
    }
    expect(kTooSmall, kind, "doubles", [](Call& call) { call.grid.type = GLEV_DOUBLE; });
    expect(kTooSmall, kind, "one more", [](Call& call) { ++call.grid.u_count; });
    expect(kTooSmall, kind, "all", [](Call& call) { call.grid.u_count = SIZE_MAX; });
    expect(kInvalid, kind, "none of v", [](Call& call) { call.grid.v = {}; });
    // Curves do not need v.
    expect(GLEV_SUCCESS, kind, "a curve", [](Call& call) {
      call.patches.vorder = 1;
      call.grid.v = {};
      call.grid.v_count = 0;
    });
    expect(kInvalid, kind, "a curve with a v that is nowhere", [](Call& call) {
      call.patches.vorder = 1;
      call.grid.v.data = nullptr;
    });
  }
  expect_none(GLEV_GRID_LISTS, "a patch", [&](Call& call) { call.grid.patch.data = numbers_; });
  expect_none(GLEV_GRID_LISTS, "a list of v without a count", [](Call& call) {
    call.patches.vorder = 1;
    call.grid.v_count = 0;
  });
  expect_none(GLEV_GRID_SCATTERED, "v_count", [](Call& call) { call.grid.v_count = 4; });
  expect(kInvalid, GLEV_GRID_SCATTERED, "no numbers", [](Call& call) { call.grid.patch = {}; });
  expect(kTooSmall, GLEV_GRID_SCATTERED, "few numbers", [](Call& call) { --call.grid.patch.data_size; });
  for (glev_uint number : {glev_uint{kPatches}, UINT_MAX}) {
    expect(kInvalid, GLEV_GRID_SCATTERED, "no such patch", [&](Call&) { numbers_[3] = number; });
    numbers_[3] = 1;
  }
  expect(kInvalid, GLEV_GRID_SCATTERED, "no patches", [](Call& call) { call.patches.count = 0; });
}

TEST_F(PatchMisuse, OfOutputs) {
  expect_all(kInvalid, "null", [](Call& call) { call.outputs_at = nullptr; });
  expect_all(kInvalid, "a null output", [](Call& call) { call.outputs[0].output = nullptr; });
  expect_all(kInvalid, "twice", [](Call& call) { call.outputs[1].attribute = GLEV_ATTRIBUTE_VERTEX; });
  for (int attribute : {9, -1, INT_MAX})
    expect_all(kInvalid, "attribute", [&](Call& call) { set_number(call.outputs[1].attribute, attribute); });
  for (glev_attribute attribute : {GLEV_ATTRIBUTE_COLOR, GLEV_ATTRIBUTE_TEXCOORD})
    expect_all(GLEV_ERROR_NO_MAP, "no map", [&](Call& call) { call.outputs[1].attribute = attribute; });
  expect_all(GLEV_SUCCESS, "normals", [](Call& call) { call.outputs[1].attribute = GLEV_ATTRIBUTE_NORMAL; });
  expect_all(GLEV_ERROR_NO_MAP, "normals of two components", [](Call& call) {
    call.patches.components = 2;
    call.outputs[1].attribute = GLEV_ATTRIBUTE_NORMAL;
  });
  expect_all(kInvalid, "normals of four", [](Call& call) {
    call.outputs[1].attribute = GLEV_ATTRIBUTE_NORMAL;
    call.tangent.components = 4;
    call.tangent.stride = 16;
  });
  expect_all(kInvalid, "two components", [](Call& call) { call.vertex.components = 2; });
  for (const OutputMisuse& misuse : kOutputMisuses)
    expect_all(misuse.result, misuse.what, [&](Call& call) { misuse.change(call.vertex); });
  for (glev_grid_kind kind : {GLEV_GRID_UNIFORM, GLEV_GRID_LISTS}) {
    // Four columns and two rows.
    const auto ask = [&](glev_result expected, const char* what, std::size_t row, std::size_t patch,
                         std::size_t bytes) {
      expect(expected, kind, what, [&](Call& call) {
        call.output_count = 1;
        call.vertex.row_stride = row;
        call.vertex.patch_stride = patch;
        call.vertex.data_size = bytes;
      });
    };
    constexpr std::size_t kRow = 3 * 24 + 12;
    ask(GLEV_SUCCESS, "tight", kRow, 2 * kRow, 6 * kRow);
    ask(kTooSmall, "one byte less", kRow, 2 * kRow, 6 * kRow - 1);
    ask(kInvalid, "rows overlap", kRow - 1, 0, 2048);
    ask(kInvalid, "patches overlap", kRow, 2 * kRow - 1, 2048);
    ask(kInvalid, "patches overlap", 0, 96 + kRow - 1, 2048);
    ask(GLEV_SUCCESS, "far apart", 0, 500, 2 * 500 + 96 + kRow);
    ask(kTooSmall, "too far apart", 0, 500, 2 * 500 + 96 + kRow - 1);
    for (std::size_t large : {SIZE_MAX, SIZE_MAX / 2 + 1}) {
      ask(kTooSmall, "large row stride", large, 0, SIZE_MAX);
      ask(kTooSmall, "large patch stride", 0, large, SIZE_MAX);
    }
  }
  expect(kInvalid, GLEV_GRID_SCATTERED, "rows", [](Call& call) { call.vertex.row_stride = 96; });
  expect(kInvalid, GLEV_GRID_SCATTERED, "patches", [](Call& call) { call.vertex.patch_stride = 192; });
}

TEST_F(PatchMisuse, OfScratch) {
  expect_all(kInvalid, "null", [](Call& call) { call.scratch = nullptr; });
  expect_all(kTooSmall, "none", [](Call& call) { call.scratch = nullptr, call.scratch_size = 0; });
  expect_all(kTooSmall, "one byte less",
             [](Call& call) { call.scratch_size = glevGetPatchScratchSize(&call.patches, &call.grid) - 1; });
}

TEST_F(PatchMisuse, OverlapIsFound) {
  const auto put = [](Call& call, const void* at) {
    call.output_count = 1;
    call.vertex.data = const_cast<void*>(at);
  };
  expect_all(kOverlap, "outputs", [](Call& call) { call.tangent.data = call.vertex.data; });
  expect_all(kOverlap, "one byte",
             [](Call& call) { call.tangent.data = static_cast<std::byte*>(call.vertex.data) + 11; });
  expect_all(kOverlap, "scratch", [&](Call& call) { put(call, call.scratch); });
  expect_all(kOverlap, "all of the scratch", [&](Call& call) {
    call.scratch_size = SIZE_MAX;
    call.scratch = call.vertex.data;
  });
  expect_all(kOverlap, "control points", [&](Call& call) { put(call, call.patches.points); });
  expect(kOverlap, GLEV_GRID_LISTS, "u", [&](Call& call) { put(call, call.grid.u.data); });
  expect(kOverlap, GLEV_GRID_SCATTERED, "v", [&](Call& call) { put(call, call.grid.v.data); });
  expect(kOverlap, GLEV_GRID_SCATTERED, "numbers", [&](Call& call) { put(call, call.grid.patch.data); });
  // The tangents of a patch may follow its vertices directly, but must not begin one byte earlier.
  for (glev_grid_kind kind : {GLEV_GRID_UNIFORM, GLEV_GRID_LISTS}) {
    for (std::size_t early : {0, 1}) {
      expect(early == 0 ? GLEV_SUCCESS : kOverlap, kind, "patches in turns", [&](Call& call) {
        for (glev_output* output : {&call.vertex, &call.tangent}) {
          output->stride = 12;
          output->patch_stride = 192 - early;
        }
        call.tangent.data = static_cast<std::byte*>(call.vertex.data) + 96;
        call.tangent.data_size -= 96;
      });
    }
  }
}

TEST_F(PatchMisuse, WithoutPatchesOrPointsNothingIsTouched) {
  const auto strip = [](Call& call) {
    call.patches.points = nullptr;
    call.patches.points_size = 0;
    call.vertex.data = call.tangent.data = nullptr;
    call.vertex.data_size = call.tangent.data_size = 0;
    call.scratch = nullptr;
    call.scratch_size = 0;
  };
  Memory memory(2048), scratch(64);
  for (glev_grid_kind kind : kAllKinds) {
    Call call;
    fill(call, kind, memory, scratch);
    strip(call);
    if (kind == GLEV_GRID_SCATTERED) call.grid.u_count = 0;
    call.patches.count = 0;
    EXPECT_EQ(evaluate(call), GLEV_SUCCESS);
    call.vertex.components = 9;
    EXPECT_EQ(evaluate(call), kInvalid);
  }
  for (auto member : {&glev_patch_grid::u_count, &glev_patch_grid::v_count}) {
    Call call;
    fill(call, GLEV_GRID_LISTS, memory, scratch);
    strip(call);
    call.grid.*member = 0;
    EXPECT_EQ(evaluate(call), GLEV_SUCCESS);
  }
  EXPECT_TRUE(memory.is_untouched());
}

TEST_F(PatchMisuse, ScratchSizeNeedsNoPointers) {
  Memory memory(2048), scratch(64);
  for (glev_grid_kind kind : kAllKinds) {
    Call call;
    fill(call, kind, memory, scratch);
    const std::size_t size = glevGetPatchScratchSize(&call.patches, &call.grid);
    EXPECT_NE(size, 0u);
    call.patches.points = nullptr;
    call.patches.points_size = 0;
    call.patches.count = 1000000;
    call.grid.u = call.grid.v = call.grid.patch = {};
    EXPECT_EQ(glevGetPatchScratchSize(&call.patches, &call.grid), size);
  }
}

// ---- Plans of one map

class PlanFromMap : public ::testing::Test {
 protected:
  static constexpr int kOrder = 3;

  PlanFromMap() {
    Chance chance;
    points_ = chance.next_points(kOrder * kOrder * 4);
    patches_ = glevaluator::make_patches<float>(points_, 3, kOrder, kOrder);
    patches_.count = 1;
    info_.size = sizeof info_;
    info_.target = GLEV_MAP2_VERTEX_3;
    info_.map = &patches_;
  }

  void expect(glev_result expected, const char* what, const std::function<void()>& change) {
    const glev_patches patches = patches_;
    const glev_map_info info = info_;
    change();
    int none = 0;
    auto* plan = reinterpret_cast<glev_plan*>(&none);
    EXPECT_EQ(glevCreatePlanFromMap(&info_, &plan), expected) << what;
    EXPECT_EQ(plan != nullptr, expected == GLEV_SUCCESS) << what;
    glevReleasePlan(plan);
    patches_ = patches;
    info_ = info;
  }

  std::vector<float> points_;
  glev_patches patches_{};
  glev_map_info info_{};
};

TEST_F(PlanFromMap, GivesWhatThePlanOfAContextGives) {
  patches_.u1 = -1, patches_.u2 = 3, patches_.v1 = 2, patches_.v2 = 1;
  info_.u_segments = 5;
  info_.auto_normal = GLEV_TRUE;
  for (const TargetRow& row : kTargetRows) {
    if (row.offset == GLEV_MAP1_INDEX - GLEV_MAP1_COLOR_4) continue;
    for (int dimension : {1, 2}) {
      const int rows = dimension == 2 ? kOrder : 1;
      const glev_enum target = (dimension == 1 ? GLEV_MAP1_COLOR_4 : GLEV_MAP2_COLOR_4) + row.offset;
      const glevaluator::Context context;
      glev_context* const gl = context.get();
      if (dimension == 1) {
        glevMap1f(gl, target, -1, 3, row.components, kOrder, points_.data());
        glevMapGrid1f(gl, 5, -1, 3);
      } else {
        glevMap2f(gl, target, -1, 3, rows * row.components, kOrder, 2, 1, row.components, rows,
                  points_.data());
        glevMapGrid2f(gl, 5, -1, 3, 6, 2, 1);
        glevEnable(gl, GLEV_AUTO_NORMAL);
      }
      glevEnable(gl, target);
      const Plan expected(gl, static_cast<std::size_t>(dimension));

      patches_.components = static_cast<std::size_t>(row.components);
      patches_.vorder = rows;
      info_.target = target;
      info_.v_segments = dimension == 2 ? 6 : 0;
      const glevaluator::Plan plan(info_);
      ASSERT_TRUE(plan) << std::hex << target;
      for (int number = 0; number <= GLEV_ATTRIBUTE_SECOND_VV; ++number) {
        const auto attribute = static_cast<glev_attribute>(number);
        ASSERT_EQ(plan.components(attribute), glevGetPlanComponents(expected, attribute));
        if (plan.components(attribute) == 0) continue;
        const Range range = {0, 5, 0, info_.v_segments};
        EXPECT_EQ(bits_of(evaluate_grid(plan.get(), attribute, range)),
                  bits_of(evaluate_grid(expected, attribute, range)));
        EXPECT_EQ(bits_of(evaluate_grid<double>(plan.get(), attribute, range)),
                  bits_of(evaluate_grid<double>(expected, attribute, range)));
      }
    }
  }
}

TEST_F(PlanFromMap, MisuseIsRejected) {
  expect(GLEV_SUCCESS, "nothing", [] {});
  EXPECT_EQ(glevCreatePlanFromMap(&info_, nullptr), kInvalid);
  glev_plan* plan;
  EXPECT_EQ(glevCreatePlanFromMap(nullptr, &plan), kInvalid);
  EXPECT_EQ(plan, nullptr);
  expect(kWrongSize, "size", [&] { info_.size = 8; });
  expect(kWrongSize, "size - 1", [&] { --info_.size; });
  expect(kWrongSize, "size of the map", [&] { patches_.size = 0; });
  for (glev_enum target :
       {0, GLEV_MAP1_INDEX, GLEV_MAP2_INDEX, GLEV_MAP2_COLOR_4 - 1, GLEV_MAP2_VERTEX_4 + 1})
    expect(kInvalid, "target", [&] { info_.target = target; });
  for (glev_enum target : {GLEV_MAP2_VERTEX_4, GLEV_MAP2_TEXTURE_COORD_2})
    expect(kInvalid, "components", [&] { info_.target = target; });
  expect(kInvalid, "no map", [&] { info_.map = nullptr; });
  for (std::size_t count : {std::size_t{0}, std::size_t{2}, SIZE_MAX})
    expect(kInvalid, "count", [&] { patches_.count = count; });
  expect(kInvalid, "order", [&] { patches_.uorder = 65; });
  expect(kInvalid, "domain", [&] { patches_.v1 = patches_.v2 = 3; });
  expect(kInvalid, "points", [&] { patches_.points = nullptr; });
  expect(kTooSmall, "points_size", [&] { patches_.points_size = 9 * 12 - 1; });
  expect(GLEV_SUCCESS, "points_size", [&] { patches_.points_size = 9 * 12; });
  expect(kTooSmall, "stride", [&] { patches_.u_stride = SIZE_MAX / 2; });
  expect(kInvalid, "segments", [&] { info_.u_segments = -1; });
  expect(kInvalid, "segments", [&] { info_.v_segments = -1; });
  expect(kInvalid, "a surface for a curve", [&] { info_.target = GLEV_MAP1_VERTEX_3; });
  expect(GLEV_SUCCESS, "a curve", [&] { info_.target = GLEV_MAP1_VERTEX_3, patches_.vorder = 1; });
  expect(kInvalid, "rows of a curve",
         [&] { info_.target = GLEV_MAP1_VERTEX_3, patches_.vorder = 1, info_.v_segments = 1; });
  expect(kInvalid, "instruction set", [&] { info_.instruction_set = "no such machine"; });
  const glev_allocator none = {sizeof none, nullptr, nullptr, nullptr};
  expect(kInvalid, "allocator", [&] { info_.allocator = &none; });
  const glev_allocator no_size = {};
  expect(kWrongSize, "size of the allocator", [&] { info_.allocator = &no_size; });
}

TEST_F(PlanFromMap, MemoryComesFromItsAllocator) {
  Ledger ledger;
  const glev_allocator allocator = ledger.make_allocator();
  info_.allocator = &allocator;
  expect(GLEV_SUCCESS, "memory", [] {});
  EXPECT_TRUE(ledger.out.empty());
  const int requests = ledger.requests;
  EXPECT_GT(requests, 0);
  for (int from = 0; from < requests; ++from) {
    ledger.requests = 0;
    ledger.refuse_from = from;
    expect(GLEV_ERROR_OUT_OF_MEMORY, "no memory", [] {});
    EXPECT_TRUE(ledger.out.empty());
  }
}

}  // namespace
}  // namespace glev_tests
