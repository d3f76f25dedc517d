// libglevaluator as an implementation.
#include <glevaluator.h>

#include <algorithm>
#include <map>
#include <utility>

#include <evalcts/gl/bind_methods.h>
#include "kinds.h"

namespace evalcts {
namespace {

struct CurrentHandle {
  static inline thread_local glev_context* current = nullptr;
};

gl::Table bind_functions() {
  gl::Table table;
#define BIND(name) table.name = &Forward<CurrentHandle, &glev##name>::call
  BIND(Map1f);
  BIND(Map1d);
  BIND(Map2f);
  BIND(Map2d);
  BIND(MapGrid1f);
  BIND(MapGrid1d);
  BIND(MapGrid2f);
  BIND(MapGrid2d);
  BIND(EvalCoord1f);
  BIND(EvalCoord1d);
  BIND(EvalCoord1fv);
  BIND(EvalCoord1dv);
  BIND(EvalCoord2f);
  BIND(EvalCoord2d);
  BIND(EvalCoord2fv);
  BIND(EvalCoord2dv);
  BIND(EvalPoint1);
  BIND(EvalPoint2);
  BIND(EvalMesh1);
  BIND(EvalMesh2);
  BIND(GetMapfv);
  BIND(GetMapdv);
  BIND(GetMapiv);
  BIND(GetnMapfv);
  BIND(GetnMapdv);
  BIND(GetnMapiv);
  BIND(Enable);
  BIND(Disable);
  BIND(IsEnabled);
  BIND(GetBooleanv);
  BIND(GetIntegerv);
  BIND(GetFloatv);
  BIND(GetDoublev);
  BIND(GetString);
  BIND(GetError);
  BIND(Flush);
  BIND(Finish);
  BIND(Begin);
  BIND(End);
  BIND(Vertex2f);
  BIND(Vertex2d);
  BIND(Vertex3f);
  BIND(Vertex3d);
  BIND(Vertex4f);
  BIND(Vertex4d);
  BIND(Vertex2fv);
  BIND(Vertex3fv);
  BIND(Vertex4fv);
  BIND(Vertex2dv);
  BIND(Vertex3dv);
  BIND(Vertex4dv);
  BIND(Color3f);
  BIND(Color3d);
  BIND(Color4f);
  BIND(Color4d);
  BIND(Color3fv);
  BIND(Color3dv);
  BIND(Color4fv);
  BIND(Color4dv);
  BIND(Normal3f);
  BIND(Normal3d);
  BIND(Normal3fv);
  BIND(Normal3dv);
  BIND(TexCoord1f);
  BIND(TexCoord2f);
  BIND(TexCoord3f);
  BIND(TexCoord4f);
  BIND(TexCoord1d);
  BIND(TexCoord2d);
  BIND(TexCoord3d);
  BIND(TexCoord4d);
  BIND(TexCoord1fv);
  BIND(TexCoord2fv);
  BIND(TexCoord3fv);
  BIND(TexCoord4fv);
  BIND(TexCoord1dv);
  BIND(TexCoord2dv);
  BIND(TexCoord3dv);
  BIND(TexCoord4dv);
  BIND(MultiTexCoord1f);
  BIND(MultiTexCoord2f);
  BIND(MultiTexCoord3f);
  BIND(MultiTexCoord4f);
  BIND(MultiTexCoord1d);
  BIND(MultiTexCoord2d);
  BIND(MultiTexCoord3d);
  BIND(MultiTexCoord4d);
  BIND(MultiTexCoord1fv);
  BIND(MultiTexCoord2fv);
  BIND(MultiTexCoord3fv);
  BIND(MultiTexCoord4fv);
  BIND(MultiTexCoord1dv);
  BIND(MultiTexCoord2dv);
  BIND(MultiTexCoord3dv);
  BIND(MultiTexCoord4dv);
  BIND(Indexf);
  BIND(Indexd);
  BIND(Indexfv);
  BIND(Indexdv);
  BIND(EdgeFlag);
  BIND(EdgeFlagv);
  BIND(ActiveTexture);
  BIND(NewList);
  BIND(EndList);
  BIND(CallList);
  BIND(CallLists);
  BIND(ListBase);
  BIND(GenLists);
  BIND(IsList);
  BIND(DeleteLists);
  BIND(PushAttrib);
  BIND(PopAttrib);
#undef BIND
  return table;
}

// A context, and further contexts that a case has made. They share no objects.
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
  bool has_sink() const override { return true; }
  std::vector<ObservedPrimitive> take_emitted() override { return std::exchange(emitted_, {}); }

  // Implements the command of gl/contexts.h.
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
    return table;
  }();
};

}  // namespace

std::unique_ptr<Implementation> open_production() { return std::make_unique<Production>(); }

}  // namespace evalcts
