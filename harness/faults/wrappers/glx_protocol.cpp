// Section 25: what an indirect client sends, and what it makes of replies. A wrapper that gives another
// command sends another request.
#include <algorithm>
#include <cmath>

#include <evalcts/gl/tokens.h>
#include "around.h"
#include "forms.h"

#define GLX_FAULT(name, requirements, what) EVALCTS_FAULT_IN("glx-indirect", name, must, requirements, what)

namespace evalcts::faults::glx_protocol {
namespace {

bool is_map2(GLenum target) { return target >= GL_MAP2_COLOR_4 && target <= GL_MAP2_VERTEX_4; }
bool is_map1(GLenum target) { return gl::components_of(target) != 0 && !is_map2(target); }

// --- Requests ----------------------------------------------------------------------------------------------

GLX_FAULT(GridSentAsDoubles, "EV-GLX-OPCODES", "MapGrid1f travels as MapGrid1d") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) { sound.MapGrid1d(n, u1, u2); };
}

GLX_FAULT(EvalPointSentAsMesh, "EV-GLX-OPCODES", "EvalPoint1 travels as EvalMesh1 of one point") {
  in.gl.EvalPoint1 = [](GLint i) { sound.EvalMesh1(GL_POINT, i, i); };
}

GLX_FAULT(Mesh2SwapsRanges, "EV-GLX-OPCODES", "EvalMesh2 travels with j before i") {
  mesh2(in, [](auto call) { sound.EvalMesh2(call.mode, call.j1, call.j2, call.i1, call.i2); });
}

GLX_FAULT(NegativePointsNotSent, "EV-GLX-OPCODES", "EvalPoint2 with a negative index is not sent") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (i >= 0 && j >= 0) sound.EvalPoint2(i, j);
  };
}

GLX_FAULT(GetMapivThroughFloats, "EV-GLX-SINGLES", "GetMapiv asks for floats and converts them") {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    GLfloat values[256];
    sound.GetMapfv(target, query, values);
    *v = static_cast<GLint>(*values);
  };
}

GLX_FAULT(GetMapdvAsksOrderFirst, "EV-GLX-SINGLES", "GetMapdv asks for the order before the points") {
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    GLint order[2];
    if (query == GL_COEFF) sound.GetMapiv(target, GL_ORDER, order);
    sound.GetMapdv(target, query, v);
  };
}

GLX_FAULT(ScalarDoubleSentAsFloat, "EV-GLX-SCALAR", "EvalCoord1d travels as EvalCoord1fv") {
  in.gl.EvalCoord1d = [](GLdouble u) { sound.EvalCoord1f(static_cast<GLfloat>(u)); };
}

GLX_FAULT(ScalarPairSentAsDoubles, "EV-GLX-SCALAR", "EvalCoord2f travels as EvalCoord2dv") {
  in.gl.EvalCoord2f = [](GLfloat u, GLfloat v) { sound.EvalCoord2d(u, v); };
}

GLX_FAULT(ScalarPairSwapped, "EV-GLX-SCALAR", "EvalCoord2d travels as EvalCoord2dv of (v, u)") {
  in.gl.EvalCoord2d = [](GLdouble u, GLdouble v) { sound.EvalCoord2d(v, u); };
}

// --- Points ------------------------------------------------------------------------------------------------

GLX_FAULT(PaddedPointsSentAsTheyAre, "EV-GLX-MAP1-PACK",
          "where the stride of Map1f is above k the values are sent from the first on, padding and all") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    const int k = gl::components_of(target);
    sound.Map1f(target, u1, u2, is_map1(target) && stride > k ? k : stride, order, points);
  };
}

GLX_FAULT(LastPointOfMap1dLost, "EV-GLX-MAP1-PACK",
          "where the stride of Map1d is above k the last point is sent as the one before it") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    const int k = gl::components_of(target);
    if (!is_map1(target) || stride <= k || order < 2)
      return sound.Map1d(target, u1, u2, stride, order, points);
    std::vector<GLdouble> copy(points, points + (order - 1) * stride + k);
    std::copy_n(copy.end() - k - stride, k, copy.end() - k);
    sound.Map1d(target, u1, u2, stride, order, copy.data());
  };
}

GLX_FAULT(DomainOfMap1Sorted, "EV-GLX-MAP1-PACK", "Map1d sends the smaller end of the domain first") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, std::min(u1, u2), std::max(u1, u2), stride, order, points);
  };
}

GLX_FAULT(NetSentColumnByColumn, "EV-GLX-MAP2-PACK", "Map2f sends its points with u running faster") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    const int k = gl::components_of(target);
    if (!is_map2(target) || uorder < 1 || vorder < 1 || ustride < k || vstride < k)
      return sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    std::vector<GLfloat> turned;
    for (int j = 0; j < vorder; ++j)
      for (int i = 0; i < uorder; ++i)
        turned.insert(turned.end(), points + i * ustride + j * vstride,
                      points + i * ustride + j * vstride + k);
    sound.Map2f(target, u1, u2, k * vorder, uorder, v1, v2, k, vorder, turned.data());
  };
}

