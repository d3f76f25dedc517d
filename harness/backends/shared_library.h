// A shared library opened at run time. It stays loaded until the process ends: GL libraries leave threads
// and exit handlers behind.
#pragma once

#include <string>
#include <vector>

namespace evalcts {

class SharedLibrary {
 public:
  // `name`: a path or a soname. `in_front`: another library whose symbols precede those of this one, as if it
  // had been loaded first (LD_PRELOAD); empty: none. Throws CannotStart with the loader's message.
  explicit SharedLibrary(const std::string& name, const std::string& in_front = "");

  // Returns a symbol of the library or of a dependency; null if there is none.
  void* find(const char* symbol) const;
  template <class Function>
  Function find_as(const char* symbol) const {
    return reinterpret_cast<Function>(find(symbol));
  }
  // Returns a symbol of the library itself; null if there is none.
  void* exported(const char* symbol) const;

  // Returns the loaded file, or the library in front if there is one.
  std::string path() const;

 private:
  std::string name_;
  void* handle_;
  void* front_ = nullptr;
};

// Returns the paths of the libraries that this process has loaded.
std::vector<std::string> loaded_libraries();

}  // namespace evalcts
