// Writes random programs. Each has a random selection of the kinds of commands, so that the bug that shows
// most easily does not hide all others.
#include <evalcts/fuzz/random_program.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include <evalcts/gl/tokens.h>
#include "legal.h"

namespace evalcts::fuzz {
namespace {

constexpr GLuint kFirstList = 100;
constexpr int kLists = 6, kMostDepth = 6;

enum class Kind { kPoints, kLines, kPolygons };

// The kinds of commands in a program. Most programs do not have all of them, because otherwise the bug that
// shows most easily would hide the others.
struct Parts {
  bool curves = true, surfaces = true;
  bool vertices_always = false;  // vertex maps stay enabled
  bool grids_first = false;      // no mesh over an initial grid
  bool given_vertices = true, current_values = true, automatic_normals = true, disabling = true;
  bool meshes = true, lists = true, stack = true, errors = true, queries = true, other_unit = true;
  bool errors_in_lists = false;  // if true, GetError follows each CallList
  bool risky = true;  // commands that crash some libraries: lists that call lists, rejected queries of maps
};

bool makes_vertices(GLenum map) {
  return map == GL_MAP1_VERTEX_3 || map == GL_MAP1_VERTEX_4 || map == GL_MAP2_VERTEX_3 ||
         map == GL_MAP2_VERTEX_4;
}

// A source of random numbers. It does not use the distributions of the standard library, which differ from
// machine to machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  // Returns a number from 0 to count - 1.
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  bool one_in(int count) { return below(count) == 0; }
  template <class Range>
  auto pick(const Range& range) {
    return std::begin(range)[below(static_cast<int>(std::size(range)))];
  }

 private:
  std::mt19937_64 random_;
};

class ProgramWriter {
 public:
  ProgramWriter(gl::Case& c, Dice& dice, int max_eval_order, bool past)
      : c_(c), dice_(dice), max_order_(max_eval_order) {
    const int kind = dice_.below(8);
    kind_ = past || kind > 1 ? Kind::kPoints : kind == 0 ? Kind::kLines : Kind::kPolygons;
    hostile_ = dice_.one_in(4);
    choose_parts();
    if (past) has_.risky = has_.errors_in_lists = false;
  }

  void write(int length) {
    for (int i = 2 + dice_.below(3); i > 0; --i) supply();
    if (has_.vertices_always) {
      if (has_.curves) supply(1);
      if (has_.surfaces) supply(2);
    }
    if (!dice_.one_in(4)) grid();
    if (has_.grids_first) {
      if (has_.curves) c_.MapGrid1d(4, 0, 1);
      if (has_.surfaces) c_.MapGrid2d(4, 0, 1, 2, 0, 1);
    }
    while (static_cast<int>(c_.commands().size()) < length) command();
    while (depth_ > 0) pop();
  }

 private:
  void choose_parts() {
    const int dimensions = dice_.below(4);
    has_.curves = dimensions != 1 && kind_ != Kind::kPolygons;
    has_.surfaces = dimensions != 0 || kind_ == Kind::kPolygons;
    has_.vertices_always = dice_.one_in(2);
    has_.grids_first = !dice_.one_in(3);
    has_.automatic_normals = dice_.one_in(2);
    has_.errors_in_lists = dice_.one_in(6);
    for (bool* part : {&has_.given_vertices, &has_.current_values, &has_.disabling, &has_.meshes, &has_.lists,
                       &has_.stack, &has_.errors, &has_.queries, &has_.other_unit})
      *part = !dice_.one_in(3);
  }

  // --- numbers: doubles that are floats. Each statement draws only one number, because the order of
  // evaluation of function arguments depends on the compiler.

