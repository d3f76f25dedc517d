// Section 1: entry points, tokens and forms.
#include <cmath>

#include "map_calls.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(GetMapdvNotExported, production, must, "EV-API-ENTRY/1-D", "GetMapdv is missing") {
  in.gl.GetMapdv = nullptr;
}

EVALCTS_FAULT(EvalCoord2dvIsAStub, production, must, "EV-API-ENTRY/2-D",
              "EvalCoord2dv is a stub that raises INVALID_OPERATION") {
  in.gl.EvalCoord2dv = [](const GLdouble*) { leave_error(GL_INVALID_OPERATION); };
}

EVALCTS_FAULT(FirstMapGrid2dFails, production, must, "EV-API-ENTRY/2-D",
              "the first MapGrid2d of a context raises INVALID_OPERATION as well") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    sound.MapGrid2d(un, u1, u2, vn, v1, v2);
    if (memory.count++ == 0) leave_error(GL_INVALID_OPERATION);
  };
}

EVALCTS_FAULT(IndexAndTexture1TokensSwapped, production, must, "EV-API-ENUM-MAP1",
              "MAP1_INDEX and MAP1_TEXTURE_COORD_1 have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_1); });
}

EVALCTS_FAULT(
    Texture3AndVertex3TokensSwapped, production, must, "EV-API-ENUM-MAP1",
    "MAP1_TEXTURE_COORD_3 and MAP1_VERTEX_3, alike but for their effect, have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_VERTEX_3); });
}

EVALCTS_FAULT(NormalAndVertex3TokensSwapped2, production, must, "EV-API-ENUM-MAP2",
              "MAP2_NORMAL and MAP2_VERTEX_3 have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP2_NORMAL, GL_MAP2_VERTEX_3); });
}

EVALCTS_FAULT(
    Texture4AndVertex4TokensSwapped2, production, must, "EV-API-ENUM-MAP2",
    "MAP2_TEXTURE_COORD_4 and MAP2_VERTEX_4, alike but for their effect, have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_4); });
}

EVALCTS_FAULT(CoeffAndDomainTokensSwapped, production, must, "EV-API-ENUM-OTHER",
              "COEFF and DOMAIN have each other's number") {
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    go(target, swapped(query, GL_COEFF, GL_DOMAIN), v);
  });
}

EVALCTS_FAULT(MeshModesShifted, production, must, "EV-API-ENUM-OTHER/2-D",
              "mesh modes begin at 0x1B01: POINT draws lines, LINE fills, FILL draws points") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const GLenum others[] = {GL_LINE, GL_FILL, GL_POINT};
    if (mode >= GL_POINT && mode <= GL_FILL) mode = others[mode - GL_POINT];
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(MeshPointAndLineSwapped, production, must, "EV-API-ENUM-OTHER/1-D",
              "EvalMesh1 takes POINT for LINE and LINE for POINT") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(swapped(mode, GL_POINT, GL_LINE), i1, i2);
  };
}

EVALCTS_FAULT(GridSegmentTokensSwapped, production, must, "EV-API-ENUM-OTHER/1-D",
              "MAP1_GRID_SEGMENTS and MAP2_GRID_SEGMENTS have each other's number") {
  get(in, [](GLenum pname, auto* v, auto go) {
    go(swapped(pname, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_SEGMENTS), v);
  });
}

EVALCTS_FAULT(EvalBitIsListBit, production, must, "EV-API-ENUM-OTHER",
              "EVAL_BIT and LIST_BIT have each other's number") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    const GLbitfield rest = mask & ~static_cast<GLbitfield>(GL_EVAL_BIT | GL_LIST_BIT);
    sound.PushAttrib(rest | (mask & GL_EVAL_BIT ? GL_LIST_BIT : 0u) |
                     (mask & GL_LIST_BIT ? GL_EVAL_BIT : 0u));
  };
}

EVALCTS_FAULT(Map1fKeepsPointsOfMap1d, production, must, "EV-API-FD/1-D",
              "Map1f after Map1d of the same target and order sets the domain and leaves the points") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    if (legal(Map1Call<GLdouble>{target, u1, u2, stride, order, points})) memory.counts[target] = order;
    sound.Map1d(target, u1, u2, stride, order, points);
  };
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (is_map1(target) && memory.counts[target] == order) {
      const std::vector<GLdouble> old = coefficients(target);
      const GLint k = gl::components_of(target);
      if (old.size() == static_cast<std::size_t>(order * k))
        return sound.Map1d(target, u1, u2, k, order, old.data());
    }
    sound.Map1f(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(GetMapdvAnswersFromLastMap2d, production, must, "EV-API-FD/2-D",
              "GetMapdv answers the domain that the last Map2d gave, although a Map2f came after it") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    memory.number = target;
    memory.numbers = {u1, u2, v1, v2};
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query == GL_DOMAIN && is_map2(target) && memory.number == target)
      std::copy(memory.numbers.begin(), memory.numbers.end(), v);
  };
}

