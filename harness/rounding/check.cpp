// Compares libglevaluator with the oracle in batches, single calls, meshes, patches and their derivatives.
#include <evalcts/rounding/check.h>

#include <fmt/format.h>
#include <glevaluator.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <evalcts/gl/hexadecimal.h>
#include <reference/filter.h>

namespace evalcts::rounding {
namespace {

using accuracy::Map, accuracy::Random;
using reference::Argument, reference::Arguments;

// ---- Samples

std::array<double, 2> random_domain(Random& random) {
  switch (random.below(6)) {
    case 0:
      return {static_cast<double>(random.below(10)), 16};
    case 1:
      return {static_cast<float>(random.between(-3, 0)), static_cast<float>(random.between(0.5, 9))};
    case 2:
      return {1, 0};
    default:
      return {0, 1};
  }
}

// Returns true for the data of typical models, for which ties and zeros are frequent: multiples of a power of
// two, short decimals, and short decimals in symmetric or antisymmetric nets.
bool is_tie_rich(const Class& what) {
  return what.data == "dyadic" || what.data == "decimal" || what.data == "symmetric";
}

void draw_tie_rich_points(Map& map, const Class& what, Random& random) {
  const int n = map.uorder - 1, m = map.vorder - 1;
  map.points.resize(static_cast<std::size_t>(map.uorder) * map.vorder * map.components);
  const auto point = [&](int i, int j, int k) -> double& {
    return map.points[static_cast<std::size_t>(i * map.vorder + j) * map.components + k];
  };
  const double range = random.once_in(2) ? 1 : std::ldexp(1, static_cast<int>(random.below(8)));
  const double step = what.data == "dyadic" ? std::ldexp(range, -static_cast<int>(random.below(25)))
                                            : std::pow(10, -1 - static_cast<double>(random.below(4)));
  for (int k = 0; k < map.components; ++k) {
    const double sign_u = random.once_in(2) ? 1 : -1, sign_v = random.once_in(2) ? 1 : -1;
    const bool is_constant_along_u = random.once_in(6);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= m; ++j) {
        double& own = point(i, j, k);
        own = static_cast<float>(std::round(random.between(-range, range) / step) * step);
        if (is_constant_along_u && i > 0) own = point(0, j, k);
        if (what.data != "symmetric") continue;
        if (2 * i > n) own = sign_u * point(n - i, j, k);
        if (2 * i == n && sign_u < 0) own = 0;
        if (2 * j > m && m > 0) own = sign_v * point(i, m - j, k);
        if (2 * j == m && m > 0 && sign_v < 0) own = 0;
      }
    }
  }
}

Map random_map(const Class& what, Random& random) {
  Map map{what.uorder,
          std::max(what.vorder, 1),
          1 + static_cast<int>(random.below(4)),
          what.data != "doubles",
          {},
          {}};
  const std::array<double, 2> u = random_domain(random), v = random_domain(random);
  map.domain = {u[0], u[1], v[0], v[1]};
  if (is_tie_rich(what)) {
    const std::array<std::array<double, 2>, 4> domains = {{{0, 1}, {0, 1}, {1, 0}, {-1, 1}}};
    const std::array<double, 2> own_u = domains[random.below(4)], own_v = domains[random.below(4)];
    map.domain = {own_u[0], own_u[1], own_v[0], own_v[1]};
    draw_tie_rich_points(map, what, random);
  } else {
    draw_points(map, what, random);
  }
  return map;
}

// Returns a number, mostly inside the interval: uniform, dyadic, near an end, or slightly outside.
double random_argument(double u1, double u2, Random& random) {
  const auto place = [&](double t) { return static_cast<double>(static_cast<float>(u1 + t * (u2 - u1))); };
  switch (random.below(8)) {
    case 0:
      return u1 + static_cast<double>(random.below(1025)) / 1024 * (u2 - u1);
    case 1:
      return static_cast<float>(u1 + random.scaled(0, 1, -static_cast<int>(random.below(60))) * (u2 - u1));
    case 2:
      return place(random.between(-0.5, 1.5));
    case 3:
      return place(1 - random.scaled(0, 1, -static_cast<int>(random.below(24))));
    default:
      return place(random.uniform());
  }
}

