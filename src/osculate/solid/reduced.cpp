#include "osculate/solid/reduced.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace osculate::solid {
namespace {

template <int Dim>
using PerNode = typename CornerSizes<Dim>::Nodal;

/// Products of coordinates that shape functions have beyond linear ones: without xi_a, and, in
/// space, of all three.
template <int Dim>
inline constexpr int modes = Dim == 2 ? 1 : 4;

/// The mode `a` at the nodes.
template <int Dim>
typename CornerSizes<Dim>::NodeVector mode_at_nodes(int a) {
  typename CornerSizes<Dim>::NodeVector h;
  for (int k = 0; k < corners<Dim>; ++k) {
    const Vec<Dim> xi = node_at<Dim>(corner_cell<Dim>, k);
    h[k] = Dim == 3 && a < 3 ? xi.prod() / xi[a] : xi.prod();
  }
  return h;
}

/// A square of sums of Q_ai in the energy: half the weight times (Q_ai [+ Q_bj])^2.
struct Term {
  double weight = 0;
  int a = 0, i = 0;
  int b = -1, j = -1;
};

/// Input      square: |G_i|^2
template <int Dim>
std::array<Term, Dim == 2 ? 2 : 12> terms(const Section<Dim>& section, double volume,
                                          const Vec<Dim>& square) {
  const auto [along, shear] = mode_moduli(section);
  std::array<Term, Dim == 2 ? 2 : 12> all{};
  std::size_t count = 0;
  for (int i = 0; i < Dim; ++i) {
    const double weight = along * volume / (square[i] * square[i]);
    if constexpr (Dim == 2) {
      all[count++] = {weight / 3, 0, i};
    } else {
      for (int a = 0; a < 3; ++a)
        if (a != i) all[count++] = {weight / 3, a, i};
      all[count++] = {weight / 9, 3, i};
      const int j = (i + 1) % 3;
      all[count++] = {shear * volume / 3 / (square[i] * square[j]), i, i, j, j};
    }
  }
  return all;
}

/// The rolling of a ring.
void add_ring(double factor, const Shape<2>& centre, const Coordinates<2>& reference,
              const Coordinates<2>& displacement, bool with_tangent, Hourglass<2>& out) {
  const double radius = reference.col(0).dot(centre.n.head<4>());
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Vec<4> slope = centre.d.col(i).head<4>();
    const double along = slope.dot(reference.col(0)) / radius;
    const Vec<4> row = (slope - along * centre.n.head<4>()) / radius;
    const double value = row.dot(displacement.col(0));
    out.energy += 0.5 * factor * value * value;
    for (Eigen::Index k = 0; k < 4; ++k) {
      out.force[2 * k] += factor * value * row[k];
      if (!with_tangent) continue;
      for (Eigen::Index l = 0; l <= k; ++l) out.tangent(2 * k, 2 * l) += factor * row[k] * row[l];
    }
  }
}

/// The generalised strains Q_ai and their derivatives.
template <int Dim>
struct ModeStrains {
  Mat<corners<Dim>, modes<Dim>> gamma;
  Mat<corners<Dim>, Dim> slope;  ///< dN_k/dxi_i at the centre
  std::array<std::array<double, Dim>, modes<Dim>> value;
  std::array<std::array<typename CornerSizes<Dim>::Vector, Dim>, modes<Dim>> derivative;
};

