// The streams of libglevaluator, of GLs with transform feedback, and of other subjects.
#include <evalcts/accuracy/stream.h>

#include <fmt/format.h>
#include <glevaluator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include <evalcts/accuracy/subject.h>
#include <evalcts/capture/varyings.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

// Streams of libglevaluator, by its batches.
class ProductionStream final : public Stream {
 public:
  ProductionStream(const SweptMap& what, const std::string& instruction_set)
      : two_dimensional_(what.two_dimensional), along_v_(what.along_v), other_(what.other) {
    const Map& map = what.map;
    glev_context_info context_info{};
    context_info.size = sizeof context_info;
    if (!instruction_set.empty()) context_info.target = instruction_set.c_str();
    if (glevCreateContext(&context_info, &context_) != GLEV_SUCCESS)
      throw CannotStart("glevCreateContext failed");
    const GLenum target = target_of(what.target, two_dimensional_);
    attribute_ = attribute_of(target);
    components_ = static_cast<std::size_t>(map.components);
    if (two_dimensional_) {
      glevMap2d(context_, target, 0, 1, map.vorder * map.components, map.uorder, 0, 1, map.components,
                map.vorder, map.points.data());
    } else {
      glevMap1d(context_, target, 0, 1, map.components, map.uorder, map.points.data());
    }
    glevEnable(context_, target);
    const glev_plan_info info = {sizeof info, two_dimensional_ ? std::size_t{2} : std::size_t{1}};
    if (glevGetError(context_) != GLEV_NO_ERROR || glevCreatePlan(context_, &info, &plan_) != GLEV_SUCCESS)
      throw NotObservable("the map is rejected");
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
    output.stride = components_ * sizeof(float);
    output.components = components_;
    glev_batch batch{};
    batch.size = sizeof batch;
    batch.count = u.size();
    batch.type = GLEV_FLOAT;
    const glev_input swept = {u.data(), u.size_bytes(), sizeof(float)}, other = {&other_, sizeof other_, 0};
    batch.u = along_v_ ? other : swept;
    if (two_dimensional_) batch.v = along_v_ ? swept : other;
    const glev_attribute_output outputs = {attribute_ == kPosition ? GLEV_ATTRIBUTE_VERTEX
                                           : attribute_ == kColor  ? GLEV_ATTRIBUTE_COLOR
                                           : attribute_ == kNormal ? GLEV_ATTRIBUTE_NORMAL
                                                                   : GLEV_ATTRIBUTE_TEXCOORD,
                                           &output};
    batch.outputs = &outputs;
    batch.output_count = 1;
    if (glevEvaluate(plan_, &batch) != GLEV_SUCCESS) throw NotObservable("a batch is rejected");
  }

 private:
  bool two_dimensional_, along_v_;
  float other_;
  Attributes attribute_ = 0;
  std::size_t components_ = 0;
  glev_context* context_ = nullptr;
  glev_plan* plan_ = nullptr;
};

// Streams of libglevaluator that call glevEvaluatePatches. Several copies of the map are evaluated, so that
// the kernels for several patches are used. These kernels do not support arguments outside the domain, so
// such arguments get a separate call.
class PatchStream final : public Stream {
 public:
  PatchStream(const SweptMap& map, std::string instruction_set)
      : map_(map),
        instruction_set_(std::move(instruction_set)),
        components_(static_cast<std::size_t>(map.map.components)) {
    for (std::size_t p = 0; p < kPatches; ++p)
      points_.insert(points_.end(), map.map.points.begin(), map.map.points.end());
  }

  void evaluate(std::span<const float> u, std::span<float> results) override {
    const auto is_inside = [](float x) { return x >= 0 && x <= 1; };
    std::array<std::vector<float>, 2> arguments, values;
    for (const float x : u) arguments[is_inside(x) ? 1 : 0].push_back(x);
    for (const std::size_t part : {0, 1}) values[part] = evaluate_part(arguments[part]);
    std::array<std::size_t, 2> next{};
    for (std::size_t i = 0; i < u.size(); ++i) {
      const std::size_t part = is_inside(u[i]) ? 1 : 0;
      std::copy_n(&values[part][next[part]], components_, &results[i * components_]);
      next[part] += components_;
    }
  }

