// The forms of the commands that give vertices and current values (GL 2.1 sections 2.6.2 and 2.7). Components
// that are not given are 0, or 1 for w, alpha and q.

#include <reference/specification.h>

namespace evalcts::reference {

void Specification::Vertex2f(GLfloat x, GLfloat y) { vertex(x, y, 0, 1); }
void Specification::Vertex3f(GLfloat x, GLfloat y, GLfloat z) { vertex(x, y, z, 1); }
void Specification::Vertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w) { vertex(x, y, z, w); }
void Specification::Vertex2d(GLdouble x, GLdouble y) { vertex(x, y, 0, 1); }
void Specification::Vertex3d(GLdouble x, GLdouble y, GLdouble z) { vertex(x, y, z, 1); }
void Specification::Vertex4d(GLdouble x, GLdouble y, GLdouble z, GLdouble w) { vertex(x, y, z, w); }
void Specification::Vertex2fv(const GLfloat* v) {
  if (v != nullptr) Vertex2f(v[0], v[1]);
}
void Specification::Vertex3fv(const GLfloat* v) {
  if (v != nullptr) Vertex3f(v[0], v[1], v[2]);
}
void Specification::Vertex4fv(const GLfloat* v) {
  if (v != nullptr) Vertex4f(v[0], v[1], v[2], v[3]);
}
void Specification::Vertex2dv(const GLdouble* v) {
  if (v != nullptr) Vertex2d(v[0], v[1]);
}
void Specification::Vertex3dv(const GLdouble* v) {
  if (v != nullptr) Vertex3d(v[0], v[1], v[2]);
}
void Specification::Vertex4dv(const GLdouble* v) {
  if (v != nullptr) Vertex4d(v[0], v[1], v[2], v[3]);
}

void Specification::Color3f(GLfloat red, GLfloat green, GLfloat blue) { color(red, green, blue, 1); }
void Specification::Color4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha) {
  color(red, green, blue, alpha);
}
void Specification::Color3d(GLdouble red, GLdouble green, GLdouble blue) { color(red, green, blue, 1); }
void Specification::Color4d(GLdouble red, GLdouble green, GLdouble blue, GLdouble alpha) {
  color(red, green, blue, alpha);
}
void Specification::Color3fv(const GLfloat* v) {
  if (v != nullptr) Color3f(v[0], v[1], v[2]);
}
void Specification::Color4fv(const GLfloat* v) {
  if (v != nullptr) Color4f(v[0], v[1], v[2], v[3]);
}
void Specification::Color3dv(const GLdouble* v) {
  if (v != nullptr) Color3d(v[0], v[1], v[2]);
}
void Specification::Color4dv(const GLdouble* v) {
  if (v != nullptr) Color4d(v[0], v[1], v[2], v[3]);
}

void Specification::Normal3f(GLfloat x, GLfloat y, GLfloat z) { normal(x, y, z); }
void Specification::Normal3d(GLdouble x, GLdouble y, GLdouble z) { normal(x, y, z); }
void Specification::Normal3fv(const GLfloat* v) {
  if (v != nullptr) Normal3f(v[0], v[1], v[2]);
}
void Specification::Normal3dv(const GLdouble* v) {
  if (v != nullptr) Normal3d(v[0], v[1], v[2]);
}

