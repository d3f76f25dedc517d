// The forms of the commands that give vertices and current values (GL 2.1 sections 2.6.2 and 2.7). Components
// that are not given are 0, or 1 for w, alpha and q.

#include <reference/specification.h>

namespace evalcts::reference {

// Commands of n numbers in four forms: f and d take the numbers as a, b, c and d; fv and dv take an array of
// numbers, and a null array has no effect.
#define NUMBERS_1(T) T a
#define NUMBERS_2(T) T a, T b
#define NUMBERS_3(T) T a, T b, T c
#define NUMBERS_4(T) T a, T b, T c, T d
#define ELEMENTS_1 v[0]
#define ELEMENTS_2 v[0], v[1]
#define ELEMENTS_3 v[0], v[1], v[2]
#define ELEMENTS_4 v[0], v[1], v[2], v[3]
#define FORMS_OF_TYPE(name, n, letter, T, ...)                      \
  void Specification::name##letter(NUMBERS_##n(T)) { __VA_ARGS__; } \
  void Specification::name##letter##v(const T* v) {                 \
    if (v != nullptr) name##letter(ELEMENTS_##n);                   \
  }
#define FORMS(name, n, ...)                       \
  FORMS_OF_TYPE(name, n, f, GLfloat, __VA_ARGS__) \
  FORMS_OF_TYPE(name, n, d, GLdouble, __VA_ARGS__)
#define FORMS_OF_UNIT_OF_TYPE(name, n, letter, T, ...)                              \
  void Specification::name##letter(GLenum texture, NUMBERS_##n(T)) { __VA_ARGS__; } \
  void Specification::name##letter##v(GLenum texture, const T* v) {                 \
    if (v != nullptr) name##letter(texture, ELEMENTS_##n);                          \
  }
#define FORMS_OF_UNIT(name, n, ...)                       \
  FORMS_OF_UNIT_OF_TYPE(name, n, f, GLfloat, __VA_ARGS__) \
  FORMS_OF_UNIT_OF_TYPE(name, n, d, GLdouble, __VA_ARGS__)

FORMS(Vertex2, 2, vertex(a, b, 0, 1))
FORMS(Vertex3, 3, vertex(a, b, c, 1))
FORMS(Vertex4, 4, vertex(a, b, c, d))
FORMS(Color3, 3, color(a, b, c, 1))
FORMS(Color4, 4, color(a, b, c, d))
FORMS(Normal3, 3, normal(a, b, c))
FORMS(TexCoord1, 1, texture_coordinate(GL_TEXTURE0, a, 0, 0, 1))
FORMS(TexCoord2, 2, texture_coordinate(GL_TEXTURE0, a, b, 0, 1))
FORMS(TexCoord3, 3, texture_coordinate(GL_TEXTURE0, a, b, c, 1))
FORMS(TexCoord4, 4, texture_coordinate(GL_TEXTURE0, a, b, c, d))
FORMS_OF_UNIT(MultiTexCoord1, 1, texture_coordinate(texture, a, 0, 0, 1))
FORMS_OF_UNIT(MultiTexCoord2, 2, texture_coordinate(texture, a, b, 0, 1))
FORMS_OF_UNIT(MultiTexCoord3, 3, texture_coordinate(texture, a, b, c, 1))
FORMS_OF_UNIT(MultiTexCoord4, 4, texture_coordinate(texture, a, b, c, d))
FORMS(Index, 1, index(a))

void Specification::EdgeFlagv(const GLboolean* flag) {
  if (flag != nullptr) EdgeFlag(flag[0]);
}

}  // namespace evalcts::reference
