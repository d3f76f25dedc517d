#include "harness/faults/repaired_osmesa.h"

#include <reference/rounding.h>

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "harness/gl/tokens.h"
#include "harness/judge/prediction.h"

namespace evalcts::faults {
namespace repairs {

gl::Table own;  // of OSMesa

// A primitive that is drawn as the executable specification has it: with explicit vertices.
struct Explicit {
  gl::Case evaluation;  // all that it depends on, and a primitive that is left open
  std::array<GLfloat, 4> color{};
  std::array<GLfloat, 3> normal{};
  bool program = false;
};

struct State {
  bool inside = false;
  std::optional<Explicit> drawn;
  GLboolean edge_flag = GL_TRUE;   // to be given back after a quad strip
  std::map<GLuint, bool> is_core;  // of the contexts of the case
  GLuint context = 0;
};
State state;

GLint integer(GLenum pname) {
  GLint value = 0;
  own.GetIntegerv(pname, &value);
  return value;
}

// --- EV-AUTON-SHADER, EV-AUTON-VP: normals with a vertex program are not made units; EV-CMAT-NOSTATE,
// -NOCURRENT, -NEXT: colours that a material tracks are of their vertex only
// ---------------------------------

void define(gl::Case& c, GLenum target, int dimension) {
  const GLint k = gl::components_of(target);
  std::array<GLint, 2> order{1, 1};
  std::array<GLdouble, 4> domain{};
  own.GetMapiv(target, GL_ORDER, order.data());
  own.GetMapdv(target, GL_DOMAIN, domain.data());
  std::vector<GLdouble> points(static_cast<std::size_t>(order[0] * order[1] * k));
  own.GetMapdv(target, GL_COEFF, points.data());
  if (dimension == 1)
    c.Map1d(target, domain[0], domain[1], k, order[0], points);
  else
    c.Map2d(target, domain[0], domain[1], order[1] * k, order[0], domain[2], domain[3], k, order[1], points);
}

std::optional<Explicit> explicit_primitive() {
  const bool program = integer(GL_CURRENT_PROGRAM) != 0 || own.IsEnabled(GL_VERTEX_PROGRAM_ARB);
  const bool automatic = own.IsEnabled(GL_AUTO_NORMAL);
  if (!(program && automatic) && !own.IsEnabled(GL_COLOR_MATERIAL)) return {};
  Explicit drawn;
  drawn.program = program;
  own.GetFloatv(GL_CURRENT_COLOR, drawn.color.data());
  own.GetFloatv(GL_CURRENT_NORMAL, drawn.normal.data());
  gl::Case& c = drawn.evaluation;
  c.Color4f(drawn.color[0], drawn.color[1], drawn.color[2], drawn.color[3]);
  c.Normal3f(drawn.normal[0], drawn.normal[1], drawn.normal[2]);
  const auto copy = [&](GLenum target, int dimension) {
    if (!own.IsEnabled(target)) return;
    define(c, target, dimension);
    c.Enable(target);
  };
  for (const GLenum target : gl::kMap1Targets) copy(target, 1);
  for (const GLenum target : gl::kMap2Targets) copy(target, 2);
  if (automatic) c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  return drawn;
}

void draw(const reference::Vertex& vertex) {
  const Explicit& drawn = *state.drawn;
  const auto color = [&](std::size_t i) { return reference::rounded(vertex.color[i]); };
  own.Color4f(color(0), color(1), color(2), color(3));
  std::array<float, 3> normal = reference::rounded(vertex.normal);
  if (const auto* generated = std::get_if<reference::AutomaticNormal>(&vertex.normal);
      generated && drawn.program) {
    const reference::Vector m =
        reference::normal_vector(generated->map->surfaces(), generated->u, generated->v);
    for (std::size_t i = 0; i < normal.size(); ++i) normal[i] = reference::round_to_float(m[i]);
  }
  own.Normal3fv(normal.data());
  const auto position = [&](std::size_t i) { return reference::rounded(vertex.position[i]); };
  own.Vertex4f(position(0), position(1), position(2), position(3));
  own.Color4fv(drawn.color.data());
  own.Normal3fv(drawn.normal.data());
}

void draw(gl::Case evaluation) {
  constexpr int kMostOrder = 64;
  evaluation.End();
  for (const reference::Primitive& primitive : predict(evaluation, kMostOrder).primitives)
    for (const reference::Vertex& vertex : primitive.vertices) draw(vertex);
}

void eval_coord1(GLfloat u) {
  if (!state.inside || !state.drawn) return own.EvalCoord1f(u);
  gl::Case c = state.drawn->evaluation;
  c.EvalCoord1f(u);
  draw(std::move(c));
}
void eval_coord2(GLfloat u, GLfloat v) {
  if (!state.inside || !state.drawn) return own.EvalCoord2f(u, v);
  gl::Case c = state.drawn->evaluation;
  c.EvalCoord2f(u, v);
  draw(std::move(c));
}

// --- EV-MESH2-EDGEFLAG: edges of quad strips, explicit ones too, are boundaries
// -----------------------------

void begin(GLenum mode) {
  if (!state.inside) {
    own.GetBooleanv(GL_EDGE_FLAG, &state.edge_flag);
    if (mode == GL_QUAD_STRIP) own.EdgeFlag(GL_TRUE);
    own.Flush();  // a flag that comes with the vertices is lost
    state.drawn = explicit_primitive();
  }
  state.inside = true;
  own.Begin(mode);
}
void end() {
  own.End();
  own.Flush();
  if (state.inside) own.EdgeFlag(state.edge_flag);
  state.inside = false;
}

// --- EV-MESH2-ISQUADS, -FLAT, -FLAT-FIRST: filled meshes are quad strips
// -------------------------

void eval_mesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  if (mode != GL_FILL || state.inside) return own.EvalMesh2(mode, i1, i2, j1, j2);
  for (GLint j = j1; j < j2; ++j) {
    begin(GL_QUAD_STRIP);
    for (GLint i = i1; i <= i2; ++i) {
      own.EvalPoint2(i, j);
      own.EvalPoint2(i, j + 1);
    }
    end();
  }
}

// --- EV-PROF-CORE-GET: what a core profile has not, it does not answer for
// ----------------------------------

void other_context(GLuint number) {
  own.OtherContextEVALCTS(number);
  state.context = number;
}
void context_of_kind(GLuint number, GLuint kind) {
  own.ContextOfKindEVALCTS(number, kind);
  state.context = number;
  state.is_core.emplace(number, kind == EVALCTS_CORE_PROFILE || kind == EVALCTS_FORWARD_COMPATIBLE);
}

bool is_removed(GLenum pname) {
  if (!state.is_core[state.context]) return false;
  switch (pname) {
    case GL_AUTO_NORMAL:
    case GL_MAX_EVAL_ORDER:
    case GL_MAP1_GRID_DOMAIN:
    case GL_MAP1_GRID_SEGMENTS:
    case GL_MAP2_GRID_DOMAIN:
    case GL_MAP2_GRID_SEGMENTS:
      return true;
    default:
      return gl::components_of(pname) > 0;
  }
}
// What raises INVALID_ENUM in the place of a removed name.
GLenum removed(GLenum pname) { return is_removed(pname) ? static_cast<GLenum>(GL_COEFF) : pname; }

// --- EV-CTX-COPY, -NOMAPS: glXCopyContext, which Mesa refuses, of two groups
// --------------------------------

void copy_context(GLuint from, GLuint to, GLbitfield mask) {
  std::array<GLfloat, 4> color{}, domain2{};
  std::array<GLfloat, 2> domain1{};
  std::array<GLint, 2> segments2{};
  std::vector<std::pair<GLenum, bool>> switches;
  other_context(from);
  own.GetFloatv(GL_COLOR_CLEAR_VALUE, color.data());
  own.GetFloatv(GL_MAP1_GRID_DOMAIN, domain1.data());
  own.GetFloatv(GL_MAP2_GRID_DOMAIN, domain2.data());
  own.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments2.data());
  const GLint segments1 = integer(GL_MAP1_GRID_SEGMENTS);
  const auto note = [&](GLenum cap) { switches.emplace_back(cap, own.IsEnabled(cap)); };
  for (const GLenum target : gl::kMap1Targets) note(target);
  for (const GLenum target : gl::kMap2Targets) note(target);
  note(GL_AUTO_NORMAL);
  other_context(to);
  if (mask & GL_COLOR_BUFFER_BIT) own.ClearColor(color[0], color[1], color[2], color[3]);
  if (mask & GL_EVAL_BIT) {
    for (const auto& [cap, on] : switches) on ? own.Enable(cap) : own.Disable(cap);
    own.MapGrid1f(segments1, domain1[0], domain1[1]);
    own.MapGrid2f(segments2[0], domain2[0], domain2[1], segments2[1], domain2[2], domain2[3]);
  }
  other_context(from);
}

