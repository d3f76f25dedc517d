// Replaces evaluation by Vertex, Color, Normal and TexCoord commands with known values, and meshes by
// primitives of such vertices.
#include <evalcts/gl/explicit_vertices.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/errors.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::gl {
namespace {

// Issues an explicit vertex of three or four components whose position depends on the number.
void vertex(Case& c, int number, int components = 3, Arguments arguments = Arguments::kScalars) {
  const float x = 0.0625f * static_cast<float>(number % 16), y = 0.03125f * static_cast<float>(number % 32);
  const bool in_array = arguments == Arguments::kArray;
  if (components == 4)
    in_array ? c.Vertex4fv(std::vector<float>{x, y, 0.25f, 1}) : c.Vertex4f(x, y, 0.25f, 1);
  else
    in_array ? c.Vertex3fv(std::vector<float>{x, y, 0.25f}) : c.Vertex3f(x, y, 0.25f);
}

constexpr std::int64_t kMostIndices = 16;
constexpr GLuint kNoList = 0x7fff1234;  // a list that no test defines

// The capabilities that the commands enable, in the order in which they are written.
class EnabledMaps {
 public:
  void follow(const Command& command) {
    const auto cap = static_cast<GLenum>(integer_of(command, 0));
    if (command.entry == EntryPoint::Enable) {
      caps_.insert(cap);
    } else if (command.entry == EntryPoint::Disable) {
      caps_.erase(cap);
    } else if (command.entry == EntryPoint::PushAttrib) {
      saved_.push_back(caps_);
    } else if (command.entry == EntryPoint::PopAttrib && !saved_.empty()) {
      caps_ = std::move(saved_.back());
      saved_.pop_back();
    }
  }

  // Issues the attributes of the enabled maps of the dimension, with values that depend on the number.
  void issue_attributes(Case& c, int dimension, int number, Arguments arguments) const {
    const auto is_enabled = [&](GLenum of_one, GLenum of_two) {
      return caps_.contains(dimension == 1 ? of_one : of_two);
    };
    const bool in_array = arguments == Arguments::kArray;
    // Different values for consecutive vertices: a pipeline may give all vertices the values of the last one.
    const float change = 0.0625f * static_cast<float>(number % 8);
    const std::vector<float> color = {0.25f + change, 0.5f, 0.75f - change, 1},
                             texture = {0.25f + change, 0.5f - change, 0.75f, 2};
    std::vector<float> normal = {0, 0, 0};
    normal[static_cast<std::size_t>(number % 3)] = 1;
    if (is_enabled(GL_MAP1_INDEX, GL_MAP2_INDEX)) in_array ? c.Indexfv(std::vector<float>{1}) : c.Indexf(1);
    if (is_enabled(GL_MAP1_COLOR_4, GL_MAP2_COLOR_4))
      in_array ? c.Color4fv(color) : c.Color4f(color[0], color[1], color[2], color[3]);
    if (is_enabled(GL_MAP1_NORMAL, GL_MAP2_NORMAL) || (dimension == 2 && caps_.contains(GL_AUTO_NORMAL)))
      in_array ? c.Normal3fv(normal) : c.Normal3f(normal[0], normal[1], normal[2]);
    const float s = texture[0], t = texture[1], r = texture[2], q = texture[3];
    if (is_enabled(GL_MAP1_TEXTURE_COORD_4, GL_MAP2_TEXTURE_COORD_4)) {
      in_array ? c.TexCoord4fv(texture) : c.TexCoord4f(s, t, r, q);
    } else if (is_enabled(GL_MAP1_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_3)) {
      in_array ? c.TexCoord3fv(texture) : c.TexCoord3f(s, t, r);
    } else if (is_enabled(GL_MAP1_TEXTURE_COORD_2, GL_MAP2_TEXTURE_COORD_2)) {
      in_array ? c.TexCoord2fv(texture) : c.TexCoord2f(s, t);
    } else if (is_enabled(GL_MAP1_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_1)) {
      in_array ? c.TexCoord1fv(texture) : c.TexCoord1f(s);
    }
  }

  // Returns the number of components of the vertices that the enabled maps of the dimension generate; 0 if
  // they generate none.
  int vertex_components(int dimension) const {
    if (caps_.contains(dimension == 1 ? GL_MAP1_VERTEX_4 : GL_MAP2_VERTEX_4)) return 4;
    return caps_.contains(dimension == 1 ? GL_MAP1_VERTEX_3 : GL_MAP2_VERTEX_3) ? 3 : 0;
  }

