// Sections of errors.json that errors.cpp combines with its own.
#pragma once

#include <evalcts/gl/case.h>
#include "document.h"

namespace evalcts::vectors::errors_of {

// Defines and enables maps of positions in both dimensions.
void ready(gl::Case& c);

void grids(Document& document);
void meshes(Document& document);

}  // namespace evalcts::vectors::errors_of
