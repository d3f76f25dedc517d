// Breaks text between words, counting code points as columns.
#include "wrap.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include <evalcts/cli/terminal.h>

namespace evalcts::cli {
namespace {

std::size_t code_points(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent,
                    std::size_t used) {
  std::istringstream words(text);
  std::string out;
  std::size_t column = used;
  bool first = true;  // the next word is the first of its line
  for (std::string word; words >> word;) {
    const std::size_t size = code_points(word);
    if (!first && column + 1 + size > columns) {
      out += "\n" + indent;
      column = code_points(indent);
      first = true;
    }
    out += (first ? "" : " ") + word;
    column += size + (first ? 0 : 1);
    first = false;
  }
  return out;
}

std::size_t terminal_columns() {
  const std::size_t columns = screen_of(STDOUT_FILENO).columns;
  return columns == 0 ? 100 : std::clamp<std::size_t>(columns, 80, 100);
}

}  // namespace evalcts::cli
