// Writes the mutations of mutations.json as C++: mutation_list.h, a list for programs, and mutation_points.h,
// which defines what GLEV_AT and GLEV_HERE of production/src/mutation_point.h are in the mutated library.
//
// A row of mutations.json has "name", "what" (the mistake in words), "at" (the name of a point) and "code",
// or, for several points, "edits" with these two. At a GLEV_AT, the code replaces the expression; if it ends
// with ; or }, it is the body of a lambda that returns nothing. At a GLEV_HERE, it is executed, and may
// leave the function. A mutation that the conformance suite detects has a "level" (must or quality) and
// "requirements", IDs separated by blanks: for each, a test that names the ID must fail. "test" is a filter
// of tests of production that detect it.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

// Included directly and not through harness/results/include/evalcts/results/json.h, because production uses
// no other folder of the project.
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("'" + path.string() + "': cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Writes a file only if it changes, so that nothing is recompiled unnecessarily.
void write(const fs::path& path, const std::string& text) {
  if (fs::exists(path) && read(path) == text) return;
  fs::create_directories(path.parent_path());
  if (!(std::ofstream(path, std::ios::binary) << text))
    throw std::runtime_error("'" + path.string() + "': cannot be written");
}

// Returns a line of mutation_list.h: GLEV_MUTATION(name, level, requirements, what, test).
std::string definition(const json& row) {
  const auto text = [&row](const char* key) { return json(row.value(key, "")).dump(); };
  return "GLEV_MUTATION(" + row.at("name").get<std::string>() + ", " + row.value("level", "must") + ", " +
         text("requirements") + ", " + text("what") + ", " + text("test") + ")\n";
}

// The code of the mutations at a point: a chain of conditional expressions, or statements.
struct Point {
  std::string expression, statements;
};

void add(Point& point, int number, const std::string& code) {
  const std::string is_active = "::glev::mutation_is(" + std::to_string(number) + ")";
  const bool is_body = code.ends_with(';') || code.ends_with('}');
  point.expression += is_active + " ? (" + (is_body ? "[&] { " + code + " }()" : code) + ") : ";
  point.statements += "if (" + is_active + ") { " + code + " } ";
}

// Returns the sources as one text.
std::string read_all(const fs::path& sources) {
  std::string text;
  for (const fs::directory_entry& file : fs::directory_iterator(sources)) text += read(file.path());
  return text;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// Throws std::runtime_error unless the sources name the point exactly once.
void check(const std::string& sources, const std::string& name) {
  const int found = count(sources, "GLEV_AT(" + name + ",") + count(sources, "GLEV_HERE(" + name + ")");
  if (found != 1)
    throw std::runtime_error("the point " + name +
                             " of mutations.json must occur once in the sources, but occurs " +
                             std::to_string(found) + " times");
}

void write_headers(const fs::path& mutations, const std::string& sources, const fs::path& folder) {
  std::map<std::string, Point> points;
  std::string definitions, macros;
  int number = 0;
  for (const json& row : json::parse(read(mutations))) {
    definitions += definition(row);
    ++number;
    for (const json& edit : row.value("edits", json::array({row})))
      add(points[edit.at("at")], number, edit.at("code"));
  }
  for (const auto& [name, point] : points) {
    check(sources, name);
    macros += "#define GLEV_AT_" + name + "(...) (" + point.expression + "__VA_ARGS__)\n#define GLEV_HERE_" +
              name + " " + point.statements + "\n";
  }
  write(folder / "mutation_list.h", definitions);
  write(folder / "mutation_points.h", macros);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: write_mutations MUTATIONS.json SOURCE-FOLDER OUTPUT-FOLDER\n";
    return 2;
  }
  try {
    write_headers(argv[1], read_all(argv[2]), argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "write_mutations: " << error.what() << "\n";
    return 1;
  }
}
