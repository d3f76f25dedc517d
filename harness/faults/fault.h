// Defines faults: deliberate mistakes, one at a time, in a correct implementation. A suite is as good as the
// faults that it detects.
//
// Most faults are rules (see rules.h) that wrap entry points. They are in wrappers/, one file for each
// section of the requirements. Mistakes that a wrapper cannot make are mutations of the sources of
// `production`
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
  std::string_view implementation;  // the implementation that gets the fault: a kind, or a constant below
  Level level;                      // minimum level of the tests that must detect the fault
  std::string_view
      requirements;       // IDs (or halves, "ID/2-D"), separated by blanks; a test of each detects the fault
  std::string_view what;  // the mistake, in words
  void (*inject)(Injection&);  // null: a mutation of production
};

// The entry points without the fault.
inline gl::Table unmodified;

// Returns all faults (wrappers and mutations), sorted by name.
const std::vector<Fault>& all_faults();

// Implementations for faults in features that no available GL supports or implements correctly.
inline constexpr std::string_view kNvVertexProgram = "nv-vertex-program";  // a provider of this build
inline constexpr std::string_view kColorIndex = "color-index";             // a provider of this build
inline constexpr std::string_view kRepairedOSMesa = "repaired-osmesa";     // see repaired_osmesa.h
inline constexpr std::string_view kOSMesa30 = "osmesa-3.0";                // OSMesa that reports GL 3.0

// Returns the implementation with the fault. `inner` must be the implementation that the fault is for. Throws
// CannotStart if there is no such fault.
std::unique_ptr<Implementation> with_fault(std::unique_ptr<Implementation> inner, std::string_view fault);

struct FaultRegistration {
  explicit FaultRegistration(const Fault& fault);
};

}  // namespace evalcts::faults
