#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osculate/core/dense.hpp"
#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/stress_tensor.hpp"

namespace osculate::solid {
namespace {

/// Cauchy stress of one point from its second Piola-Kirchhoff stress.
Vec<4> cauchy(const PointStrain& p, const Vec<4>& s, double f33) {
  const double j = p.f.determinant() * f33;
  const Mat<2, 2> sigma = p.f * stress_tensor(s) * p.f.transpose() / j;
  return {sigma(0, 0), sigma(1, 1), f33 * f33 * s[2] / j, sigma(0, 1)};
}

template <int Count>
Status enhance(const Section& section, const Coordinates& reference, const material::Memory& memory,
               Points& points) {
  const EnhancedModes<Count> e = enhanced_modes<Count>(section, reference, points, memory);
  if (!e.ok) return Status::material_failed;
  for (std::size_t q = 0; q < 4; ++q) points.strain[q].strain += e.matrix[q] * e.alpha;
  return Status::ok;
}

/// Replaces the strains of the displacements by those the material sees.
Status assume_strains(const Section& section, const Coordinates& reference,
                      const Coordinates& displacement, const material::Memory& memory,
                      Points& points) {
  if (section.formulation == Formulation::enhanced)
    return section.assumption == Assumption::axisymmetric
               ? enhance<ring_modes>(section, reference, memory, points)
               : enhance<plane_modes>(section, reference, memory, points);
  if (section.formulation == Formulation::bbar) {
    if (section.kinematics == Kinematics::finite)
      points = mean_dilatation(points).point;
    else
      average_volume_small(points, displacement);
  }
  return Status::ok;
}

/// Stress and strain of one point; false where the law has no answer.
bool fill_stress(const Section& section, const PointStrain& p, const material::Memory& memory,
                 PointStress& out) {
  double strain_33 = 0;
  const material::Response r = point_response(section, p.strain, memory, &strain_33);
  out.strain = p.strain;
  out.strain[2] = strain_33;
  out.strain[3] *= 0.5;
  const double f33 = section.assumption == Assumption::plane_stress
                         ? std::sqrt(std::max(0.0, 1 + 2 * strain_33))
                         : p.f33;
  out.stress =
      section.kinematics == Kinematics::finite && r.ok ? cauchy(p, r.stress, f33) : r.stress;
  return r.ok;
}

/// Polynomial basis for the extrapolation: as many terms as the points can carry.
constexpr int max_terms = 6;
using Basis = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, max_terms>;

Basis basis(const Vec2& xi, int points) {
  Basis b(points == 1 ? 1 : points < 6 ? 3 : 6);
  b[0] = 1;
  if (b.size() >= 3) b.segment<2>(1) << xi.x(), xi.y();
  if (b.size() >= 6) b.segment<3>(3) << xi.x() * xi.y(), xi.x() * xi.x(), xi.y() * xi.y();
  return b;
}

}  // namespace

CellStress stress_at_points(const Section& section, cell::CellType type,
                            const Coordinates& reference, const Coordinates& displacement,
                            const material::Memory& memory) {
  const AreaRule& rule = area_rule(section.assumption, type);
  CellStress out;
  Points points;
  const bool one_to_one = fill_points(section, type, reference, displacement, points);
  out.status = one_to_one ? assume_strains(section, reference, displacement, memory, points)
                          : Status::inverted;
  out.count = static_cast<int>(rule.points.size());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    PointStress& p = out.point[q];
    const PointGeometry& g = points.geometry[q];
    p.xi = rule.points[q];
    p.position = reference.transpose() * g.shape.n.head(g.shape.count);
    p.volume = g.volume;
    p.stress.setZero();
    p.strain.setZero();
    if (one_to_one && !fill_stress(section, points.strain[q], memory.at(q), p) &&
        out.status == Status::ok)
      out.status = Status::material_failed;
  }
  return out;
}

Eigen::MatrixXd at_nodes(const Section& section, cell::CellType type,
                         const Eigen::MatrixXd& of_points) {
  const auto count = static_cast<int>(of_points.rows());
  const Eigen::Index terms = basis(Vec2::Zero(), count).size(), nodes = cell::info(type).nodes;
  const AreaRule& rule = area_rule(section.assumption, type);
  Eigen::MatrixXd sample(count, terms), to(nodes, terms);
  for (int q = 0; q < count; ++q)
    sample.row(q) = basis(rule.points[static_cast<std::size_t>(q)], count);
  for (int k = 0; k < nodes; ++k) to.row(k) = basis(cell::area_node(type, k), count);
  return to * core::least_squares(sample, of_points);
}

NodalStress nodal_stress(const Section& section, cell::CellType type, const Coordinates& reference,
                         const Coordinates& displacement, const material::Memory& memory) {
  const CellStress at = stress_at_points(section, type, reference, displacement, memory);
  const Eigen::Index terms = basis(Vec2::Zero(), at.count).size();
  Eigen::Matrix<double, Eigen::Dynamic, 8, 0, max_points, 8> values(at.count, 8);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_points, max_terms> sample(at.count,
                                                                                         terms);
  for (int q = 0; q < at.count; ++q) {
    const PointStress& p = at.point[static_cast<std::size_t>(q)];
    values.row(q) << p.stress.transpose(), p.strain.transpose();
    sample.row(q) = basis(p.xi, at.count);
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 8, 0, max_terms, 8> fit =
      core::least_squares(sample, values);
  NodalStress out;
  out.count = cell::info(type).nodes;
  for (int k = 0; k < out.count; ++k) {
    const Mat<1, 8> node = basis(cell::area_node(type, k), at.count) * fit;
    out.stress[static_cast<std::size_t>(k)] = node.head<4>();
    out.strain[static_cast<std::size_t>(k)] = node.tail<4>();
  }
  return out;
}

}  // namespace osculate::solid
