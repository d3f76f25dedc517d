// Implements contexts that many cases share: between cases, commands restore the initial state of GL.
#include <evalcts/backends/reused_context.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <evalcts/backends/context_in_front.h>
#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

using gl::Case;
using gl::EntryPoint;

// --- restoring commands, by theme --------------------------------------------------------------------------
//
// State is set by plain commands and not saved by PushAttrib: a case that fills the attribute stack would
// have one level less, a capture that relies on saved state would see another history, and PopAttrib is
// itself under test, with the evaluators in its EVAL_BIT. If a case sets new state, the command that restores
// it must be added to its theme here. Entry points that an implementation does not provide are left out.

constexpr GLenum unit_token(int unit) { return GL_TEXTURE0 + static_cast<GLenum>(unit); }

// Records commands for each texture unit, unit 0 last, because Map1 and Map2 accept no other (GL 2.1 §5.1).
template <class Commands>
void for_each_unit(Case& c, const ImplementationInfo& info, Commands commands) {
  for (int unit = std::max(info.texture_units, 1) - 1; unit >= 0; --unit) {
    c.ActiveTexture(unit_token(unit));
    commands(unit);
  }
}

// Returns the control point of the initial map, which has order 1, domain [0,1] and the attribute's constant
// (GL 2.1 §5.1, table 5.1 and the text below it). The memory is larger than the map, because a library that
// reads too much is judged by the tests, not here.
std::vector<GLfloat> initial_control_point(GLenum target) {
  std::vector<GLfloat> point;
  switch (target) {
    case GL_MAP1_COLOR_4:
    case GL_MAP2_COLOR_4:
      point = {1, 1, 1, 1};
      break;
    case GL_MAP1_INDEX:
    case GL_MAP2_INDEX:
      point = {1};
      break;
    case GL_MAP1_NORMAL:
    case GL_MAP2_NORMAL:
      point = {0, 0, 1};
      break;
    default:
      point = {0, 0, 0, 1};
      point.resize(static_cast<std::size_t>(gl::components_of(target)));
      break;
  }
  point.resize(256);
  return point;
}

void evaluators(Case& c, const ImplementationInfo&) {
  for (const GLenum target : gl::kMap1Targets) {
    c.Disable(target);
    c.Map1f(target, 0, 1, gl::components_of(target), 1, initial_control_point(target));
  }
  for (const GLenum target : gl::kMap2Targets) {
    const int k = gl::components_of(target);
    c.Disable(target);
    c.Map2f(target, 0, 1, k, 1, 0, 1, k, 1, initial_control_point(target));
  }
  c.Disable(GL_AUTO_NORMAL);
  c.MapGrid1f(1, 0, 1);
  c.MapGrid2f(1, 0, 1, 1, 0, 1);
}

void current_values(Case& c, const ImplementationInfo& info) {
  c.Color4f(1, 1, 1, 1);
  c.Normal3f(0, 0, 1);
  for (int unit = 1; unit < info.texture_units; ++unit) c.MultiTexCoord4f(unit_token(unit), 0, 0, 0, 1);
  c.TexCoord4f(0, 0, 0, 1);
  c.Indexf(1);
  c.EdgeFlag(GL_TRUE);
  c.SecondaryColor3f(0, 0, 0);
  c.FogCoordf(0);
  for (GLuint i = 1; i < 16; ++i) c.VertexAttrib4f(i, 0, 0, 0, 1);  // 0 is a vertex
  // Identity matrices transform this corner to the window position (0,0,0,1), with the current values above.
  // Its distance from the eye is 1 and not 0, which no test queries.
  c.RasterPos3f(-1, -1, -1);
}

void client_arrays(Case& c, const ImplementationInfo&) {
  for (const GLenum array : {GL_VERTEX_ARRAY, GL_COLOR_ARRAY, GL_NORMAL_ARRAY, GL_TEXTURE_COORD_ARRAY})
    c.DisableClientState(array);
  c.VertexPointer(4, GL_FLOAT, 0, nullptr);
  c.ColorPointer(4, GL_FLOAT, 0, nullptr);
  c.NormalPointer(GL_FLOAT, 0, nullptr);
  c.TexCoordPointer(4, GL_FLOAT, 0, nullptr);
}

