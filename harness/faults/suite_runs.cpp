// Starts the suite program that contains the faults and waits for its tests.
#include "suite_runs.h"

#include <fmt/format.h>

#include <fstream>

namespace evalcts::faults {

std::vector<std::string> arguments_of(const ListedFault& fault) {
  return fault.arguments.empty() ? std::vector<std::string>{"--implementation", fault.implementation}
                                 : fault.arguments;
}

ChildRun run_in_child(const TableRequest& request, const std::string& label,
                      const std::vector<std::string>& arguments, Depth depth,
                      const std::vector<std::string>& tests) {
  constexpr double kLook = 0.01;  // interval, in seconds, at which the child is checked
  namespace fs = std::filesystem;
  const fs::path list = request.scratch / (label + ".txt"), events = request.scratch / (label + ".jsonl");
  std::ofstream stream(list);
  for (const std::string& test : tests) stream << test << '\n';
  if (!stream.flush()) throw std::runtime_error(fmt::format("cannot write '{}'", list.string()));
  fs::remove(events);
  std::vector<std::string> command = {request.suite_program.string(),
                                      "--depth",
                                      name_of(depth),
                                      "--tests",
                                      list.string(),
                                      "--records",
                                      events.string(),
                                      "--die-with-parent",
                                      "--gtest_brief=1"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  SuiteChild child(command, events, request.scratch / (label + ".log"), {request.seconds_per_test});
  while (!child.look(kLook)) continue;
  return child.run();
}

}  // namespace evalcts::faults
