// Implements the helpers that several suites share.
#include "fixtures.h"

namespace evalcts {

std::vector<double> unit_steps(int count) {
  std::vector<double> us;
  for (int i = 0; i <= count; ++i) us.push_back(static_cast<double>(i) / count);
  return us;
}

std::vector<gl::Delivery> in_lists() { return gl::without(gl::kRepetition, gl::list_deliveries()); }

std::vector<gl::Delivery> without_lists() {
  return gl::sparing(gl::without(gl::kLists, gl::curve_deliveries()));
}

void set_current_values(gl::Case& c, const CurrentValues& values) {
  const auto& [color, normal] = values;
  c.Color4f(color[0], color[1], color[2], color[3]);
  c.Normal3f(normal[0], normal[1], normal[2]);
  c.TexCoord4f(5, 6, 7, 8);
}

gl::Case with_current_values(std::string identity, const CurrentValues& values) {
  gl::Case c(std::move(identity));
  set_current_values(c, values);
  return c;
}

void evaluate_some(gl::Case& c) {
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.375f, 0.8125f, 1.0f}) c.EvalCoord1f(u);
  c.End();
}

void enable_light(gl::Case& c, const std::vector<float>& position) {
  c.Enable(GL_LIGHTING);
  c.Enable(GL_LIGHT0);
  c.Lightfv(GL_LIGHT0, GL_POSITION, position);
}

void require_texture_units(const Test& t) {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
}

GLenum last_unit(const Test& t) { return GL_TEXTURE0 + static_cast<GLenum>(t.texture_units()) - 1; }

void require_extension(const Test& t, const std::string& extension) {
  if (!t.gl().extensions.contains(extension)) throw NotSupported("needs " + extension);
}

std::vector<ObservedVertex> vertices_of(const Observation& seen) {
  std::vector<ObservedVertex> all;
  for (const ObservedPrimitive& primitive : seen.primitives)
    all.insert(all.end(), primitive.vertices.begin(), primitive.vertices.end());
  return all;
}

std::vector<ObservedVertex> vertices_of(const Observation& seen, std::size_t count) {
  std::vector<ObservedVertex> all = vertices_of(seen);
  if (all.size() != count) throw NotObservable("vertices are missing or surplus, which other tests report");
  return all;
}

bool same_vertex(const ObservedVertex& a, const ObservedVertex& b, Attributes attributes) {
  const auto same = [&](Attribute attribute, const auto& one, const auto& other) {
    return !(attributes & attribute) || one == other;
  };
  return same(kPosition, a.position, b.position) && same(kColor, a.color, b.color) &&
         same(kNormal, a.normal, b.normal) &&
         same(kTextureCoordinate0, a.texture_coordinate[0], b.texture_coordinate[0]);
}

Failure failure_of(const gl::Case& c, std::string what, std::string message, std::string expected,
                   std::string captured) {
  Failure failure;
  failure.case_identity = c.identity();
  failure.message = std::move(message);
  failure.what = std::move(what);
  failure.difference.kind = kind_of(failure.what);
  failure.expected = std::move(expected);
  failure.captured = std::move(captured);
  return failure;
}

}  // namespace evalcts
