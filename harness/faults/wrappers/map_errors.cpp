// Section 5: errors of Map1 and Map2.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "map_calls.h"

namespace evalcts::faults {
namespace {

// ---- Map1

EVALCTS_FAULT(OrderZeroTaken, production, must, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1") {
  map1(in, [](auto call, auto go) {
    if (call.order == 0) call.order = 1;
    go(call);
  });
}

EVALCTS_FAULT(StrideErrorIsInvalidEnum, production, must, "EV-MAP1-ERR-STRIDE",
              "Map1d with a stride below k raises INVALID_ENUM") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    const bool wrong = gl::components_of(target) > stride;
    sound.Map1d(wrong ? 0 : target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(Map1TakesMap2Names, production, must, "EV-MAP1-ERR-TARGET",
              "Map1d takes the name of a two-dimensional map for its namesake") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(is_map2(target) ? target - 0x20 : target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(OnePastVertex4Ignored, production, must, "EV-MAP1-ERR-TARGET",
              "Map1 of 0x0D99, one past the last name, is ignored without an error") {
  map1(in, [](auto call, auto go) {
    if (call.target != GL_MAP1_VERTEX_4 + 1) go(call);
  });
}

EVALCTS_FAULT(UnknownTargetIsInvalidValue, production, must, "EV-MAP1-ERR-TARGET",
              "Map1 of a capability that is no map raises INVALID_VALUE") {
  map1(in, [](auto call, auto go) {
    if (call.target == GL_AUTO_NORMAL || call.target == GL_TEXTURE_2D) {
      call.target = GL_MAP1_VERTEX_4;
      call.order = 0;
    }
    go(call);
  });
}

EVALCTS_FAULT(NegativeOrderIgnored, production, must, "EV-MAP1-ERR-ORDER-LOW",
              "Map1f of a negative order copies no point and raises no error") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (order >= 0) sound.Map1f(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(LowestOrderOverflows, production, must, "EV-MAP1-ERR-ORDER-LOW",
              "order - 1 of the lowest int overflows to a large degree, which is cut to the largest") {
  map1(in, [](auto call, auto go) {
    if (call.order == std::numeric_limits<GLint>::min()) call.order = kMaxOrder;
    go(call);
  });
}

EVALCTS_FAULT(DegreeChecked, production, must, "EV-MAP1-ERR-ORDER-HIGH",
              "the degree instead of the order is held against the limit: MAX + 1 is taken, as MAX") {
  map1(in, [](auto call, auto go) {
    if (call.order == kMaxOrder + 1) call.order = kMaxOrder;
    go(call);
  });
}

EVALCTS_FAULT(OrderInOneByte, production, must, "EV-MAP1-ERR-ORDER-HIGH",
              "Map1d keeps the order in a byte before it checks it: 257 is 1") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order > 255 ? order & 255 : order, points);
  };
}

EVALCTS_FAULT(OrderInSixteenBits, production, must, "EV-MAP1-ERR-ORDER-HIGH",
              "the order is checked as 16 bits: 65537 is 1") {
  map1(in, [](auto call, auto go) {
    if (call.order > 65535) call.order &= 65535;
    go(call);
  });
}

EVALCTS_FAULT(HighOrderIsInvalidOperation, production, must, "EV-MAP1-ERR-ORDER-HIGH",
              "an order far above the limit raises INVALID_OPERATION, as if a resource were short") {
  map1(in, [](auto call, auto go) {
    if (is_map1(call.target) && call.order >= kMaxOrder + 100) return leave_error(GL_INVALID_OPERATION);
    go(call);
  });
}

EVALCTS_FAULT(NegativeStrideTurned, production, must, "EV-MAP1-ERR-STRIDE",
              "a stride of -17 or less counts as its magnitude") {
  map1(in, [](auto call, auto go) {
    if (call.stride <= -17 && call.stride > -10000) call.stride = -call.stride;
    go(call);
  });
}

EVALCTS_FAULT(StrideOfTexture2Unchecked, production, must, "EV-MAP1-ERR-STRIDE",
              "Map1f of TEXTURE_COORD_2 is content with a stride of 1") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (target == GL_MAP1_TEXTURE_COORD_2 && stride == 1) stride = 2;
    sound.Map1f(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(StrideZeroMeansPacked, production, must, "EV-MAP1-ERR-STRIDE",
              "stride 0 means packed points, as in vertex arrays") {
  map1(in, [](auto call, auto go) {
    if (call.stride == 0 && call.order > 1) call.stride = gl::components_of(call.target);
    go(call);
  });
}

EVALCTS_FAULT(StrideOfOrder1Unchecked, production, must, "EV-MAP1-ERR-STRIDE-ORDER1",
              "the stride is not checked at order 1, where it is not used") {
  map1(in, [](auto call, auto go) {
    if (call.order == 1) call.stride = std::max(call.stride, gl::components_of(call.target));
    go(call);
  });
}

EVALCTS_FAULT(StrideOfOrder1ZeroOnly, production, must, "EV-MAP1-ERR-STRIDE-ORDER1",
              "Map1d of order 1 refuses strides below 1 only") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    if (order == 1 && stride > 0) stride = std::max(stride, gl::components_of(target));
    sound.Map1d(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(EqualEndsOfConstantTaken, production, must, "EV-MAP1-ERR-DOMAIN",
              "equal ends of a map of order 1 are taken, as nothing is divided by their difference") {
  map1(in, [](auto call, auto go) {
    if (call.order == 1 && call.u1 == call.u2) call.u2 = call.u1 + 1;
    go(call);
  });
}

EVALCTS_FAULT(EqualLargeEndsTaken, production, must, "EV-MAP1-ERR-DOMAIN",
              "equal ends beyond 1e5 are taken for different ones") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (call.u1 == call.u2 && std::abs(call.u1) > Real(1e5)) call.u2 = call.u1 + 1024;
    go(call);
  });
}

EVALCTS_FAULT(EqualEndsIgnoredInDoubles, production, must, "EV-MAP1-ERR-DOMAIN",
              "Map1d with equal ends does nothing and raises nothing") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    if (u1 != u2) sound.Map1d(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(EndsComparedByBits, production, quality, "EV-MAP1-ERR-DOMAIN",
              "the ends are compared bit by bit, and so +0 and -0 count as different") {
  map1(in, [](auto call, auto go) {
    if (call.u1 == call.u2 && std::signbit(call.u1) != std::signbit(call.u2)) call.u2 = 1;
    go(call);
  });
}

EVALCTS_FAULT(Map1TakenInPolygons, production, must, "EV-MAP1-ERR-BEGINEND",
              "Map1 inside a POLYGON is ignored without an error") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_POLYGON;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  map1(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
}

EVALCTS_FAULT(Map1RefusedAfterFirstVertex, production, must, "EV-MAP1-ERR-BEGINEND",
              "Map1 is refused from the first vertex of a primitive on, and ignored before") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = true;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  in.gl.Vertex3f = [](GLfloat x, GLfloat y, GLfloat z) {
    memory.flag = false;
    sound.Vertex3f(x, y, z);
  };
  map1(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
}

EVALCTS_FAULT(Map1dInPrimitiveIsInvalidEnum, production, must, "EV-MAP1-ERR-BEGINEND",
              "Map1d in a primitive raises INVALID_ENUM") {
  follow_primitives(in);
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(memory.flag ? 0 : target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(Map1DefinedWhenPrimitiveEnds, production, must, "EV-MAP1-ERR-NOEFFECT",
              "Map1 in a primitive raises its error, and is carried out when the primitive ends") {
  follow_primitives(in);
  in.gl.End = [] {
    sound.End();
    memory.flag = false;
    if (memory.number == 0) return;
    const GLenum target = static_cast<GLenum>(memory.number);
    memory.number = 0;
    sound.Map1d(target, 0, 1, gl::components_of(target), 1, memory.numbers.data());
  };
  map1(in, [](auto call, auto go) {
    go(call);
    if (!memory.flag || !legal(call)) return;
    memory.number = call.target;
    memory.numbers = {static_cast<double>(call.points[0]), 0, 0, 0};
  });
}

EVALCTS_FAULT(OnlyTextureMapsNeedUnit0, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "with another unit active Map1 refuses the texture maps only") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  map1(in, [](auto call, auto go) {
    if (is_texture_map1(call.target) || memory.number == 0) return go(call);
    sound.ActiveTexture(GL_TEXTURE0);
    go(call);
    sound.ActiveTexture(static_cast<GLenum>(memory.number));
  });
}

EVALCTS_FAULT(Map1dTakenOnAnyUnit, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "Map1d of INDEX is refused on no unit") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    if (target == GL_MAP1_INDEX) sound.ActiveTexture(GL_TEXTURE0);
    sound.Map1d(target, u1, u2, stride, order, points);
    if (target == GL_MAP1_INDEX && memory.number != 0)
      sound.ActiveTexture(static_cast<GLenum>(memory.number));
  };
}

EVALCTS_FAULT(RefusedMap1SelectsUnit0, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "after the error for another active unit unit 0 is active") {
  map1(in, [](auto call, auto go) {
    go(call);
    GLint unit = GL_TEXTURE0;
    if (legal(call)) sound.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    if (unit != GL_TEXTURE0) sound.ActiveTexture(GL_TEXTURE0);
  });
}

EVALCTS_FAULT(UnitErrorIsInvalidEnum, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "Map1 of VERTEX_4 on another unit raises INVALID_ENUM") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  map1(in, [](auto call, auto go) {
    if (memory.flag && call.target == GL_MAP1_VERTEX_4) call.target = 0;
    go(call);
  });
}

