/* A library that replaces a function of the C library and looks for it, which the C library answers by the
 * caller. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <unistd.h>

pid_t getppid(void) { return 0; }

int finds_the_next(void) {
  void* const next = dlsym(RTLD_NEXT, "getppid");
  return next != NULL && next != (void*)getppid;
}
