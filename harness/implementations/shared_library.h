// A shared library opened at run time. It stays loaded until the process ends: GL libraries leave threads
// and exit handlers behind.
#pragma once

#include <string>

namespace evalcts {

class SharedLibrary {
 public:
  // `name`: a path or a soname. Throws CannotStart with the loader's own words.
  explicit SharedLibrary(const std::string& name);

  // A symbol of the library or of one that it depends on; null where there is none.
  void* find(const char* symbol) const;
  template <class Function>
  Function find_as(const char* symbol) const {
    return reinterpret_cast<Function>(find(symbol));
  }
  // A symbol of the library itself.
  void* exported(const char* symbol) const;

  // The file that was loaded.
  std::string path() const;

 private:
  std::string name_;
  void* handle_;
};

}  // namespace evalcts
