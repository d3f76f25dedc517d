// The subject production-fast: meshes of libglevaluator with GLEV_FAST. Each argument is evaluated as a mesh
// of one point of a grid of 2^24 segments.
#include <glevaluator.h>

#include <cmath>

#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {
namespace {

class ProductionFast final : public Subject {
 public:
  ImplementationInfo info() const override {
    ImplementationInfo info;
    info.name = "production-fast";
    return info;
  }
  bool has_targets() const override { return false; }

  std::vector<float> evaluate(GLenum, const Map& map, std::span<const float> u,
                              std::span<const float> v) override {
    constexpr int kSegments = 1 << 24;
    if (map.domain != kUnitDomain) throw NotObservable("only maps over [0,1] are evaluated here");
    for (const std::span<const float> arguments : {u, v})
      for (const float x : arguments)
        if (!(x >= 0 && x <= 1) || x * kSegments != std::floor(x * kSegments))
          throw NotObservable("only multiples of 2^-24 from 0 to 1 are evaluated here");
    glev_patches patch{};
    patch.size = sizeof patch;
    patch.count = 1;
    patch.components = static_cast<std::size_t>(map.components);
    patch.uorder = map.uorder;
    patch.vorder = map.vorder;
    patch.type = GLEV_DOUBLE;
    patch.points = map.points.data();
    patch.points_size = map.points.size() * sizeof(double);
    patch.u1 = patch.v1 = 0;
    patch.u2 = patch.v2 = 1;
    glev_map_info info{};
    info.size = sizeof info;
    info.target = (v.empty() ? GLEV_MAP1_TEXTURE_COORD_1 : GLEV_MAP2_TEXTURE_COORD_1) +
                  static_cast<glev_enum>(map.components - 1);
    info.map = &patch;
    info.u_segments = kSegments;
    info.v_segments = v.empty() ? 0 : kSegments;
    glev_plan* plan = nullptr;
    if (glevCreatePlanFromMap(&info, &plan) != GLEV_SUCCESS) throw NotObservable("the map is rejected");
    const std::unique_ptr<glev_plan, void (*)(glev_plan*)> release(plan, glevReleasePlan);

    std::vector<float> results(u.size() * patch.components);
    glev_output output{};
    output.size = sizeof output;
    output.components = patch.components;
    output.stride = output.data_size = patch.components * sizeof(float);
    const glev_attribute_output outputs = {GLEV_ATTRIBUTE_TEXCOORD, &output};
    glev_mesh mesh{};
    mesh.size = sizeof mesh;
    mesh.precision = GLEV_FAST;
    mesh.outputs = &outputs;
    mesh.output_count = 1;
    std::vector<std::byte> scratch(glevGetMeshScratchSize(plan, &mesh));
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size();
    for (std::size_t i = 0; i < u.size(); ++i) {
      mesh.i1 = mesh.i2 = static_cast<int>(u[i] * kSegments);
      mesh.j1 = mesh.j2 = v.empty() ? 0 : static_cast<int>(v[i] * kSegments);
      output.data = &results[i * patch.components];
      if (glevEvaluateMesh(plan, &mesh) != GLEV_SUCCESS) throw NotObservable("a mesh is rejected");
    }
    return results;
  }
};

}  // namespace

std::unique_ptr<Subject> make_production_fast() { return std::make_unique<ProductionFast>(); }

}  // namespace evalcts::accuracy
