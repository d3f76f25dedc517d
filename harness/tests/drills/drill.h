// Selects the deliberate mistake of a test library by the environment variable EVALCTS_DRILL.
#pragma once

#include <cstdlib>
#include <cstring>

// Returns true if EVALCTS_DRILL is `name`.
inline bool is_drill(const char* name) {
  const char* wanted = std::getenv("EVALCTS_DRILL");
  return wanted && std::strcmp(wanted, name) == 0;
}
