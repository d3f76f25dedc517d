// The GL-named entry points. They convert the forms of a command (count, type, v) to one and pass it to the
// context.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "command.h"
#include "context.h"
#include "environment.h"
#include "outputs.h"
#include "structures.h"

using glev::widen;

namespace {

// Returns `values` with the first kCount values replaced by those at v, as floats.
template <std::size_t kCount, std::size_t kSize, class Real>
std::array<float, kSize> load(std::array<float, kSize> values, const Real* v) {
  for (std::size_t k = 0; k < kCount; ++k) values[k] = static_cast<float>(v[k]);
  return values;
}

// GetMap does not know the size of the array.
constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

bool rejected(glev_context* context, const void* v) {
  if (v == nullptr) context->issue(glev::ErrorCommand{GLEV_INVALID_VALUE});
  return v == nullptr;
}

double widened(float x) { return widen(x); }
double widened(double x) { return x; }

// This is a separate function so that the fast path has a small stack frame.
template <class Real>
[[gnu::noinline]] void issue_eval_coord(glev_context* context, int dimension, Real u, Real v) {
  context->issue(glev::EvalCoordCommand{dimension, widened(u), widened(v)});
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

template <std::size_t kCount, class Real>
void issue_vertex(glev_context* context, const Real* v) {
  if (rejected(context, v)) return;
  context->issue(glev::VertexCommand{load<kCount>(std::array<float, 4>{0, 0, 0, 1}, v)});
}

template <std::size_t kCount, class Real>
void issue_color(glev_context* context, const Real* v) {
  if (rejected(context, v)) return;
  context->issue(glev::ColorCommand{load<kCount>(std::array<float, 4>{0, 0, 0, 1}, v)});
}

template <class Real>
void issue_normal(glev_context* context, const Real* v) {
  if (!rejected(context, v)) context->issue(glev::NormalCommand{load<3>(std::array<float, 3>{}, v)});
}

template <std::size_t kCount, class Real>
void issue_tex_coord(glev_context* context, glev_enum texture, const Real* v) {
  if (rejected(context, v)) return;
  context->issue(glev::MultiTexCoordCommand{texture, load<kCount>(std::array<float, 4>{0, 0, 0, 1}, v)});
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

void glevMap1f(glev_context* context, glev_enum target, glev_float u1, glev_float u2, glev_int stride,
               glev_int order, const glev_float* points) {
  context->issue_define_map(1, target, {{{widen(u1), widen(u2), stride, order}, {}}}, points);
}
void glevMap1d(glev_context* context, glev_enum target, glev_double u1, glev_double u2, glev_int stride,
               glev_int order, const glev_double* points) {
  context->issue_define_map(1, target, {{{u1, u2, stride, order}, {}}}, points);
}

void glevMap2f(glev_context* context, glev_enum target, glev_float u1, glev_float u2, glev_int ustride,
               glev_int uorder, glev_float v1, glev_float v2, glev_int vstride, glev_int vorder,
               const glev_float* points) {
  context->issue_define_map(
      2, target, {{{widen(u1), widen(u2), ustride, uorder}, {widen(v1), widen(v2), vstride, vorder}}},
      points);
}
void glevMap2d(glev_context* context, glev_enum target, glev_double u1, glev_double u2, glev_int ustride,
               glev_int uorder, glev_double v1, glev_double v2, glev_int vstride, glev_int vorder,
               const glev_double* points) {
  context->issue_define_map(2, target, {{{u1, u2, ustride, uorder}, {v1, v2, vstride, vorder}}}, points);
}

void glevGetMapdv(glev_context* context, glev_enum target, glev_enum query, glev_double* v) {
  context->get_map(target, query, kUnlimited, v);
}
void glevGetMapfv(glev_context* context, glev_enum target, glev_enum query, glev_float* v) {
  context->get_map(target, query, kUnlimited, v);
}
void glevGetMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int* v) {
  context->get_map(target, query, kUnlimited, v);
}

void glevGetnMapdv(glev_context* context, glev_enum target, glev_enum query, glev_int size, glev_double* v) {
  context->getn_map(target, query, size, v);
}
void glevGetnMapfv(glev_context* context, glev_enum target, glev_enum query, glev_int size, glev_float* v) {
  context->getn_map(target, query, size, v);
}
void glevGetnMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int size, glev_int* v) {
  context->getn_map(target, query, size, v);
}

void glevEnable(glev_context* context, glev_enum cap) { context->issue(glev::SetEnabledCommand{cap, true}); }
void glevDisable(glev_context* context, glev_enum cap) {
  context->issue(glev::SetEnabledCommand{cap, false});
}
glev_boolean glevIsEnabled(glev_context* context, glev_enum cap) {
  return context->is_enabled(cap) ? GLEV_TRUE : GLEV_FALSE;
}

// ---- Evaluation

void glevEvalCoord1f(glev_context* context, glev_float u) { eval_coord(context, u); }
void glevEvalCoord1d(glev_context* context, glev_double u) { eval_coord(context, u); }
void glevEvalCoord1fv(glev_context* context, const glev_float* u) {
  if (!rejected(context, u)) eval_coord(context, *u);
}
void glevEvalCoord1dv(glev_context* context, const glev_double* u) {
  if (!rejected(context, u)) eval_coord(context, *u);
}

void glevEvalCoord2f(glev_context* context, glev_float u, glev_float v) { eval_coord(context, u, v); }
void glevEvalCoord2d(glev_context* context, glev_double u, glev_double v) { eval_coord(context, u, v); }
void glevEvalCoord2fv(glev_context* context, const glev_float* u) {
  if (!rejected(context, u)) eval_coord(context, u[0], u[1]);
}
void glevEvalCoord2dv(glev_context* context, const glev_double* u) {
  if (!rejected(context, u)) eval_coord(context, u[0], u[1]);
}

// ---- Grids and meshes

void glevMapGrid1f(glev_context* context, glev_int n, glev_float u1, glev_float u2) {
  context->issue(glev::SetGridCommand{1, {{{widen(u1), widen(u2), n}, {}}}});
}
void glevMapGrid1d(glev_context* context, glev_int n, glev_double u1, glev_double u2) {
  context->issue(glev::SetGridCommand{1, {{{u1, u2, n}, {}}}});
}
void glevMapGrid2f(glev_context* context, glev_int un, glev_float u1, glev_float u2, glev_int vn,
                   glev_float v1, glev_float v2) {
  context->issue(glev::SetGridCommand{2, {{{widen(u1), widen(u2), un}, {widen(v1), widen(v2), vn}}}});
}
void glevMapGrid2d(glev_context* context, glev_int un, glev_double u1, glev_double u2, glev_int vn,
                   glev_double v1, glev_double v2) {
  context->issue(glev::SetGridCommand{2, {{{u1, u2, un}, {v1, v2, vn}}}});
}

void glevEvalPoint1(glev_context* context, glev_int i) { context->issue(glev::EvalPointCommand{1, i, 0}); }
void glevEvalPoint2(glev_context* context, glev_int i, glev_int j) {
  context->issue(glev::EvalPointCommand{2, i, j});
}

void glevEvalMesh1(glev_context* context, glev_enum mode, glev_int i1, glev_int i2) {
  context->issue(glev::EvalMesh1Command{mode, i1, i2});
}
void glevEvalMesh2(glev_context* context, glev_enum mode, glev_int i1, glev_int i2, glev_int j1,
                   glev_int j2) {
  context->issue(glev::EvalMesh2Command{mode, i1, i2, j1, j2});
}

// ---- Primitives

void glevBegin(glev_context* context, glev_enum mode) { context->issue(glev::BeginCommand{mode}); }
void glevEnd(glev_context* context) { context->issue(glev::EndCommand{}); }

void glevVertex2fv(glev_context* context, const glev_float* v) { issue_vertex<2>(context, v); }
void glevVertex2f(glev_context* context, glev_float x, glev_float y) {
  const glev_float v[] = {x, y};
  glevVertex2fv(context, v);
}
void glevVertex2dv(glev_context* context, const glev_double* v) { issue_vertex<2>(context, v); }
void glevVertex2d(glev_context* context, glev_double x, glev_double y) {
  const glev_double v[] = {x, y};
  glevVertex2dv(context, v);
}

void glevVertex3fv(glev_context* context, const glev_float* v) { issue_vertex<3>(context, v); }
void glevVertex3f(glev_context* context, glev_float x, glev_float y, glev_float z) {
  const glev_float v[] = {x, y, z};
  glevVertex3fv(context, v);
}
void glevVertex3dv(glev_context* context, const glev_double* v) { issue_vertex<3>(context, v); }
void glevVertex3d(glev_context* context, glev_double x, glev_double y, glev_double z) {
  const glev_double v[] = {x, y, z};
  glevVertex3dv(context, v);
}

void glevVertex4fv(glev_context* context, const glev_float* v) { issue_vertex<4>(context, v); }
void glevVertex4f(glev_context* context, glev_float x, glev_float y, glev_float z, glev_float w) {
  const glev_float v[] = {x, y, z, w};
  glevVertex4fv(context, v);
}
void glevVertex4dv(glev_context* context, const glev_double* v) { issue_vertex<4>(context, v); }
void glevVertex4d(glev_context* context, glev_double x, glev_double y, glev_double z, glev_double w) {
  const glev_double v[] = {x, y, z, w};
  glevVertex4dv(context, v);
}

// ---- Current values

void glevColor3fv(glev_context* context, const glev_float* v) { issue_color<3>(context, v); }
void glevColor3f(glev_context* context, glev_float red, glev_float green, glev_float blue) {
  const glev_float v[] = {red, green, blue};
  glevColor3fv(context, v);
}
void glevColor3dv(glev_context* context, const glev_double* v) { issue_color<3>(context, v); }
void glevColor3d(glev_context* context, glev_double red, glev_double green, glev_double blue) {
  const glev_double v[] = {red, green, blue};
  glevColor3dv(context, v);
}

void glevColor4fv(glev_context* context, const glev_float* v) { issue_color<4>(context, v); }
void glevColor4f(glev_context* context, glev_float red, glev_float green, glev_float blue, glev_float alpha) {
  const glev_float v[] = {red, green, blue, alpha};
  glevColor4fv(context, v);
}
void glevColor4dv(glev_context* context, const glev_double* v) { issue_color<4>(context, v); }
void glevColor4d(glev_context* context, glev_double red, glev_double green, glev_double blue,
                 glev_double alpha) {
  const glev_double v[] = {red, green, blue, alpha};
  glevColor4dv(context, v);
}

void glevNormal3fv(glev_context* context, const glev_float* v) { issue_normal(context, v); }
void glevNormal3f(glev_context* context, glev_float x, glev_float y, glev_float z) {
  const glev_float v[] = {x, y, z};
  glevNormal3fv(context, v);
}
void glevNormal3dv(glev_context* context, const glev_double* v) { issue_normal(context, v); }
void glevNormal3d(glev_context* context, glev_double x, glev_double y, glev_double z) {
  const glev_double v[] = {x, y, z};
  glevNormal3dv(context, v);
}

void glevIndexf(glev_context* context, glev_float index) { context->issue(glev::IndexCommand{index}); }
void glevIndexd(glev_context* context, glev_double index) {
  context->issue(glev::IndexCommand{static_cast<float>(index)});
}
void glevIndexfv(glev_context* context, const glev_float* v) {
  if (!rejected(context, v)) context->issue(glev::IndexCommand{*v});
}
void glevIndexdv(glev_context* context, const glev_double* v) {
  if (!rejected(context, v)) context->issue(glev::IndexCommand{static_cast<float>(*v)});
}

void glevEdgeFlag(glev_context* context, glev_boolean flag) {
  context->issue(glev::EdgeFlagCommand{flag != GLEV_FALSE});
}
void glevEdgeFlagv(glev_context* context, const glev_boolean* v) {
  if (!rejected(context, v)) context->issue(glev::EdgeFlagCommand{*v != GLEV_FALSE});
}

void glevTexCoord1fv(glev_context* context, const glev_float* v) {
  issue_tex_coord<1>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord1f(glev_context* context, glev_float s) {
  const glev_float v[] = {s};
  glevTexCoord1fv(context, v);
}
void glevTexCoord1dv(glev_context* context, const glev_double* v) {
  issue_tex_coord<1>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord1d(glev_context* context, glev_double s) {
  const glev_double v[] = {s};
  glevTexCoord1dv(context, v);
}

void glevTexCoord2fv(glev_context* context, const glev_float* v) {
  issue_tex_coord<2>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord2f(glev_context* context, glev_float s, glev_float t) {
  const glev_float v[] = {s, t};
  glevTexCoord2fv(context, v);
}
void glevTexCoord2dv(glev_context* context, const glev_double* v) {
  issue_tex_coord<2>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord2d(glev_context* context, glev_double s, glev_double t) {
  const glev_double v[] = {s, t};
  glevTexCoord2dv(context, v);
}

void glevTexCoord3fv(glev_context* context, const glev_float* v) {
  issue_tex_coord<3>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord3f(glev_context* context, glev_float s, glev_float t, glev_float r) {
  const glev_float v[] = {s, t, r};
  glevTexCoord3fv(context, v);
}
void glevTexCoord3dv(glev_context* context, const glev_double* v) {
  issue_tex_coord<3>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord3d(glev_context* context, glev_double s, glev_double t, glev_double r) {
  const glev_double v[] = {s, t, r};
  glevTexCoord3dv(context, v);
}

void glevTexCoord4fv(glev_context* context, const glev_float* v) {
  issue_tex_coord<4>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord4f(glev_context* context, glev_float s, glev_float t, glev_float r, glev_float q) {
  const glev_float v[] = {s, t, r, q};
  glevTexCoord4fv(context, v);
}
void glevTexCoord4dv(glev_context* context, const glev_double* v) {
  issue_tex_coord<4>(context, GLEV_TEXTURE0, v);
}
void glevTexCoord4d(glev_context* context, glev_double s, glev_double t, glev_double r, glev_double q) {
  const glev_double v[] = {s, t, r, q};
  glevTexCoord4dv(context, v);
}

void glevMultiTexCoord1fv(glev_context* context, glev_enum texture, const glev_float* v) {
  issue_tex_coord<1>(context, texture, v);
}
void glevMultiTexCoord1f(glev_context* context, glev_enum texture, glev_float s) {
  const glev_float v[] = {s};
  glevMultiTexCoord1fv(context, texture, v);
}
void glevMultiTexCoord1dv(glev_context* context, glev_enum texture, const glev_double* v) {
  issue_tex_coord<1>(context, texture, v);
}
void glevMultiTexCoord1d(glev_context* context, glev_enum texture, glev_double s) {
  const glev_double v[] = {s};
  glevMultiTexCoord1dv(context, texture, v);
}

void glevMultiTexCoord2fv(glev_context* context, glev_enum texture, const glev_float* v) {
  issue_tex_coord<2>(context, texture, v);
}
void glevMultiTexCoord2f(glev_context* context, glev_enum texture, glev_float s, glev_float t) {
  const glev_float v[] = {s, t};
  glevMultiTexCoord2fv(context, texture, v);
}
void glevMultiTexCoord2dv(glev_context* context, glev_enum texture, const glev_double* v) {
  issue_tex_coord<2>(context, texture, v);
}
void glevMultiTexCoord2d(glev_context* context, glev_enum texture, glev_double s, glev_double t) {
  const glev_double v[] = {s, t};
  glevMultiTexCoord2dv(context, texture, v);
}

void glevMultiTexCoord3fv(glev_context* context, glev_enum texture, const glev_float* v) {
  issue_tex_coord<3>(context, texture, v);
}
void glevMultiTexCoord3f(glev_context* context, glev_enum texture, glev_float s, glev_float t, glev_float r) {
  const glev_float v[] = {s, t, r};
  glevMultiTexCoord3fv(context, texture, v);
}
void glevMultiTexCoord3dv(glev_context* context, glev_enum texture, const glev_double* v) {
  issue_tex_coord<3>(context, texture, v);
}
void glevMultiTexCoord3d(glev_context* context, glev_enum texture, glev_double s, glev_double t,
                         glev_double r) {
  const glev_double v[] = {s, t, r};
  glevMultiTexCoord3dv(context, texture, v);
}

void glevMultiTexCoord4fv(glev_context* context, glev_enum texture, const glev_float* v) {
  issue_tex_coord<4>(context, texture, v);
}
void glevMultiTexCoord4f(glev_context* context, glev_enum texture, glev_float s, glev_float t, glev_float r,
                         glev_float q) {
  const glev_float v[] = {s, t, r, q};
  glevMultiTexCoord4fv(context, texture, v);
}
void glevMultiTexCoord4dv(glev_context* context, glev_enum texture, const glev_double* v) {
  issue_tex_coord<4>(context, texture, v);
}
void glevMultiTexCoord4d(glev_context* context, glev_enum texture, glev_double s, glev_double t,
                         glev_double r, glev_double q) {
  const glev_double v[] = {s, t, r, q};
  glevMultiTexCoord4dv(context, texture, v);
}

void glevActiveTexture(glev_context* context, glev_enum texture) {
  context->issue(glev::ActiveTextureCommand{texture});
}

// ---- Display lists and the attribute stack

void glevNewList(glev_context* context, glev_uint list, glev_enum mode) { context->new_list(list, mode); }
void glevEndList(glev_context* context) { context->end_list(); }
void glevCallList(glev_context* context, glev_uint list) { context->issue(glev::CallListCommand{list}); }
void glevCallLists(glev_context* context, glev_int n, glev_enum type, const void* lists) {
  context->issue_call_lists(n, type, lists);
}
void glevListBase(glev_context* context, glev_uint base) { context->issue(glev::ListBaseCommand{base}); }
glev_uint glevGenLists(glev_context* context, glev_int range) { return context->gen_lists(range); }
glev_boolean glevIsList(glev_context* context, glev_uint list) {
  return context->is_list(list) ? GLEV_TRUE : GLEV_FALSE;
}
void glevDeleteLists(glev_context* context, glev_uint list, glev_int range) {
  context->delete_lists(list, range);
}

void glevPushAttrib(glev_context* context, glev_bitfield mask) {
  context->issue(glev::PushAttribCommand{mask});
}
void glevPopAttrib(glev_context* context) { context->issue(glev::PopAttribCommand{}); }

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
