// Reduced random programs on which an implementation differed from the executable specification: the findings
// of the known bugs (bugs/README.md). Each has to behave as specified.
#include <evalcts/fuzz/events.h>
#include <evalcts/testkit/registration.h>

namespace evalcts::suite_findings {
namespace {

[[maybe_unused]] const bool kRegistered = [] {
  for (const fuzz::KnownFinding& finding : fuzz::known_findings())
    declare({"Findings", finding.name, {finding.requirement}, Level::kMust, nullptr}) << [&finding](Test& t) {
      t.prefer_fresh_contexts();  // many programs depend on the initial maps and grids
      t.judge(finding.program);
    };
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_findings
