// Implements the functions on the process, for Windows.
#include "process.h"

#include <windows.h>
// After windows.h.
#include <psapi.h>

namespace evalcts {

void prepare_process() {}
void prepare_worker() {}

std::uint64_t own_memory() {
  PROCESS_MEMORY_COUNTERS memory{};
  return GetProcessMemoryInfo(GetCurrentProcess(), &memory, sizeof memory) ? memory.WorkingSetSize : 0;
}

std::string start_again(char**) { return "not available on Windows"; }

}  // namespace evalcts
