// Section 17 of the requirements: state that is unrelated to evaluation must not change its results.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "numeric.h"

namespace evalcts::suite_numeric {

namespace {

// Repeats a drawing after changes of state: the caller appends a change to script() and calls after().
// check() expects all repetitions to have the same vertices as the first drawing.
class Repetition {
 public:
  Repetition(const std::string& identity, const std::function<void(gl::Case&)>& draw)
      : script_(identity), draw_(draw) {
    draw_(script_);
  }

  gl::Case& script() { return script_; }

  void after(const std::string& what) {
    whats_.push_back(what);
    draw_(script_);
  }

  void check(Test& t, Attributes required, std::size_t vertices_each) {
    const Attributes attributes = t.shown_exactly(required);
    const std::size_t count = (1 + whats_.size()) * vertices_each;
    const std::vector<ObservedVertex> seen = vertices_of(t.observe(script_, attributes, count + 8), count);
    const std::span all(seen);
    for (std::size_t i = 0; i < whats_.size(); ++i)
      expect_same(t, script_, all.first(vertices_each), all.subspan((i + 1) * vertices_each, vertices_each),
                  attributes, "before it was",
                  [&](std::size_t vertex) { return fmt::format("vertex {} after {}", vertex, whats_[i]); });
  }

 private:
  gl::Case script_;
  std::function<void(gl::Case&)> draw_;
  std::vector<std::string> whats_;
};

constexpr std::size_t kDrawn1 = 12 + 4 + 7, kDrawn2 = 12 + 4 + 12;

// Draws points by EvalCoord, EvalPoint and EvalMesh.
void draw_some(gl::Case& c, bool two) {
  c.Begin(GL_POINTS);
  for (int i = 0; i < 12; ++i) eval_coord(c, two, i * 0.11 - 0.1, 0.93 - i * 0.07);
  for (int i = 0; i < 4; ++i) eval_point(c, two, i, 2 - i);
  c.End();
  eval_mesh(c, two, GL_POINT, 0, two ? 3 : 6, 0, 2);
}

struct Unrelated {
  const char* name;
  void (*change)(Test& t, Repetition& r, bool two);
};

void change_current_values(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  c.Color4f(0.9f, 0.8f, 0.7f, 0.6f);
  r.after("Color");
  c.Normal3f(1, -2, 3);
  r.after("Normal");
  c.TexCoord4f(5, 6, 7, 8);
  r.after("TexCoord");
  c.Indexf(3);
  c.EdgeFlag(GL_FALSE);
  r.after("Index and EdgeFlag");
}

void change_matrices(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  const std::vector<GLfloat> skew = {2, 1, 0, 0, 0, 3, 1, 0, 1, 0, 4, 0, 5, 6, 7, 1};
  const std::vector<GLfloat> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  c.MatrixMode(GL_MODELVIEW);
  c.PushMatrix();
  r.after("PushMatrix");
  c.LoadMatrixf(skew);
  c.PushMatrix();
  c.LoadMatrixf(identity);
  r.after("another matrix below the top");
  c.PopMatrix();
  c.PopMatrix();
  r.after("PopMatrix");
  c.MatrixMode(GL_PROJECTION);
  r.after("MatrixMode");
  c.MatrixMode(GL_MODELVIEW);
}

void change_fragment_state(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  c.Scissor(3, 4, 5, 6);
  c.Enable(GL_SCISSOR_TEST);
  r.after("Scissor");
  c.ColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
  r.after("ColorMask");
  c.DepthMask(GL_FALSE);
  c.StencilMask(5);
  r.after("DepthMask and StencilMask");
  c.Enable(GL_DEPTH_TEST);
  c.Enable(GL_BLEND);
  c.Disable(GL_DITHER);
  c.Enable(GL_STENCIL_TEST);
  r.after("tests of fragments, blending and dithering");
  c.ClearColor(0.5f, 0.25f, 0.125f, 1);
  r.after("ClearColor");
}

void change_maps_not_used(Test& t, Repetition& r, bool two) {
  gl::Case& c = r.script();
  const std::vector<GLenum> used(kinds_of(two)[1].targets.begin(), kinds_of(two)[1].targets.end());
  for (const bool other : {false, true})
    for (const GLenum target : targets(other)) {
      if (std::ranges::count(used, target)) continue;
      define(c, random_map(t, target, other ? Orders{5, 6} : Orders{7}));
      // Maps of the other dimension may be enabled.
      if (other != two) c.Enable(target);
    }
  r.after("definitions of other maps");
  map_grid(c, !two, {17, 3, 5}, {3, -1, 1});
  r.after("the grid of the other dimension");
}

void change_client_state(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  c.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  c.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  r.after("PixelStore");
}

void change_rasterization(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  c.PointSize(5);
  r.after("PointSize");
  c.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  c.Enable(GL_CULL_FACE);
  r.after("PolygonMode and CULL_FACE");
  c.Fogf(GL_FOG_DENSITY, 0.5f);
  r.after("FOG_DENSITY");
  c.Lightfv(GL_LIGHT0, GL_DIFFUSE, std::vector<GLfloat>{0.3f, 0.2f, 0.1f, 1});
  r.after("Light, not enabled");
}

void change_texture_units(Test& t, Repetition& r, bool) {
  require_texture_units(t);
  gl::Case& c = r.script();
  c.MultiTexCoord4f(GL_TEXTURE1, 5, 6, 7, 8);
  r.after("MultiTexCoord of TEXTURE1");
  c.ActiveTexture(GL_TEXTURE1);
  r.after("ActiveTexture of TEXTURE1");
}

void change_the_attribute_stack(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  c.PushAttrib(GL_ALL_ATTRIB_BITS);
  r.after("PushAttrib");
  c.PopAttrib();
  r.after("PopAttrib");
}

void give_wrong_commands(Test&, Repetition& r, bool) {
  gl::Case& c = r.script();
  const std::vector<float> points(4);
  c.Map1f(GL_MAP1_VERTEX_4, 0, 1, 4, 0, points);
  c.GetError();
  c.Map2f(GL_MAP2_VERTEX_4, 0, 1, 4, 0, 0, 1, 4, 1, points);
  c.GetError();
  r.after("maps that are rejected");
  c.MapGrid1f(0, 0, 1);
  c.GetError();
  c.MapGrid2f(1, 0, 1, -1, 0, 1);
  c.GetError();
  r.after("grids that are rejected");
  c.EvalMesh1(GL_FILL, 0, 1);
  c.GetError();
  c.EvalMesh2(GL_QUADS, 0, 1, 0, 1);
  c.GetError();
  r.after("meshes that are rejected");
}

void ask_for_everything(Test& t, Repetition& r, bool) {
  for (const bool doubles : {false, true}) {
    for (const GLenum target : all_targets()) query_map(r.script(), target, t.max_order(), doubles);
    r.after(doubles ? "GetMapdv of all maps" : "GetMapfv of all maps");
  }
}

void change_materials(Test&, Repetition& r, bool) {
  for (const GLenum name : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION})
    r.script().Materialfv(GL_FRONT_AND_BACK, name, std::vector<GLfloat>{0.1f, 0.2f, 0.3f, 0.4f});
  r.after("Material");
}

void set_the_raster_position(Test&, Repetition& r, bool) {
  r.script().RasterPos3f(0.25f, 0.5f, 0);
  r.after("RasterPos");
}

void enable_arrays(Test& t, Repetition& r, bool) {
  t.require(1, 1);
  gl::Case& c = r.script();
  c.EnableClientState(GL_VERTEX_ARRAY);
  r.after("EnableClientState of VERTEX_ARRAY");
  c.EnableClientState(GL_COLOR_ARRAY);
  r.after("EnableClientState of COLOR_ARRAY");
  c.DisableClientState(GL_VERTEX_ARRAY);
  c.DisableClientState(GL_COLOR_ARRAY);
  r.after("DisableClientState");
}

constexpr Unrelated kUnrelated[] = {{"MATERIAL", change_materials},
                                    {"RASTER_POSITION", set_the_raster_position},
                                    {"ARRAYS", enable_arrays},
                                    {"TEXTURE_UNITS", change_texture_units},
                                    {"ATTRIBUTE_STACK", change_the_attribute_stack},
                                    {"REFUSED_COMMANDS", give_wrong_commands},
                                    {"QUERIES", ask_for_everything},
                                    {"CURRENT_VALUES", change_current_values},
                                    {"MATRICES", change_matrices},
                                    {"FRAGMENTS", change_fragment_state},
                                    {"OTHER_MAPS", change_maps_not_used},
                                    {"PIXEL_STORE", change_client_state},
                                    {"RASTERIZATION", change_rasterization}};

// Returns a repetition of draw_some() that defines the maps and the grid once, before the first drawing.
Repetition repeated(const std::string& identity, gl::Case maps, bool two) {
  map_grid(maps, two, {7, 0.1f, 0.8f}, {3, 1, 0.3f});
  return {identity, [=, first = true](gl::Case& c) mutable {
            if (std::exchange(first, false)) c.append(maps);
            draw_some(c, two);
          }};
}

EVALCTS_TEST_PAIR(Numeric.UnrelatedState1, Numeric.UnrelatedState2, kMust,
                  decide("EV-NUM-INVARIANT-STATE/1-D", "EV-NUM-INVARIANT-STATE/2-D"),
                  decide("EV-BE-OTHERS/1-D", "EV-BE-OTHERS/2-D"), combine(kUnrelated).by(in_lists()))
(Test& t, bool two, const Unrelated& unrelated) {
  for (int order = 3; order <= t.by_depth(3, 7, 7); order += 4) {
    gl::Case maps;
    define_random(t, maps, kinds_of(two)[1], order, {0.1f, 0.7f});
    Repetition repetition = repeated(fmt::format("order {}", order), maps, two);
    repetition.after("nothing");
    unrelated.change(t, repetition, two);
    repetition.check(t, kUnit0, two ? kDrawn2 : kDrawn1);
  }
};

EVALCTS_TEST_PAIR(Numeric.UnrelatedMaps1, Numeric.UnrelatedMaps2, kQuality,
                  decide("EV-NUM-UNRELATEDMAPS/1-D", "EV-NUM-UNRELATEDMAPS/2-D"), by(in_lists()))
(Test& t, bool two) {
  for (const Kinds& kinds : kinds_of(two))
    for (int order = 3; order <= t.by_depth(3, 7, 7); order += 4) {
      const std::span others = std::span(kinds.targets).subspan(1);  // without the vertex map
      gl::Case maps;
      define_random(t, maps, kinds, order, {0.1f, 0.7f});
      for (const GLenum target : others) maps.Disable(target);
      Repetition repetition = repeated(fmt::format("{}, order {}", kinds.name, order), maps, two);
      gl::Case& c = repetition.script();
      for (const GLenum target : others) {
        c.Enable(target);
        repetition.after("Enable of " + label(target));
      }
      const GLenum texture = target_in(two, GL_MAP1_TEXTURE_COORD_1);
      define_random(t, c, {"", {texture, texture, texture, texture}}, 6, {-1, 2});
      repetition.after("Enable of " + label(texture) + " of another order");
      for (const GLenum target : others) {
        c.Disable(target);
        repetition.after("Disable of " + label(target));
      }
      repetition.check(t, kPosition, two ? kDrawn2 : kDrawn1);
    }
};

// Material is allowed between Begin and End, where its storage may be that of current values.
EVALCTS_TEST_PAIR(Numeric.MaterialInside1, Numeric.MaterialInside2, kMust,
                  decide("EV-BE-OTHERS/1-D", "EV-BE-OTHERS/2-D"), by(in_lists()))
(Test& t, bool two) {
  gl::Case c("each Material between evaluations, with maps of all attributes");
  define_random(t, c, kinds_of(two)[1], 3, {0, 1});
  map_grid(c, two, {3, 0, 1}, {2, 0, 1});
  for (const GLenum face : {GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}) {
    c.Begin(GL_POINTS);
    eval_coord(c, two, 0.25, 0.5);
    for (const GLenum name :
         {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE, GL_SHININESS}) {
      const std::size_t values = name == GL_SHININESS ? 1 : 4;
      c.Materialfv(face, name, std::vector<GLfloat>(values, 0.125f));
      eval_coord(c, two, 0.75, 0.5);
      eval_point(c, two, 1, 1);
    }
    c.End();
    eval_mesh(c, two, GL_POINT, 0, 3, 0, 2);
  }
  t.judge_vertices(c, kUnit0);
};

// AUTO_NORMAL must not change positions; it is evaluator state (appendix A of GL 2.1).
EVALCTS_TEST(Numeric, AutomaticNormals, kQuality, "EV-NUM-UNRELATEDMAPS/2-D", by(in_lists()))
(Test& t) {
  gl::Case maps;
  define_and_enable(maps, random_map(t, GL_MAP2_VERTEX_4, {4, 3}));
  Repetition repetition = repeated("a vertex map alone", maps, true);
  repetition.script().Enable(GL_AUTO_NORMAL);
  repetition.after("Enable of AUTO_NORMAL");
  repetition.check(t, kPosition, kDrawn2);
};

}  // namespace
}  // namespace evalcts::suite_numeric
