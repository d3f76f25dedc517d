// The GL-named entry points. They convert the forms of a command (count, type, v) to one and pass it to the
// context. Macros define the forms for both types: `f` is the letter, `real` the type.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "context.h"
#include "environment.h"
#include "outputs.h"
#include "structures.h"

using glev::widen;

namespace {

// GetMap does not know the size of the array.
constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

bool rejected(glev_context* context, const void* v) {
  if (v == nullptr) context->issue<&glev_context::record_error>(glev_enum{GLEV_INVALID_VALUE});
  return v == nullptr;
}

double widened(float x) { return widen(x); }
double widened(double x) { return x; }

// This is a separate function so that the fast path has a small stack frame.
template <class Real>
[[gnu::noinline]] void issue_eval_coord(glev_context* context, int dimension, Real u, Real v) {
  context->issue<&glev_context::eval_coord>(dimension, widened(u), widened(v));
}

void set_grid(glev_context* context, int dimension, const std::array<glev::Grid, 2>& grid) {
  context->issue<&glev_context::set_grid>(dimension, grid);
}

template <class Real>
void eval_coord(glev_context* context, Real u) {
  if (!glev::is_subnormal(u) && context->eval_directly(1, u, 0)) return;
  issue_eval_coord<Real>(context, 1, u, 0);
}

template <class Real>
void eval_coord(glev_context* context, Real u, Real v) {
  if (!glev::is_subnormal(u) && !glev::is_subnormal(v) && context->eval_directly(2, u, v)) return;
  issue_eval_coord(context, 2, u, v);
}

// Issues a command that sets kSize floats: kCount values at v, completed with those of (0, 0, 0, 1). `first`:
// the arguments before them.
template <auto kMethod, std::size_t kSize, std::size_t kCount, class Real, class... First>
void issue_floats(glev_context* context, const Real* v, First... first) {
  if (rejected(context, v)) return;
  std::array<float, kSize> values{};
  if constexpr (kSize == 4) values[3] = 1;
  for (std::size_t k = 0; k < kCount; ++k) values[k] = static_cast<float>(v[k]);
  context->issue<kMethod>(first..., values);
}

}  // namespace

// ---- Names of results and errors

const char* glevGetResultString(glev_result result) {
  switch (glev::number_of(result)) {
#define GLEV_CASE(name) \
  case name:            \
    return #name
    GLEV_CASE(GLEV_SUCCESS);
    GLEV_CASE(GLEV_ERROR_INVALID_ARGUMENT);
    GLEV_CASE(GLEV_ERROR_UNSUPPORTED);
    GLEV_CASE(GLEV_ERROR_OUT_OF_MEMORY);
    GLEV_CASE(GLEV_ERROR_IN_PRIMITIVE);
    GLEV_CASE(GLEV_ERROR_NO_MAP);
    GLEV_CASE(GLEV_ERROR_BUFFER_TOO_SMALL);
    GLEV_CASE(GLEV_ERROR_OVERLAP);
    GLEV_CASE(GLEV_ERROR_STRUCTURE_SIZE);
  }
  return "unknown result";
}

const char* glevGetErrorString(glev_enum error) {
  switch (error) {
    GLEV_CASE(GLEV_NO_ERROR);
    GLEV_CASE(GLEV_INVALID_ENUM);
    GLEV_CASE(GLEV_INVALID_VALUE);
    GLEV_CASE(GLEV_INVALID_OPERATION);
    GLEV_CASE(GLEV_STACK_OVERFLOW);
    GLEV_CASE(GLEV_STACK_UNDERFLOW);
    GLEV_CASE(GLEV_OUT_OF_MEMORY);
#undef GLEV_CASE
  }
  return "unknown error";
}

// ---- Contexts, sink, errors

const char* glevGetTargetName(size_t index) {
  const glev::Kernels* kernels = glev::kernels_of(index);
  return kernels != nullptr ? kernels->name : nullptr;
}