EVALCTS_FAULT(DomainSetBeforeStrideCheck, production, must, "EV-MAP1-ERR-NOEFFECT",
              "a Map1 refused for its stride has set the domain") {
  map1(in, [](auto call, auto go) {
    if (is_map1(call.target) && legal_order(call.order) && call.u1 != call.u2 &&
        call.stride < gl::components_of(call.target)) {
      const std::vector<GLdouble> points = coefficients(call.target);
      const GLint k = gl::components_of(call.target);
      sound.Map1d(call.target, static_cast<double>(call.u1), static_cast<double>(call.u2), k,
                  static_cast<GLint>(points.size()) / k, points.data());
    }
    go(call);
  });
}

EVALCTS_FAULT(RefusedOrderSwitchesOff, production, must, "EV-MAP1-ERR-NOEFFECT",
              "a Map1d refused for its order disables the map") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order, points);
    if (is_map1(target) && !legal_order(order)) sound.Disable(target);
  };
}

EVALCTS_FAULT(RefusedDomainForgetsMap, production, must, "EV-MAP1-ERR-NOEFFECT",
              "a Map1 refused for its domain leaves the map with its first point only") {
  map1(in, [](auto call, auto go) {
    if (is_map1(call.target) && call.u1 == call.u2) {
      GLdouble domain[2];
      sound.GetMapdv(call.target, GL_DOMAIN, domain);
      const std::vector<GLdouble> points = coefficients(call.target);
      sound.Map1d(call.target, domain[0], domain[1], gl::components_of(call.target), 1, points.data());
    }
    go(call);
  });
}

