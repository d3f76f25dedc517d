// The page's view model: what index.mustache shows, as strings in the order in which it shows them. Mustache
// looks up a missing name in the enclosing sections, so every name a section uses is set in it, if only to
// false.
#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <limits>
#include <map>
#include <set>

#include "evalcts/reports.h"
#include "reports/record.h"
#include "reports/text.h"
#include "reports_templates.h"

namespace evalcts::reports {
namespace {

using kainjow::mustache::data;

data list() { return data(data::type::list); }

// Absent is false: in Mustache an empty string counts as there.
data optional_text(const std::string& text) { return text.empty() ? data(false) : data(text); }

void set_verdict(data& out, Verdict verdict) {
  out.set("word", std::string(text_of(verdict).word));
  out.set("symbol", std::string(text_of(verdict).symbol));
}

// A test's name, and the same in pieces after which a line may break.
void set_name(data& out, const std::string& name) {
  data parts = list();
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find_first_of("./", begin), name.size() - 1) + 1;
    parts << name.substr(begin, end - begin);
    begin = end;
  }
  out.set("name", name);
  out.set("name_parts", parts);
}

// The records of one page, each with a label of its own.
struct Column {
  Record record;
  std::string label;
};

// One test across the records; null where a record does not have it.
struct Row {
  std::string name;
  std::vector<const TestResult*> outcomes;

  const TestResult& worst() const {
    const TestResult* out = nullptr;
    for (const TestResult* test : outcomes) {
      if (test && (!out || test->severity() < out->severity())) out = test;
    }
    return *out;
  }
  // A record that lacks the test has no opinion.
  bool differs() const {
    const Verdict verdict = worst().verdict;
    return std::any_of(outcomes.begin(), outcomes.end(),
                       [verdict](const TestResult* test) { return test && test->verdict != verdict; });
  }
};

std::vector<Column> read_columns(const std::vector<nlohmann::json>& results) {
  std::vector<Column> columns;
  std::map<std::string, int> used;
  for (const nlohmann::json& result : results) {
    Record record = read_record(result);
    std::string label = record.heading("(unnamed)");
    const int n = ++used[label];
    if (n > 1) label += fmt::format(" ({})", n);
    columns.push_back({std::move(record), label});
  }
  return columns;
}

// In the order of first appearance.
std::vector<Row> read_rows(const std::vector<Column>& columns) {
  std::vector<Row> rows;
  std::map<std::string, std::size_t> index;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    for (const TestResult& test : columns[column].record.tests) {
      const auto [it, inserted] = index.emplace(test.name, rows.size());
      if (inserted) rows.push_back({test.name, std::vector<const TestResult*>(columns.size(), nullptr)});
      rows[it->second].outcomes[column] = &test;
    }
  }
  return rows;
}

