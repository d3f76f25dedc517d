// Statements of the vectors on automatic normals (INTERPRETING.md, "Automatic normals").
#pragma once

#include <reference/component.h>

#include "document.h"

namespace evalcts::vectors {

// {"m", "normal", "accept"}.
Json entry_of(const reference::AutomaticNormal& normal);

// {"derivatives": {"u", "v"}}.
Json derivatives_of(const reference::AutomaticNormal& normal);

}  // namespace evalcts::vectors
