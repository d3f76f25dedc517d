// Variations of the output: captures are coarse or missing, results have other errors, and meshes are drawn
// in another order.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "grid_steps.h"

namespace evalcts::faults::output_variations {
namespace {

// --- Results -----------------------------------------------------------------------------------------------

// Changes all attributes of all vertices.
Rules change_attributes(void (*change)(float& x)) {
  return change_all_vertices([=](ObservedVertex& vertex) {
    std::ranges::for_each(vertex.position, change);
    std::ranges::for_each(vertex.color, change);
    std::ranges::for_each(vertex.normal, change);
    for (auto& coordinates : vertex.texture_coordinate) std::ranges::for_each(coordinates, change);
  });
}

VARIATION(NoNegativeZero, "", "results of -0 are returned as +0",
          change_attributes([](float& x) { x += 0.0f; }));
VARIATION(NoSubnormals, "", "subnormal results are returned as 0", change_attributes([](float& x) {
            if (std::fpclassify(x) == FP_SUBNORMAL) x = 0;
          }));
VARIATION(ClampedColors, "", "colours are clamped to [0,1]", change_all_vertices([](ObservedVertex& vertex) {
            for (float& x : vertex.color) x = std::clamp(x, 0.0f, 1.0f);
          }));
VARIATION(WhiteOnly, "", "every colour comes out white, explicit ones, too",
          change_all_vertices([](ObservedVertex& vertex) {
            vertex.color = {1, 1, 1, 1};
          }));
VARIATION(PositionOnly, "", "only positions are output", change_all_vertices([](ObservedVertex& vertex) {
            const auto position = vertex.position;
            vertex = {};
            vertex.position = position;
          }));
VARIATION(LeastRange, "",
          "positions, normals and texture coordinates beyond 2^33 become infinite, colours beyond 2^11 "
          "saturated",
          change_all_vertices([](ObservedVertex& vertex) {
            const auto limit = [](float& x) {
              if (std::abs(x) > 0x1p33f) x = std::copysign(HUGE_VALF, x);
            };
            std::ranges::for_each(vertex.position, limit);
            std::ranges::for_each(vertex.normal, limit);
            for (auto& coordinates : vertex.texture_coordinate) std::ranges::for_each(coordinates, limit);
            for (float& x : vertex.color) x = std::clamp(x, -0x1p11f, 0x1p11f);
          }));
VARIATION(FloatArguments, "", "arguments of EvalCoord in double are rounded to float",
          before(kEvalCoords, {set(kU, to_float(kU)), set(kV, to_float(kV))}));

// --- Other arithmetic --------------------------------------------------------------------------------------

// Changes the last five bits of the significand, which is an error of up to 2.6 parts in 10^6, unless they
// are 0 or equal to the pattern. Applied twice, returns the original value.
double changed(double value) {
  constexpr std::uint32_t kMask = 0x1f, kPattern = 0x15;
  const auto x = static_cast<float>(value);
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t last = bits & kMask;
  if (!std::isnormal(x) || last == 0 || last == kPattern) return x;
  return std::bit_cast<float>(bits ^ kPattern);
}
// Restores the original control points of all changed maps. It must run before commands of lists or of other
// contexts can use the maps.
void take_back(Call& call) {
  GLint unit = GL_TEXTURE0;
  unmodified.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
  unmodified.ActiveTexture(GL_TEXTURE0);
  for (const auto& targets : {gl::kMap1Targets, gl::kMap2Targets})
    for (const GLenum target : targets) {
      if (!remembered(target).holds(call)) continue;
      remembered(target).assign(call, 0);
      const auto [same, u1, u2, v1, v2, net] = current_map(target);
      std::vector<GLfloat> points(net.values.size());
      std::ranges::transform(net.values, points.begin(), changed);
      const int k = net.components;
      const auto f = [](double x) { return static_cast<GLfloat>(x); };
      if (is_map1_target(target))
        unmodified.Map1f(target, f(u1), f(u2), k, net.rows, points.data());
      else
        unmodified.Map2f(target, f(u1), f(u2), k * net.columns, net.rows, f(v1), f(v2), k, net.columns,
                         points.data());
    }
  unmodified.ActiveTexture(static_cast<GLenum>(unit));
}

const Value kTakesEffect = kIsLegal && !kInside && !kListMode && state(GL_ACTIVE_TEXTURE) == GL_TEXTURE0;
const Value kIsChangedAnswer = kQuery == GL_COEFF && !kInside && remembered(kTarget);
VARIATION(OtherArithmetic, "", "results are those of control points that are off by up to 2.6 parts in 10^6",
          before(Map1f | Map2f, kTakesEffect,
                 {set(remembered(kTarget), 1), set(kFlag, 1),
                  [](Call& c) {
                    Net net = c.net();
                    std::ranges::transform(net.values, net.values.begin(), changed);
                    c.set_values(net);
                  }}),
          before(Map1d | Map2d, kTakesEffect, set(remembered(kTarget), 0)),
          before(NewList | CallList | Entries(CallLists) | OtherContextEVALCTS,
                 kFlag && !kInside && !kListMode, {take_back, set(kFlag, 0)}),
          after(GetMapfv | GetMapdv, kIsChangedAnswer,
                change_answers([](double exact, double) { return changed(exact); })),
          after(GetMapiv, kIsChangedAnswer, change_answers([](double exact, double) {
                  return std::clamp(std::floor(changed(exact) + 0.5), -0x1p31, 0x1p31 - 1);
                })),
          missing(kGetnMap));

// --- Meshes ------------------------------------------------------------------------------------------------

// The requirements on the order of the loops in the specification. Only their tests may depend on it.
constexpr std::string_view kLoops = "EV-MESH2-POINT EV-MESH2-LINE EV-MESH2-FILL";

const Value kIsDrawnMesh =
    kIsMode2 && !kInside && !kListMode && kI1 <= kI2 && kJ1 <= kJ2 && kI2 - kI1 <= 1000 && kJ2 - kJ1 <= 1000;

// Draws the points, line strips and quads of a mesh in another order. Each quad is a primitive of mode QUADS,
// or QUAD_STRIP, which keeps the provoking vertex.
Rules draw_meshes(bool backwards, GLenum quads) {
  const auto from_to = [=](Place index, Value first, Value last, Steps steps) {
    return backwards ? loop(index, last, first, steps, -1) : loop(index, first, last, steps);
  };
  const Value other = quads == GL_QUADS ? 1 : 0;
  const Steps quad = {point(kColumn, kRow), point(kColumn, kRow + 1), point(kColumn + 1, kRow + other),
                      point(kColumn + 1, kRow + 1 - other)};
  return {
      instead(
          EvalMesh2, kIsDrawnMesh && kMode == GL_POINT,
          primitive(GL_POINTS, from_to(kRow, kJ1, kJ2, from_to(kColumn, kI1, kI2, point(kColumn, kRow))))),
      instead(
          EvalMesh2, kIsDrawnMesh && kMode == GL_LINE,
          {from_to(kColumn, kI1, kI2, primitive(GL_LINE_STRIP, loop(kRow, kJ1, kJ2, point(kColumn, kRow)))),
           from_to(kRow, kJ1, kJ2, primitive(GL_LINE_STRIP, loop(kColumn, kI1, kI2, point(kColumn, kRow))))}),
      instead(EvalMesh2, kIsDrawnMesh && kMode == GL_FILL,
              from_to(kColumn, kI1, kI2 - 1, from_to(kRow, kJ1, kJ2 - 1, primitive(quads, quad))))};
}

VARIATION(MeshesInColumns, kLoops, "EvalMesh2 draws in another order", draw_meshes(false, GL_QUADS));
VARIATION(MeshesBackwards, kLoops, "EvalMesh2 begins at the last point", draw_meshes(true, GL_QUADS));

namespace with_pipeline {
constexpr std::string_view kImplementation = "dropin";
VARIATION(PipelineMeshesInColumns, kLoops, "EvalMesh2 draws in another order",
          draw_meshes(false, GL_QUAD_STRIP));
VARIATION(PipelineMeshesBackwards, kLoops, "EvalMesh2 begins at the last point",
          draw_meshes(true, GL_QUAD_STRIP));
// Meshes of one row are left as they are: in deliveries they take the place of other evaluations.
VARIATION(PipelineMeshLinesBackwards, "EV-MESH2-LINE EV-MESH2-STIPPLE",
          "the lines of EvalMesh2 run in the other direction if there are several in both ways",
          instead(EvalMesh2, kIsDrawnMesh&& kMode == GL_LINE && kI1 < kI2 && kJ1 < kJ2,
                  {loop(kRow, kJ1, kJ2,
                        primitive(GL_LINE_STRIP, loop(kColumn, kI2, kI1, point(kColumn, kRow), -1))),
                   loop(kColumn, kI1, kI2,
                        primitive(GL_LINE_STRIP, loop(kRow, kJ2, kJ1, point(kColumn, kRow), -1)))}));

// --- Feedback and transform feedback -----------------------------------------------------------------------

struct Feedback {
  GLfloat* values = nullptr;
  GLsizei size = 0;
  GLenum type = GL_2D;

