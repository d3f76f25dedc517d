// Section 3: one-dimensional maps, what they keep and what they evaluate to.
#include <cmath>
#include <cstring>

#include "map_calls.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

// ---- Values

EVALCTS_FAULT(HighOrdersCutTo48, production, must, "EV-MAP1-BEZIER",
              "points beyond the 48th of a map are evaluated as if they were the 48th") {
  map1(in, [](auto call, auto go) {
    if (!legal(call) || call.order <= 48) return go(call);
    auto points = packed(call);
    const auto k = static_cast<std::size_t>(gl::components_of(call.target));
    for (std::size_t i = 48 * k; i < points.size(); ++i) points[i] = points[47 * k + i % k];
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(CubicTakenAsLine, production, must, "EV-MAP1-BEZIER",
              "a cubic of TEXTURE_COORD_2 with flat ends is drawn as the line between its ends") {
  map1(in, [](auto call, auto go) {
    if (!legal(call) || call.target != GL_MAP1_TEXTURE_COORD_2 || call.order != 4) return go(call);
    auto points = packed(call);
    for (std::size_t c = 0; c < 2; ++c) {
      points[2 + c] = (2 * points[c] + points[6 + c]) / 3;
      points[4 + c] = (points[c] + 2 * points[6 + c]) / 3;
    }
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(UpperEndAvoided, production, must, "EV-MAP1-ZEROPOW",
              "u2 is evaluated just below, at 0.999, so that 0^0 is never needed") {
  map1(in, [](auto call, auto go) {
    memory.numbers = {static_cast<double>(call.u1), static_cast<double>(call.u2)};
    go(call);
  });
  in.gl.EvalCoord1d = [](GLdouble u) {
    if (!memory.numbers.empty() && u == memory.numbers[1]) u = u - 0.001 * (u - memory.numbers[0]);
    sound.EvalCoord1d(u);
  };
}

EVALCTS_FAULT(NarrowDomainsWidened, production, must, "EV-MAP1-DOMAIN",
              "a domain narrower than 1e-4 is taken as 1e-4 wide, against division by almost nothing") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (std::abs(call.u2 - call.u1) < Real(1e-4) && call.u2 > call.u1) call.u2 = call.u1 + Real(1e-4);
    go(call);
  });
}

EVALCTS_RULES(ReversedDomainSorted, production, must, "EV-MAP1-REVERSED EV-GETMAP-DOMAIN1",
              "Map1d sorts the ends of a domain", before(Map1d, kU1 > kU2, swap(kU1, kU2)));
EVALCTS_RULES(ReversedNegativeDomainSorted, production, must, "EV-MAP1-REVERSED",
              "a reversed domain below zero is taken as rising",
              before(kMap1, kU1 < 0 && kU2 < kU1, swap(kU1, kU2)));

EVALCTS_FAULT(ClampedAboveInDoubles, production, must, "EV-MAP1-EXTRAPOLATE",
              "EvalCoord1d clamps u to the upper end of the domain") {
  map1(in, [](auto call, auto go) {
    memory.numbers = {static_cast<double>(std::max(call.u1, call.u2))};
    go(call);
  });
  in.gl.EvalCoord1d = [](GLdouble u) {
    sound.EvalCoord1d(memory.numbers.empty() ? u : std::min(u, memory.numbers[0]));
  };
}

EVALCTS_FAULT(GridEndsClampedToDomain, production, must, "EV-MAP1-EXTRAPOLATE",
              "EvalPoint1 of index 0 is clamped to the domain of the last map") {
  map1(in, [](auto call, auto go) {
    memory.numbers = {static_cast<double>(std::min(call.u1, call.u2)),
                      static_cast<double>(std::max(call.u1, call.u2))};
    go(call);
  });
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.number = static_cast<double>(u1);
    go(n, u1, u2);
  });
  in.gl.EvalPoint1 = [](GLint i) {
    if (i != 0 || memory.numbers.empty()) return sound.EvalPoint1(i);
    sound.EvalCoord1d(std::clamp(memory.number, memory.numbers[0], memory.numbers[1]));
  };
}

EVALCTS_FAULT(OrderOneStartsAfterPadding, production, must, "EV-MAP1-ORDER-ONE EV-MAP1-PADDING",
              "the single point of a map of order 1 is taken from the end of its block") {
  map1(in, [](auto call, auto go) {
    if (legal(call) && call.order == 1) {
      call.points += call.stride - gl::components_of(call.target);
      call.stride = gl::components_of(call.target);
    }
    go(call);
  });
}

EVALCTS_FAULT(BlueFirstInDoubles, production, must, "EV-MAP1-COMPORDER",
              "Map1d takes the values of a colour in the order B,G,R,A") {
  map1(in, [](auto call, auto go) {
    if (!legal(call) || call.target != GL_MAP1_COLOR_4 || sizeof *call.points == 4) return go(call);
    auto points = packed(call);
    for (std::size_t i = 0; i < points.size(); i += 4) std::swap(points[i], points[i + 2]);
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(QBeforeR, production, must, "EV-MAP1-COMPORDER",
              "TEXTURE_COORD_4 maps are read in the order s,t,q,r") {
  map1(in, [](auto call, auto go) {
    if (!legal(call) || call.target != GL_MAP1_TEXTURE_COORD_4) return go(call);
    auto points = packed(call);
    for (std::size_t i = 0; i < points.size(); i += 4) std::swap(points[i + 2], points[i + 3]);
    go(with_points(call, points));
  });
}

// ---- State

EVALCTS_RULES(LargestColorMapRefused, production, must, "EV-MAP1-ORDER-ALL",
              "a map of more than 255 values raises INVALID_VALUE",
              before(kMap1, kIsLegal&& kOrder* kComponents > 255, set(kOrder, 0)));

EVALCTS_FAULT(OddOrdersOfNormalsRoundedUp, production, must, "EV-MAP1-ORDER-ALL",
              "Map1d keeps NORMAL maps of odd orders above 8 with the order above") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    const Map1Call<GLdouble> call{target, u1, u2, stride, order, points};
    if (!legal(call) || target != GL_MAP1_NORMAL || order < 9 || order % 2 == 0)
      return sound.Map1d(target, u1, u2, stride, order, points);
    std::vector<GLdouble> more = packed(call);
    more.resize(more.size() + 3);
    sound.Map1d(target, u1, u2, 3, order + 1, more.data());
  };
}

EVALCTS_RULES(NormalHasFourValues, production, must, "EV-MAP1-K EV-MAP1-STRIDE-MIN",
              "the stride of MAP1_NORMAL has to be 4 at least",
              before(kMap1, kTarget == GL_MAP1_NORMAL && kStride == 3, set(kStride, 0)));

EVALCTS_FAULT(Texture3AnsweredAsFour, production, must, "EV-MAP1-K",
              "COEFF of MAP1_TEXTURE_COORD_3 answers one value too many") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    sound.GetMapfv(target, query, v);
    if (target != GL_MAP1_TEXTURE_COORD_3 || query != GL_COEFF) return;
    v[coefficients(target).size()] = 1;
  };
}

