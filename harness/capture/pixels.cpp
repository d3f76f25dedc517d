// Pixels: for an implementation with neither feedback mode nor transform feedback. Each vertex is drawn as a
// large point in the middle of the viewport. A part of a row of pixels shows one vertex, because its stencil
// values let only that point pass, and a pixel shows half of one component, because a fragment shader writes
// 16 of its bits as colour. -0 comes back as 0, and subnormals may. NaN and infinities are distinguished from
// finite numbers if the shader can do so. Without shaders, the pixels show the colours of the vertices, with
// the precision of the framebuffer.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include <evalcts/gl/roles.h>
#include "control.h"
#include "program.h"

namespace evalcts {
namespace {

constexpr int kViewport = 64;
constexpr int kSide = 60;  // side of the points, in pixels
constexpr int kComponents = 15;
constexpr int kColumns = 2 * kComponents;  // pixels of one vertex
constexpr int kAcross = kSide / kColumns;  // vertices side by side
constexpr int kCorner = (kViewport - kSide) / 2;
constexpr std::size_t kOfOnePass = kSide * kAcross;
constexpr std::size_t kOfOneWindow = 255;  // the largest value of an 8-bit stencil

// Draws the vertices of one window (see Windows), or all of them if there is only one; the others are
// clipped.
std::string vertex_shader(std::size_t windows, std::size_t window) {
  std::string place = "vec4(0.0, 0.0, 0.0, 1.0)";
  if (windows > 1)
    place =
        fmt::format("abs(gl_MultiTexCoord1.s - {}.0) < 0.5 ? {} : vec4(0.0, 0.0, 2.0, 1.0)", window, place);
  return fmt::format(R"(#version 120
#ifdef GL_ES
precision highp float;
#endif
varying vec4 seen_position;
varying vec4 seen_color;
varying vec4 seen_normal;
varying vec4 seen_texture;
void main() {{
  seen_position = gl_Vertex;
  seen_color = gl_Color;
  seen_normal = vec4(gl_Normal, 0.0);
  seen_texture = gl_MultiTexCoord0;
  gl_Position = {};
  gl_PointSize = {}.0;
}}
)",
                     place, kSide);
}

// Writes half of one component into the pixel; the order of the components is that of `decode`.
// Multiplications by powers of two bring the magnitude into [1,2), and floors give its bits. Blue is 1 for
// each vertex, which distinguishes zeros from pixels without a vertex. All constants have few digits, because
// layers reprint them.
std::string fragment_shader() {
  std::string powers =
      "  float down1 = 0.5, down2 = 0.25, down4 = 0.0625, up1 = 2.0, up2 = 4.0, up4 = 16.0;\n";
  for (const int k : {4, 8, 16, 32})
    powers += fmt::format("  float down{0} = down{1} * down{1}, up{0} = up{1} * up{1};\n", 2 * k, k);
  std::string scaling;
  for (const int k : {64, 32, 16, 8, 4, 2, 1})
    scaling += fmt::format("    if (a >= up{0}) {{ a *= down{0}; e += {0}.0; }}\n", k);
  for (const int k : {64, 32, 16, 8, 4, 2, 1})
    scaling += fmt::format("    if (a < 2.0 * down{0}) {{ a *= up{0}; e -= {0}.0; }}\n", k);
  return fmt::format(R"(#version 120
#ifdef GL_ES
precision highp float;
#endif
varying vec4 seen_position;
varying vec4 seen_color;
varying vec4 seen_normal;
varying vec4 seen_texture;
void main() {{
  float column = mod(floor(gl_FragCoord.x) - {0}.0, 30.0);
  float component = floor(column / 2.0);
  float place = mod(component, 4.0);
  vec4 four = component < 4.0 ? seen_position : component < 8.0 ? seen_color :
              component < 12.0 ? seen_texture : seen_normal;
  float x = place < 1.0 ? four.x : place < 2.0 ? four.y : place < 3.0 ? four.z : four.w;
  float sign = x < 0.0 ? 128.0 : 0.0;
  float a = abs(x);
  float e = 127.0;
{1}  vec4 bytes = vec4(0.0);
  if (a > 0.0) {{
{2}    float m = (a - 1.0) * up16 * 128.0;
    float high = floor(m * down16);
    float low = m - high * up16;
    float middle = floor(low * down8);
    float even = floor(e * 0.5);
    bytes = vec4(sign + even, (e - even * 2.0) * 128.0 + high, middle, low - middle * 256.0);
    if (a >= 2.0) bytes = vec4(sign + 127.0, 128.0, 0.0, 0.0);  // infinite
  }} else if (a != 0.0) {{
    bytes = vec4(127.0, 192.0, 0.0, 0.0);  // NaN
  }}
  vec2 both = column - component * 2.0 < 0.5 ? bytes.xy : bytes.zw;
  gl_FragColor = vec4(both / 255.0, 1.0, 1.0);
}}
)",
                     kCorner, powers, scaling);
}

