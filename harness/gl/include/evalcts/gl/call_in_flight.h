// Keeps the command that the player is issuing, for the report of a crash.
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

// Writes the name of the command and its leading enumerants, "glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)", so
// that calls that differ in other arguments have the same text. `room` (at least 1) is the size of `text`,
// including the terminating null; longer text is cut. Returns the length without the null. Async-signal-safe
// after its first call.
std::size_t write_call(const Command& command, char* text, std::size_t room);
std::string call_text(const Command& command);

}  // namespace evalcts::gl
