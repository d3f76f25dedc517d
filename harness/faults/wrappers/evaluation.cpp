// Section 7: what evaluation does and leaves undone.
#include <cmath>

#include "evaluating.h"

namespace evalcts::faults {
namespace {

// --- Dimensions

EVALCTS_FAULT(ColorMapOfSurfacesColorsCurves, production, must, "EV-COORD-DIM1",
              "Enable of MAP2_COLOR_4 switches the colour map of curves on, too") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP2_COLOR_4) on ? sound.Enable(GL_MAP1_COLOR_4) : sound.Disable(GL_MAP1_COLOR_4);
  });
}

EVALCTS_FAULT(NormalMapOfCurvesServesSurfaces, production, must, "EV-COORD-DIM2",
              "Enable of MAP1_NORMAL switches the normal map of surfaces on, too") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP1_NORMAL) on ? sound.Enable(GL_MAP2_NORMAL) : sound.Disable(GL_MAP2_NORMAL);
  });
}

EVALCTS_FAULT(TextureMapOfSurfacesOutranksThatOfCurves, production, must, "EV-COORD-DIM1",
              "TEXTURE_COORD_4 of surfaces suppresses the smaller texture maps of curves") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_MAP1_TEXTURE_COORD_2 && cap != GL_MAP2_TEXTURE_COORD_4) return;
    is_noted_on(GL_MAP1_TEXTURE_COORD_2) && !is_noted_on(GL_MAP2_TEXTURE_COORD_4)
        ? sound.Enable(GL_MAP1_TEXTURE_COORD_2)
        : sound.Disable(GL_MAP1_TEXTURE_COORD_2);
  });
}

EVALCTS_FAULT(VertexMapOfCurvesOutranksThatOfSurfaces, production, must, "EV-COORD-DIM2",
              "VERTEX_4 of curves suppresses VERTEX_3 of surfaces") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_MAP2_VERTEX_3 && cap != GL_MAP1_VERTEX_4) return;
    is_noted_on(GL_MAP2_VERTEX_3) && !is_noted_on(GL_MAP1_VERTEX_4) ? sound.Enable(GL_MAP2_VERTEX_3)
                                                                    : sound.Disable(GL_MAP2_VERTEX_3);
  });
}

EVALCTS_FAULT(DimensionFixedByFirstVertex, production, must, "EV-COORD-MIXDIM",
              "EvalPoint of the other dimension than the first vertex of a primitive does nothing") {
  primitives(
      in, [] { memory.count = 0; }, [] { memory.count = 0; });
  eval_coord1(in, [](auto u, auto go) {
    if (memory.count == 0) memory.count = 1;
    go(u);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (memory.count == 0) memory.count = 2;
    go(u, v);
  });
  in.gl.EvalPoint1 = [](GLint i) {
    if (memory.count != 2) sound.EvalPoint1(i);
  };
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (memory.count != 1) sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(SurfaceAfterCurveUsesItsArgument, production, must, "EV-COORD-MIXDIM",
              "EvalCoord2 right after EvalCoord1 takes u from there") {
  eval_coord1(in, [](auto u, auto go) {
    memory.number = u;
    memory.flag = true;
    go(u);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (memory.flag && std::abs(memory.number - u) > 0.1) u = static_cast<decltype(u)>(memory.number);
    memory.flag = false;
    go(u, v);
  });
  in.gl.EvalPoint1 = [](GLint i) {
    memory.flag = true;
    memory.number = 0.75;
    sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(EvalCoord2dvTakesVFirst, production, must, "EV-COORD-ARGORDER",
              "EvalCoord2dv takes v, then u") {
  in.gl.EvalCoord2dv = [](const GLdouble* uv) { sound.EvalCoord2d(uv[1], uv[0]); };
}

EVALCTS_FAULT(EvalPoint2TakesJFirstInSquareGrids, production, must, "EV-COORD-ARGORDER EV-POINT2-EQUIV",
              "EvalPoint2 mixes i and j up, unless one of them is 0") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    i != 0 && j != 0 ? sound.EvalPoint2(j, i) : sound.EvalPoint2(i, j);
  };
}

// --- Without a vertex map

EVALCTS_FAULT(ColorMapWithoutVertexMapSetsColor, production, must, "EV-COORD-NOVERTEX",
              "without a vertex map, the colour map still sets the current colour") {
  points1(in, [](auto go) {
    if (is_noted_on(GL_MAP1_COLOR_4) && !has_vertex_map(1)) sound.Color4f(0.75f, 0.5f, 0.25f, 1);
    go();
  });
}

EVALCTS_FAULT(TexturePointWithoutVertexMapSetsS, production, must, "EV-COORD-NOVERTEX",
              "without a vertex map, EvalPoint2 still sets the current texture coordinates") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (is_noted_on(GL_MAP2_TEXTURE_COORD_2) && !has_vertex_map(2)) sound.TexCoord2f(0.5f, 0.25f);
    sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(NormalMapWithoutVertexMapDrawsOrigin, production, must, "EV-COORD-NOVERTEX",
              "without a vertex map, EvalCoord2 with a normal map draws the initial point of a vertex map") {
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (is_noted_on(GL_MAP2_NORMAL) && !has_vertex_map(2)) sound.Vertex4f(0, 0, 0, 1);
    go(u, v);
  });
}

