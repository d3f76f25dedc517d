// Runs evalcts on the drill library, which misbehaves on command (drills/drill_library.cpp).
#pragma once

#include <cstdlib>

#include "program.h"

namespace evalcts {

// The test that defines INDEX with order 5, and the part of a filter that excludes display lists, which the
// drill libraries do not support.
inline constexpr char kVictim[] = "Map1State.Stride/MAP1_INDEX_f";
inline constexpr char kWithoutLists[] = ":-*/Compiled:*/Executed:*/Nested:*/Repeated:*/Split";

class DrillTest : public ProgramTest {
 protected:
  DrillTest() { setenv("EVALCTS_DRILL_FILE", drill_file().c_str(), 1); }
  ~DrillTest() override { unsetenv("EVALCTS_DRILL_FILE"); }

  std::filesystem::path drill_file() const { return folder_ / "drill-file"; }

  // Sets the misbehaviour `what` and returns the arguments of `evalcts run` on the drill library.
  std::vector<std::string> drill_arguments(const std::string& what,
                                           std::vector<std::string> more = {}) const {
    setenv("EVALCTS_DRILL", what.c_str(), 1);
    std::vector<std::string> arguments = {
        "run",   "--implementation", "osmesa",         "--library", DRILL_LIBRARY, "--name",
        "drill", "--output",         folder_.string(), "--depth",   "thorough",    "--allow-unobserved"};
    if (more.empty())
      more = {"--filter",
              std::string("Map1State.Stride/*:Map1State.SmallestStride/*:InitialState.O*") + kWithoutLists};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Outcome drill(const std::string& what, const std::vector<std::string>& more = {}) {
    return evalcts(drill_arguments(what, more));
  }
};

}  // namespace evalcts