 private:
  static constexpr std::size_t kPatches = 4;

  // Returns the results of the last patch.
  std::vector<float> evaluate_part(std::span<const float> u) {
    if (u.empty()) return {};
    glev_patches patches{};
    patches.size = sizeof patches;
    patches.count = kPatches;
    patches.components = components_;
    patches.uorder = map_.map.uorder;
    patches.vorder = map_.two_dimensional ? map_.map.vorder : 1;
    patches.type = GLEV_DOUBLE;
    patches.points = points_.data();
    patches.points_size = points_.size() * sizeof(double);
    const glev_input swept = {u.data(), u.size_bytes(), sizeof(float)},
                     other = {&map_.other, sizeof map_.other, 0};
    glev_patch_grid grid{};
    grid.size = sizeof grid;
    grid.kind = GLEV_GRID_LISTS;
    grid.type = GLEV_FLOAT;
    grid.u = map_.along_v ? other : swept;
    grid.v = map_.along_v ? swept : other;
    grid.u_count = map_.along_v ? 1 : u.size();
    grid.v_count = map_.along_v ? u.size() : 1;
    grid.target = instruction_set_.empty() ? nullptr : instruction_set_.c_str();
    const std::size_t own = u.size() * components_;
    std::vector<float> all(kPatches * own);
    scratch_.resize(glevGetPatchScratchSize(&patches, &grid));
    glev_output output{};
    output.size = sizeof output;
    output.data = all.data();
    output.data_size = all.size() * sizeof(float);
    output.stride = components_ * sizeof(float);
    output.components = components_;
    const glev_attribute_output outputs = {GLEV_ATTRIBUTE_VERTEX, &output};
    if (glevEvaluatePatches(&patches, &grid, &outputs, 1, scratch_.data(), scratch_.size()) != GLEV_SUCCESS)
      throw NotObservable("patches are rejected");
    return {all.end() - static_cast<std::ptrdiff_t>(own), all.end()};
  }

  SweptMap map_;
  std::string instruction_set_;
  std::size_t components_;
  std::vector<double> points_;
  std::vector<std::byte> scratch_;
};

// Streams of any subject.
class SubjectStream final : public Stream {
 public:
  SubjectStream(std::unique_ptr<Subject> subject, SweptMap map)
      : subject_(std::move(subject)), map_(std::move(map)) {}
  void evaluate(std::span<const float> u, std::span<float> results) override {
    const GLenum target = target_of(map_.target, map_.two_dimensional);
    if (!map_.two_dimensional) return subject_->evaluate(target, map_.map, u, {}, results);
    const std::vector<float> others(u.size(), map_.other);
    map_.along_v ? subject_->evaluate(target, map_.map, others, u, results)
                 : subject_->evaluate(target, map_.map, u, others, results);
  }

 private:
  std::unique_ptr<Subject> subject_;
  SweptMap map_;
};

// Returns the GLSL expression for the components of an attribute, such as "gl_Vertex.xyz".
std::string in_shader(Attributes attribute, int components) {
  const std::string name = attribute == kPosition ? "gl_Vertex"
                           : attribute == kColor  ? "gl_Color"
                           : attribute == kNormal ? "gl_Normal"
                                                  : "gl_MultiTexCoord0";
  return name + "." + std::string("xyzw").substr(0, components);
}