void Specification::TexCoord1f(GLfloat s) { texture_coordinate(GL_TEXTURE0, s, 0, 0, 1); }
void Specification::TexCoord2f(GLfloat s, GLfloat t) { texture_coordinate(GL_TEXTURE0, s, t, 0, 1); }
void Specification::TexCoord3f(GLfloat s, GLfloat t, GLfloat r) {
  texture_coordinate(GL_TEXTURE0, s, t, r, 1);
}
void Specification::TexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  texture_coordinate(GL_TEXTURE0, s, t, r, q);
}
void Specification::TexCoord1d(GLdouble s) { texture_coordinate(GL_TEXTURE0, s, 0, 0, 1); }
void Specification::TexCoord2d(GLdouble s, GLdouble t) { texture_coordinate(GL_TEXTURE0, s, t, 0, 1); }
void Specification::TexCoord3d(GLdouble s, GLdouble t, GLdouble r) {
  texture_coordinate(GL_TEXTURE0, s, t, r, 1);
}
void Specification::TexCoord4d(GLdouble s, GLdouble t, GLdouble r, GLdouble q) {
  texture_coordinate(GL_TEXTURE0, s, t, r, q);
}
void Specification::TexCoord1fv(const GLfloat* v) {
  if (v != nullptr) TexCoord1f(v[0]);
}
void Specification::TexCoord2fv(const GLfloat* v) {
  if (v != nullptr) TexCoord2f(v[0], v[1]);
}
void Specification::TexCoord3fv(const GLfloat* v) {
  if (v != nullptr) TexCoord3f(v[0], v[1], v[2]);
}
void Specification::TexCoord4fv(const GLfloat* v) {
  if (v != nullptr) TexCoord4f(v[0], v[1], v[2], v[3]);
}
void Specification::TexCoord1dv(const GLdouble* v) {
  if (v != nullptr) TexCoord1d(v[0]);
}
void Specification::TexCoord2dv(const GLdouble* v) {
  if (v != nullptr) TexCoord2d(v[0], v[1]);
}
void Specification::TexCoord3dv(const GLdouble* v) {
  if (v != nullptr) TexCoord3d(v[0], v[1], v[2]);
}
void Specification::TexCoord4dv(const GLdouble* v) {
  if (v != nullptr) TexCoord4d(v[0], v[1], v[2], v[3]);
}

void Specification::MultiTexCoord1f(GLenum texture, GLfloat s) { texture_coordinate(texture, s, 0, 0, 1); }
void Specification::MultiTexCoord2f(GLenum texture, GLfloat s, GLfloat t) {
  texture_coordinate(texture, s, t, 0, 1);
}
void Specification::MultiTexCoord3f(GLenum texture, GLfloat s, GLfloat t, GLfloat r) {
  texture_coordinate(texture, s, t, r, 1);
}
void Specification::MultiTexCoord4f(GLenum texture, GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  texture_coordinate(texture, s, t, r, q);
}
void Specification::MultiTexCoord1d(GLenum texture, GLdouble s) { texture_coordinate(texture, s, 0, 0, 1); }
void Specification::MultiTexCoord2d(GLenum texture, GLdouble s, GLdouble t) {
  texture_coordinate(texture, s, t, 0, 1);
}
void Specification::MultiTexCoord3d(GLenum texture, GLdouble s, GLdouble t, GLdouble r) {
  texture_coordinate(texture, s, t, r, 1);
}
void Specification::MultiTexCoord4d(GLenum texture, GLdouble s, GLdouble t, GLdouble r, GLdouble q) {
  texture_coordinate(texture, s, t, r, q);
}
void Specification::MultiTexCoord1fv(GLenum texture, const GLfloat* v) {
  if (v != nullptr) MultiTexCoord1f(texture, v[0]);
}
void Specification::MultiTexCoord2fv(GLenum texture, const GLfloat* v) {
  if (v != nullptr) MultiTexCoord2f(texture, v[0], v[1]);
}
void Specification::MultiTexCoord3fv(GLenum texture, const GLfloat* v) {
  if (v != nullptr) MultiTexCoord3f(texture, v[0], v[1], v[2]);
}
void Specification::MultiTexCoord4fv(GLenum texture, const GLfloat* v) {
  if (v != nullptr) MultiTexCoord4f(texture, v[0], v[1], v[2], v[3]);
}
void Specification::MultiTexCoord1dv(GLenum texture, const GLdouble* v) {
  if (v != nullptr) MultiTexCoord1d(texture, v[0]);
}
void Specification::MultiTexCoord2dv(GLenum texture, const GLdouble* v) {
  if (v != nullptr) MultiTexCoord2d(texture, v[0], v[1]);
}
void Specification::MultiTexCoord3dv(GLenum texture, const GLdouble* v) {
  if (v != nullptr) MultiTexCoord3d(texture, v[0], v[1], v[2]);
}
void Specification::MultiTexCoord4dv(GLenum texture, const GLdouble* v) {
  if (v != nullptr) MultiTexCoord4d(texture, v[0], v[1], v[2], v[3]);
}

void Specification::Indexf(GLfloat c) { index(c); }
void Specification::Indexd(GLdouble c) { index(c); }
void Specification::Indexfv(const GLfloat* c) {
  if (c != nullptr) index(c[0]);
}
void Specification::Indexdv(const GLdouble* c) {
  if (c != nullptr) index(c[0]);
}
void Specification::EdgeFlagv(const GLboolean* flag) {
  if (flag != nullptr) EdgeFlag(flag[0]);
}

}  // namespace evalcts::reference