EVALCTS_FAULT(IndexMapWithoutVertexMapIsAnError, production, must, "EV-COORD-NOVERTEX",
              "EvalCoord1 with an index map and no vertex map raises INVALID_OPERATION") {
  points1(in, [](auto go) {
    if (is_noted_on(GL_MAP1_INDEX) && !has_vertex_map(1)) raise_inside();
    go();
  });
}

EVALCTS_FAULT(AnyVertexMapWillDo, production, must, "EV-COORD-NOVERTEX-OTHERDIM",
              "EvalCoord1 asks whether any vertex map is enabled, then draws the initial point") {
  points1(in, [](auto go) {
    if (!has_vertex_map(1) && has_vertex_map(2)) sound.Vertex4f(0, 0, 0, 1);
    go();
  });
}

EVALCTS_FAULT(SurfacePointOfVertexCurve, production, must, "EV-COORD-NOVERTEX-OTHERDIM",
              "EvalPoint2 asks for MAP1_VERTEX_4 as well as for the maps of its own dimension") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (!has_vertex_map(2) && is_noted_on(GL_MAP1_VERTEX_4)) sound.Vertex4f(0, 0, 0, 1);
    sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(MeshOfVertexCurveDrawsSurface, production, must, "EV-COORD-NOVERTEX-OTHERDIM",
              "EvalMesh2 with vertex maps of curves only draws a point for each index") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (!has_vertex_map(2) && has_vertex_map(1) && mode == GL_POINT) {
      sound.Begin(GL_POINTS);
      for (GLint i = i1; i <= i2; ++i) sound.Vertex4f(0, 0, 0, 1);
      sound.End();
    }
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

// --- Inside Begin and End

EVALCTS_FAULT(EvalCoordRefusedInPolygons, production, must, "EV-COORD-INBEGIN",
              "EvalCoord2dv raises INVALID_OPERATION in a POLYGON") {
  in.gl.EvalCoord2dv = [](const GLdouble* uv) {
    if (is_inside() && open_mode() == GL_POLYGON) raise_inside();
    sound.EvalCoord2dv(uv);
  };
}

EVALCTS_FAULT(EvalCoordRefusedInAdjacency, production, must, "EV-COORD-INBEGIN",
              "EvalCoord1 raises INVALID_OPERATION in primitives with adjacency, which it is older than") {
  eval_coord1(in, [](auto u, auto go) {
    if (is_inside() && open_mode() > GL_POLYGON) raise_inside();
    go(u);
  });
}

EVALCTS_FAULT(EvalPointRefusedInLoops, production, must, "EV-COORD-INBEGIN",
              "EvalPoint1 raises INVALID_OPERATION in a LINE_LOOP, but draws") {
  in.gl.EvalPoint1 = [](GLint i) {
    if (is_inside() && open_mode() == GL_LINE_LOOP) raise_inside();
    sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(EvalPoint2RefusedInQuads, production, must, "EV-COORD-INBEGIN EV-BE-ALLOWED",
              "EvalPoint2 is not on the list of commands that are legal in QUADS") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (is_inside() && open_mode() == GL_QUADS) raise_inside();
    sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(LoopOfEvaluatedVerticesStaysOpen, production, must, "EV-COORD-PRIMS",
              "a LINE_LOOP with evaluated vertices is not closed") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    for (ObservedPrimitive& primitive : all)
      if (memory.count != 0 && primitive.mode == GL_LINE_LOOP) primitive.mode = GL_LINE_STRIP;
  };
}

EVALCTS_FAULT(OddVertexEndsQuadStrip, production, must, "EV-COORD-PRIMS",
              "an odd last vertex of a QUAD_STRIP takes the last quad with it, from 7 vertices on") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    for (ObservedPrimitive& primitive : all)
      if (memory.count != 0 && primitive.mode == GL_QUAD_STRIP && primitive.vertices.size() == 7)
        primitive.vertices.resize(4);
  };
}

