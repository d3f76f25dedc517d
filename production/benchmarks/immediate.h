// Benchmarks of single calls, each of which sends a vertex to the sink, as programs use the GL commands.
#pragma once

#include <glevaluator.h>

#include <functional>
#include <string>

#include "workload.h"

namespace evalcts::bench {

// The calls of all sides: EvalCoord1(u[i]), and EvalCoord2(u[i], u[last - i]).
const Curve& called_curve();
const Mesh& called_surface();
template <class Call>
void call_curve(const Call& eval_coord) {
  for (const float u : called_curve().u) eval_coord(u);
}
template <class Call>
void call_surface(const Call& eval_coord) {
  const std::vector<float>& u = called_curve().u;
  for (std::size_t i = 0; i < u.size(); ++i) eval_coord(u[i], u[u.size() - 1 - i]);
}

// Returns a sink that stores positions in the results, round-robin.
glev_sink storing_sink();

// Registers a benchmark. `prepare` returns a function that makes all calls with a storing_sink().
using Calls = std::function<void()>;
void add_curve_calls(const std::string& side, std::function<Calls()> prepare);
void add_surface_calls(const std::string& side, std::function<Calls()> prepare);

}  // namespace evalcts::bench