// Must follow `transformation`, because positions, directions and planes are multiplied by the modelview
// matrix.
void lighting_and_fog(Case& c, const ImplementationInfo&) {
  using Values = std::vector<GLfloat>;
  c.Disable(GL_LIGHTING);
  c.Disable(GL_COLOR_MATERIAL);  // before the materials: while on, the current colour is their value
  for (GLenum i = 0; i < 8; ++i) {
    const GLenum light = GL_LIGHT0 + i;
    const GLfloat on = i == 0 ? 1 : 0;
    c.Disable(light);
    c.Lightfv(light, GL_AMBIENT, Values{0, 0, 0, 1});
    c.Lightfv(light, GL_DIFFUSE, Values{on, on, on, 1});
    c.Lightfv(light, GL_SPECULAR, Values{on, on, on, 1});
    c.Lightfv(light, GL_POSITION, Values{0, 0, 1, 0});
    c.Lightfv(light, GL_SPOT_DIRECTION, Values{0, 0, -1});
    c.Lightfv(light, GL_SPOT_EXPONENT, Values{0});
    c.Lightfv(light, GL_SPOT_CUTOFF, Values{180});
    c.Lightfv(light, GL_CONSTANT_ATTENUATION, Values{1});
    c.Lightfv(light, GL_LINEAR_ATTENUATION, Values{0});
    c.Lightfv(light, GL_QUADRATIC_ATTENUATION, Values{0});
  }
  c.LightModelfv(GL_LIGHT_MODEL_AMBIENT, Values{0.2f, 0.2f, 0.2f, 1});
  c.LightModelfv(GL_LIGHT_MODEL_LOCAL_VIEWER, Values{0});
  c.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, Values{0});
  c.LightModelfv(GL_LIGHT_MODEL_COLOR_CONTROL, Values{GL_SINGLE_COLOR});
  c.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  c.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT, Values{0.2f, 0.2f, 0.2f, 1});
  c.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, Values{0.8f, 0.8f, 0.8f, 1});
  c.Materialfv(GL_FRONT_AND_BACK, GL_SPECULAR, Values{0, 0, 0, 1});
  c.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, Values{0, 0, 0, 1});
  c.Materialfv(GL_FRONT_AND_BACK, GL_SHININESS, Values{0});
  c.Materialfv(GL_FRONT_AND_BACK, GL_COLOR_INDEXES, Values{0, 1, 1});
  c.Disable(GL_FOG);
  c.Fogi(GL_FOG_MODE, GL_EXP);
  c.Fogf(GL_FOG_DENSITY, 1);
  c.Fogf(GL_FOG_START, 0);
  c.Fogf(GL_FOG_END, 1);
  c.Fogf(GL_FOG_INDEX, 0);
  c.Fogfv(GL_FOG_COLOR, Values{0, 0, 0, 0});
  c.Fogi(GL_FOG_COORD_SRC, GL_FRAGMENT_DEPTH);
}

void programs_and_buffers(Case& c, const ImplementationInfo&) {
  c.UseProgram(0);
  c.Disable(GL_VERTEX_PROGRAM_ARB);
  c.BindProgramARB(GL_VERTEX_PROGRAM_ARB, 0);
  c.Disable(GL_FRAGMENT_PROGRAM_ARB);
  for (const GLenum target :
       {GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER})
    c.BindBuffer(target, 0);
  c.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  c.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
  c.Disable(GL_RASTERIZER_DISCARD);
  c.Disable(GL_PRIMITIVE_RESTART);
  c.Disable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  c.PrimitiveRestartIndex(0);
  c.PatchParameteri(GL_PATCH_VERTICES, 3);
}

void feedback(Case& c, const ImplementationInfo&) {
  c.RenderMode(GL_RENDER);
  c.FeedbackBuffer(0, GL_2D, nullptr);
  c.SelectBuffer(0, nullptr);
}

