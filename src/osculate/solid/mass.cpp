#include "osculate/solid/mass.hpp"

#include <Eigen/LU>

#include "osculate/cell/quadrature.hpp"
#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {
namespace {

/// Exact for N_i N_j times the Jacobian (and the radius of a ring) of a straight-sided cell.
cell::Quadrature2D area_mass_rule(cell::CellType type) {
  switch (type) {
    case cell::CellType::tri3:
      return cell::gauss_triangle(3);
    case cell::CellType::tri6:
      return cell::gauss_triangle(6);
    case cell::CellType::quad4:
      return cell::gauss_quad(3);
    default:
      return cell::gauss_quad(4);
  }
}

cell::Quadrature3D volume_mass_rule(cell::CellType type) {
  switch (type) {
    case cell::CellType::tet4:
      return cell::gauss_tetrahedron(2);
    case cell::CellType::tet10:
      return cell::gauss_tetrahedron(4);
    case cell::CellType::wedge6:
      return cell::gauss_wedge(4, 3);
    case cell::CellType::wedge15:
      return cell::gauss_wedge(6, 4);
    case cell::CellType::hex8:
      return cell::gauss_hex(3);
    case cell::CellType::shell18:
      return cell::gauss_hex(4, 3);
    default:
      return cell::gauss_hex(4);
  }
}

}  // namespace

NodeMass consistent_mass(const Section& section, cell::CellType type,
                         const Coordinates& reference) {
  const Eigen::Index n = reference.rows();
  NodeMass mass = NodeMass::Zero(n, n);
  const cell::Quadrature2D rule = area_mass_rule(type);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const PointGeometry g =
        point_geometry(section, cell::area_shape(type, rule.points[q]), reference, rule.weights[q]);
    mass += g.volume * g.shape.n.head(n) * g.shape.n.head(n).transpose();
  }
  return mass;
}

NodeMass consistent_mass(const VolumeSection&, cell::CellType type, const Coordinates3& reference) {
  const Eigen::Index n = reference.rows();
  NodeMass mass = NodeMass::Zero(n, n);
  const cell::Quadrature3D rule = volume_mass_rule(type);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::VolumeShape s = cell::volume_shape(type, rule.points[q]);
    const Mat<3, 3> j = reference.transpose() * s.d.topRows(n);
    mass += rule.weights[q] * j.determinant() * s.n.head(n) * s.n.head(n).transpose();
  }
  return mass;
}

NodeMass lumped_mass(const NodeMass& consistent) {
  NodeMass lumped = NodeMass::Zero(consistent.rows(), consistent.cols());
  double sum = 0;  // one by one: the bits of a sum by packets depend on the place in memory
  for (Eigen::Index j = 0; j < consistent.cols(); ++j)
    for (Eigen::Index i = 0; i < consistent.rows(); ++i) sum += consistent(i, j);
  lumped.diagonal() = consistent.diagonal() * (sum / consistent.trace());
  return lumped;
}

}  // namespace osculate::solid
