// The subject that measures a GL: it calls glMap, glEnable, glBegin(GL_POINTS), glEvalCoord and glEnd as
// users do, and takes the results from a capture.
#include <fmt/format.h>

#include <evalcts/accuracy/subject.h>
#include <evalcts/backends/gl_environment.h>
#include <evalcts/backends/mesa_build.h>
#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

const float* values_of(const ObservedVertex& vertex, Attributes attribute) {
  if (attribute == kPosition) return vertex.position.data();
  if (attribute == kColor) return vertex.color.data();
  if (attribute == kNormal) return vertex.normal.data();
  return vertex.texture_coordinate[0].data();
}

gl::Case commands_of(GLenum target, const Map& map, std::span<const float> u, std::span<const float> v) {
  gl::Case c;
  const std::vector<float> points(map.points.begin(), map.points.end());
  const bool two_dimensional = !v.empty();
  const auto end = [&](std::size_t i) { return static_cast<GLfloat>(map.domain[i]); };
  if (two_dimensional) {
    c.Map2f(target, end(0), end(1), map.vorder * map.components, map.uorder, end(2), end(3), map.components,
            map.vorder, points);
    if (map.segments > 0) c.MapGrid2f(map.segments, end(0), end(1), map.segments, end(2), end(3));
  } else {
    c.Map1f(target, end(0), end(1), map.components, map.uorder, points);
    if (map.segments > 0) c.MapGrid1f(map.segments, end(0), end(1));
  }
  const auto index = [&](float x, std::size_t i) {
    return grid_index(x, map.domain[i], map.domain[i + 1], map.segments);
  };
  c.Enable(target);
  // Nothing is drawn without an enabled vertex map. The initial map, of order 1, is sufficient.
  if (attribute_of(target) != kPosition) c.Enable(two_dimensional ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (map.segments > 0) {
      if (two_dimensional)
        c.EvalPoint2(index(u[i], 0), index(v[i], 2));
      else
        c.EvalPoint1(index(u[i], 0));
    } else if (two_dimensional) {
      c.EvalCoord2f(u[i], v[i]);
    } else {
      c.EvalCoord1f(u[i]);
    }
  }
  c.End();
  return c;
}

class Captured final : public Subject {
 public:
  explicit Captured(const ImplementationOptions& options)
      : implementation_(open_implementation(options)),
        info_(inquire(*implementation_)),
        captures_(*implementation_, info_) {
    if (!options.mesa_build.empty()) require_mesa_build(options.mesa_build, loaded_gl_files());
  }

  ImplementationInfo info() const override { return info_; }
  std::string capture() const override { return used_; }

  std::vector<float> evaluate(GLenum target, const Map& map, std::span<const float> u,
                              std::span<const float> v) override {
    const Attributes attribute = attribute_of(target);
    const Capture& capture = captures_.showing_all(attribute, kPoints);
    const Observation seen =
        capture.observe(*implementation_, commands_of(target, map, u, v), {attribute, u.size()});
    if (seen.error != GL_NO_ERROR)
      throw NotObservable(fmt::format("the commands raised {}", gl::error_name(seen.error)));
    if (seen.overflow || seen.vertex_count() != u.size())
      throw NotObservable(fmt::format("expected {} vertices, captured {}", u.size(), seen.vertex_count()));
    if (attribute == kColor && seen.clamped_colors)
      throw NotObservable("colours are clamped to [0,1] on the way");
    std::vector<float> results;
    for (const ObservedPrimitive& primitive : seen.primitives)
      for (const ObservedVertex& vertex : primitive.vertices) {
        const float* const values = values_of(vertex, attribute);
        results.insert(results.end(), values, values + map.components);
      }
    used_ = capture.name();
    return results;
  }

 private:
  std::unique_ptr<Implementation> implementation_;
  ImplementationInfo info_;
  Captures captures_;
  std::string used_;
};

}  // namespace

std::unique_ptr<Subject> make_captured(const ImplementationOptions& options) {
  return std::make_unique<Captured>(options);
}

}  // namespace evalcts::accuracy
