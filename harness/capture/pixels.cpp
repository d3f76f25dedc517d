// Pixels: for an implementation with neither feedback mode nor transform feedback. Each vertex is drawn as a
// large point in the middle of the window; a row of pixels shows one vertex, because its stencil values let
// only that point pass, and a column shows half of one component, because a fragment shader writes 16 of its
// bits as colour. -0 comes back as 0, subnormals may; NaN and infinities are told from numbers if the shader
// can.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "control.h"
#include "program.h"

namespace evalcts {
namespace {

constexpr int kViewport = 64;
constexpr int kSide = 48;     // of the points: rows, the vertices of one pass
constexpr int kColumns = 30;  // 15 components, two halves of each
constexpr int kCorner = (kViewport - kSide) / 2;
constexpr std::size_t kMostRows = 255;  // a stencil of 8 bits counts to there

constexpr const char* kVertexShader = R"(#version 120
#ifdef GL_ES
precision highp float;
#endif
varying vec4 seen_position;
varying vec4 seen_color;
varying vec4 seen_normal;
varying vec4 seen_texture;
void main() {
  seen_position = gl_Vertex;
  seen_color = gl_Color;
  seen_normal = vec4(gl_Normal, 0.0);
  seen_texture = gl_MultiTexCoord0;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  gl_PointSize = 48.0;
}
)";

// The order of the components is that of `decode`. Multiplications by powers of two bring a magnitude into
// [1,2); the bits follow from its floors. Blue is 1 for each vertex, so that pixels without a vertex are told
// from zeros. All constants have few digits, because layers print them anew.
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
  float column = floor(gl_FragCoord.x) - {0}.0;
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

// Drawn after the case: it has to come out as the vertex behind those of the case. If it does not, the case
// has changed something that pixels depend on.
const ObservedVertex& witness() {
  static const ObservedVertex vertex = [] {
    ObservedVertex v;
    v.position = {0.3f, -0.7f, 0.011f, 1.5f};
    v.color = {0.1f, 0.9f, 0.3f, 0.6f};
    v.normal = {0.36f, -0.48f, 0.8f};
    v.texture_coordinate[0] = {-12.3f, 0.007f, 4.5f, 1.25f};
    return v;
  }();
  return vertex;
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

bool is_witness(const ObservedVertex& vertex) {
  const ObservedVertex& known = witness();
  return vertex.position == known.position && vertex.color == known.color && vertex.normal == known.normal &&
         vertex.texture_coordinate[0] == known.texture_coordinate[0];
}

// The pixels of one pass, from the lower left corner of the points, each with its first three bytes.
struct Picture {
  std::vector<GLubyte> bytes;

  const GLubyte* at(int column, int row) const {
    return &bytes[4 * static_cast<std::size_t>(row * kColumns + column)];
  }
};

// A float whose bits two neighbouring pixels show.
float decode(const GLubyte* pixel) {
  const std::uint32_t bits = static_cast<std::uint32_t>(pixel[0]) << 24 |
                             static_cast<std::uint32_t>(pixel[1]) << 16 |
                             static_cast<std::uint32_t>(pixel[4]) << 8 | static_cast<std::uint32_t>(pixel[5]);
  return std::bit_cast<float>(bits);
}

template <std::size_t n>
void decode(const Picture& picture, int row, int first_component, std::array<float, n>& values) {
  for (std::size_t k = 0; k < n; ++k)
    values[k] = decode(picture.at(2 * (first_component + static_cast<int>(k)), row));
}

class Pixels final : public Capture {
 public:
  std::string name() const override { return "Pixels"; }
  bool is_last_resort() const override { return true; }

  void prove(Implementation& implementation, const ImplementationInfo&) override {
    attributes_ = kAttributes;  // for the control
    std::string wrong;
    try {
      wrong = try_control(*this, implementation, {true, true}, kAttributes);
    } catch (const gl::MissingEntryPoint& missing) {
      wrong = missing.what();
    } catch (const NotObservable& reason) {
      wrong = reason.what();
    }
    if (!wrong.empty()) throw NotObservable(wrong);
  }

  Attributes attributes() const override { return attributes_; }
  bool loses_vertices_beyond_float() const override { return true; }
  bool takes(PrimitiveKinds kinds) const override { return kinds == kPoints; }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const Wanted& wanted) const override {
    const std::size_t rows = wanted.most_vertices + 2;  // for the witness, and to see that more came
    if (rows > kMostRows)
      throw NotObservable(fmt::format("pixels show at most {} vertices of a case, not {}", kMostRows - 2,
                                      wanted.most_vertices));
    Observation observation;
    observation.attributes = attributes_;
    std::vector<ObservedVertex> vertices;
    for (std::size_t first = 0; vertices.size() == first && first < rows; first += kSide) {
      const GLenum error =
          play_pass(implementation, script, first, std::min(rows - first, std::size_t{kSide}), vertices);
      if (first == 0) observation.error = error;
    }
    observation.overflow = vertices.size() == rows;
    if (!observation.overflow) {
      if (vertices.empty() || !is_witness(vertices.back()))
        throw NotObservable("pixels do not show the explicit vertex that is drawn after the case");
      vertices.pop_back();
    }
    observation.overflow |= vertices.size() > wanted.most_vertices;
    if (!vertices.empty()) observation.primitives.push_back({GL_POINTS, std::move(vertices)});
    return observation;
  }

 private:
  static constexpr Attributes kAttributes =
      kPosition | kColor | kNormal | kShaderNormal | kTextureCoordinate0;

  // Appends the vertices that come as the `first` and following ones, up to `count`. Returns the error of the
  // case.
  GLenum play_pass(Implementation& implementation, const gl::Case& script, std::size_t first,
                   std::size_t count, std::vector<ObservedVertex>& vertices) const {
    const std::unique_ptr<Context> context = implementation.create_context();
    gl::Case prologue;
    prologue.Viewport(0, 0, kViewport, kViewport);
    prologue.Disable(GL_DITHER);
    prologue.Clear(GL_COLOR_BUFFER_BIT);
    prologue.Enable(GL_SCISSOR_TEST);
    for (std::size_t row = 0; row < count; ++row) {
      prologue.Scissor(0, kCorner + static_cast<GLint>(row), kViewport, 1);
      prologue.ClearStencil(static_cast<GLint>(255 - (first + row)));
      prologue.Clear(GL_STENCIL_BUFFER_BIT);
    }
    prologue.Scissor(0, kCorner, kViewport, static_cast<GLsizei>(count));
    prologue.Enable(GL_STENCIL_TEST);
    prologue.StencilFunc(GL_EQUAL, 255, ~0u);
    prologue.StencilOp(GL_INCR, GL_INCR, GL_ZERO);
    prologue.PointSize(kSide);
    prologue.Enable(GL_VERTEX_PROGRAM_POINT_SIZE);
    const UsedProgram program(prologue, *context, {.vertex = kVertexShader, .fragment = fragment_shader()});

    WrappedCase wrapped = begin_wrapping(std::move(prologue), script);
    gl::Case& c = wrapped.commands;
    draw_witness(c);
    const gl::Ref pixels = c.ReadPixels(kCorner, kCorner, kColumns, static_cast<GLsizei>(count), GL_RGBA,
                                        GL_UNSIGNED_BYTE, gl::out<GLubyte>(4 * kColumns * count));
    const gl::Trace trace = context->play(c);
    program.require_linked(trace);
    if (trace.error(wrapped.error_before) != GL_NO_ERROR) throw NotObservable("pixels cannot be set up");
    const Picture picture{trace.values<GLubyte>(pixels)};
    for (int row = 0; row < static_cast<int>(count) && picture.at(0, row)[2] == 255; ++row) {
      ObservedVertex& vertex = vertices.emplace_back();
      decode(picture, row, 0, vertex.position);
      decode(picture, row, 4, vertex.color);
      decode(picture, row, 8, vertex.texture_coordinate[0]);
      decode(picture, row, 12, vertex.normal);
    }
    return trace.error(wrapped.error_after);
  }

  Attributes attributes_ = 0;
};

}  // namespace

std::unique_ptr<Capture> make_pixels() { return std::make_unique<Pixels>(); }

}  // namespace evalcts
