// Reads the environment variables by which test runners, such as Bazel, control GoogleTest.
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

}  // namespace evalcts::cli
