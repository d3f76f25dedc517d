// Numbers and Markdown in the style of all reports.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/results/run_result.h>
#include <evalcts/results/text.h>

namespace evalcts::reports {

// Returns "123.4 ULP, condition-aware 5.6", or the part of it that is known; empty if neither is known.
std::string distance(std::optional<double> ulp, std::optional<double> condition_aware);

// Returns "flake: pass when run again", "another fail when run again" or the like; empty if the test was not
// run again or had the same outcome.
std::string repetition(const TestRecord& test);

// Returns "2 min 47 s", "47 s" or "1 h 5 min".
std::string duration(double seconds);
// Returns the start and the duration of a run, "2026-11-28 11:27 UTC, 2 min 47 s", as far as they are known.
std::string time_of(const RunResult& result);

std::string join(const std::vector<std::string>& parts, std::string_view separator);

// Returns a Markdown code span of the text, on one line, cut to `most` columns. Its fence is longer than any
// run of backticks in the text, so that no part of the text becomes markup, a link or a mention.
std::string markdown_code(const std::string& text, std::size_t most = 200);

// Returns a Markdown code span for a cell of a table. A bar becomes a slash, because a bar ends the cell even
// in code, and no escape for it works everywhere.
std::string markdown_cell(std::string text);

}  // namespace evalcts::reports