glev_result glevCreateContext(const glev_context_info* given, glev_context** context) {
  if (context == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  *context = nullptr;
  glev_context_info info{};
  glev_result result = given != nullptr ? glev::read_struct(given, &info) : GLEV_SUCCESS;
  glev::Allocator allocator;
  if (result == GLEV_SUCCESS) result = glev::read_allocator(info.allocator, &allocator);
  if (result != GLEV_SUCCESS) return result;
  const glev::Kernels* kernels = glev::find_kernels(info.target);
  if (kernels == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  void* memory = allocator.allocate(sizeof(glev_context), alignof(glev_context));
  if (memory == nullptr) return GLEV_ERROR_OUT_OF_MEMORY;
  *context = new (memory) glev_context(allocator, kernels);
  return GLEV_SUCCESS;
}

void glevDestroyContext(glev_context* context) {
  if (context == nullptr) return;
  const glev::Allocator allocator = context->allocator();
  context->~glev_context();
  allocator.release(context, sizeof(glev_context), alignof(glev_context));
}

glev_result glevSetSink(glev_context* context, const glev_sink* sink) { return context->set_sink(sink); }

glev_enum glevGetError(glev_context* context) { return context->get_error(); }

// ---- Maps and enables

#define GLEV_MAP(f, real)                                                                             \
  void glevMap1##f(glev_context* context, glev_enum target, real u1, real u2, glev_int stride,        \
                   glev_int order, const real* points) {                                              \
    context->issue_define_map(1, target, {{{widened(u1), widened(u2), stride, order}, {}}}, points);  \
  }                                                                                                   \
  void glevMap2##f(glev_context* context, glev_enum target, real u1, real u2, glev_int ustride,       \
                   glev_int uorder, real v1, real v2, glev_int vstride, glev_int vorder,              \
                   const real* points) {                                                              \
    context->issue_define_map(                                                                        \
        2, target,                                                                                    \
        {{{widened(u1), widened(u2), ustride, uorder}, {widened(v1), widened(v2), vstride, vorder}}}, \
        points);                                                                                      \
  }
GLEV_MAP(f, glev_float)
GLEV_MAP(d, glev_double)
#undef GLEV_MAP

#define GLEV_GET_MAP(f, type)                                                                                \
  void glevGetMap##f##v(glev_context* context, glev_enum target, glev_enum query, type* v) {                 \
    context->get_map(target, query, kUnlimited, v);                                                          \
  }                                                                                                          \
  void glevGetnMap##f##v(glev_context* context, glev_enum target, glev_enum query, glev_int size, type* v) { \
    context->get_map(target, query, size, v);                                                                \
  }
GLEV_GET_MAP(f, glev_float)
GLEV_GET_MAP(d, glev_double)
GLEV_GET_MAP(i, glev_int)
#undef GLEV_GET_MAP

void glevEnable(glev_context* context, glev_enum cap) {
  context->issue<&glev_context::set_enabled>(cap, true);
}
void glevDisable(glev_context* context, glev_enum cap) {
  context->issue<&glev_context::set_enabled>(cap, false);
}
glev_boolean glevIsEnabled(glev_context* context, glev_enum cap) {
  return context->is_enabled(cap) ? GLEV_TRUE : GLEV_FALSE;
}

// ---- Evaluation

#define GLEV_EVAL_COORD(f, real)                                                               \
  void glevEvalCoord1##f(glev_context* context, real u) { eval_coord(context, u); }            \
  void glevEvalCoord1##f##v(glev_context* context, const real* u) {                            \
    if (!rejected(context, u)) eval_coord(context, *u);                                        \
  }                                                                                            \
  void glevEvalCoord2##f(glev_context* context, real u, real v) { eval_coord(context, u, v); } \
  void glevEvalCoord2##f##v(glev_context* context, const real* u) {                            \
    if (!rejected(context, u)) eval_coord(context, u[0], u[1]);                                \
  }
GLEV_EVAL_COORD(f, glev_float)
GLEV_EVAL_COORD(d, glev_double)
#undef GLEV_EVAL_COORD

// ---- Grids and meshes

#define GLEV_MAP_GRID(f, real)                                                                     \
  void glevMapGrid1##f(glev_context* context, glev_int n, real u1, real u2) {                      \
    set_grid(context, 1, {{{widened(u1), widened(u2), n}, {}}});                                   \
  }                                                                                                \
  void glevMapGrid2##f(glev_context* context, glev_int un, real u1, real u2, glev_int vn, real v1, \
                       real v2) {                                                                  \
    set_grid(context, 2, {{{widened(u1), widened(u2), un}, {widened(v1), widened(v2), vn}}});      \
  }
