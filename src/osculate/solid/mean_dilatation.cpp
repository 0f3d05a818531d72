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

/// Adds the lower triangle of factor * d2(ln J)/du2.
template <int Dim>
void add_log_j_curvature(const CornerPoint<Dim>& p, double factor,
                         typename CornerSizes<Dim>::Matrix& k) {
  const typename CornerSizes<Dim>::Nodal spatial = p.gradient * p.f.inverse();  // dN/dx
  for (Eigen::Index b = 0; b < spatial.rows(); ++b) {
    const Vec<Dim> scaled = factor * spatial.row(b).transpose();
    for (Eigen::Index a = b; a < spatial.rows(); ++a) {
      k.template block<Dim, Dim>(Dim * a, Dim * b).noalias() -= scaled * spatial.row(a);
      if constexpr (Dim == 2) {
        if (p.ring) k(2 * a, 2 * b) -= factor * p.hoop[a] * p.hoop[b] / (p.f33 * p.f33);
      }
    }
  }
}

}  // namespace

template <int Dim>
void average_volume_small(CornerPoints<Dim>& points, const Coordinates<Dim>& displacement) {
  constexpr int dofs = CornerSizes<Dim>::dofs;
  using Row = Eigen::Matrix<double, 1, dofs>;
  Row mean = Row::Zero();
  double volume = 0;
  for (const CornerPoint<Dim>& p : points) {
    mean += p.volume * p.b.template topRows<3>().colwise().sum();
    volume += p.volume;
  }
  mean /= volume;
  Vec<dofs> u;
  for (Eigen::Index k = 0; k < displacement.rows(); ++k)
    u.template segment<Dim>(Dim * k) = displacement.row(k);
  for (CornerPoint<Dim>& p : points) {
    const Row shift = (mean - p.b.template topRows<3>().colwise().sum()) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) p.b.row(i) += shift;
    p.strain = p.b * u;
  }
}

template <int Dim>
MeanDilatation<Dim> mean_dilatation(const CornerPoints<Dim>& points) {
  MeanDilatation<Dim> mean;
  typename MeanDilatation<Dim>::Numbers log_j{};
  double volume = 0, growth = 0;  // int dV, int (J - 1) dV
  for (std::size_t q = 0; q < points.size(); ++q) {
    log_j[q] = material::log_volume_ratio(points[q].strain);
    volume += points[q].volume;
    growth += points[q].volume * std::expm1(log_j[q]);
  }
  const double log_theta = std::log1p(growth / volume);
  mean.log_theta.setZero();
  for (std::size_t q = 0; q < points.size(); ++q) {
    const CornerPoint<Dim>& p = points[q];
    mean.volume_share[q] = p.volume * std::exp(log_j[q]) / (volume + growth);
    mean.log_j[q].setZero();
    add_force(p.b, inverse_stretch(p.strain), mean.log_j[q]);
    mean.log_theta += mean.volume_share[q] * mean.log_j[q];
  }
  mean.point = points;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const double log_m = 2.0 / 3 * (log_theta - log_j[q]);
    const double m = std::exp(log_m);
    CornerPoint<Dim>& p = mean.point[q];
    const auto half = half_unit<decltype(p.strain)>();
    mean.scale[q] = m;
    mean.log_m[q] = 2.0 / 3 * (mean.log_theta - mean.log_j[q]);
    p.strain = (m * p.strain + std::expm1(log_m) * half).eval();
    const auto half_stretch = (p.strain + half).eval();
    for (Eigen::Index c = 0; c < half.size(); ++c)
      p.b.row(c) = (m * p.b.row(c) + half_stretch[c] * mean.log_m[q].transpose()).eval();
    p.f *= std::sqrt(m);
    if constexpr (Dim == 2) p.f33 *= std::sqrt(m);
  }
  return mean;
}

template <int Dim>
void add_mean_dilatation_curvature(const CornerPoints<Dim>& points,
                                   const std::array<Vec<components<Dim>>, corners<Dim>>& stress,
                                   const MeanDilatation<Dim>& mean,
                                   typename CornerSizes<Dim>::Matrix& tangent) {
  // S : d2(E_m) = m S : d2E + (S : dE_m) d(ln m) + d(ln m) (S : dE_m) - c d(ln m) d(ln m)
  //               + c d2(ln m),  c = S : (E_m + I/2),  d2(ln m) = 2/3 (d2(ln theta) - d2(ln J))
  using Vector = typename MeanDilatation<Dim>::Vector;
  const auto add_square = [&](double factor, const Vector& v) {
    for (Eigen::Index j = 0; j < v.size(); ++j) tangent.col(j) += factor * v[j] * v;
  };
  typename MeanDilatation<Dim>::Numbers weight{};
  double total = 0;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const double volume = points[q].volume;
    const CornerPoint<Dim>& p = mean.point[q];
    const double c = stress[q].dot(p.strain + half_unit<Vec<components<Dim>>>());
    const Vector& log_m = mean.log_m[q];
    Vector work = -0.5 * c * log_m;
    add_force(p.b, stress[q], work);
    work *= volume;
    for (Eigen::Index j = 0; j < work.size(); ++j)
      tangent.col(j) += log_m[j] * work + work[j] * log_m;
    weight[q] = 2.0 / 3 * volume * c;
    total += weight[q];
  }
  for (std::size_t q = 0; q < points.size(); ++q) {
    const double share = total * mean.volume_share[q];
    add_log_j_curvature<Dim>(points[q], share - weight[q], tangent);
    add_square(share, mean.log_j[q]);
  }
  add_square(-total, mean.log_theta);
}

template void average_volume_small<2>(CornerPoints<2>&, const Coordinates<2>&);
template void average_volume_small<3>(CornerPoints<3>&, const Coordinates<3>&);
template MeanDilatation<2> mean_dilatation<2>(const CornerPoints<2>&);
template MeanDilatation<3> mean_dilatation<3>(const CornerPoints<3>&);
template void add_mean_dilatation_curvature<2>(const CornerPoints<2>&,
                                               const std::array<material::Stress, 4>&,
                                               const MeanDilatation<2>&, CornerSizes<2>::Matrix&);
template void add_mean_dilatation_curvature<3>(const CornerPoints<3>&,
                                               const std::array<material::Stress3, 8>&,
                                               const MeanDilatation<3>&, CornerSizes<3>::Matrix&);

}  // namespace osculate::solid
