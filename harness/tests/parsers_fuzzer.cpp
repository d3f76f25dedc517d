// What reads files and lines that anybody may have written, under libFuzzer: whatever comes, the answer is a
// result or the exception that is documented. The first byte says who reads the rest. `./evalcts test
// --preset fuzz`.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "harness/gl/case_json.h"
#include "harness/runner/baseline.h"
#include "vectors/lint/lint.h"
#include "vectors/pipe/pipe.h"

namespace evalcts {
namespace {

using nlohmann::json;

// A file of vectors; what is one is emitted, and judged by its own questions.
void read_vectors(const std::string& text) {
  try {
    vectors::lint(text, {});
    const json file = json::parse(text);
    std::istringstream answers(vectors::emit(file));
    vectors::Answers none = vectors::read_answers(answers);
    vectors::judge(file, none);
  } catch (const vectors::Malformed&) {
  }
}

// Answers to a small file of vectors.
void read_answers(const std::string& text) {
  static const json file = [] {
    const char* path = std::getenv("EVALCTS_VECTORS_SAMPLE");
    std::ifstream stream(path != nullptr ? path : "");
    if (!stream) std::abort();
    return json::parse(stream);
  }();
  std::istringstream lines(text);
  vectors::Answers answers = vectors::read_answers(lines);
  vectors::judge(file, answers);
}

void read_case(const std::string& text) {
  const json commands = json::parse(text, nullptr, false);
  if (commands.is_discarded()) return;
  try {
    const gl::Case script = gl::case_from_json(commands);
    if (gl::to_json(gl::case_from_json(gl::to_json(script))) != gl::to_json(script)) std::abort();
  } catch (const std::invalid_argument&) {
  }
}

void read_baseline(const std::string& text) {
  static const std::filesystem::path folder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "evalcts-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return std::filesystem::path(name);
  }();
  // The parts of the file are the files of the baseline.
  std::istringstream rest(text);
  std::string part;
  for (const char* kind : {"fails", "signatures", "skips", "flakes"}) {
    std::getline(rest, part, '\f');
    std::ofstream(folder / (std::string("x-") + kind + ".txt"), std::ios::binary) << part;
  }
  try {
    const Baseline baseline = Baseline::read(folder, "x");
    baseline.skip("Theme.Test/MAP1_VERTEX_3");
  } catch (const BadBaseline&) {
  }
}

}  // namespace
}  // namespace evalcts

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0]) {
    case 'v':
      evalcts::read_vectors(text);
      break;
    case 'a':
      evalcts::read_answers(text);
      break;
    case 'c':
      evalcts::read_case(text);
      break;
    case 'b':
      evalcts::read_baseline(text);
      break;
    default:
      return -1;  // not worth keeping
  }
  return 0;
}
