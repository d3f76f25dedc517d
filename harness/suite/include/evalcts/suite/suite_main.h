// The suite program: an ordinary GoogleTest program that judges one implementation. The runner starts it as a
// worker; other runners for GoogleTest can start it, too.
#pragma once

#include <functional>
#include <memory>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Returns an implementation that wraps the opened one. May throw CannotStart.
using Wrapping = std::function<std::unique_ptr<Implementation>(std::unique_ptr<Implementation>)>;

// Runs the program with the tests that are linked to it, and returns the exit code.
int suite_main(int argc, char** argv, const Wrapping& wrapping = {});

}  // namespace evalcts
