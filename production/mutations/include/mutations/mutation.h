// The switch of the mutated library, which tests of the tests link instead of the original library.
// mutations.json lists the mutations. At most one is active at a time.
#pragma once

#include <cstdlib>

namespace glev {

// Number of the active mutation, counted from 1 in the order of mutations.json; 0 is the unmodified library.
// Programs may set it before they create a context. The environment variable GLEV_MUTATION sets it from
// outside.
inline int active_mutation = [] {
  const char* number = std::getenv("GLEV_MUTATION");
  return number == nullptr ? 0 : std::atoi(number);
}();

// Memory that the places of a mutation share.
inline int mutation_memory[256] = {};

// True if both are the same method.
template <auto kOne, auto kOther>
inline constexpr bool kAreSame = false;
template <auto kMethod>
inline constexpr bool kAreSame<kMethod, kMethod> = true;

inline bool mutation_is(int number) { return active_mutation == number; }

}  // namespace glev
