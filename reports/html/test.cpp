#include <fmt/format.h>

#include <algorithm>

#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

std::string baseline_sentence(const TestRecord& test) {
  const std::string reason = test.baseline_reason.empty() ? "no reason given" : test.baseline_reason;
  if (test.is_expected_failure()) return "Expected by the baseline: " + reason;
  if (test.baseline_reason.empty()) return {};
  return (test.is_unexpected() ? "Not what the baseline expects: " : "Baseline: ") + reason;
}

void add_command(data& commands, const std::string& purpose, const std::string& command) {
  if (command.empty()) return;
  data item;
  item.set("purpose", purpose);
  item.set("command", command);
  commands << item;
}

// `above`: the failure before it. Several of one case have its calls, which may be long, in common.
data failure_view(const Failure& failure, const Failure* above) {
  data out;
  out.set("open", above == nullptr);
  out.set("case", failure.case_identity.empty() ? "this test" : failure.case_identity);
  out.set("far", optional_text(distance(failure.ulp, failure.condition_aware)));
  data rows = list();
  add_row(rows, "Message", failure.message);
  add_row(rows, "What", failure.what);
  add_row(rows, "Expected", failure.expected, true);
  add_row(rows, "Captured", failure.captured, true);
  add_row(rows, "Exact", failure.exact, true);
  add_row(rows, "ULP", failure.ulp ? number(failure.ulp) : "");
  add_row(rows, "Condition-aware", failure.condition_aware ? number(failure.condition_aware) : "");
  add_row(rows, "Capture", failure.capture);
  out.set("rows", rows);
  const bool said = above && !failure.calls.empty() && failure.calls == above->calls;
  out.set("calls_above", said);
  out.set("calls", optional_text(said ? "" : join(failure.calls, "\n")));
  return out;
}

// "2 of 12 cases failed, 1 recorded, seed 1, 0.020 s". Times are never the same: without them, those that are
// alike otherwise can share a line.
std::string facts_of(const TestRecord& test, bool with_time) {
  std::vector<std::string> facts;
  if (test.failed_cases.value_or(0) && test.cases) {
    facts.push_back(fmt::format("{} of {} failed", *test.failed_cases, count(*test.cases, "case")));
  } else if (test.cases) {
    facts.push_back(count(*test.cases, "case"));
  }
  if (test.failed_cases && *test.failed_cases > test.failures.size() && !test.failures.empty()) {
    facts.push_back(fmt::format("{} recorded", test.failures.size()));
  }
  if (!test.unobserved.empty()) facts.push_back("not observed: " + test.unobserved);
  if (test.seed) facts.push_back(fmt::format("seed {}", *test.seed));
  if (test.seconds && with_time) facts.push_back(fmt::format("{:.3f} s", *test.seconds));
  return join(facts, ", ");
}

// "480 values, largest error 3.5 ULP, condition-aware 1.25; not correctly rounded: 20 % (96); ..."
std::string accuracy_of(const TestRecord& test) {
  if (!test.accuracy) return {};
  const Accuracy& accuracy = *test.accuracy;
  std::string out = count(accuracy.values, "value");
  const std::string far = distance(accuracy.ulp.error, accuracy.condition_aware.error);
  if (!far.empty()) out += ", largest error " + far;
  out += "; not correctly rounded: " + share(accuracy);
  if (!accuracy.ulp.where.empty()) out += "; worst input: " + accuracy.ulp.where;
  return out;
}

// Said in one line, together with others of which the same is to be said.
bool is_quiet(const TestRecord& test) {
  return test.failures.empty() && !test.is_bad() && baseline_sentence(test).empty() && test.rerun.empty() &&
         test.debug.empty() && test.reproducer.empty();
}

