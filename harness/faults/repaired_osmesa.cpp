// Implements the repairs as wrappers of EvalMesh2 and CopyContext in the table of a context.
#include "repaired_osmesa.h"

#include <array>
#include <utility>
#include <vector>

#include <evalcts/backends/context_in_front.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::faults {
namespace repairs {

gl::Table own;  // the commands of OSMesa

struct State {
  bool inside = false;
  GLboolean edge_flag = GL_TRUE;  // the value to restore after a quad strip
};
State state;

GLint integer(GLenum pname) {
  GLint value = 0;
  own.GetIntegerv(pname, &value);
  return value;
}

// --- EV-MESH2-EDGEFLAG: filled meshes are quad strips, and all edges of quad strips are boundary edges

void begin(GLenum mode) {
  if (!state.inside) {
    own.GetBooleanv(GL_EDGE_FLAG, &state.edge_flag);
    if (mode == GL_QUAD_STRIP) own.EdgeFlag(GL_TRUE);
    own.Flush();  // without it, Mesa ignores a flag that is set just before the vertices
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

// --- EV-CTX-COPY, -NOMAPS: glXCopyContext of two attribute groups, which Mesa rejects

void copy_context(GLuint from, GLuint to, GLbitfield mask) {
  std::array<GLfloat, 4> color{}, domain2{};
  std::array<GLfloat, 2> domain1{};
  std::array<GLint, 2> segments2{};
  std::vector<std::pair<GLenum, bool>> switches;
  own.OtherContextEVALCTS(from);
  own.GetFloatv(GL_COLOR_CLEAR_VALUE, color.data());
  own.GetFloatv(GL_MAP1_GRID_DOMAIN, domain1.data());
  own.GetFloatv(GL_MAP2_GRID_DOMAIN, domain2.data());
  own.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments2.data());
  const GLint segments1 = integer(GL_MAP1_GRID_SEGMENTS);
  const auto note = [&](GLenum cap) { switches.emplace_back(cap, own.IsEnabled(cap)); };
  for (const GLenum target : gl::kMap1Targets) note(target);
  for (const GLenum target : gl::kMap2Targets) note(target);
  note(GL_AUTO_NORMAL);
  own.OtherContextEVALCTS(to);
  if (mask & GL_COLOR_BUFFER_BIT) own.ClearColor(color[0], color[1], color[2], color[3]);
  if (mask & GL_EVAL_BIT) {
    for (const auto& [cap, on] : switches) on ? own.Enable(cap) : own.Disable(cap);
    own.MapGrid1f(segments1, domain1[0], domain1[1]);
    own.MapGrid2f(segments2[0], domain2[0], domain2[1], segments2[1], domain2[2], domain2[3]);
  }
  own.OtherContextEVALCTS(from);
}

// ------------------------------------------------------------------------------------------------------------

class RepairedContext final : public ContextInFront {
 public:
  explicit RepairedContext(std::unique_ptr<Context> inner) : ContextInFront(std::move(inner)) {
    own = table_;
    state = {};
    table_.Begin = begin;
    table_.End = end;
    table_.EvalMesh2 = eval_mesh2;
    table_.CopyContextEVALCTS = copy_context;
  }
};

class RepairedOSMesa final : public ImplementationInFront {
 public:
  using ImplementationInFront::ImplementationInFront;
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<RepairedContext>(inner().create_context());
  }
};

}  // namespace repairs

std::unique_ptr<Implementation> repaired_osmesa(std::unique_ptr<Implementation> osmesa) {
  return std::make_unique<repairs::RepairedOSMesa>(std::move(osmesa));
}

}  // namespace evalcts::faults
