// Writes the gnuplot scripts of the accuracy page, and adapts the SVG to the page's colours and IDs.
#include "figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <limits>

#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

constexpr int kPictureWidth = 900;
constexpr double kFloor = 0.1;  // least value on logarithmic scales; smaller values are drawn there

// Placeholder colours, which inlined() replaces by variables of the style sheet.
constexpr const char* kInkColour = "#010101";
constexpr const char* kFaintColour = "#020202";
constexpr const char* kZeroColour = "#030303";
constexpr const char* kUlpColour = "#040404";
constexpr const char* kConditionColour = "#050505";
// The number of colours that gnuplot gives to the series of a picture with many lines: #111101, #111102, ...
constexpr int kSeries = 12;

// Returns the error; null is infinity.
double error_of(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

std::string head(const std::string& id, int height) {
  return fmt::format(
      "set terminal svg size {0},{1} dynamic enhanced font 'sans-serif,12' name '{2}'\n"
      "set termoption noenhanced\n"
      "set encoding utf8\n"
      "set border 3 linecolor rgb '{3}' linewidth 0.7\n"
      "set tics nomirror textcolor rgb '{4}' scale 0.5\n",
      kPictureWidth, height, id, kFaintColour, kInkColour);
}

// Returns the number for gnuplot, limited to the scale from kFloor to `top`; what is not finite becomes
// `top`.
std::string plain(double x, double top) {
  return fmt::format("{:.5g}", std::isfinite(x) ? std::clamp(x, kFloor, top) : top);
}

std::string block(const std::string& name, const std::vector<std::string>& lines) {
  return "$" + name + " << EOD\n" + join(lines, "\n") + "\nEOD\n";
}

// Returns the text with characters replaced that gnuplot does not accept in names.
std::string id_of(std::string text) {
  for (char& c : text)
    if (std::string_view("abcdefghijklmnopqrstuvwxyz0123456789").find(c) == std::string_view::npos) c = '_';
  return text;
}

// Returns the implementation's row of this name if it was measured, otherwise null.
const json* row_named(const json& entry, const std::string& name) {
  for (const json& row : entry.at("rows"))
    if (as_text(row.at("name")) == name && row.contains("max_ulp")) return &row;
  return nullptr;
}

// Returns the commands that place a panel, in fractions of the picture from its lower left corner.
std::string panel(double left, double right, double bottom, double top) {
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\n",
      left, right, bottom, top);
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

// Replaces the colour in both formats of gnuplot: that of lines and that of text.
void replace_colour(std::string& svg, const char* colour, const std::string& variable) {
  const auto part = [&](int i) { return std::stoi(std::string(colour + 1 + 2 * i, 2), nullptr, 16); };
  replace_all(svg, fmt::format("rgb({:3d}, {:3d}, {:3d})", part(0), part(1), part(2)), variable);
  replace_all(svg, fmt::format("rgb({},{},{})", part(0), part(1), part(2)), variable);
}

}  // namespace

std::uint64_t natural(const json& number) {
  if (!number.is_number_integer() || number < 0) throw FormatError("expected a whole number, 0 or greater");
  return number.get<std::uint64_t>();
}

Figure errors_by_order(const json& ulp, const std::string& data) {
  Figure figure{
      id_of("by order " + data),
      "",
      fmt::format("The largest condition-aware error found by the order of curves, {} data, one line "
                  "for each implementation",
                  data),
      {}};
  std::string blocks, plots;
  std::vector<std::string> orders;
  for (const json& entry : ulp.at("implementations")) {
    std::vector<std::string> lines;
    for (const json& row : entry.at("rows")) {
      if (as_text(row.at("data")) != data || row.at("orders").size() != 1 || !row.contains("max_ulp"))
        continue;
      if (row.contains("target") && row.at("target") != ulp.at("targets").at(0)) continue;
      const std::string order = fmt::format("{}", natural(row.at("orders").at(0)));
      lines.push_back(fmt::format("{} {}", order, plain(error_of(row.at("max_condition_aware")), 1e4)));
      if (std::find(orders.begin(), orders.end(), order) == orders.end()) orders.push_back(order);
    }
    if (lines.size() < 2) continue;
    const std::size_t n = figure.names.size();
    figure.names.push_back(entry.at("name"));
    blocks += block(fmt::format("d{}", n), lines);
    plots += fmt::format(
        "{}$d{} using 1:2 with linespoints linewidth 1.6 dashtype {} pointtype {} pointsize 0.6 "
        "linecolor rgb '#1111{:02x}' title '@{}@'",
        plots.empty() ? "" : ", ", n, n < 5 ? 1 : 2, 1 + n % 13, 1 + n % kSeries, n);
  }
  if (plots.empty()) return figure;
  figure.script = head(figure.id, 380) + blocks + panel(0.085, 0.76, 0.14, 0.95) +
                  "set logscale xy\nset xrange [1.8:33]\nset yrange [*<0.5:*]\n" +
                  fmt::format("set xtics ({})\n", join(orders, ", ")) +
                  fmt::format(
                      "set xlabel 'order' textcolor rgb '{0}'\n"
                      "set ylabel 'largest error, 2^-24 · Σ|B||R|' textcolor rgb '{0}'\n"
                      "set key at screen 0.78,0.95 left top Left reverse textcolor rgb '{0}'\n"
                      "set grid ytics linecolor rgb '{1}' linewidth 0.3\n",
                      kInkColour, kFaintColour) +
                  "plot " + plots + "\n";
  return figure;
}

