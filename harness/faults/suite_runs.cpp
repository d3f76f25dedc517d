// Starts the suite program that contains the faults and waits for its tests.
#include "suite_runs.h"

#include <fmt/format.h>

#include <fstream>

namespace evalcts::faults {

std::vector<std::string> arguments_of(const ListedFault& fault) {
  return fault.arguments.empty() ? std::vector<std::string>{"--implementation", fault.implementation}
                                 : fault.arguments;
}

WorkerRun run_in_child(const TableRequest& request, const std::string& label,
                       const std::vector<std::string>& arguments, Depth depth,
                       const std::vector<std::string>& tests) {
  std::vector<std::string> command = {request.suite_program.string(), "--depth", name_of(depth),
                                      "--die-with-parent"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Worker worker(command, request.scratch / (label + ".log"), {request.seconds_per_test});
  for (const std::string& test : tests) worker.give({.kind = "test", .name = test});
  worker.finish();
  return worker.wait();
}

}  // namespace evalcts::faults
