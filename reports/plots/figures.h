// Pictures as scripts for gnuplot, and the SVG that comes of them as part of a page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::reports {

struct Figure {
  std::string id;                  // of the elements within, unique on the page
  std::string script;              // for gnuplot
  std::string caption;             // what it shows, in words
  std::vector<std::string> names;  // strings of others, which the script knows as @0@, @1@, ...
};

// A whole number from 0 on. Throws FormatError for anything else.
std::uint64_t natural(const nlohmann::json& number);

// `ulp` as evalcts::reports::accuracy_html() gets it. None of these throws because there is nothing to draw:
// the script is empty then.

// The largest condition-aware error of each implementation by the order of curves with this kind of data.
Figure errors_by_order(const nlohmann::json& ulp, const std::string& data);
// Profile of one curve: errors over u, a panel for each implementation, zeros marked.
Figure errors_over_u(const nlohmann::json& ulp, const nlohmann::json& curve);
// Numbers of results by the size of their errors: a panel for each implementation and some classes of maps.
Figure histograms(const nlohmann::json& ulp);

// Returns a drawing of gnuplot as an element of the page: colours that follow the page's, text in place of
// @0@, a name for those who do not see it.
std::string inlined(const Figure& figure, std::string svg);

}  // namespace evalcts::reports
