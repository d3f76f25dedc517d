// Section 4: two-dimensional maps.
#include <cmath>
#include <cstring>

#include "map_calls.h"

namespace evalcts::faults {
namespace {

// The net of a legal call with its directions exchanged: point (j, i) where (i, j) was.
template <class Real>
std::vector<Real> transposed(const Map2Call<Real>& c) {
  const std::vector<Real> net = packed(c);
  const auto k = static_cast<std::size_t>(gl::components_of(c.target));
  const auto rows = static_cast<std::size_t>(c.uorder), columns = static_cast<std::size_t>(c.vorder);
  std::vector<Real> other;
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i) {
      const auto point = net.begin() + static_cast<std::ptrdiff_t>((i * columns + j) * k);
      other.insert(other.end(), point, point + static_cast<std::ptrdiff_t>(k));
    }
  return other;
}

EVALCTS_FAULT(MemoryOrderAssumed, production, must, "EV-MAP2-ADDRESS",
              "of a square net the direction with the smaller stride is taken for v") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.uorder != call.vorder || call.ustride >= call.vstride) return go(call);
    const auto net = transposed(call);
    go(with_points(call, net));
  });
}

EVALCTS_FAULT(RowsTakenAsAdjacent, production, must, "EV-MAP2-ADDRESS EV-MAP2-PADDING",
              "ustride is not looked at while it is larger than a packed row of v") {
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.ustride > call.vorder * call.vstride && call.vorder > 2)
      call.ustride = call.vorder * call.vstride;
    go(call);
  });
}

EVALCTS_FAULT(EqualStridesRefused, production, must, "EV-MAP2-STRIDE-FREE",
              "equal strides of a net of several points each way raise INVALID_VALUE") {
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.ustride == call.vstride && call.uorder > 1 && call.vorder > 1) call.ustride = 0;
    go(call);
  });
}

EVALCTS_FAULT(UStrideHasToBeLarger, production, must, "EV-MAP2-STRIDE-FREE",
              "Map2d raises INVALID_VALUE where vstride is larger than ustride") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride < vstride ? 0 : ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(OverlappingRowsMoved, production, must, "EV-MAP2-STRIDE-FREE",
              "rows that share memory are taken as if they followed each other") {
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.ustride < call.vstride * call.vorder &&
        call.vstride < call.ustride * call.uorder && call.uorder > 1 && call.vorder > 1) {
      // What follows may be out of bounds: repeat the last point instead.
      auto points = packed(call);
      const std::size_t k = static_cast<std::size_t>(gl::components_of(call.target));
      std::copy_n(points.end() - static_cast<std::ptrdiff_t>(k), k,
                  points.begin() + static_cast<std::ptrdiff_t>(k));
      return go(with_points(call, points));
    }
    go(call);
  });
}

EVALCTS_FAULT(VStrideInSixteenBits, production, must, "EV-MAP2-STRIDE-FREE EV-MAP2-ADDRESS",
              "vstride is kept in 16 bits") {
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.vstride % 65536 >= gl::components_of(call.target)) call.vstride %= 65536;
    go(call);
  });
}

EVALCTS_FAULT(PaddingOfNetTimesZero, production, must, "EV-MAP2-PADDING",
              "the value behind each point but the last is added to it with weight zero") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    const GLint k = gl::components_of(call.target);
    if (!legal(call) || call.vstride <= k || call.ustride <= k) return go(call);
    auto points = packed(call);
    std::size_t place = 0;
    for (std::ptrdiff_t i = 0; i < call.uorder; ++i)
      for (std::ptrdiff_t j = 0; j + 1 < call.vorder; ++j)
        points[place = static_cast<std::size_t>((i * call.vorder + j) * k)] +=
            Real(0) * call.points[i * call.ustride + j * call.vstride + k];
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(VStrideOfDoublesInFloats, production, must, "EV-MAP2-STRIDE-UNITS",
              "Map2d counts an even vstride above k in floats") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    const Map2Call<GLdouble> call{target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points};
    if (!legal(call) || vstride % 2 || vstride / 2 < gl::components_of(target))
      return sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride / 2, vorder, points);
  };
}

