// Saves and restores state of the process that a library must not change.
#pragma once

#include <string>
#include <vector>

namespace evalcts {

class Surroundings {
 public:
  // Saves the current state.
  Surroundings();

  // Restores the saved state, and stops timers. Returns the names of the parts that had changed: "the working
  // directory", "the locale", "a timer". (The floating-point environment is restored after each case, see
  // gl::play.)
  std::vector<std::string> put_back() const;

 private:
  std::string folder_, locale_;
};

}  // namespace evalcts
