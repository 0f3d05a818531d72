#include "osculate/solid/mean_dilatation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "osculate/material/stretch.hpp"

namespace osculate::solid {
namespace {

const Vec<4> half_unit(0.5, 0.5, 0.5, 0);  // I/2 as a strain

/// Adds factor * d2(ln J)/du2.
void add_log_j_curvature(const Section& section, const PointGeometry& g, const PointStrain& p,
                         double factor, ElementMatrix& k) {
  const Eigen::Index n = g.shape.count;
  const Coordinates spatial = g.gradient * p.f.inverse();  // dN/dx
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      k.block<2, 2>(2 * a, 2 * b).noalias() -= factor * spatial.row(b).transpose() * spatial.row(a);
      if (section.assumption == Assumption::axisymmetric) {
        const double radius = g.radius * p.f33;
        k(2 * a, 2 * b) -= factor * g.shape.n[a] * g.shape.n[b] / (radius * radius);
      }
    }
}

}  // namespace

void average_volume_small(std::span<const PointGeometry> geometry, std::span<PointStrain> strain,
                          const Coordinates& displacement) {
  const Eigen::Index dofs = strain[0].b.cols();
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 2 * max_nodes>;
  Row mean = Row::Zero(dofs);
  double volume = 0;
  for (std::size_t q = 0; q < strain.size(); ++q) {
    mean += geometry[q].volume * strain[q].b.topRows<3>().colwise().sum();
    volume += geometry[q].volume;
  }
  mean /= volume;
  ElementVector u(dofs);
  for (Eigen::Index k = 0; k < dofs / 2; ++k) u.segment<2>(2 * k) = displacement.row(k);
  for (PointStrain& point : strain) {
    const Row shift = (mean - point.b.topRows<3>().colwise().sum()) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) point.b.row(i) += shift;
    point.strain = point.b * u;
  }
}

MeanDilatation mean_dilatation(std::span<const PointGeometry> geometry,
                               std::span<const PointStrain> strain) {
  MeanDilatation mean;
  std::array<double, max_points> log_j{};
  double volume = 0, growth = 0;  // int dV, int (J - 1) dV
  for (std::size_t q = 0; q < strain.size(); ++q) {
    log_j[q] = material::log_volume_ratio(strain[q].strain);
    volume += geometry[q].volume;
    growth += geometry[q].volume * std::expm1(log_j[q]);
  }
  const double log_theta = std::log1p(growth / volume);
  mean.log_theta.setZero(strain[0].b.cols());
  for (std::size_t q = 0; q < strain.size(); ++q) {
    mean.volume_share[q] = geometry[q].volume * std::exp(log_j[q]) / (volume + growth);
    mean.log_j[q] = strain[q].b.transpose() *
                    material::inverse_stretch(strain[q].strain, 1 + 2 * strain[q].strain[2]);
    mean.log_theta += mean.volume_share[q] * mean.log_j[q];
  }
  for (std::size_t q = 0; q < strain.size(); ++q) {
    const double log_m = 2.0 / 3 * (log_theta - log_j[q]);
    const double m = std::exp(log_m);
    PointStrain& p = mean.strain[q];
    mean.scale[q] = m;
    mean.log_m[q] = 2.0 / 3 * (mean.log_theta - mean.log_j[q]);
    p.strain = m * strain[q].strain + std::expm1(log_m) * half_unit;
    p.b = m * strain[q].b + (p.strain + half_unit) * mean.log_m[q].transpose();
    p.f = std::sqrt(m) * strain[q].f;
    p.f33 = std::sqrt(m) * strain[q].f33;
  }
  return mean;
}

void add_mean_dilatation_geometric(const Section& section, std::span<const PointGeometry> geometry,
                                   std::span<const PointStrain> strain,
                                   std::span<const material::Response> response,
                                   const MeanDilatation& mean, ElementMatrix& tangent) {
  // S : d2(E_m) = m S : d2E + (S : dE_m) d(ln m) + d(ln m) (S : dE_m) - c d(ln m) d(ln m)
  //               + c d2(ln m),  c = S : (E_m + I/2),  d2(ln m) = 2/3 (d2(ln theta) - d2(ln J))
  std::array<double, max_points> weight{};
  double total = 0;
  for (std::size_t q = 0; q < strain.size(); ++q) {
    const double volume = geometry[q].volume;
    const material::Stress& s = response[q].stress;
    const double c = s.dot(mean.strain[q].strain + half_unit);
    const ElementVector work = mean.strain[q].b.transpose() * s - 0.5 * c * mean.log_m[q];
    tangent.noalias() += volume * work * mean.log_m[q].transpose();
    tangent.noalias() += volume * mean.log_m[q] * work.transpose();
    add_geometric(section, geometry[q], mean.scale[q] * s, tangent);
    weight[q] = 2.0 / 3 * volume * c;
    total += weight[q];
  }
  for (std::size_t q = 0; q < strain.size(); ++q) {
    const double share = mean.volume_share[q];
    add_log_j_curvature(section, geometry[q], strain[q], total * share - weight[q], tangent);
    tangent.noalias() += total * share * mean.log_j[q] * mean.log_j[q].transpose();
  }
  tangent.noalias() -= total * mean.log_theta * mean.log_theta.transpose();
}

}  // namespace osculate::solid
