// The commands that set current values which maps can replace. They are passed on, and recorded if the values
// may have to be restored.
#include <limits>

#include "context.h"

using namespace glev::dropin;  // NOLINT(google-build-using-namespace): what follows is C

namespace {

// Returns the context if it must record the value, otherwise null.
Context* watching_context() {
  if (!evaluators_used && !lists_used) return nullptr;
  Context* const context = current_context();
  return context != nullptr && context->is_watching() ? context : nullptr;
}

template <class Values>
Setter make_setter(void (*send)(const void*), const Values& values) {
  static_assert(sizeof values <= sizeof(Setter::values));
  Setter setter;
  setter.send = send;
  std::memcpy(setter.values, &values, sizeof values);
  return setter;
}

// The values of a command, completed with those of (0, 0, 0, 1). For colours, the 1 of an integer type is its
// largest value.
template <class Type, int kMost>
struct Complete {
  Complete(Attribute attribute, int count, const Type* v) : of{} {
    of[kMost - 1] =
        attribute == kColor && std::is_integral_v<Type> ? std::numeric_limits<Type>::max() : Type(1);
    std::memcpy(of, v, static_cast<std::size_t>(count) * sizeof(Type));
  }
  Type of[kMost];
};

// Mesa may keep the last values of one command for the next command, if that has fewer. So once evaluators
// are used, values are always sent by the form with the most values.
template <auto kCommand, auto kLongest, int kCount, int kMost, class Type>
void set(Attribute attribute, const Type* v) {
  Context* const context = watching_context();
  if (context == nullptr && !evaluators_used) return (gl_below().*kCommand)(v);
  const Complete<Type, kMost> values(attribute, kCount, v);
  if (evaluators_used)
    (gl_below().*kLongest)(values.of);
  else
    (gl_below().*kCommand)(v);
  if (context != nullptr)
    context->note(
        attribute,
        make_setter([](const void* kept) { (gl_below().*kLongest)(static_cast<const Type*>(kept)); },
                    values));
}

// Only unit 0 is recorded, because maps replace only its texture coordinates.
template <auto kCommand, auto kLongest, int kCount, class Type>
void set_unit(GLenum unit, const Type* v) {
  Context* const context = unit == GL_TEXTURE0 ? watching_context() : nullptr;
  if (context == nullptr && !evaluators_used) return (gl_below().*kCommand)(unit, v);
  const Complete<Type, 4> values(kTexCoord, kCount, v);
  if (evaluators_used)
    (gl_below().*kLongest)(unit, values.of);
  else
    (gl_below().*kCommand)(unit, v);
  if (context != nullptr)
    context->note(kTexCoord, make_setter(
                                 [](const void* kept) {
                                   (gl_below().*kLongest)(GL_TEXTURE0, static_cast<const Type*>(kept));
                                 },
                                 values));
}

struct Packed {
  GLenum type;
  GLuint value;
};

template <auto kCommand>
void set_packed(Attribute attribute, GLenum type, GLuint value) {
  (gl_below().*kCommand)(type, value);
  if (Context* const context = watching_context())
    context->note(attribute, make_setter(
                                 [](const void* kept) {
                                   const auto* const packed = static_cast<const Packed*>(kept);
                                   (gl_below().*kCommand)(packed->type, packed->value);
                                 },
                                 Packed{type, value}));
}

template <auto kCommand>
void set_packed_unit(GLenum unit, GLenum type, GLuint value) {
  (gl_below().*kCommand)(unit, type, value);
  Context* const context = unit == GL_TEXTURE0 ? watching_context() : nullptr;
  if (context == nullptr) return;
  context->note(kTexCoord, make_setter(
                               [](const void* kept) {
                                 const auto* const packed = static_cast<const Packed*>(kept);
                                 (gl_below().*kCommand)(GL_TEXTURE0, packed->type, packed->value);
                               },
                               Packed{type, value}));
}

}  // namespace

#define PARAMETERS_1(type) type x
#define PARAMETERS_2(type) type x, type y
#define PARAMETERS_3(type) type x, type y, type z
#define PARAMETERS_4(type) type x, type y, type z, type w
#define VALUES_1 x
#define VALUES_2 x, y
#define VALUES_3 x, y, z
#define VALUES_4 x, y, z, w

#define X(attribute, command, n, most, letter, type)                                                 \
  DROPIN_EXPORT void gl##command##n##letter##v(const type* v) {                                      \
    set<&GlBelow::command##n##letter##v, &GlBelow::command##most##letter##v, n, most>(attribute, v); \
  }                                                                                                  \
  DROPIN_EXPORT void gl##command##n##letter(PARAMETERS_##n(type)) {                                  \
    const type v[] = {VALUES_##n};                                                                   \
    set<&GlBelow::command##n##letter##v, &GlBelow::command##most##letter##v, n, most>(attribute, v); \
  }
DROPIN_SETTERS(X)
#undef X

#define X(attribute, command, n, most, letter, type)                                           \
  DROPIN_EXPORT void gl##command##n##letter##v(GLenum unit, const type* v) {                   \
    set_unit<&GlBelow::command##n##letter##v, &GlBelow::command##most##letter##v, n>(unit, v); \
  }                                                                                            \
  DROPIN_EXPORT void gl##command##n##letter(GLenum unit, PARAMETERS_##n(type)) {               \
    const type v[] = {VALUES_##n};                                                             \
    set_unit<&GlBelow::command##n##letter##v, &GlBelow::command##most##letter##v, n>(unit, v); \
  }                                                                                            \
  DROPIN_EXPORT void gl##command##n##letter##vARB(GLenum unit, const type* v) {                \
    set_unit<&GlBelow::command##n##letter##v, &GlBelow::command##most##letter##v, n>(unit, v); \
  }                                                                                            \
  DROPIN_EXPORT void gl##command##n##letter##ARB(GLenum unit, PARAMETERS_##n(type)) {          \
    gl##command##n##letter(unit, VALUES_##n);                                                  \
  }
DROPIN_UNIT_SETTERS(X)
#undef X

#define X(attribute, command)                                 \
  DROPIN_EXPORT void gl##command(GLenum type, GLuint value) { \
    set_packed<&GlBelow::command>(attribute, type, value);    \
  }                                                           \
  DROPIN_EXPORT void gl##command##v(GLenum type, const GLuint* value) { gl##command(type, *value); }
DROPIN_PACKED_SETTERS(X)
#undef X

#define X(command)                                                                   \
  DROPIN_EXPORT void gl##command(GLenum unit, GLenum type, GLuint value) {           \
    set_packed_unit<&GlBelow::command>(unit, type, value);                           \
  }                                                                                  \
  DROPIN_EXPORT void gl##command##v(GLenum unit, GLenum type, const GLuint* value) { \
    gl##command(unit, type, *value);                                                 \
  }
DROPIN_PACKED_UNIT_SETTERS(X)
#undef X
