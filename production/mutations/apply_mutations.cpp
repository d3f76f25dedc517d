// Writes the sources of the mutated library: copies of production/src with the mutations of mutations.json,
// each behind a run-time switch (mutation.h), and mutation_list.h, the list of mutations for C++ programs. It
// is a step of the build, so a mutation whose snippet is no longer in the sources stops the build of the
// mutated library.
//
// A row of mutations.json has "name", "what" (the mistake in words), "file", "find" and "replace", or, for
// several places, "edits" with these three. "find" is a snippet that occurs once in the file: a statement if
// it ends with ; or }, otherwise an expression. Declarations in it must not be used after it. A mutation that
// the conformance suite detects has a "level" (must or quality) and "requirements", IDs separated by blanks:
// for each, a test that names the ID must fail. "test" is a filter of tests of production that detect it.
#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// Included directly and not through harness/results/include/evalcts/results/json.h, because production uses
// no other folder of the project.
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Replacement {
  int number;  // number of the mutation
  std::string name, code;
};

// One or more mutations of the same snippet, which is [begin, end) of the source.
struct Place {
  std::size_t begin, end;
  std::vector<Replacement> replacements;
};

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

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// Returns the end of the snippet if it begins at `begin` of the source, otherwise npos. Any white space
// matches any other, so that formatting the sources does not invalidate mutations.
std::size_t end_of_match(std::string_view source, std::size_t begin, std::string_view snippet) {
  for (std::size_t i = 0; i < snippet.size();) {
    if (is_space(snippet[i])) {
      if (begin == source.size() || !is_space(source[begin])) return std::string_view::npos;
      while (begin < source.size() && is_space(source[begin])) ++begin;
      while (i < snippet.size() && is_space(snippet[i])) ++i;
    } else if (begin == source.size() || source[begin++] != snippet[i++]) {
      return std::string_view::npos;
    }
  }
  return begin;
}

// Returns the place of the snippet. Throws std::runtime_error unless it occurs exactly once.
Place find_place(std::string_view source, std::string_view snippet) {
  std::vector<Place> found;
  for (std::size_t begin = 0; begin < source.size(); ++begin) {
    const std::size_t end = end_of_match(source, begin, snippet);
    if (end != std::string_view::npos) found.push_back({begin, end, {}});
  }
  if (found.size() != 1)
    throw std::runtime_error("'find' must occur exactly once, but occurs " + std::to_string(found.size()) +
                             " times: " + std::string(snippet));
  return found.front();
}

bool is_statement(std::string_view snippet) { return snippet.ends_with(';') || snippet.ends_with('}'); }

// Returns the code that replaces the snippet.
std::string mutated(const std::string& snippet, const Place& place) {
  const auto condition = [](const Replacement& replacement) {
    return "::glev::mutation_is(" + std::to_string(replacement.number) + ")";
  };
  std::string code;
  if (is_statement(snippet)) {
    for (const Replacement& replacement : place.replacements)
      code += "if (" + condition(replacement) + ") { " + replacement.code + " } else ";
    return "{ " + code + "{ " + snippet + " } }";
  }
  for (const Replacement& replacement : place.replacements)
    code += condition(replacement) + " ? (" + replacement.code + ") : ";
  return "(" + code + "(" + snippet + "))";
}

// The mutations of one source file.
class Source {
 public:
  explicit Source(const fs::path& path) : text_(read(path)) {}

  void add(const std::string& snippet, Replacement replacement) {
    const Place place = find_place(text_, snippet);
    for (Place& other : places_) {
      if (place.begin == other.begin && place.end == other.end) {
        other.replacements.push_back(std::move(replacement));
        return;
      }
      if (place.begin < other.end && other.begin < place.end)
        throw std::runtime_error("'find' overlaps that of " + other.replacements.front().name +
                                 "; use the same 'find' for both: " + snippet);
    }
    places_.push_back(place);
    places_.back().replacements.push_back(std::move(replacement));
  }

  std::string text() {
    std::ranges::sort(places_, {}, &Place::begin);
    std::string result = "#include <mutations/mutation.h>\n";
    std::size_t begin = 0;
    for (const Place& place : places_) {
      result += text_.substr(begin, place.begin - begin);
      result += mutated(text_.substr(place.begin, place.end - place.begin), place);
      begin = place.end;
    }
    return result + text_.substr(begin);
  }

 private:
  std::string text_;
  std::vector<Place> places_;
};

// Returns a line of mutation_list.h: GLEV_MUTATION(name, level, requirements, what, test).
std::string definition(const json& row) {
  const auto text = [&row](const char* key) { return json(row.value(key, "")).dump(); };
  return "GLEV_MUTATION(" + row.at("name").get<std::string>() + ", " + row.value("level", "must") + ", " +
         text("requirements") + ", " + text("what") + ", " + text("test") + ")\n";
}

// Writes the mutated copies. `from`: the folder of the sources; `to`: the root of the copies, which have the
// same relative paths.
void apply(const fs::path& mutations, const fs::path& from, const fs::path& to) {
  std::map<std::string, Source> sources;
  for (const fs::directory_entry& file : fs::directory_iterator(from))
    if (file.path().extension() == ".h" || file.path().extension() == ".cpp")
      sources.emplace(file.path().filename().string(), Source(file.path()));
  std::string definitions, errors;
  int number = 0;
  for (const json& row : json::parse(read(mutations))) {
    const std::string name = row.at("name");
    ++number;
    definitions += definition(row);
    for (const json& edit : row.value("edits", json::array({row}))) {
      const std::string file = edit.at("file");
      const auto source = sources.find(file);
      try {
        if (source == sources.end()) throw std::runtime_error("no such file");
        source->second.add(edit.at("find"), {number, name, edit.at("replace")});
      } catch (const std::runtime_error& error) {
        errors.append(mutations.string())
            .append(": mutation ")
            .append(name)
            .append(", file ")
            .append(file)
            .append(": ")
            .append(error.what())
            .append("\n");
      }
    }
  }
  if (!errors.empty()) throw std::runtime_error(errors);
  write(to / "mutation_list.h", definitions);
  for (auto& [name, source] : sources) write(to / "src" / name, source.text());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: apply_mutations MUTATIONS.json SOURCE-FOLDER OUTPUT-FOLDER\n";
    return 2;
  }
  try {
    apply(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "apply_mutations:\n" << error.what() << "\n";
    return 1;
  }
}
