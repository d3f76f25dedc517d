// Faults: deliberate defects, one at a time, of an implementation that is correct without them. A suite is as
// good as the defects that it detects.
//
// Most are wrappers around entry points: rules (see rules.h) in wrappers/, one file for a section of the
// requirements. Mistakes that no wrapper can make are mutations of the sources of `production`
// (production/mutations/mutations.json).
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/table.h>
#include <evalcts/results/test_record.h>

namespace evalcts::faults {

// The parts of an implementation that a fault may change: the entry points, and, for implementations inside
// this process, the output of their sink.
struct Injection {
  gl::Table& gl;
  std::function<void(std::vector<ObservedPrimitive>&)> emitted{};
};

struct Fault {
  std::string_view name;
  std::string_view implementation;  // that it is put into: see implementation_kinds(), or one of those below
  Level level;                      // at which a test has to detect it
  std::string_view
      requirements;       // IDs (or halves, "ID/2-D") separated by blanks; a test of each detects the fault
  std::string_view what;  // the mistake, in words
  void (*inject)(Injection&);  // null: a mutation of production
};

// The entry points without the fault.
inline gl::Table unmodified;

// Wrappers and mutations, by name.
const std::vector<Fault>& all_faults();

// Implementations for faults in what none at hand has, or follows.
inline constexpr std::string_view kNvVertexProgram = "nv-vertex-program";  // a provider of this build
inline constexpr std::string_view kColorIndex = "color-index";             // the same
inline constexpr std::string_view kRepairedOSMesa = "repaired-osmesa";     // see repaired_osmesa.h
inline constexpr std::string_view kOSMesa30 = "osmesa-3.0";  // Mesa's, when asked for that version

// The implementation with the fault; `inner` has to be of the kind that the fault is for. Throws CannotStart
// where there is no such fault.
std::unique_ptr<Implementation> with_fault(std::unique_ptr<Implementation> inner, std::string_view fault);

struct FaultRegistration {
  explicit FaultRegistration(const Fault& fault);
};

}  // namespace evalcts::faults
