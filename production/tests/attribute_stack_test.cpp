// Tests the attribute groups and the limits of the attribute stack. The conformance suite tests what the
// stack does to evaluators (suites/attribute_stack.cpp).
#include "fixture.h"

namespace glev_tests {
namespace {

class AttributeStack : public ContextTest {
 protected:
  // State of the groups that are not the evaluators'.
  struct Groups {
    std::vector<double> current, texture, list;
    bool operator==(const Groups&) const = default;
  };

  Groups observe() {
    Groups groups;
    const auto add = [&](std::vector<double>& to, glev_enum name, std::size_t count) {
      double values[4];
      glevGetDoublev(gl, name, values);
      to.insert(to.end(), values, values + count);
    };
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

  // Changes this state to values that are different for each n.
  void change(int n) {
    const auto f = static_cast<float>(n);
    glevColor4f(gl, f, f + 1, f + 2, f + 3);
    glevIndexf(gl, f);
    glevNormal3f(gl, f, f, f);
    glevEdgeFlag(gl, n % 2 == 0);
    for (glev_enum unit = 0; unit < GLEV_TEXTURE_UNITS; ++unit) {
      glevMultiTexCoord1f(gl, GLEV_TEXTURE0 + unit, f + static_cast<float>(unit));
    }
    glevListBase(gl, 100 + n);
    glevActiveTexture(gl, GLEV_TEXTURE0 + n % 8);
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
    if ((mask & GLEV_CURRENT_BIT) != 0) expected.current = pushed.current;
    if ((mask & GLEV_TEXTURE_BIT) != 0) expected.texture = pushed.texture;
    if ((mask & GLEV_LIST_BIT) != 0) expected.list = pushed.list;
    expect_accepted([&] { glevPopAttrib(gl); });
    EXPECT_EQ(observe(), expected);
  }
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
