#include "osculate/solid/volume_mean_dilatation.hpp"

#include <cmath>

#include "osculate/material/stretch.hpp"

namespace osculate::solid {
namespace {

/// I/2 as a strain.
material::Strain3 half_unit() {
  material::Strain3 e;
  e << 0.5, 0.5, 0.5, 0, 0, 0;
  return e;
}

/// Adds factor * d2(ln J)/du2.
void add_log_j_curvature(const HexPoint& p, double factor, HexSizes::Matrix& k) {
  const HexSizes::Nodal spatial = p.gradient * p.f.inverse();  // dN/dx
  for (Eigen::Index b = 0; b < 8; ++b) {
    const Vec3 scaled = factor * spatial.row(b).transpose();
    for (Eigen::Index a = b; a < 8; ++a)
      k.block<3, 3>(3 * a, 3 * b).noalias() -= scaled * spatial.row(a);
  }
}

}  // namespace

void average_volume_small(HexPoints& points, const Coordinates3& displacement) {
  using Row = Eigen::Matrix<double, 1, 24>;
  Row mean = Row::Zero();
  double volume = 0;
  for (const HexPoint& p : points) {
    mean += p.volume * p.b.topRows<3>().colwise().sum();
    volume += p.volume;
  }
  mean /= volume;
  Vec<24> u;
  for (Eigen::Index k = 0; k < 8; ++k) u.segment<3>(3 * k) = displacement.row(k);
  for (HexPoint& p : points) {
    const Row shift = (mean - p.b.topRows<3>().colwise().sum()) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) p.b.row(i) += shift;
    p.strain = p.b * u;
  }
}

MeanDilatation3 mean_dilatation(const HexPoints& points) {
  MeanDilatation3 mean;
  std::array<double, 8> log_j{};
  double volume = 0, growth = 0;  // int dV, int (J - 1) dV
  for (std::size_t q = 0; q < 8; ++q) {
    log_j[q] = material::log_volume_ratio(points[q].strain);
    volume += points[q].volume;
    growth += points[q].volume * std::expm1(log_j[q]);
  }
  const double log_theta = std::log1p(growth / volume);
  mean.log_theta.setZero();
  for (std::size_t q = 0; q < 8; ++q) {
    mean.volume_share[q] = points[q].volume * std::exp(log_j[q]) / (volume + growth);
    mean.log_j[q].setZero();
    add_force(points[q].b, material::inverse_stretch(points[q].strain), mean.log_j[q]);
    mean.log_theta += mean.volume_share[q] * mean.log_j[q];
  }
  for (std::size_t q = 0; q < 8; ++q) {
    const double log_m = 2.0 / 3 * (log_theta - log_j[q]);
    const double m = std::exp(log_m);
    HexPoint& p = mean.point[q];
    p = points[q];
    mean.scale[q] = m;
    mean.log_m[q] = 2.0 / 3 * (mean.log_theta - mean.log_j[q]);
    p.strain = m * points[q].strain + std::expm1(log_m) * half_unit();
    const material::Strain3 half_stretch = p.strain + half_unit();
    for (Eigen::Index c = 0; c < 6; ++c)
      p.b.row(c) = m * points[q].b.row(c) + half_stretch[c] * mean.log_m[q].transpose();
    p.f *= std::sqrt(m);
  }
  return mean;
}

void add_mean_dilatation_geometric(const HexPoints& points,
                                   const std::array<material::Stress3, 8>& stress,
                                   const MeanDilatation3& mean, HexSizes::Matrix& tangent,
                                   HexSizes::NodeMatrix& geometric) {
  // S : d2(E_m) = m S : d2E + (S : dE_m) d(ln m) + d(ln m) (S : dE_m) - c d(ln m) d(ln m)
  //               + c d2(ln m),  c = S : (E_m + I/2),  d2(ln m) = 2/3 (d2(ln theta) - d2(ln J))
  std::array<double, 8> weight{};
  double total = 0;
  for (std::size_t q = 0; q < 8; ++q) {
    const double volume = points[q].volume;
    const material::Stress3& s = stress[q];
    const material::Strain3 half_stretch = mean.point[q].strain + half_unit();
    const double c = s.dot(half_stretch);
    HexSizes::Vector work = -0.5 * c * mean.log_m[q];
    add_force(mean.point[q].b, s, work);
    work *= volume;
    for (Eigen::Index j = 0; j < 24; ++j)
      tangent.col(j) += mean.log_m[q][j] * work + work[j] * mean.log_m[q];
    const material::Stress3 scaled = volume * mean.scale[q] * s;
    add_geometric(points[q].gradient, scaled, geometric);
    weight[q] = 2.0 / 3 * volume * c;
    total += weight[q];
  }
  for (std::size_t q = 0; q < 8; ++q) {
    const double share = total * mean.volume_share[q];
    add_log_j_curvature(points[q], share - weight[q], tangent);
    const HexSizes::Vector& v = mean.log_j[q];
    for (Eigen::Index j = 0; j < 24; ++j) tangent.col(j) += share * v[j] * v;
  }
  const HexSizes::Vector& v = mean.log_theta;
  for (Eigen::Index j = 0; j < 24; ++j) tangent.col(j) -= total * v[j] * v;
}

}  // namespace osculate::solid
