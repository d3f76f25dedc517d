// Conversions between the types of commands, state and queries (GL 2.1 sections 2.1.1 and 6.1.2).
#pragma once

#include <GL/gl.h>

namespace evalcts::reference {

// Returns a double argument as it is kept in single-precision state: correctly rounded, infinite beyond the
// range.
GLfloat to_single(GLdouble value);

// Convert answers of queries. A value beyond the range of the type becomes the nearest representable value.
GLboolean to_boolean(GLdouble value);  // zero is FALSE, all else TRUE
GLfloat to_float(GLdouble value);
GLint to_integer(GLdouble value);             // rounded to nearest, ties to even; NaN gives 0
GLint normalized_to_integer(GLdouble value);  // colours and normals: [-1,1] to the whole range (table 2.9)

}  // namespace evalcts::reference
