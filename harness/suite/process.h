// Changes that the suite program makes to its own process.
#pragma once

#include <cstdint>
#include <string>

namespace evalcts {

// Prepares the process for libraries that leak memory and crash.
void prepare_process();
// Makes this process, a worker, end with the one that started it, and before others if memory runs out.
void prepare_worker();
// Returns the memory of this process in bytes; 0 if it is not known.
std::uint64_t own_memory();
// Starts this program again with the environment that it has now. Returns the reason if that fails.
std::string start_again(char** arguments);

}  // namespace evalcts
