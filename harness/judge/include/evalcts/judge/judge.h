// The judge: captured values against exact ones, by the accuracy rule of section 0.5 of the requirements.
#pragma once

#include <string>
#include <vector>

#include <evalcts/gl/observation.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/judge/topology.h>
#include <evalcts/results/accuracy.h>
#include <evalcts/results/verdict.h>

namespace evalcts {

// One value that is not what it has to be.
struct Mismatch {
  std::string what;      // "position.x of vertex 3"
  std::string message;   // one line
  std::string expected;  // the interval, or the value
  std::string captured;
  std::string exact;  // decimal and hex float
  // The requirement on values that no map supplies, for such a value: EV-COORD-CURRENT in an evaluated vertex,
  // EV-CUR-NEXTVERTEX in an explicit one. Otherwise empty.
  std::string rule_of_current_values;
  double ulp = 0;
  double condition_aware = 0;

  // The same as numbers: `got` lies outside [lowest, highest].
  enum class Of { value, vertices, error } of = Of::value;
  double got = 0, lowest = 0, highest = 0;
};

struct Judgement {
  std::vector<Mismatch> mismatches;
  Accuracy accuracy;
};

struct JudgeOptions {
  Level level = Level::must;
  Attributes attributes = kAllAttributes;  // judged are those of them that were observed
  Attributes measured = kAllAttributes;    // those that count for Accuracy
  bool lengths_of_shader_normals = false;  // of automatic normals with a vertex shader (U-AUTON-MAGN)
  // Positions and texture coordinates went through a matrix: where one component may be anything (infinity,
  // no number), nothing is left of the others.
  bool vectors_as_a_whole = false;
  int version = 46;        // 10 * major + minor: ranges that the GL promises depend on it
  std::string where = {};  // the case's identity, for Accuracy
};

// Compares what came out with the prediction, taken apart as the topology says, vertex by vertex, in order. A
// value that was given (not evaluated) has to come back bit for bit, -0 counting as +0.
Judgement judge(const Prediction& prediction, const Topology& topology, const Observation& observation,
                const JudgeOptions& options);
// The same for a case that draws points only.
Judgement judge(const Prediction& prediction, const Observation& observation, const JudgeOptions& options);

// The topology by which fewer values are wrong: this one, or the one in which each mesh of EvalMesh2 is drawn
// in an order of its own (match_meshes).
Topology with_meshes_in_own_order(const Prediction& prediction, Topology topology,
                                  const Observation& observation, const JudgeOptions& options);

// An observation and how the capture that made it takes primitives apart.
struct Seen {
  const Observation& observation;
  const Topology& topology;
};

// Whether two observations of the same case are the same in the attributes that both have: bit for bit, but
// -0 and subnormals as real numbers to 2^-126. Empty, or what differs.
std::string disagreement(const Seen& a, const Seen& b);

}  // namespace evalcts
