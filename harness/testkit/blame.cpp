// The table of blame. A wrong observation violates all requirements of the test, unless the table gives this
// kind of observation to some of them.
#include "blame.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>

namespace evalcts {
namespace {

struct Row {
  std::string_view part;  // of the IDs of requirements; the first row that matches is the row of an ID
  std::initializer_list<Observed> kinds;
};

constexpr Row kBlame[] = {
    // A rejected command has no effect. If it is not even rejected, the requirement on its error is violated.
    {"-NOEFFECT", {Observed::kAnswer, Observed::kChange}},
    {"-NOWRITE", {Observed::kWritten}},
    // Errors of commands in display lists.
    {"EV-DL-ERR-LATE", {Observed::kCompilingError}},
    {"EV-DL-COMPEXEC", {Observed::kCompilingError, Observed::kAnswer, Observed::kChange}},
    {"EV-DL-ERR-CONTINUE", {Observed::kAnswer}},
    {"EV-DL-ERR-ALL", {Observed::kError, Observed::kChange}},
    {"-ERR-", {Observed::kError, Observed::kCompilingError}},
};

bool is_violated_by(Observed observed, const RequirementId& requirement) {
  for (const Row& row : kBlame)
    if (requirement.id.find(row.part) != std::string::npos)
      return std::ranges::count(row.kinds, observed) > 0;
  return true;
}

}  // namespace

std::vector<RequirementId> violated_by(Observed observed, const std::vector<RequirementId>& requirements) {
  std::vector<RequirementId> violated;
  std::ranges::copy_if(requirements, std::back_inserter(violated),
                       [&](const RequirementId& each) { return is_violated_by(observed, each); });
  return violated.empty() ? requirements : violated;
}

}  // namespace evalcts
