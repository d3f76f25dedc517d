// Finds the functions behind those of the recorder.
#pragma once

#include <atomic>

#include "commands.h"

namespace evalcts::record {

// The function that a program calls in place of each function, in the order of Number.
extern void* const kForwarders[kFunctions];

// The functions behind them, as far as they are known.
extern std::atomic<void*> real_functions[kFunctions];

// Returns a function that a program has called. If there is none, ends the process with the message of the
// dynamic linker.
void* find_real(int number);

// Returns a function, or null if none is loaded.
void* find_loaded(int number);

// Returns what a program gets that asks for a function by its name and would get `result`: the function of
// the recorder if this is the one that it has in front of `result`.
void* wrapped(const char* name, void* result);

template <class Function>
inline Function* real(int number) {
  void* address = real_functions[number].load(std::memory_order_relaxed);
  if (__builtin_expect(address == nullptr, 0)) address = find_real(number);
  return reinterpret_cast<Function*>(address);
}

}  // namespace evalcts::record
