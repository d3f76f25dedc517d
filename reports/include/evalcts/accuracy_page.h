// The page of `evalcts ulp`, made from the content of ulp.json and of sweeps. The functions use no other
// input (no files, no clock), so the same input always gives the same bytes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::reports {

// Returns the SVG that gnuplot draws from the script, which has no `set output`; none without gnuplot.
using Draw = std::function<std::optional<std::string>(const std::string& script)>;

// Returns one self-contained HTML page: the accuracy table (implementation by order), pictures of errors by
// order, over u and by size, the results of sweeps, and the worst inputs. It opens from disk and loads
// nothing. Pictures that `draw` (which may be empty) does not return are omitted, and a page without pictures
// says so; its tables have the same numbers.
// ulp: of the format evalcts-ulp-1; sweeps: of evalcts-sweep-1, complete or not. Strings in them may hold any
// text. Throws FormatError if a format is another one, and nlohmann::json::exception if a field is missing or
// of another type.
std::string accuracy_html(const nlohmann::json& ulp, const std::vector<nlohmann::json>& sweeps,
                          const Draw& draw);

// Returns true if accuracy_html accepts this as a sweep.
bool is_sweep(const nlohmann::json& sweep);

// These return the same numbers as comma-separated values: the table, errors over u, histograms, and worst
// inputs.
std::string table_csv(const nlohmann::json& ulp);
std::string profiles_csv(const nlohmann::json& ulp);
std::string histograms_csv(const nlohmann::json& ulp);
std::string worst_csv(const nlohmann::json& ulp);

}  // namespace evalcts::reports