// Returns the number of vertices that the command draws by itself.
std::size_t vertices_of(const gl::Command& command) {
  const auto count = [&](std::size_t first) {
    return static_cast<std::size_t>(
        std::max<std::int64_t>(0, gl::integer_of(command, first + 1) - gl::integer_of(command, first) + 1));
  };
  if (gl::emits_vertex(command.entry)) return 1;
  if (command.entry == gl::EntryPoint::EvalMesh1) return count(1);
  if (command.entry == gl::EntryPoint::EvalMesh2) return count(1) * count(3);
  return 0;
}

// Splits a case with many vertices into windows that are captured one after the other. Texture coordinates of
// unit 1, set between the commands, hold the number of the window.
class Windows {
 public:
  // Makes one window if the case sets the texture coordinates of unit 1 itself or its lists draw the windows
  // in another order.
  // Also makes one window if there is no program, which clips the others.
  Windows(const gl::Case& script, bool has_program) : script_(script) {
    if (!has_program || !split() || !are_in_order()) {
      script_ = script;
      count_ = 1;
    }
  }

  const gl::Case& script() const { return script_; }
  std::size_t count() const { return count_; }

  static void set(gl::Case& c, std::size_t window) {
    c.MultiTexCoord1f(GL_TEXTURE1, static_cast<GLfloat>(window));
  }

 private:
  // False if the case touches the current texture coordinates of unit 1.
  bool split() {
    gl::Case windowed(script_.identity());
    std::vector<int> positions;  // positions of the original commands in `windowed`
    std::size_t in_window = 0;
    for (gl::Command command : script_.commands()) {
      if (command.entry == gl::EntryPoint::ActiveTexture || command.entry == gl::EntryPoint::PopAttrib ||
          gl::stem_of(command.entry) == "MultiTexCoord")
        return false;
      const std::size_t vertices = vertices_of(command);
      in_window += vertices;
      if (in_window > kOfOnePass - 2) {  // two places are for the witness and for a surplus vertex
        set(windowed, count_++);
        in_window = vertices;
      }
      for (gl::Value& value : command.arguments)
        if (auto* result = std::get_if<gl::ResultOf>(&value))
          result->command = positions.at(static_cast<std::size_t>(result->command));
      positions.push_back(windowed.add(std::move(command)).index);
    }
    script_ = std::move(windowed);
    return true;
  }

  // True if the vertices of each window are drawn after those of the windows before it.
  bool are_in_order() const {
    if (count_ == 1) return true;
    std::map<std::int64_t, std::vector<const gl::Command*>> lists;
    std::vector<const gl::Command*>* list = nullptr;  // the list that is being compiled, if any
    double window = 0, last = 0;
    bool in_order = true;
    int depth = 0;  // nesting of lists, which GL limits to 64 levels or more
    const std::function<void(const gl::Command&)> execute = [&](const gl::Command& command) {
      if (command.entry == gl::EntryPoint::CallList && depth < 64) {
        ++depth;
        for (const gl::Command* called : lists[gl::integer_of(command, 0)]) execute(*called);
        --depth;
      }
      if (command.entry == gl::EntryPoint::MultiTexCoord1f) window = std::get<float>(command.arguments[1]);
      if (vertices_of(command) == 0) return;
      in_order = in_order && window >= last;
      last = window;
    };
    bool executes = true;
    for (const gl::Command& command : script_.commands()) {
      if (command.entry == gl::EntryPoint::EndList) {
        list = nullptr;
        executes = true;
      }
      if (list) list->push_back(&command);
      if (executes) execute(command);
      if (command.entry == gl::EntryPoint::NewList) {
        list = &lists[gl::integer_of(command, 0)];
        list->clear();
        executes = gl::integer_of(command, 1) == GL_COMPILE_AND_EXECUTE;
      }
    }
    return in_order;
  }

  gl::Case script_;
  std::size_t count_ = 1;
};

// The explicit vertex that is drawn after the case. If it is not captured after the vertices of the case, the
// case has changed state that pixels depend on.
const ObservedVertex& witness() {
  static const ObservedVertex kVertex = [] {
    ObservedVertex v;
    v.position = {0.3f, -0.7f, 0.011f, 1.5f};
    v.color = {0.1f, 0.9f, 0.3f, 0.6f};
    v.normal = {0.36f, -0.48f, 0.8f};
    v.texture_coordinate[0] = {-12.3f, 0.007f, 4.5f, 1.25f};
    return v;
  }();
  return kVertex;
}

