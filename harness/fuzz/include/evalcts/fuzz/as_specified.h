// A program on an implementation and on the executable specification, side by side.
#pragma once

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/test.h>

namespace evalcts::fuzz {

// The outcomes of a program that are compared.
enum class Look { kAll, kAnswers, kVertices };

// The body of a test: all that the commands answer, errors included, and all vertices that they emit have to
// be what the executable specification says of it, within what the specification allows (section 0.5,
// EV-GETMAP-FLOAT).
void expect_as_specified(Test& t, const gl::Case& program, const Specified& specified,
                         Look look = Look::kAll);

}  // namespace evalcts::fuzz