// An id that needs no escaping in a fragment; different names give different ids.
std::string anchor(const std::string& name) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-";
  std::string out = "test-";
  for (const char c : name) {
    if (kPlain.find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("~{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::string baseline_note(const TestResult& test) {
  if (test.expected_bad()) return "expected";
  return test.unexpected_pass() ? "unexpected" : "";
}

std::string baseline_sentence(const TestResult& test) {
  const std::string reason = test.baseline_reason.empty() ? "no reason given" : test.baseline_reason;
  if (test.expected_bad()) return "Expected by the baseline: " + reason;
  if (test.baseline_reason.empty()) return {};
  return (test.unexpected() ? "Not what the baseline expects: " : "Baseline: ") + reason;
}

void add_row(data& rows, const char* term, const std::string& value, bool code = false) {
  if (value.empty()) return;
  data row;
  row.set("term", term);
  row.set("value", value);
  row.set("code", code);
  rows << row;
}

std::string text_of(std::optional<std::int64_t> n) { return n ? fmt::format("{}", *n) : std::string(); }

data card(const Column& column) {
  const Record& record = column.record;
  const Implementation& implementation = record.implementation;
  const bool not_started = record.status == "not-started";
  const std::uint64_t unexpected = record.unexpected_count(), expected = record.expected_bad_count();

  std::string headline = unexpected ? count(unexpected, "unexpected result") : "nothing unexpected";
  if (expected) headline += ", " + count(expected, "failing test") + " as the baseline expects";
  if (record.status.empty()) headline = "status unknown: " + headline;
  if (record.status == "interrupted") headline = "interrupted: " + headline;
  if (not_started) headline = "not started";

  data out;
  out.set("label", column.label);
  out.set("state", not_started ? "none" : unexpected || !record.complete() ? "bad" : "good");
  out.set("headline", headline);
  out.set("reason", optional_text(record.reason));

  data counts = list();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    if (!record.counts[i]) continue;
    data item;
    set_verdict(item, static_cast<Verdict>(i));
    item.set("n", fmt::format("{}", record.counts[i]));
    counts << item;
  }
  out.set("counts", counts);

  data facts = list();
  add_row(facts, "Library", implementation.library);
  add_row(facts, "Vendor", implementation.vendor);
  add_row(facts, "Renderer", implementation.renderer);
  add_row(facts, "Version", implementation.version);
  out.set("facts", facts);

  data circumstances = list();
  add_row(circumstances, "Tests", fmt::format("{}", record.total()));
  add_row(circumstances, "Depth", record.depth);
  add_row(circumstances, "Stale in the baseline", join(record.stale_baseline_entries, ", "));
  add_row(circumstances, "Largest order", text_of(implementation.max_eval_order));
  add_row(circumstances, "Machine", implementation.machine);
  add_row(circumstances, "Command", record.command, true);
  add_row(circumstances, "evalcts", record.evalcts_version);
  out.set("circumstances", circumstances);

  data captures = list();
  std::size_t available = 0;
  for (const Capture& capture : implementation.captures) {
    available += capture.available;
    data item;
    item.set("capture", capture.name);
    item.set("availability", capture.available ? "available" : "not available");
    item.set("why", optional_text(capture.reason));
    captures << item;
  }
  out.set("has_captures", !implementation.captures.empty());
  out.set("captures_summary", fmt::format("{} of {} available", available, implementation.captures.size()));
  out.set("captures", captures);

  data readings = list();
  for (const auto& [text, followed] : record.readings) {
    data item;
    item.set("text", text);
    item.set("reading", join(followed, " and "));
    readings << item;
  }
  out.set("has_readings", !record.readings.empty());
  out.set("readings", readings);
  return out;
}

void add_command(data& commands, const char* purpose, const std::string& command) {
  if (command.empty()) return;
  data item;
  item.set("purpose", purpose);
  item.set("command", command);
  commands << item;
}

data failure_view(const Failure& failure, bool open) {
  data out;
  out.set("open", open);
  out.set("case", failure.case_name.empty() ? "this test" : failure.case_name);
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
  out.set("calls", optional_text(join(failure.calls, "\n")));
  return out;
}

data outcome_view(const TestResult& test, const Column& column, bool several) {
  data out;
  set_verdict(out, test.verdict);
  out.set("label", column.label);
  // The summary line above shows the message of a test that has but one.
  const bool shown_above = !several && one_line(test.message) == test.message;
  out.set("message", optional_text(shown_above ? "" : test.message));
  out.set("baseline", optional_text(baseline_sentence(test)));

  std::vector<std::string> facts;
  if (test.failed_cases.value_or(0) && test.cases) {
    facts.push_back(fmt::format("{} of {} failed", *test.failed_cases, count(*test.cases, "case")));
  } else if (test.cases) {
    facts.push_back(count(*test.cases, "case"));
  }
  if (test.failed_cases && *test.failed_cases > test.failures.size() && !test.failures.empty()) {
    facts.push_back(fmt::format("{} recorded", test.failures.size()));
  }
  if (test.seed) facts.push_back(fmt::format("seed {}", *test.seed));
  if (test.seconds) facts.push_back(fmt::format("{:.3f} s", *test.seconds));
  out.set("facts_line", optional_text(join(facts, ", ")));

  data failures = list();
  for (const Failure& failure : test.failures)
    failures << failure_view(failure, &failure == &test.failures.front());
  out.set("failures", failures);
  data commands = list();
  add_command(commands, "Run just this test", test.rerun);
  add_command(commands, "Open it in a debugger", test.debug);
  add_command(commands, "Make a C program of it", test.reproducer);
  out.set("commands", commands);
  return out;
}

data requirement_view(const std::string& id, const Requirements& catalogue) {
  const Requirement* found = find_requirement(catalogue, id);
  const Requirement requirement = found ? *found : Requirement{};
  data out;
  out.set("id", id);
  out.set("section", optional_text(requirement.section));
  out.set("text", optional_text(requirement.text));
  out.set("source", optional_text(requirement.source));
  out.set("since", optional_text(requirement.since));
  return out;
}

// What the edge of a test's box says at a glance.
const char* state_of(const TestResult& test) {
  if (test.bad()) return test.expected_bad() ? "warn" : "bad";
  if (test.verdict == Verdict::kQualityWarning || test.unexpected_pass()) return "warn";
  return test.verdict == Verdict::kPass ? "good" : "undecided";
}

// One chip for each verdict that the implementations got, worst first.
data chips_view(const Row& row, const std::vector<Column>& columns) {
  std::map<int, std::pair<const TestResult*, std::vector<std::string>>> groups;  // by severity
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TestResult* test = row.outcomes[i];
    if (!test) continue;
    auto& [example, labels] = groups[test->severity()];
    example = test;
    labels.push_back(columns[i].label);
  }
  data out = list();
  for (const auto& [severity, group] : groups) {
    data chip;
    set_verdict(chip, group.first->verdict);
    chip.set("note", optional_text(baseline_note(*group.first)));
    chip.set("who", optional_text(columns.size() > 1 ? join(group.second, ", ") : ""));
    out << chip;
  }
  return out;
}