EVALCTS_FAULT(UStrideInBytesOfFloats, production, must, "EV-MAP2-STRIDE-UNITS EV-MAP2-ADDRESS",
              "Map2d takes an odd ustride beyond the row as if the values were floats") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    const Map2Call<GLdouble> call{target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points};
    if (!legal(call) || ustride % 2 == 0 || ustride < 5)
      return sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    std::vector<GLdouble> net;
    const auto* bytes = reinterpret_cast<const unsigned char*>(points);
    for (std::ptrdiff_t i = 0; i < uorder; ++i)
      for (std::ptrdiff_t j = 0; j < vorder; ++j)
        for (std::ptrdiff_t k = 0; k < gl::components_of(target); ++k) {
          GLdouble value;
          std::memcpy(&value, bytes + 4 * i * ustride + 8 * (j * vstride + k), sizeof value);
          net.push_back(value);
        }
    const Map2Call<GLdouble> packed_call = with_points(call, net);
    sound.Map2d(target, u1, u2, packed_call.ustride, uorder, v1, v2, packed_call.vstride, vorder, net.data());
  };
}

EVALCTS_FAULT(DomainOfTexturesExchanged, production, must, "EV-MAP2-DOMAIN",
              "a texture map takes the interval of u for v as well, where it is as wide") {
  map2(in, [](auto call, auto go) {
    if (is_texture_map2(call.target) && call.u2 - call.u1 == call.v2 - call.v1) {
      call.v1 = call.u1;
      call.v2 = call.u2;
    }
    go(call);
  });
}

EVALCTS_FAULT(BothReversedIsNeither, production, must, "EV-MAP2-REVERSED",
              "two reversed intervals are taken as two rising ones") {
  map2(in, [](auto call, auto go) {
    if (call.u1 > call.u2 && call.v1 > call.v2) {
      std::swap(call.u1, call.u2);
      std::swap(call.v1, call.v2);
    }
    go(call);
  });
}

EVALCTS_FAULT(ReversedVSorted, production, must, "EV-MAP2-REVERSED", "Map2f sorts the ends of v") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, std::min(v1, v2), std::max(v1, v2), vstride, vorder, points);
  };
}

EVALCTS_FAULT(VClampedBeyondCorners, production, must, "EV-MAP2-EXTRAPOLATE",
              "where u and v are both outside, v is clamped to its interval") {
  map2(in, [](auto call, auto go) {
    if (call.target >= GL_MAP2_VERTEX_3)
      memory.numbers = {
          static_cast<double>(std::min(call.u1, call.u2)), static_cast<double>(std::max(call.u1, call.u2)),
          static_cast<double>(std::min(call.v1, call.v2)), static_cast<double>(std::max(call.v1, call.v2))};
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    const std::vector<double>& d = memory.numbers;
    const bool u_outside = !d.empty() && (static_cast<double>(u) < d[0] || static_cast<double>(u) > d[1]);
    if (u_outside) v = static_cast<decltype(v)>(std::clamp(static_cast<double>(v), d[2], d[3]));
    go(u, v);
  });
}

EVALCTS_FAULT(UClampedFromBelow, production, must, "EV-MAP2-EXTRAPOLATE",
              "EvalCoord2d takes a negative u over a unit interval as 0") {
  map2(in, [](auto call, auto go) {
    memory.flag = call.u1 == 0 && call.u2 == 1;
    go(call);
  });
  in.gl.EvalCoord2d = [](GLdouble u, GLdouble v) {
    sound.EvalCoord2d(memory.flag ? std::max(u, 0.0) : u, v);
  };
}

EVALCTS_FAULT(TallNetsLoseLastRow, production, must, "EV-MAP2-ASYM",
              "the last row of a net with uorder three times vorder or more is that before it") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.uorder < 3 * call.vorder) return go(call);
    auto points = packed(call);
    const auto row = static_cast<std::ptrdiff_t>(call.vorder * gl::components_of(call.target));
    std::copy(points.end() - 2 * row, points.end() - row, points.end() - row);
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(WideNetsTransposed, production, must, "EV-MAP2-ASYM",
              "a net with uorder below vorder is read with the row length of u") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.uorder >= call.vorder) return go(call);
    const auto net = transposed(call);
    go(with_points(call, net));
  });
}

EVALCTS_FAULT(OrderOneInVTakesNoPadding, production, must, "EV-MAP2-ORDER-ONE",
              "of a map of vorder 1 and uorder above 2 the second point is left out") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.vorder != 1 || call.uorder < 3) return go(call);
    auto points = packed(call);
    const auto k = static_cast<std::ptrdiff_t>(gl::components_of(call.target));
    std::copy(points.begin(), points.begin() + k, points.begin() + k);
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(LargestNetRefused, production, must, "EV-MAP2-ORDER-ALL",
              "a net of 4096 points raises INVALID_VALUE") {
  map2(in, [](auto call, auto go) {
    if (legal(call) && call.uorder * call.vorder > 4095) call.uorder = 0;
    go(call);
  });
}

