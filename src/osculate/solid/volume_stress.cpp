
#include "osculate/core/dense.hpp"
#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/solid_shell.hpp"

namespace osculate::solid {
namespace {

/// What the material sees at the quadrature points.
struct Seen {
  Status status = Status::ok;
  std::array<Mat<3, 3>, max_volume_points> f;
  std::array<material::Strain3, max_volume_points> strain;
};

void see_full(const VolumeSection& section, cell::CellType type, const Coordinates3& reference,
              const Coordinates3& displacement, Seen& out) {
  const VolumeRule& rule = volume_rule(type);
  VolumePoint<Eigen::Dynamic> p;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    if (!fill_point<Eigen::Dynamic>(section.kinematics, rule.shape[q], rule.weights[q], reference,
                                    displacement, p))
      out.status = Status::inverted;
    out.f[q] = p.f;
    out.strain[q] = p.strain;
  }
}

/// The formulations of hex8 that assume strains.
void see_assumed(const VolumeSection& section, const Coordinates3& reference,
                 const Coordinates3& displacement, const material::Memory& memory, Seen& out) {
  HexPoints points;
  if (!fill_points(section.kinematics, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if (section.formulation == VolumeFormulation::enhanced) {
    const auto e = enhanced_modes<space_modes>(section, reference, points, memory);
    if (!e.ok) out.status = Status::material_failed;
    for (std::size_t q = 0; q < 8; ++q) points[q].strain += e.matrix[q] * e.alpha;
  } else if (section.kinematics == Kinematics::finite) {
    points = mean_dilatation(points).point;
  } else {
    average_volume_small(points, displacement);
  }
  for (std::size_t q = 0; q < 8; ++q) {
    out.f[q] = points[q].f;
    out.strain[q] = points[q].strain;
  }
}

/// Cauchy stress from the second Piola-Kirchhoff stress.
Vec<6> cauchy(const Mat<3, 3>& f, const material::Stress3& s) {
  const Mat<3, 3> t = f * stress_tensor(s) * f.transpose() / f.determinant();
  Vec<6> out;
  out << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
  return out;
}

/// Polynomial basis for the extrapolation: as many terms as the points of the cell can carry.
using Basis = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 10>;

Basis basis(const Vec3& xi, cell::CellType type) {
  const std::size_t points = volume_rule(type).points.size();
  const bool flat = type == cell::CellType::shell18;  // two points along zeta
  Basis b(points == 1 ? 1 : points < 18 ? 4 : flat ? 9 : 10);
  b[0] = 1;
  if (b.size() >= 4) b.segment<3>(1) = xi.transpose();
  if (b.size() >= 9)
    b.segment<5>(4) << xi.x() * xi.y(), xi.y() * xi.z(), xi.z() * xi.x(), xi.x() * xi.x(),
        xi.y() * xi.y();
  if (b.size() >= 10) b[9] = xi.z() * xi.z();
  return b;
}

/// Values at the nodes from those at the points.
Eigen::MatrixXd make_extrapolation(cell::CellType type) {
  const VolumeRule& rule = volume_rule(type);
  const auto points = static_cast<Eigen::Index>(rule.points.size());
  const Eigen::Index nodes = cell::info(type).nodes, terms = basis(Vec3::Zero(), type).size();
  Eigen::MatrixXd sample(points, terms), at_nodes(nodes, terms);
  for (Eigen::Index q = 0; q < points; ++q)
    sample.row(q) = basis(rule.points[static_cast<std::size_t>(q)], type);
  for (Eigen::Index k = 0; k < nodes; ++k)
    at_nodes.row(k) = basis(cell::volume_node(type, static_cast<int>(k)), type);
  return at_nodes * core::least_squares(sample, Eigen::MatrixXd::Identity(points, points));
}

const Eigen::MatrixXd& extrapolation(cell::CellType type) {
  using enum cell::CellType;
  static const std::array<Eigen::MatrixXd, 8> all{
      make_extrapolation(tet4),    make_extrapolation(tet10),  make_extrapolation(wedge6),
      make_extrapolation(wedge15), make_extrapolation(hex8),   make_extrapolation(hex20),
      make_extrapolation(hex27),   make_extrapolation(shell18)};
  return all[static_cast<std::size_t>(type) - static_cast<std::size_t>(tet4)];
}

}  // namespace

CellStress3 stress_at_points(const VolumeSection& section, cell::CellType type,
                             const Coordinates3& reference, const Coordinates3& displacement,
                             const material::Memory& memory) {
  if (section.formulation == VolumeFormulation::solid_shell)
    return solid_shell_stress_at_points(section, type, reference, displacement, memory);
  const VolumeRule& rule = volume_rule(type);
  Seen seen;
  if (section.formulation == VolumeFormulation::full)
    see_full(section, type, reference, displacement, seen);
  else
    see_assumed(section, reference, displacement, memory, seen);
  CellStress3 out;
  out.status = seen.status;
  out.count = static_cast<int>(rule.points.size());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    PointStress3& p = out.point[q];
    const cell::VolumeShape& s = rule.shape[q];
    const Mat<3, 3> j = reference.transpose() * s.d.topRows(s.count);
    p.xi = rule.points[q];
    p.position = reference.transpose() * s.n.head(s.count);
    p.volume = rule.weights[q] * j.determinant();
    p.stress.setZero();
    p.strain.setZero();
    if (seen.status == Status::inverted) continue;
    const material::Response3 r = material::response(section.law, seen.strain[q], memory.at(q));
    if (!r.ok) out.status = Status::material_failed;
    p.strain = seen.strain[q];
    p.strain.tail<3>() *= 0.5;
    p.stress =
        section.kinematics == Kinematics::finite && r.ok ? cauchy(seen.f[q], r.stress) : r.stress;
  }
  return out;
}

Eigen::MatrixXd at_nodes(const VolumeSection& section, cell::CellType type,
                         const Eigen::MatrixXd& of_points) {
  return section.formulation == VolumeFormulation::solid_shell
             ? solid_shell_at_nodes(type, of_points)
             : Eigen::MatrixXd(extrapolation(type) * of_points);
}

NodalStress3 nodal_stress(const VolumeSection& section, cell::CellType type,
                          const Coordinates3& reference, const Coordinates3& displacement,
                          const material::Memory& memory) {
  if (section.formulation == VolumeFormulation::solid_shell)
    return solid_shell_nodal_stress(section, type, reference, displacement, memory);
  const CellStress3 at = stress_at_points(section, type, reference, displacement, memory);
  const Eigen::MatrixXd& factor = extrapolation(type);
  NodalStress3 out;
  out.count = cell::info(type).nodes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(out.count); ++k) {
    out.stress[k].setZero();
    out.strain[k].setZero();
    for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
      const double share = factor(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q));
      out.stress[k] += share * at.point[q].stress;
      out.strain[k] += share * at.point[q].strain;
    }
  }
  return out;
}

}  // namespace osculate::solid
