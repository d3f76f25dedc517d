// Programs that random search found on some implementation, see findings/README.md: each has to do what the
// executable specification says.
#include "harness/fuzz/as_specified.h"
#include "harness/gl/case_json.h"
#include "harness/results/json.h"
#include "suites/generated/findings_data.h"

namespace evalcts::suite_findings {
namespace {

using nlohmann::json;

const json& findings() {
  static const json all = json::parse(kFindings);
  return all;
}

const bool kRegistered = [] {
  for (const json& finding : findings()) {
    const std::string name = finding.at("name");
    const auto* requirement = finding.at("requirement").get_ptr<const std::string*>();
    Registration(TestInfo{"Findings", name, {*requirement}, Level::must, [name, &finding](Test& t) {
                            gl::Case program = gl::case_from_json(finding.at("program"));
                            program.set_identity(name);
                            fuzz::expect_as_specified(t, program, specify(program, t.max_order()));
                          }});
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_findings
