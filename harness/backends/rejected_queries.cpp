// Finds the rejected queries in a fresh context, and wraps an implementation so that its Get commands ignore
// them outside of Begin and End.
#include <evalcts/backends/rejected_queries.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include <evalcts/backends/context_in_front.h>
#include <evalcts/gl/errors.h>

namespace evalcts {
namespace {

// The state of the filter, which is global because the commands have no other argument.
struct Filter {
  static inline gl::Table inner;
  static inline std::set<RejectedQuery> queries;
  static inline thread_local bool inside = false;  // between Begin and End, where every query raises an error

  static bool drops(gl::EntryPoint get, GLenum name) { return !inside && queries.contains({get, name}); }

  static void install(gl::Table& table) {
    inner = table;
    inside = false;
    if (inner.Begin)
      table.Begin = [](GLenum mode) {
        inner.Begin(mode);
        inside = mode <= GL_POLYGON;
      };
    if (inner.End)
      table.End = [] {
        inner.End();
        inside = false;
      };
    if (inner.GetBooleanv)
      table.GetBooleanv = [](GLenum name, GLboolean* values) {
        if (!drops(gl::EntryPoint::GetBooleanv, name)) inner.GetBooleanv(name, values);
      };
    if (inner.GetIntegerv)
      table.GetIntegerv = [](GLenum name, GLint* values) {
        if (!drops(gl::EntryPoint::GetIntegerv, name)) inner.GetIntegerv(name, values);
      };
    if (inner.GetFloatv)
      table.GetFloatv = [](GLenum name, GLfloat* values) {
        if (!drops(gl::EntryPoint::GetFloatv, name)) inner.GetFloatv(name, values);
      };
    if (inner.GetDoublev)
      table.GetDoublev = [](GLenum name, GLdouble* values) {
        if (!drops(gl::EntryPoint::GetDoublev, name)) inner.GetDoublev(name, values);
      };
  }
};

class FilteredContext final : public ContextInFront {
 public:
  explicit FilteredContext(std::unique_ptr<Context> inner) : ContextInFront(std::move(inner)) {
    Filter::install(table_);
  }
};

class Filtered final : public ImplementationInFront {
 public:
  using ImplementationInFront::ImplementationInFront;
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<FilteredContext>(inner().create_context());
  }
};

// Returns true if the query raises no error and writes a value.
template <class Get>
bool is_answered(const gl::Table& table, Get get, GLenum name) {
  using Number = std::conditional_t<std::is_same_v<Get, decltype(table.GetFloatv)>, GLfloat, GLint>;
  // A value that is written may be equal to the first filling, but not to both.
  for (const Number filling : {Number{-4711}, Number{815}}) {
    Number values[16];
    std::ranges::fill(values, filling);
    get(name, values);
    if (!gl::take_errors(table).empty()) return false;
    if (values[0] != filling) return true;
  }
  return false;
}

}  // namespace

std::set<RejectedQuery> find_rejected_queries(Implementation& implementation, std::span<const GLenum> names) {
  const std::unique_ptr<Context> context = implementation.create_context();
  const gl::Table& table = context->table();
  if (!table.GetError) return {};
  gl::take_errors(table);
  std::set<RejectedQuery> rejected;
  const auto try_all = [&](gl::EntryPoint entry, auto get, auto filling) {
    for (const GLenum name : names) {
      if (!get) continue;
      decltype(filling) values[16] = {};
      get(name, values);
      if (!gl::take_errors(table).empty()) rejected.emplace(entry, name);
    }
  };
  try_all(gl::EntryPoint::GetBooleanv, table.GetBooleanv, GLboolean());
  try_all(gl::EntryPoint::GetIntegerv, table.GetIntegerv, GLint());
  try_all(gl::EntryPoint::GetFloatv, table.GetFloatv, GLfloat());
  try_all(gl::EntryPoint::GetDoublev, table.GetDoublev, GLdouble());
  return rejected;
}

std::set<GLenum> find_unanswered_grid_queries(Implementation& implementation) {
  const std::unique_ptr<Context> context = implementation.create_context();
  const gl::Table& table = context->table();
  if (!table.GetError) return {};
  gl::take_errors(table);
  std::set<GLenum> unanswered;
  for (const GLenum name : kGridQueries) {
    const bool is_domain = name == GL_MAP1_GRID_DOMAIN || name == GL_MAP2_GRID_DOMAIN;
    if ((table.GetFloatv && !is_answered(table, table.GetFloatv, name)) ||
        (table.GetIntegerv && !is_domain && !is_answered(table, table.GetIntegerv, name)))
      unanswered.insert(name);
  }
  return unanswered;
}

std::unique_ptr<Implementation> without_queries(std::unique_ptr<Implementation> inner,
                                                const std::set<RejectedQuery>& queries) {
  Filter::queries = queries;
  return std::make_unique<Filtered>(std::move(inner));
}

}  // namespace evalcts
