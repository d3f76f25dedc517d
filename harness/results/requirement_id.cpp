// Parses the IDs of requirements, which may name one dimension ("EV-NUM-START/1-D").
#include <evalcts/results/requirement_id.h>

#include <algorithm>
#include <mutex>
#include <set>

namespace evalcts {
namespace {

constexpr std::string_view kSuffixes[] = {"", "/1-D", "/2-D"};  // indexed by dimension

// Returns the ID in storage of its own: thousands of tests name the same few hundred IDs.
std::string_view kept(std::string_view id) {
  static std::mutex mutex;
  static std::set<std::string, std::less<>> all;
  const std::lock_guard lock(mutex);
  const auto found = all.find(id);
  return found != all.end() ? *found : *all.emplace(id).first;
}

}  // namespace

RequirementId::RequirementId(std::string_view text) {
  for (const int half : {1, 2})
    if (text.ends_with(kSuffixes[half])) {
      dimension = half;
      text.remove_suffix(kSuffixes[half].size());
    }
  id = kept(text);
}

std::string RequirementId::text() const { return std::string(id) + std::string(kSuffixes[dimension]); }

bool RequirementId::decides(const RequirementId& wanted) const {
  return id == wanted.id && (wanted.dimension == 0 || wanted.dimension == dimension);
}

std::vector<std::string> texts_of(const std::vector<RequirementId>& ids) {
  std::vector<std::string> texts;
  std::ranges::transform(ids, std::back_inserter(texts), &RequirementId::text);
  return texts;
}

}  // namespace evalcts
