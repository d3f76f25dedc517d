// The commands that set the current values that maps can replace, in all forms of the GL: X(attribute,
// command, number of values, largest number of values, letter of the type, type).
#pragma once

// clang-format off
#define DROPIN_TYPES_OF_COLORS(X, n)                                                        \
  X(kColor, Color, n, 4, b, GLbyte) X(kColor, Color, n, 4, d, GLdouble)                     \
  X(kColor, Color, n, 4, f, GLfloat) X(kColor, Color, n, 4, i, GLint)                       \
  X(kColor, Color, n, 4, s, GLshort) X(kColor, Color, n, 4, ub, GLubyte)                    \
  X(kColor, Color, n, 4, ui, GLuint) X(kColor, Color, n, 4, us, GLushort)
#define DROPIN_TYPES_OF_COORDINATES(X, attribute, command, n, most)                         \
  X(attribute, command, n, most, d, GLdouble) X(attribute, command, n, most, f, GLfloat)    \
  X(attribute, command, n, most, i, GLint) X(attribute, command, n, most, s, GLshort)

#define DROPIN_SETTERS(X)                                                                   \
  DROPIN_TYPES_OF_COLORS(X, 3) DROPIN_TYPES_OF_COLORS(X, 4)                                 \
  X(kNormal, Normal, 3, 3, b, GLbyte) DROPIN_TYPES_OF_COORDINATES(X, kNormal, Normal, 3, 3) \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, TexCoord, 1, 4)                                 \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, TexCoord, 2, 4)                                 \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, TexCoord, 3, 4)                                 \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, TexCoord, 4, 4)

// Setters whose first argument is the texture unit.
#define DROPIN_UNIT_SETTERS(X)                                                              \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, MultiTexCoord, 1, 4)                            \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, MultiTexCoord, 2, 4)                            \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, MultiTexCoord, 3, 4)                            \
  DROPIN_TYPES_OF_COORDINATES(X, kTexCoord, MultiTexCoord, 4, 4)

// Setters of packed values, whose first argument is the type: X(attribute, command).
#define DROPIN_PACKED_SETTERS(X)                                                            \
  X(kColor, ColorP3ui) X(kColor, ColorP4ui) X(kNormal, NormalP3ui)                          \
  X(kTexCoord, TexCoordP1ui) X(kTexCoord, TexCoordP2ui) X(kTexCoord, TexCoordP3ui)          \
  X(kTexCoord, TexCoordP4ui)
#define DROPIN_PACKED_UNIT_SETTERS(X)                                                       \
  X(MultiTexCoordP1ui) X(MultiTexCoordP2ui) X(MultiTexCoordP3ui) X(MultiTexCoordP4ui)
// clang-format on
