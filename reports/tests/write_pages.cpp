// Writes pages into a folder, for check_pages.py and for people.
//   write_pages FOLDER                            the samples, alone, together and compared, and the hostile
//                                                 record
//   write_pages FOLDER REQUIREMENTS|- RESULTS...  index.html and junit-N.xml of these files
#include <filesystem>
#include <fstream>
#include <iostream>

#include <evalcts/results/files.h>
#include "evalcts/reports.h"
#include "samples.h"

namespace {

using nlohmann::json;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

json read(const std::string& path) {
  const json value = evalcts::parse_json(evalcts::read_file(path));
  if (value.is_discarded()) throw std::runtime_error("cannot read " + path);
  return value;
}

void write_samples(const std::filesystem::path& folder) {
  using namespace evalcts::reports;
  const json osmesa = read_sample("results-osmesa.json"), reference = read_sample("results-reference.json"),
             glx = read_sample("results-glx.json"), requirements = read_sample("requirements.json");
  write(folder / "one.html", html_of({osmesa}, requirements));
  write(folder / "three.html", html_of({osmesa, reference, glx}, requirements));
  write(folder / "none.html", html_of({}, nullptr));
  JsonOptions options;
  options.before = {earlier_sample()};
  write(folder / "compared.html", html_of({osmesa, reference}, requirements, options));
  write(folder / "compared.md", markdown_of({osmesa, reference}, options.before));
  options.before = {hostile_record()};
  write(folder / "hostile-compared.html",
        html_of({hostile_record(), hostile_record()}, hostile_requirements(), options));
  write(folder / "hostile.html", html_of({hostile_record(), hostile_record()}, hostile_requirements()));
  write(folder / "osmesa.xml", junit_of(osmesa));
  write(folder / "reference.xml", junit_of(reference));
  write(folder / "glx.xml", junit_of(glx));
  write(folder / "empty.xml", junit_of(json::object()));
  write(folder / "hostile.xml", junit_of(hostile_record()));
}

void write_files(const std::filesystem::path& folder, const std::vector<std::string>& files) {
  std::vector<json> results;
  for (std::size_t i = 1; i < files.size(); ++i) {
    results.push_back(read(files[i]));
    write(folder / ("junit-" + std::to_string(i) + ".xml"), evalcts::reports::junit_of(results.back()));
    std::cout << evalcts::reports::terminal_of(results.back(), nullptr, false, false) << '\n';
  }
  write(folder / "index.html", evalcts::reports::html_of(results, files[0] == "-" ? json() : read(files[0])));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.size() == 2) {
    std::cerr << "usage: write_pages FOLDER [REQUIREMENTS|- RESULTS...]\n";
    return 2;
  }
  try {
    std::filesystem::create_directories(arguments[0]);
    if (arguments.size() == 1) {
      write_samples(arguments[0]);
    } else {
      write_files(arguments[0], {arguments.begin() + 1, arguments.end()});
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
