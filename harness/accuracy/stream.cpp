#include "harness/accuracy/stream.h"

#include <fmt/format.h>
#include <glevaluator.h>

#include <functional>

#include "harness/accuracy/subject.h"
#include "harness/capture/varyings.h"
#include "harness/gl/tokens.h"

namespace evalcts::accuracy {
namespace {

// libglevaluator's batches.
class ProductionStream final : public Stream {
 public:
  explicit ProductionStream(const std::vector<double>& points) {
    if (glevCreateContext(nullptr, &context_) != GLEV_SUCCESS) throw CannotStart("glevCreateContext failed");
    glevMap1d(context_, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, static_cast<int>(points.size()), points.data());
    glevEnable(context_, GLEV_MAP1_TEXTURE_COORD_1);
    const glev_plan_info info = {sizeof info, 1};
    if (glevGetError(context_) != GLEV_NO_ERROR || glevCreatePlan(context_, &info, &plan_) != GLEV_SUCCESS)
      throw NotObservable("the map is refused");
  }
  ProductionStream(const ProductionStream&) = delete;
  ProductionStream& operator=(const ProductionStream&) = delete;
  ~ProductionStream() override {
    glevReleasePlan(plan_);
    glevDestroyContext(context_);
  }

  void evaluate(std::span<const float> u, std::span<float> results) override {
    glev_output output{};
    output.size = sizeof output;
    output.data = results.data();
    output.data_size = results.size_bytes();
    output.stride = sizeof(float);
    output.components = 1;
    glev_batch batch{};
    batch.size = sizeof batch;
    batch.count = u.size();
    batch.type = GLEV_FLOAT;
    batch.u = {u.data(), u.size_bytes(), sizeof(float)};
    batch.outputs.texcoord = &output;
    if (glevEvaluate(plan_, &batch) != GLEV_SUCCESS) throw NotObservable("a batch is refused");
  }

 private:
  glev_context* context_ = nullptr;
  glev_plan* plan_ = nullptr;
};

// Anything, through Subject.
class SubjectStream final : public Stream {
 public:
  SubjectStream(std::unique_ptr<Subject> subject, const std::vector<double>& points)
      : subject_(std::move(subject)),
        map_{static_cast<int>(points.size()), 1, 1, true, {0, 1, 0, 1}, points} {}
  void evaluate(std::span<const float> u, std::span<float> results) override {
    subject_->evaluate(GL_MAP1_TEXTURE_COORD_1, map_, u, {}, results);
  }

 private:
  std::unique_ptr<Subject> subject_;
  Map map_;
};

// A GL whose transform feedback records one float for each vertex. One context for all: nothing changes in it
// but the buffer's contents. Calls go straight to the library.
class RecordingStream final : public Stream {
 public:
  RecordingStream(Implementation& implementation, const std::vector<double>& points)
      : context_(implementation.create_context()), gl_(context_->table()) {
    gl::Case c;
    const gl::Ref shader = c.CreateShader(GL_VERTEX_SHADER);
    c.ShaderSource(
        shader, 1,
        gl::Strings{{"#version 120\nvarying float seen;\nvoid main() {\n  seen = gl_MultiTexCoord0.x;\n"
                     "  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}\n"}},
        nullptr);
    c.CompileShader(shader);
    const gl::Ref program = c.CreateProgram();
    c.AttachShader(program, shader);
    c.TransformFeedbackVaryings(program, 1, gl::Strings{{"seen"}}, GL_INTERLEAVED_ATTRIBS);
    c.LinkProgram(program);
    const gl::Ref linked = c.GetProgramiv(program, GL_LINK_STATUS, gl::out<GLint>(1));
    c.UseProgram(program);
    const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
    c.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    c.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, kLongest * sizeof(GLfloat), nullptr, GL_STREAM_READ);
    c.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    c.Enable(GL_RASTERIZER_DISCARD);
    c.Map1f(GL_MAP1_TEXTURE_COORD_1, 0, 1, 1, points.size(),
            std::vector<float>(points.begin(), points.end()));
    c.Enable(GL_MAP1_TEXTURE_COORD_1);
    c.Enable(GL_MAP1_VERTEX_3);
    const gl::Ref query = c.GenQueries(1, gl::out<GLuint>(1));
    const gl::Ref error = c.GetError();
    const gl::Trace trace = context_->play(c);
    if (trace.values<GLint>(linked)[0] != GL_TRUE) throw NotObservable("the capturing shader does not link");
    if (trace.error(error) != GL_NO_ERROR)
      throw NotObservable("transform feedback cannot be set up: " + gl::error_name(trace.error(error)));
    query_ = trace.values<GLuint>(query)[0];
  }

  void evaluate(std::span<const float> u, std::span<float> results) override {
    gl_.BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query_);
    gl_.BeginTransformFeedback(GL_POINTS);
    gl_.Begin(GL_POINTS);
    for (const float x : u) gl_.EvalCoord1f(x);
    gl_.End();
    gl_.EndTransformFeedback();
    gl_.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint written = 0;
    gl_.GetQueryObjectuiv(query_, GL_QUERY_RESULT, &written);
    gl_.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(results.size_bytes()),
                         results.data());
    const GLenum error = gl_.GetError();
    if (written != u.size() || error != GL_NO_ERROR)
      throw NotObservable(fmt::format("{} vertices should have come out, {} did ({})", u.size(), written,
                                      gl::error_name(error)));
  }

 private:
  std::unique_ptr<Context> context_;
  const gl::Table& gl_;
  GLuint query_ = 0;
};

}  // namespace

StreamSource stream_source(const ImplementationOptions& options) {
  StreamSource source;
  if (options.library.empty() && options.context.empty()) {
    if (options.name == "production-fast")
      throw CannotStart("production-fast is for grids: it has no results at every float");
    if (const auto textbook = make_textbook(options.name)) {
      source.info = textbook->info();
      source.for_threads = true;
      source.make = [name = options.name](const std::vector<double>& points) {
        return std::make_unique<SubjectStream>(make_textbook(name), points);
      };
      return source;
    }
  }
  const std::shared_ptr<Implementation> implementation = open_implementation(options);
  source.info = inquire(*implementation);
  if (source.info.name == "production") {
    source.for_threads = true;
    source.make = [](const std::vector<double>& points) {
      return std::make_unique<ProductionStream>(points);
    };
  } else if (source.info.at_least(3, 0) && !implementation->create_context()->has_sink()) {
    source.make = [implementation](const std::vector<double>& points) {
      return std::make_unique<RecordingStream>(*implementation, points);
    };
  } else {
    source.make = [options](const std::vector<double>& points) {
      return std::make_unique<SubjectStream>(make_captured(options), points);
    };
  }
  return source;
}

}  // namespace evalcts::accuracy
