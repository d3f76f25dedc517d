// Random programs: sequences of commands over the whole surface of evaluators, errors on purpose included.
#pragma once

#include <cstdint>

#include <evalcts/judge/prediction.h>

namespace evalcts::fuzz {

// The program of that number: the same for the same seed, on every machine. About `length` commands; what it
// does is defined (see specify_if_defined). A program draws one kind of primitives (most of them points, some
// lines, some polygons), so that every capture can show it. At its end nothing is open, the attribute stack
// is empty, texture unit 0 is active and no error is left.
gl::Case random_program(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order);

// The same with nothing but points, without what crashes some libraries (lists that call lists, queries of
// maps that are rejected), and without errors in lists, which have tests of their own: a past that commands
// of a test can come after.
gl::Case random_past(std::uint32_t seed, std::uint32_t number, int length, int max_eval_order);

struct SpecifiedProgram {
  gl::Case program;
  Specified specified;  // what it has to do
};
SpecifiedProgram random_specified_program(std::uint32_t seed, std::uint32_t number, int length,
                                          int max_eval_order);

}  // namespace evalcts::fuzz
