// Parses the IDs of requirements, which may name one dimension ("EV-NUM-START/1-D").
#include <evalcts/results/requirement_id.h>

#include <algorithm>

namespace evalcts {
namespace {

constexpr std::string_view kSuffixes[] = {"", "/1-D", "/2-D"};  // indexed by dimension

}  // namespace

RequirementId::RequirementId(std::string_view text) : id(text) {
  for (const int half : {1, 2})
    if (text.ends_with(kSuffixes[half])) {
      dimension = half;
      id.resize(id.size() - kSuffixes[half].size());
    }
}

std::string RequirementId::text() const { return id + std::string(kSuffixes[dimension]); }

bool RequirementId::decides(const RequirementId& wanted) const {
  return id == wanted.id && (wanted.dimension == 0 || wanted.dimension == dimension);
}

std::vector<std::string> texts_of(const std::vector<RequirementId>& ids) {
  std::vector<std::string> texts;
  std::ranges::transform(ids, std::back_inserter(texts), &RequirementId::text);
  return texts;
}

}  // namespace evalcts
