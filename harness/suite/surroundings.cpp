// Implements Surroundings: restores the working directory and the locale, and stops timers.
#include "surroundings.h"

#include <clocale>
#include <filesystem>
#ifndef _WIN32
#include <sys/time.h>
#endif

namespace evalcts {
namespace {

std::string working_directory() {
  std::error_code unknown;
  return std::filesystem::current_path(unknown).string();
}

}  // namespace

Surroundings::Surroundings() : folder_(working_directory()), locale_(std::setlocale(LC_ALL, nullptr)) {}

std::vector<std::string> Surroundings::put_back() const {
  std::vector<std::string> changed;
  if (working_directory() != folder_) {
    std::error_code error;
    std::filesystem::current_path(folder_, error);
    if (!error) changed.emplace_back("the working directory");
  }
  if (std::setlocale(LC_ALL, nullptr) != locale_) {
    std::setlocale(LC_ALL, locale_.c_str());
    changed.emplace_back("the locale");
  }
#ifndef _WIN32
  for (const auto timer : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) {
    const itimerval none{};
    itimerval running{};
    if (setitimer(timer, &none, &running) == 0 && (running.it_value.tv_sec || running.it_value.tv_usec))
      changed.emplace_back("a timer");
  }
#endif
  return changed;
}

}  // namespace evalcts
