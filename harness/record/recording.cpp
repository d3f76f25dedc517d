// Reads the records of a recording, and sorts them by context.
#include <evalcts/record/recording.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/record/format.h>
#include <evalcts/results/json.h>
#include <evalcts/results/text.h>

namespace evalcts::record {
namespace {

namespace fs = std::filesystem;

template <class T>
T number_at(const std::byte* place) {
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

// A parameter of a command: its letter (format.h), and the type of a number or of the elements of an array.
struct Parameter {
  char letter = 'i';
  bool is_signed = false;
  gl::Scalar scalar = gl::Scalar::kU8;
};

template <class P>
constexpr Parameter parameter() {
  if constexpr (std::is_pointer_v<P>) {
    using Element = std::remove_pointer_t<P>;
    constexpr char kLetter = std::is_const_v<Element> ? 'p' : 'o';
    if constexpr (std::is_arithmetic_v<std::remove_const_t<Element>>)
      return {kLetter, false, gl::scalar_of<Element>()};
    else
      return {kLetter, false, gl::Scalar::kU8};
  } else if constexpr (std::is_floating_point_v<P>) {
    return {sizeof(P) == 4 ? 'f' : 'd', true};
  } else {
    return {sizeof(P) == 8 ? 'q' : 'i', std::is_signed_v<P>};
  }
}

template <class Result, class... P>
std::vector<Parameter> parameters_from(Result (*)(P...)) {
  return {parameter<P>()...};
}

struct Signature {
  gl::EntryPoint entry;
  std::vector<Parameter> parameters;
};

// Returns the commands of the table by the text that describes them, "Map1f:iffiip".
const std::map<std::string, Signature>& signatures() {
  static const std::map<std::string, Signature> kAll = [] {
    std::map<std::string, Signature> all;
    const auto add = [&](const char* name, gl::EntryPoint entry, std::vector<Parameter> parameters) {
      std::string text = std::string(name) + ":";
      for (const Parameter& each : parameters) text += each.letter;
      all[text] = {entry, std::move(parameters)};
    };
#define GL_ENTRY(name, kinds) \
  add(#name, gl::EntryPoint::name, parameters_from(decltype(gl::Table::name)(nullptr)));
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
    return all;
  }();
  return kAll;
}

// Returns the type of the names in the array of CallLists.
gl::Scalar scalar_of_names(std::int64_t type) {
  return type == GL_FLOAT          ? gl::Scalar::kF32
         : type == GL_INT          ? gl::Scalar::kI32
         : type == GL_UNSIGNED_INT ? gl::Scalar::kU32
         : type == GL_BYTE         ? gl::Scalar::kI8
                                   : gl::Scalar::kU8;
}

// Elements that a query may write, unless it is GetMap of COEFF.
constexpr std::size_t kMostAnswers = 16;

void count(std::vector<Counted>& counted, const std::string& name) {
  const auto found = std::ranges::find(counted, name, &Counted::name);
  if (found == counted.end())
    counted.push_back({name, 1});
  else
    ++found->times;
}

void sort(std::vector<Counted>& counted) {
  std::ranges::stable_sort(counted, std::greater(), &Counted::times);
}

}  // namespace

struct Recording::Kind {
  std::string name;                     // without "gl"
  std::string letters;                  // of its arguments
  std::optional<gl::EntryPoint> entry;  // none: an event, or a command that is not in the table
  std::vector<Parameter> parameters = {};
  bool is_event() const { return name.starts_with("@"); }
};

struct Recording::Segment {
  std::uint64_t order = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges = {};  // begin and end in the file
};

// The places of the arguments are those of the fixed part of each: of an array, its size.
struct Recording::RecordAt {
  const Kind* kind = nullptr;  // null: the record is damaged
  std::array<std::uint64_t, 16> arguments{};
  std::uint64_t end = 0;
};

bool is_recording(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  char begin[sizeof kMagic] = {};
  const bool is_read = read(descriptor, begin, sizeof begin) == sizeof begin;
  close(descriptor);
  return is_read && std::memcmp(begin, kMagic, sizeof kMagic - 1) == 0;  // the last byte is the version
}

bool has_all_elements(const gl::Command& command) {
  using gl::EntryPoint;
  if (command.arguments.empty()) return true;
  const auto* const array = std::get_if<gl::Input>(&command.arguments.back());
  if (!array) return true;
  // Products of 32-bit arguments are rounded to double, which does not matter: no array is that large.
  const auto has = [&](double elements, std::size_t size) {
    return static_cast<double>(array->bytes.size()) >= elements * static_cast<double>(size);
  };
  if (command.entry == EntryPoint::CallLists) {
    const std::int64_t type = gl::integer_of(command, 1);
    const std::size_t size = type == GL_BYTE || type == GL_UNSIGNED_BYTE                           ? 1
                             : type == GL_SHORT || type == GL_UNSIGNED_SHORT || type == GL_2_BYTES ? 2
                             : type == GL_3_BYTES                                                  ? 3
                                                                                                   : 4;
    return has(static_cast<double>(gl::integer_of(command, 0)), size);
  }
  double elements = 1;
  if (gl::role_of(command.entry) == gl::Role::kMap) {
    elements = std::max(gl::components_of(static_cast<GLenum>(gl::integer_of(command, 0))), 1);
    for (int i = 0; i < gl::dimension_of(command.entry); ++i) {
      const auto stride = static_cast<std::size_t>(3 + 4 * i);
      elements += std::max(static_cast<double>(gl::integer_of(command, stride)), 0.0) *
                  std::max(static_cast<double>(gl::integer_of(command, stride + 1) - 1), 0.0);
    }
  } else {
    // "Vertex3fv" reads three numbers, and "EdgeFlagv" one.
    const std::string_view name = gl::name_of(command.entry);
    if (const std::size_t digit = name.find_first_of("1234"); digit != std::string_view::npos)
      elements = name[digit] - '0';
  }
  return has(elements, gl::size_of(array->type));
}

Recording::Recording(const fs::path& file) {
  const auto reject = [&](const std::string& why) {
    throw BadRecording(fmt::format("'{}' {}", clean(file.string()), why));
  };
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0)
    reject("cannot be read: " + std::string(std::strerror(errno)));
  size_ = static_cast<std::uint64_t>(status.st_size);
  void* const mapped =
      size_ < sizeof(FileHeader) ? MAP_FAILED : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
  close(descriptor);
  if (mapped == MAP_FAILED) reject("is not a recording of 'evalcts record'");
  data_ = static_cast<const std::byte*>(mapped);
  try {
    read_header();
    find_segments();
  } catch (const BadRecording& error) {
    munmap(mapped, size_);
    reject(error.what());
  }
}

Recording::~Recording() { munmap(const_cast<std::byte*>(data_), size_); }

void Recording::read_header() {
  const auto header = number_at<FileHeader>(data_);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic - 1) != 0)
    throw BadRecording("is not a recording of 'evalcts record'");
  if (header.magic[sizeof kMagic - 1] != kMagic[sizeof kMagic - 1])
    throw BadRecording(
        fmt::format("is a recording of version {}, and this evalcts reads version {}; use the evalcts that "
                    "recorded it, or record again",
                    clean(std::string(1, header.magic[sizeof kMagic - 1])), kMagic[sizeof kMagic - 1]));
  if (header.size > size_ || header.size < sizeof header || header.text_length > header.size - sizeof header)
    throw BadRecording("ends within its header; record again");
  const nlohmann::json text =
      parse_json(std::string(reinterpret_cast<const char*>(data_) + sizeof header, header.text_length));
  try {
    for (const std::string part : text.at("program")) program_.push_back(clean(part));
    for (const std::string name : text.at("commands")) {
      const std::size_t colon = name.find(':');
      if (colon == std::string::npos || name.size() - colon - 1 > RecordAt().arguments.size())
        throw BadRecording("has a damaged header; record again");
      Kind kind{clean(name.substr(0, colon)), name.substr(colon + 1), {}};
      if (const auto known = signatures().find(name); known != signatures().end()) {
        kind.entry = known->second.entry;
        kind.parameters = known->second.parameters;
      }
      kinds_.push_back(std::move(kind));
    }
    std::uint64_t place = header.counts;
    for (const std::string name : text.at("others")) {
      if (place > header.size - sizeof(std::uint64_t))
        throw BadRecording("has a damaged header; record again");
      if (const auto times = number_at<std::uint64_t>(data_ + place)) others_.push_back({clean(name), times});
      place += sizeof(std::uint64_t);
    }
  } catch (const nlohmann::json::exception&) {
    throw BadRecording("has a damaged header; record again");
  }
  sort(others_);
  if (header.is_cut)
    problem_ = "the recording ends before the program did, at its size limit or because the disk was full";
}

