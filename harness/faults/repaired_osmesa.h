// Repairs OSMesa (or Mesa through EGL, see faulty_suite.cpp) where no available implementation, not even
// `dropin`, satisfies a requirement, so that faults against this requirement can be injected: edge flags of
// filled meshes, and CopyContext. Wrappers implement the requirement for the commands that the plain
// deliveries of its tests use. Only tests that pass on the repaired implementation count.
#pragma once

#include <memory>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/table.h>

namespace evalcts::faults {

// Returns OSMesa with the repairs.
std::unique_ptr<Implementation> repaired_osmesa(std::unique_ptr<Implementation> osmesa);

}  // namespace evalcts::faults
