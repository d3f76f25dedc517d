// The program glevaluator_rounding checks that the library rounds correctly. It compares the results of all
// deliveries and instruction sets with those of the oracle (reference/), bit for bit: on random maps (check),
// at every float of an interval (sweep), and on the inputs of the published digest (digest). A task can be
// divided into shards, whose results `merge` sums up to the result of the whole task.
#include <fmt/format.h>
#include <fmt/ranges.h>
#ifdef _WIN32
#include <shlwapi.h>
#else
#include <fnmatch.h>
#endif
#include <reference/filter.h>
#include <glevaluator.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "rounding_maps.h"
#include "rounding_results.h"

namespace {

using namespace rounding;
namespace glv = glevaluator;
using evalcts::reference::Arguments, evalcts::reference::CorrectlyRounded, evalcts::reference::Surface;

// A 64-bit hash: the finalizer of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", 2014).
std::uint64_t hash(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

// ---- The library

using Grid = std::array<Arguments::Grid, 2>;

// A map target, and the attribute that shows its values.
struct MapTarget {
  glev_enum one_dimensional;
  int components;
  glev_attribute attribute;
  glev_enum of(const Map& map) const { return one_dimensional + (map.two_dimensional ? 0x20 : 0); }
};
constexpr MapTarget kMapTargets[] = {
    {GLEV_MAP1_VERTEX_3, 3, GLEV_ATTRIBUTE_VERTEX},
    {GLEV_MAP1_VERTEX_4, 4, GLEV_ATTRIBUTE_VERTEX},
    {GLEV_MAP1_COLOR_4, 4, GLEV_ATTRIBUTE_COLOR},
    {GLEV_MAP1_NORMAL, 3, GLEV_ATTRIBUTE_NORMAL},
    {GLEV_MAP1_TEXTURE_COORD_1, 1, GLEV_ATTRIBUTE_TEXCOORD},
    {GLEV_MAP1_TEXTURE_COORD_2, 2, GLEV_ATTRIBUTE_TEXCOORD},
    {GLEV_MAP1_TEXTURE_COORD_3, 3, GLEV_ATTRIBUTE_TEXCOORD},
    {GLEV_MAP1_TEXTURE_COORD_4, 4, GLEV_ATTRIBUTE_TEXCOORD},
};
// Texture coordinates with the number of components of the map.
const MapTarget& texture_coordinates(const Map& map) { return kMapTargets[3 + map.components]; }

void demand(bool is_true, const char* otherwise) {
  if (!is_true) throw std::logic_error(otherwise);
}

// The output of one call of the library: the values of an attribute, components innermost.
class Values {
 public:
  Values(const Map& map, std::size_t count, glev_attribute attribute)
      : values_(count * static_cast<std::size_t>(map.components)) {
    outputs_.add(attribute, std::span(values_), static_cast<std::size_t>(map.components));
  }
  const glv::Outputs& outputs() const { return outputs_; }
  std::vector<float> take(glev_result result) {
    demand(result == GLEV_SUCCESS, "the library rejects a batch, mesh or patches");
    return std::move(values_);
  }

 private:
  std::vector<float> values_;
  glv::Outputs outputs_;
};

// One map in the library, on an instruction set. The functions return values with the components innermost.
class Evaluator {
 public:
  Evaluator(const std::string& instruction_set, const Map& map, const MapTarget& target,
            const std::optional<Grid>& grid = std::nullopt)
      : map_(map), target_(target), context_(make_context(instruction_set)) {
    demand(context_.result() == GLEV_SUCCESS, "glevCreateContext failed");
    glev_context* const gl = context_.get();
    const auto& [u, v] = map.domain;
    if (map.two_dimensional) {
      glevMap2d(gl, target.of(map), u[0], u[1], map.vorder * map.components, map.uorder, v[0], v[1],
                map.components, map.vorder, map.points.data());
    } else {
      glevMap1d(gl, target.of(map), u[0], u[1], map.components, map.uorder, map.points.data());
    }
    glevEnable(gl, target.of(map));
    if (grid) {
      const auto& [in_u, in_v] = *grid;
      glevMapGrid1d(gl, static_cast<int>(in_u.segments), in_u.first, in_u.last);
      glevMapGrid2d(gl, static_cast<int>(in_u.segments), in_u.first, in_u.last,
                    static_cast<int>(in_v.segments), in_v.first, in_v.last);
    }
    demand(glevGetError(gl) == GLEV_NO_ERROR, "a map is not legal");
    plan_ = glv::Plan(context_, map.two_dimensional ? 2 : 1);
    demand(plan_.result() == GLEV_SUCCESS, "glevCreatePlan failed");
  }

  template <class Real>
  std::vector<float> batch(const std::vector<Real>& u, const std::vector<Real>& v) const {
    Values values(map_, u.size(), target_.attribute);
    return values.take(glv::evaluate<Real>(plan_, u, v, values.outputs()));
  }

  std::vector<float> mesh(int i1, int i2, int j1, int j2) const {
    glev_mesh mesh{};
    mesh.i1 = i1, mesh.i2 = i2, mesh.j1 = j1, mesh.j2 = j2;
    Values values(map_, static_cast<std::size_t>(i2 - i1 + 1) * static_cast<std::size_t>(j2 - j1 + 1),
                  target_.attribute);
    glv::Scratch scratch;
    return values.take(glv::evaluate_mesh(plan_, mesh, values.outputs(), scratch));
  }

  // Returns the vertices that `commands` emits between glevBegin and glevEnd: positions or, if the target is
  // one of texture coordinates, these.
  std::vector<float> vertices(const std::function<void(glev_context*)>& commands) const {
    glev_context* const gl = context_.get();
    const bool is_position = target_.attribute == GLEV_ATTRIBUTE_VERTEX;
    std::vector<float> values;
    auto add = [&](const glev_vertex& vertex) {
      const float* const first = is_position ? vertex.position : vertex.texcoord[0];
      values.insert(values.end(), first, first + map_.components);
    };
    glev_sink sink{};
    sink.size = sizeof sink;
    sink.user = &add;
    sink.vertex = [](void* user, const glev_vertex* vertex) {
      (*static_cast<decltype(add)*>(user))(*vertex);
    };
    glevSetSink(gl, &sink);
    if (!is_position)  // nothing is emitted without a vertex map
      glevEnable(gl, map_.two_dimensional ? GLEV_MAP2_VERTEX_3 : GLEV_MAP1_VERTEX_3);
    glevBegin(gl, GLEV_POINTS);
    commands(gl);
    glevEnd(gl);
    return values;
  }

  // Evaluates `count` patches with the orders and domain of the map at the points of a grid over the domain.
  // `points` are the control points of all patches.
  static std::vector<float> patches(const std::string& instruction_set, const Map& map,
                                    const std::vector<double>& points, std::size_t count,
                                    glev_patch_grid grid) {
    const std::vector<float> floats(map.is_float ? points.begin() : points.end(), points.end());
    const auto components = static_cast<std::size_t>(map.components);
    glev_patches patches = map.is_float
                               ? glv::make_patches<float>(floats, components, map.uorder, map.vorder)
                               : glv::make_patches<double>(points, components, map.uorder, map.vorder);
    patches.u1 = map.domain[0][0], patches.u2 = map.domain[0][1];
    patches.v1 = map.domain[1][0], patches.v2 = map.domain[1][1];
    grid.target = instruction_set.c_str();
    const auto of_patch =
        static_cast<std::size_t>(grid.u_segments + 1) * static_cast<std::size_t>(grid.v_segments + 1);
    Values values(map, count * of_patch, GLEV_ATTRIBUTE_VERTEX);
    glv::Scratch scratch;
    return values.take(glv::evaluate(patches, grid, values.outputs(), scratch));
  }

 private:
  static glv::Context make_context(const std::string& instruction_set) {
    glev_context_info info{};
    info.size = sizeof info;
    info.target = instruction_set.c_str();
    return glv::Context(&info);
  }

  const Map& map_;
  const MapTarget& target_;
  glv::Context context_;
  glv::Plan plan_;
};

// ---- Comparison with the oracle

struct Delivery {
  const char* name;
  std::function<std::vector<float>(const std::string& instruction_set)> evaluate;
  std::size_t step = 1;  // only every step-th value is evaluated
};

// Returns the correctly rounded values of a map, components innermost. If there is a grid, the arguments are
// indices of its points.
std::vector<float> right_values(const Map& map, const std::vector<double>& u, const std::vector<double>& v,
                                const std::optional<Grid>& grid) {
  const auto& [in_u, in_v] = map.domain;
  const auto arguments = [&](const std::vector<double>& values, int direction) {
    return Arguments{values, grid ? std::optional((*grid)[direction]) : std::nullopt};
  };
  const auto components = static_cast<std::size_t>(map.components);
  std::vector<float> all(u.size() * components), of_component(u.size());
  for (std::size_t k = 0; k < components; ++k) {
    const Surface surface{map.points.data() + k,
                          {map.vorder * map.components, map.uorder, in_u[0], in_u[1]},
                          {map.components, map.vorder, in_v[0], in_v[1]}};
    CorrectlyRounded(surface).to_float(arguments(u, 0), arguments(v, 1), of_component);
    for (std::size_t i = 0; i < u.size(); ++i) all[i * components + k] = of_component[i];
  }
  return all;
}

// Compares the values of a map with those of the oracle.
Result compare(const Task& task, std::uint64_t item, const Map& map, const std::vector<double>& u,
               const std::vector<double>& v, const std::optional<Grid>& grid,
               const std::vector<Delivery>& deliveries) {
  const std::vector<float> rights = right_values(map, u, v, grid);
  Result result;
  result.values = rights.size();
  const auto components = static_cast<std::size_t>(map.components);
  for (const std::string& set : task.targets) {
    for (const auto& [name, evaluate, step] : deliveries) {
      const std::vector<float> values = evaluate(set);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t at = i / components * step, k = i % components;
        const float right = rights[at * components + k];
        if (std::bit_cast<std::uint32_t>(values[i]) == std::bit_cast<std::uint32_t>(right)) continue;
        if (result.wrong++ > 0) continue;
        result.first_item = item;
        result.first_wrong = fmt::format(
            "{} on {}: expected {:a}, got {:a}; at {} ({:a}, {:a}), domain [{:a},{:a}] x [{:a},{:a}], orders "
            "{} x {}",
            name, set, right, values[i], grid ? "grid point" : "argument", u[at], v.empty() ? 0 : v[at],
            map.domain[0][0], map.domain[0][1], map.domain[1][0], map.domain[1][1], map.uorder, map.vorder);
        if (grid)
          for (const Arguments::Grid& along : *grid)
            result.first_wrong +=
                fmt::format(", {} segments over [{:a},{:a}]", along.segments, along.first, along.last);
        result.first_wrong += ", control points";
        for (std::size_t p = k; p < map.points.size(); p += components)
          result.first_wrong += fmt::format(" {:a}", map.points[p]);
      }
    }
  }
  return result;
}

// ---- check: each item is a random map of a class at some arguments

class CheckItem {
 public:
  CheckItem(const Task& task, const Class& what, std::uint64_t item)
      : task_(task), item_(item), what_(what), random_(task.seed, item), map_(random_map(what, random_)) {}