  double simple() { return (dice_.below(65) - 32) / 16.0; }
  double number() {
    if (!hostile_ || !dice_.one_in(3)) return simple();
    switch (dice_.below(4)) {
      case 0:
        return 0;
      case 1:  // a full significand
        return std::ldexp(dice_.below(1 << 24) - (1 << 23), -23);
      case 2: {
        const double significand = simple();
        return std::ldexp(significand, dice_.below(60) - 30);
      }
      default:
        return dice_.one_in(2) ? 1 : -1;
    }
  }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values) value = number();
    return values;
  }
  // Call `call` with kCount numbers, or with two arguments of evaluation.
  template <std::size_t kCount, class Call>
  void with_numbers(Call call) {
    std::array<double, kCount> values;
    for (double& value : values) value = number();
    std::apply(call, values);
  }
  template <class Call>
  void with_arguments(Call call) {
    const double u = argument(), v = argument();
    call(u, v);
  }
  template <class Real>
  static std::vector<Real> as(const std::vector<double>& values) {
    return {values.begin(), values.end()};
  }

  // Returns two ends that differ as floats.
  std::pair<double, double> domain() {
    constexpr std::pair<double, double> kUsual[] = {{0, 1}, {0, 1}, {1, 0}, {-1, 1}, {0, 4}, {0.25, 0.75}};
    constexpr std::pair<double, double> kAwkward[] = {{1000, 1001},      {3, -5},          {0, 0x1p-10},
                                                      {-0x1p20, 0x1p20}, {1, 1 + 0x1p-12}, {-7, -6.5}};
    return hostile_ && dice_.one_in(3) ? dice_.pick(kAwkward) : dice_.pick(kUsual);
  }
  // Returns an argument, which is mostly inside the usual domains.
  double argument() {
    constexpr double kEnds[] = {0, 1, 0.5, 0.25, 0.75, -1, 4, 1000, 1000.5};
    return dice_.one_in(2) ? dice_.pick(kEnds) : dice_.below(257) / 256.0;
  }

  bool in_surfaces() { return has_.surfaces && (!has_.curves || dice_.one_in(2)); }
  GLenum map1_target() { return dice_.one_in(3) ? vertex_target(1) : dice_.pick(gl::kMap1Targets); }
  GLenum map2_target() { return dice_.one_in(3) ? vertex_target(2) : dice_.pick(gl::kMap2Targets); }
  GLenum vertex_target(int dimension) {
    const bool four = dice_.one_in(2);
    if (dimension == 1) return four ? GL_MAP1_VERTEX_4 : GL_MAP1_VERTEX_3;
    return four ? GL_MAP2_VERTEX_4 : GL_MAP2_VERTEX_3;
  }
  int order() { return dice_.one_in(40) ? max_order_ : 1 + dice_.below(dice_.one_in(6) ? 9 : 5); }

  // --- commands

  // Defines maps that make the effects of later commands visible.
  void supply() { supply(in_surfaces() ? 2 : 1); }
  void supply(int dimension) {
    const GLenum target = vertex_target(dimension);
    if (dimension == 1)
      map1(target);
    else
      map2(target);
    c_.Enable(target);
  }

  void command() {
    constexpr int kWeights[] = {8, 7, 5, 10, 8, 24, 9, 5, 5, 6, 5, 4, 2};
    int at = dice_.below(98), what = 0;
    while (at >= kWeights[what]) at -= kWeights[what++];
    switch (what) {
      case 0:
      case 1:
        return map();
      case 2:
        return grid();
      case 3:
        return enable();
      case 4:
        if (has_.current_values) current_value();
        return;
      case 5:
        return primitive();
      case 6:
        if (has_.meshes) mesh();
        return;
      case 7:
        if (has_.errors) add_rejected();
        return;
      case 8:
        if (has_.queries) query();
        return;
      case 9:
        if (has_.stack) dice_.one_in(2) && depth_ < kMostDepth ? push() : pop();
        return;
      case 10:
        if (has_.lists) list();
        return;
      case 11:
        if (has_.lists) call();
        return;
      default:
        if (has_.other_unit) other_unit();
    }
  }

  void map() {
    if (in_surfaces())
      map2(map2_target());
    else
      map1(map1_target());
  }

  void map1(GLenum target) {
    const int k = gl::components_of(target), n = order(), stride = k + (dice_.one_in(4) ? dice_.below(4) : 0);
    const auto [u1, u2] = domain();
    const std::vector<double> points = numbers(static_cast<std::size_t>((n - 1) * stride + k));
    if (dice_.one_in(2))
      c_.Map1f(target, u1, u2, stride, n, as<GLfloat>(points));
    else
      c_.Map1d(target, u1, u2, stride, n, points);
  }

  void map2(GLenum target) {
    const int k = gl::components_of(target), uorder = order(), vorder = 1 + dice_.below(4);
    int vstride = k + (dice_.one_in(4) ? dice_.below(3) : 0);
    int ustride = vstride * vorder + (dice_.one_in(4) ? dice_.below(3) : 0);
    if (dice_.one_in(4)) {  // u runs fastest
      ustride = vstride;
      vstride = ustride * uorder;
    }
    const auto [u1, u2] = domain();
    const auto [v1, v2] = domain();
    const std::vector<double> points =
        numbers(static_cast<std::size_t>((uorder - 1) * ustride + (vorder - 1) * vstride + k));
    if (dice_.one_in(2))
      c_.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, as<GLfloat>(points));
    else
      c_.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  }

  void grid() {
    const int form = dice_.below(2) + (in_surfaces() ? 2 : 0);
    const GLint n = 1 + dice_.below(9), m = 1 + dice_.below(5);
    const auto [u1, u2] = domain();
    const auto [v1, v2] = domain();
    switch (form) {
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
    const bool normals = has_.automatic_normals && dice_.one_in(7);
    const GLenum cap = normals         ? static_cast<GLenum>(GL_AUTO_NORMAL)
                       : in_surfaces() ? map2_target()
                                       : map1_target();
    const bool keeps = has_.vertices_always && makes_vertices(cap);
    if (has_.disabling && !keeps && dice_.one_in(3))
      c_.Disable(cap);
    else
      c_.Enable(cap);
  }

  void current_value() {
    switch (dice_.below(16)) {
      case 0:
        return with_numbers<3>([&](auto... v) { c_.Color3f(v...); });
      case 1:
        return with_numbers<4>([&](auto... v) { c_.Color4f(v...); });
      case 2:
        return with_numbers<4>([&](auto... v) { c_.Color4d(v...); });
      case 3:
        c_.Color3dv(numbers(3));
        return;
      case 4:
        return with_numbers<3>([&](auto... v) { c_.Normal3f(v...); });
      case 5:
        c_.Normal3dv(numbers(3));
        return;
      case 6:
        c_.TexCoord1f(number());
        return;
      case 7:
        return with_numbers<2>([&](auto... v) { c_.TexCoord2d(v...); });
      case 8:
        return with_numbers<3>([&](auto... v) { c_.TexCoord3f(v...); });
      case 9:
        c_.TexCoord4fv(as<GLfloat>(numbers(4)));
        return;
      case 10:
        c_.MultiTexCoord1f(GL_TEXTURE1, number());
        return;
      case 11:
        return with_numbers<2>([&](auto... v) { c_.MultiTexCoord2f(GL_TEXTURE0, v...); });
      case 12:
        return with_numbers<4>([&](auto... v) { c_.MultiTexCoord4d(GL_TEXTURE1, v...); });
      case 13:
        c_.Indexf(dice_.below(200));
        return;
      default:
        c_.EdgeFlag(dice_.below(2));
    }
  }

  GLenum mode() {
    switch (kind_) {
      case Kind::kPoints:
        return GL_POINTS;
      case Kind::kLines:
        return dice_.one_in(2) ? GL_LINES : GL_LINE_STRIP;
      default: {
        constexpr GLenum kModes[] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN};
        return dice_.pick(kModes);
      }
    }
  }

  void vertex() {
    if (has_.given_vertices && dice_.one_in(15)) return given_vertex();
    if (in_surfaces())
      vertex2();
    else
      vertex1();
  }

  void given_vertex() {
    const double x = simple(), y = simple(), z = simple();
    if (dice_.one_in(2))
      c_.Vertex3f(x, y, z);
    else
      c_.Vertex4dv(std::vector<GLdouble>{x, y, z, 1});
  }

  void vertex1() {
    switch (dice_.below(7)) {
      case 0:
      case 1:
        c_.EvalCoord1f(argument());
        return;
      case 2:
        c_.EvalCoord1d(argument());
        return;
      case 3:
        c_.EvalCoord1fv(std::vector<GLfloat>{static_cast<GLfloat>(argument())});
        return;
      case 4:
        c_.EvalCoord1dv(std::vector<GLdouble>{argument()});
        return;
      default:
        c_.EvalPoint1(dice_.below(12) - 1);
    }
  }

  void vertex2() {
    switch (dice_.below(7)) {
      case 0:
      case 1:
        return with_arguments([&](double u, double v) { c_.EvalCoord2f(u, v); });
      case 2:
        return with_arguments([&](double u, double v) { c_.EvalCoord2d(u, v); });
      case 3:
        return with_arguments([&](double u, double v) { c_.EvalCoord2fv(as<GLfloat>({u, v})); });
      case 4:
        return with_arguments([&](double u, double v) { c_.EvalCoord2dv(std::vector<GLdouble>{u, v}); });
      default: {
        const int i = dice_.below(12) - 1;
        c_.EvalPoint2(i, dice_.below(7) - 1);
      }
    }
  }

  void primitive(int count = 0) {
    if (count == 0) count = dice_.one_in(60) ? 200 : 1 + dice_.below(6);
    c_.Begin(mode());
    // Six vertices make only complete lines and triangles.
    if (kind_ != Kind::kPoints) count = 6;
    for (int i = 0; i < count; ++i) {
      if (has_.current_values && dice_.one_in(4)) current_value();
      vertex();
    }
    c_.End();
  }

  void mesh() {
    const GLint i1 = dice_.below(4) - 1, i2 = i1 + 1 + dice_.below(4), j1 = dice_.below(3),
                j2 = j1 + 1 + dice_.below(2);
    const GLenum how = kind_ == Kind::kPoints ? GL_POINT : GL_LINE;
    if (kind_ == Kind::kPolygons)
      c_.EvalMesh2(GL_FILL, i1, i2, j1, j2);
    else if (in_surfaces())
      c_.EvalMesh2(how, i1, i2, j1, j2);
    else
      c_.EvalMesh1(how, i1, i2);
  }

  // Issues a command with one mistake, and GetError.
  void add_rejected() {
    const std::vector<GLfloat> points(64, 0.5f);
    const GLenum target1 = map1_target(), target2 = map2_target();
    const int k1 = gl::components_of(target1), k2 = gl::components_of(target2);
    switch (dice_.below(22)) {
      case 0:
        c_.Map1f(target1, 0, 0, k1, 2, points);
        break;
      case 1:
        c_.Map1f(target1, 0, 1, k1 - 1, 2, points);
        break;
      case 2:
        c_.Map1f(target1, 0, 1, k1, -dice_.below(2), points);
        break;
      case 3:
        c_.Map1f(target1, 0, 1, k1, max_order_ + 1,
                 std::vector<GLfloat>(static_cast<std::size_t>(4 * max_order_ + 4)));
        break;
      case 4:
        c_.Map1f(target2, 0, 1, 4, 2, points);
        break;
      case 5:
        c_.Map2f(target1, 0, 1, 4, 2, 0, 1, 8, 2, points);
        break;
      case 6:
        c_.Map2f(target2, 1, 1, k2, 2, 0, 1, 2 * k2, 2, points);
        break;
      case 7:
        c_.Map2f(target2, 0, 1, k2, 2, 2, 2, 2 * k2, 2, points);
        break;
      case 8:
        c_.Map2f(target2, 0, 1, k2, 2, 0, 1, k2 - 1, 2, points);
        break;
      case 9:
        c_.Map2f(target2, 0, 1, k2, 2, 0, 1, 2 * k2, 0, points);
        break;
      case 10:
        c_.MapGrid1f(-dice_.below(3), 0, 1);
        break;
      case 11:
        c_.MapGrid2f(2, 0, 1, -dice_.below(3), 0, 1);
        break;
      case 12:
        c_.EvalMesh1(GL_FILL, 0, 1);
        break;
      case 13:
        c_.EvalMesh2(GL_POINTS, 0, 1, 0, 1);
        break;
      case 14:
        c_.Enable(GL_COEFF);
        break;
      case 15:
        if (has_.risky) c_.GetMapfv(GL_COEFF, GL_COEFF, gl::out<GLfloat>(8));
        break;
      case 16:
        if (has_.risky) c_.GetMapdv(target1, target2, gl::out<GLdouble>(8));
        break;
      case 17:
        c_.Begin(GL_POLYGON + 20);
        break;
      case 18:
        c_.End();
        break;
      case 19:
        return inside([&] { c_.Map1f(target1, 0, 1, k1, 2, points); });
      case 20:
        return inside([&] { c_.MapGrid1f(3, 0, 1); });
      default:
        return inside([&] { c_.Enable(target2); });
    }
    c_.GetError();
  }
  template <class Body>
  void inside(Body body) {
    c_.Begin(mode());
    body();
    c_.End();
    c_.GetError();
  }

  // Issues a query. Programs have few queries, because they flush and so hide bugs.
  void query() {
    switch (dice_.below(14)) {
      case 0:
        c_.IsEnabled(dice_.one_in(2) ? map1_target() : map2_target());
        return;
      case 1:
        c_.IsEnabled(GL_AUTO_NORMAL);
        return;
      case 2:
        c_.GetMapfv(map1_target(), GL_COEFF, gl::out<GLfloat>(static_cast<std::size_t>(4 * max_order_)));
        return;
      case 3:
        c_.GetMapdv(map2_target(), GL_COEFF, gl::out<GLdouble>(static_cast<std::size_t>(16 * max_order_)));
        return;
      case 4:
        c_.GetMapiv(map1_target(), GL_ORDER, gl::out<GLint>(1));
        return;
      case 5:
        c_.GetMapiv(map2_target(), GL_ORDER, gl::out<GLint>(2));
        return;
      case 6:
        c_.GetMapfv(map1_target(), GL_DOMAIN, gl::out<GLfloat>(2));
        return;
      case 7:
        c_.GetMapdv(map2_target(), GL_DOMAIN, gl::out<GLdouble>(4));
        return;
      case 8:
        c_.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
        return;
      case 9:
        c_.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
        return;
      case 10:
        c_.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
        return;
      case 11:
        c_.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
        return;
      case 12:
        c_.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
        return;
      default:
        c_.GetError();
    }
  }

  void push() {
    constexpr GLbitfield kMasks[] = {
        GL_EVAL_BIT,    GL_ENABLE_BIT, GL_CURRENT_BIT, GL_ALL_ATTRIB_BITS, GL_EVAL_BIT | GL_CURRENT_BIT,
        GL_LIGHTING_BIT};
    c_.PushAttrib(dice_.pick(kMasks));
    ++depth_;
  }
  void pop() {
    if (depth_ == 0) return;
    c_.PopAttrib();
    --depth_;
  }

  GLuint list_name() { return kFirstList + static_cast<GLuint>(dice_.below(kLists)); }
  void call() { call(list_name()); }
  void call(GLuint name) {
    c_.CallList(name);
    if (has_.errors_in_lists) c_.GetError();
  }
  void list() {
    const GLuint name = list_name();
    c_.NewList(name, dice_.one_in(2) ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
    for (int i = 1 + dice_.below(5); i > 0; --i) {
      switch (dice_.below(9)) {
        case 0:
        case 1:
          map();
          break;
        case 2:
          grid();
          break;
        case 3:
          enable();
          break;
        case 4:
          if (has_.current_values) current_value();
          break;
        case 5:
          if (has_.meshes) mesh();
          break;
        case 6:  // calls an earlier list, never itself
          if (has_.risky && name > kFirstList)
            call(kFirstList + static_cast<GLuint>(dice_.below(static_cast<int>(name - kFirstList))));
          break;
        case 7:
          if (has_.errors_in_lists) add_rejected();
          break;
        default:
          primitive(2);
      }
    }
    c_.EndList();
    if (dice_.one_in(2)) call(name);
  }

  // Issues commands while another texture unit is active, which makes map commands fail.
  void other_unit() {
    c_.ActiveTexture(GL_TEXTURE1);
    switch (dice_.below(3)) {
      case 0:
        map();
        c_.GetError();
        break;
      case 1:
        primitive();
        break;
      default:
        if (has_.current_values) current_value();
    }
    c_.ActiveTexture(GL_TEXTURE0);
  }

  gl::Case& c_;
  Dice& dice_;
  int max_order_;
  Kind kind_;
  Parts has_;
  bool hostile_ = false;
  int depth_ = 0;
};

SpecifiedProgram write_program(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order,
                               bool past) {
  // If the outcome of a random program is undefined (for example because of a replaced list), another
  // one is made.
  for (std::uint64_t attempt = 0;; ++attempt) {
    Dice dice((std::uint64_t{seed} << 32 | number) + attempt * 0x9E3779B97F4A7C15u);
    gl::Case program(fmt::format("program {} of seed {}", number, seed));
    ProgramWriter(program, dice, max_eval_order, past).write(length);
    if (std::optional<Specified> specified = specify_if_defined(program, max_eval_order))
      return {std::move(program), *std::move(specified)};
  }
}

}  // namespace

SpecifiedProgram random_specified_program(std::uint32_t seed, std::uint32_t number, int length,
                                          int max_eval_order) {
  return write_program(seed, number, length, max_eval_order, false);
}

gl::Case random_past(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order) {
  return write_program(seed, number, length, max_eval_order, true).program;
}

gl::Case random_program(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order) {
  return random_specified_program(seed, number, length, max_eval_order).program;
}

}  // namespace evalcts::fuzz
