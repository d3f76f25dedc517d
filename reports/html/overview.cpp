// The first parts of the page: the table of counts and the distinct bugs.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/results/conclusion.h>
#include <evalcts/results/documents.h>
#include <evalcts/results/known_bugs.h>
#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

// Returns the CSS class of a record; with known failures it is not "good".
const char* state_of(const RunResult& record) {
  if (!record.has_started()) return "none";
  if (!conclusion_of(record).problems.empty() || !record.is_complete()) return "bad";
  return record.expected_failure_count() ? "known" : "good";
}

data count_cell(const Column& column, Verdict verdict) {
  const RunResult& record = column.record;
  const std::uint64_t n = record.counts[static_cast<std::size_t>(verdict)];
  const bool all_known = is_failure(verdict) &&
                         std::all_of(record.tests.begin(), record.tests.end(), [&](const TestRecord& test) {
                           return test.verdict != verdict || test.is_expected_failure();
                         });
  data cell;
  cell.set("name", std::string(text_of(verdict).label));
  cell.set("class", n == 0 ? "zero" : all_known && !record.tests.empty() ? "known" : class_of(verdict));
  cell.set("n", fmt::format("{}", n));
  cell.set("link", n && !record.tests.empty()
                       ? data(link({{"on", column.label}, {"verdict", std::string(text_of(verdict).word)}}))
                       : data(false));
  return cell;
}

data row(const Column& column, std::size_t number, bool earlier, const std::vector<Verdict>& verdicts) {
  const RunResult& record = column.record;
  data out;
  out.set("label", column.label);
  out.set("number", fmt::format("{}", number));
  out.set("shown", !earlier);
  out.set("version", optional_text(record.implementation.version));
  out.set("started", optional_text(time_of(record)));
  out.set("state", state_of(record));
  out.set("headline", conclusion_of(record).text);
  out.set("headline_link", record.unexpected_count() && !record.tests.empty()
                               ? data(link({{"on", column.label}, {"new", "1"}}))
                               : data(false));
  const auto added =
      std::count_if(record.bugs.begin(), record.bugs.end(), [](const Bug& bug) { return bug.known.empty(); });
  out.set("bugs", record.bugs.empty() ? data(false)
                                      : data(count(record.bugs.size(), "distinct bug") +
                                             (added ? fmt::format(", {} new", added) : "")));
  data cells = list();
  for (const Verdict verdict : verdicts) cells << count_cell(column, verdict);
  out.set("cells", cells);
  out.set("total", fmt::format("{}", record.total()));
  return out;
}

}  // namespace

data bugs(const std::vector<Column>& columns) {
  data out = list();
  for (const BugRow& row : read_bugs(columns)) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (row.found[i])
        found.push_back(fmt::format("{} ({})", columns[i].label, count(row.found[i]->tests.size(), "test")));
    data item;
    const KnownBug* const known = find_known_bug(row.bug.known);
    item.set("title", in_plain_numbers(row.bug.title));
    item.set("id", row.bug.id);
    item.set("found", join(found, ", "));
    item.set("known", optional_text(row.bug.known_in.empty() ? row.bug.known : row.bug.known_in));
    item.set("cause_name", known && known->suspected ? "Suspected cause" : "Cause");
    item.set("cause", optional_text(known ? known->cause : ""));
    item.set("real_programs", optional_text(known ? known->real_programs : ""));
    item.set("clause", optional_text(row.bug.clause));
    data documents = list();
    for (const Document& document : documents_in(row.bug.clause)) {
      data one;
      one.set("name", document.name);
      one.set("address", document.address);
      documents << one;
    }
    item.set("documents", documents);
    item.set("calls", optional_text(join(row.bug.failure.calls, "\n")));
    out << item;
  }
  return out;
}

data overview(const std::vector<Column>& columns, std::size_t current, const Comparisons& compared) {
  std::vector<Verdict> verdicts;
  data header = list(), rows = list();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto occurs = [i](const Column& column) { return column.record.counts[i] != 0; };
    if (std::none_of(columns.begin(), columns.end(), occurs)) continue;
    verdicts.push_back(static_cast<Verdict>(i));
    data item;
    set_verdict(item, verdicts.back());
    header << item;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& column = columns[i];
    data item = row(column, i, i >= current, verdicts);
    const auto pair = std::find_if(compared.pairs.begin(), compared.pairs.end(),
                                   [&](const Comparison& one) { return one.now == &column.record; });
    const bool has_changes = pair != compared.pairs.end();
    const bool alone = std::find(compared.only_now.begin(), compared.only_now.end(), column.label) !=
                       compared.only_now.end();
    item.set("changes", has_changes            ? data(pair->headline())
                        : alone && i < current ? data("not in the earlier results")
                                               : data(false));
    data change_link(false);
    if (has_changes) {
      const auto before = std::find_if(columns.begin(), columns.end(),
                                       [&](const Column& one) { return &one.record == pair->before; });
      change_link = data(link({{"from", before->label}, {"to", column.label}}));
    }
    item.set("changes_link", change_link);
    item.set("changes_class", has_changes && pair->regressions() ? "bad" : "none");
    rows << item;
  }
  data out;
  out.set("verdicts", header);
  out.set("rows", rows);
  out.set("has_rows", !columns.empty());
  return out;
}

}  // namespace evalcts::reports::view