  // Large maps get fewer arguments, so that there are many maps.
  static std::size_t arguments(const Class& what) {
    return what.uorder * std::max(what.vorder, 1) > 200 ? 64 : 512;
  }

  Result run() {
    const std::size_t count = arguments(what_);
    if (random_.once_in(6)) return on_patches(count);
    return random_.once_in(3) ? on_grid(count) : at_arguments(count);
  }

 private:
  static constexpr std::size_t kStep = 7;  // only every kStep-th value is evaluated by single calls

  Result at_arguments(std::size_t count) {
    std::vector<double> u(count), v(map_.two_dimensional ? count : 0);
    const auto argument = [&](const Interval& interval) {
      if (!what_.is_tie_rich() || random_.once_in(4)) return random_argument(interval, random_);
      const auto parts = std::uint64_t{1} << random_.below(9);
      const double part = static_cast<double>(random_.below(parts + 1)) / static_cast<double>(parts);
      return interval[0] + part * (interval[1] - interval[0]);
    };
    for (double& x : u) x = argument(map_.domain[0]);
    for (double& x : v) x = argument(map_.domain[1]);
    const auto call = [&](glev_context* context, std::size_t i) {
      v.empty() ? glevEvalCoord1d(context, u[i]) : glevEvalCoord2d(context, u[i], v[i]);
    };
    std::vector<Delivery> deliveries = {
        {"a batch",
         [&](const std::string& set) { return Evaluator(set, map_, texture_coordinates(map_)).batch(u, v); }},
        {"EvalCoord",
         [&](const std::string& set) {
           return Evaluator(set, map_, texture_coordinates(map_)).vertices([&](glev_context* context) {
             for (std::size_t i = 0; i < count; i += kStep) call(context, i);
           });
         },
         kStep}};
    if (map_.components >= 3)  // calls that evaluate only a vertex have their own code path
      deliveries.push_back({"EvalCoord of a vertex", [&](const std::string& set) {
                              return Evaluator(set, map_, kMapTargets[map_.components - 3])
                                  .vertices([&](glev_context* context) {
                                    for (std::size_t i = 0; i < count; ++i) call(context, i);
                                  });
                            }});
    return compare(task_, item_, map_, u, v, std::nullopt, deliveries);
  }

