// Draws the two pictures of `evalcts ulp` as SVG.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ulp.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

struct Series {
  std::string name;
  std::vector<std::array<double, 2>> points;  // x from 0 to 1, and an error, which may be infinite
};
struct Tick {
  double x;
  std::string text;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

// Returns a line chart whose vertical axis is logarithmic. Infinite errors lie at its top.
std::string chart(const std::string& title, const std::string& x_label, const std::string& y_label,
                  const std::vector<Tick>& ticks, const std::vector<Series>& all) {
  constexpr double kLeft = 70, kTop = 40, kWidth = 620, kHeight = 380;
  double low = 0, high = 1;  // exponents of 10
  for (const Series& series : all) {
    for (const auto& [x, error] : series.points) {
      if (error > 0) low = std::min(low, std::max(-3.0, std::floor(std::log10(error))));
      if (std::isfinite(error)) high = std::max(high, std::ceil(std::log10(error)));
    }
  }
  const auto px = [&](double x) { return kLeft + x * kWidth; };
  const auto py = [&](double error) {
    const double part = error > 0 ? (std::log10(error) - low) / (high - low) : 0;
    return kTop + (1 - std::clamp(part, 0.0, 1.0)) * kHeight;
  };
  std::string svg = fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 880 480" font-family="sans-serif" font-size="12">
<title>{0}</title>
<rect width="880" height="480" fill="white"/>
<text x="{1}" y="24" font-size="15">{0}</text>
<text x="{2}" y="468" text-anchor="middle">{3}</text>
<text transform="rotate(-90)" x="{4}" y="18" text-anchor="middle">{5}</text>
)svg",
      escaped(title), kLeft, kLeft + kWidth / 2, escaped(x_label), -(kTop + kHeight / 2), escaped(y_label));
  const auto add_line = [&](double x1, double y1, double x2, double y2) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n",
                       x1, y1, x2, y2);
  };
  const auto add_text = [&](double x, double y, const char* anchor, const std::string& text) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                       escaped(text));
  };
  for (double exponent = low; exponent <= high; exponent += std::ceil((high - low) / 12)) {
    const double y = py(std::pow(10, exponent));
    add_line(kLeft, y, kLeft + kWidth, y);
    add_text(kLeft - 6, y + 4, "end",
             exponent < -3 || exponent > 3 ? fmt::format("1e{}", exponent)
                                           : fmt::format("{:g}", std::pow(10, exponent)));
  }
  for (const Tick& tick : ticks) {
    add_line(px(tick.x), kTop, px(tick.x), kTop + kHeight);
    add_text(px(tick.x), kTop + kHeight + 18, "middle", tick.text);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Lines that cover each other stay visible by their dashes.
    static constexpr const char* kDashes[] = {"none", "7 3", "2 2", "10 2 2 2"};
    const std::string style =
        fmt::format(R"svg(fill="none" stroke-width="1.5" stroke="hsl({},70%,38%)" stroke-dasharray="{}")svg",
                    360 * i / all.size(), kDashes[i % std::size(kDashes)]);
    std::string points;
    for (const auto& [x, error] : all[i].points) points += fmt::format("{:.1f},{:.1f} ", px(x), py(error));
    svg += fmt::format("<polyline {} points=\"{}\"><title>{}</title></polyline>\n", style, points,
                       escaped(all[i].name));
    const double y = kTop + 8 + 18 * static_cast<double>(i);
    svg += fmt::format("<path {} d=\"M{},{}h24\"/>\n", style, kLeft + kWidth + 14, y);
    add_text(kLeft + kWidth + 44, y + 4, "start", all[i].name);
  }
  return svg + "</svg>\n";
}

}  // namespace

std::string errors_by_order(const json& ulp) {
  std::vector<int> orders;
  const auto for_rows = [&](const json& implementation, const auto& each) {
    for (const json& row : implementation["rows"])
      if (row["orders"].size() == 1 && as_text(row["data"]) == "ordinary" && !row.contains("not_measured") &&
          row.value("target", ulp["targets"][0]) == ulp["targets"][0])
        each(row["orders"][0].get<int>(), row["max_condition_aware"]);
  };
  for (const json& implementation : ulp["implementations"])
    for_rows(implementation, [&](int order, const json&) { orders.push_back(order); });
  std::ranges::sort(orders);
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  if (orders.empty()) return {};
  const auto place = [&](int order) {
    const auto index = std::ranges::find(orders, order) - orders.begin();
    return (static_cast<double>(index) + 0.5) / static_cast<double>(orders.size());
  };
  std::vector<Tick> ticks;
  for (const int order : orders) ticks.push_back({place(order), std::to_string(order)});
  std::vector<Series> all;
  for (const json& implementation : ulp["implementations"]) {
    Series series{implementation["name"], {}};
    for_rows(implementation, [&](int order, const json& error) {
      series.points.push_back({place(order), error_in(error)});
    });
    if (!series.points.empty()) all.push_back(std::move(series));
  }
  return chart("Largest errors of curves of ordinary data by order", "order", "condition-aware error", ticks,
               all);
}

std::string errors_by_argument(const json& ulp) {
  std::vector<Series> all;
  for (const json& implementation : ulp["implementations"]) {
    if (!implementation.contains("profile")) continue;
    const json& errors = implementation["profile"];
    Series series{implementation["name"], {}};
    for (std::size_t i = 0; i < errors.size(); ++i)
      series.points.push_back(
          {(static_cast<double>(i) + 0.5) / static_cast<double>(errors.size()), error_in(errors[i])});
    all.push_back(std::move(series));
  }
  if (all.empty()) return {};
  std::vector<Tick> ticks;
  for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) ticks.push_back({u, fmt::format("{:g}", u)});
  return chart("Largest errors along a cubic with three zeros", "u", "error in ULP", ticks, all);
}

}  // namespace evalcts::cli
