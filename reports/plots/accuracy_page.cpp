// The data for accuracy.mustache, as strings in the order of the page. Mustache looks up a missing name in
// the enclosing sections, so every name that a section uses is set in it, to false if there is nothing to
// show.
#include "evalcts/accuracy_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <limits>

#include "evalcts/reports.h"
#include "figures.h"
#include "reports_templates.h"
#include "text.h"

namespace evalcts::reports {
namespace {

using kainjow::mustache::data;
using nlohmann::json;

data list_of() { return data(data::type::list); }

std::string shown(const std::string& text) { return clean(one_line(text)); }

std::string words(const json& entry, const char* name) { return shown(entry.value(name, "")); }

std::string error_text(const json& error) {
  return error.is_null() ? "inf" : fmt::format("{:.4g}", error.get<double>());
}

struct Kind {
  const char *data, *what;
};
constexpr Kind kKinds[] = {
    {"ordinary", "control points from -1 to 1"},
    {"integers", "from -9 to 9"},
    {"lines", "of degree 1, elevated"},
    {"cancelling", "(1-2u)^n (1-2v)^m, scaled"},
    {"wide", "magnitudes from 2^-60 to 2^60"},
    {"extreme",
     "at either end of the range of float, where floats themselves may be coarser than the unit of the "
     "condition-aware error"},
};

data implementations_view(const json& ulp) {
  data all = list_of();
  for (const json& entry : ulp.at("implementations")) {
    data item, facts = list_of();
    const std::string status = entry.at("status");
    item.set("name", words(entry, "name"));
    item.set("state", status == "complete" ? "good" : "bad");
    const auto add = [&](const char* term, const std::string& value) {
      if (value.empty()) return;
      data fact;
      fact.set("term", term);
      fact.set("value", value);
      facts << fact;
    };
    add("Status", status == "complete" ? "" : shown(status));
    add("Reason", words(entry, "reason"));
    add("Vendor", words(entry, "vendor"));
    add("Renderer", words(entry, "renderer"));
    add("Version", words(entry, "version"));
    item.set("facts", facts);
    // The project's own algorithms have no facts besides their names.
    if (facts.is_non_empty_list()) all << item;
  }
  return all;
}

// Returns the names of the classes of maps with this kind of data, in the order of the rows.
std::vector<std::string> classes_of(const json& ulp, const std::string& kind) {
  std::vector<std::string> names;
  for (const json& entry : ulp.at("implementations"))
    for (const json& row : entry.at("rows")) {
      const std::string name = row.at("name");
      if (as_text(row.at("data")) == kind && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  return names;
}

// Returns the implementation's row of this name, the first one if several targets have it; null without one.
const json* row_of(const json& entry, const std::string& name) {
  for (const json& row : entry.at("rows"))
    if (as_text(row.at("name")) == name) return &row;
  return nullptr;
}

data cell_of(const json* row) {
  data cell;
  cell.set("why", false);
  cell.set("share", "");
  cell.set("largest", "");
  cell.set("state", "none");
  if (row == nullptr) return cell;
  if (row->contains("not_measured")) {
    cell.set("why", shown(row->at("not_measured")));
    cell.set("share", "not measured");
    return cell;
  }
  const double values = row->at("values"), wrong = row->at("not_correctly_rounded");
  cell.set("share", fmt::format("{:.2f} %", values > 0 ? 100 * wrong / values : 0));
  cell.set("largest", error_text(row->at("max_condition_aware")));
  cell.set("state", wrong == 0 ? "right" : "wrong");
  return cell;
}

data tables_view(const json& ulp) {
  data all = list_of();
  for (const Kind& kind : kKinds) {
    const std::vector<std::string> names = classes_of(ulp, kind.data);
    if (names.empty()) continue;
    data table, orders = list_of(), rows = list_of();
    table.set("data", kind.data);
    table.set("what", kind.what);
    table.set("open", all.list_value().empty());
    for (const std::string& name : names) {
      const std::size_t slash = name.find('/');
      orders << data("order", shown(name.substr(slash + 1, name.rfind('/') - slash - 1)));
    }
    for (const json& entry : ulp.at("implementations")) {
      data row, cells = list_of();
      row.set("name", words(entry, "name"));
      for (const std::string& name : names) cells << cell_of(row_of(entry, name));
      row.set("cells", cells);
      rows << row;
    }
    table.set("orders", orders);
    table.set("rows", rows);
    all << table;
  }
  return all;
}

// Adds the picture with its heading and text, unless it cannot be drawn.
void add_figure(data& figures, const Figure& figure, const Draw& draw, const std::string& heading,
                const std::string& text, const std::string& points) {
  if (figure.script.empty() || !draw) return;
  const auto svg = draw(figure.script);
  const std::string drawn = svg ? inlined(figure, *svg) : "";
  if (drawn.empty()) return;
  data item;
  item.set("id", figure.id);
  item.set("heading", heading);
  item.set("caption", figure.caption);
  item.set("words", text);
  item.set("points", points.empty() ? data(false) : data(points));
  item.set("svg", drawn);
  figures << item;
}

data figures_view(const json& ulp, const Draw& draw) {
  data figures = list_of();
  for (const char* kind : {"ordinary", "cancelling"})
    add_figure(figures, errors_by_order(ulp, kind), draw, fmt::format("Errors by order, {} data", kind),
               "Curves; the largest condition-aware error found. A correctly rounded result stays below 1.",
               "");
  for (const json& curve : ulp.at("curves"))
    add_figure(
        figures, errors_over_u(ulp, curve), draw, "Errors over u: " + words(curve, "what"),
        "The largest of sixteen results in each 256th of the domain. Dashed lines mark the zeros of the "
        "polynomial, where the terms cancel: errors in ULP grow, condition-aware errors do not.",
        shown(join(curve.at("points").get<std::vector<std::string>>(), ", ")));
  add_figure(figures, histograms(ulp), draw, "How many errors are how large",
             "Shares of the random results, on a logarithmic scale; the first bar counts the results within "
             "half an ULP.",
             "");
  return figures;
}

std::string largest_of_sweep(const json& largest) {
  if (largest.is_null()) return "none";
  return fmt::format("{} at {}", error_text(largest.at("error")), shown(largest.at("at")));
}

std::string map_in_words(const json& sweep) {
  if (!sweep.contains("map")) return fmt::format("order {}", sweep.at("points").size());
  const json& map = sweep.at("map");
  std::string text = shown(map.at("target"));
  for (const json& order : map.at("orders"))
    text += fmt::format("{}{}", &order == &map.at("orders").front() ? ", order " : " x ", natural(order));
  if (map.contains("swept"))
    text += fmt::format(", along {}, the other argument {}", shown(map.at("swept")), shown(map.at("other")));
  return text;
}

data sweep_view(const json& sweep) {
  if (sweep.value("format", "") != "evalcts-sweep-1")
    throw FormatError("format: expected \"evalcts-sweep-1\"");
  const json &result = sweep.at("result"), &implementation = sweep.at("implementation");
  data item;
  item.set("implementation",
           shown(implementation.at("kind").get<std::string>() + " " + implementation.value("renderer", "") +
                 " " + implementation.value("version", "")));
  item.set("map", fmt::format("{}, from {} to {}", map_in_words(sweep), shown(sweep.at("interval").at(0)),
                              shown(sweep.at("interval").at(1))));
  item.set("points", shown(join(sweep.at("points").get<std::vector<std::string>>(), ", ")));
  item.set("values", fmt::format("{}", natural(result.at("values"))));
  item.set("wrong", fmt::format("{}", natural(result.at("not_correctly_rounded"))));
  item.set("ulp", largest_of_sweep(result.at("worst_ulp")));
  item.set("condition", largest_of_sweep(result.at("worst_condition_aware")));
  item.set("digest", shown(result.at("digest")));
  item.set("status", sweep.at("proven").get<bool>() ? "proven"
                     : as_text(sweep.at("status")) == "complete"
                         ? "largest found: shard " + shown(sweep.at("shard"))
                         : "largest found: unfinished");
  return item;
}

data sweeps_view(const std::vector<json>& sweeps) {
  data all = list_of();
  for (const json& sweep : sweeps) all << sweep_view(sweep);
  return all;
}

std::string float_text(const json& value) {
  return fmt::format("{} ({})", shown(value.at("value")), shown(value.at("bits")));
}

// Returns the words as a command line for a POSIX shell.
std::string shell_line(const json& command) {
  std::string line;
  for (const json& part : command) {
    std::string word = part.get<std::string>();
    if (word.empty() ||
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "+-./:,=_@%") != std::string::npos) {
      std::string quoted = "'";
      for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
      word = quoted + "'";
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line;
}

// Returns the worst inputs of each implementation, one by each of the two measures.
data worst_view(const json& ulp) {
  data all = list_of();
  const auto size_of = [](const json& error) {
    return error.is_null() ? std::numeric_limits<double>::infinity() : error.get<double>();
  };
  for (const json& entry : ulp.at("implementations"))
    for (const auto& [which, unit] :
         {std::pair{"worst_ulp", "ULP"}, {"worst_condition_aware", "condition-aware"}}) {
      const json* worst_row = nullptr;
      for (const json& row : entry.at("rows")) {
        if (!row.contains(which)) continue;
        if (as_text(row.at("data")) == "extreme" && which == std::string("worst_condition_aware")) continue;
        if (worst_row == nullptr ||
            size_of(row.at(which).at("error")) > size_of(worst_row->at(which).at("error")))
          worst_row = &row;
      }
      if (worst_row == nullptr) continue;
      const json& worst = worst_row->at(which);
      data item;
      item.set("implementation", words(entry, "name"));
      item.set("error", error_text(worst.at("error")));
      item.set("unit", unit);
      item.set("maps", words(*worst_row, "name"));
      item.set("at", shown(join(worst.at("at").get<std::vector<std::string>>(), ", ")));
      item.set("got", float_text(worst.at("got")));
      item.set("right", float_text(worst.at("right")));
      item.set("exact", words(worst, "exact"));
      item.set("found_by", words(worst, "found_by"));
      item.set("replay", shown(shell_line(worst.at("replay"))));
      all << item;
    }
  return all;
}

}  // namespace

bool is_sweep(const json& sweep) {
  try {
    sweep_view(sweep);
    return true;
  } catch (const json::exception&) {
  } catch (const FormatError&) {
  }
  return false;
}

std::string accuracy_html(const json& ulp, const std::vector<json>& sweeps, const Draw& draw) {
  if (ulp.value("format", "") != "evalcts-ulp-1") throw FormatError("format: expected \"evalcts-ulp-1\"");
  data page;
  page.set("style", kPageStyle);
  page.set("own_style", kPlotsStyle);
  std::vector<std::string> names;
  for (const json& entry : ulp.at("implementations")) names.push_back(words(entry, "name"));
  page.set("title", "evalcts: accuracy of " + join(names, ", "));
  page.set("subtitle", fmt::format("{}, seed {}, evalcts {}", count(names.size(), "implementation"),
                                   natural(ulp.at("seed")), words(ulp, "evalcts_version")));
  page.set("note", as_text(ulp.at("status")) == "complete"
                       ? data(false)
                       : data("The run was interrupted; this is what was finished."));
  page.set("implementations", implementations_view(ulp));
  page.set("tables", tables_view(ulp));
  const data figures = figures_view(ulp, draw);
  page.set("figures", figures);
  page.set("no_pictures",
           figures.is_non_empty_list()
               ? data(false)
               : data("No pictures: gnuplot draws them (package gnuplot-nox), and it is missing or "
                      "failed. The tables and the CSV files next to this page have the numbers."));
  page.set("has_sweeps", !sweeps.empty());
  page.set("sweeps", sweeps_view(sweeps));
  page.set("worst", worst_view(ulp));
  return kainjow::mustache::mustache(kAccuracyTemplate).render(page);
}

}  // namespace evalcts::reports