EVALCTS_FAULT(FanRestartsAfterEightVertices, production, must, "EV-COORD-PRIMS",
              "the ninth evaluated vertex of a TRIANGLE_FAN begins another one") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      if (primitive.mode == GL_TRIANGLE_FAN && primitive.vertices.size() > 8) primitive.vertices.resize(8);
  };
}

EVALCTS_FAULT(VertexAfterEvaluationLost, production, must, "EV-COORD-MIX",
              "a second Vertex in a row, after an evaluation, is lost") {
  points(in, [](auto go) {
    memory.count = 1;
    go();
  });
  primitives(
      in, [] { memory.count = 0; }, [] {});
  in.gl.Vertex3f = [](GLfloat x, GLfloat y, GLfloat z) {
    memory.count = 0;
    sound.Vertex3f(x, y, z);
  };
  in.gl.Vertex2f = [](GLfloat x, GLfloat y) {
    if (memory.count != 0) memory.count = 2;
    sound.Vertex2f(x, y);
  };
  in.gl.Vertex4f = [](GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
    if (memory.count != 2) sound.Vertex4f(x, y, z, w);
    memory.count = 0;
  };
}

EVALCTS_FAULT(ColorInsidePrimitiveWaits, production, must, "EV-COORD-CURRENT",
              "a Color after an evaluation counts from the next primitive on") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  primitives(
      in, [] { memory.flag = false; },
      [] {
        if (memory.numbers.size() == 4)
          sound.Color4d(memory.numbers[0], memory.numbers[1], memory.numbers[2], memory.numbers[3]);
        memory.numbers.clear();
      });
  in.gl.Color4f = [](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
    if (is_inside() && memory.flag) {
      memory.numbers = {r, g, b, a};
    } else {
      sound.Color4f(r, g, b, a);
    }
  };
}

EVALCTS_FAULT(TexCoord2BetweenEvaluationsKeepsRAndQ, production, must, "EV-COORD-CURRENT",
              "TexCoord2 between evaluations leaves the r and q of an earlier TexCoord4") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.TexCoord4f = [](GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
    memory.numbers = {r, q};
    sound.TexCoord4f(s, t, r, q);
  };
  in.gl.TexCoord2f = [](GLfloat s, GLfloat t) {
    if (memory.flag && memory.numbers.size() == 2) {
      sound.TexCoord4f(s, t, static_cast<GLfloat>(memory.numbers[0]),
                       static_cast<GLfloat>(memory.numbers[1]));
    } else {
      sound.TexCoord2f(s, t);
    }
  };
}

// --- Attributes before the vertex

EVALCTS_FAULT(ColorOfTheVertexBefore, production, must, "EV-COORD-VERTEXLAST EV-COORD-ASIF",
              "the vertex goes out before its colour is evaluated") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (std::size_t i = primitive.vertices.size(); i-- > 1;)
        primitive.vertices[i].color = primitive.vertices[i - 1].color;
  };
}

EVALCTS_FAULT(FirstVertexHasTextureOfLastPrimitive, production, must, "EV-COORD-VERTEXLAST",
              "the first vertex of a primitive has the texture coordinates of the one before it") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (std::size_t i = all.size(); i-- > 1;)
      if (!all[i].vertices.empty() && !all[i - 1].vertices.empty())
        all[i].vertices.front().texture_coordinate[0] = all[i - 1].vertices.back().texture_coordinate[0];
  };
}

EVALCTS_FAULT(NormalOfTheVertexBefore, production, must, "EV-COORD-VERTEXLAST",
              "from the third vertex of a primitive on, the vertex goes out before its normal") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (std::size_t i = primitive.vertices.size(); i-- > 2;)
        primitive.vertices[i].normal = primitive.vertices[i - 1].normal;
  };
}

EVALCTS_FAULT(
    AllKindsTogetherLoseTheColor, production, must, "EV-COORD-ASIF EV-PREC-PERKIND",
    "where colour, normal, texture and index maps are enabled together, the colour is the current one") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    const bool all = is_noted_on(GL_MAP1_COLOR_4) && is_noted_on(GL_MAP1_NORMAL) &&
                     is_noted_on(GL_MAP1_INDEX) &&
                     (is_noted_on(GL_MAP1_TEXTURE_COORD_3) || is_noted_on(GL_MAP1_TEXTURE_COORD_4));
    if (all) {
      sound.Disable(GL_MAP1_COLOR_4);
    } else if (is_noted_on(GL_MAP1_COLOR_4) && cap != GL_MAP1_COLOR_4) {
      sound.Enable(GL_MAP1_COLOR_4);
    }
  });
}

