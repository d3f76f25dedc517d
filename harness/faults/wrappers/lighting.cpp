// Section 12: evaluated colours in the lighting equation.
#include "around.h"
#include "forms.h"

namespace evalcts::faults::lighting {
namespace {

// --- Tracked colours ---------------------------------------------------------------------------------------

EVALCTS_FAULT(MeshIgnoresColorMaterial, osmesa, must, "EV-CMAT-EFFECT",
              "meshes are lit with the material of the current colour, whatever the colour map says") {
  meshes(in, [](GLenum, auto go) { without(GL_COLOR_MATERIAL, go); });
}

EVALCTS_FAULT(PrimitiveTracksCurrentColor, osmesa, must, "EV-CMAT-EFFECT",
              "EvalCoord and EvalPoint give no colour while COLOR_MATERIAL is on") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL) && is_on(GL_LIGHTING) && is_on(GL_MAP1_COLOR_4);
    if (memory.flag) sound.Disable(GL_MAP1_COLOR_4);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_MAP1_COLOR_4);
  };
}

EVALCTS_FAULT(MeshTracksDiffuseOnly, osmesa, must, "EV-CMAT-EFFECT",
              "of AMBIENT_AND_DIFFUSE meshes track only DIFFUSE") {
  meshes(in, [](GLenum, auto go) {
    const GLint face = integer(GL_COLOR_MATERIAL_FACE), property = integer(GL_COLOR_MATERIAL_PARAMETER);
    const bool both = property == GL_AMBIENT_AND_DIFFUSE;
    if (both) sound.ColorMaterial(static_cast<GLenum>(face), GL_DIFFUSE);
    go();
    if (both) sound.ColorMaterial(static_cast<GLenum>(face), static_cast<GLenum>(property));
  });
}

EVALCTS_FAULT(SpecularNotTracked, osmesa, must, "EV-CMAT-EFFECT",
              "evaluated colours are not tracked by SPECULAR") {
  in.gl.ColorMaterial = [](GLenum face, GLenum mode) {
    sound.ColorMaterial(face, mode);
    memory.flag = mode == GL_SPECULAR;
  };
  in.gl.Begin = [](GLenum mode) {
    const bool tracks = memory.flag && is_on(GL_MAP1_VERTEX_3) && is_on(GL_COLOR_MATERIAL);
    memory.count = tracks;
    if (tracks) sound.Disable(GL_COLOR_MATERIAL);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.count) sound.Enable(GL_COLOR_MATERIAL);
  };
}

EVALCTS_FAULT(SurfaceTracksCurrentColor, osmesa, must, "EV-CMAT-EFFECT/2-D",
              "EvalCoord2 gives no colour while DIFFUSE is tracked") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL) && is_on(GL_MAP2_COLOR_4) &&
                  integer(GL_COLOR_MATERIAL_PARAMETER) == GL_DIFFUSE;
    if (memory.flag) sound.Disable(GL_MAP2_COLOR_4);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_MAP2_COLOR_4);
  };
}

EVALCTS_FAULT(FirstVertexTracksCurrentColor, osmesa, must, "EV-CMAT-EFFECT",
              "the first EvalCoord1 of a lit primitive is lit with the current colour") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL) && is_on(GL_LIGHTING) && is_on(GL_MAP1_COLOR_4);
    memory.numbers.assign(4, 0);
    sound.GetDoublev(GL_CURRENT_COLOR, memory.numbers.data());
    memory.count = 0;
    sound.Begin(mode);
  };
  eval_coord1(in, [](auto u, auto go) {
    if (memory.flag && memory.count++ == 0) {
      sound.Color4dv(memory.numbers.data());
      sound.Vertex3f(static_cast<GLfloat>(u), 0, 0);
    } else {
      go(u);
    }
  });
}

// --- Faces -------------------------------------------------------------------------------------------------

// Evaluated primitives under another face of ColorMaterial.
template <GLenum face_when, GLenum face_instead>
void change_face(Injection& in) {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = evaluates() && is_on(GL_COLOR_MATERIAL) && integer(GL_COLOR_MATERIAL_FACE) == face_when;
    if (memory.flag)
      sound.ColorMaterial(face_instead, static_cast<GLenum>(integer(GL_COLOR_MATERIAL_PARAMETER)));
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag)
      sound.ColorMaterial(face_when, static_cast<GLenum>(integer(GL_COLOR_MATERIAL_PARAMETER)));
  };
}

