#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "osculate/la/places.hpp"
#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la::test {

/// A block of springs between all nodes of each unit cell: isotropic enough, and its rigid motions
/// are free of energy. Nodes of z = 0 are held unless it is free: their rows are 1 on the diagonal.
class ElasticBlock {
 public:
  ElasticBlock(Index nx, Index ny, Index nz, bool held = true)
      : size_{nx, ny, nz}, held_(held), builder_(3 * (nx + 1) * (ny + 1) * (nz + 1)) {
    for (Index z = 0; z < nz; ++z)
      for (Index y = 0; y < ny; ++y)
        for (Index x = 0; x < nx; ++x) add_cell(x, y, z);
    for (Index i = 0; i < unknowns(); ++i)
      if (this->held(i)) builder_.add(i, i, 1);
  }
  [[nodiscard]] Index unknowns() const { return 3 * nodes(); }
  [[nodiscard]] Index nodes() const { return (size_[0] + 1) * (size_[1] + 1) * (size_[2] + 1); }
  [[nodiscard]] const SparseMatrix& matrix() const { return builder_.finish(); }
  [[nodiscard]] MatrixBuilder& builder() { return builder_; }
  [[nodiscard]] Index node(Index x, Index y, Index z) const {
    return x + (size_[0] + 1) * (y + (size_[1] + 1) * z);
  }
  [[nodiscard]] Eigen::Vector3d place(Index n) const {
    const Index a = size_[0] + 1, b = size_[1] + 1;
    return {static_cast<double>(n % a), static_cast<double>(n / a % b),
            static_cast<double>(n / a / b)};
  }
  [[nodiscard]] bool held(Index unknown) const { return held_ && place(unknown / 3).z() == 0; }
  [[nodiscard]] Eigen::MatrixXd rigid_motions() const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns(), 6);
    for (Index i = 0; i < unknowns(); ++i) {
      if (held(i)) continue;
      out(i, i % 3) = 1;
      for (int axis = 0; axis < 3; ++axis)
        out(i, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(place(i / 3))[i % 3];
    }
    return out;
  }
  /// Unknowns of the upper side are exact.
  [[nodiscard]] Places places() const {
    Places out;
    out.dimension = 3;
    for (Index i = 0; i < unknowns(); ++i) {
      out.node.push_back(i / 3);
      out.direction.push_back(i % 3);
      out.place.push_back(place(i / 3));
      out.exact.push_back(place(i / 3).z() == size_[2] ? 1 : 0);
    }
    return out;
  }

 private:
  void add_cell(Index x, Index y, Index z) {
    std::array<Index, 8> of{};
    for (Index k = 0; k < 8; ++k)
      of[static_cast<std::size_t>(k)] = node(x + k % 2, y + k / 2 % 2, z + k / 4);
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = a + 1; b < 8; ++b) add_spring(of[a], of[b]);
  }
  void add_spring(Index a, Index b) {
    const Eigen::Vector3d along = (place(b) - place(a)).normalized();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double k = along[i] * along[j];
        put(3 * a + i, 3 * a + j, k);
        put(3 * b + i, 3 * b + j, k);
        put(3 * a + i, 3 * b + j, -k);
        put(3 * b + i, 3 * a + j, -k);
      }
  }
  void put(Index i, Index j, double k) {
    if (!held(i) && !held(j)) builder_.add(i, j, k);
  }

  std::array<Index, 3> size_;
  bool held_;
  mutable MatrixBuilder builder_;
};

}  // namespace osculate::la::test
