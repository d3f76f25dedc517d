// Converts GTEST_SHARD_INDEX and GTEST_TOTAL_SHARDS to the form of --shard, and prepares the environment of
// the programs that evalcts starts.
#include "environment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <vector>

#include <evalcts/results/run_result.h>

extern char** environ;

namespace evalcts::cli {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::string shard_of_environment() {
  const std::string total = variable("GTEST_TOTAL_SHARDS"), index = variable("GTEST_SHARD_INDEX");
  if (const std::string file = variable("GTEST_SHARD_STATUS_FILE"); !file.empty())
    std::ofstream(file, std::ios::app);
  if (total.empty() && index.empty()) return {};
  // GTEST_SHARD_INDEX counts from 0.
  const bool is_number = !index.empty() && index.find_first_not_of("0123456789") == std::string::npos;
  const std::string shard =
      is_number && index.size() < 10 ? fmt::format("{}/{}", std::stoul(index) + 1, total) : "";
  if (!Shard::parse(shard, "/"))
    throw BadEnvironment(
        fmt::format("GTEST_SHARD_INDEX='{}' is not in the range of GTEST_TOTAL_SHARDS='{}': unset both, or "
                    "use --shard K/N",
                    index, total));
  return total == "1" ? "" : shard;
}

void forget_googletest() {
  std::vector<std::string> names = {"XML_OUTPUT_FILE", "TESTBRIDGE_TEST_ONLY", "TEST_PREMATURE_EXIT_FILE"};
  for (char** entry = environ; *entry; ++entry)
    if (const std::string text = *entry; text.starts_with("GTEST_"))
      names.push_back(text.substr(0, text.find('=')));
  for (const std::string& name : names) unsetenv(name.c_str());
}

void allocate_in_huge_pages() { setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 0); }

}  // namespace evalcts::cli