GLX_FAULT(VMajorNetSentAsItLies, "EV-GLX-MAP2-PACK",
          "a net of Map2d that is packed the other way round is sent as it lies in memory") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    const int k = gl::components_of(target);
    if (is_map2(target) && ustride == k && vstride == k * uorder) {
      ustride = k * vorder;
      vstride = k;
    }
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

GLX_FAULT(OverlappingNetSentPacked, "EV-GLX-MAP2-PACK",
          "where the strides of Map2f are equal ustride is taken for k * vorder") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    const int k = gl::components_of(target);
    const bool equal = is_map2(target) && ustride == vstride && ustride >= k && uorder > 1 && vorder > 1;
    if (!equal) return sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    std::vector<GLfloat> net;
    const int last = (uorder - 1 + vorder - 1) * ustride;
    for (int i = 0; i < uorder; ++i)
      for (int j = 0; j < vorder; ++j) {
        const int at = std::min((i * vorder + j) * vstride, last);
        net.insert(net.end(), points + at, points + at + k);
      }
    sound.Map2f(target, u1, u2, k * vorder, uorder, v1, v2, k, vorder, net.data());
  };
}

GLX_FAULT(LargeNetOneRowShort, "EV-GLX-LARGE",
          "a net of Map2d of more than 16 rows is sent without the last") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, uorder > 16 ? uorder - 1 : uorder, v1, v2, vstride, vorder, points);
  };
}

GLX_FAULT(LargePartRepeated, "EV-GLX-LARGE", "of a large Map2f the second part has the values of the first") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    const int k = gl::components_of(target);
    if (!is_map2(target) || uorder * vorder <= 256 || ustride != k * vorder || vstride != k)
      return sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    std::vector<GLfloat> copy(points, points + uorder * vorder * k);
    std::copy_n(copy.begin(), copy.size() / 4, copy.begin() + static_cast<std::ptrdiff_t>(copy.size() / 4));
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, copy.data());
  };
}

GLX_FAULT(CommandAfterLargeLost, "EV-GLX-LARGE", "the first MapGrid1f after a large map is not sent") {
  map2(in, [](auto call, auto go) {
    go(call);
    memory.flag = call.uorder * call.vorder > 256;
  });
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (!memory.flag) sound.MapGrid1f(n, u1, u2);
    memory.flag = false;
  };
}

// --- Grids -------------------------------------------------------------------------------------------------

GLX_FAULT(GridOfDescendingEndsTurned, "EV-GLX-MAPGRID", "MapGrid1d sends the smaller end first") {
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    sound.MapGrid1d(n, std::min(u1, u2), std::max(u1, u2));
  };
}

GLX_FAULT(Grid2fDirectionsSwapped, "EV-GLX-MAPGRID", "MapGrid2f sends v before u") {
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    sound.MapGrid2f(vn, v1, v2, un, u1, u2);
  };
}

GLX_FAULT(Grid2dSegmentsSwapped, "EV-GLX-MAPGRID", "MapGrid2d sends vn before un") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    sound.MapGrid2d(vn, u1, u2, un, v1, v2);
  };
}

// --- Errors ------------------------------------------------------------------------------------------------

GLX_FAULT(UnknownTargetNotSent, "EV-GLX-ERRONEOUS", "Map1f with an unknown target does nothing") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (is_map1(target)) sound.Map1f(target, u1, u2, stride, order, points);
  };
}

GLX_FAULT(UnknownTargetTakenForAStride, "EV-GLX-ERRONEOUS",
          "the client takes an unknown target of Map2 for a stride that is too small") {
  map2(in, [](auto call, auto go) {
    if (is_map2(call.target))
      go(call);
    else
      sound.MapGrid1f(0, 0, 1);
  });
}

GLX_FAULT(NegativeOrderSentAsOne, "EV-GLX-ERRONEOUS",
          "a Map2d of a negative vorder is sent as one of order 1 with its points") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, std::max(vorder, 1), points);
  };
}

GLX_FAULT(ZeroVOrderNotSent, "EV-GLX-ERRONEOUS", "a Map2f of vorder 0 does nothing") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    if (vorder != 0) sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

GLX_FAULT(NegativeOrderOfMap1fIsInvalidEnum, "EV-GLX-ERRONEOUS",
          "a Map1f of a negative order raises INVALID_ENUM") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    sound.Map1f(order < 0 ? 0 : target, u1, u2, stride, order, points);
  };
}

GLX_FAULT(NegativeUOrderOfMap2dNotSent, "EV-GLX-ERRONEOUS", "a Map2d of a negative uorder does nothing") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    if (uorder >= 0) sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

GLX_FAULT(SmallVStrideOfMap2fNotChecked, "EV-GLX-STRIDE-CLIENT", "vstride of Map2f is not checked") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, std::max(vstride, gl::components_of(target)), vorder,
                points);
  };
}

GLX_FAULT(ZeroStrideMeansPacked, "EV-GLX-STRIDE-CLIENT", "stride 0 of Map1f means packed points") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    sound.Map1f(target, u1, u2, stride == 0 ? gl::components_of(target) : stride, order, points);
  };
}