// --- Arguments

EVALCTS_FAULT(HugeArgumentIsAnError, production, must, "EV-COORD-NOERR/1-D",
              "EvalCoord1 raises INVALID_OPERATION where the argument is above 2^120") {
  eval_coord1(in, [](auto u, auto go) {
    if (u > 0x1p120f) raise_inside();
    go(u);
  });
}

EVALCTS_FAULT(HugeVIsAnError, production, must, "EV-COORD-NOERR/2-D",
              "EvalCoord2 raises INVALID_OPERATION where v is below -2^120") {
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (v < -0x1p120f) raise_inside();
    go(u, v);
  });
}

EVALCTS_FAULT(DenormalUIsAnError, production, must, "EV-COORD-NOERR/2-D",
              "EvalCoord2f raises INVALID_OPERATION where u is denormal") {
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (std::fpclassify(static_cast<float>(u)) == FP_SUBNORMAL) raise_inside();
    go(u, v);
  });
}

EVALCTS_FAULT(DoubleArgumentsInFixedPoint, production, must, "EV-COORD-FD",
              "EvalCoord1d keeps 10 bits behind the point of its argument") {
  in.gl.EvalCoord1d = [](GLdouble u) { sound.EvalCoord1d(std::round(u * 1024) / 1024); };
  in.gl.EvalCoord1dv = [](const GLdouble* u) { sound.EvalCoord1d(std::round(*u * 1024) / 1024); };
}

EVALCTS_FAULT(DoubleVInFixedPoint, production, must, "EV-COORD-FD",
              "EvalCoord2d keeps 10 bits behind the point of v") {
  in.gl.EvalCoord2d = [](GLdouble u, GLdouble v) { sound.EvalCoord2d(u, std::round(v * 1024) / 1024); };
  in.gl.EvalCoord2dv = [](const GLdouble* uv) { sound.EvalCoord2d(uv[0], std::round(uv[1] * 1024) / 1024); };
}

EVALCTS_FAULT(EveryFifthEvaluationOneUlpOff, production, must, "EV-COORD-REPEAT",
              "every fifth EvalCoord1f evaluates at the next number") {
  in.gl.EvalCoord1f = [](GLfloat u) {
    sound.EvalCoord1f(++memory.count % 5 == 0 ? std::nextafter(u, 2.0f) : u);
  };
}

EVALCTS_FAULT(RepeatedArgumentIsSkipped, production, must, "EV-COORD-REPEAT",
              "EvalCoord2 with the arguments of the last one draws nothing") {
  primitives(
      in, [] { memory.numbers.clear(); }, [] {});
  eval_coord2(in, [](auto u, auto v, auto go) {
    const std::vector<double> now = {static_cast<double>(u), static_cast<double>(v)};
    if (now != memory.numbers) go(u, v);
    memory.numbers = now;
  });
}

EVALCTS_FAULT(SecondPrimitiveHalfAnUlpOff, production, must, "EV-COORD-REPEAT",
              "from the second primitive on EvalCoord2 evaluates by another path") {
  primitives(
      in, [] {}, [] { memory.flag = true; });
  eval_coord2(in,
              [](auto u, auto v, auto go) { go(memory.flag ? std::nextafter(u, decltype(u){2}) : u, v); });
}

// --- Further down the pipeline

EVALCTS_FAULT(NormalBetweenEvaluationsLost, osmesa, must, "EV-COORD-MATERIAL",
              "a Normal after an evaluation in the same primitive is lost") {
  primitives(
      in, [] { memory.flag = false; }, [] { memory.flag = false; });
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.Normal3f = [](GLfloat x, GLfloat y, GLfloat z) {
    if (!memory.flag) sound.Normal3f(x, y, z);
  };
}

EVALCTS_FAULT(MaterialBetweenEvaluationsLost, osmesa, must, "EV-COORD-MATERIAL",
              "a Material after an evaluation in the same primitive is lost") {
  primitives(
      in, [] { memory.flag = false; }, [] { memory.flag = false; });
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.Materialfv = [](GLenum face, GLenum pname, const GLfloat* values) {
    if (!memory.flag) sound.Materialfv(face, pname, values);
  };
}