 private:
  std::set<GLenum> caps_;
  std::vector<std::set<GLenum>> saved_;
};

// Draws primitives of explicit vertices in place of a mesh. A filled mesh is drawn in strips of the given
// mode.
class MeshOfVertices {
 public:
  MeshOfVertices(Case& control, int number, const Command& mesh, GLenum strips)
      : control_(control), number_(number) {
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
        control_.Begin(strips);
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

bool is_of_evaluators(GLenum name) {
  for (const GLenum other : {GL_AUTO_NORMAL, GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                             GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS})
    if (name == other) return true;
  const bool is_attribute_map = name >= GL_MAP1_VERTEX_ATTRIB0_4_NV && name <= GL_MAP2_VERTEX_ATTRIB15_4_NV;
  return components_of(name) > 0 || is_attribute_map;
}

// True if the command defines, enables or queries maps or grids.
bool is_about_maps(const Command& command) {
  const Role role = role_of(command.entry);
  if (role == Role::kMap || role == Role::kMapGrid || role == Role::kGetMap) return true;
  const std::string_view name = name_of(command.entry);
  for (const char* of_state : {"glEnable", "glDisable", "glIsEnabled", "glGetBooleanv", "glGetIntegerv",
                               "glGetFloatv", "glGetDoublev"})
    if (name == of_state) {
      const auto* state = std::get_if<std::int64_t>(&command.arguments.at(0));
      return state && is_of_evaluators(static_cast<GLenum>(*state));
    }
  return false;
}

// Alternately enables and disables the capability, if there is one.
class IdleChanges {
 public:
  explicit IdleChanges(IdleCapability capability) : capability_(capability) {}
  void change(Case& c) {
    if (!capability_) return;
    enabled_ = !enabled_;
    enabled_ ? c.Enable(*capability_) : c.Disable(*capability_);
  }

 private:
  IdleCapability capability_;
  bool enabled_ = false;
};

// Returns the case without evaluators. `evaluate(control, command, number)` issues the commands that replace
// an EvalCoord or EvalPoint, `mesh(control, command, number)` the commands that replace an EvalMesh outside
// of Begin and End. `number` is the index of the command in the case. `follow(command)` is called first for
// each command.
template <class Follow, class Evaluate, class Mesh>
Case with_replaced(const Case& script, IdleCapability idle, const Follow& follow, const Evaluate& evaluate,
                   const Mesh& mesh) {
  IdleChanges changes(idle);
  Case control = script.without_commands();
  std::vector<int> places;
  bool in_primitive = false;
  for (const Command& written : script.commands()) {
    const int number = static_cast<int>(places.size());
    if (written.entry == EntryPoint::Begin) in_primitive = true;
    if (written.entry == EntryPoint::End) in_primitive = false;
    follow(written);
    const bool is_mesh = role_of(written.entry) == Role::kEvalMesh;
    if (is_about_maps(written) || (is_mesh && in_primitive)) {
      changes.change(control);
      places.push_back(-1);
      continue;
    }
    if (is_mesh) {
      mesh(control, written, number);
    } else if (is_evaluation(written.entry)) {
      evaluate(control, written, number);
    } else {
      Command command = written;
      if (written.entry == EntryPoint::PushAttrib)
        std::get<std::int64_t>(command.arguments.at(0)) &= ~std::int64_t{GL_EVAL_BIT};
      for (Value& argument : command.arguments)
        if (auto* result = std::get_if<ResultOf>(&argument))
          result->command = places.at(static_cast<std::size_t>(result->command));
      control.add(std::move(command));
    }
    places.push_back(static_cast<int>(control.commands().size()) - 1);
  }
  return control;
}

}  // namespace

IdleCapability find_idle_capability(const Table& table) {
  if (!table.Enable || !table.Disable || !table.GetError) return {};
  take_errors(table);
  for (const GLenum capability : {GL_INDEX_LOGIC_OP, GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL}) {
    table.Enable(capability);
    table.Disable(capability);
    if (take_errors(table).empty()) return capability;
  }
  return {};
}

Case with_explicit_vertices(const Case& script, IdleCapability idle) {
  return with_replaced(
      script, idle, [](const Command&) {}, [](Case& c, const Command&, int number) { vertex(c, number); },
      [](Case& c, const Command& mesh, int number) { MeshOfVertices(c, number, mesh, GL_QUAD_STRIP); });
}

Case with_explicit_commands(const Case& script, IdleCapability idle, Arguments arguments) {
  EnabledMaps maps;
  const auto is_left_out = [&](const Command& command) {
    return arguments == Arguments::kArray && maps.vertex_components(dimension_of(command.entry)) == 0;
  };
  return with_replaced(
      script, idle, [&](const Command& command) { maps.follow(command); },
      [&](Case& c, const Command& command, int number) {
        if (is_left_out(command)) return;
        const int dimension = dimension_of(command.entry), components = maps.vertex_components(dimension);
        maps.issue_attributes(c, dimension, number, arguments);
        if (components > 0) vertex(c, number, components, arguments);
      },
      [&](Case& c, const Command& mesh, int number) {
        if (!is_left_out(mesh)) MeshOfVertices(c, number, mesh, GL_TRIANGLE_STRIP);
      });
}

Case with_calls_of_no_list(const Case& script) {
  return with_replaced(
      script, {}, [](const Command&) {}, [](Case& c, const Command&, int) { c.CallList(kNoList); },
      [](Case& c, const Command&, int) {
        c.Begin(GL_POINTS);
        c.CallList(kNoList);
        c.End();
      });
}

std::vector<Case> controls_without_evaluators(const Case& script) {
  std::vector<Case> controls = {with_explicit_vertices(script), with_explicit_commands(script),
                                with_explicit_commands(script, {}, Arguments::kArray)};
  if (uses_lists(script)) controls.push_back(with_calls_of_no_list(script));
  return controls;
}

}  // namespace evalcts::gl
