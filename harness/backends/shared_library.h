// A shared library opened at run time. It stays loaded until the process ends: GL libraries leave threads
// and exit handlers behind.
#pragma once

#include <string>

namespace evalcts {

class SharedLibrary {
 public:
  // `name`: a path or a soname. `in_front`: another one, whose own symbols come before those of this one, as
  // if it had been loaded first (LD_PRELOAD); empty: none. Throws CannotStart with the loader's own words.
  explicit SharedLibrary(const std::string& name, const std::string& in_front = "");

  // A symbol of the library or of one that it depends on; null where there is none.
  void* find(const char* symbol) const;
  template <class Function>
  Function find_as(const char* symbol) const {
    return reinterpret_cast<Function>(find(symbol));
  }
  // A symbol of the library itself.
  void* exported(const char* symbol) const;

  // The file that was loaded; where there is one in front, that.
  std::string path() const;

 private:
  std::string name_;
  void* handle_;
  void* front_ = nullptr;
};

}  // namespace evalcts
