#include "osculate/solid/mean_dilatation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "osculate/material/stretch.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;

/// The points of a cell of N nodes, or of any number, with the polynomials there.
template <int Dim, int N>
struct BbarCell {
  static constexpr bool any = N == Eigen::Dynamic;
  static constexpr int most = any ? (Dim == 2 ? 9 : 27) : N, most_terms = any ? 1 + Dim : 1;
  using Terms = Eigen::Matrix<double, any ? N : 1, 1, 0, most_terms, 1>;
  using Vector = typename Sizes<Dim, N>::Vector;
  template <class T>
  using OfPoints = std::array<T, static_cast<std::size_t>(most)>;
  OfPoints<Point<Dim, N>> point;
  OfPoints<Terms> term;                                ///< orthonormal: int p_i p_j dV = delta_ij
  std::size_t count = static_cast<std::size_t>(most);  ///< of points
  [[nodiscard]] std::size_t size() const {
    if constexpr (any)
      return count;
    else
      return static_cast<std::size_t>(most);
  }
};

/// Adds factor a b^T, or the sum of it and its transposed, of which the lower triangle counts.
template <class Vector, class Matrix>
void add_product(double factor, const Vector& a, const Vector& b, Matrix& lower) {
  for (Eigen::Index j = 0, n = a.size(); j < n; ++j) {
    const double of_b = factor * b[j];
    if constexpr (Vector::SizeAtCompileTime == Eigen::Dynamic)
      lower.col(j).tail(n - j) += of_b * a.tail(n - j);
    else
      lower.col(j) += of_b * a;
  }
}
template <class Vector, class Matrix>
void add_both_products(double factor, const Vector& a, const Vector& b, Matrix& lower) {
  for (Eigen::Index j = 0, n = a.size(); j < n; ++j) {
    const double of_a = factor * a[j], of_b = factor * b[j];
    if constexpr (Vector::SizeAtCompileTime == Eigen::Dynamic)
      lower.col(j).tail(n - j) += of_b * a.tail(n - j) + of_a * b.tail(n - j);
    else
      lower.col(j) += of_b * a + of_a * b;
  }
}

/// Gram and Schmidt's orthonormal polynomials, from 1 and the coordinates less those of the middle.
template <int Dim, int N>
void set_terms(const Rule<Dim>& rule, CellType type, const Coordinates<Dim>& reference,
               BbarCell<Dim, N>& c) {
  const Eigen::Index terms = volume_terms<Dim>(type);
  for (std::size_t q = 0; q < c.size(); ++q) {
    c.term[q].setOnes(terms);
    if constexpr (BbarCell<Dim, N>::any) {
      if (terms == 1) continue;
      const Shape<Dim>& shape = rule.shape[q];
      const typename Sizes<Dim, N>::NodeVector apart =
          shape.n.head(shape.count).array() - 1.0 / shape.count;
      for (Eigen::Index i = 0; i < Dim; ++i) c.term[q][i + 1] = reference.col(i).dot(apart);
    }
  }
  const auto product = [&](Eigen::Index i, Eigen::Index j) {
    double sum = 0;
    for (std::size_t q = 0; q < c.size(); ++q)
      sum += c.point[q].volume * c.term[q][i] * c.term[q][j];
    return sum;
  };
  for (Eigen::Index i = 0; i < terms; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double share = product(i, j);
      for (std::size_t q = 0; q < c.size(); ++q) c.term[q][i] -= share * c.term[q][j];
    }
    const double norm = std::sqrt(product(i, i));
    for (std::size_t q = 0; q < c.size(); ++q) c.term[q][i] /= norm;
  }
}

/// False if det F is not positive somewhere (finite kinematics).
template <int Dim, int N>
bool fill_cell(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
               const Coordinates<Dim>& displacement, BbarCell<Dim, N>& c) {
  const Rule<Dim>& rule = rule_of(section, type);
  const typename Sizes<Dim, N>::Nodal x = reference, u = displacement;
  bool one_to_one = true;
  c.count = rule.weights.size();
  for (std::size_t q = 0; q < c.size(); ++q)
    one_to_one =
        fill_point<Dim, N>(section, rule.shape[q], rule.weights[q], x, u, c.point[q]) && one_to_one;
  set_terms<Dim, N>(rule, type, reference, c);
  return one_to_one;
}

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

