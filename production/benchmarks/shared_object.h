// A library that is opened at run time, so that the benchmarks are not linked to a GL. It is never closed.
#pragma once

#include <dlfcn.h>

#include <stdexcept>

namespace evalcts::bench {

class SharedObject {
 public:
  // Throws std::runtime_error with the message of the loader.
  explicit SharedObject(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_) throw std::runtime_error(dlerror());
  }
  template <class Function>
  Function find(const char* symbol) const {
    void* const address = dlsym(handle_, symbol);
    if (!address) throw std::runtime_error(dlerror());
    return reinterpret_cast<Function>(address);
  }

 private:
  void* handle_;
};

}  // namespace evalcts::bench
