// Makes recordings of the traces of apitrace (https://apitrace.github.io).
#pragma once

#include <filesystem>
#include <string>

#include <evalcts/record/writer.h>
#include "trace_reader.h"

namespace evalcts::lab {

// A trace as a recording: all commands that `evalcts record` records, with the bits of all numbers. Other
// commands of the GL are counted. Frames end where buffers are swapped.
struct ImportedTrace {
  record::RecordingWriter recording;
  std::string problem;  // a sentence about the missing part of the file; empty if nothing is missing
};
// Throws BadTrace.
ImportedTrace import_trace(const std::filesystem::path& file);

}  // namespace evalcts::lab