/// The volumetric part of B and of the strain becomes its projection.
template <int Dim, int N>
void average_volume_small(const Coordinates<Dim>& displacement, BbarCell<Dim, N>& c) {
  using Vector = typename BbarCell<Dim, N>::Vector;
  const Eigen::Index dofs = Dim * displacement.rows(), terms = c.term[0].size();
  std::array<Vector, static_cast<std::size_t>(BbarCell<Dim, N>::most_terms)> mean;
  const auto trace = [&](const Point<Dim, N>& p) -> Vector {
    return p.b.template topRows<3>().colwise().sum().transpose();
  };
  for (Eigen::Index i = 0; i < terms; ++i) {
    Vector& sum = mean[static_cast<std::size_t>(i)];
    sum.setZero(dofs);
    for (std::size_t q = 0; q < c.size(); ++q)
      sum += c.point[q].volume * c.term[q][i] * trace(c.point[q]);
  }
  Vector u(dofs);
  for (Eigen::Index k = 0; k < displacement.rows(); ++k)
    u.template segment<Dim>(Dim * k) = displacement.row(k);
  for (std::size_t q = 0; q < c.size(); ++q) {
    Point<Dim, N>& p = c.point[q];
    Vector shift = -trace(p);
    for (Eigen::Index i = 0; i < terms; ++i)
      shift += c.term[q][i] * mean[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 0; i < 3; ++i) p.b.row(i) += shift.transpose() / 3.0;
    p.strain = p.b * u;
  }
}

/// How the volume ratio depends on the displacements.
template <int Dim, int N>
struct VolumeRatios {
  using Cell = BbarCell<Dim, N>;
  using Vector = typename Cell::Vector;
  typename Cell::template OfPoints<double> scale;  ///< m
  typename Cell::template OfPoints<double> theta;
  typename Cell::template OfPoints<double> volume;  ///< J dV
  typename Cell::template OfPoints<Vector> log_m;   ///< d(ln m)/du
  typename Cell::template OfPoints<Vector> log_j;   ///< d(ln J)/du
  /// d(theta_i)/du, theta = sum_i theta_i p_i, theta_i = int J p_i dV
  std::array<Vector, static_cast<std::size_t>(Cell::most_terms)> slope;
};

/// E_m, B_m and F_m take the place of E, B and F; false if theta is not positive somewhere.
template <int Dim, int N>
bool average_volume(BbarCell<Dim, N>& c, VolumeRatios<Dim, N>& of) {
  const Eigen::Index dofs = c.point[0].b.cols(), terms = c.term[0].size();
  typename BbarCell<Dim, N>::template OfPoints<double> log_j{};
  typename BbarCell<Dim, N>::Terms growth;  // int (J - 1) p_i dV
  growth.setZero(terms);
  for (Eigen::Index i = 0; i < terms; ++i) of.slope[static_cast<std::size_t>(i)].setZero(dofs);
  for (std::size_t q = 0; q < c.size(); ++q) {
    const Point<Dim, N>& p = c.point[q];
    log_j[q] = material::log_volume_ratio(p.strain);
    const double grown = p.volume * std::expm1(log_j[q]);
    growth += grown * c.term[q];
    of.volume[q] = p.volume + grown;
    of.log_j[q].setZero(dofs);
    add_force(p.b, inverse_stretch(p.strain), of.log_j[q]);
    for (Eigen::Index i = 0; i < terms; ++i)
      of.slope[static_cast<std::size_t>(i)] += of.volume[q] * c.term[q][i] * of.log_j[q];
  }
  double log_theta = 0;
  for (std::size_t q = 0; q < c.size(); ++q) {
    const double change = growth.dot(c.term[q]);
    if (!(change > -1)) return false;
    if (q == 0 || terms > 1) log_theta = std::log1p(change);
    Point<Dim, N>& p = c.point[q];
    const double more = std::expm1(2.0 / 3 * (log_theta - log_j[q])), m = 1 + more;
    const double root = std::sqrt(m);
    of.theta[q] = 1 + change;
    of.scale[q] = m;
    of.log_m[q] = -of.log_j[q];
    for (Eigen::Index i = 0; i < terms; ++i)
      of.log_m[q] += c.term[q][i] / of.theta[q] * of.slope[static_cast<std::size_t>(i)];
    of.log_m[q] *= 2.0 / 3;
    const auto half = half_unit<Vec<components<Dim>>>();
    p.strain = (m * p.strain + more * half).eval();
    const auto half_stretch = (p.strain + half).eval();
    for (Eigen::Index s = 0; s < half.size(); ++s)
      p.b.row(s) = (m * p.b.row(s) + half_stretch[s] * of.log_m[q].transpose()).eval();
    p.f *= root;
    if constexpr (Dim == 2) p.f33 *= root;
  }
  return true;
}

