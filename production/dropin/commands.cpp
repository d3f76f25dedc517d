// The GL commands that this library replaces, except those that set current values.
#include "context.h"
#include "src/target.h"

using namespace glev::dropin;  // NOLINT(google-build-using-namespace): what follows is C

// If the GL does not have evaluators, the command is passed on to it.
#define OF_EVALUATORS(name, ...)              \
  Context* const context = current_context(); \
  if (context == nullptr) return gl_below().name(__VA_ARGS__)

namespace {

// Issues a command that lists can contain.
template <class Operation>
void issue(Context* context, const Operation& operation) {
  evaluators_used.note();
  context->issue([operation](Context& executing, const unsigned char*) { operation(executing); });
}

// --- Maps

// Returns the number of values that Map reads for each control point; 0 if it reads none because its
// arguments are invalid.
template <class Real>
std::size_t components_of(int dimension, GLenum name, const MapDirections<Real>& directions) {
  const glev::Target target = glev::find_target(name);
  if (target.dimension != dimension) return 0;
  const int components = glev::kSlotTable[static_cast<std::size_t>(target.slot)].components;
  for (int d = 0; d < dimension; ++d) {
    const auto& [first, last, stride, order] = directions[static_cast<std::size_t>(d)];
    if (order < 1 || order > glev::kMaxOrder || stride < components) return 0;
  }
  return static_cast<std::size_t>(components);
}

// Executes Map, or compiles it with a packed copy of the control points.
template <class Real>
void define_map(Context* context, int dimension, GLenum target, const MapDirections<Real>& directions,
                const Real* points) {
  evaluators_used.note();
  if (!context->list.open) return context->map(dimension, target, directions, points);
  const std::size_t components = points != nullptr ? components_of(dimension, target, directions) : 0;
  const MapDirection<Real>&u = directions[0], &v = directions[1];
  MapDirections<Real> packed = directions;
  if (components > 0) {
    packed[0].stride = static_cast<GLint>(components) * v.order;
    packed[1].stride = static_cast<GLint>(components);
  }
  const std::size_t size = components * sizeof(Real);
  const bool is_null = points == nullptr;
  context->issue_with(
      [=](Context& executing, const unsigned char* copy) {
        executing.map(dimension, target, packed, is_null ? nullptr : reinterpret_cast<const Real*>(copy));
      },
      components > 0 ? size * static_cast<std::size_t>(u.order) * static_cast<std::size_t>(v.order) : 0,
      [&](unsigned char* copy) {
        for (std::ptrdiff_t i = 0; components > 0 && i < u.order; ++i)
          for (std::ptrdiff_t j = 0; j < v.order; ++j, copy += size)
            std::memcpy(copy, points + i * u.stride + j * v.stride, size);
      });
}

}  // namespace

#define MAP(letter, type)                                                                                   \
  DROPIN_EXPORT void glMap1##letter(GLenum target, type u1, type u2, GLint stride, GLint order,             \
                                    const type* points) {                                                   \
    OF_EVALUATORS(Map1##letter, target, u1, u2, stride, order, points);                                     \
    define_map<type>(context, 1, target, {{{u1, u2, stride, order}, {0, 1, 0, 1}}}, points);                \
  }                                                                                                         \
  DROPIN_EXPORT void glMap2##letter(GLenum target, type u1, type u2, GLint ustride, GLint uorder, type v1,  \
                                    type v2, GLint vstride, GLint vorder, const type* points) {             \
    OF_EVALUATORS(Map2##letter, target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);          \
    define_map<type>(context, 2, target, {{{u1, u2, ustride, uorder}, {v1, v2, vstride, vorder}}}, points); \
  }
MAP(f, GLfloat)
MAP(d, GLdouble)
#undef MAP

// These commands are executed at once and rejected between Begin and End.
#define GET_MAP(letter, type)                                                                       \
  DROPIN_EXPORT void glGetMap##letter##v(GLenum target, GLenum query, type* v) {                    \
    OF_EVALUATORS(GetMap##letter##v, target, query, v);                                             \
    if (!context->is_outside()) return;                                                             \
    glevGetMap##letter##v(context->evaluators, target, query, v);                                   \
    context->report();                                                                              \
  }                                                                                                 \
  DROPIN_EXPORT void glGetnMap##letter##v(GLenum target, GLenum query, GLsizei bytes, type* v) {    \
    OF_EVALUATORS(GetnMap##letter##v, target, query, bytes, v);                                     \
    if (!context->is_outside()) return;                                                             \
    glevGetnMap##letter##v(context->evaluators, target, query, bytes, v);                           \
    context->report();                                                                              \
  }                                                                                                 \
  DROPIN_EXPORT void glGetnMap##letter##vARB(GLenum target, GLenum query, GLsizei bytes, type* v) { \
    glGetnMap##letter##v(target, query, bytes, v);                                                  \
  }