std::string quiet_words(const TestRecord& test, bool with_time) {
  std::string out(text_of(test.verdict).word);
  const std::string accuracy = accuracy_of(test), facts = facts_of(test, with_time);
  // Of what was not played there are none.
  if (test.cases.value_or(1) && !facts.empty()) out += fmt::format(" ({})", facts);
  if (!test.message.empty()) out += ": " + test.message;
  return accuracy.empty() ? out : out + "; " + accuracy;
}

// Whether one description does for both. (Commands name the implementation, and times are never the same.)
bool tell_the_same(const TestRecord& a, const TestRecord& b) {
  return a.verdict == b.verdict && a.message == b.message && a.failures == b.failures && a.flake == b.flake &&
         a.again.has_value() == b.again.has_value() && (!a.again || a.again->verdict == b.again->verdict) &&
         baseline_sentence(a) == baseline_sentence(b) && a.cases == b.cases &&
         a.failed_cases == b.failed_cases && a.seed == b.seed && accuracy_of(a) == accuracy_of(b);
}

// Those that came out alike, each with its column.
using Alike = std::vector<std::pair<const TestRecord*, const Column*>>;

data outcome_view(const Alike& alike, bool several) {
  const TestRecord& test = *alike.front().first;
  std::vector<std::string> labels;
  for (const auto& [outcome, column] : alike) labels.push_back(column->label);
  data out;
  set_verdict(out, test.verdict);
  out.set("label", join(labels, ", "));
  // The summary line above shows the message of a test that has but one.
  const bool shown_above = !several && one_line(test.message) == test.message;
  out.set("message", optional_text(shown_above ? "" : test.message));
  out.set("baseline", optional_text(baseline_sentence(test)));
  out.set("facts_line", optional_text(facts_of(test, alike.size() == 1)));
  out.set("accuracy_line", optional_text(accuracy_of(test)));
  data failures = list();
  const Failure* above = nullptr;
  for (const Failure& failure : test.failures) {
    failures << failure_view(failure, above);
    above = &failure;
  }
  out.set("failures", failures);
  data commands = list();
  for (const auto& [outcome, column] : alike) {
    const std::string whose = alike.size() > 1 ? ", " + column->label : "";
    add_command(commands, "Run just this test" + whose, outcome->rerun);
    add_command(commands, "Open it in a debugger" + whose, outcome->debug);
    add_command(commands, "Make a C program of it" + whose, outcome->reproducer);
  }
  out.set("commands", commands);
  return out;
}

data requirement_view(const std::string& id, const Catalogue& catalogue, bool in_full) {
  const Requirement* found = in_full ? catalogue.find(id) : nullptr;
  const Requirement requirement = found ? *found : Requirement{};
  data out;
  out.set("id", id);
  out.set("anchor", requirement_anchor(id));
  out.set("section", optional_text(requirement.section));
  out.set("text", optional_text(requirement.text));
  out.set("source", optional_text(requirement.source));
  out.set("since", optional_text(requirement.since));
  return out;
}

// What the edge of a test's box says at a glance.
const char* state_of(const TestRecord& test) {
  if (test.is_bad()) return test.is_expected_failure() ? "warn" : "bad";
  if (test.verdict == Verdict::kQualityWarning || test.is_unexpected_pass()) return "warn";
  return test.verdict == Verdict::kPass ? "good" : "undecided";
}

// One chip for each verdict that the implementations got, worst first.
data chips_view(const Row& row, const std::vector<Column>& columns) {
  // By severity; flakes stand for themselves.
  std::map<std::pair<int, bool>, std::pair<const TestRecord*, std::vector<std::string>>> groups;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TestRecord* outcome = row.outcomes[i];
    if (!outcome) continue;
    auto& [example, labels] = groups[{outcome->severity(), outcome->flake}];
    example = outcome;
    labels.push_back(columns[i].label);
  }
  data out = list();
  for (const auto& [severity, group] : groups) {
    data chip;
    set_verdict(chip, group.first->verdict);
    std::vector<std::string> notes;
    if (const std::string note = baseline_note(*group.first); !note.empty()) notes.push_back(note);
    if (group.first->flake) notes.emplace_back("flake");
    chip.set("note", optional_text(join(notes, ", ")));
    const bool all_agree = group.second.size() == columns.size();
    chip.set("who", optional_text(all_agree ? "" : join(group.second, ", ")));
    out << chip;
  }
  return out;
}

