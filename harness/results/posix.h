// The functions of POSIX that a worker uses, on Windows as well.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef _WIN32
#include <io.h>
#include <windows.h>
// After windows.h.
#include <shlwapi.h>
// Ignores the case of letters, unlike the function of POSIX. A worker gets names of tests, not patterns.
constexpr int FNM_NOESCAPE = 0, FNM_EXTMATCH = 0;
inline int fnmatch(const char* pattern, const char* name, int) {
  return PathMatchSpecA(name, pattern) ? 0 : 1;
}
constexpr int O_CLOEXEC = _O_NOINHERIT | _O_BINARY;
inline int fsync(int descriptor) { return _commit(descriptor); }
#else
#include <fnmatch.h>
#endif

namespace evalcts {

#ifdef _WIN32
inline constexpr char kNoFile[] = "NUL";
#else
inline constexpr char kNoFile[] = "/dev/null";
#endif

// Returns a duplicate of the descriptor that child processes do not inherit, and that a library hardly
// closes. Negative: there is none.
inline int duplicate(int descriptor) {
#ifdef _WIN32
  const int copy = _dup(descriptor);
  _setmode(copy, _O_BINARY);
  return copy;
#else
  constexpr int kFirst = 100;
  return fcntl(descriptor, F_DUPFD_CLOEXEC, kFirst);
#endif
}

}  // namespace evalcts