template <int Dim>
ModeStrains<Dim> mode_strains(bool finite, const Shape<Dim>& centre, const PerNode<Dim>& reference,
                              const PerNode<Dim>& displacement, const PerNode<Dim>& gradient) {
  constexpr int nodes = corners<Dim>;
  ModeStrains<Dim> m;
  m.slope = centre.d.template topRows<nodes>();
  const PerNode<Dim> place = finite ? PerNode<Dim>(reference + displacement) : reference;
  const Mat<Dim, Dim> base = place.transpose() * m.slope;  // columns g_i
  for (int a = 0; a < modes<Dim>; ++a) {
    const auto h = mode_at_nodes<Dim>(a);
    m.gamma.col(a) = (h - gradient * (reference.transpose() * h)) / nodes;
    const Vec<Dim> q = displacement.transpose() * m.gamma.col(a);
    for (int i = 0; i < Dim; ++i) {
      const auto at = static_cast<std::size_t>(a), along = static_cast<std::size_t>(i);
      m.value[at][along] = q.dot(base.col(i));
      auto& d = m.derivative[at][along];
      for (Eigen::Index k = 0; k < nodes; ++k) {
        d.template segment<Dim>(Dim * k) = m.gamma(k, a) * base.col(i);
        if (finite) d.template segment<Dim>(Dim * k) += m.slope(k, i) * q;
      }
    }
  }
  return m;
}

/// Adds the lower triangle of stress * d2(Q_ai).
template <int Dim>
void add_curvature(const ModeStrains<Dim>& m, int a, int i, double stress,
                   typename CornerSizes<Dim>::Matrix& tangent) {
  for (Eigen::Index l = 0; l < corners<Dim>; ++l)
    for (Eigen::Index k = l; k < corners<Dim>; ++k) {
      const double both = stress * (m.gamma(k, a) * m.slope(l, i) + m.slope(k, i) * m.gamma(l, a));
      for (Eigen::Index d = 0; d < Dim; ++d) tangent(Dim * k + d, Dim * l + d) += both;
    }
}

}  // namespace

template <int Dim>
std::array<double, 2> mode_moduli(const Section<Dim>& section) {
  const auto [young, poisson] = material::unloaded(section.law);
  double along = young;
  if constexpr (Dim == 2) {
    if (section.assumption != Assumption::plane_stress) along /= 1 - poisson * poisson;
  }
  return {along, young / 2 / (1 + poisson)};
}

template <int Dim>
bool fill_mean_point(const Section<Dim>& section, const Coordinates<Dim>& reference,
                     const Coordinates<Dim>& displacement, CornerPoint<Dim>& p) {
  constexpr int n = corners<Dim>;
  const bool finite = section.kinematics == Kinematics::finite;
  const Rule<Dim>& rule = rule_of<Dim>(corner_cell<Dim>);
  p.gradient.setZero();
  p.volume = p.determinant = 0;
  if constexpr (Dim == 2) p.hoop.setZero();
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    const Shape<Dim>& shape = rule.shape[q];
    const Mat<Dim, Dim> jacobian = reference.transpose() * shape.d.template topRows<n>();
    const double volume = volume_at(section, shape, rule.weights[q], reference);
    p.volume += volume;
    p.determinant += rule.weights[q] * jacobian.determinant();
    p.gradient += volume * shape.d.template topRows<n>() * jacobian.inverse();
    if constexpr (Dim == 2)
      p.hoop +=
          volume / reference.col(0).dot(shape.n.template head<n>()) * shape.n.template head<n>();
  }
  p.gradient /= p.volume;
  p.determinant /= n;
  fill_strains<Dim, n>(finite, displacement, p);
  if constexpr (Dim == 2) {
    if (is_ring(section)) {
      p.hoop /= p.volume;
      p.radius = 1 / p.hoop.sum();
      fill_hoop_strain<n>(finite, p.hoop.dot(displacement.col(0)), p);
    }
  }
  return one_to_one(finite, p);
}

