// Compares a program on an implementation with the same program on the executable specification.
#pragma once

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/test.h>

namespace evalcts::fuzz {

// The outcomes of a program to compare. The order in which a mesh draws its points, lines or quads is free
// except for kOrder. kAll compares the vertices only if the program has to draw some.
enum class Look { kAll, kAnswers, kVertices, kOrder };

// The body of a test. All answers of the commands, including errors, and all emitted vertices must agree with
// `specified`, the outcome of the same program on the executable specification, within the permitted
// tolerances (the accuracy rule, EV-GETMAP-FLOAT).
void expect_as_specified(Test& t, const gl::Case& program, const Specified& specified,
                         Look look = Look::kAll);

}  // namespace evalcts::fuzz
