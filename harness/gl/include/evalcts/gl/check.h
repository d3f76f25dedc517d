// A check on an answer of an executed case, simple enough for a stand-alone C program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// A number that an executed case answered.
struct Answer {
  enum class Of {
    kReturned,         // what a command returned
    kElement,          // an element of the array that a command wrote
    kWritten,          // how many leading elements of its array a command wrote
    kLeftOver,         // the first error after the last command
    kEmittedValue,     // one of the values of the emitted vertices, in the order of EmittedLayout
    kEmittedVertices,  // how many vertices were emitted
  };
  Of of = Of::kReturned;
  Ref command = {};
  std::size_t element = 0;
  bool is_error = false;  // an enumerant of GetError, shown by its name
};

// Number of values of an emitted vertex: position, colour, normal, and texture coordinates of all units.
inline constexpr std::size_t kEmittedValues = 4 + 4 + 3 + 8 * 4;

struct Check {
  enum class Rule {
    kWithin,       // the answer lies in one of the intervals
    kSame,         // two commands answer the same, bit for bit: answer.command and `other`
    kUnlike,       // no command answers what it answered when the failure was recorded: a test's own check
    kHasCommands,  // the library has all entry points
  };
  Rule rule = Rule::kWithin;
  Answer answer = {};
  std::vector<std::pair<double, double>> accepted = {};  // closed
  Ref other = {};
  std::vector<Ref> recorded = {};  // for unlike: the commands that count
  std::size_t pass = 0;            // which of the executed cases, where a capture needs several
  std::string what = {};           // "position.x of vertex 3", for people; empty: named after the command
  std::string expected = {};       // in words, where no interval says it
};

}  // namespace evalcts::gl
