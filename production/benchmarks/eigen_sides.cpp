// Benchmarks Eigen: a whole grid is one product of float matrices. This file is compiled for the machine,
// with -O3.
#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "side.h"

namespace evalcts::bench {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Net = Eigen::Map<const Matrix>;
using Rows = Eigen::Map<Matrix>;

// Returns the matrix of the values of Bernstein polynomial j at argument i.
Matrix basis(int order, const Eigen::VectorXf& t) {
  Matrix result(t.size(), order);
  const int degree = order - 1;
  double binomial = 1;
  for (int j = 0; j < order; ++j) {
    result.col(j) = static_cast<float>(binomial) * t.array().pow(j) * (1 - t.array()).pow(degree - j);
    binomial = binomial * (degree - j) / (j + 1);
  }
  return result;
}

// Returns the derivatives of the Bernstein polynomials, divided by the degree.
Matrix derivatives(int order, const Eigen::VectorXf& t) {
  const Matrix lower = basis(order - 1, t);
  Matrix result = Matrix::Zero(t.size(), order);
  result.leftCols(order - 1) -= lower;
  result.rightCols(order - 1) += lower;
  return result;
}

// The factors of the product. The left factor of a row of the grid is a row of `v`; the right factor has x y
// z of all columns side by side.
struct Factors {
  Matrix v, right;
};

Matrix right_factor(const Mesh& mesh, const Matrix& u) {
  Matrix result(mesh.order, mesh.columns * mesh.components);
  for (int j = 0; j < mesh.order; ++j) {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(j) * mesh.order * mesh.components;
    Rows(result.row(j).data(), mesh.columns, mesh.components).noalias() =
        u * Net(mesh.points.data() + row, mesh.order, mesh.components);
  }
  return result;
}

Eigen::VectorXf grid(int count) { return Eigen::VectorXf::LinSpaced(count, 0, 1); }

// Both factors are computed for each mesh, as a new surface requires.
MeshSide positions(const Mesh& mesh) {
  return [&mesh, factors = std::make_shared<Factors>()](int row, int rows, float* results) {
    if (row == 0) {
      factors->v = basis(mesh.order, grid(mesh.rows));
      factors->right = right_factor(mesh, basis(mesh.order, grid(mesh.columns)));
    }
    Rows(results, rows, factors->right.cols()).noalias() = factors->v.middleRows(row, rows) * factors->right;
  };
}

struct NormalFactors {
  Factors position, slope;
  Matrix at, along_u, along_v;
};

MeshSide with_normals(const Mesh& mesh) {
  return [&mesh, all = std::make_shared<NormalFactors>()](int row, int rows, float* results) {
    if (row == 0) {
      all->position.v = basis(mesh.order, grid(mesh.rows));
      all->slope.v = derivatives(mesh.order, grid(mesh.rows));
      all->position.right = right_factor(mesh, basis(mesh.order, grid(mesh.columns)));
      all->slope.right = right_factor(mesh, derivatives(mesh.order, grid(mesh.columns)));
    }
    all->at.noalias() = all->position.v.middleRows(row, rows) * all->position.right;
    all->along_u.noalias() = all->position.v.middleRows(row, rows) * all->slope.right;
    all->along_v.noalias() = all->slope.v.middleRows(row, rows) * all->position.right;
    const float* __restrict at = all->at.data();
    const float* __restrict a = all->along_u.data();
    const float* __restrict b = all->along_v.data();
    float* __restrict to = results;
    const std::ptrdiff_t count = all->at.size() / 3;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const float x = a[3 * i + 1] * b[3 * i + 2] - a[3 * i + 2] * b[3 * i + 1];
      const float y = a[3 * i + 2] * b[3 * i] - a[3 * i] * b[3 * i + 2];
      const float z = a[3 * i] * b[3 * i + 1] - a[3 * i + 1] * b[3 * i];
      const float scale = 1 / std::sqrt(x * x + y * y + z * z);
      for (int k = 0; k < 3; ++k) to[6 * i + k] = at[3 * i + k];
      to[6 * i + 3] = x * scale;
      to[6 * i + 4] = y * scale;
      to[6 * i + 5] = z * scale;
    }
  };
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Mesh& mesh : meshes()) {
    add(mesh, "Eigen", Unit::kMesh, [&mesh] { return mesh.normals ? with_normals(mesh) : positions(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