void transformation(Case& c, const ImplementationInfo& info) {
  c.MatrixMode(GL_PROJECTION);
  c.LoadIdentity();
  c.MatrixMode(GL_TEXTURE);
  for_each_unit(c, info, [&](int) { c.LoadIdentity(); });
  c.MatrixMode(GL_MODELVIEW);
  c.LoadIdentity();
}

// Must follow `transformation`, because a plane is multiplied by the modelview matrix when it is set.
void textures(Case& c, const ImplementationInfo& info) {
  constexpr std::array<std::pair<GLenum, GLenum>, 4> kCoordinates = {{{GL_S, GL_TEXTURE_GEN_S},
                                                                      {GL_T, GL_TEXTURE_GEN_T},
                                                                      {GL_R, GL_TEXTURE_GEN_R},
                                                                      {GL_Q, GL_TEXTURE_GEN_Q}}};
  for_each_unit(c, info, [&](int) {
    for (const GLenum target : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP}) {
      c.Disable(target);
      c.BindTexture(target, 0);
    }
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      const auto& [coordinate, enable] = kCoordinates[i];
      std::vector<GLfloat> plane(4, 0.0f);
      if (i < 2) plane[i] = 1;
      c.Disable(enable);
      c.TexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
      c.TexGenfv(coordinate, GL_OBJECT_PLANE, plane);
      c.TexGenfv(coordinate, GL_EYE_PLANE, plane);
    }
  });
}

// The rest of the fixed-function pipeline that evaluated vertices run through.
void pipeline(Case& c, const ImplementationInfo&) {
  for (GLenum i = 0; i < 6; ++i) {
    c.Disable(GL_CLIP_PLANE0 + i);
    c.ClipPlane(GL_CLIP_PLANE0 + i, std::vector<GLdouble>(4, 0.0));
  }
  c.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  c.PolygonOffset(0, 0);
  c.CullFace(GL_BACK);
  c.FrontFace(GL_CCW);
  c.ShadeModel(GL_SMOOTH);
  c.ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  c.LineStipple(1, 0xFFFF);
  c.PointSize(1);
  c.ClearColor(0, 0, 0, 0);
  c.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  c.DepthMask(GL_TRUE);
  c.StencilMask(~0u);
  c.Enable(GL_DITHER);
  for (const GLenum capability :
       {GL_NORMALIZE, GL_RESCALE_NORMAL, GL_COLOR_SUM, GL_CULL_FACE, GL_POLYGON_STIPPLE, GL_LINE_STIPPLE,
        GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_VERTEX_PROGRAM_TWO_SIDE,
        GL_POLYGON_OFFSET_POINT, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_FILL})
    c.Disable(capability);
  c.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE);
  c.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FIXED_ONLY);
  c.ClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
}

void pixel_store(Case& c, const ImplementationInfo&) {
  for (const GLenum name :
       {GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES,
        GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_IMAGE_HEIGHT,
        GL_PACK_SKIP_IMAGES})
    c.PixelStorei(name, 0);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  c.PixelStorei(GL_PACK_ALIGNMENT, 4);
}

// The themes in order: programs and modes first, evaluators last, so that earlier state does not affect them.
constexpr void (*kThemes[])(Case&, const ImplementationInfo&) = {
    feedback, programs_and_buffers, client_arrays,  transformation, textures, lighting_and_fog,
    pipeline, pixel_store,          current_values, evaluators,
};

// --- objects and open constructs of earlier cases ----------------------------------------------------------

// A command that opens a construct, and the command that closes it. Both must be called equally often.
struct Pair {
  EntryPoint open, close;
};
constexpr Pair kPairs[] = {{EntryPoint::Begin, EntryPoint::End},
                           {EntryPoint::BeginTransformFeedback, EntryPoint::EndTransformFeedback},
                           {EntryPoint::BeginQuery, EntryPoint::EndQuery},
                           {EntryPoint::BeginConditionalRender, EntryPoint::EndConditionalRender},
                           {EntryPoint::NewList, EntryPoint::EndList},
                           {EntryPoint::PushAttrib, EntryPoint::PopAttrib}};

