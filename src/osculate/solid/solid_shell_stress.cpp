#include <Eigen/LU>

#include "osculate/core/dense.hpp"
#include "osculate/solid/points.hpp"
#include "osculate/solid/solid_shell.hpp"
#include "osculate/solid/solid_shell_strain.hpp"

namespace osculate::solid {
namespace {

/// Symmetric tensor from the components 11, 22, 33, 12, 23, 13, the last three times `shear`.
Mat<3, 3> tensor(const Vec<6>& v, double shear) {
  Mat<3, 3> t;
  t << v[0], shear * v[3], shear * v[5],  //
      shear * v[3], v[1], shear * v[4],   //
      shear * v[5], shear * v[4], v[2];
  return t;
}

/// Cauchy stress from second Piola-Kirchhoff stress, assumed strain and deformation gradient. False
/// where the assumed strain squeezes a direction to nothing.
bool cauchy(const Mat<3, 3>& f, const material::Strain3& strain, const Vec<6>& stress,
            Vec<6>& out) {
  const Mat<3, 3> c = Mat<3, 3>::Identity() + 2 * tensor(strain, 0.5);
  const core::Spectrum eigen = core::spectrum(c);
  if (!(eigen.values[0] > 0)) return false;
  const core::SingularValues polar = core::singular_values(f);
  const Mat<3, 3> rotation = polar.u * polar.v.transpose();
  const Mat<3, 3> stretch =
      eigen.vectors * eigen.values.cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
  const Mat<3, 3> g = rotation * stretch;
  const Mat<3, 3> s = g * tensor(stress, 1) * g.transpose() / std::sqrt(eigen.values.prod());
  out << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  return true;
}

/// Linear through the thickness, linear or (from nine points a layer on) quadratic along the shell.
Eigen::RowVectorXd basis(const Vec3& xi, cell::CellType type) {
  Eigen::RowVectorXd plane(type == cell::CellType::hex8 ? 3 : 6);
  plane.head<3>() << 1, xi.x(), xi.y();
  if (plane.size() == 6) plane.tail<3>() << xi.x() * xi.y(), xi.x() * xi.x(), xi.y() * xi.y();
  Eigen::RowVectorXd b(2 * plane.size());
  b << plane, xi.z() * plane;
  return b;
}

Eigen::MatrixXd make_extrapolation(cell::CellType type) {
  return extrapolation<3>(type, rule_of<3>(type).points,
                          [&](const Vec3& xi) { return basis(xi, type); });
}

}  // namespace

CellStress<3> solid_shell_stress_at_points(const Section<3>& section, cell::CellType type,
                                           const Coordinates<3>& reference,
                                           const Coordinates<3>& displacement,
                                           const material::Memory& memory) {
  CellStress<3> out;
  ShellCell cell;
  const bool one_to_one = fill_shell(section, type, reference, displacement, cell);
  const ShellRule& rule = shell_rule(type);
  out.status = one_to_one ? Status::ok : Status::inverted;
  out.count = static_cast<int>(rule.points.size());
  ShellModes modes;
  if (one_to_one) modes = shell_modes(section, cell, memory);
  if (one_to_one && !modes.ok) out.status = Status::material_failed;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    PointStress<3>& to = out.point[q];
    to.xi = rule.points[q].xi;
    const cell::VolumeShape shape = cell::volume_shape(type, to.xi);
    to.position = reference.transpose() * shape.n.head(shape.count);
    to.volume = rule.points[q].weight *
                Mat<3, 3>(reference.transpose() * rule.points[q].shape).determinant();
    to.stress.setZero();
    to.strain.setZero();
    if (out.status != Status::ok) continue;
    const ShellPoint& p = cell.points[q];
    const material::Strain3 strain = p.strain + p.modes * modes.alpha;
    to.strain = strain;
    to.strain.tail<3>() *= 0.5;
    to.stress = modes.response[q].stress;
    if (section.kinematics == Kinematics::small) continue;
    const Mat<3, 3> f = Mat<3, 3>::Identity() + p.change * p.basis.inverse();
    if (!cauchy(f, strain, modes.response[q].stress, to.stress))
      out.status = Status::material_failed;
  }
  return out;
}

const Eigen::MatrixXd& solid_shell_extrapolation(cell::CellType type) {
  static const Eigen::MatrixXd eight = make_extrapolation(cell::CellType::hex8);
  static const Eigen::MatrixXd eighteen = make_extrapolation(cell::CellType::shell18);
  return type == cell::CellType::hex8 ? eight : eighteen;
}

}  // namespace osculate::solid