EVALCTS_FAULT(EvaluatedColorOnBothFaces, osmesa, must, "EV-CMAT-FACES",
              "evaluated colours are tracked on both faces though ColorMaterial names FRONT") {
  change_face<GL_FRONT, GL_FRONT_AND_BACK>(in);
}

EVALCTS_FAULT(EvaluatedColorNotOnBack, osmesa, must, "EV-CMAT-FACES",
              "of FRONT_AND_BACK evaluated colours are tracked on the front alone") {
  change_face<GL_FRONT_AND_BACK, GL_FRONT>(in);
}

EVALCTS_FAULT(EvaluatedColorOnOtherFace, osmesa, must, "EV-CMAT-FACES",
              "evaluated colours that BACK tracks go to the front") {
  change_face<GL_BACK, GL_FRONT>(in);
}

EVALCTS_FAULT(SurfaceColorOnBothFaces, osmesa, must, "EV-CMAT-FACES/2-D",
              "evaluated colours of surfaces are tracked on both faces though ColorMaterial names one") {
  in.gl.Begin = [](GLenum mode) {
    memory.count = is_on(GL_MAP2_VERTEX_3) && is_on(GL_COLOR_MATERIAL) ? integer(GL_COLOR_MATERIAL_FACE) : 0;
    if (memory.count)
      sound.ColorMaterial(GL_FRONT_AND_BACK, static_cast<GLenum>(integer(GL_COLOR_MATERIAL_PARAMETER)));
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.count)
      sound.ColorMaterial(static_cast<GLenum>(memory.count),
                          static_cast<GLenum>(integer(GL_COLOR_MATERIAL_PARAMETER)));
  };
}

// --- No tracking -------------------------------------------------------------------------------------------

EVALCTS_FAULT(MeshAlwaysTracksColors, osmesa, must, "EV-CMAT-OFF",
              "meshes are lit with evaluated colours though COLOR_MATERIAL is off") {
  meshes(in, [](GLenum, auto go) {
    const bool turn_on = is_on(GL_LIGHTING) && !is_on(GL_COLOR_MATERIAL);
    if (turn_on) sound.Enable(GL_COLOR_MATERIAL);
    go();
    if (turn_on) sound.Disable(GL_COLOR_MATERIAL);
  });
}

EVALCTS_FAULT(EvaluatedColorAlwaysEmitted, osmesa, must, "EV-CMAT-OFF",
              "evaluated colours are the emission of lit primitives though COLOR_MATERIAL is off") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = evaluates() && is_on(GL_LIGHTING) && !is_on(GL_COLOR_MATERIAL);
    if (memory.flag) {
      sound.ColorMaterial(GL_FRONT_AND_BACK, GL_EMISSION);
      sound.Enable(GL_COLOR_MATERIAL);
    }
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Disable(GL_COLOR_MATERIAL);
  };
}

EVALCTS_FAULT(UnlitMeshColorGoesToMaterial, osmesa, must, "EV-CMAT-UNLIT",
              "with COLOR_MATERIAL on the colour of a mesh goes to the material alone, lit or not") {
  meshes(in, [](GLenum, auto go) {
    if (is_on(GL_COLOR_MATERIAL) && !is_on(GL_LIGHTING))
      without(GL_MAP1_COLOR_4, go);
    else
      go();
  });
}

EVALCTS_FAULT(UnlitPrimitiveColorGoesToMaterial, osmesa, must, "EV-CMAT-UNLIT",
              "with COLOR_MATERIAL on EvalCoord gives the vertex no colour, lit or not") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL) && !is_on(GL_LIGHTING) && is_on(GL_MAP1_COLOR_4);
    if (memory.flag) sound.Disable(GL_MAP1_COLOR_4);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_MAP1_COLOR_4);
  };
}

EVALCTS_FAULT(SurfaceMeshAlwaysTracksColors, osmesa, must, "EV-CMAT-OFF/2-D",
              "EvalMesh2 is lit with evaluated colours though COLOR_MATERIAL is off") {
  mesh2(in, [](auto call) {
    const bool turn_on = is_on(GL_LIGHTING) && !is_on(GL_COLOR_MATERIAL);
    if (turn_on) sound.Enable(GL_COLOR_MATERIAL);
    go2(call);
    if (turn_on) sound.Disable(GL_COLOR_MATERIAL);
  });
}

