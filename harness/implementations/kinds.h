// The ways to make an implementation; implementation.cpp chooses between them.
#pragma once

#include <memory>
#include <string>

#include "harness/implementations/implementation.h"

namespace evalcts {

// Mesa's off-screen library: entry points and contexts from `library`, or from the usual soname where empty.
std::unique_ptr<Implementation> open_osmesa(const std::string& library);
// The executable specification and the production evaluator, both in this process.
std::unique_ptr<Implementation> open_reference();
std::unique_ptr<Implementation> open_production();

}  // namespace evalcts
