#include "suites/random_commands.h"

#include <array>
#include <tuple>

#include "suites/maps2.h"

namespace evalcts {
namespace {

constexpr GLuint kFirstList = 200, kLists = 4;

class Past {
 public:
  Past(gl::Case& c, std::mt19937& random) : c_(c), random_(random) {}

  void add(int count) {
    for (int i = 0; i < count; ++i) command();
    while (depth_ > 0) pop();
  }

 private:
  // From 0 to count - 1.
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool coin() { return below(2) == 0; }
  // A multiple of 1/16 in [-2,2]. One draw a statement: in which order the arguments of a function are
  // evaluated is up to the compiler.
  double number() { return (below(65) - 32) / 16.0; }
  GLenum target() { return coin() ? gl::kMap1Targets[below9()] : gl::kMap2Targets[below9()]; }
  std::size_t below9() { return static_cast<std::size_t>(below(9)); }

  void command() {
    switch (below(16)) {
      case 0:
      case 1:
        return map1();
      case 2:
      case 3:
        return map2();
      case 4:
        return grid();
      case 5:
      case 6:
        return enable();
      case 7:
        return current_value();
      case 8:
      case 9:
        return primitive(1 + below(6));
      case 10:
        return mesh();
      case 11:
        return refused();
      case 12:
        return query();
      case 13:
        return depth_ < 8 && coin() ? push() : pop();
      case 14:
        return list();
      default:
        return seldom();
    }
  }

  void seldom() {
    switch (below(3)) {
      case 0:
        return primitive(300);  // long enough to make an implementation flush in the middle
      case 1:
        c_.Flush();
        return;
      default:
        c_.ActiveTexture(GL_TEXTURE1);
        current_value();
        c_.ActiveTexture(GL_TEXTURE0);
    }
  }

  std::vector<double> points(std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values) value = number();
    return values;
  }

  // Calls it with so many numbers.
  template <std::size_t kCount, class Call>
  void with_numbers(Call call) {
    std::array<double, kCount> values;
    for (double& value : values) value = number();
    std::apply(call, values);
  }

  void map1() {
    const GLenum target = gl::kMap1Targets[below9()];
    const int k = gl::components_of(target), order = 1 + below(5);
    const double u1 = number(), u2 = u1 + (coin() ? 1 : -2.5);
    const int stride = k + below(3);
    const Map1 map = make_map1(target, u1, u2, stride, points(static_cast<std::size_t>(order * k)));
    define(c_, map, coin());
  }

  void map2() {
    const GLenum target = gl::kMap2Targets[below9()];
    const int uorder = 1 + below(4), vorder = 1 + below(4);
    Map2 map = make_map2(target, uorder, vorder,
                         points(static_cast<std::size_t>(uorder * vorder * gl::components_of(target))));
    map.u1 = number(), map.u2 = map.u1 + 1.5;
    map.v1 = number(), map.v2 = map.v1 - 0.75;
    define(c_, map, coin());
  }

  void grid() {
    const GLint n = 1 + below(9), m = 1 + below(9);
    const double u1 = number(), u2 = number(), v1 = number(), v2 = number();
    switch (below(4)) {
      case 0:
        c_.MapGrid1f(n, u1, u2);
        return;
      case 1:
        c_.MapGrid1d(n, u1, u2);
        return;
      case 2:
        c_.MapGrid2f(n, u1, u2, m, v1, v2);
        return;
      default:
        c_.MapGrid2d(n, u1, u2, m, v1, v2);
    }
  }

  void enable() {
    const GLenum cap = below(12) == 0 ? static_cast<GLenum>(GL_AUTO_NORMAL) : target();
    if (below(3) != 0)
      c_.Enable(cap);
    else
      c_.Disable(cap);
  }

