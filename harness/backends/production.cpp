// libglevaluator as an implementation.
#include <glevaluator.h>

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

#include <evalcts/gl/table.h>
#include "kinds.h"

namespace evalcts {
namespace {

struct CurrentHandle {
  static inline thread_local glev_context* current = nullptr;
};

// Returns a command of this type that calls `function` on the current context; null if `function` does not
// take the command's parameters.
template <class Result, class... Parameters, class Function>
auto forward(Result (*)(Parameters...), Function) -> Result (*)(Parameters...) {
  if constexpr (std::is_invocable_v<Function, glev_context*, Parameters...>) {
    return
        [](Parameters... parameters) -> Result { return Function()(CurrentHandle::current, parameters...); };
  } else {
    return nullptr;
  }
}

// Returns a table with the commands of entry_points.def that the library provides, such as glevMap1f for
// Map1f.
gl::Table bind_functions() {
  gl::Table table;
#define GL_ENTRY(name, kinds)                                                                                \
  table.name = forward(table.name,                                                                           \
                       [](auto* context, auto... arguments) -> decltype(glev##name(context, arguments...)) { \
                         return glev##name(context, arguments...);                                           \
                       });
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  return table;
}

// The initial context of a case, and the further contexts that the case makes. They share no objects.
class ProductionContext final : public Context {
 public:
  explicit ProductionContext(const gl::Table& table) : table_(table) { switch_to(0); }
  ~ProductionContext() override {
    CurrentHandle::current = nullptr;
    for (const auto& [number, context] : contexts_) glevDestroyContext(context);
  }
  ProductionContext(const ProductionContext&) = delete;
  ProductionContext& operator=(const ProductionContext&) = delete;

  const gl::Table& table() const override { return table_; }
  void make_current() override { switch_to(0); }
  void release() override {
    of_the_case_ = nullptr;
    CurrentHandle::current = nullptr;
  }
  bool has_sink() const override { return true; }
  std::vector<ObservedPrimitive> take_emitted() override { return std::exchange(emitted_, {}); }

  // Implements glOtherContextEVALCTS (gl/contexts.h).
  static void other(GLuint number) { of_the_case_->switch_to(number); }

 private:
  void switch_to(GLuint number) {
    of_the_case_ = this;
    if (contexts_.find(number) == contexts_.end()) contexts_[number] = make();
    CurrentHandle::current = contexts_[number];
  }

  glev_context* make() {
    glev_context* context = nullptr;
    if (glevCreateContext(nullptr, &context) != GLEV_SUCCESS) throw CannotStart("glevCreateContext failed");
    glev_sink sink{};
    sink.size = sizeof sink;
    sink.user = this;
    sink.begin = [](void* self, glev_enum mode) {
      static_cast<ProductionContext*>(self)->emitted_.push_back({mode, {}});
    };
    sink.vertex = [](void* self, const glev_vertex* vertex) {
      static_cast<ProductionContext*>(self)->keep(*vertex);
    };
    if (glevSetSink(context, &sink) != GLEV_SUCCESS) {
      glevDestroyContext(context);
      throw CannotStart("glevSetSink failed");
    }
    return context;
  }

  void keep(const glev_vertex& vertex) {
    ObservedVertex out;
    std::copy_n(vertex.position, 4, out.position.begin());
    std::copy_n(vertex.color, 4, out.color.begin());
    std::copy_n(vertex.normal, 3, out.normal.begin());
    for (std::size_t unit = 0; unit < kTextureUnits; ++unit)
      std::copy_n(vertex.texcoord[unit], 4, out.texture_coordinate[unit].begin());
    emitted_.back().vertices.push_back(out);
  }

  static inline thread_local ProductionContext* of_the_case_ = nullptr;

  const gl::Table& table_;
  std::map<GLuint, glev_context*> contexts_;
  std::vector<ObservedPrimitive> emitted_;
};

class Production final : public Implementation {
 public:
  std::string name() const override { return "production"; }
  std::unique_ptr<Context> create_context() override { return std::make_unique<ProductionContext>(table_); }

 private:
  gl::Table table_ = [] {
    gl::Table table = bind_functions();
    table.OtherContextEVALCTS = &ProductionContext::other;
    table.MoveToThreadEVALCTS = [](GLuint) {};
    return table;
  }();
};

}  // namespace

std::unique_ptr<Implementation> open_production() { return std::make_unique<Production>(); }

}  // namespace evalcts