Recording::RecordAt Recording::record_at(std::uint64_t offset, std::uint64_t end) const {
  RecordAt record;
  const auto has = [&](std::uint64_t bytes) { return bytes <= end - offset; };
  if (!has(2)) return {};
  const auto number = number_at<std::uint16_t>(data_ + offset);
  offset += 2;
  if (number >= kinds_.size()) return {};
  const Kind& kind = kinds_[number];
  for (std::size_t i = 0; i < kind.letters.size(); ++i) {
    const char letter = kind.letters[i];
    record.arguments[i] = offset;
    const std::uint64_t fixed = letter == 'q' || letter == 'd' ? 8 : 4;
    if (!has(fixed)) return {};
    offset += fixed;
    if (letter != 'p') continue;
    const auto bytes = number_at<std::uint32_t>(data_ + record.arguments[i]);
    if (bytes == kNull || bytes == kUnknown) continue;
    if (!has(bytes)) return {};
    offset += bytes;
  }
  record.kind = &kind;
  record.end = offset;
  return record;
}

// A context that is destroyed and made again under the same number is another one.
void Recording::find_segments() {
  struct Placed {
    std::uint64_t context = 0;
    Segment segment;
  };
  std::vector<Placed> all;
  std::map<std::uint32_t, Placed> current;                         // by thread
  std::vector<std::pair<std::uint64_t, std::uint64_t>> destroyed;  // order of the segment, context
  std::vector<std::uint64_t> times(kinds_.size());
  std::uint64_t lost = 0;
  for (std::uint64_t at = number_at<FileHeader>(data_).size; size_ - at >= sizeof(Chunk);) {
    const auto chunk = number_at<Chunk>(data_ + at);
    if (chunk.magic == 0 && chunk.space == 0) break;  // the process ended before it began this chunk
    const std::uint64_t begin = at + sizeof chunk, end = begin + std::min(chunk.length, size_ - begin);
    if (chunk.magic != kChunkMagic || chunk.space < sizeof chunk || chunk.space % kAlignment != 0) {
      lost += size_ - at;
      break;
    }
    Placed& placed = current[chunk.thread];
    std::uint64_t from = begin, offset = begin;
    while (offset < end) {
      const RecordAt record = record_at(offset, end);
      if (!record.kind) break;
      ++times[static_cast<std::size_t>(record.kind - kinds_.data())];
      if (record.kind->name == "@context") {
        placed.segment.ranges.emplace_back(from, offset);
        all.push_back(std::exchange(placed, {number_at<std::uint64_t>(data_ + record.arguments[0]),
                                             {number_at<std::uint64_t>(data_ + record.arguments[1])}}));
        from = record.end;
      } else if (record.kind->name == "@destroy") {
        destroyed.emplace_back(placed.segment.order, number_at<std::uint64_t>(data_ + record.arguments[0]));
      } else if (record.kind->name == "@frame") {
        ++frames_;
      } else if (!is_replayable(record)) {
        count(left_out_, "gl" + record.kind->name);
      }
      offset = record.end;
    }
    lost += begin + chunk.length - offset;
    placed.segment.ranges.emplace_back(from, offset);
    at = chunk.space > size_ - at ? size_ : at + chunk.space;
  }
  for (auto& [thread, placed] : current) all.push_back(std::move(placed));
  std::ranges::stable_sort(all, {}, [](const Placed& placed) { return placed.segment.order; });
  std::ranges::sort(destroyed);
  std::map<std::uint64_t, std::uint64_t> generations;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> places;
  auto next = destroyed.begin();
  for (Placed& placed : all) {
    for (; next != destroyed.end() && next->first < placed.segment.order; ++next) ++generations[next->second];
    const auto is_empty = [](const auto& range) { return range.first == range.second; };
    if (placed.context == 0 || std::ranges::all_of(placed.segment.ranges, is_empty)) continue;
    const auto [place, is_new] =
        places.try_emplace({placed.context, generations[placed.context]}, contexts_.size());
    if (is_new) contexts_.emplace_back();
    contexts_[place->second].push_back(std::move(placed.segment));
  }
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] > 0 && !kinds_[i].is_event()) commands_.push_back({"gl" + kinds_[i].name, times[i]});
  sort(commands_);
  sort(left_out_);
  if (lost > 0 && problem_.empty())
    problem_ = fmt::format("the file is damaged or was cut: {} bytes of it are not read", lost);
}

