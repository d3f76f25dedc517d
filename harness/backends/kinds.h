// The implementations that are no GL library; implementation.cpp chooses between all.
#pragma once

#include <memory>
#include <string>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// The executable specification and the production evaluator, both in this process.
std::unique_ptr<Implementation> open_reference();
std::unique_ptr<Implementation> open_production();
// The drop-in library, `library` or that of this build where empty, in front of libOSMesa, libEGL or libGL.
// Throws CannotStart.
std::unique_ptr<Implementation> open_dropin(const std::string& name, const std::string& library);
// A shared library that fills in evalcts_sink.h. Throws CannotStart.
std::unique_ptr<Implementation> open_sink(const std::string& path);

}  // namespace evalcts