GET_MAP(f, GLfloat)
GET_MAP(d, GLdouble)
GET_MAP(i, GLint)
#undef GET_MAP

// --- Grids and evaluation

#define MAP_GRID(letter, type)                                                                    \
  DROPIN_EXPORT void glMapGrid1##letter(GLint n, type u1, type u2) {                              \
    OF_EVALUATORS(MapGrid1##letter, n, u1, u2);                                                   \
    issue(context, [=](Context& executing) { executing.map_grid1(n, u1, u2); });                  \
  }                                                                                               \
  DROPIN_EXPORT void glMapGrid2##letter(GLint un, type u1, type u2, GLint vn, type v1, type v2) { \
    OF_EVALUATORS(MapGrid2##letter, un, u1, u2, vn, v1, v2);                                      \
    issue(context, [=](Context& executing) { executing.map_grid2(un, u1, u2, vn, v1, v2); });     \
  }
MAP_GRID(f, GLfloat)
MAP_GRID(d, GLdouble)
#undef MAP_GRID

#define EVAL_COORD(letter, type)                                                          \
  DROPIN_EXPORT void glEvalCoord1##letter(type u) {                                       \
    OF_EVALUATORS(EvalCoord1##letter, u);                                                 \
    issue(context, [=](Context& executing) { executing.eval_coord(1, u, 0); });           \
  }                                                                                       \
  DROPIN_EXPORT void glEvalCoord1##letter##v(const type* u) { glEvalCoord1##letter(*u); } \
  DROPIN_EXPORT void glEvalCoord2##letter(type u, type v) {                               \
    OF_EVALUATORS(EvalCoord2##letter, u, v);                                              \
    issue(context, [=](Context& executing) { executing.eval_coord(2, u, v); });           \
  }                                                                                       \
  DROPIN_EXPORT void glEvalCoord2##letter##v(const type* u) { glEvalCoord2##letter(u[0], u[1]); }
EVAL_COORD(f, GLfloat)
EVAL_COORD(d, GLdouble)
#undef EVAL_COORD

DROPIN_EXPORT void glEvalPoint1(GLint i) {
  OF_EVALUATORS(EvalPoint1, i);
  issue(context, [=](Context& executing) { executing.eval_point(1, i, 0); });
}
DROPIN_EXPORT void glEvalPoint2(GLint i, GLint j) {
  OF_EVALUATORS(EvalPoint2, i, j);
  issue(context, [=](Context& executing) { executing.eval_point(2, i, j); });
}
DROPIN_EXPORT void glEvalMesh1(GLenum mode, GLint i1, GLint i2) {
  OF_EVALUATORS(EvalMesh1, mode, i1, i2);
  issue(context, [=](Context& executing) { executing.eval_mesh1(mode, i1, i2); });
}
DROPIN_EXPORT void glEvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  OF_EVALUATORS(EvalMesh2, mode, i1, i2, j1, j2);
  issue(context, [=](Context& executing) { executing.eval_mesh2(mode, i1, i2, j1, j2); });
}

// --- Enables and queries

namespace {

bool is_evaluator_capability(GLenum cap) {
  return cap == GL_AUTO_NORMAL || glev::find_target(cap).dimension != 0;
}

bool is_state(GLenum pname) {
  return is_evaluator_capability(pname) || pname == GL_MAX_EVAL_ORDER || pname == GL_MAP1_GRID_DOMAIN ||
         pname == GL_MAP1_GRID_SEGMENTS || pname == GL_MAP2_GRID_DOMAIN || pname == GL_MAP2_GRID_SEGMENTS;
}

void set_enabled(GLenum cap, bool on) {
  Context* const context = is_evaluator_capability(cap) ? current_context() : nullptr;
  if (context != nullptr) return issue(context, [=](Context& executing) { executing.set_enabled(cap, on); });
  if (on)
    gl_below().Enable(cap);
  else
    gl_below().Disable(cap);
}

void ask(glev_context* evaluators, GLenum pname, GLboolean* v) { glevGetBooleanv(evaluators, pname, v); }
void ask(glev_context* evaluators, GLenum pname, GLint* v) { glevGetIntegerv(evaluators, pname, v); }
void ask(glev_context* evaluators, GLenum pname, GLfloat* v) { glevGetFloatv(evaluators, pname, v); }
void ask(glev_context* evaluators, GLenum pname, GLdouble* v) { glevGetDoublev(evaluators, pname, v); }
void ask(glev_context* evaluators, GLenum pname, GLint64* v) {
  GLint values[4] = {};
  glevGetIntegerv(evaluators, pname, values);
  const int count = pname == GL_MAP2_GRID_DOMAIN                                     ? 4
                    : pname == GL_MAP1_GRID_DOMAIN || pname == GL_MAP2_GRID_SEGMENTS ? 2
                                                                                     : 1;
  for (int k = 0; k < count; ++k) v[k] = values[k];
}

// Answers a query and returns true. Returns false if the GL below must answer it.
template <class Number>
bool answer(GLenum pname, Number* v) {
  const bool of_list = pname == GL_LIST_INDEX || pname == GL_LIST_MODE;
  Context* const context = current_context_of_any_kind();
  if (context == nullptr || v == nullptr) return false;
  if (context->list.deferring) {
    context->raise_error(GL_INVALID_OPERATION);
    return true;
  }
  if (!is_state(pname) && !(of_list && context->list.open)) return false;
  if (current_context() == nullptr) {
    if (context->kind != Context::Kind::kRemoved) return false;
    context->raise_error(GL_INVALID_ENUM);
    return true;
  }
  if (!context->is_outside()) return true;
  if (of_list) {
    const GLuint value = pname == GL_LIST_INDEX ? context->list.name : context->list.mode;
    *v = static_cast<Number>(sizeof(Number) == 1 ? value != 0 : value);
  } else {
    ask(context->evaluators, pname, v);
  }
  return true;
}

}  // namespace

