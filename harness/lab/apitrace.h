// Reads the traces of apitrace (https://apitrace.github.io), and makes recordings of them.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <evalcts/record/writer.h>

namespace evalcts::lab {

// Thrown if a file is not a trace that can be read. what() says what to do.
struct BadTrace : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns true if the file begins like a trace of apitrace.
bool is_trace(const std::filesystem::path& file);

// A trace as a recording: all commands that `evalcts record` records, with the bits of all numbers. Other
// commands of the GL are counted. Frames end where buffers are swapped.
struct Imported {
  record::RecordingWriter recording;
  std::string problem;  // a sentence about the missing part of the file; empty if nothing is missing
};
// Throws BadTrace.
Imported import_trace(const std::filesystem::path& file);

}  // namespace evalcts::lab
