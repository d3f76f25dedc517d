// The command that the player issues, kept for the report of a crash.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// The command of a case that is being issued, and its position; null between cases. Read by a signal handler.
struct CallInFlight {
  std::atomic<const Command*> command = nullptr;
  std::atomic<std::size_t> position = 0;
};
inline CallInFlight call_in_flight;

// Writes the command by its name and its tokens, "glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)", with a null
// behind it: calls that differ in other arguments have the same text. Returns its length. Text that is longer
// than `room`, which is at least 1, is cut. Async-signal-safe once it has been called.
std::size_t write_call(const Command& command, char* text, std::size_t room);
std::string call_text(const Command& command);

}  // namespace evalcts::gl
