// Writes the part of a C program that makes the contexts.
#pragma once

#include <string>

#include <evalcts/gl/c_program.h>

namespace evalcts::gl {

// Returns C that defines
//   static void make_context(const char *path);       opens the library at `path`, or exits with code 2
//   static void use_context(GLuint number, int how);  see contexts.h
//   static void *address_of(const char *name);        returns the address of a GL command, or null
// `how` is 0 for a context like the first, 1 for a context that shares objects with the first, and 1 + KIND
// for a context of that kind. For "production", make_context has no argument and there is no address_of.
// Throws NoCProgram.
std::string c_contexts(const CProgram& program);

}  // namespace evalcts::gl