template <int Dim>
Hourglass<Dim> hourglass(const Section<Dim>& section, const Coordinates<Dim>& reference,
                         const Coordinates<Dim>& displacement, const CornerPoint<Dim>& p,
                         bool with_tangent) {
  const bool finite = section.kinematics == Kinematics::finite;
  const Shape<Dim> centre = shape_at<Dim>(corner_cell<Dim>, Vec<Dim>::Zero());
  const ModeStrains<Dim> m = mode_strains<Dim>(finite, centre, reference, displacement, p.gradient);
  const Vec<Dim> square = (reference.transpose() * m.slope).colwise().squaredNorm().transpose();
  Hourglass<Dim> out;
  out.force.setZero();
  if (with_tangent) out.tangent.setZero();
  for (const Term& t : terms<Dim>(section, p.volume, square)) {
    const auto a = static_cast<std::size_t>(t.a), i = static_cast<std::size_t>(t.i),
               b = static_cast<std::size_t>(t.b), j = static_cast<std::size_t>(t.j);
    double strain = m.value[a][i];
    typename CornerSizes<Dim>::Vector derivative = m.derivative[a][i];
    if (t.b >= 0) {
      strain += m.value[b][j];
      derivative += m.derivative[b][j];
    }
    const double stress = t.weight * strain;
    out.energy += 0.5 * stress * strain;
    out.force += stress * derivative;
    if (with_tangent) out.tangent += t.weight * derivative * derivative.transpose();
    if (!finite || !with_tangent) continue;
    add_curvature<Dim>(m, t.a, t.i, stress, out.tangent);
    if (t.b >= 0) add_curvature<Dim>(m, t.b, t.j, stress, out.tangent);
  }
  if constexpr (Dim == 2) {
    if (is_ring(section))
      add_ring(mode_moduli(section)[0] * p.volume / 3, centre, reference, displacement,
               with_tangent, out);
  }
  return out;
}

NodeMatrix3 faint_stiffness(const Section<3>& section, cell::CellType type,
                            const Coordinates<3>& reference) {
  constexpr double third = 1.0 / 3;
  const bool wedge = type == cell::CellType::wedge6;
  const double share = !wedge && section.kinematics == Kinematics::finite ? 1e-4 : 1e-6;
  const Eigen::Index n = reference.rows();
  const Shape<3> centre = shape_at<3>(type, wedge ? Vec3(third, third, 0) : Vec3(Vec3::Zero()));
  const Vec3 sides = wedge ? Vec3(1, 1, 2) : Vec3(2, 2, 2);  // of the cell's own coordinates
  const Mat<3, 3> base = reference.transpose() * centre.d.topRows(n) * sides.asDiagonal();
  const double largest = base.colwise().norm().maxCoeff(), box = std::abs(base.determinant());
  double face = 0;
  for (Eigen::Index i = 0; i < 3; ++i)
    face = std::max(face, base.col(i).cross(base.col((i + 1) % 3)).norm());
  const double least = box / face, volume = (wedge ? 0.5 : 1.0) * box;
  using Polynomials = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_nodes<3>, 10>;
  Polynomials terms(n, wedge ? 4 : 10);
  const Coordinates<3> r = (reference.rowwise() - reference.colwise().mean()) / largest;
  terms.col(0).setOnes();
  terms.middleCols<3>(1) = r;
  for (Eigen::Index i = 0; !wedge && i < 3; ++i) {
    terms.col(4 + i) = r.col(i).cwiseAbs2();
    terms.col(7 + i) = r.col(i).cwiseProduct(r.col((i + 1) % 3));
  }
  const Eigen::HouseholderQR<Polynomials> factors(terms);
  const Polynomials q = factors.householderQ() * Polynomials::Identity(n, terms.cols());
  const double size = share * material::unloaded(section.law).young * volume * (least * least) /
                      (largest * largest * largest * largest);
  return size * (NodeMatrix3::Identity(n, n) - q * q.transpose());
}

template std::array<double, 2> mode_moduli(const Section<2>&);
template std::array<double, 2> mode_moduli(const Section<3>&);
template bool fill_mean_point(const Section<2>&, const Coordinates<2>&, const Coordinates<2>&,
                              CornerPoint<2>&);
template bool fill_mean_point(const Section<3>&, const Coordinates<3>&, const Coordinates<3>&,
                              CornerPoint<3>&);
template Hourglass<2> hourglass(const Section<2>&, const Coordinates<2>&, const Coordinates<2>&,
                                const CornerPoint<2>&, bool);
template Hourglass<3> hourglass(const Section<3>&, const Coordinates<3>&, const Coordinates<3>&,
                                const CornerPoint<3>&, bool);

}  // namespace osculate::solid