void draw_witness(gl::Case& c) {
  const auto& [position, color, normal, textures] = witness();
  c.Begin(GL_POINTS);
  c.Color4f(color[0], color[1], color[2], color[3]);
  c.Normal3f(normal[0], normal[1], normal[2]);
  c.TexCoord4f(textures[0][0], textures[0][1], textures[0][2], textures[0][3]);
  c.Vertex4f(position[0], position[1], position[2], position[3]);
  c.End();
}

bool is_witness(const ObservedVertex& vertex, bool colors_only) {
  const ObservedVertex& known = witness();
  if (colors_only)
    return std::ranges::equal(vertex.color, known.color,
                              [](float got, float given) { return std::abs(got - given) <= 1.0f / 63; });
  return vertex.position == known.position && vertex.color == known.color && vertex.normal == known.normal &&
         vertex.texture_coordinate[0] == known.texture_coordinate[0];
}

// The pixels of one pass, from the lower left corner of the points.
struct Picture {
  std::vector<GLubyte> bytes;

  // Returns the first pixel of a vertex.
  const GLubyte* at(std::size_t vertex) const {
    return &bytes[4 * (vertex % kSide * kSide + vertex / kSide * kColumns)];
  }
};

// Returns the float whose bits two neighbouring pixels show.
float decode(const GLubyte* pixel) {
  const std::uint32_t bits = static_cast<std::uint32_t>(pixel[0]) << 24 |
                             static_cast<std::uint32_t>(pixel[1]) << 16 |
                             static_cast<std::uint32_t>(pixel[4]) << 8 | static_cast<std::uint32_t>(pixel[5]);
  return std::bit_cast<float>(bits);
}

template <std::size_t kN>
void decode(const GLubyte* vertex, std::size_t first_component, std::array<float, kN>& values) {
  for (std::size_t k = 0; k < kN; ++k) values[k] = decode(vertex + 8 * (first_component + k));
}

class Pixels final : public Capture {
 public:
  std::string name() const override { return "Pixels"; }
  bool is_last_resort() const override { return true; }

  void prove(Implementation& implementation, const ImplementationInfo&) override {
    has_program_ = true;
    attributes_ = kAttributes;  // for the control
    std::string wrong;
    try {
      wrong = try_control(*this, implementation, {true, true}, kAttributes);
    } catch (const gl::MissingEntryPoint& missing) {
      wrong = missing.what();
    } catch (const NotObservable& reason) {
      wrong = reason.what();
    }
    if (wrong.empty()) return;
    has_program_ = false;
    attributes_ = 0;
    color_error_ = measure_color_error(*this, implementation);
    if (!color_error_) throw NotObservable(wrong);
  }