GLEV_MAP_GRID(f, glev_float)
GLEV_MAP_GRID(d, glev_double)
#undef GLEV_MAP_GRID

void glevEvalPoint1(glev_context* context, glev_int i) { context->issue<&glev_context::eval_point>(1, i, 0); }
void glevEvalPoint2(glev_context* context, glev_int i, glev_int j) {
  context->issue<&glev_context::eval_point>(2, i, j);
}

void glevEvalMesh1(glev_context* context, glev_enum mode, glev_int i1, glev_int i2) {
  context->issue<&glev_context::eval_mesh1>(mode, i1, i2);
}
void glevEvalMesh2(glev_context* context, glev_enum mode, glev_int i1, glev_int i2, glev_int j1,
                   glev_int j2) {
  context->issue<&glev_context::eval_mesh2>(mode, i1, i2, j1, j2);
}

// ---- Primitives

void glevBegin(glev_context* context, glev_enum mode) { context->issue<&glev_context::begin>(mode); }
void glevEnd(glev_context* context) { context->issue<&glev_context::end>(); }

// ---- Vertices and current values

#define GLEV_PARAMETERS_1(real) real x
#define GLEV_PARAMETERS_2(real) real x, real y
#define GLEV_PARAMETERS_3(real) real x, real y, real z
#define GLEV_PARAMETERS_4(real) real x, real y, real z, real w
#define GLEV_VALUES_1 x
#define GLEV_VALUES_2 x, y
#define GLEV_VALUES_3 x, y, z
#define GLEV_VALUES_4 x, y, z, w

#define GLEV_FORMS(command, method, size, count, f, real)                              \
  void glev##command##count##f##v(glev_context* context, const real* v) {              \
    issue_floats<&glev_context::method, size, count>(context, v);                      \
  }                                                                                    \
  void glev##command##count##f(glev_context* context, GLEV_PARAMETERS_##count(real)) { \
    const real v[] = {GLEV_VALUES_##count};                                            \
    glev##command##count##f##v(context, v);                                            \
  }
#define GLEV_SETTER(command, method, size, count)         \
  GLEV_FORMS(command, method, size, count, f, glev_float) \
  GLEV_FORMS(command, method, size, count, d, glev_double)
GLEV_SETTER(Vertex, vertex, 4, 2)
GLEV_SETTER(Vertex, vertex, 4, 3)
GLEV_SETTER(Vertex, vertex, 4, 4)
GLEV_SETTER(Color, color, 4, 3)
GLEV_SETTER(Color, color, 4, 4)
GLEV_SETTER(Normal, normal, 3, 3)
#undef GLEV_SETTER
#undef GLEV_FORMS

#define GLEV_TEXTURE_FORMS(count, f, real)                                                       \
  void glevMultiTexCoord##count##f##v(glev_context* context, glev_enum texture, const real* v) { \
    issue_floats<&glev_context::multi_tex_coord, 4, count>(context, v, texture);                 \
  }                                                                                              \
  void glevMultiTexCoord##count##f(glev_context* context, glev_enum texture,                     \
                                   GLEV_PARAMETERS_##count(real)) {                              \
    const real v[] = {GLEV_VALUES_##count};                                                      \
    glevMultiTexCoord##count##f##v(context, texture, v);                                         \
  }                                                                                              \
  void glevTexCoord##count##f##v(glev_context* context, const real* v) {                         \
    glevMultiTexCoord##count##f##v(context, GLEV_TEXTURE0, v);                                   \
  }                                                                                              \
  void glevTexCoord##count##f(glev_context* context, GLEV_PARAMETERS_##count(real)) {            \
    glevMultiTexCoord##count##f(context, GLEV_TEXTURE0, GLEV_VALUES_##count);                    \
  }
#define GLEV_TEXTURE_SETTER(count)         \
  GLEV_TEXTURE_FORMS(count, f, glev_float) \
  GLEV_TEXTURE_FORMS(count, d, glev_double)
GLEV_TEXTURE_SETTER(1)
GLEV_TEXTURE_SETTER(2)
GLEV_TEXTURE_SETTER(3)
GLEV_TEXTURE_SETTER(4)
#undef GLEV_TEXTURE_SETTER
#undef GLEV_TEXTURE_FORMS

