#include <Eigen/LU>
#include <Eigen/QR>

#include "osculate/solid/enhanced.hpp"

namespace osculate::solid {
namespace {

/// Cauchy stress of one point from its second Piola-Kirchhoff stress.
Vec<4> cauchy(const PointStrain& p, const Vec<4>& s, double f33) {
  Mat<2, 2> stress;
  stress << s[0], s[3], s[3], s[1];
  const double j = p.f.determinant() * f33;
  const Mat<2, 2> sigma = p.f * stress * p.f.transpose() / j;
  return {sigma(0, 0), sigma(1, 1), f33 * f33 * s[2] / j, sigma(0, 1)};
}

/// Polynomial basis for the extrapolation: as many terms as the points can carry.
Eigen::RowVectorXd basis(const Vec2& xi, std::size_t points) {
  Eigen::RowVectorXd b(points == 1 ? 1 : points < 6 ? 3 : 6);
  b[0] = 1;
  if (b.size() >= 3) b.segment<2>(1) << xi.x(), xi.y();
  if (b.size() >= 6) b.segment<3>(3) << xi.x() * xi.y(), xi.x() * xi.x(), xi.y() * xi.y();
  return b;
}

}  // namespace

NodalStress nodal_stress(const Section& section, cell::CellType type, const Coordinates& reference,
                         const Coordinates& displacement) {
  const cell::Quadrature2D& rule = quadrature_of(type);
  const auto points = static_cast<Eigen::Index>(rule.points.size());
  Eigen::MatrixXd values(points, 8), sample(points, basis(Vec2::Zero(), rule.points.size()).size());
  std::array<PointGeometry, max_points> geometry;
  std::array<PointStrain, max_points> strains;
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    geometry[i] = point_geometry(section, type, reference, rule.points[i], rule.weights[i]);
    strains[i] = point_strain(section, geometry[i], displacement);
  }
  if (section.formulation == Formulation::enhanced) {
    const EnhancedModes e = enhanced_modes(section, reference, geometry, strains);
    if (e.ok)
      for (std::size_t i = 0; i < 4; ++i) strains[i].strain += e.matrix[i] * e.alpha;
  }
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto i = static_cast<std::size_t>(q);
    const PointStrain& p = strains[i];
    double strain_33 = 0;
    const material::Response r = point_response(section, p.strain, &strain_33);
    Vec<4> strain = p.strain;
    strain[2] = strain_33;
    strain[3] *= 0.5;
    const bool finite = section.kinematics == Kinematics::finite;
    const double f33 = section.assumption == Assumption::plane_stress
                           ? std::sqrt(std::max(0.0, 1 + 2 * strain_33))
                           : p.f33;
    values.row(q) << (finite ? cauchy(p, r.stress, f33) : r.stress).transpose(), strain.transpose();
    sample.row(q) = basis(rule.points[i], rule.points.size());
  }
  const Eigen::MatrixXd fit = sample.colPivHouseholderQr().solve(values);
  NodalStress out;
  out.count = cell::info(type).nodes;
  for (int k = 0; k < out.count; ++k) {
    const Eigen::RowVectorXd at = basis(cell::area_node(type, k), rule.points.size()) * fit;
    out.stress[static_cast<std::size_t>(k)] = at.head<4>();
    out.strain[static_cast<std::size_t>(k)] = at.tail<4>();
  }
  return out;
}

}  // namespace osculate::solid
