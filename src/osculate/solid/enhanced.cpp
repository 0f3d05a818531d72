#include "osculate/solid/enhanced.hpp"

#include <Eigen/LU>

#include "osculate/solid/local_modes.hpp"

namespace osculate::solid {
namespace {

/// Strain modes at the points (xi for 11, eta for 22, xi and eta for 12; in a ring xi eta for the
/// hoop strain), brought from the centre of the cell; their mean is zero, so that the patch test
/// holds (Simo & Rifai 1990).
template <int Count>
std::array<Mat<4, Count>, 4> mode_matrices(const Section& section, const Coordinates& reference,
                                           std::span<const PointGeometry> geometry) {
  const cell::AreaShape center = cell::area_shape(cell::CellType::quad4, Vec2::Zero());
  const Mat<2, 2> j = (reference.transpose() * center.d.topRows<4>()).transpose();  // dX_j/dxi_i
  const Mat<2, 2> i = j.inverse();  // i(a, b) = dxi_b/dX_a
  // strain_X = T strain_xi with eps_ab = dxi_i/dX_a dxi_j/dX_b eps_ij
  Mat<3, 3> t;
  t << i(0, 0) * i(0, 0), i(0, 1) * i(0, 1), i(0, 0) * i(0, 1),  //
      i(1, 0) * i(1, 0), i(1, 1) * i(1, 1), i(1, 0) * i(1, 1),   //
      2 * i(0, 0) * i(1, 0), 2 * i(0, 1) * i(1, 1), i(0, 0) * i(1, 1) + i(0, 1) * i(1, 0);
  constexpr bool ring = Count == ring_modes;
  const AreaRule& rule = area_rule(section.assumption, cell::CellType::quad4);
  Vec3 mean = Vec3::Zero();  // of xi, eta, xi eta over the circumference; zero in the plane
  double circumference = 0;
  for (std::size_t q = 0; ring && q < 4; ++q) {
    const Vec2& xi = rule.points[q];
    mean += geometry[q].radius * Vec3(xi.x(), xi.y(), xi.x() * xi.y());
    circumference += geometry[q].radius;
  }
  if (ring) mean /= circumference;
  std::array<Mat<4, Count>, 4> modes;
  for (std::size_t q = 0; q < 4; ++q) {
    const Vec2& xi = rule.points[q];
    Mat<3, 4> natural = Mat<3, 4>::Zero();
    natural(0, 0) = natural(2, 2) = xi.x() - mean[0];
    natural(1, 1) = natural(2, 3) = xi.y() - mean[1];
    const double ratio = j.determinant() / geometry[q].determinant;
    const Mat<3, 4> plane = ratio * t * natural;
    modes[q].setZero();
    modes[q].template topLeftCorner<2, 4>() = plane.topRows<2>();
    modes[q].template block<1, 4>(3, 0) = plane.row(2);
    if constexpr (ring) modes[q](2, 4) = ratio * (xi.x() * xi.y() - mean[2]);
  }
  return modes;
}

/// Responses, equations int M^T S dV = 0 and their derivative at the modes of `e`. `scale` is the
/// size that rounding errors of the equations are relative to. False where the law fails.
template <int Count>
bool sample(const Section& section, std::span<const PointGeometry> geometry,
            std::span<const PointStrain> strain, const material::Memory& memory,
            EnhancedModes<Count>& e, Vec<Count>& rest, double& scale) {
  rest.setZero();
  scale = 0;
  e.stiffness.setZero();
  for (std::size_t q = 0; q < 4; ++q) {
    const material::Strain total = strain[q].strain + e.matrix[q] * e.alpha;
    e.response[q] = point_response(section, total, memory.at(q));
    const material::Response& r = e.response[q];
    if (!r.ok) return false;
    const Mat<4, Count> weighted = geometry[q].volume * e.matrix[q];
    rest.noalias() += weighted.transpose() * r.stress;
    e.stiffness.noalias() += weighted.transpose() * r.tangent * e.matrix[q];
    // before they cancel: modes of a long cell take nearly all of its strain away
    const Vec<4> parts = strain[q].strain.cwiseAbs() + e.matrix[q].cwiseAbs() * e.alpha.cwiseAbs();
    const Vec<4> size = r.tangent.cwiseAbs() * parts + r.stress.cwiseAbs();
    scale += (weighted.cwiseAbs().transpose() * size).maxCoeff();
  }
  return true;
}

}  // namespace

template <int Count>
EnhancedModes<Count> enhanced_modes(const Section& section, const Coordinates& reference,
                                    std::span<const PointGeometry> geometry,
                                    std::span<const PointStrain> strain,
                                    const material::Memory& memory) {
  EnhancedModes<Count> e;
  e.matrix = mode_matrices<Count>(section, reference, geometry);
  solve_modes<Vec<Count>>(e, memory.size > 0,
                          [&](EnhancedModes<Count>& m, Vec<Count>& rest, double& scale) {
                            return sample(section, geometry, strain, memory, m, rest, scale);
                          });
  return e;
}

template EnhancedModes<plane_modes> enhanced_modes(const Section&, const Coordinates&,
                                                   std::span<const PointGeometry>,
                                                   std::span<const PointStrain>,
                                                   const material::Memory&);
template EnhancedModes<ring_modes> enhanced_modes(const Section&, const Coordinates&,
                                                  std::span<const PointGeometry>,
                                                  std::span<const PointStrain>,
                                                  const material::Memory&);

}  // namespace osculate::solid