DROPIN_EXPORT void glEnable(GLenum cap) { set_enabled(cap, true); }
DROPIN_EXPORT void glDisable(GLenum cap) { set_enabled(cap, false); }

DROPIN_EXPORT GLboolean glIsEnabled(GLenum cap) {
  Context* const context = current_context();
  if (context != nullptr && context->list.deferring) {
    context->raise_error(GL_INVALID_OPERATION);
    return GL_FALSE;
  }
  if (context == nullptr || !is_evaluator_capability(cap)) return gl_below().IsEnabled(cap);
  return context->is_outside() ? glevIsEnabled(context->evaluators, cap) : GL_FALSE;
}

DROPIN_EXPORT void glGetBooleanv(GLenum pname, GLboolean* v) {
  if (!answer(pname, v)) gl_below().GetBooleanv(pname, v);
}
DROPIN_EXPORT void glGetIntegerv(GLenum pname, GLint* v) {
  if (!answer(pname, v)) gl_below().GetIntegerv(pname, v);
}
DROPIN_EXPORT void glGetInteger64v(GLenum pname, GLint64* v) {
  if (!answer(pname, v)) gl_below().GetInteger64v(pname, v);
}
DROPIN_EXPORT void glGetFloatv(GLenum pname, GLfloat* v) {
  if (!answer(pname, v)) gl_below().GetFloatv(pname, v);
}
DROPIN_EXPORT void glGetDoublev(GLenum pname, GLdouble* v) {
  if (!answer(pname, v)) gl_below().GetDoublev(pname, v);
}

DROPIN_EXPORT GLenum glGetError() {
  Context* const context = current_context_of_any_kind();
  if (context != nullptr && context->list.deferring) {
    context->raise_error(GL_INVALID_OPERATION);
    return GL_NO_ERROR;
  }
  const GLenum error = gl_below().GetError();
  if (error != GL_NO_ERROR || context == nullptr || !context->out_of_memory) return error;
  context->out_of_memory = false;
  return GL_OUT_OF_MEMORY;
}

// --- Primitives, the attribute stack, display lists

DROPIN_EXPORT void glBegin(GLenum mode) {
  OF_EVALUATORS(Begin, mode);
  context->issue_begin(mode);
}
DROPIN_EXPORT void glEnd() {
  OF_EVALUATORS(End);
  context->end();
}
DROPIN_EXPORT void glPushAttrib(GLbitfield mask) {
  OF_EVALUATORS(PushAttrib, mask);
  context->issue_push_attrib(mask);
}
DROPIN_EXPORT void glPopAttrib() {
  OF_EVALUATORS(PopAttrib);
  context->issue_pop_attrib();
}
DROPIN_EXPORT void glNewList(GLuint list, GLenum mode) {
  OF_EVALUATORS(NewList, list, mode);
  context->new_list(list, mode);
}
DROPIN_EXPORT void glEndList() {
  OF_EVALUATORS(EndList);
  context->end_list();
}
DROPIN_EXPORT void glCallList(GLuint list) {
  OF_EVALUATORS(CallList, list);
  context->issue_call_list(list);
}
DROPIN_EXPORT void glCallLists(GLsizei n, GLenum type, const GLvoid* lists) {
  OF_EVALUATORS(CallLists, n, type, lists);
  context->issue_call_lists(n, type, lists);
}
DROPIN_EXPORT void glListBase(GLuint base) {
  OF_EVALUATORS(ListBase, base);
  list_base_used.note();
  context->list_base_known = false;
  gl_below().ListBase(base);
}
DROPIN_EXPORT GLboolean glIsList(GLuint list) {
  OF_EVALUATORS(IsList, list);
  if (!context->is_outside()) return GL_FALSE;
  return context->group->is_segment(list) ? GL_FALSE : gl_below().IsList(list);
}
DROPIN_EXPORT void glDeleteLists(GLuint list, GLsizei range) {
  OF_EVALUATORS(DeleteLists, list, range);
  context->delete_lists(list, range);
}
