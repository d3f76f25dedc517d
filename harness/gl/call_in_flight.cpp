// Formats the command that is being issued without allocating memory, because a signal handler calls it.
#include <evalcts/gl/call_in_flight.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include <evalcts/gl/tokens.h>

namespace evalcts::gl {
namespace {

// Appends to an array of characters, as long as there is room.
class BoundedText {
 public:
  BoundedText(char* text, std::size_t room) : text_(text), room_(room) {}

  void add(std::string_view more) {
    const std::size_t count = std::min(more.size(), room_ - 1 - length_);
    std::memcpy(text_ + length_, more.data(), count);
    length_ += count;
  }
  void add_hexadecimal(GLenum value) {
    char digits[2 + 8] = {'0', 'x'};
    for (int i = 0; i < 8; ++i) digits[2 + i] = "0123456789ABCDEF"[value >> (28 - 4 * i) & 0xFU];
    add({digits, sizeof digits});
  }
  std::size_t end() {
    text_[length_] = '\0';
    return length_;
  }

 private:
  char* text_;
  std::size_t room_, length_ = 0;
};

}  // namespace

std::size_t write_call(const Command& command, char* text, std::size_t room) {
  BoundedText writer(text, room);
  writer.add(name_of(command.entry));
  writer.add("(");
  const std::string_view kinds = parameter_kinds(command.entry);
  std::size_t tokens = 0;
  for (; tokens < kinds.size() && (kinds[tokens] == 'e' || kinds[tokens] == 'm'); ++tokens) {
    if (tokens > 0) writer.add(", ");
    const auto* const value = std::get_if<std::int64_t>(&command.arguments[tokens]);
    const auto token = static_cast<GLenum>(value ? *value : 0);
    const char* const name = kinds[tokens] == 'm' ? known_primitive(token) : known_token(token);
    if (name)
      writer.add(name);
    else
      writer.add_hexadecimal(token);
  }
  if (tokens < kinds.size()) writer.add(tokens > 0 ? ", ..." : "...");
  writer.add(")");
  return writer.end();
}

std::string call_text(const Command& command) {
  std::array<char, 256> text{};
  return {text.data(), write_call(command, text.data(), text.size())};
}

}  // namespace evalcts::gl
