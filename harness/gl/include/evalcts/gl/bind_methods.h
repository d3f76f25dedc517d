// Entry points of implementations in this process. They are plain functions without a context argument, so
// each forwards to the current context.
#pragma once

#include <evalcts/gl/table.h>

namespace evalcts {

// Defines the plain function `call` that forwards to `kFunction`. Owner::current is the context of the call
// and must not be null.
template <class Owner, auto kFunction>
struct Forward;

// Binds methods of a context object.
template <class Owner, class Class, class Result, class... Parameters,
          Result (Class::*kMethod)(Parameters...)>
struct Forward<Owner, kMethod> {
  static Result call(Parameters... parameters) { return (Owner::current->*kMethod)(parameters...); }
};

// Binds C functions whose first argument is the context.
template <class Owner, class Handle, class Result, class... Parameters,
          Result (*kFunction)(Handle*, Parameters...)>
struct Forward<Owner, kFunction> {
  static Result call(Parameters... parameters) { return kFunction(Owner::current, parameters...); }
};

// Returns a table with every command of entry_points.def for which `Class` has a method of the same name.
template <class Owner, class Class>
gl::Table bind_methods() {
  gl::Table table;
#define GL_ENTRY(name, kinds) \
  if constexpr (requires { &Class::name; }) table.name = &Forward<Owner, &Class::name>::call;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  return table;
}

}  // namespace evalcts