// ---- Derivatives

struct Derivative {
  glev_attribute attribute;
  std::array<int, 2> order;
  const char* delivery;
};
constexpr Derivative kDerivatives[] = {{GLEV_ATTRIBUTE_TANGENT_U, {1, 0}, "patches, TANGENT_U"},
                                       {GLEV_ATTRIBUTE_TANGENT_V, {0, 1}, "patches, TANGENT_V"},
                                       {GLEV_ATTRIBUTE_SECOND_UU, {2, 0}, "patches, SECOND_UU"},
                                       {GLEV_ATTRIBUTE_SECOND_UV, {1, 1}, "patches, SECOND_UV"},
                                       {GLEV_ATTRIBUTE_SECOND_VV, {0, 2}, "patches, SECOND_VV"}};

// Returns the derivative of a map by u (direction 0) or v (1), which is a map of lower order. Returns nothing
// if one of its control points is not a double.
std::optional<Map> derive(const Map& map, int direction) {
  const double first = map.domain[2 * direction], last = map.domain[2 * direction + 1], width = last - first;
  int exponent = 0;
  const bool is_exact =
      width + first == last && last - width == first && std::fabs(std::frexp(width, &exponent)) == 0.5;
  const int degree = (direction == 0 ? map.uorder : map.vorder) - 1;
  if (!is_exact || std::abs(exponent) > 100) return std::nullopt;
  Map result = map;
  result.is_float = false;
  if (degree == 0) {
    result.points.assign(map.points.size(), 0);
    return result;
  }
  --(direction == 0 ? result.uorder : result.vorder);
  result.points.clear();
  const std::size_t row = static_cast<std::size_t>(map.vorder) * map.components,
                    next = direction == 0 ? row : map.components;
  for (int i = 0; i < result.uorder; ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(result.vorder) * map.components; ++j) {
      const double from = map.points[i * row + j], to = map.points[i * row + j + next],
                   difference = to - from, rest = difference - to, product = difference * degree;
      const double lost = (to - (difference - rest)) - (from + rest);  // two-sum (Knuth)
      const bool is_ordinary =
          product == 0 || (std::fabs(product) > 0x1p-500 && std::fabs(product) < 0x1p500);
      if (lost != 0 || std::fma(difference, degree, -product) != 0 || !is_ordinary) return std::nullopt;
      result.points.push_back(product / width);
    }
  }
  return result;
}

// ---- The library under test and the oracle

glev_output output_of(std::vector<float>& results, int components) {
  glev_output output{};
  output.size = sizeof output;
  output.data = results.data();
  output.data_size = results.size() * sizeof(float);
  output.stride = components * sizeof(float);
  output.components = components;
  return output;
}

struct Grid {
  std::int64_t segments;
  double first, last;
};

class Production {
 public:
  explicit Production(const std::string& target) : target_(target) {
    glev_context_info info{};
    info.size = sizeof info;
    info.target = target.c_str();
    if (glevCreateContext(&info, &context_) != GLEV_SUCCESS ||
        glevCreateContext(&info, &vertices_) != GLEV_SUCCESS)
      throw std::invalid_argument("this machine does not support the instruction set " + target);
    sink_.size = sizeof sink_;
    sink_.user = &single_;
    sink_.vertex = [](void* user, const glev_vertex* vertex) {
      std::copy_n(vertex->texcoord[0], 4, static_cast<float*>(user));
    };
    glevSetSink(context_, &sink_);
    glev_sink positions = sink_;
    positions.user = &positions_;
    positions.vertex = [](void* user, const glev_vertex* vertex) {
      static_cast<std::vector<std::array<float, 4>>*>(user)->push_back(std::to_array(vertex->position));
    };
    glevSetSink(vertices_, &positions);
  }
  Production(const Production&) = delete;
  Production& operator=(const Production&) = delete;
  ~Production() {
    glevReleasePlan(plan_);
    glevDestroyContext(context_);
    glevDestroyContext(vertices_);
  }