  void current_value() {
    switch (below(8)) {
      case 0:
        return with_numbers<4>([&](auto... v) { c_.Color4f(v...); });
      case 1:
        return with_numbers<3>([&](auto... v) { c_.Color3f(v...); });
      case 2:
        return with_numbers<3>([&](auto... v) { c_.Normal3f(v...); });
      case 3:
        c_.TexCoord1f(number());
        return;
      case 4:
        return with_numbers<2>([&](auto... v) { c_.TexCoord2f(v...); });
      case 5:
        return with_numbers<4>([&](auto... v) { c_.TexCoord4f(v...); });
      case 6:
        return with_numbers<2>([&](auto... v) { c_.MultiTexCoord2f(GL_TEXTURE1, v...); });
      default:
        c_.EdgeFlag(coin());
    }
  }

  void point() {
    switch (below(8)) {
      case 0:
        c_.EvalCoord1f(number());
        return;
      case 1:
        c_.EvalCoord1d(number());
        return;
      case 2:
        return with_numbers<2>([&](auto... v) { c_.EvalCoord2f(v...); });
      case 3:
        c_.EvalCoord2dv(points(2));
        return;
      case 4:
        c_.EvalPoint1(below(12) - 1);
        return;
      case 5: {
        const int i = below(12) - 1;
        c_.EvalPoint2(i, below(12) - 1);
        return;
      }
      case 6:
        return with_numbers<3>([&](auto... v) { c_.Vertex3f(v...); });
      default:
        current_value();
    }
  }

  void primitive(int count) {
    c_.Begin(GL_POINTS);
    for (int i = 0; i < count; ++i) point();
    c_.End();
  }

  void mesh() {
    const GLint first = below(4) - 1, last = first + below(5);
    const GLint first_row = below(3);
    if (coin())
      c_.EvalMesh1(GL_POINT, first, last);
    else
      c_.EvalMesh2(GL_POINT, first, last, first_row, 2 + below(2));
  }

  void refused() {
    switch (below(5)) {
      case 0: {
        Map1 map = make_map1(GL_MAP1_VERTEX_3, points(9));
        map.u2 = map.u1;
        define(c_, map, coin());
        break;
      }
      case 1: {
        Map2 map = make_map2(GL_MAP2_COLOR_4, 2, 2, points(16));
        map.vorder = 0;
        define(c_, map, coin());
        break;
      }
      case 2:
        c_.MapGrid1f(-below(3), 2, 3);
        break;
      case 3:
        c_.EvalMesh1(GL_FILL, 0, 1);
        break;
      default:
        c_.Begin(GL_POINTS);
        map1();
        c_.End();
    }
    c_.GetError();
  }

  void query() {
    switch (below(4)) {
      case 0:
        c_.IsEnabled(target());
        return;
      case 1:
        c_.GetMapfv(gl::kMap1Targets[below9()], GL_COEFF, gl::out<GLfloat>(64));
        return;
      case 2:
        c_.GetMapiv(gl::kMap2Targets[below9()], GL_ORDER, gl::out<GLint>(2));
        return;
      default:
        c_.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    }
  }

  void push() {
    constexpr GLbitfield kMasks[] = {GL_EVAL_BIT, GL_ENABLE_BIT, GL_CURRENT_BIT, 0xFFFFFFFFu,
                                     GL_EVAL_BIT | GL_CURRENT_BIT};
    c_.PushAttrib(kMasks[below(std::size(kMasks))]);
    ++depth_;
  }
  void pop() {
    if (depth_ == 0) return;
    c_.PopAttrib();
    --depth_;
  }

  void list() {
    const GLuint name = kFirstList + static_cast<GLuint>(below(kLists));
    if (below(3) == 0) {
      c_.CallList(name);
      return;
    }
    c_.NewList(name, coin() ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
    for (int i = 1 + below(4); i > 0; --i) {
      switch (below(6)) {
        case 0:
          map1();
          break;
        case 1:
          map2();
          break;
        case 2:
          grid();
          break;
        case 3:
          enable();
          break;
        case 4:
          current_value();
          break;
        default:
          primitive(2);
      }
    }
    c_.EndList();
    if (coin()) c_.CallList(name);
  }

  gl::Case& c_;
  std::mt19937& random_;
  int depth_ = 0;
};

}  // namespace

void add_random_commands(gl::Case& c, std::mt19937& random, int count) { Past(c, random).add(count); }

}  // namespace evalcts