// Streams of a GL whose transform feedback records the components of each vertex. One context serves all
// calls, because only the contents of the buffer change. Calls go directly to the library.
class RecordingStream final : public Stream {
 public:
  RecordingStream(Implementation& implementation, const SweptMap& what)
      : two_dimensional_(what.two_dimensional),
        along_v_(what.along_v),
        other_(what.other),
        context_(implementation.create_context()),
        gl_(context_->table()) {
    const Map& map = what.map;
    const GLenum target = target_of(what.target, two_dimensional_);
    const Attributes attribute = attribute_of(target);
    const std::string type = map.components == 1 ? "float" : fmt::format("vec{}", map.components);
    gl::Case c;
    const gl::Ref shader = c.CreateShader(GL_VERTEX_SHADER);
    c.ShaderSource(shader, 1,
                   gl::Strings{{fmt::format("#version 120\nvarying {} seen;\nvoid main() {{\n  seen = {};\n"
                                            "  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}}\n",
                                            type, in_shader(attribute, map.components))}},
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
    c.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, kLongest * map.components * sizeof(GLfloat), nullptr,
                 GL_STREAM_READ);
    c.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    c.Enable(GL_RASTERIZER_DISCARD);
    const std::vector<float> points(map.points.begin(), map.points.end());
    if (two_dimensional_) {
      c.Map2f(target, 0, 1, map.vorder * map.components, map.uorder, 0, 1, map.components, map.vorder,
              points);
    } else {
      c.Map1f(target, 0, 1, map.components, map.uorder, points);
    }
    c.Enable(target);
    if (attribute != kPosition) c.Enable(two_dimensional_ ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
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
    if (!two_dimensional_) {
      for (const float x : u) gl_.EvalCoord1f(x);
    } else if (along_v_) {
      for (const float x : u) gl_.EvalCoord2f(other_, x);
    } else {
      for (const float x : u) gl_.EvalCoord2f(x, other_);
    }
    gl_.End();
    gl_.EndTransformFeedback();
    gl_.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint written = 0;
    gl_.GetQueryObjectuiv(query_, GL_QUERY_RESULT, &written);
    gl_.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(results.size_bytes()),
                         results.data());
    const GLenum error = gl_.GetError();
    if (written != u.size() || error != GL_NO_ERROR)
      throw NotObservable(
          fmt::format("expected {} vertices, captured {} ({})", u.size(), written, gl::error_name(error)));
  }

 private:
  bool two_dimensional_, along_v_;
  float other_;
  std::unique_ptr<Context> context_;
  const gl::Table& gl_;
  GLuint query_ = 0;
};

}  // namespace

StreamSource stream_source(const ImplementationOptions& options) {
  StreamSource source;
  if (options.library.empty() && options.context.empty()) {
    if (options.name == "production-fast")
      throw CannotStart("production-fast evaluates grids only, so it has no result for every float");
    if (const auto textbook = make_textbook(options.name)) {
      source.info = textbook->info();
      source.for_threads = true;
      source.make = [name = options.name](const SweptMap& map) {
        return std::make_unique<SubjectStream>(make_textbook(name), map);
      };
      return source;
    }
  }
  const std::shared_ptr<Implementation> implementation = open_implementation(options);
  source.info = inquire(*implementation);
  if (source.info.name == "production") {
    return production_source("");
  } else if (source.info.at_least(3, 0) && !implementation->create_context()->has_sink()) {
    source.make = [implementation](const SweptMap& map) {
      return std::make_unique<RecordingStream>(*implementation, map);
    };
  } else {
    source.make = [options](const SweptMap& map) {
      return std::make_unique<SubjectStream>(make_captured(options), map);
    };
  }
  return source;
}

StreamSource production_source(const std::string& instruction_set) {
  StreamSource source;
  ImplementationOptions options;
  options.name = "production";
  source.info = inquire(*open_implementation(options));
  source.for_threads = true;
  source.make = [instruction_set](const SweptMap& map) {
    return std::make_unique<ProductionStream>(map, instruction_set);
  };
  source.make_other = [instruction_set](const SweptMap& map) {
    return std::make_unique<PatchStream>(map, instruction_set);
  };
  return source;
}

}  // namespace evalcts::accuracy
