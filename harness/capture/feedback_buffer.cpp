// Feedback mode (GL 2.1 §5.3). Texture coordinates of unit 0 come back as they are; positions come back
// through identity OBJECT_LINEAR texture generation, normals through NORMAL_MAP, each in a pass of its own.
// If an implementation divides s, t and r by q, as Mesa up to 7 does, the texture matrix separates q from
// them; if it loses others, the matrix puts one after the other in the place of s. Without NORMAL_MAP (GL
// 1.3), normals come back as the colours of vertices that are lit along the axes. -0, subnormals and
// non-finite values are not preserved.
#include <algorithm>
#include <bit>
#include <optional>

#include <evalcts/gl/roles.h>
#include "control.h"

namespace evalcts {
namespace {

enum class TextureCoordinatesHold { kTexture, kPosition, kNormal };

// The three lights of a pass that shows normals: they shine along the axes, or against them if `sign` is -1.
// A vertex gets the colour max(0, sign * scale * normal).
struct Lights {
  float sign, scale;
};

// The passes that show all components of the texture coordinates.
enum class Passes { kOne, kLastApart, kOneByOne };

// The components that a pass shows: `count` of them from `first` on, in the places of s, t and r. The others
// are 0. A pass of all four needs no matrix.
struct Components {
  std::size_t first, count;
};
std::vector<Components> components_of(Passes passes) {
  if (passes == Passes::kOne) return {{0, 4}};
  if (passes == Passes::kLastApart) return {{0, 3}, {3, 1}};
  return {{0, 1}, {1, 1}, {2, 1}, {3, 1}};
}

// Returns a projection to x = y = z = 0, so that no vertex is clipped. If w is kept, vertices with w < 0 are
// still clipped. If w becomes 0, none is clipped, provided that the library accepts the degenerate point.
std::vector<GLfloat> collapsing_projection(bool keep_w) {
  std::vector<GLfloat> matrix(16, 0.0f);
  if (keep_w) matrix[15] = 1.0f;
  return matrix;
}

// Returns a texture matrix that shows these components.
std::vector<GLfloat> texture_matrix(Components components) {
  std::vector<GLfloat> matrix(16, 0.0f);
  for (std::size_t i = 0; i < components.count; ++i) matrix[4 * (components.first + i) + i] = 1.0f;
  return matrix;
}

// Properties of the implementation that the proof has found.
struct Ways {
  Passes passes = Passes::kOne;
  bool keep_w = true;
  bool unclamp = false;
  bool has_texture_objects = true;  // GL 1.1, which also has names of internal formats
  bool lit_normals = false;         // normals come back through lights, not through NORMAL_MAP
};

void add_lights(gl::Case& c, Lights lights) {
  const auto black = [] { return std::vector<GLfloat>{0, 0, 0, 1}; };
  c.LightModelfv(GL_LIGHT_MODEL_AMBIENT, black());
  c.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT, black());
  c.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, std::vector<GLfloat>(4, 1.0f));
  for (std::size_t i = 0; i < 3; ++i) {
    const GLenum light = GL_LIGHT0 + static_cast<GLenum>(i);
    std::vector<GLfloat> direction(4, 0.0f), color = black();
    direction[i] = lights.sign;
    color[i] = lights.scale;
    c.Lightfv(light, GL_POSITION, direction);
    c.Lightfv(light, GL_DIFFUSE, color);
    c.Lightfv(light, GL_SPECULAR, black());
    c.Enable(light);
  }
  c.Enable(GL_LIGHTING);
}

// True if the command may change the colours of lit vertices.
bool affects_lighting(const gl::Command& command) {
  const std::string stem = gl::stem_of(command.entry);
  if (stem == "Enable" || stem == "Disable") {
    const auto* const capability = std::get_if<std::int64_t>(&command.arguments.at(0));
    if (!capability) return true;
    return *capability == GL_LIGHTING || *capability == GL_COLOR_MATERIAL || *capability == GL_NORMALIZE ||
           *capability == GL_RESCALE_NORMAL || (*capability >= GL_LIGHT0 && *capability < GL_LIGHT0 + 8);
  }
  return stem == "Material" || stem == "ColorMaterial" || stem == "Light" || stem == "LightModel";
}

