// Searches for bugs by random programs, which workers run on an implementation. A crash or hang of
// the library affects only the running program, and is a finding like any other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

struct SearchRequest {
  std::filesystem::path suite_program;
  ImplementationOptions implementation;
  std::string name;  // part of the names of output files
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> programs;  // none: until the time is over
  double seconds = 0;                     // time limit; 0: none
  int length = 120;
  int jobs = 1;
  bool fresh_contexts = false;  // see RandomJob::in_fresh_context
  double seconds_per_program = 20;
  std::filesystem::path output;  // an existing folder
};

// All findings with one cause, or of one known bug, which the first of them represents.
struct Cause {
  std::string cause;     // Finding::cause, or the ID of the known bug
  std::string known_as;  // ID of the known bug, or the reason why evaluators are not at fault; empty: new
  std::string program;   // "program 17", the first program with this cause
  std::string file;      // fuzz-NAME-K.json in the output folder; there are .txt and .c files of this name
  std::size_t times = 0;
  Finding finding;
};

struct SearchResult {
  std::uint64_t programs = 0, commands = 0;
  std::uint64_t judged = 0, in_full = 0;  // programs of which some, or all, effects could be observed
  std::uint64_t not_repeated = 0;         // programs that differed only in a shared context
  std::uint64_t slow = 0;                 // programs that exceeded the time limit, but not when repeated
  double seconds = 0;
  double seconds_of_known = 0;  // time of all processes spent on differences without a new cause
  std::vector<Cause> causes;    // in the order of their first programs
  std::string cannot_start;     // the reason if no program was run; otherwise empty
};

// Runs until all programs have run, the time is over or `interrupted` is set. When a cause is found, writes
// its program as JSON for replays, the commands as text with the expected and captured results, and, if the
// implementation supports it, a stand-alone C program. Throws std::runtime_error if the output cannot be
// written, or for an internal error of the suite program.
SearchResult search(const SearchRequest& request,
                    const std::function<void(const SearchResult& now)>& progress);

}  // namespace evalcts::fuzz
