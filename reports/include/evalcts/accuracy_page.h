// The page of `evalcts ulp`: the content of ulp.json and of sweeps in, text out. Nothing else is read, no
// file is written, no clock is asked, so the same input always gives the same bytes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::reports {

// The SVG that gnuplot draws of a script, which ends before any `set output`; none where there is no gnuplot.
using Draw = std::function<std::optional<std::string>(const std::string& script)>;

// One self-contained HTML page: the accuracy table (implementation by order), pictures of errors by order,
// over u and by size, what sweeps have proven, and the worst inputs. It opens from disk and loads nothing.
// Pictures that `draw` (which may be empty) does not give are left out with a word; the tables have the same
// numbers. ulp: of the format evalcts-ulp-1; sweeps: of evalcts-sweep-1, complete or not. Strings in them may
// hold anything. Throws FormatError (evalcts/reports.h) where the formats are others, and
// nlohmann::json::exception where a field is missing or of another type.
std::string accuracy_html(const nlohmann::json& ulp, const std::vector<nlohmann::json>& sweeps,
                          const Draw& draw);

// Returns true if accuracy_html takes that as a sweep.
bool is_sweep(const nlohmann::json& sweep);

// The same numbers as comma-separated values: the table, errors over u, histograms, worst inputs.
std::string table_csv(const nlohmann::json& ulp);
std::string profiles_csv(const nlohmann::json& ulp);
std::string histograms_csv(const nlohmann::json& ulp);
std::string worst_csv(const nlohmann::json& ulp);

}  // namespace evalcts::reports
