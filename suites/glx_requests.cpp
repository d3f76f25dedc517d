// Parses GLX requests (Render, RenderLarge and single commands) into evaluator commands.
#include "glx_requests.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>

namespace evalcts {
namespace {

constexpr unsigned kRender = 1, kRenderLarge = 2;
constexpr unsigned kFirstSingle = 101;  // 101 and up: GL commands with requests of their own

constexpr const char* kRendering[] = {"Map1d",        "Map1f",        "Map2d",        "Map2f",
                                      "MapGrid1d",    "MapGrid1f",    "MapGrid2d",    "MapGrid2f",
                                      "EvalCoord1dv", "EvalCoord1fv", "EvalCoord2dv", "EvalCoord2fv",
                                      "EvalMesh1",    "EvalPoint1",   "EvalMesh2",    "EvalPoint2"};
constexpr const char* kSingles[] = {"GetMapdv", "GetMapfv", "GetMapiv"};
constexpr unsigned kRenderingBegin = 143, kSinglesBegin = 120;

bool is_of_evaluators(const SentCommand& command) {
  return command.rendering
             ? command.opcode >= kRenderingBegin && command.opcode < kRenderingBegin + std::size(kRendering)
             : command.opcode >= kSinglesBegin && command.opcode < kSinglesBegin + std::size(kSingles);
}

using ByteSpan = std::span<const std::uint8_t>;

template <class T>
T read(ByteSpan bytes, std::size_t at) {
  if (at + sizeof(T) > bytes.size()) throw std::runtime_error("a request ends early");
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

Bytes copy(ByteSpan bytes) { return {bytes.begin(), bytes.end()}; }

// Section 2.3.1: reads the commands of one Render request.
void read_render(ByteSpan body, std::vector<SentCommand>& commands) {
  for (std::size_t at = 0; at < body.size();) {
    const std::size_t length = read<std::uint16_t>(body, at);
    const unsigned opcode = read<std::uint16_t>(body, at + 2);
    if (length < 4 || length % 4 != 0 || length > body.size() - at)
      throw std::runtime_error(fmt::format("rendering command {} claims {} bytes of the {} that are there",
                                           opcode, length, body.size() - at));
    commands.push_back({opcode, true, false, copy(body.subspan(at + 4, length - 4))});
    at += length;
  }
}

// Section 2.3.2: collects a command from several RenderLarge requests. The text is inconsistent as to whether
// the byte count of the first request includes length and opcode; both are accepted.
class Large {
 public:
  // Returns true if the command is complete.
  bool add(ByteSpan body) {
    const unsigned number = read<std::uint16_t>(body, 4), total = read<std::uint16_t>(body, 6);
    const std::size_t count = read<std::uint32_t>(body, 8);
    const ByteSpan data = body.subspan(12);
    if (number != seen_ + 1 || number > total || (seen_ > 0 && total != total_))
      throw std::runtime_error(
          fmt::format("RenderLarge {} of {} follows number {} of {}", number, total, seen_, total_));
    if (count > data.size()) throw std::runtime_error("RenderLarge claims more bytes than it has");
    if (seen_ == 0) {
      total_ = total;
      first_ = copy(data);
      first_count_ = count;
    } else {
      rest_.insert(rest_.end(), data.begin(), data.begin() + static_cast<std::ptrdiff_t>(count));
    }
    seen_ = number;
    return seen_ == total_;
  }

  bool begun() const { return seen_ > 0; }

  SentCommand command() const {
    const std::size_t length = read<std::uint32_t>(first_, 0);
    const unsigned opcode = read<std::uint32_t>(first_, 4);
    const std::size_t first = length - rest_.size();
    if (length < rest_.size() + 8 || first > first_.size() ||
        (first_count_ != first && first_count_ + 8 != first))
      throw std::runtime_error(fmt::format("RenderLarge, command {}: {} bytes are claimed, {} and {} come",
                                           opcode, length, first_count_, rest_.size()));
    Bytes parameters(first_.begin() + 8, first_.begin() + static_cast<std::ptrdiff_t>(first));
    parameters.insert(parameters.end(), rest_.begin(), rest_.end());
    return {opcode, true, true, std::move(parameters)};
  }

 private:
  unsigned seen_ = 0, total_ = 0;
  std::size_t first_count_ = 0;
  Bytes first_, rest_;
};

}  // namespace

std::vector<SentCommand> evaluator_commands(const Bytes& requests) {
  std::vector<SentCommand> all;
  Large large;
  for (std::size_t at = 0; at < requests.size();) {
    const ByteSpan rest = ByteSpan(requests).subspan(at);
    const unsigned opcode = read<std::uint8_t>(rest, 1);
    std::size_t header = 4, length = 4 * std::size_t{read<std::uint16_t>(rest, 2)};
    if (length == 0) {  // BIG-REQUESTS
      header = 8;
      length = 4 * std::size_t{read<std::uint32_t>(rest, 4)};
    }
    if (length < header || length > rest.size()) throw std::runtime_error("a request is cut off");
    const ByteSpan body = rest.subspan(header, length - header);  // from the context tag on
    if (large.begun() && opcode != kRenderLarge)
      throw std::runtime_error(fmt::format("request {} comes between those of RenderLarge", opcode));
    if (opcode == kRender) {
      if (body.size() < 4) throw std::runtime_error("Render has no context tag");
      read_render(body.subspan(4), all);
    } else if (opcode == kRenderLarge) {
      if (large.add(body)) {
        all.push_back(large.command());
        large = {};
      }
    } else if (opcode >= kFirstSingle && body.size() >= 4) {
      all.push_back({opcode, false, false, copy(body.subspan(4))});
    }
    at += length;
  }
  if (large.begun()) throw std::runtime_error("the last requests of RenderLarge are missing");
  std::erase_if(all, [](const SentCommand& command) { return !is_of_evaluators(command); });
  return all;
}

std::string in_words(const std::vector<SentCommand>& commands) {
  constexpr std::size_t kShown = 96;
  std::vector<std::string> words;
  for (const SentCommand& command : commands) {
    const char* name = command.rendering ? kRendering[command.opcode - kRenderingBegin]
                                         : kSingles[command.opcode - kSinglesBegin];
    const ByteSpan shown = ByteSpan(command.parameters).first(std::min(command.parameters.size(), kShown));
    words.push_back(fmt::format("{} ({}{}), {} bytes: {:02x}{}", name, command.opcode,
                                command.in_parts ? ", RenderLarge" : "", command.parameters.size(),
                                fmt::join(shown, " "),
                                shown.size() < command.parameters.size() ? " ..." : ""));
  }
  return words.empty() ? "no evaluator commands" : fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace evalcts
