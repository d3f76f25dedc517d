// Text for a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace evalcts::cli {

// The words of `text` on lines of at most `columns` code points, every line but the first behind `indent`,
// which counts. `used`: columns of the first line that are taken already. A longer word has a line of its
// own.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent,
                    std::size_t used = 0);

// Columns of the terminal on standard output, between 80 and 100; 100 where it is none.
std::size_t terminal_columns();

}  // namespace evalcts::cli