  const std::string& target() const { return target_; }

  // Defines the map as texture coordinates, which have maps of one to four components.
  void define(const Map& map, bool two_dimensional, const std::optional<std::array<Grid, 2>>& grid) {
    const auto dimension_token = [&](glev_enum one) { return one + (two_dimensional ? 0x20 : 0); };
    for (glev_enum k = 0; k < 4; ++k) glevDisable(context_, dimension_token(GLEV_MAP1_TEXTURE_COORD_1 + k));
    const auto define_in = [&](glev_context* context, glev_enum target) {
      const auto [u1, u2, v1, v2] = map.domain;
      if (two_dimensional) {
        glevMap2d(context, target, u1, u2, map.vorder * map.components, map.uorder, v1, v2, map.components,
                  map.vorder, map.points.data());
      } else {
        glevMap1d(context, target, u1, u2, map.components, map.uorder, map.points.data());
      }
      glevEnable(context, target);
    };
    define_in(context_, dimension_token(GLEV_MAP1_TEXTURE_COORD_1 + map.components - 1));
    if (map.components >= 3) {
      for (glev_enum k = 0; k < 2; ++k) glevDisable(vertices_, dimension_token(GLEV_MAP1_VERTEX_3 + k));
      define_in(vertices_, dimension_token(GLEV_MAP1_VERTEX_3 + map.components - 3));
    }
    glevEnable(context_, dimension_token(GLEV_MAP1_VERTEX_3));  // single calls need a vertex map
    if (grid) {
      const auto& [u, v] = *grid;
      if (two_dimensional) {
        glevMapGrid2d(context_, static_cast<int>(u.segments), u.first, u.last, static_cast<int>(v.segments),
                      v.first, v.last);
      } else {
        glevMapGrid1d(context_, static_cast<int>(u.segments), u.first, u.last);
      }
    }
    if (glevGetError(context_) != GLEV_NO_ERROR) throw std::logic_error("a sample is not a legal map");
    glevReleasePlan(plan_);
    const glev_plan_info info = {sizeof info, two_dimensional ? std::size_t{2} : std::size_t{1}};
    if (glevCreatePlan(context_, &info, &plan_) != GLEV_SUCCESS) throw std::bad_alloc();
  }

  void evaluate(const std::vector<double>& u, const std::vector<double>& v, int components,
                std::vector<float>& results) const {
    const glev_output output = output_of(results, components);
    glev_batch batch{};
    batch.size = sizeof batch;
    batch.count = u.size();
    batch.type = GLEV_DOUBLE;
    batch.u = {u.data(), u.size() * sizeof(double), sizeof(double)};
    if (!v.empty()) batch.v = {v.data(), v.size() * sizeof(double), sizeof(double)};
    const glev_attribute_output outputs = {GLEV_ATTRIBUTE_TEXCOORD, &output};
    batch.outputs = &outputs;
    batch.output_count = 1;
    if (glevEvaluate(plan_, &batch) != GLEV_SUCCESS) throw std::logic_error("a batch is rejected");
  }

  void mesh(int i1, int i2, int j1, int j2, int components, std::vector<float>& results) {
    const glev_output output = output_of(results, components);
    glev_mesh mesh{};
    mesh.size = sizeof mesh;
    mesh.i1 = i1, mesh.i2 = i2, mesh.j1 = j1, mesh.j2 = j2;
    const glev_attribute_output outputs = {GLEV_ATTRIBUTE_TEXCOORD, &output};
    mesh.outputs = &outputs;
    mesh.output_count = 1;
    scratch_.resize(glevGetMeshScratchSize(plan_, &mesh));
    mesh.scratch = scratch_.data();
    mesh.scratch_size = scratch_.size();
    if (glevEvaluateMesh(plan_, &mesh) != GLEV_SUCCESS) throw std::logic_error("a mesh is rejected");
  }

