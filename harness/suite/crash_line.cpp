// Implements CrashLine.
#include "crash_line.h"

#include <charconv>

#include <evalcts/gl/call_in_flight.h>

namespace evalcts {

void CrashLine::prepare() {
  gl::call_text({gl::EntryPoint::Begin, {std::int64_t{0}}});
  gl::call_text({gl::EntryPoint::Enable, {std::int64_t{0}}});
}

CrashLine::CrashLine() {
  add(R"({"event":"crash","crash":{"call":")");
  const gl::Command* const command = gl::call_in_flight.command;
  if (command) {
    std::array<char, 256> text{};
    add_text({text.data(), gl::write_call(*command, text.data(), text.size())});
  }
  add(R"(","commands_before":)");
  add_number(command ? gl::call_in_flight.position.load() : 0, 10);
  add(R"(,"frames":[)");
}

void CrashLine::add_frame(std::string_view module, std::string_view function, std::uint64_t offset) {
  add(has_frames_ ? R"(",")" : R"(")");
  has_frames_ = true;
  if (module.empty()) return add("code of no file");
  add_text(module);
  if (!function.empty()) add(" ");
  add_text(function);
  add("+0x");
  add_number(offset, 16);
}

std::string_view CrashLine::finish() {
  add(has_frames_ ? R"("]}})" : "]}}");
  add("\n");
  return {text_.data(), length_};
}

void CrashLine::add(std::string_view text) {
  for (const char c : text)
    if (length_ < text_.size()) text_[length_++] = c;
}

// Adds text of unknown origin, without characters that need escapes in JSON.
void CrashLine::add_text(std::string_view text) {
  for (const char c : text)
    if (c >= ' ' && c < 0x7F && c != '"' && c != '\\') add({&c, 1});
}

void CrashLine::add_number(std::uint64_t value, int base) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, base).ptr;
  add({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

}  // namespace evalcts