EVALCTS_FAULT(LongRowsOfNormalsRefused, production, must, "EV-MAP2-ORDER-ALL",
              "Map2d takes no NORMAL net of one row and the largest vorder") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    const bool refused = target == GL_MAP2_NORMAL && uorder == 1 && vorder == kMaxOrder;
    sound.Map2d(target, u1, u2, ustride, refused ? 0 : uorder, v1, v2, vstride, vorder, points);
  };
}

EVALCTS_FAULT(Normal2HasFourValuesInV, production, must, "EV-MAP2-K",
              "the vstride of MAP2_NORMAL has to be 4 at least") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_NORMAL && call.vstride == 3) call.vstride = 0;
    go(call);
  });
}

EVALCTS_FAULT(Color2TakesThreeInU, production, must, "EV-MAP2-K EV-MAP2-ERR-USTRIDE",
              "Map2 of COLOR_4 is content with a ustride of 3") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_COLOR_4 && call.ustride == 3) call.ustride = 4;
    go(call);
  });
}

EVALCTS_FAULT(IndexAnsweredAsTexture2, production, must, "EV-MAP2-K",
              "COEFF of MAP2_INDEX answers two values a point") {
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    go(target, query, v);
    if (target != GL_MAP2_INDEX || query != GL_COEFF) return;
    const std::size_t count = coefficients(target).size();
    for (std::size_t i = 0; i < count; ++i) v[count + i] = 0;
  });
}

// The last definition of a large net, to be read again. Fresh whenever memory is.
Map2Call<GLfloat> unread{};

EVALCTS_FAULT(LargeNetReadLate, production, must, "EV-MAP2-COPY",
              "Map2f keeps the pointer to a net of more than 1000 points until it is queried") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    unread = {target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points};
    memory.flag = legal(unread) && uorder * vorder > 1000;
  };
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    if (memory.flag) {
      const auto& c = unread;
      memory.flag = false;
      sound.Map2f(c.target, c.u1, c.u2, c.ustride, c.uorder, c.v1, c.v2, c.vstride, c.vorder, c.points);
    }
    go(target, query, v);
  });
}

EVALCTS_FAULT(PackedNetReadWhenDrawn, production, must, "EV-MAP2-COPY",
              "Map2f keeps the pointer to a packed net until the next primitive begins") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    unread = {target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points};
    const GLint k = gl::components_of(target);
    memory.flag = legal(unread) && vstride == k && ustride == k * vorder;
  };
  in.gl.Begin = [](GLenum mode) {
    if (memory.flag) {
      const auto& c = unread;
      memory.flag = false;
      sound.Map2f(c.target, c.u1, c.u2, c.ustride, c.uorder, c.v1, c.v2, c.vstride, c.vorder, c.points);
    }
    sound.Begin(mode);
  };
}

EVALCTS_FAULT(VDomainKeptAtEqualOrders, production, must, "EV-MAP2-REPLACE",
              "Map2 of the orders that the map has leaves the interval of v") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (!legal(call)) return go(call);
    const auto place = static_cast<std::size_t>(2 * (call.target - GL_MAP2_COLOR_4));
    const long orders = 100 * call.uorder + call.vorder;
    memory.numbers.resize(18);
    if (memory.counts[call.target] == orders) {
      call.v1 = static_cast<Real>(memory.numbers[place]);
      call.v2 = static_cast<Real>(memory.numbers[place + 1]);
    }
    memory.counts[call.target] = orders;
    memory.numbers[place] = static_cast<double>(call.v1);
    memory.numbers[place + 1] = static_cast<double>(call.v2);
    go(call);
  });
}

EVALCTS_FAULT(OldRowBehindSmallerNet, production, must, "EV-MAP2-REPLACE",
              "a net smaller than that before it keeps the last value of the old one at its place") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (!legal(call)) return go(call);
    auto points = packed(call);
    const auto size = static_cast<long>(points.size());
    memory.numbers.resize(9);
    double& last = memory.numbers[call.target - GL_MAP2_COLOR_4];
    const double old = last;
    last = static_cast<double>(points.back());
    if (memory.counts[call.target] > size) points.back() = static_cast<Real>(old);
    memory.counts[call.target] = size;
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(Map2EnablesFirstDefinition, production, must, "EV-MAP2-NOENABLE",
              "the first Map2d of INDEX enables it") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    if (target == GL_MAP2_INDEX && memory.count++ == 0) sound.Enable(target);
  };
}

EVALCTS_FAULT(FlatVertexNetSwitchesAutoNormalOff, production, must, "EV-MAP2-NOENABLE",
              "Map2 of a vertex net without slope disables AUTO_NORMAL") {
  map2(in, [](auto call, auto go) {
    go(call);
    if (legal(call) && call.target >= GL_MAP2_VERTEX_3 && call.uorder == 1 && call.vorder == 1)
      sound.Disable(GL_AUTO_NORMAL);
  });
}

