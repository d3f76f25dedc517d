// Makes the members of cases about automatic normals (INTERPRETING.md, "Automatic normals").
#pragma once

#include <reference/component.h>

#include "document.h"
#include "values.h"

namespace evalcts::vectors {

// Returns {"m", "normal", "accept"}.
Json entry_of(const reference::AutomaticNormal& normal);

// Returns {"level", "map", "u", "v", "derivatives"} and the members above. `problem` has a v.
Json normal_case(const Problem& problem);

}  // namespace evalcts::vectors
