// Implements the functions on the process, for Linux.
#include "process.h"

#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include <evalcts/runner/child_process.h>

namespace evalcts {

void prepare_process() {
  // Mesa allocates the same large blocks for each context. To return them to the system in between takes a
  // sixth of the time of a run.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);  // crashes of the library under test leave no core dumps
  std::signal(SIGXFSZ, SIG_IGN);     // a file that becomes too large must not count as a crash of the library
}

void prepare_worker() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::ofstream("/proc/self/oom_score_adj") << 1000;
}

std::uint64_t own_memory() { return resident_memory(getpid()); }

std::string start_again(char** arguments) {
  execv("/proc/self/exe", arguments);
  return std::strerror(errno);
}

}  // namespace evalcts