EVALCTS_RULES(StrideInOneByte, production, must, "EV-MAP1-STRIDE",
              "the stride is kept in a byte: 257 becomes 1",
              before(kMap1, kIsLegal&& kStride % 256 >= kComponents, set(kStride, kStride % 256)));
EVALCTS_RULES(StrideInSixteenBits, production, must, "EV-MAP1-STRIDE",
              "the stride is kept in 16 bits: 65536 + k becomes k",
              before(kMap1, kIsLegal&& kStride % 65536 >= kComponents, set(kStride, kStride % 65536)));
EVALCTS_RULES(DoubleStrideInFloats, production, must, "EV-MAP1-STRIDE",
              "Map1d with an even stride of 2k or more takes it as counted in floats",
              before(Map1d, kStride % 2 == 0 && kStride / 2 >= kComponents, set(kStride, kStride / 2)));

EVALCTS_FAULT(NanInPaddingRefused, production, must, "EV-MAP1-PADDING",
              "Map1 raises INVALID_VALUE for a NaN anywhere in the array") {
  map1(in, [](auto call, auto go) {
    if (legal(call))
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(call.order) * call.stride; ++i)
        if (std::isnan(call.points[i])) call.order = 0;
    go(call);
  });
}

EVALCTS_FAULT(PaddingTimesZero, production, must, "EV-MAP1-PADDING",
              "the value behind a point of three is loaded with it, and added with weight zero") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (!legal(call) || gl::components_of(call.target) != 3 || call.stride < 4) return go(call);
    auto points = packed(call);
    for (std::ptrdiff_t i = 0; i + 1 < call.order; ++i)
      points[static_cast<std::size_t>(3 * i)] += Real(0) * call.points[i * call.stride + 3];
    go(with_points(call, points));
  });
}