data test_view(const Row& row, const std::vector<Column>& columns, const Requirements& catalogue) {
  const TestResult& worst = row.worst();
  data out;
  out.set("anchor", anchor(row.name));
  set_name(out, row.name);
  out.set("level", optional_text(worst.level));
  out.set("headline", optional_text(one_line(worst.message)));
  out.set("differs", row.differs());
  out.set("state", state_of(worst));

  // Records of different versions of the suite may name different requirements.
  std::vector<std::string> ids, words;
  data outcomes = list();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TestResult* test = row.outcomes[i];
    if (!test) continue;
    for (const std::string& id : test->requirements) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
    words.emplace_back(text_of(test->verdict).word);
    if (test->unexpected()) words.emplace_back("unexpected");
    outcomes << outcome_view(*test, columns[i], columns.size() > 1);
  }
  data requirements = list();
  for (const std::string& id : ids) requirements << requirement_view(id, catalogue);
  out.set("requirements", requirements);
  out.set("verdict_words", join(words, " "));
  out.set("outcomes", outcomes);
  out.set("verdict_chips", chips_view(row, columns));
  return out;
}

data matrix_view(const std::vector<Row>& rows) {
  data out = list();
  for (const Row& row : rows) {
    data cells = list();
    for (const TestResult* test : row.outcomes) {
      data cell;
      cell.set("word", "absent");
      cell.set("symbol", false);
      if (test) set_verdict(cell, test->verdict);
      cell.set("shown", test ? std::string(text_of(test->verdict).word) : "not in this record");
      cell.set("note", optional_text(test ? baseline_note(*test) : ""));
      cells << cell;
    }
    data item;
    item.set("anchor", anchor(row.name));
    set_name(item, row.name);
    item.set("cells", cells);
    out << item;
  }
  return out;
}

std::string share(const Accuracy& accuracy) {
  if (!accuracy.incorrectly_rounded || !accuracy.values || *accuracy.values == 0) return "unknown";
  const double ratio =
      static_cast<double>(*accuracy.incorrectly_rounded) / static_cast<double>(*accuracy.values);
  return fmt::format("{:.3g} % ({})", 100 * ratio, *accuracy.incorrectly_rounded);
}

