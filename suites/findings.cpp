// The named programs of the register of known bugs, most of them found by random search. Each has to behave
// as specified.
#include <evalcts/fuzz/known_programs.h>
#include <evalcts/testkit/registration.h>

namespace evalcts::suite_findings {
namespace {

[[maybe_unused]] const bool kRegistered = [] {
  for (const fuzz::KnownProgram& known : fuzz::known_programs()) {
    if (known.record.name.empty()) continue;
    TestInfo info = test_info("Findings", known.record.name, Level::kMust, __FILE__, __LINE__);
    info.requirements = {known.record.requirement};
    TestDeclaration(info, Parameters<>()) << [&known](Test& t) {
      t.prefer_fresh_contexts();  // many programs depend on the initial maps and grids
      t.judge(known.program);
    };
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_findings
