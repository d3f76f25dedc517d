// Writes the files of vectors, byte for byte the same on every machine.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::vectors {

// Returns the names of all kinds: "map1_eval", "map2_eval", "grid", "auto_normal", "errors", "get_map",
// "state".
const std::vector<std::string>& kinds();

// A case of the suite, for the kinds "errors", "get_map" and "state".
struct SuiteCase {
  std::string test;                       // "Map1Errors.StrideBelowK/MAP1_VERTEX_3"
  std::vector<std::string> requirements;  // of the test
  gl::Case script;
};

// The cases of recorded programs as a file of the kind "state".
struct Sequences {
  std::string text;
  std::size_t cases = 0;      // programs that have a form in the vectors
  std::size_t shortened = 0;  // cases that end before their programs
};
Sequences sequences_of_programs(const std::vector<SuiteCase>& programs);

// A file that was written.
struct WrittenFile {
  std::string kind;
  std::size_t cases, bytes;
};
// Writes KIND.json to the folder for each kind, atomically, and calls `wrote` after each file with its kind
// and its numbers of cases and bytes. Values and normals are those of the files in `inputs`: their ids,
// requirements, flags, maps and arguments are copied, and their answers, which may be missing there, are
// computed. `cases_of_suite` returns the cases of all tests whose cases are vectors, in their order. Throws
// std::runtime_error if a file cannot be written, or a case cannot be read or computed.
void write_all(const std::filesystem::path& inputs, const std::filesystem::path& folder,
               const std::function<std::vector<SuiteCase>()>& cases_of_suite,
               const std::function<void(const WrittenFile&)>& wrote);

}  // namespace evalcts::vectors
