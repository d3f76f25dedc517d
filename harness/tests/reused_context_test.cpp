// Tests that the shared context answers like a fresh one after any case.
#include <evalcts/backends/reused_context.h>

#include <gtest/gtest.h>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

using gl::Case;

// Returns the commands that the implementation provides.
Case filtered(const Case& commands, const gl::Table& table) {
  Case c;
  for (const gl::Command& command : commands.commands())
    if (gl::has(table, command.entry)) c.add(command);
  return c;
}

// Returns commands that change all state that the harness can set, and leave a primitive open.
Case disturbing(int units) {
  Case c;
  const std::vector<GLfloat> points(64, 0.375f);
  for (const GLenum target : gl::kMap1Targets) {
    c.Map1f(target, -1, 4, 4, 5, points);
    c.Enable(target);
  }
  for (const GLenum target : gl::kMap2Targets) {
    c.Map2f(target, -1, 4, 4, 3, 2, 5, 12, 4, points);
    c.Enable(target);
  }
  c.Enable(GL_AUTO_NORMAL);
  c.MapGrid1f(7, -2, 3);
  c.MapGrid2f(7, -2, 3, 5, 4, 9);
  for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SWAP_BYTES, GL_PACK_SKIP_ROWS})
    c.PixelStorei(name, 1);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  c.Viewport(1, 2, 3, 4);
  for (const GLenum mode : {GL_PROJECTION, GL_TEXTURE, GL_MODELVIEW}) {
    c.MatrixMode(mode);
    c.LoadMatrixf(std::vector<GLfloat>(16, 0.5f));
  }
  c.MatrixMode(GL_TEXTURE);
  c.Color4f(0.5, 0.5, 0.5, 0.5);
  c.Normal3f(3, 2, 1);
  c.Indexf(9);
  c.EdgeFlag(GL_FALSE);
  for (int unit = 0; unit < units; ++unit) {
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    c.MultiTexCoord4f(GL_TEXTURE0 + static_cast<GLenum>(unit), 4, 3, 2, 1);
    c.TexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    c.Enable(GL_TEXTURE_GEN_S);
    c.BindTexture(GL_TEXTURE_2D, 5);
    c.Enable(GL_TEXTURE_2D);
  }
  for (const GLenum capability :
       {GL_LIGHTING, GL_LIGHT3, GL_FOG, GL_NORMALIZE, GL_CLIP_PLANE2, GL_RASTERIZER_DISCARD})
    c.Enable(capability);
  c.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
  c.SecondaryColor3f(1, 1, 1);
  c.FogCoordf(3);
  c.VertexAttrib4f(6, 1, 2, 3, 4);
  c.RasterPos3f(0, 0, 0);
  c.EnableClientState(GL_VERTEX_ARRAY);
  c.Fogi(GL_FOG_MODE, GL_LINEAR);
  c.Fogf(GL_FOG_END, 9);
  c.Lightfv(GL_LIGHT0, GL_DIFFUSE, std::vector<GLfloat>(4, 0.25f));
  c.LightModelfv(GL_LIGHT_MODEL_AMBIENT, std::vector<GLfloat>(4, 0.25f));
  c.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  c.PolygonOffset(2, 3);
  c.CullFace(GL_FRONT);
  c.FrontFace(GL_CW);
  c.ShadeModel(GL_FLAT);
  c.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  c.LineStipple(3, 0x0F0F);
  c.PointSize(3);
  c.ClearColor(1, 1, 1, 1);
  c.Begin(GL_TRIANGLES);
  return c;
}