/// Adds the lower triangle of factor * d2(ln J)/du2.
///
/// Input      p: with F_m = sqrt(m) F; scale: m
template <int Dim, int N>
void add_log_j_curvature(const Point<Dim, N>& p, double scale, double factor,
                         typename Sizes<Dim, N>::Matrix& lower) {
  const typename Sizes<Dim, N>::Nodal spatial = p.gradient * p.f.inverse();  // dN/dx / sqrt(m)
  const double of_products = factor * scale;
  for (Eigen::Index b = 0; b < spatial.rows(); ++b) {
    const Vec<Dim> scaled = of_products * spatial.row(b).transpose();
    for (Eigen::Index a = b; a < spatial.rows(); ++a) {
      lower.template block<Dim, Dim>(Dim * a, Dim * b).noalias() -= scaled * spatial.row(a);
      if constexpr (Dim == 2) {
        if (p.ring) lower(2 * a, 2 * b) -= of_products * p.hoop[a] * p.hoop[b] / (p.f33 * p.f33);
      }
    }
  }
}

template <int Dim, int N>
using Stresses = typename BbarCell<Dim, N>::template OfPoints<Vec<components<Dim>>>;

/// Adds the lower triangle of the part of the tangent that comes from the change of B_m,
/// int S : d2(E_m)/du2 dV, but for m S : d2E, which the sum over the points has.
///
/// Formula    S : d2(E_m) = m S : d2E + (S : dE_m) d(ln m) + d(ln m) (S : dE_m) - c d(ln m) d(ln m)
///            + c d2(ln m),  c = S : (E_m + I/2),  d2(ln m) = 2/3 (d2(ln theta) - d2(ln J)),
///            d2(ln theta) = sum_i p_i d2(theta_i) / theta - d(ln theta) d(ln theta),
///            d2(theta_i) = int J p_i (d2(ln J) + d(ln J) d(ln J)) dV
template <int Dim, int N>
void add_volume_curvature(const BbarCell<Dim, N>& c, const Stresses<Dim, N>& stress,
                          const VolumeRatios<Dim, N>& of, typename Sizes<Dim, N>::Matrix& lower) {
  using Cell = BbarCell<Dim, N>;
  using Vector = typename Cell::Vector;
  const Eigen::Index terms = c.term[0].size();
  typename Cell::template OfPoints<double> weight{};
  typename Cell::Terms pull;  // of d2(theta_i)
  Eigen::Matrix<double, Cell::Terms::RowsAtCompileTime, Cell::Terms::RowsAtCompileTime, 0,
                Cell::most_terms, Cell::most_terms>
      square;  // of d(theta_i) d(theta_j)
  pull.setZero(terms);
  square.setZero(terms, terms);
  for (std::size_t q = 0; q < c.size(); ++q) {
    const Point<Dim, N>& p = c.point[q];
    const double growth = stress[q].dot(p.strain + half_unit<Vec<components<Dim>>>());
    Vector work = -0.5 * growth * of.log_m[q];
    add_force(p.b, stress[q], work);
    add_both_products(p.volume, work, of.log_m[q], lower);
    weight[q] = 2.0 / 3 * p.volume * growth;
    const typename Cell::Terms per = weight[q] / of.theta[q] * c.term[q];
    pull += per;
    square += per / of.theta[q] * c.term[q].transpose();
  }
  for (std::size_t q = 0; q < c.size(); ++q) {
    const double share = of.volume[q] * pull.dot(c.term[q]);
    add_log_j_curvature<Dim, N>(c.point[q], of.scale[q], share - weight[q], lower);
    add_product(share, of.log_j[q], of.log_j[q], lower);
  }
  for (Eigen::Index i = 0; i < terms; ++i)
    for (Eigen::Index j = 0; j < terms; ++j)
      add_product(-square(i, j), of.slope[static_cast<std::size_t>(i)],
                  of.slope[static_cast<std::size_t>(j)], lower);
}

