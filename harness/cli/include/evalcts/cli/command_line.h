// The command line of evalcts: from arguments to what is done, and to an exit code.
#pragma once

namespace evalcts::cli {

// `only_parse`: nothing is done but to say whether it could be: 0, or 2 with words on standard error.
int command_line(int argc, char** argv, bool only_parse = false);

}  // namespace evalcts::cli