EVALCTS_FAULT(RefusedNameDefinesNamesake, production, must, "EV-MAP1-ERR-NOEFFECT",
              "a Map1 with a two-dimensional name raises its error and defines the one-dimensional map") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!is_map2(call.target)) return;
    call.target -= 0x20;
    go(call);
  });
}

// ---- Map2

EVALCTS_FAULT(Map2TakesMap1Names, production, must, "EV-MAP2-ERR-TARGET",
              "Map2f takes the name of a one-dimensional map for its namesake") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(is_map1(target) ? target + 0x20 : target, u1, u2, ustride, uorder, v1, v2, vstride, vorder,
                points);
  };
}

EVALCTS_FAULT(OneBeforeColor2IsInvalidValue, production, must, "EV-MAP2-ERR-TARGET",
              "Map2 of 0x0DAF, one before the first name, raises INVALID_VALUE") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_COLOR_4 - 1) {
      call.target = GL_MAP2_COLOR_4;
      call.uorder = 0;
    }
    go(call);
  });
}

EVALCTS_FAULT(UOrderZeroTaken, production, must, "EV-MAP2-ERR-UORDER", "Map2 takes uorder 0 as 1") {
  map2(in, [](auto call, auto go) {
    if (call.uorder == 0) call.uorder = 1;
    go(call);
  });
}

