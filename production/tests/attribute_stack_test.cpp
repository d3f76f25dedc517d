// Tests PushAttrib and PopAttrib.
#include <bit>

#include "fixture.h"

namespace glev_tests {
namespace {

class AttributeStack : public ContextTest {
 protected:
  // State of the attribute groups. Maps are not part of any group.
  struct Groups {
    std::vector<double> flags, grids, current, texture, list;
    bool operator==(const Groups&) const = default;
  };

  Groups observe() {
    Groups groups;
    const auto add = [&](std::vector<double>& to, glev_enum name, std::size_t count) {
      double values[4];
      glevGetDoublev(gl, name, values);
      to.insert(to.end(), values, values + count);
    };
    for (glev_enum cap : capabilities()) groups.flags.push_back(glevIsEnabled(gl, cap));
    add(groups.grids, GLEV_MAP1_GRID_DOMAIN, 2);
    add(groups.grids, GLEV_MAP1_GRID_SEGMENTS, 1);
    add(groups.grids, GLEV_MAP2_GRID_DOMAIN, 4);
    add(groups.grids, GLEV_MAP2_GRID_SEGMENTS, 2);
    add(groups.texture, GLEV_ACTIVE_TEXTURE, 1);
    add(groups.list, GLEV_LIST_BASE, 1);
    add(groups.current, GLEV_CURRENT_COLOR, 4);
    add(groups.current, GLEV_CURRENT_INDEX, 1);
    add(groups.current, GLEV_CURRENT_NORMAL, 3);
    add(groups.current, GLEV_EDGE_FLAG, 1);
    for (glev_enum unit = 0; unit < GLEV_TEXTURE_UNITS; ++unit) {
      glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
      add(groups.current, GLEV_CURRENT_TEXTURE_COORDS, 4);
    }
    glevActiveTexture(gl, static_cast<glev_enum>(groups.texture[0]));
    return groups;
  }

  // Changes all state, maps included, to values that are different for each n.
  void change(int n) {
    const auto f = static_cast<float>(n);
    for (std::size_t i = 0; i < capabilities().size(); ++i) {
      ((i + n) % 3 == 0 ? glevDisable : glevEnable)(gl, capabilities()[i]);
    }
    glevMapGrid1f(gl, n, f, f + 1);
    glevMapGrid2f(gl, n + 1, f, f + 2, n + 2, f, f + 3);
    glevColor4f(gl, f, f + 1, f + 2, f + 3);
    glevIndexf(gl, f);
    glevNormal3f(gl, f, f, f);
    glevEdgeFlag(gl, n % 2 == 0);
    for (glev_enum unit = 0; unit < GLEV_TEXTURE_UNITS; ++unit) {
      glevMultiTexCoord1f(gl, GLEV_TEXTURE0 + unit, f + static_cast<float>(unit));
    }
    glevListBase(gl, 100 + n);
    glevActiveTexture(gl, GLEV_TEXTURE0);
    const float point[] = {f, f, f, f};
    for (const TargetRow& row : target_rows()) {
      glevMap1f(gl, GLEV_MAP1_COLOR_4 + row.offset, f, f + 1, 4, 1, point);
      glevMap2f(gl, GLEV_MAP2_COLOR_4 + row.offset, f, f + 1, 4, 1, f, f + 1, 4, 1, point);
    }
    glevActiveTexture(gl, GLEV_TEXTURE0 + n % 8);
  }

