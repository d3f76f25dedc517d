// Implements the reduction of crashes and hangs: each candidate runs in a separate process.
#include "death.h"

#include <evalcts/fuzz/known_programs.h>
#include <evalcts/fuzz/normal_form.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/runner/interruption.h>
#include "legal.h"
#include "reducer.h"
#include "shrink.h"

namespace evalcts::fuzz {

Finding finding_of_death(const gl::Case& program, const Difference& death, int max_eval_order) {
  Finding finding;
  finding.program = program;
  finding.failure.what = death.kind;
  finding.failure.difference = death;
  finding.failure.expected = "the program is run to its end";
  finding.failure.captured = death.kind;
  finding.failure.message = death.kind + (death.place.empty() ? "" : " at " + death.place);
  name_finding(finding, max_eval_order);
  return finding;
}

WorkerRun run_program(const std::vector<std::string>& command, const gl::Case& program,
                      const std::filesystem::path& log, const Limits& limits) {
  Worker worker(command, log, limits);
  worker.give({.kind = "case", .name = "program", .data = gl::to_text(program)});
  worker.finish();
  return worker.wait();
}

std::optional<Difference> death_of(const WorkerRun& run) {
  const bool is_own_fault = !run.ending.signalled && run.ending.value == kOwnFault;
  if (run.complete || interrupted || !run.died_in_job() || is_own_fault) return std::nullopt;
  if (run.hung) return Difference{Difference::kHang, run.crash ? run.crash->command() : "", ""};
  return Difference{Difference::kCrash, run.crash ? run.crash->group() : "", ""};
}

std::optional<Finding> reduce_death(const gl::Case& program, const Difference& death, const RunAlone& run,
                                    std::vector<Finding>& seen, int most, int max_eval_order) {
  const InterestingnessTest dies = [&](const gl::Case& candidate) {
    if (!specify_if_defined(candidate, max_eval_order)) return false;
    const std::optional<Difference> of_candidate = run(candidate);
    return of_candidate && of_candidate->is_like(death);
  };
  // One place is one bug. Without a place, the commands tell.
  const auto is = [&](const gl::Case& known) {
    return (!death.place.empty() || with_stems_of(known, program)) &&
           specify_if_defined(known, max_eval_order) && run(known) == std::optional(death);
  };
  for (const KnownProgram& known : known_programs())
    if (known.record.difference.kind == death.kind && is(known.program)) {
      Finding finding = finding_of_death(known.program, death, max_eval_order);
      finding.known = known.bug;
      return finding;
    }
  for (const Finding& earlier : seen)
    if (!death.place.empty() && earlier.failure.difference == death) return earlier;
  for (const gl::Case& form : forms_of(program))
    for (const Finding& earlier : seen)
      if (earlier.failure.difference.is_like(death))
        if (const std::optional<gl::Case> reduced = with_stems_of(earlier.program, form);
            reduced && dies(*reduced))
          return earlier;
  if (!dies(program)) return std::nullopt;
  gl::Case minimal = shrink(program, dies, most);
  const gl::Case control = gl::with_explicit_vertices(minimal);
  const bool is_outside = dies(control);
  Finding finding = finding_of_death(is_outside ? control : minimal, death, max_eval_order);
  finding.outside_evaluators = is_outside;
  seen.push_back(finding);
  return finding;
}

}  // namespace evalcts::fuzz
