#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "evalcts/reports.h"
#include "reports_templates.h"
#include "text.h"
#include "view.h"

namespace evalcts::reports {
namespace {

using namespace view;

// All that one record measured, and the tests with its largest errors. What one test measured stands with it.
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
    item.set("max_ulp", number(all.ulp.error));
    item.set("max_condition_aware", number(all.condition_aware.error));
    item.set("ulp_anchor", worst_ulp ? data(test_anchor(worst_ulp->name)) : data(false));
    item.set("aware_anchor", worst_aware ? data(test_anchor(worst_aware->name)) : data(false));
    out << item;
  }
  return out;
}

// One entry for each verdict, reason, and list of tests; implementations that agree in all of that share it.
data undecided_view(const std::vector<Column>& columns) {
  using Names = std::vector<std::string>;
  std::map<std::pair<Verdict, std::string>, std::map<Names, std::vector<std::string>>> labels;
  for (const Column& column : columns) {
    std::map<std::pair<Verdict, std::string>, Names> reasons;
    for (const TestRecord& outcome : column.record.tests) {
      if (outcome.verdict > Verdict::kQualityWarning && outcome.verdict < Verdict::kPass)
        reasons[{outcome.verdict, outcome.message}].push_back(outcome.name);
    }
    for (const auto& [reason, names] : reasons) labels[reason][names].push_back(column.label);
  }
  data out = list();
  for (const auto& [reason, groups] : labels) {
    for (const auto& [names, who] : groups) {
      data item, links = list();
      set_verdict(item, reason.first);
      item.set("label", join(who, ", "));
      item.set("why", reason.second.empty() ? "no reason given" : reason.second);
      item.set("n", count(names.size(), "test"));
      for (const std::string& name : names) {
        data link;
        link.set("anchor", test_anchor(name));
        link.set("name", name);
        links << link;
      }
      item.set("names", links);
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

data themes_view(const std::vector<Row>& rows) {
  std::set<std::string> themes;
  for (const Row& row : rows) themes.insert(row.name.substr(0, row.name.find('.')));
  data out = list();
  for (const std::string& theme : themes) out << data("theme", theme);
  return out;
}

// "372 of 395 requirements have a test here."
std::string reach(const Matrix& matrix, const Catalogue& catalogue) {
  if (catalogue.requirements.empty()) return {};
  std::set<std::size_t> places;
  for (const auto& [id, number] : matrix.numbers)
    if (const Requirement* known = catalogue.find(id)) places.insert(known->place);
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

// For each test, what has happened to it in each column.
std::map<std::string, std::vector<const Change*>> changes_by_test(const std::vector<Column>& columns,
                                                                  const Comparisons& comparisons) {
  std::map<std::string, std::vector<const Change*>> out;
  for (const Comparison& pair : comparisons.pairs)
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (pair.now != &columns[i].record) continue;
      for (const Change& change : pair.changes) {
        if (!change.now) continue;
        auto& of_test = out[change.now->name];
        of_test.resize(columns.size());
        of_test[i] = &change;
      }
    }
  return out;
}

data tests_view(const std::vector<Row>& rows, const std::vector<Column>& columns, const Catalogue& catalogue,
                const Matrix& requirements, const Comparisons& comparisons) {
  const auto changed = changes_by_test(columns, comparisons);
  const std::vector<const Change*> unchanged(columns.size());
  std::vector<const Row*> worst_first;
  for (const Row& row : rows) worst_first.push_back(&row);
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [](const Row* a, const Row* b) { return a->worst().severity() < b->worst().severity(); });
  data out = list();
  for (const Row* row : worst_first) {
    const auto change = changed.find(row->name);
    out << view::test(*row, change == changed.end() ? unchanged : change->second, columns, catalogue,
                      requirements);
  }
  return out;
}

}  // namespace

std::string html(const std::vector<RunResult>& results, const Catalogue& catalogue,
                 const PageOptions& options) {
  const std::vector<Column> columns = label_columns(results), earlier = label_columns(options.before);
  const std::vector<Row> rows = read_rows(columns);
  const Comparisons compared = compare(columns, earlier);

  data page;
  page.set("style", kPageStyle);
  page.set("script", kPageScript);
  page.set("several", columns.size() > 1);
  page.set("accuracy_page", options.accuracy_page);

  std::vector<std::string> labels;
  data cards = list(), headers = list();
  for (const Column& column : columns) {
    labels.push_back(column.label);
    cards << card(column);
    data header;
    header.set("label", column.label);
    header.set("column", fmt::format("{}", labels.size() - 1));
    headers << header;
  }
  page.set("title", "evalcts: " + (labels.empty() ? "no results" : join(labels, ", ")));
  page.set("subtitle", subtitle(rows, columns));
  page.set("implementations", cards);
  page.set("columns", headers);
  page.set("width", fmt::format("{}", columns.size() + 1));
  page.set("compared", !options.before.empty());
  page.set("comparisons", comparisons(compared));

  const Matrix by_requirement = matrix(rows, columns, catalogue);
  page.set("has_matrix", by_requirement.rows > 0);
  page.set("sections", by_requirement.sections);
  page.set("reach", optional_text(reach(by_requirement, catalogue)));
  page.set("themes", themes_view(rows));
  page.set("flakes", std::any_of(columns.begin(), columns.end(), [](const Column& column) {
             return std::any_of(column.record.tests.begin(), column.record.tests.end(),
                                [](const TestRecord& outcome) { return outcome.flake; });
           }));
  page.set("verdicts", verdict_list(columns, false));
  page.set("words", verdict_list(columns, true));
  page.set("tests", tests_view(rows, columns, catalogue, by_requirement, compared));

  const data accuracy = accuracy_view(columns), undecided = undecided_view(columns),
             followed = readings(columns, catalogue);
  page.set("has_accuracy", accuracy.is_non_empty_list() || options.accuracy_page);
  page.set("has_accuracy_table", accuracy.is_non_empty_list());
  page.set("accuracy", accuracy);
  page.set("has_undecided", undecided.is_non_empty_list());
  page.set("undecided", undecided);
  page.set("has_readings", followed.is_non_empty_list());
  page.set("readings", followed);
  return kainjow::mustache::mustache(kPageTemplate).render(page);
}

}  // namespace evalcts::reports