Figure errors_over_u(const json& ulp, const json& curve) {
  const std::string name = curve.at("name");
  Figure figure{
      id_of("over u " + name),
      "",
      fmt::format("Errors over u of {}: the largest in ULP and the largest condition-aware one in each "
                  "of so many intervals, a panel for each implementation, the zeros of the polynomial "
                  "marked",
                  curve.at("what").get<std::string>()),
      {}};
  constexpr double kTop = 1e9;
  constexpr int kPanel = 62, kFoot = 44, kHead = 26;
  std::vector<const json*> profiles;
  for (const json& entry : ulp.at("implementations"))
    for (const json& profile : entry.at("profiles"))
      if (as_text(profile.at("name")) == name && profile.contains("max_ulp")) {
        profiles.push_back(&profile);
        figure.names.push_back(entry.at("name"));
      }
  if (profiles.empty()) return figure;
  const int height = kHead + kFoot + kPanel * static_cast<int>(profiles.size());
  std::string script = head(figure.id, height);
  for (std::size_t n = 0; n < profiles.size(); ++n) {
    std::vector<std::string> lines;
    const json &by_ulp = profiles[n]->at("max_ulp"), &by_condition = profiles[n]->at("max_condition_aware");
    for (std::size_t i = 0; i < by_ulp.size(); ++i)
      lines.push_back(fmt::format("{:.7g} {} {}",
                                  (static_cast<double>(i) + 0.5) / static_cast<double>(by_ulp.size()),
                                  plain(error_of(by_ulp[i]), kTop), plain(error_of(by_condition[i]), kTop)));
    script += block(fmt::format("d{}", n), lines);
  }
  script += fmt::format(
      "set multiplot\nset logscale y\nset xrange [0:1]\nset yrange [{}:{}]\nset ytics ('1' 1, '10³' 1e3, "
      "'10⁶' "
      "1e6)\nunset key\nset grid ytics linecolor rgb '{}' linewidth 0.3\n",
      kFloor, kTop, kFaintColour);
  for (const json& zero : curve.at("zeros"))
    script += fmt::format(
        "set arrow from {0:.7g},graph 0 to {0:.7g},graph 1 nohead linecolor rgb '{1}' linewidth 1 dashtype 3 "
        "back\n",
        zero.get<double>(), kZeroColour);
  for (std::size_t n = 0; n < profiles.size(); ++n) {
    const double top = 1 - static_cast<double>(kHead + kPanel * static_cast<int>(n)) / height;
    const double bottom = top - static_cast<double>(kPanel - 8) / height;
    const bool last = n + 1 == profiles.size();
    script += panel(0.22, 0.98, bottom, top);
    script += fmt::format("set label 1 '@{}@' at graph -0.055,0.5 right textcolor rgb '{}'\n", n, kInkColour);
    script +=
        last ? fmt::format("set xtics 0,0.125,1 format '%g'\nset xlabel 'u' textcolor rgb '{}'\n", kInkColour)
             : "set xtics 0,0.125,1 format ''\n";
    if (n == 0)
      script += fmt::format("set key at screen 0.98,{:.5f} right top horizontal textcolor rgb '{}'\n",
                            1 - 2.0 / height, kInkColour);
    script += fmt::format(
        "plot $d{0} using 1:2 with lines linewidth 1.2 linecolor rgb '{1}' title 'ULP', $d{0} using 1:3 with "
        "lines linewidth 1.2 linecolor rgb '{2}' title 'condition-aware'\nunset key\n",
        n, kUlpColour, kConditionColour);
  }
  figure.script = script + "unset multiplot\n";
  return figure;
}

