// Deliberate defects, for testing the tests. A normal build has none of them: GLEV_FAULTY is false there.
//
// faults.def lists them. A build with GLEV_FAULTS defined has all of them, at most one of which is active.
#pragma once

#ifdef GLEV_FAULTS

namespace glev {

enum class Fault : int {
  kNone,
#define GLEV_FAULT(name, level, requirements, what) k##name,
#include "production/src/faults.def"
#undef GLEV_FAULT
};

inline Fault active_fault = Fault::kNone;

// With a fault values are those of plain double, so that no later route makes up for it.
inline bool IsPlain() { return active_fault != Fault::kNone; }

}  // namespace glev

// Whether the fault of that name is the active one.
#define GLEV_FAULTY(name) (::glev::active_fault == ::glev::Fault::k##name)

#else

#define GLEV_FAULTY(name) false

namespace glev {
constexpr bool IsPlain() { return false; }
}  // namespace glev

#endif