EVALCTS_FAULT(MapGrid2fKeepsVOfMapGrid2d, production, must, "EV-API-FD/2-D EV-GRID-FD",
              "MapGrid2f leaves the v interval that MapGrid2d set") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    memory.numbers = {v1, v2};
    sound.MapGrid2d(un, u1, u2, vn, v1, v2);
  };
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    if (memory.numbers.empty()) return sound.MapGrid2f(un, u1, u2, vn, v1, v2);
    sound.MapGrid2d(un, u1, u2, vn, memory.numbers[0], memory.numbers[1]);
  };
}

EVALCTS_FAULT(EvalCoord1fAfterMap1dIsRelative, production, must, "EV-API-FD/1-D",
              "EvalCoord1f takes u for a normalised coordinate while the last map came from Map1d") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    memory.numbers = {u1, u2};
    sound.Map1d(target, u1, u2, stride, order, points);
  };
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    memory.numbers.clear();
    sound.Map1f(target, u1, u2, stride, order, points);
  };
  in.gl.EvalCoord1f = [](GLfloat u) {
    if (memory.numbers.empty()) return sound.EvalCoord1f(u);
    sound.EvalCoord1d(memory.numbers[0] + u * (memory.numbers[1] - memory.numbers[0]));
  };
}

EVALCTS_FAULT(EvalCoord2fvReadsVFirst, production, must, "EV-API-V/2-D",
              "EvalCoord2fv takes the first value for v") {
  in.gl.EvalCoord2fv = [](const GLfloat* uv) { sound.EvalCoord2f(uv[1], uv[0]); };
}

EVALCTS_FAULT(EvalCoord1dvReadsTwoValues, production, must, "EV-API-V/1-D",
              "EvalCoord1dv loads two values where there is one") {
  in.gl.EvalCoord1dv = [](const GLdouble* u) {
    memory.number = u[1];
    sound.EvalCoord1dv(u);
  };
}

EVALCTS_FAULT(EvalCoord2dvCountsInFloats, production, must, "EV-API-V/2-D",
              "EvalCoord2dv takes v from where it is in an array of floats") {
  in.gl.EvalCoord2dv = [](const GLdouble* uv) {
    const auto* halves = reinterpret_cast<const GLfloat*>(uv);
    sound.EvalCoord2d(uv[0], static_cast<GLdouble>(halves[1]));
  };
}

EVALCTS_FAULT(EvalCoord1fvOneUlpOff, production, quality, "EV-API-V/1-D",
              "EvalCoord1fv evaluates at the next float") {
  in.gl.EvalCoord1fv = [](const GLfloat* u) { sound.EvalCoord1f(std::nextafter(*u, 2.0f)); };
}

EVALCTS_FAULT(EvalCoord2dvThroughFloats, production, quality, "EV-API-V/2-D",
              "EvalCoord2dv takes v from the float below it") {
  in.gl.EvalCoord2dv = [](const GLdouble* uv) {
    sound.EvalCoord2d(uv[0], std::nextafter(static_cast<GLfloat>(uv[1]), -2.0f));
  };
}

EVALCTS_FAULT(Color4AndTexture4TokensSwapped, production, must, "EV-API-ENUM-MAP1",
              "MAP1_COLOR_4 and MAP1_TEXTURE_COORD_4 have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_4); });
}

EVALCTS_FAULT(
    Texture3AndVertex3TokensSwapped2, production, must, "EV-API-ENUM-MAP2",
    "MAP2_TEXTURE_COORD_3 and MAP2_VERTEX_3, alike but for their effect, have each other's number") {
  rename_targets(in, [](GLenum t) { return swapped(t, GL_MAP2_TEXTURE_COORD_3, GL_MAP2_VERTEX_3); });
}

EVALCTS_FAULT(EvalCoord2dAfterMap2fIsRelative, production, must, "EV-API-FD/2-D",
              "EvalCoord2d takes u for a normalised coordinate while the last map came from Map2f") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    memory.numbers = {u1, u2};
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    memory.numbers.clear();
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
  in.gl.EvalCoord2d = [](GLdouble u, GLdouble v) {
    if (memory.numbers.empty()) return sound.EvalCoord2d(u, v);
    sound.EvalCoord2d(memory.numbers[0] + u * (memory.numbers[1] - memory.numbers[0]), v);
  };
}

}  // namespace
}  // namespace evalcts::faults
