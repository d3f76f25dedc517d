// Commands of the harness that record the requests of an indirect GLX context to its X server.
#pragma once

#include <GL/gl.h>

extern "C" {

// Starts to record the GLX requests of the case. Must not be called between Begin and End.
void glRecordRequestsEVALCTS(void);

// Stops recording. Fills `requests` with up to `size` bytes of the recorded GLX requests, complete, in order,
// and in this machine's byte order. Returns their total number of bytes. Must not be called between Begin and
// End.
GLsizei glRecordedRequestsEVALCTS(GLsizei size, GLubyte* requests);
}