EVALCTS_FAULT(UOrderCutToLargest, production, must, "EV-MAP2-ERR-UORDER",
              "Map2d cuts a uorder above the limit to it") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, std::min(uorder, kMaxOrder), v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(VOrderInOneByte, production, must, "EV-MAP2-ERR-VORDER",
              "vorder is kept in a byte before it is checked: 257 is 1") {
  map2(in, [](auto call, auto go) {
    if (call.vorder > 255) call.vorder &= 255;
    go(call);
  });
}

EVALCTS_FAULT(NegativeVOrderIgnored, production, must, "EV-MAP2-ERR-VORDER",
              "a negative vorder copies no point and raises no error") {
  map2(in, [](auto call, auto go) {
    if (call.vorder >= 0) go(call);
  });
}

EVALCTS_FAULT(OrdersCheckedByProduct, production, must, "EV-MAP2-ERR-VORDER EV-MAP2-ERR-UORDER",
              "orders are refused where their product is above 64*64: 65 is fine with 1, as 64") {
  map2(in, [](auto call, auto go) {
    if (call.uorder > 0 && call.vorder > 0 && call.uorder * call.vorder <= 4096) {
      call.uorder = std::min(call.uorder, kMaxOrder);
      call.vorder = std::min(call.vorder, kMaxOrder);
    }
    go(call);
  });
}

EVALCTS_FAULT(SumOfStridesChecked, production, must, "EV-MAP2-ERR-USTRIDE",
              "a ustride of k - 1 is taken, as k, where vstride is larger than k") {
  map2(in, [](auto call, auto go) {
    const GLint k = gl::components_of(call.target);
    if (call.ustride == k - 1 && call.vstride > k) call.ustride = k;
    go(call);
  });
}

EVALCTS_FAULT(UStrideUncheckedInRowsOfOne, production, must, "EV-MAP2-ERR-USTRIDE",
              "ustride is not checked where uorder is 1") {
  map2(in, [](auto call, auto go) {
    if (call.uorder == 1) call.ustride = std::max(call.ustride, gl::components_of(call.target));
    go(call);
  });
}

EVALCTS_FAULT(VStrideUncheckedAtOneByOne, production, must, "EV-MAP2-ERR-VSTRIDE",
              "Map2d of 1x1 points does not check vstride") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    if (uorder == 1 && vorder == 1) vstride = std::max(vstride, gl::components_of(target));
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(NegativeVStrideTurned, production, must, "EV-MAP2-ERR-VSTRIDE",
              "a vstride of -17 counts as 17") {
  map2(in, [](auto call, auto go) {
    if (call.vstride == -17) call.vstride = 17;
    go(call);
  });
}

EVALCTS_FAULT(VDomainCheckedOnlyWithU, production, must, "EV-MAP2-ERR-VDOMAIN",
              "equal ends of v are taken where those of u differ by 1 or more") {
  map2(in, [](auto call, auto go) {
    if (call.v1 == call.v2 && std::abs(call.u1 - call.u2) >= 1) call.v2 = call.v1 + 1;
    go(call);
  });
}

EVALCTS_FAULT(EqualEndsOfVAreInvalidOperation, production, must, "EV-MAP2-ERR-VDOMAIN",
              "Map2f with v1 = v2 raises INVALID_OPERATION") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    if (is_map2(target) && v1 == v2 && u1 != u2) return leave_error(GL_INVALID_OPERATION);
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(EqualEndsOfConstantNetTaken, production, must, "EV-MAP2-ERR-UDOMAIN",
              "u1 = u2 is taken for a net of 1x1 points") {
  map2(in, [](auto call, auto go) {
    if (call.uorder == 1 && call.vorder == 1 && call.u1 == call.u2) call.u2 = call.u1 + 1024;
    go(call);
  });
}

