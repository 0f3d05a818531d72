#include "osculate/solid/mean_dilatation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "osculate/material/stretch.hpp"

namespace osculate::solid {
namespace {

/// I/2 as a strain.
template <class Strain>
Strain half_unit() {
  Strain e = Strain::Zero();
  e.template head<3>().setConstant(0.5);
  return e;
}

material::Strain inverse_stretch(const material::Strain& e) {
  return material::inverse_stretch(e, 1 + 2 * e[2]);
}
material::Strain3 inverse_stretch(const material::Strain3& e) {
  return material::inverse_stretch(e);
}

/// Adds factor * d2(ln J)/du2.
template <class Geometry, class Strain, class Matrix>
void add_log_j_curvature(const Geometry& g, const Strain& p, double factor,
                         [[maybe_unused]] bool ring, Matrix& k) {
  constexpr int dim = decltype(p.f)::RowsAtCompileTime;
  const auto spatial = (g.gradient * p.f.inverse()).eval();  // dN/dx
  for (Eigen::Index b = 0; b < spatial.rows(); ++b) {
    const Vec<dim> scaled = factor * spatial.row(b).transpose();
    for (Eigen::Index a = dim == 2 ? 0 : b; a < spatial.rows(); ++a) {
      k.template block<dim, dim>(dim * a, dim * b).noalias() -= scaled * spatial.row(a);
      if constexpr (dim == 2) {
        const double radius = g.radius * p.f33;
        if (ring) k(2 * a, 2 * b) -= factor * g.shape.n[a] * g.shape.n[b] / (radius * radius);
      }
    }
  }
}

}  // namespace

template <class AnyPoints, class AnyCoordinates>
void average_volume_small(AnyPoints& points, const AnyCoordinates& displacement) {
  using Vector = typename PointsTraits<AnyPoints>::Vector;
  using Row = Eigen::Matrix<double, 1, Vector::RowsAtCompileTime, Eigen::RowMajor, 1,
                            Vector::MaxRowsAtCompileTime>;
  const Eigen::Index dofs = displacement.size(), dim = displacement.cols();
  Row mean = Row::Zero(dofs);
  double volume = 0;
  for (std::size_t q = 0; q < count(points); ++q) {
    const double here = geometry_at(points, q).volume;
    mean += here * strain_at(points, q).b.template topRows<3>().colwise().sum();
    volume += here;
  }
  mean /= volume;
  Vector u(dofs);
  for (Eigen::Index k = 0; k < displacement.rows(); ++k)
    u.segment(dim * k, dim) = displacement.row(k);
  for (std::size_t q = 0; q < count(points); ++q) {
    auto& p = strain_at(points, q);
    const Row shift = (mean - p.b.template topRows<3>().colwise().sum()) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) p.b.row(i) += shift;
    p.strain = p.b * u;
  }
}

template <class AnyPoints>
MeanDilatation<AnyPoints> mean_dilatation(const AnyPoints& points) {
  MeanDilatation<AnyPoints> mean;
  std::array<double, MeanDilatation<AnyPoints>::most> log_j{};
  double volume = 0, growth = 0;  // int dV, int (J - 1) dV
  for (std::size_t q = 0; q < count(points); ++q) {
    const double here = geometry_at(points, q).volume;
    log_j[q] = material::log_volume_ratio(strain_at(points, q).strain);
    volume += here;
    growth += here * std::expm1(log_j[q]);
  }
  const double log_theta = std::log1p(growth / volume);
  mean.log_theta.setZero(strain_at(points, 0).b.cols());
  for (std::size_t q = 0; q < count(points); ++q) {
    const auto& p = strain_at(points, q);
    mean.volume_share[q] = geometry_at(points, q).volume * std::exp(log_j[q]) / (volume + growth);
    mean.log_j[q].setZero(p.b.cols());
    add_force(p.b, inverse_stretch(p.strain), mean.log_j[q]);
    mean.log_theta += mean.volume_share[q] * mean.log_j[q];
  }
  mean.point = points;
  for (std::size_t q = 0; q < count(points); ++q) {
    const double log_m = 2.0 / 3 * (log_theta - log_j[q]);
    const double m = std::exp(log_m);
    auto& p = strain_at(mean.point, q);
    const auto half = half_unit<decltype(p.strain)>();
    mean.scale[q] = m;
    mean.log_m[q] = 2.0 / 3 * (mean.log_theta - mean.log_j[q]);
    p.strain = (m * p.strain + std::expm1(log_m) * half).eval();
    const auto half_stretch = (p.strain + half).eval();
    for (Eigen::Index c = 0; c < half.size(); ++c)
      p.b.row(c) = (m * p.b.row(c) + half_stretch[c] * mean.log_m[q].transpose()).eval();
    p.f *= std::sqrt(m);
    if constexpr (requires { p.f33; }) p.f33 *= std::sqrt(m);
  }
  return mean;
}

template <class AnyPoints, class Stress>
void add_mean_dilatation_curvature(const AnyPoints& points,
                                   const std::array<Stress, PointsTraits<AnyPoints>::most>& stress,
                                   const MeanDilatation<AnyPoints>& mean, bool ring,
                                   typename PointsTraits<AnyPoints>::Matrix& tangent) {
  // S : d2(E_m) = m S : d2E + (S : dE_m) d(ln m) + d(ln m) (S : dE_m) - c d(ln m) d(ln m)
  //               + c d2(ln m),  c = S : (E_m + I/2),  d2(ln m) = 2/3 (d2(ln theta) - d2(ln J))
  using Vector = typename PointsTraits<AnyPoints>::Vector;
  const auto add_square = [&](double factor, const Vector& v) {
    for (Eigen::Index j = 0; j < v.size(); ++j) tangent.col(j) += factor * v[j] * v;
  };
  std::array<double, MeanDilatation<AnyPoints>::most> weight{};
  double total = 0;
  for (std::size_t q = 0; q < count(points); ++q) {
    const double volume = geometry_at(points, q).volume;
    const auto& p = strain_at(mean.point, q);
    const Stress half_stretch = p.strain + half_unit<Stress>();
    const double c = stress[q].dot(half_stretch);
    const Vector& log_m = mean.log_m[q];
    Vector work = -0.5 * c * log_m;
    add_force(p.b, stress[q], work);
    work *= volume;
    for (Eigen::Index j = 0; j < work.size(); ++j)
      tangent.col(j) += log_m[j] * work + work[j] * log_m;
    weight[q] = 2.0 / 3 * volume * c;
    total += weight[q];
  }
  for (std::size_t q = 0; q < count(points); ++q) {
    const double share = total * mean.volume_share[q];
    add_log_j_curvature(geometry_at(points, q), strain_at(points, q), share - weight[q], ring,
                        tangent);
    add_square(share, mean.log_j[q]);
  }
  add_square(-total, mean.log_theta);
}

template void average_volume_small(Points&, const Coordinates&);
template void average_volume_small(HexPoints&, const Coordinates3&);
template MeanDilatation<Points> mean_dilatation(const Points&);
template MeanDilatation<HexPoints> mean_dilatation(const HexPoints&);
template void add_mean_dilatation_curvature(const Points&,
                                            const std::array<material::Stress, max_points>&,
                                            const MeanDilatation<Points>&, bool, ElementMatrix&);
template void add_mean_dilatation_curvature(const HexPoints&,
                                            const std::array<material::Stress3, 8>&,
                                            const MeanDilatation<HexPoints>&, bool,
                                            HexSizes::Matrix&);

}  // namespace osculate::solid