EVALCTS_RULES(TightTexture1Refused, production, must, "EV-MAP1-STRIDE-MIN",
              "MAP1_TEXTURE_COORD_1 with stride 1 raises INVALID_VALUE above order 1",
              before(kMap1, kTarget == GL_MAP1_TEXTURE_COORD_1 && kStride == 1 && kOrder > 1,
                     set(kStride, 0)));

// What a deferred definition keeps of its call. Fresh whenever memory is.
struct Deferred {
  GLenum target = 0;
  GLdouble u1 = 0, u2 = 0;
  GLint stride = 0, order = 0;
  const GLdouble* points = nullptr;
  std::vector<GLdouble> copy;
};
Deferred deferred;

void define_deferred() {
  if (!memory.flag) return;
  memory.flag = false;
  sound.Map1d(deferred.target, deferred.u1, deferred.u2, deferred.stride, deferred.order, deferred.points);
}

EVALCTS_FAULT(SinglePointReadLate, production, must, "EV-MAP1-COPY",
              "Map1d of order 1 keeps the pointer until the map is queried or a primitive begins") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order, points);
    memory.flag = order == 1 && legal(Map1Call<GLdouble>{target, u1, u2, stride, order, points});
    if (memory.flag) deferred = {target, u1, u2, stride, order, points, {}};
  };
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    define_deferred();
    go(target, query, v);
  });
  in.gl.Begin = [](GLenum mode) {
    define_deferred();
    sound.Begin(mode);
  };
}

EVALCTS_FAULT(PackedPointsNotCopied, production, must, "EV-MAP1-COPY",
              "Map1d keeps the pointer to points that need no packing") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order, points);
    memory.flag = stride == gl::components_of(target) &&
                  legal(Map1Call<GLdouble>{target, u1, u2, stride, order, points});
    if (memory.flag) deferred = {target, u1, u2, stride, order, points, {}};
  };
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    define_deferred();
    go(target, query, v);
  });
}

EVALCTS_FAULT(DomainKeptAtEqualOrder, production, must, "EV-MAP1-REPLACE",
              "Map1 of the order that the map has leaves the domain as it was") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (!legal(call)) return go(call);
    const auto place = static_cast<std::size_t>(2 * (call.target - GL_MAP1_COLOR_4));
    memory.numbers.resize(18);
    if (memory.counts[call.target] == call.order) {
      call.u1 = static_cast<Real>(memory.numbers[place]);
      call.u2 = static_cast<Real>(memory.numbers[place + 1]);
    }
    memory.counts[call.target] = call.order;
    memory.numbers[place] = static_cast<double>(call.u1);
    memory.numbers[place + 1] = static_cast<double>(call.u2);
    go(call);
  });
}

EVALCTS_FAULT(SamePointerNotReadAgain, production, must, "EV-MAP1-REPLACE EV-MAP1-LIVE",
              "Map1 of the same target, order and pointer as the last one reads no points") {
  map1(in, [](auto call, auto go) {
    if (!legal(call)) return go(call);
    static const void* pointer = nullptr;
    const bool same = !memory.numbers.empty() && pointer == call.points && memory.counts[0] == call.target &&
                      memory.counts[1] == call.order;
    if (!same) {
      const auto points = packed(call);
      memory.numbers.assign(points.begin(), points.end());
    }
    pointer = call.points;
    memory.counts[0] = call.target;
    memory.counts[1] = call.order;
    std::vector<typename decltype(call)::Value> points;
    for (const double value : memory.numbers)
      points.push_back(static_cast<typename decltype(call)::Value>(value));
    go(with_points(call, points));
  });
}

