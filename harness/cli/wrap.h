// Wraps text for a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace evalcts::cli {

// Returns the words of `text` on lines of at most `columns` code points. All lines but the first begin with
// `indent`, which counts as part of the line. `used` is the number of columns that are already used on the
// first line. A word that is too long gets its own line.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent,
                    std::size_t used = 0);

// Returns the number of columns of the terminal on standard output, limited to 80..100; 100 if there
// is no terminal.
std::size_t terminal_columns();

}  // namespace evalcts::cli
