// One call after another, each with a vertex for the sink, as programs with GL's commands have them.
#pragma once

#include <glevaluator.h>

#include <functional>
#include <string>

#include "workload.h"

namespace evalcts::bench {

// The work of all sides: EvalCoord1(u[i]), and EvalCoord2(u[i], u[last - i]).
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

// A sink that stores positions in the results, in turn.
glev_sink storing_sink();

// Registers a benchmark. prepare returns what makes all calls, with a storing_sink.
using Calls = std::function<void()>;
void add_curve_calls(const std::string& side, std::function<Calls()> prepare);
void add_surface_calls(const std::string& side, std::function<Calls()> prepare);

}  // namespace evalcts::bench
