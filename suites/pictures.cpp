// Reads the feedback buffer or pixels after a drawing, compares pictures, and plots their differences.
#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <evalcts/capture/capture.h>

namespace evalcts {
namespace {

constexpr std::size_t kRoom = 2048;

// Two NaN do not differ: a value that the pipeline makes NaN of explicit vertices as well decides nothing.
bool differs(double a, double b, double tolerance) {
  if (std::isnan(a) && std::isnan(b)) return false;
  return !(std::abs(a - b) <= tolerance * std::max(1.0, std::abs(b)));
}

// Returns the first index at which two lists differ, or the length of the shorter one if they do not.
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

// Returns "rrggbb" for each pixel of values between 0 and 1. A single channel is grey.
std::string rgb_of(const Part& part) {
  const auto pixel_count = static_cast<std::size_t>(part.area->width * part.area->height);
  const std::size_t channels = part.values.size() / pixel_count;
  std::string out;
  for (std::size_t pixel = 0; pixel < pixel_count; ++pixel)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double value = part.values[pixel * channels + (channels == 1 ? 0 : channel)];
      out += fmt::format("{:02x}", std::isnan(value) ? 0 : std::lround(255 * std::clamp(value, 0.0, 1.0)));
    }
  return out;
}

std::vector<PlottedPrimitive> plotted(const Part& feedback) {
  std::vector<PlottedPrimitive> out;
  std::size_t room = Plot::kMostVertices;
  for (const FeedbackPrimitive& primitive : primitives_of(feedback)) {
    if (primitive.vertices.size() > room) break;
    room -= primitive.vertices.size();
    PlottedPrimitive& one = out.emplace_back();
    one.mode = primitive.token == GL_POINT_TOKEN     ? "GL_POINTS"
               : primitive.token == GL_POLYGON_TOKEN ? "GL_POLYGON"
                                                     : "GL_LINES";
    for (const auto& vertex : primitive.vertices)
      one.positions.push_back({static_cast<float>(vertex[0]), static_cast<float>(vertex[1]), 0});
  }
  return out;
}

// Returns true if both have the same picture, so that only values such as colours differ.
bool look_alike(const std::vector<PlottedPrimitive>& a, const std::vector<PlottedPrimitive>& b) {
  return std::ranges::equal(a, b, [](const PlottedPrimitive& one, const PlottedPrimitive& other) {
    return one.mode == other.mode &&
           std::ranges::equal(one.positions, other.positions, [](const auto& p, const auto& q) {
             return std::hypot(p[0] - q[0], p[1] - q[1]) <= kTolerance;
           });
  });
}

// Returns no plot if one of the parts is not from a feedback buffer, or if both look alike.
std::optional<Plot> feedback_plot(const Part& seen, const Part& expected) {
  try {
    Plot plot;
    plot.expected = plotted(expected);
    plot.captured = plotted(seen);
    plot.is_cut = plot.expected->size() < primitives_of(expected).size() ||
                  plot.captured.size() < primitives_of(seen).size();
    if (look_alike(*plot.expected, plot.captured)) return std::nullopt;
    return plot;
  } catch (const NotObservable&) {
    return std::nullopt;
  }
}

Plot pixel_plot(const std::vector<Part>& seen, const std::vector<Part>& expected, std::size_t scene) {
  Plot plot;
  int room = Plot::kMostPixels;
  for (std::size_t i = 0; i < seen.size() && i < expected.size(); ++i) {
    if (!seen[i].area || seen[i].scene != scene) continue;
    const auto [x, y, width, height] = *seen[i].area;
    room -= width * height;
    plot.is_cut = room < 0;
    if (plot.is_cut) break;
    plot.pixels.push_back({x, y, width, height, rgb_of(expected[i]), rgb_of(seen[i])});
  }
  return plot;
}

}  // namespace

void show_pixels(Picture& picture, const std::vector<Part>& control, std::size_t scene) {
  picture.checked.set_plot([&picture, &control, scene] { return pixel_plot(picture.parts, control, scene); });
}

Picture feedback(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes) {
  gl::Case c(identity);
  struct Refs {
    gl::Ref buffer, count;
  };
  std::vector<Refs> refs;
  for (const Scene& scene : scenes) {
    const gl::Ref buffer = c.FeedbackBuffer(kRoom, GL_4D_COLOR_TEXTURE, gl::out<GLfloat>(kRoom));
    c.RenderMode(GL_FEEDBACK);
    c.append(scene.commands);
    refs.push_back({buffer, c.RenderMode(GL_RENDER)});
  }
  Picture picture = {t.play(c), {}};
  const gl::Trace& trace = picture.checked.trace();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto returned = static_cast<GLint>(trace.result(refs[i].count));
    if (returned < 0) throw NotObservable("pipeline: the feedback buffer overflows");
    const std::vector<GLfloat> all = trace.values<GLfloat>(refs[i].buffer);
    const auto end = all.begin() + std::min<std::ptrdiff_t>(kRoom, returned);
    picture.parts.push_back({scenes[i].name, refs[i].buffer, {all.begin(), end}, i});
  }
  return picture;
}

