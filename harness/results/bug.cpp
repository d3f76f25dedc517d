// Sorts distinct bugs by importance.
#include <evalcts/results/bug.h>

#include <algorithm>
#include <tuple>

namespace evalcts {

void sort_by_importance(std::vector<Bug>& bugs) {
  // Descending in the first two and in the number of tests, ascending in the rest.
  const auto key = [](const Bug& bug) {
    return std::tuple(!bug.breaks_real_programs, -static_cast<int>(bug.level), bug.verdict,
                      -static_cast<std::ptrdiff_t>(bug.tests.size()), bug.id);
  };
  std::ranges::sort(bugs, {}, key);
}

}  // namespace evalcts
