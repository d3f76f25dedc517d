// Splits a recording into programs that can be judged one by one: each restores the state of its context and
// then makes commands of one frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/record/recording.h>

namespace evalcts::record {

struct Program {
  std::string name;  // "Frame12/3", the third program of frame 12; "Context2Frame12/3" if there are several
  std::string commands;        // JSON text (gl/case_json.h)
  std::uint64_t vertices = 0;  // that it has to draw
  std::uint64_t times = 1;     // number of programs of the recording that are equal to this one
};

// The frames to judge, from 0.
struct Frames {
  std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max();
};
// Returns the frames of "A..B" or "A"; nothing if the text has another form.
std::optional<Frames> parse_frames(const std::string& text);

// Returns the programs of the recording that use evaluators, in the order of their frames. Equal programs are
// one. A program ends behind a frame, or behind some thousand vertices, where no primitive and no display
// list is open. `progress`: called with the number of commands that were read; may be empty.
std::vector<Program> programs_of(const Recording& recording, const Frames& frames,
                                 const std::function<void(std::uint64_t)>& progress = {});

// Writes the programs into a file for --programs of the suite program: a line for each, with its name, a tab
// and its commands. Throws CannotWrite.
void write_programs(const std::filesystem::path& file, const std::vector<Program>& programs);
// Reads such a file. Throws std::runtime_error. Names and commands are set only.
std::vector<Program> read_programs(const std::filesystem::path& file);

}  // namespace evalcts::record