data accuracy_view(const std::vector<Row>& rows, const std::vector<Column>& columns) {
  data out = list();
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const TestResult* test = row.outcomes[i];
      if (!test || !test->accuracy) continue;
      const Accuracy& accuracy = *test->accuracy;
      data item;
      item.set("anchor", anchor(row.name));
      set_name(item, row.name);
      item.set("label", columns[i].label);
      item.set("values", accuracy.values ? fmt::format("{}", *accuracy.values) : "unknown");
      item.set("max_ulp", number(accuracy.max_ulp));
      item.set("max_condition_aware", number(accuracy.max_condition_aware));
      item.set("share", share(accuracy));
      item.set("worst", accuracy.worst);
      out << item;
    }
  }
  return out;
}

// One entry for each implementation, verdict and reason, with the tests that share them.
data undecided_view(const std::vector<Column>& columns) {
  data out = list();
  for (const Column& column : columns) {
    std::map<std::pair<Verdict, std::string>, std::vector<std::string>> reasons;
    for (const TestResult& test : column.record.tests) {
      if (test.verdict > Verdict::kQualityWarning && test.verdict < Verdict::kPass) {
        reasons[{test.verdict, test.message}].push_back(test.name);
      }
    }
    for (const auto& [key, tests] : reasons) {
      data item, names = list();
      set_verdict(item, key.first);
      item.set("label", column.label);
      item.set("why", key.second.empty() ? "no reason given" : key.second);
      item.set("n", count(tests.size(), "test"));
      for (const std::string& name : tests) {
        data test;
        test.set("anchor", anchor(name));
        test.set("name", name);
        names << test;
      }
      item.set("names", names);
      out << item;
    }
  }
  return out;
}

// The verdicts that occur (for the filter), or all of them (for the glossary).
data verdict_list(const std::vector<Column>& columns, bool all) {
  data out = list();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto occurs = [i](const Column& column) { return column.record.counts[i] != 0; };
    if (!all && std::none_of(columns.begin(), columns.end(), occurs)) continue;
    data item;
    set_verdict(item, static_cast<Verdict>(i));
    item.set("meaning", std::string(text_of(static_cast<Verdict>(i)).meaning));
    out << item;
  }
  return out;
}

}  // namespace

std::string html(const std::vector<nlohmann::json>& results, const nlohmann::json& requirements) {
  const Requirements catalogue = read_requirements(requirements);
  const std::vector<Column> columns = read_columns(results);
  const std::vector<Row> rows = read_rows(columns);

  data page;
  page.set("style", kPageStyle);
  page.set("script", kPageScript);
  page.set("several", columns.size() > 1);

  std::vector<std::string> labels;
  data cards = list(), headers = list();
  for (const Column& column : columns) {
    labels.push_back(column.label);
    cards << card(column);
    headers << data("label", column.label);
  }
  page.set("title", "evalcts: " + (labels.empty() ? "no results" : join(labels, ", ")));
  const auto second_passes =
      std::count_if(columns.begin(), columns.end(), [](const Column& c) { return !c.record.pass.empty(); });
  const std::size_t implementations = columns.size() - static_cast<std::size_t>(second_passes);
  page.set("subtitle",
           fmt::format("{} on {}{}", count(rows.size(), "test"), count(implementations, "implementation"),
                       second_passes ? ", with fresh contexts and with one shared context" : ""));
  page.set("implementations", cards);
  page.set("columns", headers);
  page.set("verdicts", verdict_list(columns, false));
  page.set("words", verdict_list(columns, true));
  page.set("matrix", columns.size() > 1 ? matrix_view(rows) : list());

  std::vector<const Row*> worst_first;
  for (const Row& row : rows) worst_first.push_back(&row);
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [](const Row* a, const Row* b) { return a->worst().severity() < b->worst().severity(); });
  data tests = list();
  for (const Row* row : worst_first) tests << test_view(*row, columns, catalogue);
  page.set("tests", tests);

  const data accuracy = accuracy_view(rows, columns), undecided = undecided_view(columns);
  page.set("has_accuracy", accuracy.is_non_empty_list());
  page.set("accuracy", accuracy);
  page.set("has_undecided", undecided.is_non_empty_list());
  page.set("undecided", undecided);
  return kainjow::mustache::mustache(kPageTemplate).render(page);
}

}  // namespace evalcts::reports
