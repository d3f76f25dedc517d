// Benchmarks of typical models: short decimal or dyadic coordinates, often symmetric, drawn with few
// segments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "side.h"

namespace evalcts::bench {

// A model: patches over [0,1] x [0,1], each drawn with the same number of segments in both directions.
struct Model {
  std::string name;
  int order, segments;                      // in both directions
  std::vector<std::vector<float>> patches;  // control point (i, j), i along u, begins at (j * order + i) * 3

  std::size_t points_of_patch() const { return static_cast<std::size_t>(segments + 1) * (segments + 1); }
};

const std::vector<Model>& models();

// A million bicubic patches of three random components in one array, v fastest, each at 8 x 8 points. The
// array does not fit into any cache. Patches are evaluated in blocks, whose results go to the same memory.
struct ManyPatches {
  static constexpr std::size_t kCount = 1000000, kBlock = 1000, kValues = 48;
  static constexpr int kSegments = 7;
  static constexpr std::size_t kPoints = (kSegments + 1) * (kSegments + 1);
  std::vector<float> points;
};
const ManyPatches& many_patches();
// Registers a benchmark whose items are points. `prepare` returns evaluate(points, results), which evaluates
// kBlock patches; v is fastest in the control points and u in the results.
void add_many_patches(const std::string& side,
                      std::function<std::function<void(const float* points, float* results)>()> prepare);

// Evaluates all points of one patch.
using PatchSide = std::function<void(std::size_t patch, float* results)>;
// Registers a benchmark whose items are points, of all patches.
void add(const Model& model, const std::string& side, std::function<PatchSide()> prepare);

}  // namespace evalcts::bench
