// Calls to the window systems show which context is current and which contexts share lists.
#pragma once

namespace glev::dropin {

class Context;

// Note that a context was made or destroyed. Handles are those of GLX, EGL or OSMesa. `shared`: handle of the
// context to share lists with, or null.
void note_created(const void* handle, const void* shared);
void note_destroyed(const void* handle);
// Notes that a context is current in this thread; null for none.
void note_current(const void* handle);
Context* context_of(const void* handle);

// Asks the window systems below for the current context of this thread. Returns its handle; null if there is
// none.
const void* ask_for_current();

}  // namespace glev::dropin