EVALCTS_FAULT(EqualNegativeEndsOfUTaken, production, must, "EV-MAP2-ERR-UDOMAIN",
              "u1 = u2 is taken where both are negative") {
  map2(in, [](auto call, auto go) {
    if (call.u1 == call.u2 && call.u1 < 0) call.u2 = -call.u1;
    go(call);
  });
}

EVALCTS_FAULT(EndsOfVComparedByBits, production, quality, "EV-MAP2-ERR-VDOMAIN",
              "the ends of v are compared bit by bit, and so +0 and -0 count as different") {
  map2(in, [](auto call, auto go) {
    if (call.v1 == call.v2 && std::signbit(call.v1) != std::signbit(call.v2)) call.v2 = 1;
    go(call);
  });
}

EVALCTS_FAULT(Map2TakenInQuadStrips, production, must, "EV-MAP2-ERR-BEGINEND",
              "Map2 inside a QUAD_STRIP is ignored without an error") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_QUAD_STRIP;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  map2(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
}

EVALCTS_FAULT(Map2dInPrimitiveIsInvalidValue, production, must, "EV-MAP2-ERR-BEGINEND",
              "Map2d in a primitive raises INVALID_VALUE") {
  follow_primitives(in);
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, memory.flag ? 0 : uorder, v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(LastUnitTakenForFirst, production, must, "EV-MAP2-ERR-ACTIVETEX",
              "Map2 refuses unit 1, but none of those above") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  map2(in, [](auto call, auto go) {
    if (memory.number <= GL_TEXTURE1) return go(call);
    sound.ActiveTexture(GL_TEXTURE0);
    go(call);
    sound.ActiveTexture(static_cast<GLenum>(memory.number));
  });
}

EVALCTS_FAULT(OnlyTextureNetsNeedUnit0, production, must, "EV-MAP2-ERR-ACTIVETEX",
              "with another unit active Map2 takes vertex nets") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  map2(in, [](auto call, auto go) {
    if (call.target < GL_MAP2_VERTEX_3 || memory.number == 0) return go(call);
    sound.ActiveTexture(GL_TEXTURE0);
    go(call);
    sound.ActiveTexture(static_cast<GLenum>(memory.number));
  });
}

EVALCTS_FAULT(UDirectionSetBeforeVIsChecked, production, must, "EV-MAP2-ERR-NOEFFECT",
              "a Map2 refused for v1 = v2 has set the interval of u") {
  map2(in, [](auto call, auto go) {
    if (is_map2(call.target) && call.u1 != call.u2 && call.v1 == call.v2) {
      const std::vector<GLdouble> points = coefficients(call.target);
      const GLint k = gl::components_of(call.target);
      GLint order[2];
      GLdouble domain[4];
      sound.GetMapiv(call.target, GL_ORDER, order);
      sound.GetMapdv(call.target, GL_DOMAIN, domain);
      sound.Map2d(call.target, static_cast<double>(call.u1), static_cast<double>(call.u2), k * order[1],
                  order[0], domain[2], domain[3], k, order[1], points.data());
    }
    go(call);
  });
}

EVALCTS_FAULT(RefusedVOrderLosesColumns, production, must, "EV-MAP2-ERR-NOEFFECT",
              "a Map2 refused for its vorder leaves the map with one column") {
  map2(in, [](auto call, auto go) {
    if (is_map2(call.target) && legal_order(call.uorder) && !legal_order(call.vorder)) {
      const std::vector<GLdouble> points = coefficients(call.target);
      const GLint k = gl::components_of(call.target);
      GLint order[2];
      GLdouble domain[4];
      sound.GetMapiv(call.target, GL_ORDER, order);
      sound.GetMapdv(call.target, GL_DOMAIN, domain);
      sound.Map2d(call.target, domain[0], domain[1], k * order[1], order[0], domain[2], domain[3], k, 1,
                  points.data());
    }
    go(call);
  });
}