Figure histograms(const json& ulp) {
  Figure figure{
      "histograms",
      "",
      "Share of results by their error in ULP, logarithmic, a panel for each implementation and class of "
      "maps",
      {}};
  // A selection of classes in which implementations differ visibly, without those that no implementation has.
  std::vector<std::string> classes;
  for (const char* name :
       {"curve/4/ordinary", "curve/10/ordinary", "curve/30/ordinary", "surface/4x4/ordinary"})
    for (const json& entry : ulp.at("implementations"))
      if (row_named(entry, name) != nullptr) {
        classes.emplace_back(name);
        break;
      }
  std::vector<const json*> entries;
  for (const json& entry : ulp.at("implementations"))
    if (std::any_of(classes.begin(), classes.end(),
                    [&](const std::string& name) { return row_named(entry, name) != nullptr; })) {
      entries.push_back(&entry);
      figure.names.push_back(entry.at("name"));
    }
  if (entries.empty()) return figure;
  constexpr int kPanel = 58, kFoot = 44, kHead = 26;
  constexpr double kLeft = 0.2, kRight = 0.99, kGap = 0.035;
  const int height = kHead + kFoot + kPanel * static_cast<int>(entries.size());
  const double width = (kRight - kLeft) / static_cast<double>(classes.size());
  std::string script = head(figure.id, height);
  script += fmt::format(
      "set multiplot\nset logscale y\nset yrange [1e-5:1.5]\nset xrange [-1:25]\nunset key\nset style fill "
      "solid "
      "0.9 noborder\nset boxwidth 0.9\nset grid ytics linecolor rgb "
      "'{}' linewidth 0.3\n",
      kFaintColour);
  for (std::size_t n = 0; n < entries.size(); ++n) {
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const json* const row = row_named(*entries[n], classes[c]);
      if (row == nullptr) continue;
      const double values = std::max(1.0, row->at("values").get<double>());
      std::vector<std::string> lines;
      for (std::size_t bin = 0; bin < row->at("histogram").size(); ++bin) {
        const double count = row->at("histogram")[bin].get<double>();
        if (count > 0) lines.push_back(fmt::format("{} {:.6g}", bin, count / values));
      }
      if (lines.empty()) continue;
      const double top = 1 - static_cast<double>(kHead + kPanel * static_cast<int>(n)) / height;
      const double bottom = top - static_cast<double>(kPanel - 10) / height;
      const double left = kLeft + width * static_cast<double>(c);
      const bool last = n + 1 == entries.size();
      script += block("d", lines) + panel(left, left + width - kGap, bottom, top);
      script += c == 0 ? fmt::format(
                             "set label 1 '@{}@' at graph -0.33,0.5 right textcolor rgb '{}'\n"
                             "set ytics ('0.01 %%' 1e-4, '1 %%' 1e-2, '100 %%' 1)\n",
                             n, kInkColour)
                       : "unset label 1\nset ytics ('' 1e-4, '' 1e-2, '' 1)\n";
      script += n == 0 ? fmt::format("set label 2 '{}' at graph 0.5,1.2 center textcolor rgb '{}'\n",
                                     classes[c], kInkColour)
                       : "unset label 2\n";
      script += last ? fmt::format(
                           "set xtics ('½' 0, '4' 3, '64' 7, '2¹⁰' 11, '2¹⁴' 15, '2¹⁸' 19, '2²²' 23)\n"
                           "set xlabel 'error up to, ULP' textcolor rgb '{}'\n",
                           kInkColour)
                     : "set xtics ('' 0, '' 3, '' 7, '' 11, '' 15, '' 19, '' 23)\nunset xlabel\n";
      script += fmt::format("plot $d using 1:2 with boxes linecolor rgb '{}'\n", kUlpColour);
    }
  }
  figure.script = script + "unset multiplot\n";
  return figure;
}

std::string inlined(const Figure& figure, std::string svg) {
  const std::size_t begin = svg.find("<svg");
  const std::size_t end = svg.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos) return {};
  svg = svg.substr(begin, end + 6 - begin);
  for (const auto& [colour, variable] : {std::pair{kInkColour, "--text"},
                                         {kFaintColour, "--line"},
                                         {kZeroColour, "--bad"},
                                         {kUlpColour, "--ulp"},
                                         {kConditionColour, "--condition"}})
    replace_colour(svg, colour, fmt::format("var({})", variable));
  for (int i = 1; i <= kSeries; ++i)
    replace_colour(svg, fmt::format("#1111{:02x}", i).c_str(), fmt::format("var(--series-{})", i));
  replace_all(svg, "color=\"black\"", "color=\"var(--text)\"");
  // Some elements of gnuplot have the same IDs in all pictures.
  for (const char* name : {"gp", "textbox", "greybox", "gnuplot_canvas"}) {
    for (const char* before : {"id='", "id=\"", "href='#", "url(#"})
      replace_all(svg, before + std::string(name), before + figure.id + "_" + name);
  }
  // Several panels have the same IDs for their plots, which this page does not use.
  const std::string plot = " id=\"" + figure.id + "_plot_";
  for (std::size_t at = 0; (at = svg.find(plot, at)) != std::string::npos;)
    svg.erase(at, svg.find('"', at + plot.size()) + 1 - at);
  const std::size_t title = svg.find("<title>"), after = svg.find("<g ");
  if (title != std::string::npos && title < after) svg.erase(title, after - title);
  for (std::size_t i = 0; i < figure.names.size(); ++i)
    replace_all(svg, fmt::format("@{}@", i),
                kainjow::mustache::html_escape(clean(one_line(figure.names[i]))));
  return svg;
}

}  // namespace evalcts::reports