// What the filters look at, for each column in order: the verdict, then "unexpected", "flake" and what has
// changed, with commas between; "absent" where there is no outcome.
std::string words_for_filters(const Row& row, const std::vector<const Change*>& changes) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
    const TestRecord* outcome = row.outcomes[i];
    std::string words(outcome ? text_of(outcome->verdict).word : "absent");
    if (outcome && outcome->is_unexpected()) words += ",unexpected";
    if (outcome && outcome->flake) words += ",flake";
    if (changes[i]) words += fmt::format(",{}", text_of(changes[i]->kind).filter);
    columns.push_back(words);
  }
  return join(columns, " ");
}

}  // namespace

data test(const Row& row, const std::vector<const Change*>& changes, const std::vector<Column>& columns,
          const Catalogue& catalogue, const Matrix& matrix) {
  const TestRecord& worst = row.worst();
  const bool several = columns.size() > 1;
  data out;
  out.set("anchor", test_anchor(row.name));
  set_name(out, row.name);
  out.set("theme", row.name.substr(0, row.name.find('.')));
  out.set("level", name_of(worst.level));
  out.set("headline", optional_text(one_line(worst.message)));
  out.set("differs", row.differs());
  out.set("state", state_of(worst));
  out.set("verdict_words", words_for_filters(row, changes));
  out.set("verdict_chips", chips_view(row, columns));

  // Records of different versions of the suite may name different requirements.
  std::vector<std::string> ids, row_numbers;
  std::vector<std::pair<std::string, std::vector<std::string>>> quiet;  // what is said, of whom
  std::vector<Alike> loud;
  bool all_pass = true;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TestRecord* outcome = row.outcomes[i];
    if (!outcome) continue;
    for (const std::string& id : texts_of(outcome->requirements)) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
    all_pass = all_pass && outcome->verdict == Verdict::kPass;
    if (!is_quiet(*outcome)) {
      auto same = std::find_if(loud.begin(), loud.end(), [&](const Alike& others) {
        return tell_the_same(*others.front().first, *outcome);
      });
      if (same == loud.end()) same = loud.insert(same, Alike{});
      same->emplace_back(outcome, &columns[i]);
      continue;
    }
    const std::string what = quiet_words(*outcome, !several);
    auto same =
        std::find_if(quiet.begin(), quiet.end(), [&](const auto& other) { return other.first == what; });
    if (same == quiet.end()) same = quiet.insert(same, {what, {}});
    same->second.push_back(columns[i].label);
  }
  data requirements = list();
  for (const std::string& id : ids) {
    requirements << requirement_view(id, catalogue, !all_pass);
    row_numbers.push_back(fmt::format("{}", matrix.numbers.at(id)));
  }
  data since = list();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!changes[i]) continue;
    data change;
    change.set("label", columns[i].label);
    change.set("kind", std::string(text_of(changes[i]->kind).word));
    change.set("was",
               changes[i]->before ? std::string(text_of(changes[i]->before->verdict).word) : "no such test");
    since << change;
  }
  data outcomes = list();
  for (const Alike& alike : loud) outcomes << outcome_view(alike, several);
  out.set("requirements", requirements);
  out.set("row_numbers", join(row_numbers, " "));
  out.set("changes", since);
  out.set("outcomes", outcomes);
  data lines = list();
  for (const auto& [what, labels] : quiet) {
    data line;
    line.set("who", optional_text(several ? join(labels, ", ") : ""));
    line.set("what", what);
    lines << line;
  }
  out.set("has_quiet", !quiet.empty());
  out.set("quiet", lines);
  return out;
}

}  // namespace evalcts::reports::view