  Attributes attributes() const override { return attributes_; }
  Attributes inexact_attributes() const override { return color_error_ ? kColor : 0u; }
  bool loses_nonpositive_w() const override { return !has_program_; }
  bool loses_vertices_beyond_float() const override { return true; }
  bool takes(PrimitiveKinds kinds) const override { return kinds == kPoints; }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const CaptureRequest& request) const override {
    Observation observation;
    observation.attributes = has_program_ ? attributes_ : kColor;
    observation.clamped_colors = !has_program_;
    observation.color_error = color_error_.value_or(0);
    const Windows windows(script, has_program_);
    std::vector<ObservedVertex> vertices;
    for (std::size_t window = 0; window < windows.count(); ++window)
      observe_window(implementation, windows, window, vertices, observation);
    observation.overflow = vertices.size() > request.most_vertices;
    if (!vertices.empty()) observation.primitives.push_back({GL_POINTS, std::move(vertices)});
    return observation;
  }

 private:
  static constexpr Attributes kAttributes =
      kPosition | kColor | kNormal | kShaderNormal | kTextureCoordinate0;

  void observe_window(Implementation& implementation, const Windows& windows, std::size_t window,
                      std::vector<ObservedVertex>& vertices, Observation& observation) const {
    std::vector<ObservedVertex> seen;
    for (std::size_t first = 0; seen.size() == first && first < kOfOneWindow; first += kOfOnePass) {
      const std::size_t count = std::min(kOfOneWindow - first, kOfOnePass);
      const GLenum error = run_pass(implementation, windows, window, first, count, seen);
      if (window == 0 && first == 0) observation.error = error;
    }
    if (seen.size() == kOfOneWindow)
      throw NotObservable(fmt::format("pixels show at most {} vertices of these commands", kOfOneWindow - 1));
    if (seen.empty() || !is_witness(seen.back(), !has_program_))
      throw NotObservable("pixels do not show the explicit vertex that is drawn after the case");
    vertices.insert(vertices.end(), seen.begin(), seen.end() - 1);
  }

  // Appends up to `count` vertices of the window, starting with the vertex `first`. Returns the error of the
  // case.
  GLenum run_pass(Implementation& implementation, const Windows& windows, std::size_t window,
                  std::size_t first, std::size_t count, std::vector<ObservedVertex>& vertices) const {
    if (!has_program_) return run_pass_of_colors(implementation, windows.script(), first, count, vertices);
    const std::unique_ptr<Context> context = implementation.create_context();
    gl::Case prologue = begin_pass(first, count);
    prologue.Enable(GL_VERTEX_PROGRAM_POINT_SIZE);
    const UsedProgram program(
        prologue, *context,
        {.vertex = vertex_shader(windows.count(), window), .fragment = fragment_shader()});
    gl::Case epilogue;
    if (windows.count() > 1) Windows::set(epilogue, window);
    const auto [picture, error] = draw(*context, std::move(prologue), windows.script(), epilogue, &program);
    for (std::size_t i = 0; i < count && picture.at(i)[2] == 255; ++i) {
      ObservedVertex& vertex = vertices.emplace_back();
      decode(picture.at(i), 0, vertex.position);
      decode(picture.at(i), 4, vertex.color);
      decode(picture.at(i), 8, vertex.texture_coordinate[0]);
      decode(picture.at(i), 12, vertex.normal);
    }
    return error;
  }

  // Draws twice, behind black and behind white: where both pictures agree there is a vertex.
  GLenum run_pass_of_colors(Implementation& implementation, const gl::Case& script, std::size_t first,
                            std::size_t count, std::vector<ObservedVertex>& vertices) const {
    const auto behind = [&](GLfloat background) {
      gl::Case prologue;
      prologue.ClearColor(background, background, background, background);
      prologue.append(begin_pass(first, count));
      prologue.MatrixMode(GL_PROJECTION);
      std::vector<GLfloat> to_the_middle(16, 0.0f);
      to_the_middle[15] = 1.0f;
      prologue.LoadMatrixf(std::move(to_the_middle));
      prologue.MatrixMode(GL_MODELVIEW);
      return draw(*implementation.create_context(), std::move(prologue), script, {}, nullptr);
    };
    const auto [picture, error] = behind(0);
    const Picture other = behind(1).first;
    for (std::size_t i = 0; i < count && std::equal(picture.at(i), picture.at(i) + 4, other.at(i)); ++i) {
      ObservedVertex& vertex = vertices.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) vertex.color[k] = static_cast<float>(picture.at(i)[k]) / 255.0f;
    }
    return error;
  }

  // Returns commands that clear the framebuffer and let a part of a row of pixels show the vertex `first` and
  // each of the `count` - 1 after it.
  static gl::Case begin_pass(std::size_t first, std::size_t count) {
    gl::Case c;
    c.Viewport(0, 0, kViewport, kViewport);
    c.Disable(GL_DITHER);
    c.Clear(GL_COLOR_BUFFER_BIT);
    c.Enable(GL_SCISSOR_TEST);
    for (std::size_t i = 0; i < count; ++i) {
      c.Scissor(kCorner + static_cast<GLint>(i / kSide * kColumns), kCorner + static_cast<GLint>(i % kSide),
                kColumns, 1);
      c.ClearStencil(static_cast<GLint>(255 - (first + i)));
      c.Clear(GL_STENCIL_BUFFER_BIT);
    }
    c.Scissor(kCorner, kCorner, kSide, kSide);
    c.Enable(GL_STENCIL_TEST);
    c.StencilFunc(GL_EQUAL, 255, ~0u);
    c.StencilOp(GL_INCR, GL_INCR, GL_ZERO);
    c.PointSize(kSide);
    return c;
  }

  // Runs the prologue, the case, the epilogue and the witness. Returns the pixels and the error of the case.
  static std::pair<Picture, GLenum> draw(Context& context, gl::Case prologue, const gl::Case& script,
                                         const gl::Case& epilogue, const UsedProgram* program) {
    WrappedCase wrapped = begin_wrapping(std::move(prologue), script);
    wrapped.commands.append(epilogue);
    draw_witness(wrapped.commands);
    const gl::Ref pixels =
        wrapped.commands.ReadPixels(kCorner, kCorner, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE,
                                    gl::out<GLubyte>(std::size_t{4} * kSide * kSide));
    const gl::Trace trace = context.play(wrapped.commands);
    if (program) program->require_linked(trace);
    if (trace.error(wrapped.error_before) != GL_NO_ERROR) throw NotObservable("pixels cannot be set up");
    return {Picture{trace.values<GLubyte>(pixels)}, trace.error(wrapped.error_after)};
  }

  bool has_program_ = true;
  Attributes attributes_ = 0;
  std::optional<double> color_error_;  // set if there is no program
};

}  // namespace

std::unique_ptr<Capture> make_pixels() { return std::make_unique<Pixels>(); }

}  // namespace evalcts
