// Implementations inside this process: entry points are plain functions without a context argument, so each
// forwards to the context that is current.
#pragma once

#include <evalcts/gl/table.h>

namespace evalcts {

// Owner::current is the context that the forwarded calls act on; null outside its life.
template <class Owner, auto Function>
struct Forward;

// Methods of a context object.
template <class Owner, class Class, class Result, class... Parameters, Result (Class::*method)(Parameters...)>
struct Forward<Owner, method> {
  static Result call(Parameters... parameters) { return (Owner::current->*method)(parameters...); }
};

// Fills in every command of entry_points.def that `Class` has a method for.
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
