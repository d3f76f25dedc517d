// Reduced random programs on which an implementation differed from the executable specification, see
// findings/README.md. Each has to behave as specified.
#include <evalcts/fuzz/as_specified.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/testkit/registration.h>

namespace evalcts::suite_findings {
namespace {

[[maybe_unused]] const bool kRegistered = [] {
  for (const fuzz::KnownFinding& finding : fuzz::known_findings())
    declare({"Findings", finding.name, {finding.requirement}, Level::kMust, nullptr}) << [&finding](Test& t) {
      fuzz::expect_as_specified(t, finding.program, specify(finding.program, t.max_order()));
    };
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_findings
