// Reads the environment variables by which test runners, such as Bazel, control GoogleTest, and sets those of
// the programs that evalcts starts.
#pragma once

#include <stdexcept>
#include <string>

namespace evalcts::cli {

// Thrown if the variables are invalid. The message states their values and what to do.
struct BadEnvironment : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the part of the tests that GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX select, as "K/N" for --shard;
// empty if they select all tests. Creates GTEST_SHARD_STATUS_FILE, which tells the caller that sharding is
// supported. Throws BadEnvironment.
std::string shard_of_environment();

// Removes all environment variables that GoogleTest reads, so that they do not affect the suite programs that
// evalcts starts.
void forget_googletest();

// Lets the suite programs allocate memory in huge pages, unless GLIBC_TUNABLES is set: contexts of Mesa
// allocate many megabytes each, and a tenth of the time of a run is spent on page faults.
void allocate_in_huge_pages();

}  // namespace evalcts::cli
