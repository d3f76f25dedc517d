// Section 8: the attributes of evaluated vertices.
#include <algorithm>
#include <array>
#include <cmath>

#include "evaluating.h"

namespace evalcts::faults {
namespace {

// The call with its points of four components packed, these in the given order.
template <class Call, class Go>
void with_packed(Call call, const Go& go, const std::array<int, 4>& order) {
  const bool wrong = call.uorder < 1 || call.uorder > 64 || call.vorder < 1 || call.vorder > 64;
  if (wrong || call.ustride < 4 || call.vstride < 4) return go(call);
  std::vector<typename Call::Value> packed;
  for (std::ptrdiff_t i = 0; i < call.uorder; ++i)
    for (std::ptrdiff_t j = 0; j < call.vorder; ++j)
      for (const int component : order)
        packed.push_back(call.points[i * call.ustride + j * call.vstride + component]);
  call.ustride = 4 * call.vorder;
  call.vstride = 4;
  call.points = packed.data();
  go(call);
}

EVALCTS_FAULT(WOfTheVertexBefore, production, must, "EV-ATTR-VERTEX3",
              "VERTEX_3 leaves the w of the vertex before it") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (std::size_t i = primitive.vertices.size(); i-- > 1;)
        if (primitive.vertices[i].position[3] == 1)
          primitive.vertices[i].position[3] = primitive.vertices[i - 1].position[3];
  };
}

EVALCTS_FAULT(WOfVertex3IsQ, production, must, "EV-ATTR-VERTEX3",
              "VERTEX_3 takes its w from where the q of the texture map was put") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    if (vertex.position[3] == 1) vertex.position[3] = vertex.texture_coordinate[0][3];
  });
}

EVALCTS_FAULT(ColorsOfSurfacesInTheOrderBgra, production, must, "EV-ATTR-COLOR",
              "points of colour maps of surfaces are taken as B, G, R, A") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_COLOR_4) return with_packed(call, go, {2, 1, 0, 3});
    go(call);
  });
}

EVALCTS_FAULT(NormalsFaceForward, production, must, "EV-ATTR-NORMAL",
              "normals with negative z are turned round") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    if (vertex.normal[2] < 0)
      for (float& x : vertex.normal) x = -x;
  });
}

EVALCTS_FAULT(QOfTheVertexBefore, production, must, "EV-ATTR-TEX1 EV-ATTR-TEX2 EV-ATTR-TEX3 EV-CUR-MAXCOMP",
              "texture maps without q leave that of the vertex before it") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (std::size_t i = primitive.vertices.size(); i-- > 1;) {
        auto &now = primitive.vertices[i].texture_coordinate[0],
             &before = primitive.vertices[i - 1].texture_coordinate[0];
        if (now[3] == 1) now[3] = before[3];
      }
  };
}

EVALCTS_FAULT(AlphaOfTheFirstVertex, production, must, "EV-ATTR-COLOR",
              "alpha is evaluated for the first vertex of a primitive only") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (ObservedVertex& vertex : primitive.vertices) vertex.color[3] = primitive.vertices[0].color[3];
  };
}

EVALCTS_FAULT(NegativeWMadePositive, production, must, "EV-ATTR-VERTEX4",
              "a point with negative w is multiplied by -1") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    if (vertex.position[3] < 0)
      for (float& x : vertex.position) x = -x;
  });
}

EVALCTS_FAULT(DividedByWAtOnce, production, must, "EV-ATTR-VERTEX4",
              "the evaluator divides by w, where w is above 1") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    const float w = vertex.position[3];
    if (w > 1)
      for (float& x : vertex.position) x /= w;
  });
}

EVALCTS_FAULT(TextureCoordinatesDividedByW, production, must, "EV-ATTR-RATIONAL-ONLYVTX",
              "texture coordinates are divided by the w of the vertex") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    const float w = vertex.position[3];
    if (w > 0)
      for (float& x : vertex.texture_coordinate[0]) x /= w;
  });
}

EVALCTS_FAULT(ColorsDividedByW, production, must, "EV-ATTR-RATIONAL-ONLYVTX",
              "colours are divided by the w of the vertex") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    if (vertex.position[3] > 0)
      for (float& x : vertex.color) x /= vertex.position[3];
  });
}

EVALCTS_FAULT(NormalsTimesW, production, must, "EV-ATTR-RATIONAL-ONLYVTX",
              "normals of rational vertices are multiplied by w") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    for (float& x : vertex.normal) x *= vertex.position[3];
  });
}

EVALCTS_FAULT(NegativeColorsClamped, production, must, "EV-ATTR-COLOR-CLAMP",
              "negative components of colours become 0 in the evaluator") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    for (float& x : vertex.color) x = std::max(x, 0.0f);
  });
}

EVALCTS_FAULT(AlphaClamped, production, must, "EV-ATTR-COLOR-CLAMP",
              "alpha above 1 becomes 1 in the evaluator") {
  emitted_vertices(in, [](ObservedVertex& vertex) { vertex.color[3] = std::min(vertex.color[3], 1.0f); });
}

