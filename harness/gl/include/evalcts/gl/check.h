// A check on an answer of a played case, simple enough for a stand-alone C program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// A number that a played case answered.
struct Answer {
  enum class Of {
    returned,          // what a command returned
    element,           // an element of the array that a command wrote
    written,           // how many leading elements of its array a command wrote
    left_over,         // the first error after the last command
    emitted_value,     // one of the values of the emitted vertices, in the order of EmittedLayout
    emitted_vertices,  // how many vertices were emitted
  };
  Of of = Of::returned;
  Ref command = {};
  std::size_t element = 0;
  bool is_error = false;  // an enumerant of GetError, shown by its name
};

// Number of values of an emitted vertex: position, colour, normal, and texture coordinates of all units.
inline constexpr std::size_t kEmittedValues = 4 + 4 + 3 + 8 * 4;

struct Check {
  enum class Rule {
    within,        // the answer lies in one of the intervals
    same,          // two commands answer the same, bit for bit: answer.command and `other`
    unlike,        // no command answers what it answered when the failure was recorded: a test's own check
    has_commands,  // the library has all entry points
  };
  Rule rule = Rule::within;
  Answer answer = {};
  std::vector<std::pair<double, double>> accepted = {};  // closed
  Ref other = {};
  std::vector<Ref> recorded = {};  // for unlike: the commands that count
  std::size_t pass = 0;            // which of the played cases, where a capture needs several
  std::string what = {};           // "position.x of vertex 3", for people; empty: named after the command
  std::string expected = {};       // in words, where no interval says it
};

}  // namespace evalcts::gl