EVALCTS_FAULT(ListBetweenEvaluationsLost, osmesa, must, "EV-COORD-MATERIAL",
              "CallList after an evaluation in the same primitive calls nothing") {
  primitives(
      in, [] { memory.flag = false; }, [] { memory.flag = false; });
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.CallList = [](GLuint list) {
    if (!memory.flag) sound.CallList(list);
  };
}

EVALCTS_FAULT(ColorArrayColorsEvaluatedVertices, osmesa, must, "EV-COORD-NOARRAYS",
              "with an enabled colour array, evaluated vertices without a colour map have its first colour") {
  in.gl.EnableClientState = [](GLenum array) {
    if (array == GL_COLOR_ARRAY) memory.flag = true;
    sound.EnableClientState(array);
  };
  points(in, [](auto go) {
    if (memory.flag) sound.Color4f(0.625f, 0.625f, 0.625f, 0.625f);
    go();
  });
}

EVALCTS_FAULT(TextureCoordinateArrayFeedsEvaluatedVertices, osmesa, must, "EV-COORD-NOARRAYS",
              "with an enabled array, evaluated vertices without a texture map have its first coordinates") {
  in.gl.EnableClientState = [](GLenum array) {
    if (array == GL_TEXTURE_COORD_ARRAY) memory.flag = true;
    sound.EnableClientState(array);
  };
  points(in, [](auto go) {
    if (memory.flag) sound.TexCoord4f(0.625f, 0.625f, 0.625f, 0.625f);
    go();
  });
}

EVALCTS_FAULT(NormalArrayTurnsNormalMapsOff, osmesa, must, "EV-COORD-NOARRAYS",
              "an enabled normal array goes before the normal map") {
  in.gl.EnableClientState = [](GLenum array) {
    if (array == GL_NORMAL_ARRAY) memory.flag = true;
    sound.EnableClientState(array);
  };
  in.gl.Enable = [](GLenum cap) {
    if (cap != GL_MAP1_NORMAL || !memory.flag) sound.Enable(cap);
  };
}

// What the explicit control never has: an enabled vertex map.
EVALCTS_FAULT(EvaluatedVerticesIgnoreClipPlanes, osmesa, must, "EV-COORD-TRANSFORM",
              "evaluated vertices are not clipped by user clip planes") {
  primitives(
      in,
      [] {
        if (has_vertex_map(1) || has_vertex_map(2)) sound.Disable(GL_CLIP_PLANE0);
      },
      [] {
        if (is_noted_on(GL_CLIP_PLANE0)) sound.Enable(GL_CLIP_PLANE0);
      });
}

EVALCTS_FAULT(EvaluatedVerticesHaveNoFog, osmesa, must, "EV-COORD-TRANSFORM",
              "evaluated vertices are not fogged") {
  primitives(
      in,
      [] {
        if (has_vertex_map(1) || has_vertex_map(2)) sound.Disable(GL_FOG);
      },
      [] {
        if (is_noted_on(GL_FOG)) sound.Enable(GL_FOG);
      });
}

EVALCTS_FAULT(EvaluatedVerticesHaveNoTextureGeneration, osmesa, must, "EV-COORD-TRANSFORM",
              "texture coordinates of evaluated vertices are not generated") {
  primitives(
      in,
      [] {
        if (has_vertex_map(1) || has_vertex_map(2)) sound.Disable(GL_TEXTURE_GEN_S);
      },
      [] {
        if (is_noted_on(GL_TEXTURE_GEN_S)) sound.Enable(GL_TEXTURE_GEN_S);
      });
}

EVALCTS_FAULT(EvaluatedColorsAreNotLit, osmesa, must, "EV-COORD-TRANSFORM",
              "evaluated vertices with a colour map are not lit") {
  primitives(
      in,
      [] {
        if (is_noted_on(GL_MAP1_COLOR_4) || is_noted_on(GL_MAP2_COLOR_4)) sound.Disable(GL_LIGHTING);
      },
      [] {
        if (is_noted_on(GL_LIGHTING)) sound.Enable(GL_LIGHTING);
      });
}

EVALCTS_FAULT(EvaluatedTextureCoordinatesSkipTheirMatrix, osmesa, must, "EV-COORD-TRANSFORM",
              "evaluated texture coordinates do not go through the texture matrix") {
  primitives(
      in,
      [] {
        if (!has_vertex_map(1) && !has_vertex_map(2)) return;
        sound.MatrixMode(GL_TEXTURE);
        sound.LoadIdentity();
        sound.MatrixMode(GL_MODELVIEW);
      },
      [] {});
}

}  // namespace
}  // namespace evalcts::faults