  Arguments::Grid random_grid(const Interval& interval) {
    const auto [u1, u2] = interval;
    if (what_.is_tie_rich() && !random_.once_in(8)) {
      const std::array<std::int64_t, 4> others = {5, 6, 12, 20};
      const std::int64_t few = std::int64_t{1} << random_.below(8);
      return {random_.once_in(5) ? others[random_.below(4)] : few, u1, u2};
    }
    const auto segments =
        static_cast<std::int64_t>(random_.once_in(2) ? 1 + random_.below(300) : 1u << random_.below(9));
    if (!random_.once_in(3)) return {segments, u1, u2};
    if (random_.once_in(3)) return {segments, u2, u1};
    return {segments, random_argument(interval, random_), random_argument(interval, random_)};
  }

  Result on_grid(std::size_t count) {
    const bool two_dimensional = map_.two_dimensional;
    const Grid grid = {random_grid(map_.domain[0]), random_grid(map_.domain[1])};
    const int columns =
        two_dimensional ? 1 + static_cast<int>(random_.below(count / 8)) : static_cast<int>(count);
    const int rows = two_dimensional ? static_cast<int>(count) / columns : 1;
    const auto start = [&](const Arguments::Grid& along, int span) {
      return static_cast<int>(random_.below(along.segments + 3)) - 1 -
             static_cast<int>(random_.below(span / 8 + 1));
    };
    const int i1 = start(grid[0], columns), j1 = two_dimensional ? start(grid[1], rows) : 0;
    std::vector<double> u, v;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        u.push_back(i1 + i);
        if (two_dimensional) v.push_back(j1 + j);
      }
    }
    const auto mesh = [&](const std::string& set) {
      return Evaluator(set, map_, texture_coordinates(map_), grid)
          .mesh(i1, i1 + columns - 1, j1, j1 + rows - 1);
    };
    const auto points = [&](const std::string& set) {
      return Evaluator(set, map_, texture_coordinates(map_), grid).vertices([&](glev_context* context) {
        for (std::size_t i = 0; i < u.size(); i += kStep)
          two_dimensional ? glevEvalPoint2(context, static_cast<int>(u[i]), static_cast<int>(v[i]))
                          : glevEvalPoint1(context, static_cast<int>(u[i]));
      });
    };
    return compare(task_, item_, map_, u, v, grid, {{"a mesh", mesh}, {"EvalPoint", points, kStep}});
  }

  // Checks the map as one of several patches that are evaluated in one call.
  Result on_patches(std::size_t count) {
    const auto most =
        map_.two_dimensional ? static_cast<std::uint64_t>(std::sqrt(static_cast<double>(count))) : count;
    const auto segments = [&] {
      const std::uint64_t few =
          random_.once_in(2) ? std::uint64_t{1} << random_.below(7) : 1 + random_.below(most);
      return static_cast<int>(std::min(few, most - 1));
    };
    const int u_segments = segments(), v_segments = map_.two_dimensional ? segments() : 0;
    const glev_patch_grid grid = glv::make_uniform_grid(u_segments, v_segments);
    std::vector<double> u, v;
    for (int j = 0; j <= grid.v_segments; ++j) {
      for (int i = 0; i <= grid.u_segments; ++i) {
        u.push_back(i);
        if (map_.two_dimensional) v.push_back(j);
      }
    }
    const std::size_t patches = 1 + random_.below(20), own = random_.below(patches);
    std::vector<double> points;
    for (std::size_t p = 0; p < patches; ++p) {
      const std::vector<double> of_patch = p == own ? map_.points : draw_points(map_, what_, random_);
      points.insert(points.end(), of_patch.begin(), of_patch.end());
    }
    const auto evaluate = [&](const std::string& set) {
      const std::vector<float> all = Evaluator::patches(set, map_, points, patches, grid);
      const auto values = static_cast<std::ptrdiff_t>(all.size() / patches);
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(own) * values;
      return std::vector<float>(first, first + values);
    };
    const Grid over_domain = {{{grid.u_segments, map_.domain[0][0], map_.domain[0][1]},
                               {std::max(grid.v_segments, 1), map_.domain[1][0], map_.domain[1][1]}}};
    return compare(task_, item_, map_, u, v, over_domain, {{"patches", evaluate}});
  }

  const Task& task_;
  std::uint64_t item_;
  const Class& what_;
  Random random_;
  Map map_;
};

