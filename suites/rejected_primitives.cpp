// Section 22 of the requirements, primitives that the state of the pipeline does not allow: if Begin raises
// an error, EvalMesh raises the same error and draws nothing.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include <evalcts/testkit/registration.h>

#include "drawings.h"
#include "programs.h"

namespace evalcts::suite_rejected_primitives {
namespace {

// A state that allows some kinds of primitives, or none.
struct Refusal {
  std::string name;
  std::function<void(gl::Case&)> enter, leave;
  std::vector<GLenum> allowed;  // modes that Begin accepts

  bool allows(GLenum primitive) const { return std::ranges::find(allowed, primitive) != allowed.end(); }
};

struct Prepared {
  std::vector<Refusal> rejections;
  std::vector<Program> programs = {};
};
// A function that appends commands to the beginning of a case.
using Prepare = std::function<Prepared(gl::Case&)>;

// One drawing in one state, with the queries after it.
struct Attempt {
  std::string name;
  bool allowed;
  gl::Ref error, no_more;
  gl::Ref count;  // the result of a query object, if there is one
  gl::Ref read;   // ReadPixels of the whole window
  gl::Ref again;  // in the control of a rejected drawing, GetError after a second Begin and End
};

struct Attempts {
  gl::Case script;
  std::vector<gl::Ref> before, after;  // queries of evaluator state
  Prepared prepared;
  std::vector<Attempt> all;
};

// Returns a case that tries all drawings in all states: first those that have to be rejected. In the control
// each rejected drawing is Begin and End; the error of Begin is the first one, which GetError returns. A
// second Begin and End follow, because a mesh may consist of several primitives.
Attempts attempts(Test& t, const gl::Identity& identity, const std::vector<Drawing>& drawings,
                  const Prepare& prepare, GLenum counted, bool evaluated) {
  Attempts attempts = {gl::Case(identity), {}, {}, {}, {}};
  gl::Case& c = attempts.script;
  c.Viewport(0, 0, kSide, kSide);
  c.ClearColor(0, 0, 0, 0);
  attempts.prepared = prepare(c);
  define_curve(c);
  define_patch(c);
  if (evaluated) attempts.before = query_everything(t, c);
  const auto attempt = [&](const Refusal& rejection, const Drawing& drawing, bool allowed) {
    c.Clear(GL_COLOR_BUFFER_BIT);
    rejection.enter(c);
    gl::ResultOf query;
    if (counted) c.BeginQuery(counted, query = make_query(c));
    if (evaluated) {
      c.append(drawing.evaluated);
    } else if (allowed) {
      c.append(drawing.vertices);
    } else {
      c.Begin(drawing.primitive);
      c.End();
    }
    Attempt made = {
        fmt::format("{}, {}", drawing.name, rejection.name), allowed, c.GetError(), c.GetError(), {}, {}, {}};
    if (!evaluated && !allowed) {
      c.Begin(drawing.primitive);
      c.End();
      made.again = c.GetError();
      c.GetError();
    }
    if (counted) {
      c.EndQuery(counted);
      made.count = c.GetQueryObjectuiv(query, GL_QUERY_RESULT, gl::out<GLuint>(1));
    }
    rejection.leave(c);
    made.read = c.ReadPixels(0, 0, kSide, kSide, GL_RED, GL_FLOAT, gl::out<GLfloat>(kSide * kSide));
    attempts.all.push_back(made);
  };
  for (const bool allowed : {false, true}) {
    for (const Refusal& rejection : attempts.prepared.rejections)
      for (const Drawing& drawing : drawings)
        if (rejection.allows(drawing.primitive) == allowed) attempt(rejection, drawing, allowed);
    // The query comes before the drawings that are allowed, which may change current values.
    if (!allowed && evaluated) attempts.after = query_everything(t, c);
  }
  return attempts;
}

GLuint counted_by(const CheckedTrace& checked, const Attempt& attempt) {
  return attempt.count.index < 0 ? 0 : checked.trace().values<GLuint>(attempt.count)[0];
}

void expect_rejected_like_begin(Test& t, const std::vector<Drawing>& drawings, const Prepare& prepare,
                                GLenum error, GLenum counted = 0) {
  const Attempts controls = attempts(t, gl::control("Begin"), drawings, prepare, counted, false);
  const CheckedTrace control = t.play(controls.script);
  for (const Program& program : controls.prepared.programs) require_linked(control, program);

  const Attempts evaluated = attempts(t, "evaluated", drawings, prepare, counted, true);
  CheckedTrace checked = t.play(evaluated.script);
  bool observed = false, all_rejected = true;
  for (std::size_t i = 0; i < evaluated.all.size(); ++i) {
    const Attempt& attempt = evaluated.all[i];
    const Attempt& begin = controls.all[i];
    const std::size_t lit = count_lit(checked, attempt.read), expected = count_lit(control, begin.read);
    const GLuint count = counted_by(checked, attempt), expected_count = counted_by(control, begin);
    const GLenum begins_error = control.trace().error(begin.error);
    if (attempt.allowed) {
      if (begins_error != GL_NO_ERROR || expected == 0) continue;
      checked.expect_no_error(attempt.error);
      checked.expect(lit > 0, attempt.read, fmt::format("nothing is drawn ({})", attempt.name),
                     fmt::format("some of {} pixels", expected), "no pixel");
    } else {
      if (begins_error != error || expected != 0 || expected_count != 0) continue;
      observed = true;
      checked.expect_error(attempt.error, {error});
      all_rejected = all_rejected && checked.trace().error(attempt.error) == error;
      checked.expect_no_error(attempt.no_more);
      if (control.trace().error(begin.again) != error) continue;  // Begin draws, without an error
      checked.expect(lit == 0, attempt.read, fmt::format("{} pixels are drawn ({})", lit, attempt.name),
                     "no pixel", fmt::format("{} pixels", lit));
      if (attempt.count.index >= 0)
        checked.expect(count == 0, attempt.count,
                       fmt::format("{} primitives are counted ({})", count, attempt.name), "0",
                       std::to_string(count));
    }
    if (attempt.allowed && attempt.count.index >= 0)
      checked.expect(count == expected_count, attempt.count,
                     fmt::format("{} primitives are counted, of explicit vertices {} ({})", count,
                                 expected_count, attempt.name),
                     std::to_string(expected_count), std::to_string(count));
  }
  if (!observed) throw NotObservable("pipeline: Begin does not raise the error, either");
  if (all_rejected) expect_unchanged(checked, evaluated.before, evaluated.after);
}

const std::vector<GLenum> kNone = {};

// --- Framebuffers ----------------------------------------------------------------------------------------

EVALCTS_TEST(Pipeline, IncompleteFramebuffer, kMust, "EV-PIPE-FBO")
(Test& t) {
  t.require(3, 0, "GL_ARB_framebuffer_object");
  expect_rejected_like_begin(
      t, meshes(t),
      [](gl::Case& c) {
        const gl::ResultOf whole{c.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, gl::out<GLint>(1)).index, 0};
        const gl::ResultOf without_images{c.GenFramebuffers(1, gl::out<GLuint>(1)).index, 0};
        return Prepared{{{"a framebuffer without images",
                          [=](gl::Case& to) { to.BindFramebuffer(GL_DRAW_FRAMEBUFFER, without_images); },
                          [=](gl::Case& to) { to.BindFramebuffer(GL_DRAW_FRAMEBUFFER, whole); }, kNone}}};
      },
      GL_INVALID_FRAMEBUFFER_OPERATION);
};

// --- Programs that cannot run ----------------------------------------------------------------------------

// Returns a state in which the program is in use.
Refusal in_use(std::string name, const Program& program, std::vector<GLenum> allowed) {
  return {std::move(name), [=](gl::Case& to) { to.UseProgram(program.name); },
          [](gl::Case& to) { to.UseProgram(0); }, std::move(allowed)};
}

struct Invalid {
  const char* name;
  const char* extension;
  GLenum target;
};
constexpr Invalid kInvalid[] = {{"VERTEX_PROGRAM", "GL_ARB_vertex_program", GL_VERTEX_PROGRAM_ARB},
                                {"FRAGMENT_PROGRAM", "GL_ARB_fragment_program", GL_FRAGMENT_PROGRAM_ARB}};

EVALCTS_TEST(Pipeline, NoValidAssemblyProgram, kMust, "EV-PIPE-INVALIDPROGRAM", combine(kInvalid))
(Test& t, const Invalid& invalid) {
  require_extension(t, invalid.extension);
  expect_rejected_like_begin(
      t, meshes(t),
      [&](gl::Case&) {
        const GLenum target = invalid.target;
        return Prepared{{{"enabled without a program", [=](gl::Case& to) { to.Enable(target); },
                          [=](gl::Case& to) { to.Disable(target); }, kNone}}};
      },
      GL_INVALID_OPERATION);
};

// Two samplers of different types use the same texture unit: the initial one, 0.
EVALCTS_TEST(Pipeline, SamplersInConflict, kMust, "EV-PIPE-INVALIDPROGRAM")
(Test& t) {
  t.require(2, 0);
  expect_rejected_like_begin(
      t, meshes(t),
      [](gl::Case& c) {
        const Program program = link_program(
            c, {{GL_FRAGMENT_SHADER,
                 "uniform sampler2D flat_one;\nuniform sampler3D deep_one;\nvoid main() {\n  gl_FragColor = "
                 "texture2D(flat_one, gl_FragCoord.xy) + texture3D(deep_one, gl_FragCoord.xyz);\n}\n"}});
        return Prepared{{in_use("samplers in conflict", program, kNone)}, {program}};
      },
      GL_INVALID_OPERATION);
};

// --- Transform feedback ----------------------------------------------------------------------------------

constexpr std::size_t kRecordedFloats = 4096;

// Primitives of the mode of transform feedback are recorded like explicit ones, others are rejected.
EVALCTS_TEST(Pipeline, TransformFeedbackModes, kMust, "EV-PIPE-XFB-MODE")
(Test& t) {
  t.require(3, 0);
  expect_rejected_like_begin(
      t, meshes(t),
      [](gl::Case& c) {
        const Program program = link_program(
            c,
            {{GL_VERTEX_SHADER,
              "varying vec4 seen;\nvoid main() {\n  seen = gl_Vertex;\n  gl_FrontColor = gl_Color;\n  "
              "gl_Position = gl_Vertex;\n}\n"}},
            {"seen"});
        bind_recording_buffer(c, kRecordedFloats);
        Prepared prepared{{}, {program}};
        const auto add = [&](const char* name, GLenum mode, GLenum allowed) {
          prepared.rejections.push_back({name,
                                         [=](gl::Case& to) {
                                           to.UseProgram(program.name);
                                           to.BeginTransformFeedback(mode);
                                         },
                                         [](gl::Case& to) {
                                           to.EndTransformFeedback();
                                           to.UseProgram(0);
                                         },
                                         {allowed}});
        };
        add("transform feedback of POINTS", GL_POINTS, GL_POINTS);
        add("transform feedback of LINES", GL_LINES, GL_LINE_STRIP);
        add("transform feedback of TRIANGLES", GL_TRIANGLES, GL_QUAD_STRIP);
        return prepared;
      },
      GL_INVALID_OPERATION, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
};

// --- Geometry shaders and tessellation -------------------------------------------------------------------

constexpr char kVertexShader[] = "#version 150 compatibility\nvoid main() {\n  gl_Position = gl_Vertex;\n}\n";
constexpr char kFragmentShader[] =
    "#version 150 compatibility\nvoid main() {\n  gl_FragColor = vec4(1.0);\n}\n";

std::string geometry_shader(const char* input, const char* output, int vertices) {
  return fmt::format(
      "#version 150 compatibility\nlayout({}) in;\nlayout({}, max_vertices = {}) out;\nvoid main() {{\n  for "
      "(int i = 0; i < {}; ++i) {{\n    gl_Position = gl_in[i].gl_Position;\n    EmitVertex();\n  }}\n}}\n",
      input, output, vertices, vertices);
}

EVALCTS_TEST(Pipeline, GeometryShaderInputs, kMust, "EV-PIPE-GS", combine(kMeshKinds))
(Test& t, const MeshKind& kind) {
  t.require(3, 2);
  struct Input {
    const char *name, *output;
    int vertices;
    std::vector<GLenum> allowed;
  };
  const std::vector<Input> inputs = {{"points", "points", 1, {GL_POINTS}},
                                     {"lines", "line_strip", 2, {GL_LINE_STRIP}},
                                     {"triangles", "triangle_strip", 3, {}},
                                     {"lines_adjacency", "line_strip", 4, {}},
                                     {"triangles_adjacency", "triangle_strip", 6, {}}};
  expect_rejected_like_begin(
      t, meshes_of(t, kind),
      [&](gl::Case& c) {
        Prepared prepared;
        for (const Input& input : inputs) {
          const Program program = link_program(
              c, {{GL_VERTEX_SHADER, kVertexShader},
                  {GL_GEOMETRY_SHADER, geometry_shader(input.name, input.output, input.vertices)},
                  {GL_FRAGMENT_SHADER, kFragmentShader}});
          prepared.programs.push_back(program);
          prepared.rejections.push_back(
              in_use(std::string("geometry shader of ") + input.name, program, input.allowed));
        }
        return prepared;
      },
      GL_INVALID_OPERATION);
};

EVALCTS_TEST(Pipeline, Tessellation, kMust, "EV-PIPE-TESS")
(Test& t) {
  t.require(4, 0);
  expect_rejected_like_begin(
      t, meshes(t),
      [](gl::Case& c) {
        Prepared prepared;
        for (const char* domain : {"isolines", "triangles", "quads"}) {
          const Program program = link_program(
              c, {{GL_VERTEX_SHADER, kVertexShader},
                  {GL_TESS_EVALUATION_SHADER,
                   fmt::format("#version 400 compatibility\nlayout({}) in;\nvoid main() {{\n  gl_Position = "
                               "gl_in[0].gl_Position;\n}}\n",
                               domain)},
                  {GL_FRAGMENT_SHADER, kFragmentShader}});
          prepared.programs.push_back(program);
          prepared.rejections.push_back({std::string("tessellation of ") + domain,
                                         [=](gl::Case& to) {
                                           to.PatchParameteri(GL_PATCH_VERTICES, 1);
                                           to.UseProgram(program.name);
                                         },
                                         [](gl::Case& to) { to.UseProgram(0); }, kNone});
        }
        return prepared;
      },
      GL_INVALID_OPERATION);
};

}  // namespace
}  // namespace evalcts::suite_rejected_primitives