EVALCTS_FAULT(RefusedUnitDefinesTheNet, production, must, "EV-MAP2-ERR-NOEFFECT",
              "Map2d on another unit raises its error and defines the map all the same") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    if (memory.number <= GL_TEXTURE0) return;
    sound.ActiveTexture(GL_TEXTURE0);
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    sound.ActiveTexture(static_cast<GLenum>(memory.number));
  };
}

EVALCTS_FAULT(RefusedNetEnablesAutoNormal, production, must, "EV-MAP2-ERR-NOEFFECT",
              "a Map2 refused for its ustride toggles AUTO_NORMAL") {
  map2(in, [](auto call, auto go) {
    go(call);
    if (!is_map2(call.target) || call.ustride >= gl::components_of(call.target)) return;
    if (sound.IsEnabled(GL_AUTO_NORMAL))
      sound.Disable(GL_AUTO_NORMAL);
    else
      sound.Enable(GL_AUTO_NORMAL);
  });
}

// ---- Both

EVALCTS_FAULT(TwoErrorsForTwoMistakes, production, must, "EV-MAP-ERR-ANY",
              "a bad target with a bad order raises two errors, the second once the first was asked for") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!is_map1(call.target) && !legal_order(call.order)) memory.count = 1;
  });
  map2(in, [](auto call, auto go) {
    go(call);
    if (!is_map2(call.target) && !(legal_order(call.uorder) && legal_order(call.vorder))) memory.count = 1;
  });
  in.gl.GetError = []() -> GLenum {
    const GLenum error = sound.GetError();
    if (error == GL_NO_ERROR && memory.count > 0) {
      memory.count = 0;
      return GL_INVALID_VALUE;
    }
    return error;
  };
}

EVALCTS_FAULT(TwoMistakesCancel, production, must, "EV-MAP-ERR-ANY/1-D",
              "a Map1 with a bad order, stride and domain at once raises nothing") {
  map1(in, [](auto call, auto go) {
    if (call.order < 1 && call.stride < gl::components_of(call.target) && call.u1 == call.u2) return;
    go(call);
  });
}

EVALCTS_FAULT(SeveralMistakesAreInvalidOperation, production, must, "EV-MAP-ERR-ANY/2-D",
              "a Map2 with a bad value in both directions raises INVALID_OPERATION") {
  map2(in, [](auto call, auto go) {
    const GLint k = gl::components_of(call.target);
    if (is_map2(call.target) && call.ustride < k && call.v1 == call.v2)
      return leave_error(GL_INVALID_OPERATION);
    go(call);
  });
}

EVALCTS_FAULT(LargeStrideRefused, production, must, "EV-MAP-NOERR-OTHER",
              "a stride of 1000 or more, far larger than needed, raises INVALID_VALUE") {
  map1(in, [](auto call, auto go) {
    if (call.stride >= 1000 && call.order == 1) call.stride = 0;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (call.ustride >= 900 && call.vstride >= 1000) call.ustride = 0;
    go(call);
  });
}

EVALCTS_FAULT(NarrowDomainCountsAsEmpty, production, must, "EV-MAP-NOERR-OTHER",
              "ends that differ by one float are refused as equal") {
  map1(in, [](auto call, auto go) {
    if (std::abs(call.u1 - call.u2) < 1e-6 * std::abs(call.u1)) call.u2 = call.u1;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (std::abs(call.v1 - call.v2) < 1e-6 * std::abs(call.v1)) call.v2 = call.v1;
    go(call);
  });
}

EVALCTS_FAULT(ReversedConstantRefused, production, must, "EV-MAP-NOERR-OTHER/1-D",
              "u1 > u2 is refused at order 1") {
  map1(in, [](auto call, auto go) {
    if (call.order == 1 && call.u1 > call.u2) call.order = 0;
    go(call);
  });
}

EVALCTS_FAULT(SubnormalPointsRefused, production, must, "EV-MAP-NOERR-OTHER",
              "a subnormal control point raises INVALID_VALUE") {
  map1(in, [](auto call, auto go) {
    if (legal(call) && std::abs(static_cast<double>(call.points[0])) < 1e-38 && call.points[0] != 0)
      call.order = 0;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (legal(call) && std::abs(static_cast<double>(call.points[0])) < 1e-38 && call.points[0] != 0)
      call.uorder = 0;
    go(call);
  });
}

