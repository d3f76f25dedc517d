// Faults: deliberate defects, one at a time, of an implementation that is sound without them. A suite is as
// good as the defects it catches.
//
// Most are wrappers around entry points, written with EVALCTS_FAULT in wrappers/, one file a section of the
// requirements. What a wrapper cannot do is a mutation of the sources of `production`
// (production/mutations/mutations.json).
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/table.h>
#include <evalcts/results/test_record.h>

namespace evalcts::faults {

// What a fault may change: the entry points, and, for implementations inside this process, what comes out of
// their sink. Entry points are plain functions: a fault sets lambdas without a capture, which call `sound`.
struct Injection {
  gl::Table& gl;
  void (*emitted)(std::vector<ObservedPrimitive>&) = nullptr;
};

struct Fault {
  std::string_view name;
  std::string_view implementation;  // that it is put into: see implementation_kinds(), or one of those below
  Level level;                      // at which a test has to catch it
  std::string_view requirements;    // IDs (or halves, "ID/2-D") with blanks between: each betrayed by a test
  std::string_view what;            // the mistake, in words
  void (*inject)(Injection&);       // null: a mutation of production
};

// The entry points without the fault.
inline gl::Table sound;

// What the wrappers of the active fault remember of the context: all zero in a fresh one.
struct Memory {
  long count = 0;
  bool flag = false;
  double number = 0;
  std::vector<double> numbers;
  std::map<GLenum, long> counts;
};
inline Memory memory;

// Wrappers and mutations, by name.
const std::vector<Fault>& all_faults();

// Implementations for faults in what none at hand has, or follows.
inline constexpr std::string_view kNvVertexProgram = "nv-vertex-program";  // a provider of this build
inline constexpr std::string_view kRepairedOSMesa = "repaired-osmesa";     // see repaired_osmesa.h
inline constexpr std::string_view kOSMesa30 = "osmesa-3.0";  // Mesa's, when asked for that version

// The implementation with the fault; `inner` has to be of the kind that the fault is for. Throws CannotStart
// where there is no such fault.
std::unique_ptr<Implementation> with_fault(std::unique_ptr<Implementation> inner, std::string_view fault);

struct FaultRegistration {
  explicit FaultRegistration(const Fault& fault);
};

// EVALCTS_FAULT(EvalPointOffByOne, production, must, "EV-POINT1-VALUE", "EvalPoint1 takes the next grid
// point") {
//   in.gl.EvalPoint1 = [](GLint i) { sound.EvalPoint1(i + 1); };
// }
#define EVALCTS_FAULT(name, implementation, level, requirements, what) \
  EVALCTS_FAULT_IN(#implementation, name, level, requirements, what)
// The same for an implementation that is no word ("glx-indirect").
#define EVALCTS_FAULT_IN(implementation, name, level, requirements, what)          \
  static void name(::evalcts::faults::Injection& in);                              \
  static const ::evalcts::faults::FaultRegistration name##_registration{           \
      {#name, implementation, ::evalcts::Level::level, requirements, what, name}}; \
  static void name(::evalcts::faults::Injection& in)

}  // namespace evalcts::faults