gl::Case setup(TextureCoordinatesHold hold, Components components, const Ways& ways,
               const std::optional<Lights>& lights) {
  gl::Case c;
  c.Viewport(0, 0, 64, 64);
  if (components.count < 4) {
    c.MatrixMode(GL_TEXTURE);
    c.LoadMatrixf(texture_matrix(components));
  }
  c.MatrixMode(GL_PROJECTION);
  c.LoadMatrixf(collapsing_projection(ways.keep_w));
  c.MatrixMode(GL_MODELVIEW);
  c.LoadIdentity();
  if (ways.unclamp) c.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
  // Some drivers skip texture coordinates and their generation unless a complete texture is enabled.
  if (ways.has_texture_objects) c.BindTexture(GL_TEXTURE_2D, 1);
  c.TexImage2D(GL_TEXTURE_2D, 0, ways.has_texture_objects ? GL_RGBA : 4, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               std::vector<GLubyte>(4, 255));
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  c.Enable(GL_TEXTURE_2D);
  if (hold == TextureCoordinatesHold::kTexture) return c;

  if (lights) {
    add_lights(c, *lights);
    return c;
  }
  const bool position = hold == TextureCoordinatesHold::kPosition;
  const GLenum coordinates[] = {GL_S, GL_T, GL_R, GL_Q};
  const GLenum switches[] = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q};
  for (std::size_t i = 0; i < (position ? 4u : 3u); ++i) {
    c.TexGeni(coordinates[i], GL_TEXTURE_GEN_MODE, position ? GL_OBJECT_LINEAR : GL_NORMAL_MAP);
    if (position) {
      std::vector<GLfloat> plane(4, 0.0f);
      plane[i] = 1.0f;
      c.TexGenfv(coordinates[i], GL_OBJECT_PLANE, plane);
    }
    c.Enable(switches[i]);
  }
  return c;
}

class FeedbackBuffer final : public Capture {
 public:
  std::string name() const override { return "FeedbackBuffer"; }

  void prove(Implementation& implementation, const ImplementationInfo& info) override {
    const auto reproduces = [&](const ControlOptions& options, Attribute attribute) {
      return confirm_attributes(*this, implementation, options, attribute) != 0;
    };
    ways_ = {.has_texture_objects = info.at_least(1, 1)};
    attributes_ = 0;
    constexpr Attributes kOfTextures = kTextureCoordinate0 | kPosition | kNormal;
    Passes best = Passes::kOne;
    for (const Passes passes : {Passes::kOne, Passes::kLastApart, Passes::kOneByOne}) {
      if ((attributes_ & kOfTextures) == kOfTextures) break;
      ways_.passes = passes;
      const Attributes shown = confirm_attributes(*this, implementation, {}, kAllAttributes);
      if (std::popcount(shown) <= std::popcount(attributes_)) continue;
      attributes_ = shown;
      best = passes;
    }
    ways_.passes = best;
    if (!(attributes_ & kNormal)) {
      ways_.lit_normals = true;
      if (reproduces({}, kNormal)) attributes_ |= kNormal;
    }
    if (!(attributes_ & kColor)) color_error_ = measure_color_error(*this, implementation);
    if (attributes_ == 0 && !color_error_)
      throw NotObservable("feedback mode does not give explicit vertices back unchanged");

    if (attributes_ & kNormal) attributes_ |= kUnitNormal;
    if (attributes_ & kPosition) {
      ways_.keep_w = false;
      if (!reproduces({.negative_w = true}, kPosition)) ways_.keep_w = true;
    }
    if ((attributes_ & kColor) && info.at_least(3, 0)) {
      ways_.unclamp = true;
      if (!reproduces({.unclamped_color = true}, kColor)) ways_.unclamp = false;
    }
  }

