// Control cases: explicit vertices in the place of evaluation, under the same state. What goes wrong there,
// an error, a crash or a hang, is the pipeline's and not the evaluator's: the test is not-observable.
#pragma once

#include <string_view>

namespace evalcts {

// A case is a control where its identity says so.
inline bool is_control(std::string_view identity) { return identity.starts_with("control: "); }

}  // namespace evalcts