// ---- What only a certain past shows

EVALCTS_FAULT(SameArrayOtherShapeIgnored, production, must, "EV-MAP2-REPLACE",
              "Map2 with the values that the map has is taken for the same definition, whatever its orders") {
  map2(in, [](auto call, auto go) {
    if (!legal(call)) return go(call);
    const auto points = packed(call);
    const std::vector<double> real(points.begin(), points.end());
    if (memory.number == call.target && real == memory.numbers) return;
    memory.number = call.target;
    memory.numbers = real;
    go(call);
  });
}

EVALCTS_FAULT(LargeNetsShareOverflow, production, must, "EV-MAP2-REPLACE",
              "nets of more than 100 points share the place of their last value") {
  map2(in, [](auto call, auto go) {
    go(call);
    if (!legal(call) || call.uorder * call.vorder <= 100) return;
    const auto other = static_cast<GLenum>(memory.number);
    memory.number = call.target;
    if (other == 0 || other == call.target) return;
    std::vector<GLdouble> points = coefficients(other);
    GLdouble d[4];
    GLint order[2];
    sound.GetMapdv(other, GL_DOMAIN, d);
    sound.GetMapiv(other, GL_ORDER, order);
    if (order[0] * order[1] <= 100) return;
    points.back() = static_cast<GLdouble>(call.points[0]);
    const GLint k = gl::components_of(other);
    sound.Map2d(other, d[0], d[1], k * order[1], order[0], d[2], d[3], k, order[1], points.data());
  });
}

EVALCTS_FAULT(FirstNetDisables, production, must, "EV-MAP2-NOENABLE",
              "the first Map2 of a texture map disables it") {
  map2(in, [](auto call, auto go) {
    go(call);
    if (legal(call) && is_texture_map2(call.target) && memory.counts[call.target]++ == 0)
      sound.Disable(call.target);
  });
}

EVALCTS_FAULT(OrderQueryCached, production, must, "EV-MAP2-REPLACE",
              "GetMapiv answers the vorder that it answered last for the uorder") {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (query != GL_ORDER || !is_map2(target)) return;
    long& cached = memory.counts[target * 100 + static_cast<GLenum>(v[0])];
    if (cached == 0) cached = v[1];
    v[1] = static_cast<GLint>(cached);
  };
}

EVALCTS_FAULT(EqualFirstRowsTakenForAll, production, must, "EV-MAP2-BEZIER",
              "a net whose first two rows are equal is taken for constant in u") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.uorder < 3) return go(call);
    auto points = packed(call);
    const auto row = static_cast<std::ptrdiff_t>(call.vorder * gl::components_of(call.target));
    if (std::equal(points.begin(), points.begin() + row, points.begin() + row))
      for (std::ptrdiff_t i = 2; i < call.uorder; ++i)
        std::copy(points.begin(), points.begin() + row, points.begin() + i * row);
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(EqualFirstColumnsTakenForAll, production, must, "EV-MAP2-BEZIER",
              "a net whose first two columns are equal is taken for constant in v") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.vorder < 3) return go(call);
    auto points = packed(call);
    const auto k = static_cast<std::ptrdiff_t>(gl::components_of(call.target));
    const std::ptrdiff_t row = call.vorder * k;
    bool equal = true;
    for (std::ptrdiff_t i = 0; i < call.uorder; ++i) {
      const auto first = points.begin() + i * row;
      equal = equal && std::equal(first, first + k, first + k);
    }
    for (std::ptrdiff_t i = 0; equal && i < call.uorder; ++i)
      for (std::ptrdiff_t j = 2; j < call.vorder; ++j)
        std::copy_n(points.begin() + i * row, k, points.begin() + i * row + j * k);
    go(with_points(call, points));
  });
}

EVALCTS_FAULT(SecondColumnWeighsLess, production, must, "EV-MAP2-SEPARABLE",
              "the second weight of v is a hundredth too small, and so the weights do not add up to 1") {
  map2(in, [](auto call, auto go) {
    if (!legal(call) || call.vorder < 3) return go(call);
    auto points = packed(call);
    const auto k = static_cast<std::size_t>(gl::components_of(call.target));
    const auto row = static_cast<std::size_t>(call.vorder) * k;
    for (std::size_t i = 0; i < points.size(); i += row)
      for (std::size_t c = 0; c < k; ++c) points[i + k + c] -= points[i + k + c] / 100;
    go(with_points(call, points));
  });
}

}  // namespace
}  // namespace evalcts::faults
