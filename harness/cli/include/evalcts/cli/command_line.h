// Runs the command line of evalcts.
#pragma once

#include <vector>

#include <evalcts/cli/command.h>

namespace evalcts::cli {

// Runs the one of the commands that the arguments name, and returns the exit code of evalcts. If
// `only_parse`, it is only parsed: returns 0, or 2 after an error message on standard error.
int command_line(int argc, char** argv, const std::vector<Command>& commands, bool only_parse = false);

}  // namespace evalcts::cli
