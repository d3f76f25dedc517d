// Parses the programs of the register.
#include <evalcts/fuzz/known_programs.h>

#include <evalcts/fuzz/normal_form.h>
#include <evalcts/gl/case_json.h>

namespace evalcts::fuzz {

std::string KnownProgram::cause(int max_eval_order) const {
  Finding finding{program, {}};
  finding.failure.difference = record.difference;
  name_finding(finding, max_eval_order);
  return finding.cause;
}

bool KnownProgram::is_shown_by(const Failure& failure) const {
  return failure.difference.is_like(record.difference) &&
         (record.captured.empty() || record.captured == failure.captured);
}

const std::vector<KnownProgram>& known_programs() {
  static const std::vector<KnownProgram> kAll = [] {
    std::vector<KnownProgram> programs;
    for (const KnownBug& bug : known_bugs())
      for (const BugProgram& record : bug.programs) {
        programs.push_back({bug.id, record, gl::parse_case(record.commands)});
        programs.back().program.set_identity(record.name.empty() ? bug.id : record.name);
      }
    return programs;
  }();
  return kAll;
}

}  // namespace evalcts::fuzz
