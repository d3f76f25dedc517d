// The window systems tell which context is current and which contexts share their lists.
#pragma once

namespace glev::dropin {

class Context;

// Handles are those of GLX, EGL or OSMesa. `shared`: of a context to share with, or null.
void note_created(const void* handle, const void* shared);
void note_destroyed(const void* handle);
// In this thread; null for none.
void note_current(const void* handle);
Context* context_of(const void* handle);

// The handle of what is current in this thread, by the word of the window systems below; null for none.
const void* ask_for_current();

}  // namespace glev::dropin