  Attributes attributes() const override { return attributes_; }
  Attributes inexact_attributes() const override { return color_error_ ? kColor : 0u; }
  bool loses_nonpositive_w() const override { return ways_.keep_w; }
  bool loses_vertices_beyond_float() const override { return true; }  // 0 * infinity is clipped

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const CaptureRequest& request) const override {
    const Attributes wanted = request.attributes;
    std::optional<Observation> observation;
    const auto pass = [&](TextureCoordinatesHold hold, Attributes gives) {
      Observation seen = hold == TextureCoordinatesHold::kNormal && ways_.lit_normals
                             ? run_lit_passes(implementation, script, request)
                             : run_passes(implementation, script, hold, request);
      seen.attributes = gives;
      if (!observation) {
        observation = std::move(seen);
      } else {
        merge(*observation, seen, [gives](ObservedVertex& vertex, const ObservedVertex& more) {
          if (gives & kPosition) vertex.position = more.position;
          if (gives & kNormal) vertex.normal = more.normal;
        });
        observation->attributes |= gives;
      }
    };
    if ((wanted & (kTextureCoordinate0 | kColor)) || (wanted & kAllAttributes) == 0)
      pass(TextureCoordinatesHold::kTexture, ways_.passes == Passes::kOne
                                                 ? kTextureCoordinate0 | kColor
                                                 : kColor | (wanted & kTextureCoordinate0));
    if (wanted & kPosition) pass(TextureCoordinatesHold::kPosition, kPosition);
    if (wanted & (kNormal | kUnitNormal)) pass(TextureCoordinatesHold::kNormal, kNormal | kUnitNormal);
    if (!observation) throw NotObservable("feedback mode shows nothing of units 1 and up");
    // The control of a proof requests attributes that are not proved yet. Other unproved attributes
    // may be wrong.
    observation->attributes &= attributes_ | inexact_attributes() | wanted;
    observation->clamped_colors = !ways_.unclamp;
    observation->color_error = color_error_.value_or(0);
    return *std::move(observation);
  }

 private:
  // Runs the passes that show the components that are needed.
  Observation run_passes(Implementation& implementation, const gl::Case& script, TextureCoordinatesHold hold,
                         const CaptureRequest& request) const {
    const bool shows_none =
        hold == TextureCoordinatesHold::kTexture && !(request.attributes & kTextureCoordinate0);
    const std::size_t needed = shows_none ? 1 : hold == TextureCoordinatesHold::kNormal ? 3 : 4;
    std::optional<Observation> observation;
    for (const Components components : components_of(ways_.passes)) {
      if (components.first >= needed) break;
      Observation seen = run_pass(implementation, script, hold, components, request.most_vertices);
      if (!observation) {
        observation = std::move(seen);
        continue;
      }
      merge(*observation, seen, [&](ObservedVertex& vertex, const ObservedVertex& more) {
        for (std::size_t i = 0; i < components.count; ++i) {
          const std::size_t place = components.first + i;
          vertex.position[place] = more.position[i];
          vertex.texture_coordinate[0][place] = more.texture_coordinate[0][i];
          if (place < 3) vertex.normal[place] = more.normal[i];
        }
      });
    }
    return *std::move(observation);
  }

  // Runs the passes that show normals as colours: one for positive and one for negative components, and two
  // with lights of 2^-32 if a component may exceed 1, because colours are clamped.
  Observation run_lit_passes(Implementation& implementation, const gl::Case& script,
                             const CaptureRequest& request) const {
    if (std::ranges::any_of(script.commands(), affects_lighting))
      throw NotObservable("feedback mode shows normals by lighting, which the case changes");
    for (const float scale : {1.0f, 0x1p-32f}) {
      bool is_clamped = false;
      const auto pass = [&](float sign) {
        Observation seen = run_pass(implementation, script, TextureCoordinatesHold::kNormal, {0, 4},
                                    request.most_vertices, Lights{sign, scale});
        for (ObservedPrimitive& primitive : seen.primitives)
          for (ObservedVertex& vertex : primitive.vertices)
            for (std::size_t i = 0; i < 3; ++i) {
              is_clamped = is_clamped || vertex.color[i] >= 1;
              vertex.normal[i] = sign * vertex.color[i] / scale;
            }
        return seen;
      };
      Observation observation = pass(1);
      merge(observation, pass(-1), [](ObservedVertex& vertex, const ObservedVertex& more) {
        for (std::size_t i = 0; i < 3; ++i) vertex.normal[i] += more.normal[i];
      });
      if (!is_clamped) return observation;
    }
    throw NotObservable("feedback mode shows normals by lighting, and they are too large");
  }

  Observation run_pass(Implementation& implementation, const gl::Case& script, TextureCoordinatesHold hold,
                       Components components, std::size_t most_vertices,
                       const std::optional<Lights>& lights = {}) const {
    // Each vertex takes x y z w, R G B A, s t r q and a token; a polygon adds its number of vertices.
    const std::size_t room = (most_vertices + 1) * 13;
    gl::Case prologue = setup(hold, components, ways_, lights);
    const gl::Ref buffer = prologue.FeedbackBuffer(room, GL_4D_COLOR_TEXTURE, gl::out<GLfloat>(room));
    prologue.RenderMode(GL_FEEDBACK);
    WrappedCase wrapped = begin_wrapping(std::move(prologue), script);
    const gl::Ref count = wrapped.commands.RenderMode(GL_RENDER);

    const std::unique_ptr<Context> context = implementation.create_context();
    const gl::Trace trace = context->play(wrapped.commands);
    if (trace.error(wrapped.error_before) != GL_NO_ERROR)
      throw NotObservable("feedback mode cannot be set up");

    Observation observation;
    observation.error = trace.error(wrapped.error_after);
    const std::vector<GLfloat> values = trace.values<GLfloat>(buffer);
    const auto returned = static_cast<GLint>(trace.result(count));
    decode(values, returned < 0 ? room : std::min<std::size_t>(room, static_cast<std::size_t>(returned)),
           hold, observation);
    observation.overflow = returned < 0 || observation.vertex_count() > most_vertices;
    return observation;
  }

  // Decodes the complete primitives; a buffer that was too small may end inside one.
  static void decode(const std::vector<GLfloat>& values, std::size_t count, TextureCoordinatesHold hold,
                     Observation& observation) {
    for (std::size_t i = 0; i < count;) {
      const auto token = static_cast<GLenum>(values[i++]);
      std::size_t vertices = 1;
      GLenum mode = GL_POINTS;
      if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) {
        mode = GL_LINES;  // other tests judge the stipple
        vertices = 2;
      } else if (token == GL_POLYGON_TOKEN && i < count) {
        mode = GL_POLYGON;
        vertices = static_cast<std::size_t>(values[i++]);
      } else if (token != GL_POINT_TOKEN) {
        throw NotObservable("something other than points, lines and polygons came back in feedback mode");
      }
      if (vertices > (count - i) / 12) return;
      std::vector<ObservedPrimitive>& primitives = observation.primitives;
      if (mode != GL_POINTS || primitives.empty() || primitives.back().mode != GL_POINTS)
        primitives.push_back({mode, {}});
      ObservedPrimitive& primitive = primitives.back();
      for (; vertices > 0; --vertices, i += 12) primitive.vertices.push_back(vertex(&values[i], hold));
    }
  }

  static ObservedVertex vertex(const GLfloat* data, TextureCoordinatesHold hold) {
    ObservedVertex vertex;
    std::copy_n(data + 4, 4, vertex.color.begin());
    const GLfloat* const texture = data + 8;
    switch (hold) {
      case TextureCoordinatesHold::kTexture:
        std::copy_n(texture, 4, vertex.texture_coordinate[0].begin());
        break;
      case TextureCoordinatesHold::kPosition:
        std::copy_n(texture, 4, vertex.position.begin());
        break;
      case TextureCoordinatesHold::kNormal:
        std::copy_n(texture, 3, vertex.normal.begin());
        break;
    }
    return vertex;
  }

  // Adds the vertices of another pass to an observation. All passes replay the same case, so their primitives
  // must agree.
  template <class Add>
  static void merge(Observation& whole, const Observation& pass, Add add) {
    const char* const kDiffer = "two feedback passes over the same commands gave different primitives";
    if (whole.primitives.size() != pass.primitives.size()) throw NotObservable(kDiffer);
    for (std::size_t p = 0; p < whole.primitives.size(); ++p) {
      auto& vertices = whole.primitives[p].vertices;
      const auto& more = pass.primitives[p].vertices;
      if (vertices.size() != more.size()) throw NotObservable(kDiffer);
      for (std::size_t i = 0; i < vertices.size(); ++i) add(vertices[i], more[i]);
    }
    if (whole.error == GL_NO_ERROR) whole.error = pass.error;
    whole.overflow = whole.overflow || pass.overflow;
  }

  Ways ways_;
  Attributes attributes_ = 0;
  std::optional<double> color_error_;  // set if colours are inexact
};

}  // namespace

std::unique_ptr<Capture> make_feedback_buffer() { return std::make_unique<FeedbackBuffer>(); }

}  // namespace evalcts
