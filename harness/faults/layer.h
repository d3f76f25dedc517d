// Defines changes, which are put in front of the entry points of an implementation as layers, and the state
// of a layer:
//   a fault      a deliberate mistake in a correct implementation, which tests must detect;
//   a variation  a difference that the specification permits or that does not concern evaluators, on which no
//                test may fail;
//   a repair     what an implementation needs to satisfy a requirement that faults violate.
// Changes are rules (see rules.h). Those of faults and repairs are in wrappers/, one file for each section of
// the requirements, and those of variations in variations/. Mistakes that rules cannot make are mutations of
// the sources of `production` (production/mutations/mutations.json).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/test_record.h>
#include "call.h"

namespace evalcts::faults {

struct Rule;
struct Rules;

// Kinds of changes, as listed.
inline constexpr std::string_view kFault = "wrapper", kMutation = "switch", kVariation = "variation",
                                  kRepair = "repair";

// Implementations for changes of features that no available GL supports or implements correctly.
inline constexpr std::string_view kNvVertexProgram = "nv-vertex-program";  // a provider of this build
inline constexpr std::string_view kColorIndex = "color-index";             // a provider of this build
inline constexpr std::string_view kRepairedOSMesa = "repaired-osmesa";     // OSMesa behind this repair
inline constexpr std::string_view kOSMesa30 = "osmesa-3.0";                // OSMesa that reports GL 3.0

struct Change {
  std::string_view name, kind;
  std::string_view implementation;  // the implementation that is changed: a kind, or a constant above
  Level level;                      // minimum level of the tests that must detect a fault
  // IDs of violated requirements (or halves, "ID/2-D"), separated by blanks. A test of each must detect a
  // fault; tests of these requirements may fail on a variation.
  std::string_view requirements;
  std::string_view what;  // the mistake or the difference, in words
  Rules (*rules)();       // null: a mutation of production
};
struct Registration {
  explicit Registration(const Change& change);
};
// Returns all changes, sorted by name.
const std::vector<Change>& all_changes();

// Returns the implementation with the changes in front of it, the outermost first. Throws CannotStart if
// there is no such change.
std::unique_ptr<Implementation> with_changes(std::unique_ptr<Implementation> inner,
                                             const std::vector<std::string>& names);

inline constexpr GLenum kNoPrimitive = 0xFFFFFFFFu;

// State of the context that is known from the calls that reach a layer, and that cannot be queried between
// Begin and End or while a list is compiled.
struct TrackedState {
  GLenum primitive = kNoPrimitive;   // mode of the open primitive
  GLenum unit = GL_TEXTURE0;         // argument of the last ActiveTexture
  GLenum list_mode = 0;              // mode of the open list, 0 without one
  GLuint kind = 0;                   // the argument of the last ContextOfKindEVALCTS
  std::vector<GLbitfield> masks{};   // the masks of PushAttrib on the attribute stack
  std::map<GLenum, bool> enabled{};  // the last Enable or Disable of each capability
  std::map<GLenum, GLuint> buffers{};

  bool is_inside() const { return primitive != kNoPrimitive; }
  bool has_vertex_map(int dimension);
  // Note a call with these first arguments, before and after the rules.
  void note_before(gl::EntryPoint entry, double first, double second);
  void note_after(gl::EntryPoint entry, double first, double second);
};

// One change in front of the entry points, with the memory of its rules.
struct Layer {
  std::vector<Rule> rules;
  TrackedState tracked{};
  std::map<double, double> numbers{};
  std::vector<double> list{};
  std::vector<Call> held{};
};
// Returns the layer whose rules run.
Layer& running_layer();

}  // namespace evalcts::faults
