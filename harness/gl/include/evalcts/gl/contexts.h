// Commands of the harness that make another context current, so that a case may use several.
#pragma once

#include <GL/gl.h>

extern "C" {

// Makes context `context` of the case current: 0 is the one that it begins with, any other is made in its
// initial state when it is first named (less than 8: C programs have room for as many). All live until the
// case is over; the player goes back to context 0. Never called between Begin and End.
void glOtherContextEVALCTS(GLuint context);

// The same; a context that is made now shares objects (display lists, textures) with context 0.
void glSharingContextEVALCTS(GLuint context);

// The same; a context that is made now is of this kind. Not every implementation makes every kind.
enum {
  EVALCTS_CORE_PROFILE = 1,    // 3.2 at least
  EVALCTS_FORWARD_COMPATIBLE,  // 3.1, without what is deprecated in 3.0
  EVALCTS_DEBUG,               // compatibility profile, debug context
  EVALCTS_NO_ERROR             // compatibility profile, KHR_no_error
};
void glContextOfKindEVALCTS(GLuint context, GLuint kind);

// Copies the state that belongs to the attribute groups of the mask from one context of the case, which is
// current afterwards, to another, which is not current (glXCopyContext: GLX 1.4 section 3.3.7).
void glCopyContextEVALCTS(GLuint from, GLuint to, GLbitfield mask);
}