// Objects and open constructs that earlier cases left behind, which no constant list of commands removes.
class Remains {
 public:
  void add(const Case& script, const gl::Trace& trace) {
    for (std::size_t i = 0; i < script.commands().size(); ++i) {
      const gl::Command& command = script.commands()[i];
      const gl::Ref ref{static_cast<int>(i)};
      for (const Pair& pair : kPairs) {
        if (command.entry == pair.open) open_.emplace_back(pair.close, closing_arguments(command, pair));
        if (command.entry == pair.close) forget_latest(pair.close);
      }
      const auto returned = [&] { return static_cast<GLuint>(trace.result(ref)); };
      const auto written = [&](std::set<GLuint>& names) {
        if (!trace.has_output(ref)) return;
        for (const GLuint name : trace.values<GLuint>(ref)) names.insert(name);
      };
      if (command.entry == EntryPoint::CreateShader) shaders_.insert(returned());
      if (command.entry == EntryPoint::CreateProgram) programs_.insert(returned());
      if (command.entry == EntryPoint::GenBuffers) written(buffers_);
      if (command.entry == EntryPoint::GenQueries) written(queries_);
      if (command.entry == EntryPoint::GenFramebuffers) written(framebuffers_);
      // Textures, assembly programs and lists come into existence with names that the case chooses.
      const auto given = [&](std::size_t argument, std::set<GLuint>& names) {
        if (const auto* name = std::get_if<std::int64_t>(&command.arguments[argument]))
          names.insert(static_cast<GLuint>(*name));
      };
      if (command.entry == EntryPoint::BindTexture) given(1, textures_);
      if (command.entry == EntryPoint::BindProgramARB) given(1, assembly_programs_);
      if (command.entry == EntryPoint::NewList) given(0, lists_);
    }
  }

  Case closing() const {
    Case c;
    for (auto entry = open_.rbegin(); entry != open_.rend(); ++entry) c.add({entry->first, entry->second});
    return c;
  }

  // Returns the commands that delete all objects except the kept programs. No object may be bound when they
  // are run.
  Case deleting(const std::map<std::string, GLuint>& kept) const {
    Case c;
    for (const GLuint program : programs_)
      if (std::ranges::none_of(kept, [&](const auto& one) { return one.second == program; }))
        c.DeleteProgram(program);
    for (const GLuint shader : shaders_) c.DeleteShader(shader);
    if (!queries_.empty()) c.DeleteQueries(queries_.size(), array_of(queries_));
    if (!framebuffers_.empty()) c.DeleteFramebuffers(framebuffers_.size(), array_of(framebuffers_));
    if (!buffers_.empty()) c.DeleteBuffers(buffers_.size(), array_of(buffers_));
    if (!assembly_programs_.empty())
      c.DeleteProgramsARB(assembly_programs_.size(), array_of(assembly_programs_));
    for (const GLuint list : lists_) c.DeleteLists(list, 1);
    if (!textures_.empty()) c.DeleteTextures(textures_.size(), array_of(textures_));
    return c;
  }

 private:
  static std::vector<GLuint> array_of(const std::set<GLuint>& names) { return {names.begin(), names.end()}; }

  static std::vector<gl::Value> closing_arguments(const gl::Command& command, const Pair& pair) {
    if (pair.close == EntryPoint::EndQuery) return {command.arguments[0]};  // the target
    return {};
  }
  void forget_latest(EntryPoint close) {
    for (auto entry = open_.rbegin(); entry != open_.rend(); ++entry)
      if (entry->first == close) {
        open_.erase(std::next(entry).base());
        return;
      }
  }

  std::vector<std::pair<EntryPoint, std::vector<gl::Value>>> open_;  // commands that close, latest last
  std::set<GLuint> shaders_, programs_, buffers_, queries_, framebuffers_, textures_, assembly_programs_,
      lists_;
};

