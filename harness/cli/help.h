// What helps who types: examples, and the word that was meant.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}

namespace evalcts::cli {

// Puts examples under the help of each command that has some.
void add_examples(CLI::App& app);

// "did you mean --baseline?" for the first argument that is no command, or no option of its command, and is
// near to one; else empty.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& arguments);

// The candidate that the fewest insertions, deletions, replacements and swaps of neighbours make of the word;
// empty where it takes too many to be a slip.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace evalcts::cli
