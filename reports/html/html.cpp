// Makes the HTML page from its template, its scripts and the data of view.h and data.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "data.h"
#include "evalcts/reports.h"
#include "reports_templates.h"
#include "text.h"
#include "view.h"

namespace evalcts::reports {
namespace {

using namespace view;

// Returns one row for each record that measured values: the accuracy over all its tests, and links to the
// tests with the largest errors.
data accuracy_view(const std::vector<Column>& columns) {
  data out = list();
  for (const Column& column : columns) {
    Accuracy all;
    const TestRecord *worst_ulp = nullptr, *worst_aware = nullptr;
    bool measured = false;
    for (const TestRecord& outcome : column.record.tests) {
      if (!outcome.accuracy) continue;
      measured = true;
      if (outcome.accuracy->ulp.error > all.ulp.error) worst_ulp = &outcome;
      if (outcome.accuracy->condition_aware.error > all.condition_aware.error) worst_aware = &outcome;
      all.add(*outcome.accuracy);
    }
    if (!measured) continue;
    data item;
    item.set("label", column.label);
    item.set("values", fmt::format("{}", all.values));
    item.set("share", share(all));
    item.set("max_ulp", plain_error(all.ulp.error));
    item.set("max_condition_aware", plain_error(all.condition_aware.error));
    item.set("ulp_link", worst_ulp ? data(link_to_test(worst_ulp->name)) : data(false));
    item.set("aware_link", worst_aware ? data(link_to_test(worst_aware->name)) : data(false));
    out << item;
  }
  return out;
}

data glossary() {
  data out = list();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    data item;
    set_verdict(item, static_cast<Verdict>(i));
    item.set("class", std::string(class_of(static_cast<Verdict>(i))));
    item.set("meaning", std::string(text_of(static_cast<Verdict>(i)).meaning));
    out << item;
  }
  return out;
}

// Returns "372 of 395 requirements have a test here." or the like; empty without a catalogue.
std::string reach(const std::vector<Row>& rows, const Catalogue& catalogue) {
  if (catalogue.requirements.empty()) return {};
  std::set<std::size_t> places;
  for (const Row& row : rows)
    for (const TestRecord* outcome : row.outcomes) {
      if (!outcome) continue;
      for (const RequirementId& id : outcome->requirements)
        if (const Requirement* known = catalogue.find(id)) places.insert(known->place);
    }
  return fmt::format("{} of {} have a test here.", places.size(),
                     count(catalogue.requirements.size(), "requirement"));
}

std::string subtitle(const std::vector<Row>& rows, const std::vector<Column>& columns) {
  const auto second_passes = std::count_if(
      columns.begin(), columns.end(), [](const Column& c) { return c.record.pass != Pass::kFreshContexts; });
  const std::size_t implementations = columns.size() - static_cast<std::size_t>(second_passes);
  return fmt::format("{} on {}{}", count(rows.size(), "test"), count(implementations, "implementation"),
                     second_passes ? ", with fresh contexts and with one shared context" : "");
}

// Returns the comparisons of each current column with each other column.
std::vector<Comparison> all_comparisons(const std::vector<Column>& columns, std::size_t current) {
  std::vector<Comparison> out;
  for (std::size_t to = 0; to < current; ++to)
    for (std::size_t from = 0; from < columns.size(); ++from) {
      if (from == to) continue;
      out.push_back(compare(columns[to], columns[from]));
      out.back().of_two_implementations = from < current;
    }
  return out;
}

}  // namespace

std::string html(const std::vector<RunResult>& results, const Catalogue& catalogue,
                 const PageOptions& options) {
  const std::vector<Column> columns = label_columns(results), earlier = label_columns(options.before);
  const Comparisons compared = compare(columns, earlier);
  std::vector<Column> all;
  for (const Column& column : columns) all.push_back(column);
  for (const Column& column : earlier) all.push_back({column.record, column.label + ", earlier"});
  const std::vector<Row> rows = read_rows(columns), all_rows = read_rows(all);

  data page;
  page.set("style", kPageStyle);
  page.set("script", fmt::format("(() => {{\n'use strict';\n{}{}{}{}{}{}}})();", kModelScript, kStateScript,
                                 kElementsScript, kPlotScript, kSectionsScript, kPageScript));
  page.set("data", page_data(all, earlier.size(), all_rows, catalogue, all_comparisons(all, columns.size()),
                             compared, options.sources));

  std::vector<std::string> labels;
  data cards = list(), headers = list();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    labels.push_back(columns[i].label);
    cards << card(columns[i], i < options.files.size() ? options.files[i] : std::vector<std::string>());
    headers << data("label", columns[i].label);
  }
  page.set("title", "evalcts: " + (labels.empty() ? "no results" : join(labels, ", ")));
  page.set("subtitle", subtitle(rows, columns));
  page.set("overview", overview(all, columns.size(), compared));
  const data bug_list = bugs(columns);
  page.set("has_bugs", bug_list.is_non_empty_list());
  page.set("bugs", bug_list);
  page.set("has_runs", !columns.empty());
  page.set("runs", cards);
  page.set("columns", headers);
  page.set("reach", optional_text(reach(rows, catalogue)));
  page.set("words", glossary());

  const data accuracy = accuracy_view(columns), followed = readings(columns, catalogue);
  page.set("has_accuracy", accuracy.is_non_empty_list());
  page.set("accuracy", accuracy);
  page.set("history", options.history.empty() ? data(false) : data(history_html(options.history)));
  page.set("has_readings", followed.is_non_empty_list());
  page.set("readings", followed);
  return kainjow::mustache::mustache(kPageTemplate).render(page);
}

}  // namespace evalcts::reports
