// Commands of the harness that make another context current, so that a case may use several, or move one to
// another thread.
#pragma once

#include <GL/gl.h>

extern "C" {

// Makes context number `context` of the case current. Context 0 is the initial one. Any other (up to 7, the
// limit of C programs) is created in its initial state when it is first used. All contexts exist until the
// case ends; the player then returns to context 0. Must not be called between Begin and End.
void glOtherContextEVALCTS(GLuint context);

// Like glOtherContextEVALCTS, but a new context shares objects (display lists, textures) with context 0.
void glSharingContextEVALCTS(GLuint context);

// Kinds of contexts. An implementation need not support every kind.
enum {
  EVALCTS_CORE_PROFILE = 1,    // core profile of GL 3.2 or newer
  EVALCTS_FORWARD_COMPATIBLE,  // GL 3.1, without the deprecated features of GL 3.0
  EVALCTS_DEBUG,               // compatibility profile, debug context
  EVALCTS_NO_ERROR,            // compatibility profile, KHR_no_error
  EVALCTS_COLOR_INDEX          // RGBA_MODE is false
};
// Like glOtherContextEVALCTS, but a new context is of this kind.
void glContextOfKindEVALCTS(GLuint context, GLuint kind);

// Copies the state of the attribute groups in the mask from one context of the case, which becomes current,
// to another, which is not current (glXCopyContext: GLX 1.4 section 3.3.7).
void glCopyContextEVALCTS(GLuint from, GLuint to, GLbitfield mask);

// Moves context 0, which must be current and not between Begin and End, to another thread (1), or back to the
// thread of the first command (0), which issues the next commands. Thread 1 ends when the context leaves it.
// The player does this; a table has the entry point if its contexts can move.
void glMoveToThreadEVALCTS(GLuint thread);
}
