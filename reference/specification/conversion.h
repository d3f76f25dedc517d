// Conversions between the types of commands, state and queries (GL 2.1 sections 2.1.1 and 6.1.2).
#pragma once

#include <GL/gl.h>

#include <vector>

namespace evalcts::reference {

// Returns a double argument as it is kept in single-precision state: correctly rounded, infinite beyond the
// range.
GLfloat to_single(GLdouble value);

// Convert answers of queries. A value beyond the range of the type becomes the nearest representable value.
GLboolean to_boolean(GLdouble value);  // zero is FALSE, all else TRUE
GLfloat to_float(GLdouble value);
GLint to_integer(GLdouble value);             // rounded to nearest, ties to even; NaN gives 0
GLint normalized_to_integer(GLdouble value);  // colours and normals: [-1,1] to the whole range (table 2.9)

// Return all integers that a conversion may give, the one of the functions above first: n + 1/2 is rounded up
// or down, and [-1,1] is mapped by the rule of table 2.9 or by that of GL 4.2 (section 2.3.4), with 0 as 0.
std::vector<GLint> permitted_integers(GLdouble value);
std::vector<GLint> permitted_normalized_integers(GLdouble value);

}  // namespace evalcts::reference
