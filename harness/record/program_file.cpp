// Writes and reads the file of the programs of a recording.
#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include <evalcts/record/programs.h>
#include <evalcts/results/files.h>

namespace evalcts::record {

void write_programs(const std::filesystem::path& file, const std::vector<Program>& programs) {
  std::string text;
  for (const Program& program : programs) text += program.name + "\t" + program.commands + "\n";
  write_atomically(file, text);
}

std::vector<Program> read_programs(const std::filesystem::path& file) {
  std::ifstream lines(file);
  std::vector<Program> programs;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos)
      throw std::runtime_error(fmt::format("'{}' is not a file of programs", file.string()));
    programs.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  if (programs.empty()) throw std::runtime_error(fmt::format("'{}' has no programs", file.string()));
  return programs;
}

}  // namespace evalcts::record
