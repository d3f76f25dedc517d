// Judges the evaluator commands of a recorded program on implementations.
#pragma once

#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/record/programs.h>

namespace evalcts::cli {

struct RecordingCheck {
  std::string file;
  std::vector<ImplementationOptions> implementations;
  record::Frames frames;
  std::string output;  // empty: a new folder
  double seconds_per_test = 0;
  std::string command, program;  // see RunRequest
};

// The outcome of a check, an exit code of `git bisect run`: kBad if any implementation is wrong.
enum class CheckOutcome { kGood = 0, kBad = 1, kCannotBeJudged = 125 };

// Judges the programs of the recording on each implementation, prints what is wrong, and writes results and
// pages as `evalcts run` does. Throws BadRecording, CannotStart or CannotWrite.
CheckOutcome check_recording(const RecordingCheck& check);

}  // namespace evalcts::cli
