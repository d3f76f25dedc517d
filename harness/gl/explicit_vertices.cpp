#include "harness/gl/explicit_vertices.h"

namespace evalcts::gl {
namespace {

// Vertices that differ from each other.
void vertex(Case& c, int number) {
  c.Vertex3f(0.0625f * static_cast<float>(number % 16), 0.03125f * static_cast<float>(number % 32), 0.25f);
}

}  // namespace

Case with_explicit_vertices(const Case& script) {
  Case control(script.identity());
  std::vector<int> places;
  bool in_primitive = false;
  for (const Command& written : script.commands()) {
    const int number = static_cast<int>(places.size());
    const std::string_view name = name_of(written.entry);
    if (name == "glBegin") in_primitive = true;
    if (name == "glEnd") in_primitive = false;
    if (name.starts_with("glEvalMesh")) {
      if (in_primitive) {  // an error without effect
        places.push_back(-1);
        continue;
      }
      const bool line = std::get<std::int64_t>(written.arguments[0]) == GL_LINE;
      control.Begin(line ? GL_LINE_STRIP : GL_POINTS);
      for (const int i : {number, number + 1}) vertex(control, i);
      control.End();
    } else if (name.starts_with("glEval")) {
      vertex(control, number);
    } else {
      Command command = written;
      for (Value& argument : command.arguments)
        if (auto* result = std::get_if<ResultOf>(&argument))
          result->command = places.at(static_cast<std::size_t>(result->command));
      control.add(std::move(command));
    }
    places.push_back(static_cast<int>(control.commands().size()) - 1);
  }
  return control;
}

}  // namespace evalcts::gl
