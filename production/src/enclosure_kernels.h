// Double-double for each instruction set.
#pragma once

#include "production/src/enclosure.h"

namespace glev {

// Enclose, with several control points at a time. For maps that have at least three values behind the control
// points of a component.
using Encloses = Enclosure (*)(const Component& component, double largest, const GridArgument& u,
                               const GridArgument& v);

// That of the instruction set of this name, one of Kernels.
Encloses EnclosesOf(const char* name);

}  // namespace glev
