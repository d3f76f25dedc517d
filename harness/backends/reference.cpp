// The executable specification as an implementation: each emitted value is the exact value, correctly
// rounded.
#include <reference/specification.h>

#include <cstdlib>
#include <map>

#include <evalcts/gl/bind_methods.h>
#include "kinds.h"

namespace evalcts {
namespace {

using reference::Specification;

struct CurrentSpecification {
  static inline thread_local Specification* current = nullptr;
};

ObservedVertex rounded(const reference::Vertex& vertex) {
  ObservedVertex out;
  const auto round = [](const auto& components, auto& values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = reference::rounded(components[i]);
  };
  round(vertex.position, out.position);
  round(vertex.color, out.color);
  out.normal = reference::rounded(vertex.normal);
  for (std::size_t unit = 0; unit < kTextureUnits; ++unit)
    round(vertex.texture_coordinate[unit], out.texture_coordinate[unit]);
  return out;
}

// Returns MAX_EVAL_ORDER, which the environment variable EVALCTS_MAX_EVAL_ORDER can change. Every test must
// pass with the smallest value that the GL allows, too.
int max_eval_order() {
  const char* const wanted = std::getenv("EVALCTS_MAX_EVAL_ORDER");
  return wanted ? std::atoi(wanted) : reference::kMaxOrder;
}

// The initial context of a case, and the further contexts that the case makes.
class ReferenceContext final : public Context {
 public:
  explicit ReferenceContext(const gl::Table& table) : table_(table) { switch_to(0); }
  ~ReferenceContext() override { CurrentSpecification::current = nullptr; }
  ReferenceContext(const ReferenceContext&) = delete;
  ReferenceContext& operator=(const ReferenceContext&) = delete;

  const gl::Table& table() const override { return table_; }
  bool has_sink() const override { return true; }
  std::vector<ObservedPrimitive> take_emitted() override {
    std::vector<ObservedPrimitive> primitives;
    for (const reference::Primitive& primitive : CurrentSpecification::current->take_primitives()) {
      ObservedPrimitive& observed = primitives.emplace_back();
      observed.mode = primitive.mode;
      for (const reference::Vertex& vertex : primitive.vertices) observed.vertices.push_back(rounded(vertex));
    }
    return primitives;
  }

  // Implements glOtherContextEVALCTS (gl/contexts.h).
  static void other(GLuint number) { of_the_case_->switch_to(number); }

 private:
  void switch_to(GLuint number) {
    of_the_case_ = this;
    CurrentSpecification::current =
        &contexts_.try_emplace(number, Specification::Options{.max_eval_order = max_eval_order()})
             .first->second;
  }

  static inline thread_local ReferenceContext* of_the_case_ = nullptr;

  const gl::Table& table_;
  std::map<GLuint, Specification> contexts_;
};

class Reference final : public Implementation {
 public:
  std::string name() const override { return "reference"; }
  std::unique_ptr<Context> create_context() override { return std::make_unique<ReferenceContext>(table_); }

 private:
  gl::Table table_ = [] {
    gl::Table table = bind_methods<CurrentSpecification, Specification>();
    table.OtherContextEVALCTS = &ReferenceContext::other;
    return table;
  }();
};

}  // namespace

std::unique_ptr<Implementation> open_reference() { return std::make_unique<Reference>(); }

}  // namespace evalcts