// Compares a batch of floats, and adds the digest of its first `count` values. `first` is the index of the
// first value in the task.
Result compare_floats(const Task& task, std::uint64_t item, const Map& map, const MapTarget& target,
                      const std::vector<float>& u, const std::vector<float>& v, std::uint64_t first,
                      std::uint64_t count) {
  std::vector<float> values;
  const auto batch = [&](const std::string& set) { return values = Evaluator(set, map, target).batch(u, v); };
  Result result = compare(task, item, map, {u.begin(), u.end()}, {v.begin(), v.end()}, std::nullopt,
                          {{"a batch", batch}});
  result.values = count;
  for (std::uint64_t i = 0; i < count; ++i)
    result.digest += hash(hash(first + i) + std::bit_cast<std::uint32_t>(values[i]));
  return result;
}

// ---- sweep: one random curve of a class at every float of an interval; each item is a block of floats

constexpr std::int64_t kBlock = 1 << 16;

// Numbers the floats in order; 0 has number 0.
std::int64_t number_of(float x) {
  const auto magnitude = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(std::fabs(x)));
  return std::signbit(x) ? -magnitude : magnitude;
}
float float_of(std::int64_t number) {
  const float magnitude = std::bit_cast<float>(static_cast<std::uint32_t>(std::abs(number)));
  return number < 0 ? -magnitude : magnitude;
}

