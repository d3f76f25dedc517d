// Helps users with the command line: the layout of --help, and suggestions for mistyped words.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
class FormatterBase;
}  // namespace CLI

namespace evalcts::cli {

// Writes the text of --help.
std::shared_ptr<CLI::FormatterBase> help_formatter();

// Returns "did you mean --baseline?" for the first argument that is not a known command or option but is
// similar to one; empty if there is none.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& arguments);

// Returns the candidate with the smallest Damerau-Levenshtein distance from the word; empty if the distance
// exceeds a third of the word's length (but at least 1).
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace evalcts::cli
