// Benchmarks the CPU evaluator of OpenSubdiv, with bicubic B-splines that are equal to the Bezier patches of
// the workloads.
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuPatchTable.h>

#include <array>
#include <cmath>
#include <memory>

#include "side.h"

namespace evalcts::bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;
namespace Sdc = OpenSubdiv::Sdc;

// The matrix that converts Bezier control points to B-spline control points in one direction.
constexpr double kFromBezier[4][4] = {{6, -7, 2, 0}, {0, 2, -1, 0}, {0, -1, 2, 0}, {0, 2, -7, 6}};

std::vector<float> spline_points(const Mesh& mesh) {
  std::vector<float> result(16 * 3);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int j = 0; j < 4; ++j) {
          for (int i = 0; i < 4; ++i)
            sum += kFromBezier[row][j] * kFromBezier[column][i] * mesh.points[(j * 4 + i) * 3 + k];
        }
        result[(row * 4 + column) * 3 + k] = static_cast<float>(sum);
      }
    }
  }
  return result;
}

// Makes the one patch of a net of 4 x 4 points, whose outer faces have no limit surface.
std::unique_ptr<Osd::CpuPatchTable> patch() {
  const std::vector<int> sizes(9, 4);
  std::vector<int> corners;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int first = j * 4 + i;
      for (const int corner : {first, first + 1, first + 5, first + 4}) corners.push_back(corner);
    }
  }
  Far::TopologyDescriptor net;
  net.numVertices = 16;
  net.numFaces = 9;
  net.numVertsPerFace = sizes.data();
  net.vertIndicesPerFace = corners.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Sdc::Options boundary;
  boundary.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE);
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(net, Factory::Options(Sdc::SCHEME_CATMARK, boundary)));
  refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(0));
  const std::unique_ptr<Far::PatchTable> table(
      Far::PatchTableFactory::Create(*refiner, Far::PatchTableFactory::Options(0)));
  return std::make_unique<Osd::CpuPatchTable>(table.get());
}

MeshSide side(const Mesh& mesh) {
  const std::shared_ptr<Osd::CpuPatchTable> table = patch();
  std::vector<Osd::PatchCoord> places;
  for (int j = 0; j < mesh.rows; ++j) {
    for (int i = 0; i < mesh.columns; ++i)
      places.emplace_back(Far::PatchTable::PatchHandle{}, mesh.u(i), mesh.v(j));
  }
  const int values = mesh.values();
  const auto slopes =
      std::make_shared<std::vector<float>>(static_cast<std::size_t>(mesh.columns) * mesh.ring * 6);
  return [&mesh, table, places, values, slopes, points = spline_points(mesh)](int row, int rows,
                                                                              float* results) {
    const Osd::BufferDescriptor from(0, 3, 3), to(0, 3, values), along_u(0, 3, 6), along_v(3, 3, 6);
    const Osd::PatchCoord* const first = places.data() + static_cast<std::size_t>(row) * mesh.columns;
    const int count = rows * mesh.columns;
    if (!mesh.normals) {
      Osd::CpuEvaluator::EvalPatches(points.data(), from, results, to, count, first,
                                     table->GetPatchArrayBuffer(), table->GetPatchIndexBuffer(),
                                     table->GetPatchParamBuffer());
      return;
    }
    Osd::CpuEvaluator::EvalPatches(points.data(), from, results, to, slopes->data(), along_u, slopes->data(),
                                   along_v, count, first, table->GetPatchArrayBuffer(),
                                   table->GetPatchIndexBuffer(), table->GetPatchParamBuffer());
    for (int i = 0; i < count; ++i) {
      const float* const a = slopes->data() + 6 * i;
      const float* const b = a + 3;
      const float x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
      const float length = std::sqrt(x * x + y * y + z * z);
      float* const normal = results + 6 * i + 3;
      normal[0] = x / length;
      normal[1] = y / length;
      normal[2] = z / length;
    }
  };
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Mesh& mesh : meshes()) {
    if (mesh.order != 4 || mesh.components != 3 || mesh.ring == mesh.rows) continue;
    add(mesh, "OpenSubdiv", Unit::kStrip, [&mesh] { return side(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