#define GLEV_INDEX(f, real)                                                                  \
  void glevIndex##f##v(glev_context* context, const real* v) {                               \
    if (!rejected(context, v)) context->issue<&glev_context::index>(static_cast<float>(*v)); \
  }                                                                                          \
  void glevIndex##f(glev_context* context, real index) { glevIndex##f##v(context, &index); }
GLEV_INDEX(f, glev_float)
GLEV_INDEX(d, glev_double)
#undef GLEV_INDEX

void glevEdgeFlag(glev_context* context, glev_boolean flag) {
  context->issue<&glev_context::edge_flag>(flag != GLEV_FALSE);
}
void glevEdgeFlagv(glev_context* context, const glev_boolean* v) {
  if (!rejected(context, v)) context->issue<&glev_context::edge_flag>(*v != GLEV_FALSE);
}

void glevActiveTexture(glev_context* context, glev_enum texture) {
  context->issue<&glev_context::active_texture>(texture);
}

// ---- Display lists and the attribute stack

void glevNewList(glev_context* context, glev_uint list, glev_enum mode) { context->new_list(list, mode); }
void glevEndList(glev_context* context) { context->end_list(); }
void glevCallList(glev_context* context, glev_uint list) { context->issue<&glev_context::call_list>(list); }
void glevCallLists(glev_context* context, glev_int n, glev_enum type, const void* lists) {
  context->issue_call_lists(n, type, lists);
}
void glevListBase(glev_context* context, glev_uint base) { context->issue<&glev_context::list_base>(base); }
glev_uint glevGenLists(glev_context* context, glev_int range) { return context->gen_lists(range); }
glev_boolean glevIsList(glev_context* context, glev_uint list) {
  return context->is_list(list) ? GLEV_TRUE : GLEV_FALSE;
}
void glevDeleteLists(glev_context* context, glev_uint list, glev_int range) {
  context->delete_lists(list, range);
}

void glevPushAttrib(glev_context* context, glev_bitfield mask) {
  context->issue<&glev_context::push_attrib>(mask);
}
void glevPopAttrib(glev_context* context) { context->issue<&glev_context::pop_attrib>(); }

void glevFlush(glev_context* context) { context->flush(); }
void glevFinish(glev_context* context) { context->flush(); }

// ---- Queries

void glevGetBooleanv(glev_context* context, glev_enum pname, glev_boolean* v) { context->get(pname, v); }
void glevGetIntegerv(glev_context* context, glev_enum pname, glev_int* v) { context->get(pname, v); }
void glevGetFloatv(glev_context* context, glev_enum pname, glev_float* v) { context->get(pname, v); }
void glevGetDoublev(glev_context* context, glev_enum pname, glev_double* v) { context->get(pname, v); }

const glev_ubyte* glevGetString(glev_context* context, glev_enum name) {
  return reinterpret_cast<const glev_ubyte*>(context->get_string(name));
}

// ---- Plans

glev_result glevCreatePlan(glev_context* context, const glev_plan_info* given, glev_plan** plan) {
  if (plan == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  *plan = nullptr;
  glev_plan_info info;
  const glev_result result = glev::read_struct(given, &info);
  if (result != GLEV_SUCCESS) return result;
  if (info.dimension != 1 && info.dimension != 2) return GLEV_ERROR_UNSUPPORTED;
  glev_plan* current = context->current_plan(static_cast<int>(info.dimension));
  if (current == nullptr) return GLEV_ERROR_OUT_OF_MEMORY;
  current->retain();
  *plan = current;
  return GLEV_SUCCESS;
}

void glevRetainPlan(glev_plan* plan) { plan->retain(); }

void glevReleasePlan(glev_plan* plan) {
  if (plan != nullptr) plan->release();
}

size_t glevGetPlanComponents(const glev_plan* plan, glev_attribute attribute) {
  const auto index = static_cast<unsigned>(attribute);
  if (attribute == GLEV_ATTRIBUTE_NORMAL && plan->automatic_normals()) return 3;
  if (attribute >= GLEV_ATTRIBUTE_TANGENT_U && attribute <= GLEV_ATTRIBUTE_SECOND_VV)
    return plan->derivative_components();
  return index < glev::kAttributes ? plan->components(static_cast<glev::Attribute>(index)) : 0;
}
