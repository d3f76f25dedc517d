// The parts of `evalcts ulp`.
#pragma once

#include <string>

#include "harness/cli/commands.h"
#include "harness/implementations/implementation.h"

namespace evalcts::cli {

// The one implementation of the options.
ImplementationOptions implementation_of(const UlpOptions& options);
// Why the orders and control points that were given are none; empty where they are good: floats, as many as
// the orders say.
std::string wrong_points(const UlpOptions& options);
// Every float of an interval.
int sweep(const UlpOptions& options);
// The shards of a sweep together.
int merge(const UlpOptions& options);
// One line for many results.
int digest(const UlpOptions& options);

}  // namespace evalcts::cli
