// A side is one implementation of a workload. Before it is measured, its results are compared with those of
// float Horner. If a side fails or has other results, this is an error and it is not measured.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "workload.h"

namespace evalcts::bench {

// A function to measure: one call of `run` computes `points` points.
struct Measured {
  std::function<void()> run;
  std::int64_t points;
};

// Registers a benchmark whose items are points. `prepare` is called once, before the first measurement, and
// throws if there is nothing to measure.
void add(const std::string& name, std::function<Measured()> prepare);

// Evaluates all points of the curve.
using CurveSide = std::function<void(float* results)>;
void add(const Curve& curve, const std::string& side, std::function<CurveSide()> prepare);

// Evaluates `rows` rows of the mesh from `row` on.
using MeshSide = std::function<void(int row, int rows, float* results)>;
// The unit of one measurement. Sides whose rows are independent may be measured in strips of a large mesh.
enum class Unit { kMesh, kStrip };
void add(const Mesh& mesh, const std::string& side, Unit unit, std::function<MeshSide()> prepare);

// Returns the memory for the results of any workload, the same for all sides.
float* results();

// Throws unless each result is within the tolerance. tolerance_for() is that of float computations of the
// order with these control points.
void check_agreement(std::span<const float> results, std::span<const float> expected, double tolerance);
double tolerance_for(int order, std::span<const float> points);

}  // namespace evalcts::bench
