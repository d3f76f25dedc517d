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
  enum class Kind {
    kReturned,         // the value that a command returned
    kElement,          // an element of the array that a command wrote
    kWritten,          // the number of leading elements of its array that a command wrote
    kLeftOver,         // the first error after the last command
    kEmittedValue,     // one of the values of the emitted vertices, in the order of EmittedLayout
    kEmittedVertices,  // the number of emitted vertices
  };
  Kind kind = Kind::kReturned;
  Ref command = {};
  std::size_t element = 0;
  bool is_error = false;  // an enumerant of GetError, shown by its name
};

// Number of values of an emitted vertex: position, colour, normal, and texture coordinates of all units.
inline constexpr std::size_t kEmittedValues = 4 + 4 + 3 + 8 * 4;

struct Check {
  enum class Rule {
    kWithin,       // the answer lies in one of the intervals
    kSame,         // the commands `answer.command` and `other` give the same answer, bit for bit
    kUnlike,       // at least one command of `recorded` no longer gives the answer recorded with the failure
    kHasCommands,  // the library provides all entry points
  };
  Rule rule = Rule::kWithin;
  Answer answer = {};
  std::vector<std::pair<double, double>> accepted = {};  // closed
  Ref other = {};
  std::vector<Ref> recorded = {};  // for kUnlike: the commands whose answers are compared
  std::size_t pass = 0;            // index of the executed case, if a capture needs several
  std::string what = {};           // "position.x of vertex 3", for people; empty: named after the command
  std::string expected = {};       // the expectation in words, if no interval states it
};

}  // namespace evalcts::gl