EVALCTS_FAULT(IndexMapSetsTheIndex, production, must, "EV-ATTR-INDEX-RGBA EV-CUR-INDEX",
              "evaluation at a grid point with an index map sets the current index") {
  in.gl.EvalPoint1 = [](GLint i) {
    sound.EvalPoint1(i);
    if (is_noted_on(GL_MAP1_INDEX)) sound.Indexf(3);
  };
}

EVALCTS_FAULT(IndexMapGivesTheRed, production, must, "EV-ATTR-INDEX-RGBA",
              "in RGBA mode an index map makes the current colour white") {
  points1(in, [](auto go) {
    if (is_noted_on(GL_MAP1_INDEX) && has_vertex_map(1)) sound.Color4f(1, 1, 1, 1);
    go();
  });
}

EVALCTS_FAULT(LongNormalsNormalised, production, must, "EV-ATTR-NORMAL",
              "normals longer than 1 are normalised by the evaluator") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    auto& [x, y, z] = vertex.normal;
    const float length = std::sqrt(x * x + y * y + z * z);
    if (length > 1)
      for (float& value : vertex.normal) value /= length;
  });
}

EVALCTS_FAULT(TextureCoord1GivesTToo, production, must, "EV-ATTR-TEX1",
              "TEXTURE_COORD_1 gives s as t as well") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    auto& [s, t, r, q] = vertex.texture_coordinate[0];
    if (t == 0 && r == 0 && q == 1) t = s;
  });
}

EVALCTS_FAULT(TextureCoord2GivesROne, production, must, "EV-ATTR-TEX2", "TEXTURE_COORD_2 gives r = 1") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    auto& [s, t, r, q] = vertex.texture_coordinate[0];
    if (t != 0 && r == 0 && q == 1) r = 1;
  });
}

EVALCTS_FAULT(TextureCoord3GivesRAsQ, production, must, "EV-ATTR-TEX3",
              "TEXTURE_COORD_3 gives its last coordinate as q") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    auto& [s, t, r, q] = vertex.texture_coordinate[0];
    if (r != 0 && q == 1) q = r;
  });
}

EVALCTS_FAULT(TextureCoord4DividedByQ, production, must, "EV-ATTR-TEX4",
              "TEXTURE_COORD_4 is divided by q, where q is positive") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    const float q = vertex.texture_coordinate[0][3];
    if (q > 0)
      for (float& x : vertex.texture_coordinate[0]) x /= q;
  });
}

EVALCTS_FAULT(TextureCoord4SwapsRAndQ, production, must, "EV-ATTR-TEX4",
              "TEXTURE_COORD_4 of surfaces gives r and q in the wrong order") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_TEXTURE_COORD_4) return with_packed(call, go, {0, 1, 3, 2});
    go(call);
  });
}

EVALCTS_FAULT(LastUnitFollowsTextureMaps, production, must, "EV-ATTR-OTHERUNITS",
              "texture maps feed unit 7 as well") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    vertex.texture_coordinate.back() = vertex.texture_coordinate.front();
  });
}

EVALCTS_FAULT(OtherUnitsAtTheirInitialValues, production, must, "EV-ATTR-OTHERUNITS",
              "units 1 and up of evaluated vertices have (0,0,0,1)") {
  emitted_vertices(in, [](ObservedVertex& vertex) {
    for (std::size_t unit = 1; unit < kTextureUnits; ++unit) vertex.texture_coordinate[unit] = {0, 0, 0, 1};
  });
}

EVALCTS_FAULT(ColorMapFeedsSecondaryColor, osmesa, must, "EV-ATTR-NOMAPS",
              "a colour map resets the secondary colour of evaluated vertices") {
  points(in, [](auto go) {
    if (is_noted_on(GL_MAP1_COLOR_4) || is_noted_on(GL_MAP2_COLOR_4)) sound.SecondaryColor3f(0, 0, 0);
    go();
  });
}

EVALCTS_FAULT(TextureMapFeedsGenericSix, osmesa, must, "EV-ATTR-NOMAPS",
              "a texture map writes generic attribute 6, unless EvalPoint evaluates it") {
  eval_coord1(in, [](auto u, auto go) {
    if (is_noted_on(GL_MAP1_TEXTURE_COORD_4)) sound.VertexAttrib4f(6, 0, 0, 0, 1);
    go(u);
  });
}

EVALCTS_FAULT(EvaluatedVerticesHaveNoFogCoordinate, osmesa, must, "EV-ATTR-NOMAPS",
              "the fog coordinate of evaluated vertices is 0") {
  points(in, [](auto go) {
    sound.FogCoordf(0);
    go();
  });
}

EVALCTS_FAULT(GenericZeroIsTheFirstPoint, osmesa, must, "EV-ATTR-GENERIC0",
              "a shader that reads generic attribute 0 gets the start of the curve") {
  in.gl.BindAttribLocation = [](GLuint program, GLuint index, const GLchar* name) {
    if (index == 0) memory.flag = true;
    sound.BindAttribLocation(program, index, name);
  };
  eval_coord1(in, [](auto u, auto go) { go(memory.flag ? decltype(u){0} : u); });
  eval_coord2(in, [](auto u, auto v, auto go) { go(memory.flag ? decltype(u){0} : u, v); });
}

}  // namespace
}  // namespace evalcts::faults
