// The table of blame. A wrong observation violates all requirements of the test, unless the table gives this
// kind of observation to some of them, or to a requirement of other tests.
#include "blame.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace evalcts {
namespace {

// Sets of observations.
class Kinds {
 public:
  constexpr Kinds(std::initializer_list<Observed> all) {
    for (const Observed each : all) bits_ |= static_cast<unsigned>(each);
  }
  constexpr bool has(Observed observed) const { return (bits_ & static_cast<unsigned>(observed)) != 0; }
  constexpr Kinds operator|(const Kinds& other) const {
    Kinds both = *this;
    both.bits_ |= other.bits_;
    return both;
  }

 private:
  unsigned bits_ = 0;
};
constexpr Kinds kCurrent = {Observed::kEvaluatedVertex, Observed::kExplicitVertex};
constexpr Kinds kAutomatic = {Observed::kAutomaticNormal, Observed::kRationalNormal};
constexpr Kinds kAnswers = {Observed::kError, Observed::kCompilingError, Observed::kAnswer, Observed::kChange,
                            Observed::kWritten};
constexpr Kinds kAllButCurrent = kAnswers | kAutomatic;

struct Row {
  std::string_view part;  // of the IDs of requirements; the first row that matches is the row of an ID
  Kinds kinds;            // the observations that violate it
};

constexpr Row kBlame[] = {
    // A rejected command has no effect. If it is not even rejected, the requirement on its error is violated.
    {"-NOEFFECT", Kinds{Observed::kAnswer, Observed::kChange} | kCurrent},
    {"-NOWRITE", {Observed::kWritten}},
    // Errors of commands in display lists.
    {"EV-DL-ERR-LATE", Kinds{Observed::kCompilingError} | kCurrent},
    {"EV-DL-COMPEXEC", Kinds{Observed::kCompilingError, Observed::kAnswer, Observed::kChange} | kCurrent},
    {"EV-DL-ERR-CONTINUE", Kinds{Observed::kAnswer} | kCurrent},
    {"EV-DL-ERR-ALL", Kinds{Observed::kError, Observed::kChange} | kCurrent},
    {"-ERR-", Kinds{Observed::kError, Observed::kCompilingError} | kCurrent},
    // The choice of a map shows in the values that maps supply.
    {"EV-PREC-", kAllButCurrent},
    {"EV-EN-MULTI", kAllButCurrent},
    {"EV-DL-EXECSTATE-MAP", kAllButCurrent},
    {"EV-COORD-MIXDIM", kAllButCurrent},
    {"EV-ATTRIB-EVALBIT", kAllButCurrent},
    {"EV-ATTRIB-NOMAPS", kAllButCurrent},
    // The direction and length of automatic normals have requirements of their own.
    {"EV-AUTON-DEGENERATE", kAnswers | kCurrent},
    {"EV-AUTON-SAMEVERTEX", kAnswers | kCurrent},
    // Requirements on all vertices of any program.
    {"EV-COORD-ASIF", kAllButCurrent},
    {"EV-DL-REPEAT", kAllButCurrent},
    {"EV-BE-ORDER", kAllButCurrent},
};

// The requirements that observations violate if they violate none of the test.
constexpr std::pair<Observed, const char*> kOwners[] = {{Observed::kEvaluatedVertex, "EV-COORD-CURRENT"},
                                                        {Observed::kExplicitVertex, "EV-CUR-NEXTVERTEX"},
                                                        {Observed::kAutomaticNormal, "EV-AUTON-CURVED"},
                                                        {Observed::kRationalNormal, "EV-AUTON-RATIONAL"}};

bool is_violated_by(Observed observed, const RequirementId& requirement) {
  for (const Row& row : kBlame)
    if (requirement.id.find(row.part) != std::string::npos) return row.kinds.has(observed);
  return true;
}

}  // namespace

std::vector<RequirementId> violated_by(Observed observed, const std::vector<RequirementId>& requirements) {
  std::vector<RequirementId> violated;
  std::ranges::copy_if(requirements, std::back_inserter(violated),
                       [&](const RequirementId& each) { return is_violated_by(observed, each); });
  if (!violated.empty()) return violated;
  for (const auto& [kind, owner] : kOwners)
    if (kind == observed) return {owner};
  return requirements;
}

}  // namespace evalcts
