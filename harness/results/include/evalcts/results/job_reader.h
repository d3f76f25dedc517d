// Reads the jobs of a worker.
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

}  // namespace evalcts
