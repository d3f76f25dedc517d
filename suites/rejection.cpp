// Prepares the state that a rejected command must not change, and lists the commands that are legal or
// illegal between Begin and End.
#include "rejection.h"

#include <fmt/format.h>

#include <algorithm>

namespace evalcts {

void prepare(gl::Case& c, Prepared prepared, bool odd_enabled) {
  const bool all = prepared == Prepared::kEverything;
  set_current_values(c);
  for (int i = 0; i < 9; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const auto points = [i](GLenum target, int count) {
      std::vector<double> values;
      for (int p = 0; p < count * gl::components_of(target); ++p) values.push_back(0.125 * p + i);
      return values;
    };
    const GLenum one = gl::kMap1Targets[index], two = gl::kMap2Targets[index];
    define(c, make_map1(one, -1.0 - i, 2, 4, points(one, 2)));
    const bool enabled = (i % 2 == 1) == odd_enabled;
    if (all) {
      const int uorder = 2 + i % 2, vorder = 4 - i % 3;
      define(c, over(make_map2(two, uorder, vorder, points(two, uorder * vorder)), {-2.0 - i, 3},
                     {5, -4.5 - i}));
    }
    if (enabled || all) c.Enable(enabled ? one : two);
  }
  if (!all) return;
  if (odd_enabled) c.Enable(GL_AUTO_NORMAL);
  c.MapGrid1f(7, -1.5f, 2.25f);
  c.MapGrid2f(5, 0.5f, -3, 9, 2, 6.5f);
  c.GetError();  // these calls are legal; other tests find errors that they raise
}

std::vector<NamedCalls> allowed_in_primitives() {
  return {
      {"EvalCoord1f", [](gl::Case& c) { c.EvalCoord1f(0.5f); }},
      {"EvalCoord1d", [](gl::Case& c) { c.EvalCoord1d(0.5); }},
      {"EvalCoord1fv", [](gl::Case& c) { c.EvalCoord1fv(std::vector<float>{0.5f}); }},
      {"EvalCoord1dv", [](gl::Case& c) { c.EvalCoord1dv(std::vector<double>{0.5}); }},
      {"EvalCoord2f", [](gl::Case& c) { c.EvalCoord2f(0.5f, 0.25f); }},
      {"EvalCoord2d", [](gl::Case& c) { c.EvalCoord2d(0.5, 0.25); }},
      {"EvalCoord2fv",
       [](gl::Case& c) {
         c.EvalCoord2fv(std::vector<float>{0.5f, 0.25f});
       }},
      {"EvalCoord2dv",
       [](gl::Case& c) {
         c.EvalCoord2dv(std::vector<double>{0.5, 0.25});
       }},
      {"EvalPoint1", [](gl::Case& c) { c.EvalPoint1(1); }},
      {"EvalPoint2", [](gl::Case& c) { c.EvalPoint2(1, 0); }},
  };
}

std::vector<NamedCalls> forbidden_in_primitives() {
  std::vector<NamedCalls> all;
  for (const Form& form : kForms) {
    const bool doubles = form.doubles;
    all.push_back({fmt::format("Map1{}", form.name), [=](gl::Case& c) {
                     define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}), doubles);
                   }});
    all.push_back({fmt::format("Map2{}", form.name), [=](gl::Case& c) {
                     define(c, make_map2(GL_MAP2_VERTEX_3, 1, 2, {1, 2, 3, 4, 5, 6}), doubles);
                   }});
  }
  all.push_back({"MapGrid1f", [](gl::Case& c) { c.MapGrid1f(3, 5.0f, 6.0f); }});
  all.push_back({"MapGrid1d", [](gl::Case& c) { c.MapGrid1d(3, 5.0, 6.0); }});
  all.push_back({"MapGrid2f", [](gl::Case& c) { c.MapGrid2f(3, 5.0f, 6.0f, 3, 5.0f, 6.0f); }});
  all.push_back({"MapGrid2d", [](gl::Case& c) { c.MapGrid2d(3, 5.0, 6.0, 3, 5.0, 6.0); }});
  all.push_back({"EvalMesh1", [](gl::Case& c) { c.EvalMesh1(GL_POINT, 0, 1); }});
  all.push_back({"EvalMesh2", [](gl::Case& c) { c.EvalMesh2(GL_POINT, 0, 1, 0, 1); }});
  return all;
}

void judge_rejected(Test& t, const std::string& identity, const std::vector<Calls>& bad_calls,
                    Prepared prepared) {
  gl::Case c(identity);
  prepare(c, prepared, t.random()() % 2 == 1);
  take_snapshot(t, c);
  for (const Calls& bad_call : bad_calls) {
    bad_call(c);
    c.GetError();
    c.GetError();
  }
  take_snapshot(t, c);
  t.judge_answers(c);
}

Map legal_map(GLenum target) {
  const int k = std::max(gl::components_of(target), 1);
  if (reference::is_map2_target(target)) return with_room({target, 0, 1, 0, 1, 12, 4, 2, 3, {}});
  return with_room({target, 0, 1, 0, 1, k, k, 3, 1, {}});
}

Map with_room(Map map) {
  constexpr std::size_t kMostValues = 4, kFewest = 64, kMost = 8192;
  // A library may take an order that is not positive for one modulo a power of two.
  const auto points = [](int order) { return static_cast<std::size_t>(order > 0 ? order : 64); };
  const auto values = [&](int stride) {
    return std::max(static_cast<std::size_t>(std::max(stride, 0)), kMostValues);
  };
  const std::size_t u = points(map.uorder), v = points(map.vorder);
  const auto extent = [&](int along_u, int along_v) {
    return (u - 1) * values(along_u) + (v - 1) * values(along_v) +
           (map.two ? std::min(values(along_u), values(along_v)) : values(along_u));
  };
  const std::size_t swapped = std::min(extent(map.vstride, map.ustride), kMost);
  map.points.resize(std::max({extent(map.ustride, map.vstride), swapped, u * v * kMostValues, kFewest}), 0.5);
  return map;
}

std::vector<Direction> directions(bool two) {
  return two ? std::vector<Direction>{kU, kV} : std::vector<Direction>{kU};
}

Calls defining(const Map& map, bool doubles) {
  return [map, doubles](gl::Case& c) { define(c, map, doubles); };
}

Calls in_primitive(GLenum mode, bool after_vertex, const Calls& calls) {
  return [=](gl::Case& c) {
    c.Begin(mode);
    if (after_vertex) c.Vertex3f(1, 2, 3);
    calls(c);
    c.End();
  };
}

void judge_rejected(Test& t, const std::string& identity, const std::vector<Map>& bad, bool doubles) {
  std::vector<Calls> calls;
  for (const Map& map : bad) calls.push_back(defining(with_room(map), doubles));
  judge_rejected(t, identity, calls, bad.front().two ? Prepared::kEverything : Prepared::kMaps1);
}

}  // namespace evalcts
