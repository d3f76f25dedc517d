#include "suites/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/capture/capture.h"

namespace evalcts {
namespace {

constexpr std::size_t kRoom = 4096;

bool differs(double a, double b, double tolerance) {
  return !(std::abs(a - b) <= tolerance * std::max(1.0, std::abs(b)));
}

// Where two lists differ; their common length where neither does.
std::size_t first_difference(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  const std::size_t size = std::min(a.size(), b.size());
  std::size_t i = 0;
  while (i < size && !differs(a[i], b[i], tolerance)) ++i;
  return i;
}

std::size_t channels_of(GLenum format) { return format == GL_RGBA ? 4 : 1; }

std::string name_of(const Area& area) {
  if (area.width == 1 && area.height == 1) return fmt::format("pixel ({}, {})", area.x, area.y);
  return fmt::format("the {} by {} pixels at ({}, {})", area.width, area.height, area.x, area.y);
}

}  // namespace

Picture feedback(Test& t, const std::string& identity, const gl::Case& state, const gl::Case& drawing) {
  gl::Case c(identity);
  c.append(state);
  const gl::Ref buffer = c.FeedbackBuffer(kRoom, GL_4D_COLOR_TEXTURE, gl::out<GLfloat>(kRoom));
  c.RenderMode(GL_FEEDBACK);
  c.append(drawing);
  const gl::Ref count = c.RenderMode(GL_RENDER);
  Played played = t.play(c);
  const auto returned = static_cast<GLint>(played.trace().result(count));
  if (returned < 0) throw NotObservable("pipeline: the feedback buffer overflows");
  const std::vector<GLfloat> all = played.trace().values<GLfloat>(buffer);
  const auto end = all.begin() + std::min<std::ptrdiff_t>(kRoom, returned);
  return {std::move(played), {{"the feedback buffer", buffer, {all.begin(), end}}}};
}

std::vector<FeedbackPrimitive> primitives_of(const Picture& feedback) {
  const std::vector<double>& values = feedback.values();
  std::vector<FeedbackPrimitive> primitives;
  for (std::size_t i = 0; i < values.size();) {
    const auto token = static_cast<GLenum>(values[i++]);
    std::size_t count = 1;
    if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) {
      count = 2;
    } else if (token == GL_POLYGON_TOKEN && i < values.size()) {
      count = static_cast<std::size_t>(values[i++]);
    } else if (token != GL_POINT_TOKEN) {
      throw NotObservable("something other than points, lines and polygons came back in feedback mode");
    }
    if (count > (values.size() - i) / 12) throw NotObservable("the feedback buffer ends within a primitive");
    FeedbackPrimitive& primitive = primitives.emplace_back(token);
    for (; count > 0; --count, i += 12)
      std::copy_n(&values[i], 12, primitive.vertices.emplace_back().begin());
  }
  return primitives;
}

Picture pixels(Test& t, const std::string& identity, const gl::Case& state, const gl::Case& drawing,
               const std::vector<Area>& areas, GLenum format) {
  gl::Case c(identity);
  c.Viewport(0, 0, kSide, kSide);
  c.append(state);
  c.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  c.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  c.append(drawing);
  std::vector<Part> parts;
  for (const Area& area : areas) {
    const std::size_t count = channels_of(format) * static_cast<std::size_t>(area.width * area.height);
    parts.push_back(
        {name_of(area),
         c.ReadPixels(area.x, area.y, area.width, area.height, format, GL_FLOAT, gl::out<GLfloat>(count)),
         {}});
  }
  Played played = t.play(c);
  for (Part& part : parts) {
    const std::vector<GLfloat> values = played.trace().values<GLfloat>(part.shown);
    part.values.assign(values.begin(), values.end());
  }
  return {std::move(played), std::move(parts)};
}

bool alike(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  return a.size() == b.size() && first_difference(a, b, tolerance) == a.size();
}

bool alike(const Picture& a, const Picture& b, double tolerance) {
  return std::ranges::equal(a.parts, b.parts, [&](const Part& one, const Part& other) {
    return alike(one.values, other.values, tolerance);
  });
}

void require_an_effect(const std::vector<double>& with, const std::vector<double>& without) {
  if (with.empty()) throw NotObservable("pipeline: nothing comes out of explicit vertices");
  if (alike(with, without, kEffect))
    throw NotObservable("pipeline: the stage does not show with explicit vertices");
}

void require_an_effect(const Picture& with, const Picture& without) {
  if (std::ranges::all_of(with.parts, [](const Part& part) { return part.values.empty(); }))
    throw NotObservable("pipeline: nothing comes out of explicit vertices");
  if (alike(with, without, kEffect))
    throw NotObservable("pipeline: the stage does not show with explicit vertices");
}

void expect_like_explicit(Picture picture, const Picture& control) {
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    const std::vector<double>& seen = picture.parts[i].values;
    const std::vector<double>& expected = control.parts.at(i).values;
    const std::size_t where = first_difference(seen, expected, kTolerance);
    const auto text = [&](const std::vector<double>& values) {
      if (where >= values.size()) return fmt::format("{} values", values.size());
      return fmt::format("{:.7g} at {} of {} values", values[where], where, values.size());
    };
    picture.played.expect(
        alike(seen, expected), picture.parts[i].shown,
        fmt::format("evaluated vertices come out of the pipeline as {}, explicit ones as {} ({})", text(seen),
                    text(expected), picture.parts[i].name),
        text(expected), text(seen));
  }
}

void set_up_texture(gl::Case& c) {
  c.BindTexture(GL_TEXTURE_2D, 1);
  c.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, std::vector<GLubyte>(4, 255));
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  c.Enable(GL_TEXTURE_2D);
}

}  // namespace evalcts