// ------------------------------------------------------------------------------------------------------------

class RepairedContext final : public Context {
 public:
  explicit RepairedContext(std::unique_ptr<Context> inner) : inner_(std::move(inner)) {
    own = table_ = inner_->table();
    state = {};
    table_.Begin = begin;
    table_.End = end;
    table_.EvalCoord1f = eval_coord1;
    table_.EvalCoord2f = eval_coord2;
    table_.EvalMesh2 = eval_mesh2;
    table_.OtherContextEVALCTS = other_context;
    table_.ContextOfKindEVALCTS = context_of_kind;
    table_.CopyContextEVALCTS = copy_context;
    table_.GetBooleanv = [](GLenum name, GLboolean* values) { own.GetBooleanv(removed(name), values); };
    table_.GetIntegerv = [](GLenum name, GLint* values) { own.GetIntegerv(removed(name), values); };
    table_.GetFloatv = [](GLenum name, GLfloat* values) { own.GetFloatv(removed(name), values); };
    table_.GetDoublev = [](GLenum name, GLdouble* values) { own.GetDoublev(removed(name), values); };
  }
  const gl::Table& table() const override { return table_; }

 private:
  std::unique_ptr<Context> inner_;
  gl::Table table_;
};

class RepairedOSMesa final : public Implementation {
 public:
  explicit RepairedOSMesa(std::unique_ptr<Implementation> osmesa) : osmesa_(std::move(osmesa)) {}
  std::string name() const override { return osmesa_->name(); }
  std::string library() const override { return osmesa_->library(); }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<RepairedContext>(osmesa_->create_context());
  }
  std::unique_ptr<Context> create_beside() override { return osmesa_->create_beside(); }

 private:
  std::unique_ptr<Implementation> osmesa_;
};

}  // namespace repairs

std::unique_ptr<Implementation> repaired_osmesa(std::unique_ptr<Implementation> osmesa) {
  return std::make_unique<repairs::RepairedOSMesa>(std::move(osmesa));
}

const gl::Table& unrepaired() { return repairs::own; }

}  // namespace evalcts::faults
