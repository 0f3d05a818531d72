#pragma once
// One quadrature point of a volume element, and the sums over the points; shared by the
// formulations. Templated on the number of nodes N, so that the common cells have loops of known
// length; N = Eigen::Dynamic serves any cell.
#include <Eigen/LU>
#include <vector>

#include "osculate/solid/stress_tensor.hpp"
#include "osculate/solid/volume.hpp"

namespace osculate::solid {

/// Quadrature of a cell type with the shape functions at its points. No formulation leaves a mode
/// without energy.
struct VolumeRule {
  std::vector<Vec3> points;
  std::vector<double> weights;
  std::vector<cell::VolumeShape> shape;
};
[[nodiscard]] const VolumeRule& volume_rule(cell::CellType type);

template <int N>
struct VolumeSizes {
  static constexpr int dofs = N == Eigen::Dynamic ? Eigen::Dynamic : 3 * N;
  static constexpr int most = N == Eigen::Dynamic ? max_volume_nodes : N;
  using Nodal = Eigen::Matrix<double, N, 3, 0, most, 3>;
  using Strains = Eigen::Matrix<double, 6, dofs, Eigen::RowMajor, 6, 3 * most>;
  using Vector = Eigen::Matrix<double, dofs, 1, 0, 3 * most, 1>;
  using Matrix = Eigen::Matrix<double, dofs, dofs, 0, 3 * most, 3 * most>;
  using NodeMatrix = Eigen::Matrix<double, N, N, 0, most, most>;
};

/// Geometry and strain of one point.
template <int N>
struct VolumePoint {
  double volume = 0;  ///< undeformed: weight times determinant
  double determinant = 0;
  Mat<3, 3> f = Mat<3, 3>::Identity();  ///< deformation gradient
  material::Strain3 strain;
  typename VolumeSizes<N>::Nodal gradient;  ///< dN_k/dX
  typename VolumeSizes<N>::Strains b;       ///< d(strain)/du
};

/// Derivative of the strain at the deformation gradient f with respect to the displacements.
template <class Nodal, class Strains>
void fill_strain_matrix(const Mat<3, 3>& f, const Nodal& gradient, Strains& b) {
  for (Eigen::Index k = 0; k < gradient.rows(); ++k) {
    const double x = gradient(k, 0), y = gradient(k, 1), z = gradient(k, 2);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double f0 = f(i, 0), f1 = f(i, 1), f2 = f(i, 2);
      b.col(3 * k + i) << f0 * x, f1 * y, f2 * z, f0 * y + f1 * x, f1 * z + f2 * y, f0 * z + f2 * x;
    }
  }
}

/// Fills `p`; false if det F is not positive (finite kinematics).
template <int N>
[[nodiscard]] bool fill_point(Kinematics kinematics, const cell::VolumeShape& shape, double weight,
                              const typename VolumeSizes<N>::Nodal& reference,
                              const typename VolumeSizes<N>::Nodal& displacement,
                              VolumePoint<N>& p) {
  const Eigen::Index n = reference.rows();
  const Mat<3, 3> jacobian = reference.transpose() * shape.d.topRows(n);  // dX_i/dxi_j
  p.determinant = jacobian.determinant();
  p.volume = weight * p.determinant;
  p.gradient.noalias() = shape.d.topRows(n) * jacobian.inverse();
  const Mat<3, 3> h = displacement.transpose() * p.gradient;  // du_i/dX_j
  p.f = Mat<3, 3>::Identity() + h;
  p.strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
  p.b.resize(6, 3 * n);
  if (kinematics == Kinematics::small) {
    fill_strain_matrix(Mat<3, 3>::Identity(), p.gradient, p.b);
    return true;
  }
  const Mat<3, 3> hh = h.transpose() * h;
  material::Strain3 quadratic;
  quadratic << 0.5 * hh(0, 0), 0.5 * hh(1, 1), 0.5 * hh(2, 2), hh(0, 1), hh(1, 2), hh(0, 2);
  p.strain += quadratic;
  fill_strain_matrix(p.f, p.gradient, p.b);
  return p.f.determinant() > 0;
}

/// Adds b^T s.
template <class Strains, class Stress, class Vector>
void add_force(const Strains& b, const Stress& s, Vector& force) {
  for (Eigen::Index c = 0; c < b.rows(); ++c) force += s[c] * b.row(c).transpose();
}

/// Adds the lower triangle of b^T d b for a symmetric d. The sums run along contiguous rows of b.
template <class Strains, class Matrix>
void add_material(const Strains& b, const material::Tangent3& d, Matrix& lower) {
  Strains db = b;
  for (Eigen::Index c = 0; c < 6; ++c) {
    db.row(c) = d(c, 0) * b.row(0);
    for (Eigen::Index e = 1; e < 6; ++e) db.row(c) += d(c, e) * b.row(e);
  }
  const Eigen::Index dofs = b.cols();
  for (Eigen::Index j = 0; j < dofs; ++j) {
    const Eigen::Index m = dofs - j;
    lower.col(j).tail(m) +=
        (b(0, j) * db.row(0).tail(m) + b(1, j) * db.row(1).tail(m) + b(2, j) * db.row(2).tail(m) +
         b(3, j) * db.row(3).tail(m) + b(4, j) * db.row(4).tail(m) + b(5, j) * db.row(5).tail(m))
            .transpose();
  }
}

/// Adds the lower triangle of grad N_a . s grad N_b, the part of the tangent from the change of B.
template <class Nodal, class NodeMatrix>
void add_geometric(const Nodal& gradient, const material::Stress3& s, NodeMatrix& lower) {
  const Mat<3, 3> stress = stress_tensor(s);
  const Nodal turned = gradient * stress;
  const Eigen::Index n = gradient.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index m = n - j;
    lower.col(j).tail(m) += turned(j, 0) * gradient.col(0).tail(m) +
                            turned(j, 1) * gradient.col(1).tail(m) +
                            turned(j, 2) * gradient.col(2).tail(m);
  }
}

/// Adds the node matrix to each of the three directions and copies the lower triangle upwards.
template <class NodeMatrix, class Matrix>
void finish_tangent(const NodeMatrix& geometric, Matrix& tangent) {
  const Eigen::Index n = geometric.rows();
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = b; a < n; ++a)
      for (Eigen::Index i = 0; i < 3; ++i) tangent(3 * a + i, 3 * b + i) += geometric(a, b);
  tangent.template triangularView<Eigen::StrictlyUpper>() = tangent.transpose();
}

/// The eight points of hex8, for the formulations that couple them.
using HexPoint = VolumePoint<8>;
using HexPoints = std::array<HexPoint, 8>;
using HexSizes = VolumeSizes<8>;

/// Fills all points; false if det F is not positive somewhere (finite kinematics).
[[nodiscard]] bool fill_points(Kinematics kinematics, const Coordinates3& reference,
                               const Coordinates3& displacement, HexPoints& points);

}  // namespace osculate::solid
