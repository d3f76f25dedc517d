// Writes a history as HTML.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "history/history.h"
#include "html/view.h"
#include "reports_templates.h"
#include "text.h"

namespace evalcts::reports {
namespace {

using view::data;
using view::list;
using view::optional_text;

std::uint64_t failures_of(const PastRun& run) { return run.new_failures + run.known_failures; }

// Returns the plot of a number over the runs.
data plot_of(const Series& series, const std::string& label,
             const std::function<std::uint64_t(const PastRun&)>& value_of) {
  constexpr double kLeft = 8, kRight = 312, kTop = 24, kBottom = 102;  // in the viewBox of the template
  std::uint64_t most = 1;
  for (const Step& step : series.by_date) most = std::max(most, value_of(*step.run));
  data plot, dots = list();
  std::string points;
  for (std::size_t i = 0; i < series.by_date.size(); ++i) {
    const PastRun& run = *series.by_date[i].run;
    const double x = series.by_date.size() == 1 ? kLeft
                                                : kLeft + (kRight - kLeft) * static_cast<double>(i) /
                                                              static_cast<double>(series.by_date.size() - 1);
    const double y =
        kBottom - (kBottom - kTop) * static_cast<double>(value_of(run)) / static_cast<double>(most);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    data dot;
    dot.set("x", fmt::format("{:.1f}", x));
    dot.set("y", fmt::format("{:.1f}", y));
    dot.set("tip", fmt::format("{}, {}: {}", date_in_words(run), run.version, value_of(run)));
    dots << dot;
  }
  plot.set("label", label);
  plot.set("first", fmt::format("{}", value_of(*series.by_date.front().run)));
  plot.set("last", fmt::format("{}", value_of(*series.by_date.back().run)));
  plot.set("points", points);
  plot.set("dots", dots);
  return plot;
}

data bugs_of(const std::vector<PastRun::PastBug>& bugs) {
  data out = list();
  for (const PastRun::PastBug& bug : bugs) {
    data item;
    item.set("id", bug.id);
    item.set("title", bug.title);
    out << item;
  }
  return out;
}

// Sets what the rows of both tables have: version, number of bugs, and the bugs that came and went.
void set_step(data& row, const Step& step) {
  row.set("version", step.run->version);
  row.set("bugs", bugs_in_words(*step.run));
  row.set("came", bugs_of(step.came));
  row.set("went", bugs_of(step.went));
}

data series_view(const Series& series) {
  data out, plots = list(), runs = list(), versions = list(), verdicts = list();
  std::vector<std::size_t> shown;  // verdicts that occur
  for (std::size_t i = 0; i < kVerdicts; ++i)
    if (std::ranges::any_of(series.by_date, [i](const Step& step) { return step.run->counts[i] > 0; })) {
      shown.push_back(i);
      verdicts << data("word", std::string(text_of(static_cast<Verdict>(i)).label));
    }
  for (const Step& step : series.by_date) {
    const PastRun& run = *step.run;
    data row, cells = list();
    for (const std::size_t i : shown) cells << data("n", fmt::format("{}", run.counts[i]));
    set_step(row, step);
    row.set("date", date_in_words(run));
    row.set("new", fmt::format("{}", run.new_failures));
    row.set("new_class", run.new_failures ? data("bad") : data(false));
    row.set("known", fmt::format("{}", run.known_failures));
    row.set("cells", cells);
    row.set("run", run.run);
    runs << row;
  }
  for (const Step& step : series.by_version) {
    data row;
    set_step(row, step);
    versions << row;
  }
  if (!series.by_date.empty()) {
    plots << plot_of(series, "Bugs", [](const PastRun& run) { return run.bugs.size(); });
    plots << plot_of(series, "Failing tests", failures_of);
  }
  out.set("name", series.name);
  out.set("left_out", series.left_out ? data(count(series.left_out, "run")) : data(false));
  out.set("has_runs", !series.by_date.empty());
  out.set("plots", plots);
  out.set("verdicts", verdicts);
  out.set("runs", runs);
  out.set("versions", versions);
  return out;
}

}  // namespace

std::string history_html(const std::vector<PastRun>& runs) {
  data page, all = list();
  for (const Series& series : series_of(runs)) all << series_view(series);
  page.set("series", all);
  return kainjow::mustache::mustache(kHistoryTemplate).render(page);
}

}  // namespace evalcts::reports