Case asking(int units) {
  Case c;
  for (const auto* targets : {&gl::kMap1Targets, &gl::kMap2Targets})
    for (const GLenum target : *targets) {
      for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF})
        c.GetMapdv(target, query, gl::out<GLdouble>(256));
      c.IsEnabled(target);
    }
  for (const GLenum capability : {GL_AUTO_NORMAL, GL_LIGHTING, GL_LIGHT3, GL_FOG, GL_NORMALIZE,
                                  GL_CLIP_PLANE2, GL_RASTERIZER_DISCARD, GL_VERTEX_ARRAY})
    c.IsEnabled(capability);
  for (const GLenum name : {GL_MAP1_GRID_DOMAIN,
                            GL_MAP1_GRID_SEGMENTS,
                            GL_MAP2_GRID_DOMAIN,
                            GL_MAP2_GRID_SEGMENTS,
                            GL_CURRENT_COLOR,
                            GL_CURRENT_NORMAL,
                            GL_CURRENT_INDEX,
                            GL_EDGE_FLAG,
                            GL_VIEWPORT,
                            GL_MATRIX_MODE,
                            GL_MODELVIEW_MATRIX,
                            GL_PROJECTION_MATRIX,
                            GL_ACTIVE_TEXTURE,
                            GL_UNPACK_ROW_LENGTH,
                            GL_UNPACK_SWAP_BYTES,
                            GL_UNPACK_ALIGNMENT,
                            GL_PACK_SKIP_ROWS,
                            GL_RENDER_MODE,
                            GL_CURRENT_PROGRAM,
                            GL_ARRAY_BUFFER_BINDING,
                            GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
                            GL_CLAMP_VERTEX_COLOR,
                            GL_CURRENT_SECONDARY_COLOR,
                            GL_CURRENT_FOG_COORD,
                            GL_CURRENT_RASTER_POSITION,
                            GL_CURRENT_RASTER_COLOR,
                            GL_CURRENT_RASTER_POSITION_VALID,
                            GL_FOG_MODE,
                            GL_FOG_END,
                            GL_LIGHT_MODEL_AMBIENT,
                            GL_POLYGON_MODE,
                            GL_POLYGON_OFFSET_FACTOR,
                            GL_CULL_FACE_MODE,
                            GL_FRONT_FACE,
                            GL_SHADE_MODEL,
                            GL_PROVOKING_VERTEX,
                            GL_LINE_STIPPLE_PATTERN,
                            GL_LINE_STIPPLE_REPEAT,
                            GL_POINT_SIZE,
                            GL_COLOR_CLEAR_VALUE})
    c.GetFloatv(name, gl::out<GLfloat>(16));
  c.GetVertexAttribfv(6, GL_CURRENT_VERTEX_ATTRIB, gl::out<GLfloat>(4));
  for (int unit = 0; unit < units; ++unit) {
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (const GLenum name : {GL_CURRENT_TEXTURE_COORDS, GL_TEXTURE_MATRIX, GL_TEXTURE_BINDING_2D})
      c.GetFloatv(name, gl::out<GLfloat>(16));
    for (const GLenum capability : {GL_TEXTURE_GEN_S, GL_TEXTURE_2D}) c.IsEnabled(capability);
  }
  return c;
}

class ReusedContexts : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    try {
      implementation_ = open_implementation({.name = GetParam()});
    } catch (const CannotStart& reason) {
      GTEST_SKIP() << reason.what();
    }
    info_ = inquire(*implementation_);
  }
  std::unique_ptr<Implementation> implementation_;
  ImplementationInfo info_;
};

TEST_P(ReusedContexts, AnswerAsFreshOnesDo) {
  const int units = std::min(info_.texture_units, 8);
  std::optional<gl::Trace> fresh;
  Case questions;
  {
    const std::unique_ptr<Context> context = implementation_->create_context();
    questions = filtered(asking(units), context->table());
    fresh = context->play(questions);
  }
  const std::unique_ptr<Implementation> reused = reuse_context(*implementation_, info_);
  {
    const std::unique_ptr<Context> context = reused->create_context();
    context->play(filtered(disturbing(units), context->table()));
    const gl::Trace other = context->play(questions);
    bool differs = false;
    for (int i = 0; i < static_cast<int>(fresh->size()); ++i) differs |= !fresh->same({i}, other, {i});
    EXPECT_TRUE(differs);  // because the context has not been restored
  }
  const std::unique_ptr<Context> context = reused->create_context();
  EXPECT_TRUE(context->take_emitted().empty());
  const gl::Trace trace = context->play(questions);
  for (int i = 0; i < static_cast<int>(fresh->size()); ++i)
    EXPECT_TRUE(fresh->same({i}, trace, {i}))
        << gl::to_c(questions.commands()[static_cast<std::size_t>(i)], 4);
}