GLX_FAULT(StrideOfOnePointNotChecked, "EV-GLX-STRIDE-CLIENT",
          "the stride of a Map1d of order 1 is not checked") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, order == 1 ? std::max(stride, gl::components_of(target)) : stride, order,
                points);
  };
}

GLX_FAULT(SmallStrideSentPacked, "EV-GLX-STRIDE-CLIENT", "Map1f sends a stride below k as packed points") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    sound.Map1f(target, u1, u2, std::max(stride, gl::components_of(target)), order, points);
  };
}

GLX_FAULT(SmallVStrideNotChecked, "EV-GLX-STRIDE-CLIENT", "the client checks ustride and not vstride") {
  map2(in, [](auto call, auto go) {
    call.vstride = std::max(call.vstride, gl::components_of(call.target));
    go(call);
  });
}

GLX_FAULT(SmallStrideReportedTwice, "EV-GLX-STRIDE-CLIENT",
          "a stride of Map1d below k is an error of the client and once more of the server") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order, points);
    if (stride < gl::components_of(target)) memory.flag = true;
  };
  in.gl.GetError = []() -> GLenum {
    const GLenum error = sound.GetError();
    if (error != GL_NO_ERROR || !memory.flag) return error;
    memory.flag = false;
    return GL_INVALID_VALUE;
  };
}

GLX_FAULT(SmallUStrideDefinesAllTheSame, "EV-GLX-STRIDE-CLIENT",
          "Map2f with a ustride below k raises the error and sends the map") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    if (ustride < gl::components_of(target) && uorder > 0 && vorder > 0)
      sound.Map2f(target, u1, u2, 3, uorder, v1, v2, vstride, vorder, points);
  };
}

// --- Replies -----------------------------------------------------------------------------------------------

// A reply of one value has it in its head, others behind it.
GLX_FAULT(ReplyOfOneValueIgnored, "EV-GLX-GETMAP-REPLY",
          "GetMapiv does not write the value of a reply of one") {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    const GLint before = *v;
    sound.GetMapiv(target, query, v);
    if (query == GL_ORDER && is_map1(target)) *v = before;
  };
}

GLX_FAULT(ReplyOfOneDoubleIsFloat, "EV-GLX-GETMAP-REPLY",
          "of a reply of one double GetMapdv takes the first four bytes for a float") {
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (target != GL_MAP1_INDEX || query == GL_DOMAIN) return;
    GLfloat half;
    std::copy_n(reinterpret_cast<const char*>(v), sizeof half, reinterpret_cast<char*>(&half));
    *v = half;
  };
}

GLX_FAULT(ReplyOneValueLong, "EV-GLX-GETMAP-REPLY", "GetMapfv writes one value more than the reply has") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    sound.GetMapfv(target, query, v);
    if (query == GL_DOMAIN) v[is_map2(target) ? 4 : 2] = 0;
  };
}

GLX_FAULT(ReplyLastValueLost, "EV-GLX-GETMAP-REPLY", "GetMapfv does not write the last of several points") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    GLint order[2] = {1, 1};
    if (query == GL_COEFF) sound.GetMapiv(target, GL_ORDER, order);
    const int last = order[0] * order[1] * gl::components_of(target) - 1;
    const GLfloat before = query == GL_COEFF && last > 0 ? v[last] : 0;
    sound.GetMapfv(target, query, v);
    if (query == GL_COEFF && last > 0) v[last] = before;
  };
}

// --- The same result ---------------------------------------------------------------------------------------

GLX_FAULT(IndirectSurfacesWithoutColors, "EV-GLX-SAMERESULT",
          "colours of surfaces are not drawn indirectly") {
  in.gl.Enable = [](GLenum cap) {
    if (cap != GL_MAP2_COLOR_4) sound.Enable(cap);
  };
}

GLX_FAULT(IndirectArgumentsRounded, "EV-GLX-SAMERESULT",
          "EvalCoord1f is sent with one bit behind the point") {
  in.gl.EvalCoord1f = [](GLfloat u) { sound.EvalCoord1f(std::nearbyint(u * 2) / 2); };
}

GLX_FAULT(IndirectMeshDrawsFirstRow, "EV-GLX-SAMERESULT",
          "of EvalMesh2 the first row alone is drawn indirectly") {
  mesh2(in, [](auto call) { sound.EvalMesh2(call.mode, call.i1, call.i2, call.j1, call.j1); });
}

GLX_FAULT(IndirectGridIsInitial, "EV-GLX-SAMERESULT", "EvalPoint1 has the initial grid indirectly") {
  in.gl.EvalPoint1 = [](GLint i) { sound.EvalCoord1f(static_cast<GLfloat>(i)); };
}

GLX_FAULT(IndirectVIsZero, "EV-GLX-SAMERESULT", "v of EvalCoord2f is not drawn indirectly") {
  in.gl.EvalCoord2f = [](GLfloat u, GLfloat) { sound.EvalCoord2f(u, 0); };
}

}  // namespace
}  // namespace evalcts::faults::glx_protocol
