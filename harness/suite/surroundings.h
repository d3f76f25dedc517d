// State that all code in a process shares and a library must leave alone: remembered, and put back.
#pragma once

#include <string>
#include <vector>

namespace evalcts {

class Surroundings {
 public:
  // Remembers the present state.
  Surroundings();

  // Puts back what has changed since, and says what that was: "the working directory", "the locale", "a
  // timer". (The floating-point environment is put back after each case, see gl::play.)
  std::vector<std::string> put_back() const;

 private:
  std::string folder_, locale_;
};

}  // namespace evalcts