  // Evaluates `count` patches with the orders and domain of the map and the control points `points`, or a
  // derivative, at all points of a grid over the domain.
  void patches(const Map& map, const std::vector<double>& points, std::size_t count,
               const std::array<int, 2>& segments, glev_attribute attribute, std::vector<float>& results) {
    const std::vector<float> floats(map.is_float ? points.begin() : points.end(), points.end());
    glev_patches patches{};
    patches.size = sizeof patches;
    patches.count = count;
    patches.components = static_cast<std::size_t>(map.components);
    patches.uorder = map.uorder;
    patches.vorder = map.vorder;
    patches.type = map.is_float ? GLEV_FLOAT : GLEV_DOUBLE;
    patches.points = map.is_float ? static_cast<const void*>(floats.data()) : points.data();
    patches.points_size = map.is_float ? floats.size() * sizeof(float) : points.size() * sizeof(double);
    patches.u1 = map.domain[0], patches.u2 = map.domain[1], patches.v1 = map.domain[2],
    patches.v2 = map.domain[3];
    glev_patch_grid grid{};
    grid.size = sizeof grid;
    grid.u_segments = segments[0];
    grid.v_segments = segments[1];
    grid.target = target_.c_str();
    const glev_output output = output_of(results, map.components);
    const glev_attribute_output outputs = {attribute, &output};
    scratch_.resize(glevGetPatchScratchSize(&patches, &grid));
    if (glevEvaluatePatches(&patches, &grid, &outputs, 1, scratch_.data(), scratch_.size()) != GLEV_SUCCESS)
      throw std::logic_error("patches are rejected");
  }

  std::array<float, 4> coord(bool two_dimensional, double u, double v) {
    glevBegin(context_, GLEV_POINTS);
    two_dimensional ? glevEvalCoord2d(context_, u, v) : glevEvalCoord1d(context_, u);
    glevEnd(context_);
    return single_;
  }
  // Evaluates the vertex map of 3 or 4 components at many coordinates. Consecutive calls between Begin and
  // End have their own code path.
  const std::vector<std::array<float, 4>>& coords(const std::vector<double>& u,
                                                  const std::vector<double>& v) {
    positions_.clear();
    glevBegin(vertices_, GLEV_POINTS);
    for (std::size_t i = 0; i < u.size(); ++i)
      v.empty() ? glevEvalCoord1d(vertices_, u[i]) : glevEvalCoord2d(vertices_, u[i], v[i]);
    glevEnd(vertices_);
    return positions_;
  }
  std::array<float, 4> point(bool two_dimensional, int i, int j) {
    glevBegin(context_, GLEV_POINTS);
    two_dimensional ? glevEvalPoint2(context_, i, j) : glevEvalPoint1(context_, i);
    glevEnd(context_);
    return single_;
  }

 private:
  std::string target_;
  glev_context* context_ = nullptr;
  glev_context* vertices_ = nullptr;
  std::vector<std::array<float, 4>> positions_;
  glev_plan* plan_ = nullptr;
  glev_sink sink_{};
  std::array<float, 4> single_{};
  std::vector<std::byte> scratch_;
};

std::vector<std::string> all_targets() {
  std::vector<std::string> names;
  for (std::size_t i = 0; glevGetTargetName(i) != nullptr; ++i) names.emplace_back(glevGetTargetName(i));
  return names;
}