// Buffers, shaders and programs of a case are deleted, so that they do not exist in the next case.
TEST_P(ReusedContexts, HoldNoObjectsOfTheCaseBefore) {
  const std::unique_ptr<Implementation> reused = reuse_context(*implementation_, info_);
  if (!gl::has(reused->create_context()->table(), gl::EntryPoint::CreateProgram))
    GTEST_SKIP() << "has no programs";
  Case making;
  const gl::Ref buffer = making.GenBuffers(1, gl::out<GLuint>(1));
  making.BindBuffer(GL_ARRAY_BUFFER, gl::ResultOf{buffer.index, 0});
  making.BufferData(GL_ARRAY_BUFFER, 4, std::vector<GLubyte>(4, 1), GL_STATIC_READ);
  const gl::Ref program = making.CreateProgram();
  const gl::Ref shader = making.CreateShader(GL_VERTEX_SHADER);
  const gl::Trace made = reused->create_context()->play(making);

  Case questions;
  std::vector<gl::Ref> errors;
  questions.CompileShader(static_cast<GLuint>(made.result(shader)));
  errors.push_back(questions.GetError());
  questions.LinkProgram(static_cast<GLuint>(made.result(program)));
  errors.push_back(questions.GetError());
  questions.BindBuffer(GL_ARRAY_BUFFER, made.values<GLuint>(buffer)[0]);
  questions.GetBufferSubData(GL_ARRAY_BUFFER, 0, 4, gl::out<GLubyte>(4));
  errors.push_back(questions.GetError());
  const gl::Trace trace = reused->create_context()->play(questions);
  for (const gl::Ref ref : errors)
    EXPECT_EQ(trace.error(ref), static_cast<GLenum>(GL_INVALID_VALUE)) << ref.index;
}

// Programs that captures keep exist after the case that made them, if Programs::kKept is chosen.
TEST_P(ReusedContexts, KeepProgramsOfCaptures) {
  const std::unique_ptr<Implementation> reused = reuse_context(*implementation_, info_, Programs::kKept);
  if (!gl::has(reused->create_context()->table(), gl::EntryPoint::CreateProgram))
    GTEST_SKIP() << "has no programs";
  Case making;
  const gl::Ref program = making.CreateProgram();
  {
    const std::unique_ptr<Context> context = reused->create_context();
    ASSERT_TRUE(context->kept_programs());
    context->kept_programs()->emplace("", static_cast<GLuint>(context->play(making).result(program)));
  }
  const std::unique_ptr<Context> context = reused->create_context();
  Case question;
  question.LinkProgram(context->kept_programs()->at(""));
  const gl::Ref error = question.GetError();
  EXPECT_EQ(context->play(question).error(error), static_cast<GLenum>(GL_NO_ERROR));
}

// A context whose state cannot be restored is replaced: here the attribute stack has a level of which the
// context does not know.
TEST_P(ReusedContexts, AreReplacedIfTheirStateIsNotRestored) {
  const std::unique_ptr<WarmContext> warm = WarmContext::of(*implementation_, info_);
  if (implementation_->create_context()->has_sink()) {
    EXPECT_EQ(warm, nullptr) << "a shared context is not faster";
    return;
  }
  ASSERT_NE(warm, nullptr);
  const auto context = [&] { return warm->implementation().create_context(); };
  context()->play(filtered(disturbing(info_.texture_units), context()->table()));
  EXPECT_TRUE(warm->restore());
  context()->table().PushAttrib(GL_EVAL_BIT);
  EXPECT_FALSE(warm->restore());
  EXPECT_TRUE(warm->restore()) << "another context";
  const std::unique_ptr<Context> fresh = implementation_->create_context();
  fresh->play(filtered(disturbing(info_.texture_units), fresh->table()));
  EXPECT_TRUE(warm->restore()) << "a fresh context beside it does not matter";
}

INSTANTIATE_TEST_SUITE_P(Of, ReusedContexts,
                         testing::Values("reference", "production"
#ifndef __SANITIZE_ADDRESS__
                                         ,
                                         "osmesa"
#endif
                                         ),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace evalcts
