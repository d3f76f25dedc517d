// A side is one way to do the work of a workload. Before it is measured its results are compared with those
// of float Horner; a side that cannot do the work, or does another one, is an error and not measured.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "workload.h"

namespace evalcts::bench {

// Something to measure: one call of run makes so many points.
struct Measured {
  std::function<void()> run;
  std::int64_t points;
};

// Registers a benchmark whose items are points. prepare is called once, before its first measurement, and
// throws where there is nothing to measure.
void add(const std::string& name, std::function<Measured()> prepare);

// All points of the curve.
using CurveSide = std::function<void(float* results)>;
void add(const Curve& curve, const std::string& side, std::function<CurveSide()> prepare);

// `rows` rows of the mesh from `row` on.
using MeshSide = std::function<void(int row, int rows, float* results)>;
// The unit of one measurement: sides that use nothing from one row for the next need not do all of a big
// mesh.
enum class Unit { kMesh, kStrip };
void add(const Mesh& mesh, const std::string& side, Unit unit, std::function<MeshSide()> prepare);

// Memory for the results of any workload, the same for all sides.
float* results();

// Throws unless they are as close as float computations of that order with these control points come.
void check_agreement(std::span<const float> results, std::span<const float> expected, double tolerance);
double tolerance_for(int order, std::span<const float> points);

}  // namespace evalcts::bench
