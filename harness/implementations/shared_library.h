// A shared library opened at run time. It stays loaded until the process ends: GL libraries leave threads
// and exit handlers behind.
#pragma once

#include <string>

namespace evalcts {

class SharedLibrary {
 public:
  // `name`: a path or a soname. Throws CannotStart with the loader's own words.
  explicit SharedLibrary(const std::string& name);

  // Null where the library exports no such symbol.
  void* find(const char* symbol) const;
  template <class Function>
  Function find_as(const char* symbol) const {
    return reinterpret_cast<Function>(find(symbol));
  }

  // The file that was loaded.
  std::string path() const;

 private:
  std::string name_;
  void* handle_;
};

}  // namespace evalcts
