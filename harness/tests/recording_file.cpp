// Implements RecordingFile.
#include "recording_file.h"

#include <cstring>
#include <fstream>
#include <map>
#include <variant>

#include <evalcts/record/format.h>

namespace evalcts {
namespace {

using record::kAlignment;

// The numbers of the commands, in the order of the table; behind them come the events.
const std::vector<std::string>& names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
#define GL_ENTRY(name, kinds) names.push_back(#name);
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
    for (const char* const event : {"@context", "@destroy", "@frame"}) names.emplace_back(event);
    return names;
  }();
  return kNames;
}

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

std::string header_text() {
  std::string text = R"({"program": ["viewer", "-fast"], "others": ["glLightfv", "glRectf"], "commands": [)";
#define GL_ENTRY(name, kinds) text += "\"" #name ":" + letters(decltype(gl::Table::name)(nullptr)) + "\",";
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  return text + R"("@context:qq","@destroy:q","@frame:q"]})";
}

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string padded(std::string text) {
  text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment);
  return text;
}

}  // namespace

RecordingFile::RecordingFile() = default;

template <class T>
void RecordingFile::put(T value) {
  parts_.back().records += bytes_of(value);
}

void RecordingFile::begin(const std::string& name) {
  const auto place = std::find(names().begin(), names().end(), name) - names().begin();
  put(static_cast<std::uint16_t>(place));
}

void RecordingFile::context(std::uint64_t number, std::uint32_t thread) {
  if (parts_.back().thread != thread) parts_.push_back({thread, ""});
  begin("@context");
  put(number);
  put(++order_);
}

void RecordingFile::destroy(std::uint64_t number) {
  begin("@destroy");
  put(number);
}

void RecordingFile::frame() {
  begin("@frame");
  put(frames_++);
}

void RecordingFile::command(const gl::Command& command) {
  begin(std::string(gl::name_of(command.entry).substr(2)));
  for (const gl::Value& value : command.arguments) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      put(static_cast<std::int32_t>(*number));
    } else if (const auto* single = std::get_if<float>(&value)) {
      put(*single);
    } else if (const auto* real = std::get_if<double>(&value)) {
      put(*real);
    } else if (const auto* input = std::get_if<gl::Input>(&value)) {
      put(static_cast<std::uint32_t>(input->bytes.size()));
      parts_.back().records.append(reinterpret_cast<const char*>(input->bytes.data()), input->bytes.size());
    } else {
      put(std::holds_alternative<gl::Output>(value) ? 0 : record::kNull);
    }
  }
}

void RecordingFile::commands(const gl::Case& script) {
  for (const gl::Command& each : script.commands()) command(each);
}

void RecordingFile::unknown_array() {
  begin("Map1f");
  put(std::int32_t{GL_MAP1_VERTEX_3});
  put(0.0f);
  put(1.0f);
  put(std::int32_t{1});
  put(std::int32_t{4});
  put(record::kUnknown);
}

std::string RecordingFile::text() const {
  const std::string header = header_text();
  record::FileHeader fixed{};
  std::memcpy(fixed.magic, record::kMagic, sizeof fixed.magic);
  fixed.text_length = header.size();
  fixed.counts = (sizeof fixed + header.size() + 7) / 8 * 8;
  std::string text(fixed.counts, '\0');
  text += bytes_of(std::uint64_t{7}) + bytes_of(std::uint64_t{9});
  text = padded(text);
  fixed.size = text.size();
  text.replace(0, sizeof fixed, bytes_of(fixed));
  text.replace(sizeof fixed, header.size(), header);
  for (const Part& part : parts_) {
    record::Chunk chunk{record::kChunkMagic, part.thread, 0, part.records.size()};
    std::string whole = padded(std::string(sizeof chunk, '\0') + part.records);
    chunk.space = whole.size();
    text += whole.replace(0, sizeof chunk, bytes_of(chunk));
  }
  return text;
}

void RecordingFile::write(const std::filesystem::path& file) const {
  std::ofstream(file, std::ios::binary) << text();
}

}  // namespace evalcts
