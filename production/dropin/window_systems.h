// The window systems tell which context is current and which contexts share their lists.
#pragma once

namespace glev::dropin {

class Context;

// Handles are those of GLX, EGL or OSMesa. `shared`: of a context to share with, or null.
void NoteCreated(const void* handle, const void* shared);
void NoteDestroyed(const void* handle);
// In this thread; null for none.
void NoteCurrent(const void* handle);
Context* ContextOf(const void* handle);

// The handle of what is current in this thread, by the word of the window systems below; null for none.
const void* AskForCurrent();

}  // namespace glev::dropin
