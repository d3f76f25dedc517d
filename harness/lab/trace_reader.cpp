// Implements TraceReader.
#include "trace_reader.h"

#include <fmt/format.h>
#include <snappy-c.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace evalcts::lab {
namespace {

constexpr std::uint64_t kOldestVersion = 4, kNewestVersion = 6;
constexpr std::size_t kLargestBlock = std::size_t{1} << 28;
constexpr std::uint64_t kMostSignatures = 1 << 20;
// Limits: elements of the arrays of a call, its arguments, and calls of all threads that have not returned.
constexpr std::size_t kMostElements = 1 << 21, kMostArguments = 64, kMostPending = 4096;
constexpr int kDeepest = 64;  // arrays and structures in each other

enum Event { kEnter, kLeave };
enum Detail { kEnd, kArgument, kResult, kThread, kBacktrace, kFlags };
enum FrameDetail { kFrameEnd, kModule, kFunction, kFile, kLine, kOffset };
constexpr std::uint64_t kFakeFlag = 1;

// Types of values.
enum Type {
  kNull,
  kFalse,
  kTrue,
  kNegative,
  kUnsigned,
  kFloat,
  kDouble,
  kString,
  kBlob,
  kEnum,
  kMask,
  kArray,
  kStructure,
  kAddress,
  kTwoForms,
  kWideString
};

[[noreturn]] void reject_as_damaged() { throw BadTrace("is damaged"); }

}  // namespace

bool is_trace(const std::filesystem::path& file) {
  char begin[2] = {};
  return std::ifstream(file, std::ios::binary).read(begin, sizeof begin) && begin[0] == 'a' &&
         begin[1] == 't';
}

TraceReader::TraceReader(const std::filesystem::path& file)
    : stream_(file, std::ios::binary), left_(std::filesystem::file_size(file) - 2) {
  stream_.ignore(2);
  try {
    const std::uint64_t version = number();
    if (version < kOldestVersion || version > kNewestVersion)
      throw BadTrace(fmt::format("is a trace of format {}, and this evalcts reads formats {} to {}", version,
                                 kOldestVersion, kNewestVersion));
    if (version < kNewestVersion) return;
    number();  // a version of the meaning
    for (std::string name = text(); !name.empty(); name = text()) {
      const std::string property = text();
      if (name == "process.name") program_ = property;
    }
  } catch (EndOfFile) {
    throw BadTrace("ends within its header");
  }
}

// Returns false at the end of the file.
bool TraceReader::read_block() {
  unsigned char size[4];
  if (left_ == 0) return false;
  std::size_t compressed_size = 0, block_size = 0;
  if (stream_.read(reinterpret_cast<char*>(size), sizeof size))
    for (int i = 3; i >= 0; --i) compressed_size = compressed_size << 8 | size[i];
  if (left_ < sizeof size || compressed_size > left_ - sizeof size) {
    is_cut_ = true;
    left_ = 0;
    return false;
  }
  left_ -= sizeof size + compressed_size;
  if (compressed_size > kLargestBlock) reject_as_damaged();
  std::string compressed(compressed_size, '\0');
  if (!stream_.read(compressed.data(), static_cast<std::streamsize>(compressed_size))) return false;
  if (snappy_uncompressed_length(compressed.data(), compressed_size, &block_size) != SNAPPY_OK ||
      block_size > kLargestBlock)
    reject_as_damaged();
  block_.resize(block_size);
  place_ = 0;
  if (snappy_uncompress(compressed.data(), compressed_size, block_.data(), &block_size) != SNAPPY_OK)
    reject_as_damaged();
  return true;
}

int TraceReader::byte() {
  while (place_ == block_.size())
    if (!read_block()) throw EndOfFile();
  return static_cast<unsigned char>(block_[place_++]);
}

// Seven bits a byte, the lowest first.
std::uint64_t TraceReader::number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const int next = byte();
    value |= static_cast<std::uint64_t>(next & 0x7F) << shift;
    if ((next & 0x80) == 0) return value;
  }
  reject_as_damaged();
}

std::int64_t TraceReader::signed_number() {
  const int type = byte();
  if (type != kNegative && type != kUnsigned) reject_as_damaged();
  const std::uint64_t value = number();
  return static_cast<std::int64_t>(type == kNegative ? 0 - value : value);
}

std::string TraceReader::text() {
  std::string text;
  for (std::uint64_t left = number(); left > 0;) {
    if (place_ == block_.size() && !read_block()) throw EndOfFile();
    const std::size_t part = std::min<std::uint64_t>(left, block_.size() - place_);
    text.append(block_, place_, part);
    place_ += part;
    left -= part;
  }
  return text;
}

