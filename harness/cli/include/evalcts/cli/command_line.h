// Runs the command line of evalcts.
#pragma once

namespace evalcts::cli {

// Runs the command in the arguments and returns the exit code of evalcts. If `only_parse`, the command is
// only parsed: returns 0, or 2 after an error message on standard error.
int command_line(int argc, char** argv, bool only_parse = false);

}  // namespace evalcts::cli
