// Commands of the harness that record what an indirect GLX context sends to its X server.
#pragma once

#include <GL/gl.h>

extern "C" {

// From here on the GLX requests of the case are kept. Never called between Begin and End.
void glRecordRequestsEVALCTS(void);

// Ends that. Fills `requests` with the GLX requests since then, whole, in their order and in this machine's
// byte order, as far as `size` bytes go; returns how many bytes they are. Never called between Begin and End.
GLsizei glRecordedRequestsEVALCTS(GLsizei size, GLubyte* requests);
}