template <int N, int Dim>
void evaluate_cell(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
                   const Coordinates<Dim>& displacement, const material::Memory& memory,
                   bool with_tangent, ElementResult<Dim>& out) {
  const bool finite = section.kinematics == Kinematics::finite;
  BbarCell<Dim, N> c;
  VolumeRatios<Dim, N> of;
  out.status = Status::inverted;
  if (!fill_cell<Dim, N>(section, type, reference, displacement, c)) return;
  if (!finite)
    average_volume_small<Dim, N>(displacement, c);
  else if (!average_volume<Dim, N>(c, of))
    return;
  CellSum<Dim, N> sum(section, reference.rows(), with_tangent);
  Stresses<Dim, N> stress;
  out.status = Status::material_failed;
  for (std::size_t q = 0; q < c.size(); ++q) {
    const auto r = point_response(section, c.point[q].strain, memory.at(q));
    if (!r.ok) return;
    stress[q] = r.stress;
    sum.add(c.point[q], r, finite ? of.scale[q] : 1);
  }
  out.status = Status::ok;
  if (with_tangent && finite) add_volume_curvature<Dim, N>(c, stress, of, sum.tangent);
  sum.finish(out);
}

template <int N, int Dim>
void see_cell(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, Seen<Dim>& out) {
  BbarCell<Dim, N> c;
  VolumeRatios<Dim, N> of;
  out.status = Status::inverted;
  if (!fill_cell<Dim, N>(section, type, reference, displacement, c)) return;
  if (section.kinematics == Kinematics::small)
    average_volume_small<Dim, N>(displacement, c);
  else if (!average_volume<Dim, N>(c, of))
    return;
  out.status = Status::ok;
  for (std::size_t q = 0; q < c.size(); ++q) out.set(q, c.point[q]);
}

}  // namespace

template <int Dim>
int volume_terms(CellType type) {
  using enum CellType;
  if constexpr (Dim == 2) {
    if (type == quad4 || type == tri6) return 1;
    return type == quad8 || type == quad9 ? 3 : 0;
  } else {
    if (type == hex8 || type == tet10 || type == wedge15) return 1;
    return type == hex20 || type == hex27 ? 4 : 0;
  }
}
template int volume_terms<2>(CellType);
template int volume_terms<3>(CellType);

template <int Dim>
void evaluate_bbar(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
                   const Coordinates<Dim>& displacement, const material::Memory& memory,
                   bool with_tangent, ElementResult<Dim>& out) {
  if (type == corner_cell<Dim>)
    evaluate_cell<corners<Dim>>(section, type, reference, displacement, memory, with_tangent, out);
  else
    evaluate_cell<Eigen::Dynamic>(section, type, reference, displacement, memory, with_tangent,
                                  out);
}

template <int Dim>
void see_bbar(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, Seen<Dim>& out) {
  if (type == corner_cell<Dim>)
    see_cell<corners<Dim>>(section, type, reference, displacement, out);
  else
    see_cell<Eigen::Dynamic>(section, type, reference, displacement, out);
}

template <int Dim>
void add_bbar_stress_stiffness(const Section<Dim>& section, CellType type,
                               const Coordinates<Dim>& reference, const CellStress<Dim>& stress,
                               ElementMatrix<Dim>& lower) {
  constexpr int any = Eigen::Dynamic;
  BbarCell<Dim, any> c;
  VolumeRatios<Dim, any> of;
  const Eigen::Index nodes = reference.rows();
  (void)fill_cell<Dim, any>(section, type, reference, Coordinates<Dim>::Zero(nodes, Dim), c);
  (void)average_volume<Dim, any>(c, of);
  Stresses<Dim, any> of_points;
  for (std::size_t q = 0; q < c.size(); ++q) of_points[q] = stress.point[q].stress;
  add_volume_curvature<Dim, any>(c, of_points, of, lower);
}

template void evaluate_bbar(const Section<2>&, CellType, const Coordinates<2>&,
                            const Coordinates<2>&, const material::Memory&, bool,
                            ElementResult<2>&);
template void evaluate_bbar(const Section<3>&, CellType, const Coordinates<3>&,
                            const Coordinates<3>&, const material::Memory&, bool,
                            ElementResult<3>&);
template void see_bbar(const Section<2>&, CellType, const Coordinates<2>&, const Coordinates<2>&,
                       Seen<2>&);
template void see_bbar(const Section<3>&, CellType, const Coordinates<3>&, const Coordinates<3>&,
                       Seen<3>&);
template void add_bbar_stress_stiffness(const Section<2>&, CellType, const Coordinates<2>&,
                                        const CellStress<2>&, ElementMatrix<2>&);
template void add_bbar_stress_stiffness(const Section<3>&, CellType, const Coordinates<3>&,
                                        const CellStress<3>&, ElementMatrix<3>&);

}  // namespace osculate::solid
