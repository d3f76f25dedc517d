// The judge compares captured values with exact ones, by the accuracy rule
// (vectors/INTERPRETING.md).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <evalcts/gl/observation.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/judge/topology.h>
#include <evalcts/results/accuracy.h>
#include <evalcts/results/difference.h>
#include <evalcts/results/verdict.h>

namespace evalcts {

// A value that differs from the prediction.
struct Mismatch {
  std::string what;      // "position.x of vertex 3"
  std::string message;   // one line
  std::string expected;  // the interval, or the value
  std::string captured;
  std::string exact;  // decimal and hex float
  // The source that the value should have: a map (or a default component beside those of a map), AUTO_NORMAL
  // on a surface with one w or with several, the current value, at an evaluated or an explicit vertex, or the
  // position of an explicit vertex.
  enum class Source {
    kMap,
    kAutomaticNormal,
    kRationalNormal,
    kCurrentOfEvaluatedVertex,
    kCurrentOfExplicitVertex,
    kExplicitPosition
  };
  Source source = Source::kMap;
  std::string observed = {};  // Difference::kind, if neither `what` nor `kind` tells it
  double ulp = 0;
  double condition_aware = 0;

  // The captured value and the interval as numbers: `got` is outside [lowest, highest].
  enum class Kind { kValue, kVertices, kError } kind = Kind::kValue;
  double got = 0, lowest = 0, highest = 0;

  // Returns the identity of a wrong value or of wrong vertices.
  Difference difference() const;
};

struct Judgement {
  std::vector<Mismatch> mismatches;
  Accuracy accuracy;
};

struct JudgeOptions {
  Level level = Level::kMust;
  Attributes attributes = kAllAttributes;  // attributes to judge, if they were observed
  Attributes measured = kAllAttributes;    // attributes that count for Accuracy
  bool lengths_of_shader_normals = false;  // judge lengths of normals with a vertex shader (U-AUTON-MAGN)
  // Positions and texture coordinates were multiplied by a matrix: if one component may be infinite or NaN,
  // the others are not judged either.
  bool vectors_as_a_whole = false;
  int version = 46;        // 10 * major + minor: ranges that the GL promises depend on it
  std::string where = {};  // identity of the case, for Accuracy
  // Vertices behind so many mismatches are not judged.
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

// Compares the captured vertices, in order, with the prediction, which is split according to the topology. An
// explicit value (not evaluated) must be reproduced bit for bit, with -0 equal to +0.
Judgement judge(const Prediction& prediction, const Topology& topology, const Observation& observation,
                const JudgeOptions& options);
// Judges a case that draws only points.
Judgement judge(const Prediction& prediction, const Observation& observation, const JudgeOptions& options);

// Returns the topology with fewer wrong values: either `topology`, or the topology of match_meshes(), in
// which each mesh of EvalMesh2 may have any order.
Topology with_meshes_in_own_order(const Prediction& prediction, Topology topology,
                                  const Observation& observation, const JudgeOptions& options);

// An observation, and the topology of the capture that made it, which gives the order of its vertices.
struct OrderedObservation {
  const Observation& observation;
  const Topology& topology;
};

// Compares two observations of the same case in the attributes that both have: bit for bit, except that -0
// and subnormals are compared as real numbers, to 2^-126. Returns an empty string or a description of the
// difference.
std::string disagreement(const OrderedObservation& a, const OrderedObservation& b);

}  // namespace evalcts