// Computes the correctly rounded values of component k. With a grid, u and v are indices of grid points.
// Returns the number of values that took the exact route.
std::uint64_t right_values(const Map& map, bool two_dimensional, int k, Oracle oracle,
                           const std::vector<double>& u, const std::vector<double>& v,
                           const std::optional<std::array<Grid, 2>>& grid, std::vector<float>& results) {
  const auto [u1, u2, v1, v2] = map.domain;
  const reference::Surface surface = {map.points.data() + k,
                                      map.vorder * map.components,
                                      map.components,
                                      map.uorder,
                                      map.vorder,
                                      u1,
                                      u2,
                                      v1,
                                      v2};
  const reference::Curve curve = {map.points.data() + k, map.components, map.uorder, u1, u2};
  if (oracle == Oracle::kExact) {
    const reference::BernsteinForm form =
        two_dimensional ? reference::BernsteinForm(surface) : reference::BernsteinForm(curve);
    const auto argument = [&](double x, int direction) {
      if (!grid) return Argument::coordinate(x);
      const Grid& own = (*grid)[direction];
      return Argument::grid(static_cast<std::int64_t>(x), own.segments, own.first, own.last);
    };
    for (std::size_t i = 0; i < u.size(); ++i)
      results[i] =
          form.to_float(argument(u[i], 0), two_dimensional ? argument(v[i], 1) : Argument::coordinate(0));
    return u.size();
  }
  const auto arguments = [&](const std::vector<double>& values, int direction) {
    Arguments result{values};
    if (grid)
      result.grid =
          Arguments::Grid{(*grid)[direction].segments, (*grid)[direction].first, (*grid)[direction].last};
    return result;
  };
  if (two_dimensional)
    return reference::CorrectlyRounded(surface).to_float(arguments(u, 0), arguments(v, 1), results);
  return reference::CorrectlyRounded(curve).to_float(arguments(u, 0), results);
}

bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

std::string words(const Class& what, const Map& map, const std::string& target, const char* delivery,
                  double u, double v, const std::optional<std::array<Grid, 2>>& grid, int k, float got,
                  float right) {
  std::string text =
      fmt::format("{} by {} on {}: component {} at ({}, {}) of [{},{}] x [{},{}]", what.name(), delivery,
                  target, k, hexadecimal(u), hexadecimal(v), hexadecimal(map.domain[0]),
                  hexadecimal(map.domain[1]), hexadecimal(map.domain[2]), hexadecimal(map.domain[3]));
  if (grid)
    text += fmt::format(", indices of a grid of {} x {} segments over [{},{}] x [{},{}]", (*grid)[0].segments,
                        (*grid)[1].segments, hexadecimal((*grid)[0].first), hexadecimal((*grid)[0].last),
                        hexadecimal((*grid)[1].first), hexadecimal((*grid)[1].last));
  text += fmt::format(": {}, not {}; control points", hexadecimal(right), hexadecimal(got));
  for (std::size_t i = k; i < map.points.size(); i += map.components)
    text += " " + hexadecimal(map.points[i]);
  return text;
}

// ---- Items: each is one map at some arguments

class Item {
 public:
  Item(const Request& request, std::vector<std::unique_ptr<Production>>& sides, std::uint64_t number)
      : request_(request),
        sides_(sides),
        random_(request.seed, number),
        two_dimensional_(request.what.vorder > 0),
        map_(random_map(request.what, random_)) {}

  Outcome run(std::size_t count) {
    if (random_.once_in(6)) {
      on_patches(count);
    } else if (random_.once_in(3)) {
      on_grid(count);
    } else {
      at_arguments(count);
    }
    return outcome_;
  }

 private:
  // Returns the correctly rounded values of each component of the map or its derivative.
  std::vector<std::vector<float>> right(const Map& map, const std::vector<double>& u,
                                        const std::vector<double>& v) {
    std::vector<std::vector<float>> values(map_.components, std::vector<float>(u.size()));
    for (int k = 0; k < map_.components; ++k)
      outcome_.exact += right_values(map, two_dimensional_, k, request_.oracle, u, v, grid_, values[k]);
    outcome_.samples += u.size() * map_.components;
    return values;
  }

  void compare(const Production& side, const char* delivery, double u, double v, int k, float got,
               float right) {
    if (same(got, right) || std::isnan(right)) return;
    if (outcome_.wrong++ == 0)
      outcome_.first_wrong = words(request_.what, map_, side.target(), delivery, u, v, grid_, k, got, right);
  }

