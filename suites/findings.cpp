// Programs that random search found on some implementation, see findings/README.md: each has to do what the
// executable specification says.
#include <evalcts/fuzz/as_specified.h>
#include <evalcts/fuzz/events.h>

namespace evalcts::suite_findings {
namespace {

const bool kRegistered = [] {
  for (const fuzz::KnownFinding& finding : fuzz::known_findings())
    Registration(TestInfo{"Findings", finding.name, {finding.requirement}, Level::must, [&finding](Test& t) {
                            fuzz::expect_as_specified(t, finding.program,
                                                      specify(finding.program, t.max_order()));
                          }});
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_findings
