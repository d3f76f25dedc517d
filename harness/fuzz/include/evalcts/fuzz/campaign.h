// The options with which random programs are judged on one implementation, in one process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace evalcts::fuzz {

struct Campaign {
  std::uint32_t first = 0;                // number of the first program
  std::uint32_t step = 1;                 // difference between the numbers of successive programs
  std::optional<std::uint32_t> programs;  // number of programs; none: until the time is over
  double seconds = 0;                     // time limit; 0: none
  int length = 120;                       // approximate number of commands of a program
  int most_attempts = 400;                // maximum number of candidates for the reduction of a program
  // File to which each candidate of a reduction is written before it runs, so that the candidate is known if
  // the library dies in it. The file is empty at other times. An empty name means no file.
  std::string in_flight = {};
  std::vector<std::string> deadly = {};  // candidates (JSON) in which the library has died; not run again
  // True: each program has its own context. False: most programs share a context, if the implementation can
  // create it beside others. Creating a context and its shaders takes most of the time of a program. A
  // difference in the shared context must be reproduced in a fresh context, alone or after some of the
  // earlier programs.
  bool fresh_contexts = false;
};

}  // namespace evalcts::fuzz