  std::vector<double> map_state() {
    std::vector<double> maps;
    for (const TargetRow& row : target_rows()) {
      for (const glev_enum target : {GLEV_MAP1_COLOR_4 + row.offset, GLEV_MAP2_COLOR_4 + row.offset}) {
        double values[4];
        glevGetMapdv(gl, target, GLEV_DOMAIN, values);
        maps.push_back(values[0]);
        glevGetMapdv(gl, target, GLEV_COEFF, values);
        maps.push_back(values[0]);
      }
    }
    return maps;
  }
};

TEST_F(AttributeStack, EachBitBringsBackItsGroupAndNothingElse) {
  for (int bit = -1; bit < 33; ++bit) {
    const glev_bitfield mask = bit < 0 ? 0 : bit == 32 ? GLEV_ALL_ATTRIB_BITS : 1u << bit;
    SCOPED_TRACE(mask);
    change(2);
    const Groups pushed = observe();
    expect_accepted([&] { glevPushAttrib(gl, mask); });
    EXPECT_EQ(observe(), pushed) << "PushAttrib changes nothing";
    change(7);
    Groups expected = observe();
    const std::vector<double> maps = map_state();
    if ((mask & (GLEV_EVAL_BIT | GLEV_ENABLE_BIT)) != 0) expected.flags = pushed.flags;
    if ((mask & GLEV_EVAL_BIT) != 0) expected.grids = pushed.grids;
    if ((mask & GLEV_CURRENT_BIT) != 0) expected.current = pushed.current;
    if ((mask & GLEV_TEXTURE_BIT) != 0) expected.texture = pushed.texture;
    if ((mask & GLEV_LIST_BIT) != 0) expected.list = pushed.list;
    expect_accepted([&] { glevPopAttrib(gl); });
    EXPECT_EQ(observe(), expected);
    EXPECT_EQ(map_state(), maps) << "maps are in no group";
  }
}

TEST_F(AttributeStack, BitsAddUp) {
  change(2);
  const Groups pushed = observe();
  glevPushAttrib(gl, GLEV_ENABLE_BIT | GLEV_LIST_BIT);
  change(7);
  Groups expected = observe();
  expected.flags = pushed.flags;
  expected.list = pushed.list;
  glevPopAttrib(gl);
  EXPECT_EQ(observe(), expected);
}

TEST_F(AttributeStack, NestsToSixteen) {
  std::vector<Groups> pushed;
  for (int n = 1; n <= 16; ++n) {
    change(n);
    pushed.push_back(observe());
    expect_accepted([&] { glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS); });
  }
  change(17);
  expect_rejected(GLEV_STACK_OVERFLOW, [&] { glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS); });
  for (; !pushed.empty(); pushed.pop_back()) {
    expect_accepted([&] { glevPopAttrib(gl); });
    EXPECT_EQ(observe(), pushed.back());
  }
  expect_rejected(GLEV_STACK_UNDERFLOW, [&] { glevPopAttrib(gl); });
}

TEST_F(AttributeStack, NotBetweenBeginAndEnd) {
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevPushAttrib(gl, GLEV_EVAL_BIT); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevPopAttrib(gl); });
  glevPushAttrib(gl, GLEV_EVAL_BIT);
  change(3);
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevPopAttrib(gl); });
  int depth = 0;
  glevGetIntegerv(gl, GLEV_ATTRIB_STACK_DEPTH, &depth);
  EXPECT_EQ(depth, 1);
}

TEST_F(AttributeStack, EvaluationFollowsWhatWasPopped) {
  const float one[] = {1, 1, 1}, two[] = {2, 2, 2};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 1, one);
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 1, 0, 1, 3, 1, two);
  glevPushAttrib(gl, GLEV_ENABLE_BIT);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  EXPECT_EQ(one_vertex([&] { glevEvalCoord1f(gl, 0); }).position[0], 1);
  EXPECT_EQ(one_vertex([&] { glevEvalCoord2f(gl, 0, 0); }).position[0], 2);
  glevPopAttrib(gl);
  recording = {};
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord1f(gl, 0);
  glevEvalCoord2f(gl, 0, 0);
  glevEnd(gl);
  EXPECT_TRUE(recording.vertices.empty());

  const float ramp[] = {0, 0, 0, 8, 8, 8};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, ramp);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevMapGrid1f(gl, 4, 0, 1);
  glevPushAttrib(gl, GLEV_EVAL_BIT);
  glevMapGrid1f(gl, 2, 0, 1);
  EXPECT_EQ(one_vertex([&] { glevEvalPoint1(gl, 1); }).position[0], 4);
  recording = {};
  glevEvalMesh1(gl, GLEV_POINT, 1, 1);
  EXPECT_EQ(recording.vertices.at(0).position[0], 4);
  glevPopAttrib(gl);
  recording = {};
  glevEvalMesh1(gl, GLEV_POINT, 1, 1);
  EXPECT_EQ(recording.vertices.at(0).position[0], 2);

  const float patch[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 3, 2, patch);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevNormal3f(gl, 7, 7, 7);
  glevPushAttrib(gl, GLEV_ENABLE_BIT);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  EXPECT_EQ(one_vertex([&] { glevEvalCoord2f(gl, 0, 0); }).normal[0], 0);
  glevPopAttrib(gl);
  EXPECT_EQ(one_vertex([&] { glevEvalCoord2f(gl, 0, 0); }).normal[0], 7);
}

TEST_F(AttributeStack, WhatDidNotChangeKeepsItsPlan) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  const glev_plan_info info = {sizeof(glev_plan_info), 1};
  glev_plan *before, *after;
  ASSERT_EQ(glevCreatePlan(gl, &info, &before), GLEV_SUCCESS);
  glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevPopAttrib(gl);
  ASSERT_EQ(glevCreatePlan(gl, &info, &after), GLEV_SUCCESS);
  EXPECT_EQ(before, after);
  glevReleasePlan(before);
  glevReleasePlan(after);
}

}  // namespace
}  // namespace glev_tests
