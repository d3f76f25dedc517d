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

// "did you mean --baseline?" for the first argument that is no command, or no option of its command, and is
// near to one; else empty.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& arguments);

// The candidate that the fewest insertions, deletions, replacements and swaps of neighbours make of the word;
// empty where it takes too many to be a slip.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace evalcts::cli
