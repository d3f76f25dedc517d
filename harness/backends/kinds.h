// Opens implementations other than plain GL libraries. implementation.cpp chooses among all kinds.
#pragma once

#include <memory>
#include <string>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Open the executable specification and the production evaluator, both in this process.
std::unique_ptr<Implementation> open_reference();
std::unique_ptr<Implementation> open_production();
// Opens the drop-in library in front of libOSMesa, libEGL or libGL. `library`: its path; empty: that of this
// build. Throws CannotStart.
std::unique_ptr<Implementation> open_dropin(const std::string& name, const std::string& library);
// Opens a sink, a shared library that implements evalcts_sink.h. Throws CannotStart.
std::unique_ptr<Implementation> open_sink(const std::string& path);

}  // namespace evalcts