  void compare_all(const Production& side, const char* delivery, const std::vector<double>& u,
                   const std::vector<double>& v, const std::vector<float>& got,
                   const std::vector<std::vector<float>>& right) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      for (int k = 0; k < map_.components; ++k)
        compare(side, delivery, u[i], two_dimensional_ ? v[i] : 0, k, got[i * map_.components + k],
                right[k][i]);
    }
  }

  void at_arguments(std::size_t count) {
    std::vector<double> u(count), v(two_dimensional_ ? count : 0);
    const auto argument = [&](double u1, double u2) {
      if (!is_tie_rich(request_.what) || random_.once_in(4)) return random_argument(u1, u2, random_);
      const auto parts = std::uint64_t{1} << random_.below(9);
      return u1 + static_cast<double>(random_.below(parts + 1)) / static_cast<double>(parts) * (u2 - u1);
    };
    for (double& x : u) x = argument(map_.domain[0], map_.domain[1]);
    for (double& x : v) x = argument(map_.domain[2], map_.domain[3]);
    const std::vector<std::vector<float>> expected = right(map_, u, v);
    std::vector<float> got(count * map_.components);
    for (const auto& side : sides_) {
      side->define(map_, two_dimensional_, std::nullopt);
      side->evaluate(u, v, map_.components, got);
      compare_all(*side, "a batch", u, v, got, expected);
      for (std::size_t i = 0; i < count; i += 7) {
        const std::array<float, 4> values = side->coord(two_dimensional_, u[i], two_dimensional_ ? v[i] : 0);
        for (int k = 0; k < map_.components; ++k)
          compare(*side, "EvalCoord", u[i], two_dimensional_ ? v[i] : 0, k, values[k], expected[k][i]);
      }
      if (map_.components < 3) continue;
      const std::vector<std::array<float, 4>>& positions = side->coords(u, v);
      for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < map_.components; ++k)
          compare(*side, "EvalCoord after another", u[i], two_dimensional_ ? v[i] : 0, k, positions[i][k],
                  expected[k][i]);
      }
    }
  }

  Grid random_grid(double u1, double u2) {
    if (is_tie_rich(request_.what) && !random_.once_in(8)) {
      const std::array<std::int64_t, 4> others = {5, 10, 12, 20};
      const std::int64_t few = std::int64_t{1} << random_.below(8);
      return {random_.once_in(5) ? others[random_.below(4)] : few, u1, u2};
    }
    const auto segments =
        static_cast<std::int64_t>(random_.once_in(2) ? 1 + random_.below(300) : 1u << random_.below(9));
    if (!random_.once_in(3)) return {segments, u1, u2};
    if (random_.once_in(3)) return {segments, u2, u1};
    return {segments, random_argument(u1, u2, random_), random_argument(u1, u2, random_)};
  }

  void on_grid(std::size_t count) {
    grid_ = {random_grid(map_.domain[0], map_.domain[1]), random_grid(map_.domain[2], map_.domain[3])};
    const int columns =
        two_dimensional_ ? 1 + static_cast<int>(random_.below(count / 8)) : static_cast<int>(count);
    const int rows = two_dimensional_ ? static_cast<int>(count) / columns : 1;
    const auto start = [&](const Grid& grid, int span) {
      return static_cast<int>(random_.below(grid.segments + 3)) - 1 -
             static_cast<int>(random_.below(span / 8 + 1));
    };
    const int i1 = start((*grid_)[0], columns), j1 = two_dimensional_ ? start((*grid_)[1], rows) : 0;
    std::vector<double> u, v;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        u.push_back(i1 + i);
        if (two_dimensional_) v.push_back(j1 + j);
      }
    }
    const std::vector<std::vector<float>> expected = right(map_, u, v);
    std::vector<float> got(u.size() * map_.components);
    for (const auto& side : sides_) {
      side->define(map_, two_dimensional_, grid_);
      side->mesh(i1, i1 + columns - 1, j1, two_dimensional_ ? j1 + rows - 1 : 0, map_.components, got);
      compare_all(*side, "a mesh", u, v, got, expected);
      for (std::size_t i = 0; i < u.size(); i += 7) {
        const int row = two_dimensional_ ? static_cast<int>(v[i]) : 0;
        const std::array<float, 4> values = side->point(two_dimensional_, static_cast<int>(u[i]), row);
        for (int k = 0; k < map_.components; ++k)
          compare(*side, "EvalPoint", u[i], row, k, values[k], expected[k][i]);
      }
    }
  }

  // Checks the map as one of several patches that are evaluated in one call.
  void on_patches(std::size_t count) {
    const auto most =
        two_dimensional_ ? static_cast<std::uint64_t>(std::sqrt(static_cast<double>(count))) : count;
    const auto segments = [&] {
      const std::uint64_t few =
          random_.once_in(2) ? std::uint64_t{1} << random_.below(7) : 1 + random_.below(most);
      return static_cast<std::int64_t>(std::min(few, most - 1));
    };
    const std::int64_t in_u = segments(), in_v = two_dimensional_ ? segments() : 1;
    grid_ = {Grid{in_u, map_.domain[0], map_.domain[1]}, Grid{in_v, map_.domain[2], map_.domain[3]}};
    std::vector<double> u, v;
    for (std::int64_t j = 0; j <= (two_dimensional_ ? in_v : 0); ++j) {
      for (std::int64_t i = 0; i <= in_u; ++i) {
        u.push_back(static_cast<double>(i));
        if (two_dimensional_) v.push_back(static_cast<double>(j));
      }
    }
    const std::size_t patches = 1 + random_.below(20), own = random_.below(patches);
    std::vector<double> points;
    for (std::size_t p = 0; p < patches; ++p) {
      Map other = map_;
      if (p != own)
        is_tie_rich(request_.what) ? draw_tie_rich_points(other, request_.what, random_)
                                   : draw_points(other, request_.what, random_);
      points.insert(points.end(), other.points.begin(), other.points.end());
    }
    const std::size_t values = u.size() * static_cast<std::size_t>(map_.components);
    std::vector<float> all(patches * values);
    const auto compare_patches = [&](glev_attribute attribute, const char* delivery,
                                     const std::vector<std::vector<float>>& expected) {
      for (const auto& side : sides_) {
        side->patches(map_, points, patches,
                      {static_cast<int>(in_u), two_dimensional_ ? static_cast<int>(in_v) : 0}, attribute,
                      all);
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(own * values);
        compare_all(*side, delivery, u, v, {first, first + static_cast<std::ptrdiff_t>(values)}, expected);
      }
    };
    compare_patches(GLEV_ATTRIBUTE_VERTEX, "patches", right(map_, u, v));
    const Derivative& derivative = kDerivatives[random_.below(std::size(kDerivatives))];
    std::optional<Map> derived = map_;
    for (const int direction : {0, 1}) {
      for (int k = 0; derived && k < derivative.order[direction]; ++k) derived = derive(*derived, direction);
    }
    if (derived) compare_patches(derivative.attribute, derivative.delivery, right(*derived, u, v));
  }

  const Request& request_;
  std::vector<std::unique_ptr<Production>>& sides_;
  Random random_;
  bool two_dimensional_;
  Map map_;
  std::optional<std::array<Grid, 2>> grid_;
  Outcome outcome_;
};