EVALCTS_RULES(OrderNeverShrinks, production, must, "EV-MAP1-REPLACE",
              "GetMapiv answers the largest order that MAP1_INDEX ever had",
              before(kMap1, kIsLegal&& kTarget == GL_MAP1_INDEX, set(kCount, max(kCount, kOrder))),
              after(GetMapiv, kTarget == GL_MAP1_INDEX && kQuery == GL_ORDER && kCount, put(0, kCount)));

EVALCTS_FAULT(TextureMapsShareDomain, production, must, "EV-MAP1-INDEP",
              "MAP1_TEXTURE_COORD_1 takes over the domain of every other texture map") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.target <= GL_MAP1_TEXTURE_COORD_1 || call.target > GL_MAP1_TEXTURE_COORD_4)
      return;
    const std::vector<GLdouble> points = coefficients(GL_MAP1_TEXTURE_COORD_1);
    sound.Map1d(GL_MAP1_TEXTURE_COORD_1, static_cast<double>(call.u1), static_cast<double>(call.u2), 1,
                static_cast<GLint>(points.size()), points.data());
  });
}

EVALCTS_FAULT(VertexMapsShareStorage, production, must, "EV-MAP1-INDEP",
              "Map1 of VERTEX_4 overwrites the first value of VERTEX_3") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.target != GL_MAP1_VERTEX_4) return;
    std::vector<GLdouble> points = coefficients(GL_MAP1_VERTEX_3);
    GLdouble domain[2];
    sound.GetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, domain);
    points[0] = static_cast<GLdouble>(call.points[0]);
    sound.Map1d(GL_MAP1_VERTEX_3, domain[0], domain[1], 3, static_cast<GLint>(points.size() / 3),
                points.data());
  });
}

EVALCTS_FAULT(FlatMap2IsMap1, production, must, "EV-MAP1-VS-MAP2/2-D",
              "a Map2 of vorder 1 defines the one-dimensional namesake as well") {
  map2(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.vorder != 1) return;
    const auto points = packed(call);
    const std::vector<GLdouble> real(points.begin(), points.end());
    sound.Map1d(call.target - GL_MAP2_COLOR_4 + GL_MAP1_COLOR_4, static_cast<double>(call.u1),
                static_cast<double>(call.u2), gl::components_of(call.target), call.uorder, real.data());
  });
}

EVALCTS_FAULT(Map1SetsConstantNamesake, production, must, "EV-MAP1-VS-MAP2/1-D",
              "a Map1 of order 1 sets the point of the two-dimensional namesake, if that is constant") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.order != 1) return;
    const GLenum namesake = call.target - GL_MAP1_COLOR_4 + GL_MAP2_COLOR_4;
    const GLint k = gl::components_of(call.target);
    if (coefficients(namesake).size() != static_cast<std::size_t>(k)) return;
    const auto points = packed(call);
    const std::vector<GLdouble> real(points.begin(), points.end());
    sound.Map2d(namesake, 0, 1, k, 1, 0, 1, k, 1, real.data());
  });
}

EVALCTS_RULES(ConstantMapSwitchesOff, production, must, "EV-MAP1-NOENABLE",
              "Map1f of order 1 disables the map",
              after(Map1f, kOrder == 1 && is_map1(kTarget), call(Disable, {kTarget})));
EVALCTS_RULES(Vertex4SwitchesVertex3Off, production, must, "EV-MAP1-NOENABLE",
              "Map1 of VERTEX_4 disables VERTEX_3",
              after(kMap1, kIsLegal&& kTarget == GL_MAP1_VERTEX_4, call(Disable, {GL_MAP1_VERTEX_3})));

EVALCTS_FAULT(RedefinitionWaitsForNextPrimitive, production, must, "EV-MAP1-LIVE",
              "Map1 of the order that the map has is first evaluated by the primitive after the next") {
  map1(in, [](auto call, auto go) {
    define_deferred();
    if (!legal(call) || memory.counts[call.target] != call.order) {
      if (legal(call)) memory.counts[call.target] = call.order;
      return go(call);
    }
    const auto points = packed(call);
    deferred = {call.target,
                static_cast<double>(call.u1),
                static_cast<double>(call.u2),
                gl::components_of(call.target),
                call.order,
                nullptr,
                {points.begin(), points.end()}};
    deferred.points = deferred.copy.data();
    memory.flag = true;
  });
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    define_deferred();
    go(target, query, v);
  });
  in.gl.End = [] {
    sound.End();
    define_deferred();
  };
}