EVALCTS_FAULT(HugeUnusedStrideOverflows, production, must, "EV-MAP-NOERR-OTHER/2-D",
              "Map2 with a stride that times its order overflows is refused, though the order is 1") {
  map2(in, [](auto call, auto go) {
    if (call.ustride > 0x40000000) call.ustride = 0;
    go(call);
  });
}

EVALCTS_FAULT(TouchingIntervalsRefused, production, must, "EV-MAP-NOERR-OTHER/2-D",
              "Map2 raises INVALID_VALUE for u2 = v1") {
  map2(in, [](auto call, auto go) {
    if (call.u2 == call.v1 && call.v2 == call.u1) call.v2 = call.v1;
    go(call);
  });
}

// ---- What only certain arguments or a certain past show

EVALCTS_FAULT(TargetInSixteenBits, production, must, "EV-MAP1-ERR-TARGET EV-MAP2-ERR-TARGET",
              "only the low 16 bits of a target are looked at") {
  map1(in, [](auto call, auto go) {
    if (is_map1(call.target & 0xFFFF)) call.target &= 0xFFFF;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (is_map2(call.target & 0xFFFF)) call.target &= 0xFFFF;
    go(call);
  });
}

EVALCTS_FAULT(GapBetweenNamesIgnored, production, must, "EV-MAP1-ERR-TARGET",
              "Map1 of 0x0DA0, between the names of both dimensions, is ignored without an error") {
  map1(in, [](auto call, auto go) {
    if (call.target != 0x0DA0) go(call);
  });
}

EVALCTS_FAULT(StrideOfLongMapsUnchecked, production, must, "EV-MAP1-ERR-STRIDE",
              "the stride is not checked from order 4 on") {
  map1(in, [](auto call, auto go) {
    if (call.order > 3 && call.stride > 0)
      call.stride = std::max(call.stride, gl::components_of(call.target));
    go(call);
  });
}

EVALCTS_FAULT(EqualEndsOfLineTaken, production, must, "EV-MAP1-ERR-DOMAIN",
              "equal ends of a map of order 2 are taken: the line is vertical") {
  map1(in, [](auto call, auto go) {
    if (call.order == 2 && call.u1 == call.u2) call.u2 = call.u1 + 1024;
    go(call);
  });
}

EVALCTS_FAULT(EqualEndsOfSquareNetTaken, production, must, "EV-MAP2-ERR-UDOMAIN",
              "u1 = u2 is taken for nets of 2x2 points") {
  map2(in, [](auto call, auto go) {
    if (call.uorder == 2 && call.vorder == 2 && call.u1 == call.u2) call.u2 = call.u1 + 1024;
    go(call);
  });
}

EVALCTS_FAULT(VStrideOfLongRowsUnchecked, production, must, "EV-MAP2-ERR-VSTRIDE",
              "vstride is not checked from vorder 4 on") {
  map2(in, [](auto call, auto go) {
    if (call.vorder > 3 && call.vstride > 0)
      call.vstride = std::max(call.vstride, gl::components_of(call.target));
    go(call);
  });
}

EVALCTS_FAULT(ChecksSkippedWhileErrorWaits, production, must, "EV-MAP1-ERR-NOEFFECT",
              "while an error waits Map1d of order 0 is carried out as one of order 1") {
  map1(in, [](auto call, auto go) {
    if (memory.flag && call.order == 0 && sizeof *call.points == 8) call.order = 1;
    if (!legal(call)) memory.flag = true;
    go(call);
  });
  in.gl.GetError = [] {
    memory.flag = false;
    return sound.GetError();
  };
}

EVALCTS_FAULT(ErrorForgottenByLegalMap2, production, must, "EV-MAP2-ERR-NOEFFECT",
              "a legal Map2 clears the error that waits") {
  map2(in, [](auto call, auto go) {
    if (legal(call)) sound.GetError();
    go(call);
  });
}

