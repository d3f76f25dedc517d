// OSMesa (or the same Mesa through EGL, see faulty_suite.cpp) without those of its own defects for which a
// rule would have no correct implementation to put a fault into, `dropin` included: edge flags of filled
// meshes, and CopyContext. Wrappers do what the rule says, in the commands that the plain deliveries of its
// tests use. A test counts on it only where it passes.
#pragma once

#include <memory>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/table.h>

namespace evalcts::faults {

std::unique_ptr<Implementation> repaired_osmesa(std::unique_ptr<Implementation> osmesa);

}  // namespace evalcts::faults
