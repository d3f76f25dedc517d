// The vectors as lines of text, and the answers to them: for judging a program in any language ("In a pipe"
// of INTERPRETING.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// One line for each case of a file, each with its end of line; nothing for kinds that are not asked in this
// way (sequences). `file` has passed check_structure().
std::string emit(const nlohmann::json& file);

// The answers of a program.
struct Answers {
  // Answers by id; no numbers: skipped.
  std::map<std::string, std::vector<double>> of;
  std::vector<std::string> answered_twice;  // ids
  std::vector<std::string> malformed;       // "line 3: ...", in words
  std::size_t lines = 0;                    // that were read
};

// Reads a line; returns false at the end.
bool read_answer(std::istream& lines, Answers& answers);
// Reads lines to the end; numbers in hexadecimal or decimal, "inf" and "nan" too. Empty lines and what begins
// with # are left out.
Answers read_answers(std::istream& lines);

struct Wrong {
  std::string id;
  std::string message;  // which component, what came, what is accepted
};

// The score of the answers to one file.
struct Score {
  std::string kind;
  std::size_t cases = 0, skipped = 0;
  std::vector<std::string> missing;
  std::vector<Wrong> wrong;
  // Flag: how many cases were answered, and how many of them wrong.
  struct Count {
    std::size_t answered = 0, wrong = 0;
  };
  std::map<std::string, Count> by_flag;
  // Values with an acceptance interval (normals have none), the number of those that are the nearest
  // binary32, and the largest error in ULP of binary32, with the case it is in.
  std::size_t values = 0, correctly_rounded = 0;
  double largest_ulp = 0;
  std::string largest_id;
  // Quality by target: single-precision values at coordinates that are judged, those that are not as good as
  // single precision, and the largest error as a multiple of the bound, with its case. Infinity stands for a
  // corner of the domain that does not give its control point. Normals are GL_AUTO_NORMAL.
  struct Quality {
    std::size_t values = 0, worse = 0;
    double largest = 0;
    std::string id;

    void add(double multiple, const std::string& id_of_case);
    void add(const Quality& other);
  };
  std::map<std::string, Quality> quality;
};

// One line: the targets for which a program is as good as single precision, and the others with their worst
// cases. Empty if nothing was measured.
std::string quality_in_words(const std::vector<Score>& scores);

// Random cases in the place of a file, for tests without end: the first `count` of a kind and a seed, which
// are the same everywhere. Kinds are "map1_eval", "map2_eval", "grid" and "auto_normal".
void emit_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::ostream& lines);
// Reads answers as far as they are needed, so that answers in the order of the cases take no memory.
Score judge_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::istream& lines,
                   Answers& answers);

// Judges the answers to a file and takes them out of `answers`: what is left at the end has unknown ids.
Score judge(const nlohmann::json& file, Answers& answers);

}  // namespace evalcts::vectors
