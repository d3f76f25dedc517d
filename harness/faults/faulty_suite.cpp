// The suite program with faults: the implementation under test has the one that --fault names. --list-faults
// FILE writes all of them as JSON.
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/faults/fault.h"
#include "harness/runner/suite_main.h"

namespace {

// The provider of a stand-in; empty for any other implementation.
std::string_view context_of(std::string_view implementation) {
  return implementation == evalcts::faults::kNvVertexProgram ? NV_VERTEX_PROGRAM_PROVIDER : "";
}

void list_faults(const char* file) {
  nlohmann::json all = nlohmann::json::array();
  for (const evalcts::faults::Fault& fault : evalcts::faults::all_faults())
    all.push_back({{"name", fault.name},
                   {"implementation", fault.implementation},
                   {"context", context_of(fault.implementation)},
                   {"level", evalcts::name_of(fault.level)},
                   {"requirements", fault.requirements},
                   {"what", fault.what},
                   {"kind", fault.inject ? "wrapper" : "switch"}});
  std::ofstream(file) << nlohmann::json{{"faults", all}}.dump(1) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  std::string fault;
  std::vector<char*> rest;  // what the suite program itself knows
  for (int i = 0; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (has_value && std::strcmp(argv[i], "--list-faults") == 0) {
      list_faults(argv[i + 1]);
      return 0;
    }
    if (has_value && std::strcmp(argv[i], "--fault") == 0)
      fault = argv[++i];
    else
      rest.push_back(argv[i]);
  }
  rest.push_back(nullptr);
  return evalcts::suite_main(static_cast<int>(rest.size()) - 1, rest.data(),
                             [&](std::unique_ptr<evalcts::Implementation> implementation) {
                               return fault.empty()
                                          ? std::move(implementation)
                                          : evalcts::faults::with_fault(std::move(implementation), fault);
                             });
}