// Returns the commands that the table supports. They can be left out one by one, because no command here uses
// the result of another.
Case available(const Case& commands, const gl::Table& table) {
  Case c;
  for (const gl::Command& command : commands.commands())
    if (gl::has(table, command.entry)) c.add(command);
  return c;
}

// The context that all handles share.
class Shared final : public ContextInFront {
 public:
  Shared(std::unique_ptr<Context> context, const ImplementationInfo& info, Programs programs)
      : ContextInFront(std::move(context)), programs_(programs) {
    inner().make_current();
    table_.OtherContextEVALCTS = table_.SharingContextEVALCTS = nullptr;  // all cases must use one context
    table_.ContextOfKindEVALCTS = nullptr;
    table_.CopyContextEVALCTS = nullptr;
    table_.MoveToThreadEVALCTS = nullptr;
    table_.RecordRequestsEVALCTS = nullptr;
    table_.RecordedRequestsEVALCTS = nullptr;
    // The initial viewport is the size of a window that only the implementation knows.
    if (gl::has(inner().table(), EntryPoint::Viewport)) {
      Case question;
      const gl::Ref viewport = question.GetIntegerv(GL_VIEWPORT, gl::out<GLint>(4));
      const std::vector<GLint> v = inner().play(question).values<GLint>(viewport);
      restoring_.Viewport(v[0], v[1], v[2], v[3]);
      restoring_.Scissor(v[0], v[1], v[2], v[3]);
    }
    restoring_.append(available(restoring_commands(info), inner().table()));
  }

  std::map<std::string, GLuint>* kept_programs() override {
    return programs_ == Programs::kKept ? &kept_ : nullptr;
  }

  gl::Trace play(const Case& script) override {
    gl::Trace trace = Context::play(script);
    remains_.add(script, trace);
    return trace;
  }

  void restore() {
    const Remains remains = std::exchange(remains_, {});
    Case commands = available(remains.closing(), table());
    commands.append(restoring_);
    commands.append(available(remains.deleting(kept_), table()));
    inner().make_current();  // other contexts are used in between
    inner().play(commands);  // also drains the errors
    take_emitted();
  }

 private:
  Programs programs_;
  std::map<std::string, GLuint> kept_;
  Case restoring_;
  Remains remains_;
};

class Handle final : public ContextInFront {
 public:
  using ContextInFront::ContextInFront;
  gl::Trace play(const Case& script) override { return inner().play(script); }
  std::map<std::string, GLuint>* kept_programs() override { return inner().kept_programs(); }
};

class ReusedContext final : public ImplementationInFront {
 public:
  ReusedContext(Implementation& inner, const ImplementationInfo& info, Programs programs)
      : ImplementationInFront(inner), info_(info), programs_(programs) {}

  std::unique_ptr<Context> create_context() override {
    const bool is_first = !shared_;
    if (is_first) shared_ = std::make_shared<Shared>(inner().create_context(), info_, programs_);
    if (!is_first || info_.shares_state) shared_->restore();
    return std::make_unique<Handle>(shared_);
  }
  std::unique_ptr<Context> create_beside() override { return nullptr; }

 private:
  ImplementationInfo info_;
  Programs programs_;
  std::shared_ptr<Shared> shared_;
};