EVALCTS_FAULT(UnlitSurfaceMeshHasCurrentColor, osmesa, must, "EV-CMAT-UNLIT/2-D",
              "an unlit EvalMesh2 with COLOR_MATERIAL on has the current colour") {
  mesh2(in, [](auto call) {
    if (!is_on(GL_COLOR_MATERIAL) || is_on(GL_LIGHTING)) return go2(call);
    without(GL_MAP2_COLOR_4, [call] { go2(call); });
  });
}

// --- No vertex map -----------------------------------------------------------------------------------------

void track_first_color() {
  GLfloat points[64 * 4];
  sound.GetMapfv(GL_MAP1_COLOR_4, GL_COEFF, points);
  sound.Color4fv(points);
}

bool only_colors() { return is_on(GL_MAP1_COLOR_4) && is_on(GL_COLOR_MATERIAL) && !evaluates(); }

EVALCTS_FAULT(MeshWithoutVerticesTracks, osmesa, must, "EV-CMAT-NOVERTEX",
              "EvalMesh1 without a vertex map leaves its first colour in the tracked material") {
  mesh1(in, [](auto call) {
    if (only_colors()) track_first_color();
    go1(call);
  });
}

EVALCTS_FAULT(SurfaceMeshWithoutVerticesTracks, osmesa, must, "EV-CMAT-NOVERTEX/2-D",
              "EvalMesh2 without a vertex map leaves its first colour in the tracked material") {
  mesh2(in, [](auto call) {
    if (is_on(GL_MAP2_COLOR_4) && is_on(GL_COLOR_MATERIAL) && !evaluates()) {
      std::vector<GLfloat> points(64 * 64 * 4);
      sound.GetMapfv(GL_MAP2_COLOR_4, GL_COEFF, points.data());
      sound.Color4fv(points.data());
    }
    go2(call);
  });
}

EVALCTS_FAULT(EvalCoordWithoutVerticesTracks, osmesa, must, "EV-CMAT-NOVERTEX",
              "EvalCoord1 without a vertex map makes its colour the tracked one") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = only_colors();
    memory.numbers.assign(4 * 64, 0);
    if (memory.flag) sound.GetMapdv(GL_MAP1_COLOR_4, GL_COEFF, memory.numbers.data());
    sound.Begin(mode);
  };
  eval_coord1(in, [](auto u, auto go) {
    if (memory.flag) sound.Color4dv(memory.numbers.data());
    go(u);
  });
}

// --- What evaluation leaves as it was ----------------------------------------------------------------------

// memory.flag: evaluated colours are tracked in this primitive; memory.count: there were such.
void note_tracking(Injection& in) {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL) && is_on(GL_MAP1_COLOR_4) && evaluates();
    memory.count = 0;
    sound.Begin(mode);
  };
  eval_coord1(in, [](auto u, auto go) {
    memory.count += memory.flag;
    go(u);
  });
}

EVALCTS_FAULT(EvaluatedColorStaysInMaterial, dropin, must, "EV-CMAT-NOSTATE",
              "after EvalCoord1 with COLOR_MATERIAL the tracked material is another one") {
  note_tracking(in);
  in.gl.GetMaterialfv = [](GLenum face, GLenum property, GLfloat* v) {
    sound.GetMaterialfv(face, property, v);
    if (memory.count > 0 && (property == GL_EMISSION || property == GL_DIFFUSE)) v[0] += 0.0625f;
  };
}

EVALCTS_FAULT(EvaluatedColorStaysCurrent, dropin, must, "EV-CMAT-NOCURRENT",
              "EvalCoord1 with COLOR_MATERIAL changes the current colour") {
  note_tracking(in);
  in.gl.End = [] {
    sound.End();
    if (memory.count > 0) sound.Color4f(0.125f, 0.25f, 0.375f, 1);
  };
}

EVALCTS_FAULT(NextVertexTracksEvaluatedColor, dropin, must, "EV-CMAT-NEXT",
              "a Vertex behind EvalCoord1 is lit with another colour than the current one") {
  in.gl.Begin = [](GLenum mode) {
    memory.numbers.assign(4, 0);
    sound.GetDoublev(GL_CURRENT_COLOR, memory.numbers.data());
    memory.flag = is_on(GL_COLOR_MATERIAL) && is_on(GL_MAP1_COLOR_4) && evaluates();
    sound.Begin(mode);
  };
  eval_coord1(in, [](auto u, auto go) {
    go(u);
    if (memory.flag) sound.Color4f(1, 0.125f, 0, 1);
  });
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Color4dv(memory.numbers.data());
  };
}

}  // namespace
}  // namespace evalcts::faults::lighting