Result sweep_item(const Task& task, const Class& what, std::uint64_t item) {
  Random random(task.seed, 0);
  Map map = random_map(what, random);
  map.domain = {{{0, 1}, {0, 1}}};
  const std::int64_t before = static_cast<std::int64_t>(item) * kBlock, first = number_of(task.from) + before;
  std::vector<float> u;
  for (std::int64_t i = first; i < first + kBlock && i <= number_of(task.to); ++i) u.push_back(float_of(i));
  const std::uint64_t components = static_cast<std::uint64_t>(map.components);
  return compare_floats(task, item, map, texture_coordinates(map), u, {},
                        static_cast<std::uint64_t>(before) * components, u.size() * components);
}

// ---- digest: random curves and surfaces of all targets, of orders 1 to 30, at arguments in and around the
// domain; each item is a map. A change of these inputs changes the published digest.

constexpr std::uint64_t kValuesOfItem = 1200;  // a multiple of 1, 2, 3 and 4 components

Result digest_item(const Task& task, std::uint64_t item) {
  static const char* const kData[] = {"ordinary", "integers", "lines", "cancelling", "wide", "extreme"};
  Random random(task.seed, item);
  const MapTarget& target = kMapTargets[random.below(std::size(kMapTargets))];
  Map map{1, 1, target.components, random.once_in(3), true};
  const int most = !map.two_dimensional || random.once_in(16) ? 30 : 8;
  map.uorder = 1 + static_cast<int>(random.below(most));
  if (map.two_dimensional) map.vorder = 1 + static_cast<int>(random.below(most));
  const char* const data = kData[random.below(std::size(kData))];
  map.points = evalcts::accuracy::random_points(data, map.uorder, map.vorder, map.components, random);
  const bool along_v = map.two_dimensional && random.once_in(2);
  const auto argument = [&] {
    switch (random.below(8)) {
      case 0:
        return static_cast<float>(random.below(65)) / 64;
      case 1:
        return static_cast<float>(random.scaled(0, 1, -static_cast<int>(random.below(120))));
      case 2:
        return static_cast<float>(random.between(-0.5, 1.5));
      default:
        return static_cast<float>(random.uniform());
    }
  };
  const float other = map.two_dimensional ? argument() : 0;
  std::vector<float> along(kValuesOfItem / static_cast<std::uint64_t>(map.components));
  for (float& x : along) x = argument();
  const std::vector<float> fixed(map.two_dimensional ? along.size() : 0, other);
  const std::uint64_t before = item * kValuesOfItem;
  return compare_floats(task, item, map, target, along_v ? fixed : along, along_v ? along : fixed, before,
                        std::min(kValuesOfItem, task.values - before));
}

