#include <evalcts/gl/explicit_vertices.h>

#include <algorithm>

namespace evalcts::gl {
namespace {

// Vertices that differ from each other.
void vertex(Case& c, int number) {
  c.Vertex3f(0.0625f * static_cast<float>(number % 16), 0.03125f * static_cast<float>(number % 32), 0.25f);
}

constexpr std::int64_t kMostIndices = 16;

// The primitives that GL 1.0 5.1 defines a mesh by.
class MeshOfVertices {
 public:
  MeshOfVertices(Case& control, int number, const Command& mesh) : control_(control), number_(number) {
    const auto at = [&](std::size_t i) { return std::get<std::int64_t>(mesh.arguments[i]); };
    const auto last = [&](std::size_t i) { return std::min(at(i + 1), at(i) + kMostIndices - 1); };
    const GLenum mode = static_cast<GLenum>(at(0));
    const bool is_surface = mesh.arguments.size() == 5;
    if (!is_surface) {
      if (mode == GL_POINT || mode == GL_LINE)
        strip(mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP, at(1), last(1));
    } else if (mode == GL_POINT) {
      control_.Begin(GL_POINTS);
      for (std::int64_t j = at(3); j <= last(3); ++j) row(at(1), last(1));
      control_.End();
    } else if (mode == GL_LINE) {
      for (std::int64_t j = at(3); j <= last(3); ++j) strip(GL_LINE_STRIP, at(1), last(1));
      for (std::int64_t i = at(1); i <= last(1); ++i) strip(GL_LINE_STRIP, at(3), last(3));
    } else if (mode == GL_FILL) {
      for (std::int64_t j = at(3); j < last(3); ++j) {
        control_.Begin(GL_QUAD_STRIP);
        for (std::int64_t i = at(1); i <= last(1); ++i)
          for (int side = 0; side < 2; ++side) vertex(control_, number_++);
        control_.End();
      }
    }
  }

 private:
  void row(std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i <= last; ++i) vertex(control_, number_++);
  }
  void strip(GLenum mode, std::int64_t first, std::int64_t last) {
    control_.Begin(mode);
    row(first, last);
    control_.End();
  }

  Case& control_;
  int number_;
};

}  // namespace

Case with_explicit_vertices(const Case& script) {
  Case control = script.without_commands();
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
      MeshOfVertices(control, number, written);
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
