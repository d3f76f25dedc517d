#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

#include "harness/cli/commands.h"
#include "vectors/write/write.h"

namespace evalcts::cli {

namespace fs = std::filesystem;

int write_vectors(const VectorsOptions& options) {
  const fs::path folder = options.output.empty() ? places().vectors : fs::path(options.output);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0) {
    std::cerr << fmt::format("evalcts: cannot write into '{}'; choose another folder with --output\n",
                             folder.string());
    return kWrongUse;
  }
  std::size_t cases = 0, bytes = 0;
  try {
    vectors::write_all(folder, [&](const vectors::Written& written) {
      std::cout << fmt::format("{:<12} {:>5} cases {:>9} bytes\n", written.kind, written.cases,
                               written.bytes);
      cases += written.cases;
      bytes += written.bytes;
    });
  } catch (const std::runtime_error& problem) {
    std::cerr << fmt::format("evalcts: {}\n", problem.what());
    return kWrongUse;
  }
  std::cout << fmt::format("{:<12} {:>5} cases {:>9} bytes\nWritten into {}\n", "all", cases, bytes,
                           folder.string());
  return kNothingUnexpected;
}

}  // namespace evalcts::cli