std::vector<std::unique_ptr<Production>> make_sides(const Request& request) {
  std::vector<std::unique_ptr<Production>> sides;
  for (const std::string& target : request.targets.empty() ? all_targets() : request.targets)
    sides.push_back(std::make_unique<Production>(target));
  return sides;
}

// Runs the items 0, 1, ... in `jobs` threads. `first_wrong` is that of the smallest item with a wrong value.
template <class Run>
Outcome in_threads(int jobs, std::uint64_t items, const std::atomic<bool>& stop, const Run& run) {
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Outcome total;
  std::uint64_t first = items;
  std::exception_ptr problem;
  const auto work = [&] {
    try {
      auto side = run();
      for (std::uint64_t item; !stop && (item = next++) < items;) {
        const Outcome outcome = side(item);
        const std::lock_guard lock(mutex);
        total.samples += outcome.samples;
        total.exact += outcome.exact;
        total.wrong += outcome.wrong;
        if (outcome.wrong != 0 && item < first) {
          first = item;
          total.first_wrong = outcome.first_wrong;
        }
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!problem) problem = std::current_exception();
      next = items;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < jobs; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (problem) std::rethrow_exception(problem);
  return total;
}

}  // namespace

std::vector<Class> classes() {
  std::vector<Class> all;
  const std::vector<std::string> data = {"ordinary", "integers", "lines",  "cancelling",
                                         "wide",     "extreme",  "doubles"};
  for (const int order : {2, 3, 4, 6, 10, 30, 64}) {
    for (const std::string& kind : data) all.push_back({order, 0, kind});
  }
  for (const auto& [u, v] : {std::pair{2, 2}, {4, 4}, {3, 8}, {1, 5}, {30, 30}}) {
    for (const std::string& kind : data) all.push_back({u, v, kind});
  }
  const std::vector<std::string> tie_rich = {"dyadic", "decimal", "symmetric"};
  for (const auto& [u, v] :
       {std::pair{2, 0}, {3, 0}, {4, 0}, {6, 0}, {2, 2}, {3, 3}, {4, 4}, {2, 4}, {6, 5}}) {
    for (const std::string& kind : tie_rich) all.push_back({u, v, kind});
  }
  return all;
}

Outcome check(const Request& request, const std::atomic<bool>& stop) {
  // Large maps get fewer arguments, so that there are many maps.
  const std::size_t count = request.what.uorder * std::max(request.what.vorder, 1) > 200 ? 64 : 512;
  const std::uint64_t items = (request.samples + count - 1) / count;
  make_sides(request);  // throws if an instruction set is unknown
  return in_threads(request.jobs, items, stop, [&] {
    return [&request, count, sides = make_sides(request)](std::uint64_t item) mutable {
      return Item(request, sides, item).run(count);
    };
  });
}

Outcome sweep(const Request& request, const std::atomic<bool>& stop,
              const std::function<void(double done)>& progress) {
  constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.0f), kBlock = 1u << 16;
  Random random(request.seed, 0);
  Map map = random_map(request.what, random);
  map.domain = {0, 1, 0, 1};
  Request one = request;
  if (one.targets.empty()) one.targets = {all_targets().front()};
  const std::uint64_t items = kOne / kBlock + 1;
  return in_threads(request.jobs, items, stop, [&] {
    auto sides = make_sides(one);
    sides.front()->define(map, false, std::nullopt);
    return [&, sides = std::move(sides)](std::uint64_t item) {
      Outcome outcome;
      const auto first = static_cast<std::uint32_t>(item) * kBlock;
      const std::uint32_t count = std::min(kBlock, kOne - first + 1);
      std::vector<double> u(count);
      for (std::uint32_t i = 0; i < count; ++i) u[i] = std::bit_cast<float>(first + i);
      std::vector<float> got(static_cast<std::size_t>(count) * map.components), right(count);
      sides.front()->evaluate(u, {}, map.components, got);
      for (int k = 0; k < map.components; ++k) {
        outcome.exact += right_values(map, false, k, one.oracle, u, {}, std::nullopt, right);
        for (std::uint32_t i = 0; i < count; ++i) {
          const float result = got[static_cast<std::size_t>(i) * map.components + k];
          if (same(result, right[i])) continue;
          if (outcome.wrong++ == 0)
            outcome.first_wrong = words(one.what, map, one.targets.front(), "a batch", u[i], 0, std::nullopt,
                                        k, result, right[i]);
        }
        outcome.samples += count;
      }
      if (item % 64 == 0) progress(static_cast<double>(item) / static_cast<double>(items));
      return outcome;
    };
  });
}

}  // namespace evalcts::rounding
