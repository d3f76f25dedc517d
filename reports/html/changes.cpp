#include <fmt/format.h>

#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

// What the earlier record was made of, where that is not what it is now.
std::string earlier(const Comparison& pair) {
  const RunResult &before = *pair.before, &now = *pair.now;
  std::vector<std::string> parts;
  const auto add = [&parts](const std::string& then, const std::string& today) {
    if (!then.empty() && then != today) parts.push_back(one_line(then));
  };
  add(before.implementation.name, now.implementation.name);
  for (const auto member :
       {&ImplementationRecord::library, &ImplementationRecord::vendor, &ImplementationRecord::renderer,
        &ImplementationRecord::version, &ImplementationRecord::machine})
    add(before.implementation.*member, now.implementation.*member);
  if (before.evalcts_version != now.evalcts_version && !before.evalcts_version.empty())
    parts.push_back("evalcts " + one_line(before.evalcts_version));
  if (!before.origin.empty()) parts.push_back(one_line(before.origin));
  return join(parts, "; ");
}

data groups_view(const Comparison& pair) {
  data groups = list();
  for (std::size_t i = 0; i < kChangeKinds; ++i) {
    const auto kind = static_cast<ChangeKind>(i);
    const std::uint64_t n = pair.count(kind);
    if (n == 0) continue;
    data tests = list();
    for (const Change& change : pair.changes) {
      if (change.kind != kind) continue;
      data item;
      set_name(item, (change.now ? change.now : change.before)->name);
      item.set("anchor", change.now ? data(test_anchor(change.now->name)) : data(false));
      item.set("words", words_of(change));
      tests << item;
    }
    data group;
    group.set("n", fmt::format("{} {}", n, n == 1 ? text_of(kind).one : text_of(kind).several));
    group.set("class", kind <= ChangeKind::kNewFailure ? "fail"
                       : kind == ChangeKind::kFix      ? "pass"
                                                       : "other");
    group.set("open", kind <= ChangeKind::kFix);
    group.set("tests", tests);
    groups << group;
  }
  return groups;
}

}  // namespace

data comparisons(const Comparisons& comparisons) {
  data out = list();
  for (const Comparison& pair : comparisons.pairs) {
    data item, caveats = list();
    for (const std::string& caveat : pair.caveats) caveats << data("caveat", caveat);
    item.set("label", pair.label);
    item.set("headline", pair.headline());
    item.set("state", pair.regressions() ? "bad" : "good");
    item.set("earlier", optional_text(earlier(pair)));
    item.set("caveats", caveats);
    item.set("groups", groups_view(pair));
    out << item;
  }
  const auto alone = [&out](const std::vector<std::string>& labels, const char* words) {
    for (const std::string& label : labels) {
      data item;
      item.set("label", label);
      item.set("headline", words);
      item.set("state", "none");
      item.set("earlier", false);
      item.set("caveats", list());
      item.set("groups", list());
      out << item;
    }
  };
  alone(comparisons.only_now, "not in the earlier results");
  alone(comparisons.only_before, "only in the earlier results");
  return out;
}

}  // namespace evalcts::reports::view
