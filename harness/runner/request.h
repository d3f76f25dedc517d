// Derives the header of a result and shell commands from the request of a run.
#pragma once

#include <string>
#include <vector>

#include <evalcts/runner/runner.h>

namespace evalcts {

// Returns a result with everything that is known before the first test.
RunResult header_of(const RunRequest& request);

// Returns the suite program and its options.
std::vector<std::string> suite_command(const RunRequest& request);

// Adds shell commands to a failure: run this test alone, run it in a debugger, and write it as a C program.
void add_commands(const RunRequest& request, TestRecord& record);

}  // namespace evalcts