Picture feedback(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing) {
  return feedback(t, identity, {Scene("in feedback mode", state, drawing)});
}

std::vector<FeedbackPrimitive> primitives_of(const Part& feedback) {
  const std::vector<double>& values = feedback.values;
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
    FeedbackPrimitive primitive = {token, {}};
    for (; count > 0; --count, i += 12)
      std::copy_n(&values[i], 12, primitive.vertices.emplace_back().begin());
    primitives.push_back(std::move(primitive));
  }
  return primitives;
}

void forget_stipple_starts(Picture& feedback) {
  for (Part& part : feedback.parts)
    std::ranges::replace(part.values, double{GL_LINE_RESET_TOKEN}, double{GL_LINE_TOKEN});
}

Picture pixels(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes,
               const std::vector<Area>& areas, GLenum format) {
  gl::Case c(identity);
  c.Viewport(0, 0, kSide, kSide);
  c.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    c.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    c.append(scene.commands);
    for (const Area& area : areas) {
      const std::size_t count = channels_of(format) * static_cast<std::size_t>(area.width * area.height);
      const gl::Ref read =
          c.ReadPixels(area.x, area.y, area.width, area.height, format, GL_FLOAT, gl::out<GLfloat>(count));
      parts.push_back(
          {scene.name.empty() ? name_of(area) : scene.name + ": " + name_of(area), read, {}, i, area});
    }
  }
  Picture picture = {t.play(c), std::move(parts)};
  for (Part& part : picture.parts) {
    const std::vector<GLfloat> values = picture.checked.trace().values<GLfloat>(part.shown);
    part.values.assign(values.begin(), values.end());
  }
  return picture;
}

Picture pixels(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing,
               const std::vector<Area>& areas, GLenum format) {
  return pixels(t, identity, {Scene("", state, drawing)}, areas, format);
}

bool alike(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  return a.size() == b.size() && first_difference(a, b, tolerance) == a.size();
}

void require_an_effect(const std::vector<double>& with, const std::vector<double>& without) {
  if (with.empty()) throw NotObservable("pipeline: nothing comes out of explicit vertices");
  if (alike(with, without, kEffect))
    throw NotObservable("pipeline: the stage does not show with explicit vertices");
}

void require_an_effect(const Picture& with, const Picture& without) {
  const bool alike_in_all = std::ranges::equal(with.parts, without.parts, [](const Part& a, const Part& b) {
    return alike(a.values, b.values, kEffect);
  });
  if (std::ranges::all_of(with.parts, [](const Part& part) { return part.values.empty(); }))
    throw NotObservable("pipeline: nothing comes out of explicit vertices");
  if (alike_in_all) throw NotObservable("pipeline: the stage does not show with explicit vertices");
}

void expect_like_explicit(CheckedTrace& checked, const Part& seen, const Part& control) {
  const std::size_t where = first_difference(seen.values, control.values, kTolerance);
  const auto text = [&](const std::vector<double>& values) {
    if (where >= values.size()) return fmt::format("{} values", values.size());
    return fmt::format("{:.7g} at {} of {} values", values[where], where, values.size());
  };
  const std::string expected = text(control.values), captured = text(seen.values);
  if (!seen.area) checked.set_plot([&] { return feedback_plot(seen, control); });
  checked.expect(alike(seen.values, control.values), seen.shown,
                 fmt::format("evaluated vertices leave the pipeline as {}, explicit ones as {} ({})",
                             captured, expected, seen.name),
                 expected, captured);
  if (!seen.area) checked.set_plot({});
}

void expect_like_explicit(Picture picture, const Picture& control) {
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    if (picture.parts[i].area) show_pixels(picture, control.parts, picture.parts[i].scene);
    expect_like_explicit(picture.checked, picture.parts[i], control.parts.at(i));
  }
}

const Part& drawn_once(const std::string& name, const std::function<Part()>& draw) {
  static std::map<std::string, Part> drawn;
  auto found = drawn.find(name);
  if (found == drawn.end()) found = drawn.emplace(name, draw()).first;
  return found->second;
}

void set_up_texture(gl::Case& c) {
  constexpr GLint kComponents = 4;  // GL 1.0 has neither names of internal formats nor texture objects
  c.TexImage2D(GL_TEXTURE_2D, 0, kComponents, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               std::vector<GLubyte>(4, 255));
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  c.Enable(GL_TEXTURE_2D);
}

}  // namespace evalcts
