// Environment variables that other programs set when they start tests.
#pragma once

#include <stdexcept>
#include <string>

namespace evalcts::cli {

// Variables that make no sense; the message says which, and what to do.
struct BadEnvironment : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The part of the tests that GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX ask for, as the "K/N" of --shard; empty
// where they ask for all. Creates GTEST_SHARD_STATUS_FILE, which says that somebody has read them. Throws
// BadEnvironment.
std::string shard_of_environment();

// Removes all that GoogleTest reads: the programs that this one starts are told what to do by their arguments
// alone.
void forget_googletest();

}  // namespace evalcts::cli