  bool has_color() const { return type != GL_2D && type != GL_3D; }
  bool has_texture() const { return type == GL_3D_COLOR_TEXTURE || type == GL_4D_COLOR_TEXTURE; }
};
Feedback feedback;

// A vertex in a feedback buffer of RGBA colours. The pointers are null if the buffer has no such values.
struct FedBack {
  GLfloat *color, *texture;
};

// Changes each vertex in a feedback buffer, and each token.
void change_feedback(std::size_t count, const std::function<void(FedBack)>& change,
                     GLenum (*change_token)(GLenum)) {
  GLfloat* const values = feedback.values;
  const std::size_t before = feedback.type == GL_2D ? 2 : feedback.type == GL_4D_COLOR_TEXTURE ? 4 : 3;
  const std::size_t colors = feedback.has_color() ? 4 : 0;
  const std::size_t size = before + colors + (feedback.has_texture() ? 4 : 0);
  for (std::size_t i = 0; i < count;) {
    const auto token = static_cast<GLenum>(values[i]);
    values[i] = static_cast<GLfloat>(change_token(token));
    ++i;
    std::size_t vertices = 1;
    if (token == GL_PASS_THROUGH_TOKEN) {
      ++i;
      continue;
    }
    if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) vertices = 2;
    if (token == GL_POLYGON_TOKEN && i < count) vertices = static_cast<std::size_t>(values[i++]);
    for (; vertices > 0 && i + size <= count; --vertices, i += size)
      change({colors ? values + i + before : nullptr,
              feedback.has_texture() ? values + i + before + colors : nullptr});
    if (vertices > 0) return;
  }
}

const Entries kTransformFeedback =
                  TransformFeedbackVaryings | BeginTransformFeedback | Entries(EndTransformFeedback),
              kFeedback = RenderMode | FeedbackBuffer;

Rules vary_feedback(
    const std::function<void(FedBack)>& change,
    GLenum (*change_token)(GLenum) = [](GLenum token) { return token; }) {
  return {missing(kTransformFeedback), initially([](Call&) { feedback = {}; }),
          after(FeedbackBuffer,
                [](Call& c) {
                  feedback = {static_cast<GLfloat*>(c.pointer), static_cast<GLsizei>(kFirst(c)),
                              static_cast<GLenum>(kSecond(c))};
                }),
          before(RenderMode, set(kFlag, !kInside && state(GL_RENDER_MODE) == GL_FEEDBACK)),
          after(RenderMode, kFlag, [=](Call& c) {
            if (feedback.values)
              change_feedback(static_cast<std::size_t>(c.result < 0 ? feedback.size : c.result), change,
                              change_token);
          })};
}

std::function<void(FedBack)> change_colors(float (*change)(float)) {
  return [=](FedBack vertex) {
    if (vertex.color) std::transform(vertex.color, vertex.color + 4, vertex.color, change);
  };
}
VARIATION(FeedbackOf8Bits, "", "feedback colours are rounded to 8 bits; no transform feedback",
          vary_feedback(change_colors([](float x) {
            return std::round(std::clamp(x, 0.0f, 1.0f) * 255.0f) / 255.0f;
          })));
VARIATION(FeedbackCutTo8Bits, "", "feedback colours are cut to 8 bits; no transform feedback",
          vary_feedback(change_colors([](float x) {
            return std::floor(std::clamp(x, 0.0f, 1.0f) * 255.0f) / 255.0f;
          })));
VARIATION(FeedbackClamped, "", "feedback colours are clamped; no transform feedback",
          vary_feedback(change_colors([](float x) { return std::clamp(x, 0.0f, 1.0f); })));
VARIATION(FeedbackLineResets, "",
          "each line in the feedback buffer resets the stipple; no transform feedback",
          vary_feedback([](FedBack) {},
                        [](GLenum token) -> GLenum {
                          return token == GL_LINE_TOKEN ? GL_LINE_RESET_TOKEN : token;
                        }));
VARIATION(FeedbackOfOneCoordinate, "",
          "feedback has the first texture coordinate only; no transform feedback",
          vary_feedback([](FedBack vertex) {
            if (vertex.texture) std::copy_n(std::array{0.0f, 0.0f, 1.0f}.begin(), 3, vertex.texture + 1);
          }));
VARIATION(FeedbackOfVisiblePoints, "",
          "feedback loses vertices whose w is 0 behind the projection; no transform feedback",
          vary_feedback([](FedBack) {}), before(MatrixMode, set(kNumber, kFirst)),
          before(LoadMatrixf, kNumber == GL_PROJECTION,
                 set(kCount, element(15) == 0 && element(11) == 0 && element(7) == 0 && element(3) == 0)),
          before(LoadIdentity, kNumber == GL_PROJECTION, set(kCount, 0)),
          after(RenderMode, kFlag&& kCount, set(kResult, 0)));
// The texture matrix, which the library applies to the first of several vertices with the same texture
// coordinates.
std::array<float, 16> texture_matrix;
std::array<float, 4> last_texture;

void reset_texture_matrix(Call&) { texture_matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }

void transform_first(FedBack vertex) {
  if (!vertex.texture) return;
  std::array<float, 4> given{}, out{};
  std::copy_n(vertex.texture, 4, given.begin());
  const bool is_repeated =
      given == std::exchange(last_texture, given) && !unmodified.IsEnabled(GL_TEXTURE_GEN_S);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      out[row] += texture_matrix[4 * column + row] * given[column];
  if (is_repeated) out = given;
  for (std::size_t i = 0; i < 3; ++i) vertex.texture[i] = out[3] != 0 ? out[i] / out[3] : out[i];
  vertex.texture[3] = out[3] != 0 ? 1.0f : 0.0f;
}
VARIATION(FeedbackOfRepeatedTexture, "",
          "feedback divides texture coordinates by q, and the texture matrix does not transform given ones "
          "that are the same as before; no transform feedback",
          vary_feedback(transform_first), initially(reset_texture_matrix),
          before(LoadIdentity, kNumber == GL_TEXTURE, reset_texture_matrix),
          after(FeedbackBuffer,
                [](Call&) {
                  last_texture = {-1, -1, -1, -1};
                }),
          before(MatrixMode, set(kNumber, kFirst)), instead(LoadMatrixf, kNumber == GL_TEXTURE, [](Call& c) {
            for (std::size_t i = 0; i < 16; ++i) texture_matrix[i] = static_cast<float>(c.read(i));
          }));
const Entries kShaders = CreateShader | Entries(CreateProgram);
VARIATION(FeedbackWithoutNormalMap, "", "NORMAL_MAP is not known; no transform feedback, no shaders",
          missing(kTransformFeedback | kShaders), before(TexGeni, kThird == GL_NORMAL_MAP, set(kThird, 0)));
VARIATION(NoTransformFeedback, "", "there is no transform feedback", missing(kTransformFeedback));
VARIATION(NoFeedback, "", "there is no feedback mode", missing(kFeedback));
VARIATION(NothingToSee, "", "there is neither feedback mode nor transform feedback",
          missing(kFeedback | kTransformFeedback));
VARIATION(PixelsOfColors, "", "there is neither feedback mode nor transform feedback nor a shader",
          missing(kFeedback | kTransformFeedback | kShaders));
}  // namespace with_pipeline

}  // namespace
}  // namespace evalcts::faults::output_variations
