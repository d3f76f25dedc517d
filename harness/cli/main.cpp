// The program evalcts.
#include <evalcts/cli/command_line.h>

int main(int argc, char** argv) { return evalcts::cli::command_line(argc, argv); }
