// Implements RecordingWriter.
#include <evalcts/record/writer.h>

#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include <evalcts/record/format.h>
#include <evalcts/results/json.h>

namespace evalcts::record {
namespace {

template <class P>
char letter() {
  if constexpr (std::is_pointer_v<P>) return std::is_const_v<std::remove_pointer_t<P>> ? 'p' : 'o';
  if constexpr (std::is_same_v<P, float>) return 'f';
  if constexpr (std::is_same_v<P, double>) return 'd';
  return sizeof(P) == 8 ? 'q' : 'i';
}

template <class Result, class... P>
std::string letters(Result (*)(P...)) {
  return {letter<P>()...};
}

// The commands have the numbers of their entry points; behind them come the events.
enum Event : std::size_t { kContext = gl::kEntryPointCount, kDestroy, kFrame };

// The letters of the parameters of each entry point.
const std::vector<std::string>& letters_of_commands() {
  static const std::vector<std::string> kAll = {
#define GL_ENTRY(name, kinds) letters(decltype(gl::Table::name)(nullptr)),
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  };
  return kAll;
}

// Returns the names of commands and events in the header.
std::vector<std::string> names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < gl::kEntryPointCount; ++i)
    names.push_back(std::string(gl::name_of(static_cast<gl::EntryPoint>(i)).substr(2)) + ":" +
                    letters_of_commands()[i]);
  for (const char* const event : {"@context:qq", "@destroy:q", "@frame:q"}) names.emplace_back(event);
  return names;
}

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::size_t aligned(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

}  // namespace

RecordingWriter::RecordingWriter(std::vector<std::string> program,
                                 std::map<std::string, std::uint64_t> others)
    : program_(std::move(program)), others_(std::move(others)) {}

template <class T>
void RecordingWriter::put(T value) {
  records_[thread_] += bytes_of(value);
}

void RecordingWriter::begin(std::size_t number) { put(static_cast<std::uint16_t>(number)); }

void RecordingWriter::context(std::uint64_t number) {
  begin(kContext);
  put(number);
  put(++order_);
}

void RecordingWriter::destroy(std::uint64_t number) {
  begin(kDestroy);
  put(number);
}

void RecordingWriter::frame() {
  begin(kFrame);
  put(frames_++);
}

void RecordingWriter::command(const gl::Command& command, bool is_complete) {
  const std::string& parameters = letters_of_commands().at(static_cast<std::size_t>(command.entry));
  if (parameters.size() != command.arguments.size())
    throw std::logic_error("a command with a wrong number of arguments");
  begin(static_cast<std::size_t>(command.entry));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const gl::Value& value = command.arguments[i];
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      if (parameters[i] == 'q')
        put(*number);
      else
        put(static_cast<std::int32_t>(*number));
    } else if (const auto* single = std::get_if<float>(&value)) {
      put(*single);
    } else if (const auto* real = std::get_if<double>(&value)) {
      put(*real);
    } else if (const auto* input = std::get_if<gl::Input>(&value)) {
      put(is_complete ? static_cast<std::uint32_t>(input->bytes.size()) : kUnknown);
      if (is_complete)
        records_[thread_].append(reinterpret_cast<const char*>(input->bytes.data()), input->bytes.size());
    } else {
      put(std::holds_alternative<gl::Output>(value) ? 0 : kNull);
    }
  }
}

std::string RecordingWriter::text() const {
  nlohmann::json others = nlohmann::json::array();
  std::string counts;
  for (const auto& [name, times] : others_) {
    others.push_back(name);
    counts += bytes_of(times);
  }
  const std::string header =
      nlohmann::json{{"program", program_}, {"commands", names()}, {"others", others}}.dump(
          -1, ' ', false, nlohmann::json::error_handler_t::replace);
  FileHeader fixed{};
  std::memcpy(fixed.magic, kMagic, sizeof fixed.magic);
  fixed.text_length = header.size();
  fixed.counts = (sizeof fixed + header.size() + 7) / 8 * 8;
  std::string text(fixed.counts, '\0');
  text += counts;
  text.resize(aligned(text.size()));
  fixed.size = text.size();
  text.replace(0, sizeof fixed, bytes_of(fixed));
  text.replace(sizeof fixed, header.size(), header);
  for (const auto& [thread, records] : records_) {
    text += bytes_of(Chunk{kChunkMagic, thread, aligned(sizeof(Chunk) + records.size()), records.size()});
    text += records;
    text.resize(aligned(text.size()));
  }
  return text;
}

}  // namespace evalcts::record
