// Prints cases as lines of numbers for another program to answer (INTERPRETING.md).
#include <fmt/format.h>

#include <evalcts/vectors/pipe.h>
#include "question.h"
#include "write/text.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

void append(std::string& line, const json& number) {
  line += ' ';
  line += number.is_string() ? number.get_ref<const std::string&>() : number.dump();
}

// Appends all numbers of nested lists in order.
void append_all(std::string& line, const json& list) {
  for (const json& entry : list) {
    if (entry.is_array())
      append_all(line, entry);
    else
      append(line, entry);
  }
}

void append_argument(std::string& line, const json& argument) {
  if (!argument.is_object()) return append(line, argument);
  for (const char* member : {"segments", "first", "last", "index"}) append(line, argument[member]);
}

std::string question(const json& entry, const std::string& kind) {
  const json& map = entry["map"];
  const json& points = map["points"];
  const bool two = points[0][0].is_array();
  const bool on_grid = entry["u"].is_object();
  std::string line = on_grid ? "grid" : kind == "auto_normal" ? "" : "map";
  if (kind == "auto_normal")
    line += "normal";
  else
    line += two ? '2' : '1';
  append(line, entry["id"]);
  append(line, map["type"]);
  append(line, two ? points[0][0].size() : points[0].size());
  append(line, points.size());
  if (two) append(line, points[0].size());
  append_all(line, map["domain"]);
  append_argument(line, entry["u"]);
  if (two) append_argument(line, entry["v"]);
  append_all(line, points);
  return line + '\n';
}

void append(std::string& line, double number) { line += ' ' + hexadecimal(number); }

void append(std::string& line, const Argument& argument) {
  if (!argument.is_grid()) return append(line, argument.coordinate());
  line += fmt::format(" {} {} {} {}", argument.segments(), hexadecimal(argument.first()),
                      hexadecimal(argument.last()), argument.index());
}

}  // namespace

std::string question(const RandomCases& cases) {
  const Problem& problem = cases.problem();
  const Map& map = problem.map;
  std::string line =
      fmt::format("{}{} {} {} {} {}",
                  problem.u.is_grid() ? "grid"
                  : cases.is_normal() ? ""
                                      : "map",
                  cases.is_normal() ? "normal"
                  : problem.v       ? "2"
                                    : "1",
                  cases.id(), problem.type == Type::kSingle ? 'f' : 'd', map.components(), map.u.order);
  if (problem.v) line += fmt::format(" {}", map.v.order);
  append(line, map.u.first);
  append(line, map.u.last);
  if (problem.v) {
    append(line, map.v.first);
    append(line, map.v.last);
  }
  append(line, problem.u);
  if (problem.v) append(line, *problem.v);
  for (const double value : map.points) append(line, value);
  return line + '\n';
}

void emit_random(const std::string& kind, std::uint64_t seed, std::uint64_t count, std::ostream& lines) {
  RandomCases cases(kind, seed);
  for (std::uint64_t i = 0; i < count && lines; ++i) {
    cases.draw();
    lines << question(cases);
  }
}

std::string emit(const json& file) {
  std::string lines;
  const std::string kind = file["kind"];
  if (kind == "errors" || kind == "get_map" || kind == "state") return lines;
  for (const json& entry : file["cases"]) lines += question(entry, kind);
  return lines;
}

}  // namespace evalcts::vectors
