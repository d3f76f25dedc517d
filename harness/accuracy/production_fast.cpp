// The subject production-fast: meshes of libglevaluator with GLEV_FAST. Each argument is evaluated as a mesh
// of one point of a grid of 2^24 segments.
#include <glevaluator.h>

#include <cmath>
#include <new>

#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {
namespace {

constexpr int kLog2Segments = 24;

class ProductionFast final : public Subject {
 public:
  ProductionFast() {
    info_.name = "production-fast";
    if (glevCreateContext(nullptr, &context_) != GLEV_SUCCESS) throw CannotStart("glevCreateContext failed");
    glevGetIntegerv(context_, GLEV_MAX_EVAL_ORDER, &info_.max_eval_order);
    info_.version = reinterpret_cast<const char*>(glevGetString(context_, GLEV_VERSION));
    info_.renderer = reinterpret_cast<const char*>(glevGetString(context_, GLEV_RENDERER));
    info_.vendor = reinterpret_cast<const char*>(glevGetString(context_, GLEV_VENDOR));
  }
  ProductionFast(const ProductionFast&) = delete;
  ProductionFast& operator=(const ProductionFast&) = delete;
  ~ProductionFast() override { glevDestroyContext(context_); }

  ImplementationInfo info() const override { return info_; }
  bool has_targets() const override { return false; }

  void evaluate(GLenum, const Map& map, std::span<const float> u, std::span<const float> v,
                std::span<float> results) override {
    const bool two_dimensional = !v.empty();
    if (map.domain != kUnitDomain) throw NotObservable("only maps over [0,1] are evaluated here");
    for (const std::span<const float> arguments : {u, v})
      for (const float x : arguments)
        if (x < 0 || x > 1 || std::ldexp(x, kLog2Segments) != std::floor(std::ldexp(x, kLog2Segments)))
          throw NotObservable("only multiples of 2^-24 from 0 to 1 are evaluated here");
    const int segments = 1 << kLog2Segments;
    const glev_enum first = two_dimensional ? GLEV_MAP2_TEXTURE_COORD_1 : GLEV_MAP1_TEXTURE_COORD_1;
    const glev_enum target = first + static_cast<glev_enum>(map.components - 1);
    for (glev_enum other = first; other < first + 4; ++other) glevDisable(context_, other);
    glevEnable(context_, target);
    if (two_dimensional) {
      glevMap2d(context_, target, 0, 1, map.vorder * map.components, map.uorder, 0, 1, map.components,
                map.vorder, map.points.data());
      glevMapGrid2d(context_, segments, 0, 1, segments, 0, 1);
    } else {
      glevMap1d(context_, target, 0, 1, map.components, map.uorder, map.points.data());
      glevMapGrid1d(context_, segments, 0, 1);
    }
    glev_plan* plan = nullptr;
    const glev_plan_info plan_info = {sizeof plan_info, two_dimensional ? std::size_t{2} : std::size_t{1}};
    if (glevGetError(context_) != GLEV_NO_ERROR ||
        glevCreatePlan(context_, &plan_info, &plan) != GLEV_SUCCESS)
      throw NotObservable("the map is rejected");
    const std::unique_ptr<glev_plan, void (*)(glev_plan*)> release(plan, glevReleasePlan);

    glev_output output{};
    output.size = sizeof output;
    output.components = map.components;
    output.stride = output.data_size = map.components * sizeof(float);
    glev_mesh mesh{};
    mesh.size = sizeof mesh;
    mesh.precision = GLEV_FAST;
    const glev_attribute_output outputs = {GLEV_ATTRIBUTE_TEXCOORD, &output};
    mesh.outputs = &outputs;
    mesh.output_count = 1;
    std::vector<std::byte> scratch;
    for (std::size_t a = 0; a < u.size(); ++a) {
      mesh.i1 = mesh.i2 = static_cast<int>(std::ldexp(u[a], kLog2Segments));
      mesh.j1 = mesh.j2 = two_dimensional ? static_cast<int>(std::ldexp(v[a], kLog2Segments)) : 0;
      output.data = &results[a * map.components];
      scratch.resize(glevGetMeshScratchSize(plan, &mesh));
      mesh.scratch = scratch.data();
      mesh.scratch_size = scratch.size();
      if (glevEvaluateMesh(plan, &mesh) != GLEV_SUCCESS) throw NotObservable("a mesh is rejected");
    }
  }

 private:
  glev_context* context_ = nullptr;
  ImplementationInfo info_;
};

}  // namespace

std::unique_ptr<Subject> make_production_fast() { return std::make_unique<ProductionFast>(); }

}  // namespace evalcts::accuracy
