// Tests the parser of GLX requests on hand-made requests.
#include "glx_requests.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

namespace evalcts {
namespace {

constexpr std::uint8_t kMajor = 150;

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

template <class T>
Bytes number(T value) {
  Bytes bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}
Bytes card16(unsigned value) { return number(static_cast<std::uint16_t>(value)); }
Bytes card32(std::size_t value) { return number(static_cast<std::uint32_t>(value)); }

// Encodes a request of the GLX extension. `body` begins with the context tag.
Bytes request(unsigned opcode, const Bytes& body) {
  return Bytes{kMajor, static_cast<std::uint8_t>(opcode)} +
         card16(static_cast<unsigned>(1 + body.size() / 4)) + body;
}
Bytes big_request(unsigned opcode, const Bytes& body) {
  return Bytes{kMajor, static_cast<std::uint8_t>(opcode)} + card16(0) + card32(2 + body.size() / 4) + body;
}
Bytes small(unsigned opcode, const Bytes& parameters) {
  return card16(static_cast<unsigned>(4 + parameters.size())) + card16(opcode) + parameters;
}
const Bytes kTag = card32(1);

Bytes large(unsigned part, unsigned parts, const Bytes& data, std::size_t claimed) {
  return request(2, kTag + card16(part) + card16(parts) + card32(claimed) + data);
}
Bytes large(unsigned part, unsigned parts, const Bytes& data) {
  return large(part, parts, data, data.size());
}

const Bytes kFour = {1, 2, 3, 4}, kEight = {5, 6, 7, 8, 9, 10, 11, 12};

TEST(GlxRequests, CommandsOfEvaluatorsInTheirOrder) {
  const Bytes render = small(156, kFour) + small(81, kEight) + small(152, kEight);
  const Bytes stream = request(1, kTag + render) + request(108, kTag) + request(120, kTag + kEight) +
                       big_request(1, kTag + small(144, kFour));
  const std::vector<SentCommand> commands = evaluator_commands(stream);
  const std::vector<SentCommand> expected = {{156, true, false, kFour},
                                             {152, true, false, kEight},
                                             {120, false, false, kEight},
                                             {144, true, false, kFour}};
  EXPECT_EQ(commands, expected);
  EXPECT_EQ(in_words({expected[0]}), "EvalPoint1 (156), 4 bytes: 01 02 03 04");
  EXPECT_TRUE(evaluator_commands({}).empty());
}

// The specification is inconsistent as to whether the byte count of the first part includes length and
// opcode.
TEST(GlxRequests, LargeCommandsEitherWay) {
  const std::vector<SentCommand> expected = {{145, true, true, kFour + kEight + kFour}};
  const Bytes first = card32(24) + card32(145) + kFour;
  const Bytes rest = large(2, 3, kEight) + large(3, 3, kFour + kFour, 4);  // padded
  EXPECT_EQ(evaluator_commands(large(1, 3, first) + rest), expected);
  EXPECT_EQ(evaluator_commands(large(1, 3, first, 4) + rest), expected);
}

TEST(GlxRequests, MalformedOnes) {
  const Bytes first = card32(24) + card32(145) + kFour;
  const Bytes whole = large(1, 3, first) + large(2, 3, kEight) + large(3, 3, kFour);
  ASSERT_EQ(evaluator_commands(whole).size(), 1u);
  const Bytes malformed[] = {
      {kMajor, 1, 9, 0},                                              // the request is cut off
      request(1, {}),                                                 // no context tag
      request(1, kTag + card16(12) + card16(144) + kFour),            // a command longer than its request
      request(1, kTag + card16(0) + card16(144)),                     // a command of length 0
      request(1, kTag + card16(7) + card16(144) + kFour),             // a length that is no multiple of 4
      large(1, 3, first) + large(3, 3, kFour),                        // the second part is missing
      large(1, 3, first) + large(2, 3, kEight),                       // the last part is missing
      large(1, 3, first) + large(2, 4, kEight) + large(3, 3, kFour),  // different numbers of parts
      large(1, 2, first) + large(2, 2, kEight),                       // fewer bytes than the command claims
      large(1, 3, first, 5) + large(2, 3, kEight) +
          large(3, 3, kFour),  // a wrong byte count of the first part
      large(1, 3, first) + large(2, 3, kEight, 16) +
          large(3, 3, kFour),  // a byte count above the part's size
      large(1, 3, first) + request(108, kTag) + large(2, 3, kEight) + large(3, 3, kFour)};
  for (const Bytes& stream : malformed) EXPECT_THROW(evaluator_commands(stream), std::runtime_error);
}

}  // namespace
}  // namespace evalcts
