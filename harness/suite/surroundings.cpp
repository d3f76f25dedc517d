// Implements Surroundings: restores the working directory and the locale, and stops timers.
#include "surroundings.h"

#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <clocale>

namespace evalcts {
namespace {

std::string working_directory() {
  std::array<char, PATH_MAX> path{};
  return getcwd(path.data(), path.size()) ? path.data() : "";
}

}  // namespace

Surroundings::Surroundings() : folder_(working_directory()), locale_(std::setlocale(LC_ALL, nullptr)) {}

std::vector<std::string> Surroundings::put_back() const {
  std::vector<std::string> changed;
  if (working_directory() != folder_ && chdir(folder_.c_str()) == 0)
    changed.emplace_back("the working directory");
  if (std::setlocale(LC_ALL, nullptr) != locale_) {
    std::setlocale(LC_ALL, locale_.c_str());
    changed.emplace_back("the locale");
  }
  for (const auto timer : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) {
    const itimerval none{};
    itimerval running{};
    if (setitimer(timer, &none, &running) == 0 && (running.it_value.tv_sec || running.it_value.tv_usec))
      changed.emplace_back("a timer");
  }
  return changed;
}

}  // namespace evalcts