bool matches(const std::string& pattern, const std::string& name) {
#ifdef _WIN32
  return PathMatchSpecA(name.c_str(), pattern.c_str());
#else
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
#endif
}

// Returns the number of items of the task in a class; 0: the class does not belong to the task.
std::uint64_t items_of(const Task& task, const Class& what) {
  if (!matches(task.filter, what.name())) return 0;
  if (task.kind == "check") return (task.values - 1) / CheckItem::arguments(what) + 1;
  if (what.vorder > 0) return 0;
  return static_cast<std::uint64_t>((number_of(task.to) - number_of(task.from)) / kBlock + 1);
}

// Runs the shard of the task. Prints a line for each class on standard error.
std::map<std::string, Result> run(const Task& task) {
  std::map<std::string, Result> results;
  const auto run_items = [&](const std::string& name, std::uint64_t items, const auto& item) {
    if (items == 0) return;
    Result& sum = results[name];
    for (std::uint64_t i = task.shard - 1; i < items; i += task.shards) sum.add(item(i));
    std::cerr << fmt::format("{:<27} {:>11} values {:>6} wrong\n", name, sum.values, sum.wrong);
  };
  if (task.kind == "digest") {
    run_items("digest", (task.values - 1) / kValuesOfItem + 1,
              [&](auto item) { return digest_item(task, item); });
    return results;
  }
  for (const Class& what : classes())
    run_items(what.name(), items_of(task, what), [&](std::uint64_t item) {
      return task.kind == "sweep" ? sweep_item(task, what, item) : CheckItem(task, what, item).run();
    });
  if (results.empty()) throw WrongUse("--filter '" + task.filter + "' matches no class of maps");
  return results;
}

