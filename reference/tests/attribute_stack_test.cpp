// Tests PushAttrib and PopAttrib (GL 2.1 section 6.1.14; section 21 of the requirements).
#include <gtest/gtest.h>
#include <reference/specification.h>

#include <vector>

#include "context.h"

namespace evalcts::reference {
namespace {

using Values = std::vector<GLdouble>;
using State = std::vector<Values>;

// Functions that return the state of each group.
State enables(Specification& gl) {
  State state{get(gl, GL_AUTO_NORMAL)};
  for (const GLenum target : map_targets()) state.push_back(get(gl, target));
  return state;
}
State values(Specification& gl, std::initializer_list<GLenum> pnames) {
  State state;
  for (const GLenum pname : pnames) state.push_back(get(gl, pname));
  return state;
}
State grids(Specification& gl) {
  return values(gl, {GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS});
}
State current(Specification& gl) {
  State state = values(gl, {GL_CURRENT_COLOR, GL_CURRENT_INDEX, GL_CURRENT_NORMAL, GL_EDGE_FLAG});
  Specification copy = gl;
  for (const GLenum unit : {GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE7}) {
    copy.ActiveTexture(unit);
    state.push_back(get(copy, GL_CURRENT_TEXTURE_COORDS));
  }
  return state;
}
State texture(Specification& gl) { return values(gl, {GL_ACTIVE_TEXTURE}); }
State list(Specification& gl) { return values(gl, {GL_LIST_BASE}); }
State maps(Specification& gl) {
  State state;
  for (const GLenum target : map_targets()) {
    for (const GLenum query : {GL_ORDER, GL_COEFF, GL_DOMAIN}) state.push_back(get_map(gl, target, query));
  }
  return state;
}

// Changes all state.
void change_everything(Specification& gl) {
  gl.ActiveTexture(GL_TEXTURE0);
  for (const GLenum target : kMap1Targets) define_line(gl, target, 5);
  for (const GLenum target : kMap2Targets) {
    const GLfloat points[] = {9, 8, 7, 6};
    gl.Map2f(target, 1, 2, 4, 1, 3, 4, 4, 1, points);
  }
  for (const GLenum target : map_targets()) gl.IsEnabled(target) ? gl.Disable(target) : gl.Enable(target);
  gl.IsEnabled(GL_AUTO_NORMAL) ? gl.Disable(GL_AUTO_NORMAL) : gl.Enable(GL_AUTO_NORMAL);
  gl.MapGrid1f(7, 8, 9);
  gl.MapGrid2f(7, 8, 9, 10, 11, 12);
  gl.Color4f(0.25f, 0.5f, 0.75f, 0.5f);
  gl.Normal3f(1, 2, 3);
  gl.Indexf(44);
  gl.EdgeFlag(GL_FALSE);
  for (const GLenum unit : {GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE7}) gl.MultiTexCoord4f(unit, 4, 3, 2, 5);
  gl.ActiveTexture(GL_TEXTURE2);
  gl.ListBase(33);
}

// A group of state, and the mask bits that restore it.
struct Group {
  const char* name;
  State (*state)(Specification&);
  GLbitfield bits;  // any of them
};
const Group kGroups[] = {{"enables", enables, GL_EVAL_BIT | GL_ENABLE_BIT},
                         {"grids", grids, GL_EVAL_BIT},
                         {"current", current, GL_CURRENT_BIT},
                         {"texture", texture, GL_TEXTURE_BIT},
                         {"list", list, GL_LIST_BIT},
                         {"maps", maps, 0}};  // EV-ATTRIB-NOMAPS

void expect_groups(GLbitfield mask) {
  SCOPED_TRACE(mask);
  Specification before;
  before.Enable(GL_MAP2_COLOR_4);
  before.MapGrid1d(3, 4, 5);
  before.Indexf(5);
  before.ListBase(6);
  Specification changed = before, gl = before;
  change_everything(changed);
  gl.PushAttrib(mask);
  change_everything(gl);
  gl.PopAttrib();
  expect_error(gl, GL_NO_ERROR);
  for (const Group& group : kGroups) {
    SCOPED_TRACE(group.name);
    ASSERT_NE(group.state(before), group.state(changed));
    EXPECT_EQ(group.state(gl), group.state(mask & group.bits ? before : changed));
  }
}

// EV-ATTRIB-ALL, -EVALBIT, -ENABLEBIT, -ENABLEBIT-NOGRID, -NOMAPS, -OTHERBITS
TEST(AttributeStack, SavesTheGroupsOfTheMask) {
  for (int bit = 0; bit < 32; ++bit) expect_groups(1u << bit);
  expect_groups(0);
  expect_groups(GL_CURRENT_BIT | GL_LIST_BIT);
  expect_groups(GL_ALL_ATTRIB_BITS);
  expect_groups(0x000FFFFF);  // ALL_ATTRIB_BITS before GL 1.3
  expect_groups(~static_cast<GLbitfield>(GL_EVAL_BIT | GL_ENABLE_BIT));
}

TEST(AttributeStack, Nests) {  // EV-ATTRIB-NEST
  Specification gl;
  gl.Indexf(2);
  gl.MapGrid1f(2, 0, 1);
  gl.PushAttrib(GL_CURRENT_BIT);
  gl.Indexf(3);
  gl.MapGrid1f(3, 0, 1);
  gl.PushAttrib(GL_EVAL_BIT);
  gl.Indexf(4);
  gl.MapGrid1f(4, 0, 1);
  EXPECT_EQ(get(gl, GL_ATTRIB_STACK_DEPTH), Values{2});
  gl.PopAttrib();
  EXPECT_EQ(get(gl, GL_CURRENT_INDEX), Values{4});
  EXPECT_EQ(get(gl, GL_MAP1_GRID_SEGMENTS), Values{3});
  gl.PopAttrib();
  EXPECT_EQ(get(gl, GL_CURRENT_INDEX), Values{2});
  EXPECT_EQ(get(gl, GL_MAP1_GRID_SEGMENTS), Values{3});
  EXPECT_EQ(get(gl, GL_ATTRIB_STACK_DEPTH), Values{0});
  expect_error(gl, GL_NO_ERROR);
}

TEST(AttributeStack, OverflowsAndUnderflows) {
  Specification gl;
  for (int i = 0; i < 16; ++i) {
    gl.Indexf(static_cast<GLfloat>(i));
    gl.PushAttrib(GL_CURRENT_BIT);
  }
  expect_error(gl, GL_NO_ERROR);
  gl.Indexf(16);
  gl.PushAttrib(GL_CURRENT_BIT);
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_STACK_OVERFLOW});
  expect_error(gl, GL_STACK_OVERFLOW);
  EXPECT_EQ(get(gl, GL_ATTRIB_STACK_DEPTH), Values{16});
  for (int i = 15; i >= 0; --i) {
    gl.PopAttrib();
    EXPECT_EQ(get(gl, GL_CURRENT_INDEX), Values{double(i)});
  }
  expect_error(gl, GL_NO_ERROR);
  gl.Indexf(20);
  gl.PopAttrib();
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_STACK_UNDERFLOW});
  expect_error(gl, GL_STACK_UNDERFLOW);
  EXPECT_EQ(get(gl, GL_CURRENT_INDEX), Values{20});
}

}  // namespace
}  // namespace evalcts::reference
