// The suite program: a plain GoogleTest program that judges one implementation. The runner starts it as a
// child; any other GoogleTest runner can, too.
#pragma once

#include <functional>
#include <memory>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Puts something around an implementation once it is open; may throw CannotStart.
using Wrapping = std::function<std::unique_ptr<Implementation>(std::unique_ptr<Implementation>)>;

// The whole program: the exit code. Tests are those that are linked to it.
int suite_main(int argc, char** argv, const Wrapping& wrapping = {});

}  // namespace evalcts