EVALCTS_FAULT(CallAfterErrorIgnored, production, must, "EV-MAP1-ERR-NOEFFECT",
              "the Map1 that follows a refused one is ignored") {
  map1(in, [](auto call, auto go) {
    const bool ignored = memory.flag && legal(call);
    memory.flag = !legal(call);
    if (!ignored) go(call);
  });
}

EVALCTS_FAULT(UnitOfPopAttribMissed, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "Map1 goes by the unit of the last ActiveTexture, whatever PopAttrib brought back") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  map1(in, [](auto call, auto go) {
    if (memory.flag && legal(call)) return leave_error(GL_INVALID_OPERATION);
    go(call);
  });
}

EVALCTS_FAULT(UnitBroughtBackByPopAttribMissed2, production, must, "EV-MAP2-ERR-ACTIVETEX",
              "Map2 is legal after ActiveTexture(TEXTURE0), though PopAttrib brought unit 1 back") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.count = static_cast<long>(texture);
    sound.ActiveTexture(texture);
  };
  map2(in, [](auto call, auto go) {
    GLint unit = GL_TEXTURE0;
    if (legal(call) && memory.count == GL_TEXTURE0) sound.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    if (unit == GL_TEXTURE0) return go(call);
    sound.ActiveTexture(GL_TEXTURE0);
    go(call);
    sound.ActiveTexture(static_cast<GLenum>(unit));
  });
}

EVALCTS_FAULT(RepeatedPointsRefused, production, must, "EV-MAP-NOERR-OTHER",
              "a map whose points are all the same raises INVALID_VALUE, as it has no direction") {
  map1(in, [](auto call, auto go) {
    if (legal(call) && call.order > 2 &&
        std::equal(call.points, call.points + gl::components_of(call.target), call.points + call.stride) &&
        std::equal(call.points, call.points + gl::components_of(call.target), call.points + 2 * call.stride))
      call.order = 0;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.vorder > 2 && call.target >= GL_MAP2_VERTEX_3 &&
        std::equal(call.points, call.points + gl::components_of(call.target), call.points + call.vstride) &&
        std::equal(call.points, call.points + gl::components_of(call.target), call.points + 2 * call.vstride))
      call.vorder = 0;
    go(call);
  });
}

EVALCTS_FAULT(LargeDomainsRefused, production, must, "EV-MAP-NOERR-OTHER",
              "a domain that reaches to 2^31 raises INVALID_VALUE, as no int holds it") {
  map1(in, [](auto call, auto go) {
    if (std::abs(static_cast<double>(call.u1)) >= 0x1p31) call.order = 0;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    if (std::abs(static_cast<double>(call.v2)) >= 0x1p31) call.vorder = 0;
    go(call);
  });
}

EVALCTS_FAULT(SecondBadOrderSilent, production, must, "EV-MAP2-ERR-UORDER EV-MAP2-ERR-VORDER",
              "of two Map2 with bad orders in a row the second raises no error") {
  map2(in, [](auto call, auto go) {
    const bool bad_orders = !legal_order(call.uorder) || !legal_order(call.vorder);
    const bool silent = memory.flag && bad_orders;
    memory.flag = bad_orders;
    if (!silent) go(call);
  });
}

EVALCTS_FAULT(Map1TakenOnLastUnit, production, must, "EV-MAP1-ERR-ACTIVETEX",
              "Map1 refuses unit 1, but none of those above") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.number = texture;
    sound.ActiveTexture(texture);
  };
  map1(in, [](auto call, auto go) {
    if (memory.number <= GL_TEXTURE1) return go(call);
    sound.ActiveTexture(GL_TEXTURE0);
    go(call);
    sound.ActiveTexture(static_cast<GLenum>(memory.number));
  });
}

EVALCTS_FAULT(MapsIgnoredInLineLoops, production, must, "EV-MAP1-ERR-BEGINEND EV-MAP2-ERR-BEGINEND",
              "Map1 and Map2 in a LINE_LOOP do nothing and raise nothing") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_LINE_LOOP;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  map1(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
  map2(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
}

}  // namespace
}  // namespace evalcts::faults
