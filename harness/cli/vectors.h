// The commands behind `evalcts vectors`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace evalcts::cli {

struct VectorsOptions {
  std::string output;              // folder to write into; empty: the usual one
  std::vector<std::string> files;  // to look at; empty: those that are shipped
  std::vector<std::string> kinds;  // that are asked in a pipe; empty: all of them
  bool allow_unobserved = false;   // exit code 0 of check although most cases were skipped
  std::uint64_t seed = 0;          // of random cases
  std::uint64_t count = 0;         // random cases of each kind; 0: the shipped cases
};

int write_vectors(const VectorsOptions& options);
int lint_vectors(const VectorsOptions& options);
int emit_vectors(const VectorsOptions& options);
int check_vectors(const VectorsOptions& options);

}  // namespace evalcts::cli