// Completes and checks the task of the command line. Throws WrongUse.
Task completed(Task task) {
  std::vector<std::string> sets;
  for (std::size_t i = 0; glevGetTargetName(i) != nullptr; ++i) sets.emplace_back(glevGetTargetName(i));
  for (const std::string& target : task.targets)
    if (std::find(sets.begin(), sets.end(), target) == sets.end())
      throw WrongUse(
          fmt::format("this machine has no instruction set {}, only {}", target, fmt::join(sets, ", ")));
  if (task.targets.empty()) task.targets = sets;
  if (task.values == 0) task.values = task.kind == "digest" ? 10'000'000 : 100'000;
  if (!std::isfinite(task.from) || !std::isfinite(task.to) || task.from > task.to)
    throw WrongUse("--from and --to take floats in increasing order");
  return task;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Checks that libglevaluator rounds correctly. The result, in JSON, goes to standard output.\n"
      "Exit codes: 0 all values are right; 1 some are wrong; 2 wrong use, or shards that do not make a "
      "whole.");
  app.require_subcommand(1);
  Task task;
  std::vector<std::string> files;
  const auto set_shard = [&](const std::string& text) {
    char end = 0;
    if (std::sscanf(text.c_str(), "%" SCNu64 "/%" SCNu64 "%c", &task.shard, &task.shards, &end) != 2 ||
        task.shard < 1 || task.shard > task.shards)
      throw CLI::ValidationError("--shard", "'" + text + "' is not K/N with 1 <= K <= N");
  };
  const auto add_task = [&](const char* kind, const char* description) {
    CLI::App* const mode = app.add_subcommand(kind, description);
    mode->add_option("--target", task.targets,
                     "instruction set; may be repeated (default: all of this machine)")
        ->expected(1)
        ->take_all();
    mode->add_option("--seed", task.seed, "seed of maps and arguments (default: 1)");
    mode->add_option_function<std::string>("--shard", set_shard, "K/N: the K-th of N parts of the task");
    mode->parse_complete_callback([&task, kind] { task.kind = kind; });
    return mode;
  };
  CLI::App* const check = add_task("check", "random maps and arguments of each class, by all deliveries");
  CLI::App* const sweep = add_task("sweep", "a random curve of each class, at every float of an interval");
  CLI::App* const digest = add_task("digest", "the inputs of the published digest");
  for (CLI::App* const mode : {check, digest})
    mode->add_option("--values", task.values, "least number of values, in check of each class")
        ->check(CLI::Range(1.0, 1e15));  // the parser reads -1 as 2^64 - 1
  for (CLI::App* const mode : {check, sweep})
    mode->add_option("--filter", task.filter,
                     "shell pattern of the classes, such as 'curve/4/*' (default: all)");
  sweep->add_option("--from", task.from, "first argument (default: 0)");
  sweep->add_option("--to", task.to, "last argument (default: 1)");
  CLI::App* const merge = app.add_subcommand("merge", "the result of a task from those of all of its shards");
  merge->add_option("file", files, "results of the shards")->required();
  try {
    app.parse(argc, argv);
    if (*merge) return print(merged(files));
    task = completed(task);
    return print(to_json(task, run(task)));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const WrongUse& error) {
    std::cerr << "glevaluator_rounding: " << error.what() << "\n";
    return 2;
  }
}
