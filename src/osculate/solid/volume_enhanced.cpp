#include "osculate/solid/volume_enhanced.hpp"

#include "osculate/solid/local_modes.hpp"

namespace osculate::solid {
namespace {

/// Strains of unit natural strains (11, 22, 33, 12, 23, 13, columns) at the centre of the cell.
struct Centre {
  material::Tangent3 strain;
  double determinant;
};

Centre centre_of(const Coordinates3& reference) {
  const cell::VolumeShape shape = cell::volume_shape(cell::CellType::hex8, Vec3::Zero());
  const Mat<3, 3> j = reference.transpose() * shape.d.topRows<8>();  // dX_i/dxi_j
  const Mat<3, 3> i = j.inverse();                                   // dxi_i/dX_j
  constexpr std::array<std::array<int, 2>, 6> axes{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Centre c{{}, j.determinant()};
  for (std::size_t n = 0; n < 6; ++n) {
    const Vec3 a = i.row(axes[n][0]), b = i.row(axes[n][1]);
    const Mat<3, 3> e = 0.5 * (a * b.transpose() + b * a.transpose());
    c.strain.col(static_cast<Eigen::Index>(n)) << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1),
        2 * e(1, 2), 2 * e(0, 2);
  }
  return c;
}

/// The modes, brought from the centre of the cell to the point; their mean is zero, so that the
/// patch test holds.
Mat<6, enhanced_count3> mode_matrix(const Centre& centre, const Vec3& xi, double determinant) {
  constexpr std::array<std::array<Eigen::Index, 2>, 9> linear{
      {{0, 0}, {1, 1}, {2, 2}, {3, 0}, {3, 1}, {4, 1}, {4, 2}, {5, 0}, {5, 2}}};  // strain, axis
  Mat<6, enhanced_count3> m = Mat<6, enhanced_count3>::Zero();
  for (std::size_t k = 0; k < 9; ++k)
    m.col(static_cast<Eigen::Index>(k)) = xi[linear[k][1]] * centre.strain.col(linear[k][0]);
  for (Eigen::Index k = 0; k < 3; ++k) m.col(9 + k).head<3>().setConstant(xi[k] * xi[(k + 1) % 3]);
  return centre.determinant / determinant * m;
}

/// Responses, equations int M^T S dV = 0 and their derivative at the modes of `e`. `scale` is the
/// size that rounding errors of the equations are relative to. False where the law fails.
bool sample(const material::Law& law, const HexPoints& points, const material::Memory& memory,
            EnhancedModes3& e, Vec<enhanced_count3>& rest, double& scale) {
  rest.setZero();
  scale = 0;
  e.stiffness.setZero();
  for (std::size_t q = 0; q < 8; ++q) {
    const material::Strain3 total = points[q].strain + e.matrix[q] * e.alpha;
    e.response[q] = material::response(law, total, memory.at(q));
    const material::Response3& r = e.response[q];
    if (!r.ok) return false;
    const Mat<6, enhanced_count3> weighted = points[q].volume * e.matrix[q];
    const Mat<6, enhanced_count3> stress = r.tangent * e.matrix[q];
    rest.noalias() += weighted.transpose() * r.stress;
    e.stiffness.noalias() += weighted.transpose() * stress;
    // before they cancel: modes of a long cell take nearly all of its strain away
    const Vec<6> parts = points[q].strain.cwiseAbs() + e.matrix[q].cwiseAbs() * e.alpha.cwiseAbs();
    const Vec<6> size = r.tangent.cwiseAbs() * parts + r.stress.cwiseAbs();
    scale += (weighted.cwiseAbs().transpose() * size).maxCoeff();
  }
  return true;
}

}  // namespace

EnhancedModes3 enhanced_modes(const VolumeSection& section, const Coordinates3& reference,
                              const HexPoints& points, const material::Memory& memory) {
  const VolumeRule& rule = volume_rule(cell::CellType::hex8);
  const Centre centre = centre_of(reference);
  EnhancedModes3 e;
  for (std::size_t q = 0; q < 8; ++q)
    e.matrix[q] = mode_matrix(centre, rule.points[q], points[q].determinant);
  solve_modes<Vec<enhanced_count3>>(
      e, memory.size > 0, [&](EnhancedModes3& m, Vec<enhanced_count3>& rest, double& scale) {
        return sample(section.law, points, memory, m, rest, scale);
      });
  return e;
}

}  // namespace osculate::solid
