// Reads the evaluator commands from the requests that a case with an indirect GLX context sent ("GLX
// Extensions For OpenGL Protocol Specification" 1.3, and its encoding document GLXenc).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

using Bytes = std::vector<std::uint8_t>;

// A GL command: a rendering command (section 2.3), or a request of its own (section 2.2). `parameters`: the
// bytes after length and opcode, or after the context tag.
struct SentCommand {
  unsigned opcode;
  bool rendering;
  bool in_parts = false;  // true if RenderLarge carried it
  Bytes parameters;

  bool operator==(const SentCommand& other) const {
    return opcode == other.opcode && rendering == other.rendering && parameters == other.parameters;
  }
};

// Returns the evaluator commands of the requests in their order: maps, grids and evaluation (opcodes 143 to
// 158), and GetMap (120 to 122). Throws std::runtime_error if requests violate sections 2.2, 2.3.1 or 2.3.2.
std::vector<SentCommand> evaluator_commands(const Bytes& requests);

// Returns the commands as text, as in "Map1f (144), 40 bytes: 90 0d 00 00 ...".
std::string in_words(const std::vector<SentCommand>& commands);

// Encodes the parameters of a command one after the other in the byte order of the machine (types:
// GLXenc 1.4).
class Wire {
 public:
  Wire& card32(std::uint32_t value) { return put(value); }
  Wire& int32(std::int32_t value) { return put(value); }
  Wire& float32(float value) { return put(value); }
  Wire& float64(double value) { return put(value); }
  // Appends values as floats or as doubles.
  Wire& reals(const std::vector<double>& values, bool doubles) {
    for (const double value : values) doubles ? float64(value) : float32(static_cast<float>(value));
    return *this;
  }
  Bytes bytes() const { return bytes_; }

 private:
  template <class T>
  Wire& put(T value) {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof value);
    return *this;
  }

  Bytes bytes_;
};

}  // namespace evalcts