bool Recording::is_replayable(const RecordAt& record) const {
  if (record.kind->is_event()) return true;
  for (std::size_t i = 0; i < record.kind->letters.size(); ++i)
    if (record.kind->letters[i] == 'p' && number_at<std::uint32_t>(data_ + record.arguments[i]) == kUnknown)
      return false;
  if (!record.kind->entry) return false;
  return record.kind->letters.find('p') == std::string::npos || has_all_elements(command_of(record));
}

gl::Command Recording::command_of(const RecordAt& record) const {
  const Kind& kind = *record.kind;
  gl::Command command{*kind.entry, {}};
  for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
    const Parameter& parameter = kind.parameters[i];
    const std::byte* const place = data_ + record.arguments[i];
    switch (parameter.letter) {
      case 'f':
        command.arguments.emplace_back(number_at<float>(place));
        break;
      case 'd':
        command.arguments.emplace_back(number_at<double>(place));
        break;
      case 'q':
        command.arguments.emplace_back(number_at<std::int64_t>(place));
        break;
      case 'i':
        command.arguments.emplace_back(parameter.is_signed ? std::int64_t{number_at<std::int32_t>(place)}
                                                           : std::int64_t{number_at<std::uint32_t>(place)});
        break;
      default:
        const auto bytes = number_at<std::uint32_t>(place);
        if (bytes == kNull)
          command.arguments.emplace_back(nullptr);
        else if (parameter.letter == 'o')
          command.arguments.emplace_back(gl::Output{parameter.scalar, kMostAnswers});
        else
          command.arguments.emplace_back(
              gl::Input{parameter.scalar, {place + sizeof bytes, place + sizeof bytes + bytes}});
    }
  }
  if (*kind.entry == gl::EntryPoint::CallLists)
    if (auto* const names = std::get_if<gl::Input>(&command.arguments[2]))
      names->type = scalar_of_names(gl::integer_of(command, 1));
  return command;
}

void Recording::read(std::size_t context, const std::function<void(gl::Command)>& command,
                     const std::function<void()>& end_of_frame) const {
  for (const Segment& segment : contexts_.at(context))
    for (auto [offset, end] : segment.ranges)
      while (offset < end) {
        const RecordAt record = record_at(offset, end);
        const std::optional<gl::EntryPoint> entry = record.kind->entry;
        if (!record.kind->is_event() && is_replayable(record)) command(command_of(record));
        if (frames_ > 0 ? record.kind->name == "@frame"
                        : entry == gl::EntryPoint::Flush || entry == gl::EntryPoint::Finish)
          end_of_frame();
        offset = record.end;
      }
}

}  // namespace evalcts::record
