// Runs the suite program with faults or variations.
#pragma once

#include <string>
#include <vector>

#include <evalcts/faults/fault_table.h>
#include <evalcts/runner/suite_child.h>

namespace evalcts::faults {

// Returns the arguments that make the suite program open the implementation of the fault.
std::vector<std::string> arguments_of(const ListedFault& fault);

// Runs the tests in this order in one child process with these arguments. The run ends early if a test kills
// the process. The names of files in the scratch folder begin with `label`.
ChildRun play_in_child(const TableRequest& request, const std::string& label,
                       const std::vector<std::string>& arguments, Depth depth,
                       const std::vector<std::string>& tests);

}  // namespace evalcts::faults
