// Section 9: which of several enabled maps counts.
#include "evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(LastEnabledVertexMapWins, production, must, "EV-PREC-VERTEX EV-PREC-ORDERFREE",
              "VERTEX_3 wins where it was enabled after VERTEX_4") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP1_VERTEX_3 && on) sound.Disable(GL_MAP1_VERTEX_4);
    if (cap == GL_MAP2_VERTEX_3 && on) sound.Disable(GL_MAP2_VERTEX_4);
  });
}

EVALCTS_FAULT(BothVertexMapsDraw, production, must, "EV-PREC-VERTEX",
              "EvalPoint1 draws a vertex for each of two enabled vertex maps") {
  in.gl.EvalPoint1 = [](GLint i) {
    sound.EvalPoint1(i);
    if (is_noted_on(GL_MAP1_VERTEX_3) && is_noted_on(GL_MAP1_VERTEX_4)) sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(Vertex3WinsBesideColors, production, must, "EV-PREC-VERTEX",
              "with a colour map enabled VERTEX_3 goes before VERTEX_4") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_MAP1_COLOR_4 && cap != GL_MAP1_VERTEX_3 && cap != GL_MAP1_VERTEX_4) return;
    const bool three = is_noted_on(GL_MAP1_COLOR_4) && is_noted_on(GL_MAP1_VERTEX_3);
    is_noted_on(GL_MAP1_VERTEX_4) && !three ? sound.Enable(GL_MAP1_VERTEX_4)
                                            : sound.Disable(GL_MAP1_VERTEX_4);
  });
}

EVALCTS_FAULT(EnableReplacesTextureMap, production, must, "EV-PREC-TEX EV-PREC-ORDERFREE EV-PREC-FALLBACK",
              "Enable of a texture map switches the others off") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (!on || cap < GL_MAP1_TEXTURE_COORD_1 || cap > GL_MAP1_TEXTURE_COORD_4) return;
    for (GLenum other = GL_MAP1_TEXTURE_COORD_1; other <= GL_MAP1_TEXTURE_COORD_4; ++other)
      if (other != cap) sound.Disable(other);
  });
}

// Of the pairs, only that one.
EVALCTS_FAULT(TextureCoord3BeforeTextureCoord4, production, must, "EV-PREC-TEX",
              "TEXTURE_COORD_3 goes before TEXTURE_COORD_4 where 1 and 2 are disabled") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap < GL_MAP1_TEXTURE_COORD_1 || cap > GL_MAP1_TEXTURE_COORD_4) return;
    const bool three = is_noted_on(GL_MAP1_TEXTURE_COORD_3) && !is_noted_on(GL_MAP1_TEXTURE_COORD_1) &&
                       !is_noted_on(GL_MAP1_TEXTURE_COORD_2);
    is_noted_on(GL_MAP1_TEXTURE_COORD_4) && !three ? sound.Enable(GL_MAP1_TEXTURE_COORD_4)
                                                   : sound.Disable(GL_MAP1_TEXTURE_COORD_4);
  });
}

EVALCTS_FAULT(TextureCoord1GivesS, production, must, "EV-PREC-LOSER-IGNORED",
              "TEXTURE_COORD_3 takes its s from the points of TEXTURE_COORD_1, as far as there are") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    GLint order = 0;
    GLfloat narrow[64] = {};
    sound.GetMapiv(GL_MAP1_TEXTURE_COORD_1, GL_ORDER, &order);
    const bool legal = call.order >= 1 && call.order <= 64 && order <= 64 && call.stride >= 3;
    if (call.target != GL_MAP1_TEXTURE_COORD_3 || !legal) return go(call);
    sound.GetMapfv(GL_MAP1_TEXTURE_COORD_1, GL_COEFF, narrow);
    std::vector<Real> points;
    for (GLint i = 0; i < call.order; ++i) {
      const Real* point = call.points + i * call.stride;
      points.insert(points.end(), {i < order ? static_cast<Real>(narrow[i]) : point[0], point[1], point[2]});
    }
    call.stride = 3;
    call.points = points.data();
    go(call);
  });
}

EVALCTS_FAULT(FallbackSkipsTextureCoord2, production, must, "EV-PREC-FALLBACK",
              "after Disable of TEXTURE_COORD_3 its next is TEXTURE_COORD_1") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (on || cap != GL_MAP1_TEXTURE_COORD_3) return;
    if (is_noted_on(GL_MAP1_TEXTURE_COORD_1)) sound.Disable(GL_MAP1_TEXTURE_COORD_2);
  });
}

EVALCTS_FAULT(FallbackFromVertex4Lost, production, must, "EV-PREC-FALLBACK",
              "Disable of VERTEX_4 of surfaces disables VERTEX_3 where a texture map was enabled") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (!on && cap == GL_MAP2_VERTEX_4) sound.Disable(GL_MAP2_VERTEX_3);
  });
}

EVALCTS_FAULT(ColorSuppressesNormalBesideTexture, production, must, "EV-PREC-PERKIND",
              "the normal map of surfaces loses to a colour and a texture map together") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap < GL_MAP2_COLOR_4 || cap > GL_MAP2_TEXTURE_COORD_4) return;
    bool texture = false;
    for (GLenum other = GL_MAP2_TEXTURE_COORD_1; other <= GL_MAP2_TEXTURE_COORD_4; ++other)
      texture = texture || is_noted_on(other);
    const bool lost = texture && is_noted_on(GL_MAP2_COLOR_4);
    is_noted_on(GL_MAP2_NORMAL) && !lost ? sound.Enable(GL_MAP2_NORMAL) : sound.Disable(GL_MAP2_NORMAL);
  });
}

EVALCTS_FAULT(UndefinedTextureMapGivesWay, production, must, "EV-PREC-NOVALIDITY",
              "a texture map that was never defined is skipped for one that was") {
  map1(in, [](auto call, auto go) {
    if (call.target == GL_MAP1_TEXTURE_COORD_4) memory.flag = true;
    go(call);
  });
  in.gl.Enable = [](GLenum cap) {
    if (cap != GL_MAP1_TEXTURE_COORD_4 || memory.flag) sound.Enable(cap);
  };
}

EVALCTS_FAULT(UndefinedVertexMapGivesWay, production, must, "EV-PREC-NOVALIDITY",
              "MAP2_VERTEX_4 wins only after it was defined") {
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_VERTEX_4) memory.flag = true;
    go(call);
  });
  in.gl.Enable = [](GLenum cap) {
    if (cap != GL_MAP2_VERTEX_4 || memory.flag) sound.Enable(cap);
  };
}

}  // namespace
}  // namespace evalcts::faults