template <class T>
T TraceReader::real() {
  char bytes[sizeof(T)];
  for (char& each : bytes) each = static_cast<char>(byte());
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

TraceValue TraceReader::value(int depth) {
  using Kind = TraceValue::Kind;
  if (depth > kDeepest) reject_as_damaged();
  const auto elements = [&](std::uint64_t count) {
    std::vector<TraceValue> values;
    for (; count > 0; --count) {
      if (++elements_ > kMostElements) reject_as_damaged();
      values.push_back(value(depth + 1));
    }
    return values;
  };
  switch (byte()) {
    case kNull:
      return {};
    case kFalse:
      return {Kind::kInteger, 0};
    case kTrue:
      return {Kind::kInteger, 1};
    case kNegative:
      return {Kind::kInteger, static_cast<std::int64_t>(0 - number())};
    case kUnsigned:
      return {Kind::kInteger, static_cast<std::int64_t>(number())};
    case kFloat:
      return {Kind::kReal, 0, real<float>()};
    case kDouble:
      return {Kind::kReal, 0, real<double>()};
    case kString:
      text();
      return {Kind::kOther};
    case kBlob:
      return {Kind::kBytes, 0, 0, text()};
    case kEnum:
      if (is_new(enums_, number()))
        for (std::uint64_t names = number(); names > 0; --names) {
          text();
          signed_number();
        }
      return {Kind::kInteger, signed_number()};
    case kMask:
      if (is_new(masks_, number()))
        for (std::uint64_t names = number(); names > 0; --names) {
          text();
          number();
        }
      return {Kind::kInteger, static_cast<std::int64_t>(number())};
    case kArray:
      return {Kind::kArray, 0, 0, {}, elements(number())};
    case kStructure: {
      const std::uint64_t signature = number();
      if (signature > kMostSignatures) reject_as_damaged();
      if (signature >= members_.size()) members_.resize(signature + 1, SIZE_MAX);
      if (members_[signature] == SIZE_MAX) {
        text();
        members_[signature] = number();
        for (std::size_t i = 0; i < members_[signature]; ++i) text();
      }
      elements(members_[signature]);
      return {Kind::kOther};
    }
    case kAddress:
      return {Kind::kPointer, static_cast<std::int64_t>(number())};
    case kTwoForms:  // a text for people, then the value
      value(depth + 1);
      return value(depth + 1);
    case kWideString:
      for (std::uint64_t left = number(); left > 0; --left) number();
      return {Kind::kOther};
    default:
      reject_as_damaged();
  }
}

void TraceReader::skip_frame_of_stack() {
  if (!is_new(frames_, number())) return;
  for (int detail = byte(); detail != kFrameEnd; detail = byte()) {
    if (detail == kLine || detail == kOffset)
      number();
    else if (detail <= kFile)
      text();
    else
      reject_as_damaged();
  }
}

void TraceReader::read_details(TraceCall& call) {
  elements_ = 0;
  for (int detail = byte(); detail != kEnd; detail = byte()) {
    if (detail == kArgument) {
      const std::uint64_t index = number();
      if (index >= kMostArguments) reject_as_damaged();
      if (index >= call.arguments.size()) call.arguments.resize(index + 1);
      call.arguments[index] = value();
    } else if (detail == kResult) {
      call.result = value();
    } else if (detail == kThread) {
      number();
    } else if (detail == kBacktrace) {
      for (std::uint64_t frames = number(); frames > 0; --frames) skip_frame_of_stack();
    } else if (detail == kFlags) {
      call.is_fake = (number() & kFakeFlag) != 0;
    } else {
      reject_as_damaged();
    }
  }
}

std::optional<TraceCall> TraceReader::next() {
  bool is_between_events = true;
  try {
    for (;;) {
      is_between_events = true;
      const int event = byte();
      is_between_events = false;
      if (event == kEnter) {
        TraceCall call;
        call.number = calls_++;
        call.thread = static_cast<std::uint32_t>(number());
        const std::uint64_t signature = number();
        if (signature > kMostSignatures) reject_as_damaged();
        if (signature >= functions_.size()) functions_.resize(signature + 1);
        if (functions_[signature].empty()) {
          functions_[signature] = text();
          for (std::uint64_t names = number(); names > 0; --names) text();
        }
        if (pending_.size() == kMostPending) reject_as_damaged();
        call.name = functions_[signature];
        read_details(call);
        pending_.push_back(std::move(call));
      } else if (event == kLeave) {
        const std::uint64_t call_number = number();
        TraceCall ignored_call;
        const auto found = std::ranges::find(pending_, call_number, &TraceCall::number);
        read_details(found == pending_.end() ? ignored_call : *found);
        if (found == pending_.end()) continue;
        TraceCall call = std::move(*found);
        pending_.erase(found);
        return call;
      } else {
        reject_as_damaged();
      }
    }
  } catch (EndOfFile) {
    is_cut_ = is_cut_ || !is_between_events;
  }
  if (pending_.empty()) return {};
  TraceCall call = std::move(pending_.front());
  pending_.pop_front();
  return call;
}

}  // namespace evalcts::lab
