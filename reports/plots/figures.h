// Makes the pictures of the accuracy page: scripts for gnuplot, and the resulting SVG as an element of the
// page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::reports {

struct Figure {
  std::string id;                  // prefix of the IDs in the picture, unique on the page
  std::string script;              // for gnuplot
  std::string caption;             // description of the picture
  std::vector<std::string> names;  // untrusted strings; the script has @0@, @1@, ... in their places
};

// Returns the number, which is an integer from 0 on. Throws FormatError for any other value.
std::uint64_t natural(const nlohmann::json& number);

// The argument `ulp` of the next three functions is that of accuracy_html(). If there is nothing to draw,
// they return an empty script.

// Returns the largest condition-aware errors of all implementations by the order of curves with this kind of
// data.
Figure errors_by_order(const nlohmann::json& ulp, const std::string& data);
// Returns the profile of one curve: errors over u, a panel for each implementation, zeros of the curve
// marked.
Figure errors_over_u(const nlohmann::json& ulp, const nlohmann::json& curve);
// Returns the shares of results by the size of their errors, a panel for each implementation and class of
// maps.
Figure histograms(const nlohmann::json& ulp);

// Returns gnuplot's SVG as an element of the page: with the colours of the page, and with the names of the
// figure in place of @0@, @1@, ... Returns an empty string if `svg` contains no SVG.
std::string inlined(const Figure& figure, std::string svg);

}  // namespace evalcts::reports
