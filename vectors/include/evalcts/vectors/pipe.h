// The vectors as lines of text, and the judgement of a program's answers ("In a pipe" of INTERPRETING.md).
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

// Returns a line for each case of a file, or an empty string for sequences, which a pipe does not ask. `file`
// has passed check_structure().
std::string emit(const nlohmann::json& file);

// The answers of a program.
struct Answers {
  // Answers by id. An answer without numbers is a skipped case.
  std::map<std::string, std::vector<double>> of;
  std::vector<std::string> answered_twice;  // ids
  std::vector<std::string> malformed;       // messages that begin with the number of the line
  std::size_t lines = 0;                    // number of lines read
};

// Reads a line and adds its answer. Returns false at the end of the stream.
bool read_answer(std::istream& lines, Answers& answers);
// Reads all lines. Numbers are hexadecimal or decimal, "inf" or "nan". Ignores empty lines and lines that
// begin with #.
Answers read_answers(std::istream& lines);

struct Wrong {
  std::string id;
  std::string message;  // the component, its value, and the accepted values
};

// The score of the answers to one file.
struct Score {
  std::string kind;
  std::size_t cases = 0, skipped = 0;
  std::vector<std::string> missing;
  std::vector<Wrong> wrong;
  // Numbers of answered cases and of wrong ones among them, by flag.
  struct Count {
    std::size_t answered = 0, wrong = 0;
  };
  std::map<std::string, Count> by_flag;
  // Number of values that have an acceptance interval (normals have none), the number of these that are
  // correctly rounded to binary32, and the largest error in ULP of binary32, with the id of its case.
  std::size_t values = 0, correctly_rounded = 0;
  double largest_ulp = 0;
  std::string largest_id;
  // Quality by target (GL_AUTO_NORMAL for normals): the number of judged values of maps of type "f" at
  // coordinates (not at points of grids), the number of these that are worse than single precision, and the
  // largest error as a multiple of the bound of single precision, with the id of its case. Infinity means
  // that the value at a corner of the domain is not its control point.
  struct Quality {
    std::size_t values = 0, worse = 0;
    double largest = 0;
    std::string id;

    void add(double multiple, const std::string& id_of_case);
    void add(const Quality& other);
  };
  std::map<std::string, Quality> quality;
};

// Returns one line: the number of targets for which a program is as good as single precision, and the other
// targets with their worst cases. Empty if nothing was measured.
std::string quality_in_words(const std::vector<Score>& scores);

// Writes the first `count` random cases of a kind ("map1_eval", "map2_eval", "grid" or "auto_normal") and a
// seed. They are the same on every machine.
void emit_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::ostream& lines);
// Judges the answers to these cases, and removes them from `answers`. Reads lines only until the answer to
// the next case is found, so that answers in the order of the cases take no memory.
Score judge_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::istream& lines,
                   Answers& answers);

// Judges the answers to the cases of a file and removes them from `answers`. Those that remain after all
// files have unknown ids.
Score judge(const nlohmann::json& file, Answers& answers);

}  // namespace evalcts::vectors
