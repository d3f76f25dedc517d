// Random programs against an implementation in child processes: a library that crashes or hangs costs the
// program in flight, which is a finding like any other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/fuzz/campaign.h>

namespace evalcts::fuzz {

struct SearchRequest {
  std::filesystem::path suite_program;
  ImplementationOptions implementation;
  std::string name;  // of the output
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> programs;  // none: until the time is over
  double seconds = 0;                     // 0: no limit
  int length = 120;
  int jobs = 1;
  bool fresh_contexts = false;  // as of Campaign
  double seconds_per_program = 20;
  std::map<std::string, std::string> known;  // causes, and what each is known as
  std::filesystem::path output;              // an existing folder
};

// All findings with one cause; the smallest program of them stands for all.
struct Cause {
  std::string cause;
  std::string known_as;  // what it is known as, or why it is no matter of evaluators; empty: new
  std::string program;   // "program 17", the first that showed it
  std::string file;      // fuzz-NAME-K.json in the output folder; .txt and .c beside it
  std::size_t times = 0;
  Finding finding;
};

struct SearchResult {
  std::uint64_t programs = 0, commands = 0;
  std::uint64_t judged = 0, in_full = 0;  // programs of which something, or everything, could be observed
  std::uint64_t not_repeated = 0;         // that differed in a shared context only
  std::uint64_t slow = 0;                 // that exceeded the time limit, but not when run again
  double seconds = 0;
  std::vector<Cause> causes;  // in the order of their first programs
  std::string cannot_start;   // why nothing was run; else empty
};

// Runs until programs or time are over or `interrupted` is set, and writes each cause as it is found: a
// replayable program (JSON), the commands as text with what was expected and what came, and, where the
// implementation has one, a stand-alone C program. Throws std::runtime_error where the output cannot be
// written.
SearchResult search(const SearchRequest& request,
                    const std::function<void(const SearchResult& now)>& progress);

}  // namespace evalcts::fuzz
