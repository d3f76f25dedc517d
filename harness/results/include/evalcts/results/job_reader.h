// The channels of a worker: its jobs, and the events of one that has no file for them.
#pragma once

#include <optional>
#include <string>

namespace evalcts {

// Reads lines of standard input. A library that is opened later gets an empty standard input in its place.
class JobReader {
 public:
  JobReader();
  ~JobReader();
  JobReader(const JobReader&) = delete;
  JobReader& operator=(const JobReader&) = delete;

  // Returns the next line; none at the end.
  std::optional<std::string> next();

 private:
  int descriptor_;
  std::string read_;
};

// Returns another descriptor of standard output, whose place standard error takes, so that what a library
// prints is no event.
int take_standard_output();

// Makes a worker elsewhere read its options from standard input. It is the only option then.
inline constexpr char kRemote[] = "--remote";

}  // namespace evalcts
