// The part of a C program that makes the context.
#pragma once

#include <string>

#include <evalcts/gl/c_program.h>

namespace evalcts::gl {

// Returns C that defines
//   static void make_context(const char *path);          the library under test; exits with code 2 on failure
//   static void use_context(GLuint number, int how);     see contexts.h; how: 0 a context like the first, 1
//   one that
//                                                        shares with it, 1 + KIND one of that kind
//   static void *address_of(const char *name);           of a GL command, or null
// For "production" make_context has no argument, and there is no address_of. Throws NoCProgram.
std::string c_contexts(const CProgram& program);

}  // namespace evalcts::gl