// ---- State of the pixel path and of buffers, which only a whole GL has

EVALCTS_FAULT(PointsSwappedLikePixels, osmesa, must, "EV-MAP1-NOPIXELSTORE",
              "UNPACK_SWAP_BYTES swaps the bytes of control points") {
  in.gl.PixelStorei = [](GLenum pname, GLint value) {
    if (pname == GL_UNPACK_SWAP_BYTES) memory.flag = value != 0;
    sound.PixelStorei(pname, value);
  };
  map1(in, [](auto call, auto go) {
    if (!legal(call) || !memory.flag) return go(call);
    auto points = packed(call);
    for (auto& value : points) {
      auto* bytes = reinterpret_cast<unsigned char*>(&value);
      std::reverse(bytes, bytes + sizeof value);
    }
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(PixelsSkippedBeforePoints, osmesa, must, "EV-MAP1-NOPIXELSTORE",
              "Map1d skips UNPACK_SKIP_PIXELS values before the first point") {
  in.gl.PixelStorei = [](GLenum pname, GLint value) {
    if (pname == GL_UNPACK_SKIP_PIXELS) memory.count = value;
    sound.PixelStorei(pname, value);
  };
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    const Map1Call<GLdouble> call{target, u1, u2, stride, order, points};
    if (!legal(call) || !memory.count) return sound.Map1d(target, u1, u2, stride, order, points);
    std::vector<GLdouble> shifted = packed(call);
    std::rotate(shifted.begin(), shifted.begin() + memory.count % static_cast<std::ptrdiff_t>(shifted.size()),
                shifted.end());
    sound.Map1d(target, u1, u2, gl::components_of(target), order, shifted.data());
  };
}

EVALCTS_FAULT(FloatStrideAligned, osmesa, must, "EV-MAP1-NOPIXELSTORE",
              "UNPACK_ALIGNMENT 8 rounds the stride of Map1f up to an even number") {
  in.gl.PixelStorei = [](GLenum pname, GLint value) {
    if (pname == GL_UNPACK_ALIGNMENT) memory.flag = value == 8;
    sound.PixelStorei(pname, value);
  };
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    const Map1Call<GLfloat> call{target, u1, u2, stride, order, points};
    if (!legal(call) || !memory.flag || stride % 2 == 0 || order < 2)
      return sound.Map1f(target, u1, u2, stride, order, points);
    std::vector<GLfloat> moved = packed(call);
    for (std::size_t i = static_cast<std::size_t>(gl::components_of(target)); i + 1 < moved.size(); ++i)
      moved[i] = moved[i + 1];
    sound.Map1f(target, u1, u2, gl::components_of(target), order, moved.data());
  };
}

EVALCTS_FAULT(PointsFromArrayBuffer, osmesa, must, "EV-MAP1-NOBUFFER",
              "with an ARRAY_BUFFER bound Map1 reads control points of zero from it") {
  in.gl.BindBuffer = [](GLenum target, GLuint buffer) {
    if (target == GL_ARRAY_BUFFER) memory.flag = buffer != 0;
    sound.BindBuffer(target, buffer);
  };
  map1(in, [](auto call, auto go) {
    if (!legal(call) || !memory.flag) return go(call);
    auto points = packed(call);
    std::ranges::fill(points, 0);
    go(with_points(call, points));
  });
}

EVALCTS_RULES(UnpackBufferRefusesMap1d, osmesa, must, "EV-MAP1-NOBUFFER",
              "with a PIXEL_UNPACK_BUFFER bound Map1d does nothing but raise INVALID_OPERATION",
              instead(Map1d, has_buffer(GL_PIXEL_UNPACK_BUFFER), error(GL_INVALID_OPERATION)));

// ---- What only a certain past shows

EVALCTS_FAULT(SamePointsOtherDomainIgnored, production, must, "EV-MAP1-REPLACE EV-MAP1-LIVE",
              "Map1 with the points that the map has is taken for the same definition, whatever its domain") {
  map1(in, [](auto call, auto go) {
    if (!legal(call)) return go(call);
    const auto points = packed(call);
    const std::vector<double> real(points.begin(), points.end());
    if (memory.number == call.target && real == memory.numbers) return;
    memory.number = call.target;
    memory.numbers = real;
    go(call);
  });
}

EVALCTS_FAULT(LongMapsShareOverflow, production, must, "EV-MAP1-INDEP",
              "maps of more than 32 points share the place of what is beyond") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.order <= 32) return;
    const auto other = static_cast<GLenum>(memory.number);
    memory.number = call.target;
    if (other == 0 || other == call.target) return;
    std::vector<GLdouble> points = coefficients(other);
    GLdouble domain[2];
    sound.GetMapdv(other, GL_DOMAIN, domain);
    const GLint k = gl::components_of(other), order = static_cast<GLint>(points.size()) / k;
    if (order <= 32) return;
    points.back() = static_cast<GLdouble>(call.points[(call.order - 1) * call.stride]);
    sound.Map1d(other, domain[0], domain[1], k, order, points.data());
  });
}

