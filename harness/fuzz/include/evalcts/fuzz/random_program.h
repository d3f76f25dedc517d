// Makes random programs: sequences of all kinds of commands of evaluators, including deliberate errors.
#pragma once

#include <cstdint>

#include <evalcts/judge/prediction.h>

namespace evalcts::fuzz {

// Returns the program with this number, which is the same for the same seed on every machine. It has about
// `length` commands, and its outcome is defined (see specify_if_defined). A program draws one kind of
// primitives (mostly points, some lines, some polygons), so that every capture can show it. At its end no
// primitive or list is open, the attribute stack is empty, texture unit 0 is active and no error is pending.
gl::Case random_program(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order);

// Returns a program as above to run before the commands of a test. It draws only points, and has no commands
// that crash some libraries (lists that call lists, rejected queries of maps) and no errors in lists, which
// other tests cover.
gl::Case random_past(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order);

struct SpecifiedProgram {
  gl::Case program;
  Specified specified;  // its required outcome
};
// Returns the program of random_program() together with its outcome.
SpecifiedProgram random_specified_program(std::uint32_t seed, std::uint32_t number, int length,
                                          int max_eval_order);

}  // namespace evalcts::fuzz