// State besides enables, materials and maps that a query answers.
// clang-format off
constexpr GLenum kQueried[] = {
    GL_CURRENT_COLOR, GL_CURRENT_NORMAL, GL_CURRENT_TEXTURE_COORDS, GL_CURRENT_INDEX, GL_EDGE_FLAG,
    GL_CURRENT_SECONDARY_COLOR, GL_CURRENT_FOG_COORD, GL_CURRENT_RASTER_COLOR, GL_MATRIX_MODE,
    GL_MODELVIEW_MATRIX, GL_PROJECTION_MATRIX, GL_TEXTURE_MATRIX, GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D,
    GL_SHADE_MODEL, GL_POLYGON_MODE, GL_CULL_FACE_MODE, GL_FRONT_FACE, GL_LINE_STIPPLE_PATTERN,
    GL_LINE_STIPPLE_REPEAT, GL_POINT_SIZE, GL_FOG_MODE, GL_FOG_DENSITY, GL_FOG_START, GL_FOG_END,
    GL_FOG_COLOR, GL_FOG_COORD_SRC, GL_LIGHT_MODEL_AMBIENT, GL_LIGHT_MODEL_TWO_SIDE,
    GL_LIGHT_MODEL_LOCAL_VIEWER, GL_COLOR_MATERIAL_FACE, GL_COLOR_CLEAR_VALUE, GL_COLOR_WRITEMASK,
    GL_DEPTH_WRITEMASK, GL_RENDER_MODE, GL_ATTRIB_STACK_DEPTH, GL_CURRENT_PROGRAM, GL_ARRAY_BUFFER_BINDING,
    GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT, GL_LIST_INDEX, GL_VIEWPORT, GL_MAP1_GRID_DOMAIN,
    GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS, GL_PROVOKING_VERTEX,
    GL_PRIMITIVE_RESTART_INDEX};
// clang-format on

class Beside final : public ImplementationInFront {
 public:
  explicit Beside(Implementation& inner) : ImplementationInFront(inner) {}
  std::unique_ptr<Context> create_context() override {
    std::unique_ptr<Context> context = inner().create_beside();
    if (!context) throw CannotStart("no further context can be created");
    return context;
  }
};

}  // namespace

Case state_queries(const ImplementationInfo& info) {
  constexpr std::size_t kRoom = 16;
  Case c("state");
  const Case restoring = restoring_commands(info);
  for (const gl::Command& command : restoring.commands())
    if (command.entry == EntryPoint::Disable || command.entry == EntryPoint::Enable)
      c.IsEnabled(static_cast<GLenum>(std::get<std::int64_t>(command.arguments[0])));
  for (const GLenum name : kQueried)
    if (!info.rejected_grid_queries.contains(name)) c.GetFloatv(name, gl::out<GLfloat>(kRoom));
  for (const GLenum face : {GL_FRONT, GL_BACK})
    for (const GLenum name : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_SHININESS})
      c.GetMaterialfv(face, name, gl::out<GLfloat>(kRoom));
  const auto ask = [&](GLenum target) {
    for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF})
      c.GetMapfv(target, query, gl::out<GLfloat>(kRoom));
  };
  std::ranges::for_each(gl::kMap1Targets, ask);
  std::ranges::for_each(gl::kMap2Targets, ask);
  return c;
}

std::unique_ptr<WarmContext> WarmContext::of(Implementation& inner, const ImplementationInfo& info) {
  if (info.shares_state) return nullptr;
  const std::unique_ptr<Context> one = inner.create_beside();
  if (!one || one->has_sink()) return nullptr;
  return std::unique_ptr<WarmContext>(new WarmContext(inner, info));
}

WarmContext::WarmContext(Implementation& inner, const ImplementationInfo& info)
    : beside_(std::make_unique<Beside>(inner)), info_(info) {
  renew();
}

void WarmContext::renew() {
  shared_.reset();
  shared_ = reuse_context(*beside_, info_, Programs::kKept);
  const std::unique_ptr<Context> context = shared_->create_context();
  queries_ = available(state_queries(info_), context->table());
  initial_ = context->play(queries_);
}

bool WarmContext::restore() {
  const gl::Trace now = shared_->create_context()->play(queries_);
  for (std::size_t i = 0; i < queries_.commands().size(); ++i) {
    const gl::Ref query{static_cast<int>(i)};
    if (now.same(query, *initial_, query)) continue;
    ++replaced_;
    renew();
    return false;
  }
  return true;
}

Case restoring_commands(const ImplementationInfo& info) {
  Case c("restoring");
  for (const auto theme : kThemes) theme(c, info);
  return c;
}

std::unique_ptr<Implementation> reuse_context(Implementation& inner, const ImplementationInfo& info,
                                              Programs programs) {
  return std::make_unique<ReusedContext>(inner, info, programs);
}

}  // namespace evalcts