EVALCTS_RULES(FirstDefinitionDisables, production, must, "EV-MAP1-NOENABLE",
              "the first Map1 of NORMAL disables it, as it begins a new object",
              after(kMap1, kIsLegal&& kTarget == GL_MAP1_NORMAL && !kFlag,
                    sequence({set(kFlag, 1), call(Disable, {GL_MAP1_NORMAL})})));

EVALCTS_FAULT(DomainQueryCached, production, must, "EV-MAP1-REPLACE",
              "GetMapfv answers the domain that it answered first") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    sound.GetMapfv(target, query, v);
    if (query != GL_DOMAIN || !is_map1(target)) return;
    const auto place = static_cast<std::size_t>(2 * (target - GL_MAP1_COLOR_4));
    memory.numbers.resize(18);
    if (memory.counts[target]++ == 0) {
      memory.numbers[place] = v[0];
      memory.numbers[place + 1] = v[1];
    }
    v[0] = static_cast<GLfloat>(memory.numbers[place]);
    v[1] = static_cast<GLfloat>(memory.numbers[place + 1]);
  };
}

EVALCTS_FAULT(ShorterMapKeepsOldValue, production, must, "EV-MAP1-REPLACE",
              "the last value of a map of order 2 that comes after a longer one is left from before") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (!legal(call)) return go(call);
    auto points = packed(call);
    const long before = memory.counts[call.target];
    memory.counts[call.target] = call.order;
    if (call.order == 2 && before > 2) points.back() = static_cast<Real>(memory.number);
    memory.number = static_cast<double>(points[static_cast<std::size_t>(gl::components_of(call.target)) - 1]);
    go(with_points(call, points));
  });
}

EVALCTS_RULES(DefinitionWhileDisabledMissed, production, must, "EV-MAP1-LIVE",
              "Map1 of a map that was enabled once and is not now is taken up by queries only",
              before(Enable, true, set(remembered(kName), 1)),
              skip(kMap1, kIsLegal&& remembered(kTarget) && !enabled(kTarget)));

EVALCTS_FAULT(EnabledMapReadLate, production, must, "EV-MAP1-COPY",
              "Map1d of an enabled map keeps the pointer until the next primitive begins") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    sound.Map1d(target, u1, u2, stride, order, points);
    memory.flag = legal(Map1Call<GLdouble>{target, u1, u2, stride, order, points}) && sound.IsEnabled(target);
    if (memory.flag) deferred = {target, u1, u2, stride, order, points, {}};
  };
  in.gl.Begin = [](GLenum mode) {
    define_deferred();
    sound.Begin(mode);
  };
}

EVALCTS_RULES(ReversedClampedAbove, production, must, "EV-MAP1-EXTRAPOLATE",
              "u is clamped to the upper end of a reversed domain",
              before(kMap1, true, sequence({set(kFlag, kU1 > kU2), set(kNumber, kU1)})),
              before(EvalCoord1f, kFlag, set(kU, min(kU, kNumber))));
EVALCTS_RULES(SymmetricDomainTakenForUnit, production, must, "EV-MAP1-DOMAIN",
              "a domain from -a to a is taken for one from 0 to a",
              before(kMap1, kU1 == -kU2 && kU2 > 0, set(kU1, 0)));

}  // namespace
}  // namespace evalcts::faults
