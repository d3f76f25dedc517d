// The workloads of the benchmarks. They are generated from seeds and are the same for every side.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace evalcts::bench {

// A workload: points of one curve over [0,1] at scattered arguments.
struct Curve {
  std::string name;
  int order, components;
  std::vector<float> points;  // order * components
  std::vector<float> u;
};

// A workload: points of one surface over [0,1] x [0,1] on the grid (i / (columns - 1), j / (rows - 1)), row
// by row.
struct Mesh {
  std::string name;
  int order, components;  // both orders are the same
  int columns, rows;
  int ring;      // number of rows of the memory for results, which is reused
  bool normals;  // each position is followed by its unit normal
  // Control point (i, j), i in the direction of u, begins at points[(j * order + i) * components].
  std::vector<float> points;

  float u(int i) const { return static_cast<float>(i) / static_cast<float>(columns - 1); }
  float v(int j) const { return static_cast<float>(j) / static_cast<float>(rows - 1); }
  int values() const { return components + (normals ? 3 : 0); }  // number of values of a point
};

// Ordinary data: control points uniform in [-1,1], arguments in [0,1].
const std::vector<Curve>& curves();
const std::vector<Mesh>& meshes();

// Curves that are hard to round: exact ties, lines given as curves of higher degree, and cancellation. Every
// component has the same polynomial, except in Hard/offset.
const std::vector<Curve>& hard_curves();

}  // namespace evalcts::bench
