// Requests of an indirect GLX context ("GLX Extensions For OpenGL Protocol Specification" 1.3, GLXenc), read
// back from the requests of a case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

using Bytes = std::vector<std::uint8_t>;

// A GL command behind its length and opcode: a rendering command (section 2.3), or a request of its own
// behind its context tag (section 2.2).
struct SentCommand {
  unsigned opcode;
  bool rendering;
  bool in_parts = false;  // RenderLarge
  Bytes parameters;

  bool operator==(const SentCommand& other) const {
    return opcode == other.opcode && rendering == other.rendering && parameters == other.parameters;
  }
};

// The commands that belong to evaluators, in their order: maps, grids and evaluation (143 to 158), GetMap
// (120 to 122). Throws std::runtime_error with words about requests that break sections 2.2, 2.3.1 or 2.3.2.
std::vector<SentCommand> evaluator_commands(const Bytes& requests);

// "Map1f (144): 90 0d 00 00 | ..." for the reader.
std::string in_words(const std::vector<SentCommand>& commands);

// The parameters of a command, one behind the other (GLXenc 1.4: the types and their sizes).
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
