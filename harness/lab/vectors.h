// Declares the options and the subcommands of `evalcts vectors`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace evalcts::cli {

struct VectorsOptions {
  std::string output;              // folder to write into; empty: the default folder
  std::vector<std::string> files;  // files to read; empty: the shipped files
  std::vector<std::string> kinds;  // kinds of cases for emit and check; empty: all
  bool allow_unobserved = false;   // exit code 0 of check even if most cases were skipped
  std::uint64_t seed = 0;          // seed of random cases
  std::uint64_t count = 0;         // number of random cases of each kind; 0: the shipped cases
};

// Carry out a subcommand and return an exit code.
int write_vectors(const VectorsOptions& options);
int lint_vectors(const VectorsOptions& options);
int emit_vectors(const VectorsOptions& options);
int check_vectors(const VectorsOptions& options);

}  // namespace evalcts::cli
