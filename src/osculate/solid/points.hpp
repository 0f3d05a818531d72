#pragma once
// The quadrature points of a cell in the plane and in space, and the sums over them; shared by the
// formulations. Templated on the number of nodes N, so that the common cells have loops of known
// length; N = Eigen::Dynamic serves any cell. For sources of this layer.
#include <Eigen/LU>
#include <array>
#include <numbers>
#include <vector>

#include "osculate/cell/shape.hpp"
#include "osculate/core/dense.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

template <int Dim>
using Shape = std::conditional_t<Dim == 2, cell::AreaShape, cell::VolumeShape>;
template <int Dim>
[[nodiscard]] Shape<Dim> shape_at(cell::CellType type, const Vec<Dim>& xi) {
  if constexpr (Dim == 2)
    return cell::area_shape(type, xi);
  else
    return cell::volume_shape(type, xi);
}
/// Reference coordinates of a node.
template <int Dim>
[[nodiscard]] Vec<Dim> node_at(cell::CellType type, int node) {
  if constexpr (Dim == 2)
    return cell::area_node(type, node);
  else
    return cell::volume_node(type, node);
}

/// Quadrature of a cell type with the shape functions at its points. Fully integrated no cell has a
/// mode without energy.
template <int Dim>
struct Rule {
  std::vector<Vec<Dim>> points;
  std::vector<double> weights;
  std::vector<Shape<Dim>> shape;
};
template <int Dim>
[[nodiscard]] const Rule<Dim>& rule_of(cell::CellType type, bool ring = false);
/// Two points along each axis for quad8 and hex20, one for quad4 and hex8, two along the height for
/// wedge6.
template <int Dim>
[[nodiscard]] const Rule<Dim>& reduced_rule_of(cell::CellType type);
/// Of hex20 along a beam: two points along the first axis, five along the others.
[[nodiscard]] const Rule<3>& beam_rule();
/// One that is exact for N_i N_j times the Jacobian (and the radius of a ring) of a straight-sided
/// cell.
template <int Dim>
[[nodiscard]] const Rule<Dim>& mass_rule(cell::CellType type);

[[nodiscard]] inline bool is_ring(const Section<2>& section) {
  return section.assumption == Assumption::axisymmetric;
}
[[nodiscard]] inline bool is_ring(const Section<3>&) { return false; }
template <int Dim>
[[nodiscard]] const Rule<Dim>& rule_of(const Section<Dim>& section, cell::CellType type) {
  if (section.formulation == Formulation::reduced) return reduced_rule_of<Dim>(type);
  if constexpr (Dim == 3) {
    if (section.formulation == Formulation::beam) return beam_rule();
  }
  return rule_of<Dim>(type, is_ring(section));
}

/// What a determinant of the plane is multiplied by: thickness or circumference.
[[nodiscard]] inline double depth_at(const Section<2>& section, double radius) {
  return is_ring(section) ? 2 * std::numbers::pi * radius : section.thickness;
}
[[nodiscard]] inline double depth_at(const Section<3>&, double) { return 1; }

/// Undeformed volume of a point.
template <int Dim>
[[nodiscard]] double volume_at(const Section<Dim>& section, const Shape<Dim>& shape, double weight,
                               const Coordinates<Dim>& reference) {
  const Eigen::Index n = shape.count;
  const Mat<Dim, Dim> jacobian = reference.transpose() * shape.d.topRows(n);
  return weight * jacobian.determinant() * depth_at(section, reference.col(0).dot(shape.n.head(n)));
}

/// Components of a symmetric matrix: of a stress, of a strain (which has twice the shear).
[[nodiscard]] inline Mat<2, 2> stress_tensor(const material::Stress& s) {
  Mat<2, 2> t;
  t << s[0], s[3], s[3], s[1];
  return t;
}
[[nodiscard]] inline Mat<3, 3> stress_tensor(const material::Stress3& s) {
  Mat<3, 3> t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}
[[nodiscard]] inline material::Strain strain_of(const Mat<2, 2>& h) {
  return {h(0, 0), h(1, 1), 0, h(0, 1) + h(1, 0)};
}
[[nodiscard]] inline material::Strain3 strain_of(const Mat<3, 3>& h) {
  material::Strain3 e;
  e << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
  return e;
}

template <int Dim, int N>
struct Sizes {
  static constexpr int dofs = N == Eigen::Dynamic ? Eigen::Dynamic : Dim * N;
  static constexpr int most = N == Eigen::Dynamic ? max_nodes<Dim> : N;
  static constexpr int rows = components<Dim>;
  using Nodal = Eigen::Matrix<double, N, Dim, 0, most, Dim>;
  using NodeVector = Eigen::Matrix<double, N, 1, 0, most, 1>;
  using NodeMatrix = Eigen::Matrix<double, N, N, 0, most, most>;
  using Strains = Eigen::Matrix<double, rows, dofs, Eigen::RowMajor, rows, Dim * most>;
  using Vector = Eigen::Matrix<double, dofs, 1, 0, Dim * most, 1>;
  using Matrix = Eigen::Matrix<double, dofs, dofs, 0, Dim * most, Dim * most>;
};

/// What a point has across the plane; nothing in space.
template <int Dim, int N>
struct Across {};
template <int N>
struct Across<2, N> {
  bool ring = false;
  double radius = 0;                      ///< of a ring, undeformed
  double f33 = 1;                         ///< stretch of the circumference
  typename Sizes<2, N>::NodeVector hoop;  ///< of a ring: N_k / radius
};

/// Geometry and strain of one point.
template <int Dim, int N>
struct Point : Across<Dim, N> {
  double volume = 0;  ///< undeformed: weight times determinant, thickness or circumference
  double determinant = 0;
  Mat<Dim, Dim> f = Mat<Dim, Dim>::Identity();  ///< deformation gradient
  Vec<components<Dim>> strain;
  typename Sizes<Dim, N>::Nodal gradient;  ///< dN_k/dX
  typename Sizes<Dim, N>::Strains b;       ///< d(strain)/du
};

/// Derivative of the strain at the deformation gradient f with respect to the displacements.
template <class Nodal, class Strains>
void fill_strain_matrix(const Mat<2, 2>& f, const Nodal& gradient, Strains& b) {
  for (Eigen::Index k = 0; k < gradient.rows(); ++k) {
    const double x = gradient(k, 0), y = gradient(k, 1);
    for (Eigen::Index i = 0; i < 2; ++i)
      b.col(2 * k + i) << f(i, 0) * x, f(i, 1) * y, 0, f(i, 0) * y + f(i, 1) * x;
  }
}
template <class Nodal, class Strains>
void fill_strain_matrix(const Mat<3, 3>& f, const Nodal& gradient, Strains& b) {
  for (Eigen::Index k = 0; k < gradient.rows(); ++k) {
    const double x = gradient(k, 0), y = gradient(k, 1), z = gradient(k, 2);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double f0 = f(i, 0), f1 = f(i, 1), f2 = f(i, 2);
      b.col(3 * k + i) << f0 * x, f1 * y, f2 * z, f0 * y + f1 * x, f1 * z + f2 * y, f0 * z + f2 * x;
    }
  }
}

/// The strain of the circumference and its derivative.
///
/// Input      hoop: radial displacement over radius
/// Requires   p.hoop
template <int N>
void fill_hoop_strain(bool finite, double hoop, Point<2, N>& p) {
  p.ring = true;
  p.f33 = 1 + hoop;
  p.strain[2] = finite ? hoop + 0.5 * hoop * hoop : hoop;
  for (Eigen::Index k = 0; k < p.hoop.size(); ++k)
    p.b(2, 2 * k) = (finite ? p.f33 : 1.0) * p.hoop[k];
}
template <int N>
void add_hoop(bool finite, const cell::AreaShape& shape,
              const typename Sizes<2, N>::Nodal& reference,
              const typename Sizes<2, N>::Nodal& displacement, Point<2, N>& p) {
  const Eigen::Index n = reference.rows();
  p.radius = reference.col(0).dot(shape.n.head(n));
  p.hoop = shape.n.head(n) / p.radius;
  fill_hoop_strain<N>(finite, displacement.col(0).dot(shape.n.head(n)) / p.radius, p);
}

/// Strain and its derivative from the gradients of the shape functions, but for circumferences.
template <int Dim, int N>
void fill_strains(bool finite, const typename Sizes<Dim, N>::Nodal& displacement,
                  Point<Dim, N>& p) {
  using Square = Mat<Dim, Dim>;
  const Square h = displacement.transpose() * p.gradient;  // du_i/dX_j
  p.f = Square::Identity() + h;
  p.strain = strain_of(h);
  if (finite) p.strain += 0.5 * strain_of(Square(h.transpose() * h));
  p.b.resize(components<Dim>, Dim * displacement.rows());
  fill_strain_matrix(finite ? p.f : Square(Square::Identity()), p.gradient, p.b);
}
/// Of finite kinematics; true for small ones.
template <int Dim, int N>
[[nodiscard]] bool one_to_one(bool finite, const Point<Dim, N>& p) {
  if (!finite) return true;
  if constexpr (Dim == 2) {
    if (!(p.f33 > 0)) return false;
  }
  return p.f.determinant() > 0;
}

/// Fills `p`; false if det F is not positive (finite kinematics).
template <int Dim, int N>
[[nodiscard]] bool fill_point(const Section<Dim>& section, const Shape<Dim>& shape, double weight,
                              const typename Sizes<Dim, N>::Nodal& reference,
                              const typename Sizes<Dim, N>::Nodal& displacement, Point<Dim, N>& p) {
  using Square = Mat<Dim, Dim>;
  const bool finite = section.kinematics == Kinematics::finite;
  const Eigen::Index n = reference.rows();
  const Square jacobian = reference.transpose() * shape.d.topRows(n);  // dX_i/dxi_j
  p.determinant = jacobian.determinant();
  p.gradient.noalias() = shape.d.topRows(n) * jacobian.inverse();
  fill_strains<Dim, N>(finite, displacement, p);
  double radius = 0;
  if constexpr (Dim == 2) {
    if (is_ring(section)) add_hoop<N>(finite, shape, reference, displacement, p);
    radius = p.radius;
  }
  p.volume = weight * p.determinant * depth_at(section, radius);
  return one_to_one(finite, p);
}

/// What the material sees at the quadrature points.
template <int Dim>
struct Seen {
  Status status = Status::ok;
  std::array<Mat<Dim, Dim>, max_points<Dim>> f;
  std::array<double, max_points<Dim>> f33;
  std::array<Vec<components<Dim>>, max_points<Dim>> strain;

  template <int N>
  void set(std::size_t q, const Point<Dim, N>& p) {
    f[q] = p.f;
    if constexpr (Dim == 2) f33[q] = p.f33;
    strain[q] = p.strain;
  }
};

[[nodiscard]] inline material::Response point_response(const Section<2>& section,
                                                       const material::Strain& strain,
                                                       const material::Memory& memory,
                                                       double* strain_33 = nullptr) {
  if (section.assumption == Assumption::plane_stress)
    return material::plane_stress_response(section.law, strain, strain_33, memory);
  if (strain_33) *strain_33 = strain[2];
  return material::response(section.law, strain, memory);
}
[[nodiscard]] inline material::Response3 point_response(const Section<3>& section,
                                                        const material::Strain3& strain,
                                                        const material::Memory& memory) {
  return material::response(section.law, strain, memory);
}

/// Adds b^T s.
template <class Strains, class Stress, class Vector>
void add_force(const Strains& b, const Stress& s, Vector& force) {
  for (Eigen::Index c = 0; c < b.rows(); ++c) force += s[c] * b.row(c).transpose();
}

/// Adds the lower triangle of b^T d b for a symmetric d, in blocks of four rows and columns: those
/// on the diagonal are added as a whole. The sums run along contiguous rows of b.
template <class Strains, int C, class Matrix>
void add_material(const Strains& b, const Mat<C, C>& d, Matrix& lower) {
  static_assert(Strains::IsRowMajor && !Matrix::IsRowMajor);
  using Four = Eigen::Array4d;
  Strains db = b;
  for (Eigen::Index c = 0; c < C; ++c) {
    db.row(c) = d(c, 0) * b.row(0);
    for (Eigen::Index e = 1; e < C; ++e) db.row(c) += d(c, e) * b.row(e);
  }
  const Eigen::Index dofs = b.cols(), whole = dofs - dofs % 4;
  for (Eigen::Index j = 0; j < whole; j += 4)
    for (Eigen::Index i = j; i < whole; i += 4) {
      Four sum0 = Four::Zero(), sum1 = sum0, sum2 = sum0, sum3 = sum0;  // loops are not unrolled
      for (Eigen::Index c = 0; c < C; ++c) {
        const Four row = Eigen::Map<const Four>(&db(c, i));
        sum0 += b(c, j) * row;
        sum1 += b(c, j + 1) * row;
        sum2 += b(c, j + 2) * row;
        sum3 += b(c, j + 3) * row;
      }
      Eigen::Map<Four>(&lower(i, j)) += sum0;
      Eigen::Map<Four>(&lower(i, j + 1)) += sum1;
      Eigen::Map<Four>(&lower(i, j + 2)) += sum2;
      Eigen::Map<Four>(&lower(i, j + 3)) += sum3;
    }
  for (Eigen::Index i = whole; i < dofs; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      double sum = 0;
      for (Eigen::Index c = 0; c < C; ++c) sum += db(c, i) * b(c, j);
      lower(i, j) += sum;
    }
}

/// Adds the lower triangle of grad N_a . s grad N_b, the part of the tangent from the change of B.
template <int Dim, class Nodal, class NodeMatrix>
void add_geometric(const Nodal& gradient, const Mat<Dim, Dim>& stress, NodeMatrix& lower) {
  const Nodal turned = gradient * stress;
  const Eigen::Index n = gradient.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index m = n - j;
    const auto first =
        turned(j, 0) * gradient.col(0).tail(m) + turned(j, 1) * gradient.col(1).tail(m);
    if constexpr (Dim == 2)
      lower.col(j).tail(m) += first;
    else
      lower.col(j).tail(m) += first + turned(j, 2) * gradient.col(2).tail(m);
  }
}

/// Force of a cell and the lower triangle of its tangent, summed over the points.
template <int Dim, int N>
struct CellSum {
  using S = Sizes<Dim, N>;
  using Stress = Vec<components<Dim>>;
  bool with_tangent, finite;
  typename S::Vector force;
  typename S::Matrix tangent;
  typename S::NodeMatrix geometric;  ///< the same in each direction

  CellSum(const Section<Dim>& section, Eigen::Index nodes, bool tangent_too)
      : with_tangent(tangent_too), finite(section.kinematics == Kinematics::finite) {
    force.setZero(Dim * nodes);
    if (!with_tangent) return;
    tangent.setZero(Dim * nodes, Dim * nodes);
    geometric.setZero(nodes, nodes);
  }

  /// Input      scale: of the stress that works on the change of B
  void add(const Point<Dim, N>& p, const material::ResponseOf<components<Dim>>& r,
           double scale = 1) {
    const Stress stress = p.volume * r.stress;
    add_force(p.b, stress, force);
    if (!with_tangent) return;
    add_material(p.b, Mat<components<Dim>, components<Dim>>(p.volume * r.tangent), tangent);
    if (!finite) return;
    add_geometric<Dim>(p.gradient, stress_tensor(Stress(scale * stress)), geometric);
    if constexpr (Dim == 2) {
      if (!p.ring) return;
      for (Eigen::Index b = 0; b < p.hoop.size(); ++b)
        for (Eigen::Index a = b; a < p.hoop.size(); ++a)
          tangent(2 * a, 2 * b) += scale * stress[2] * p.hoop[a] * p.hoop[b];
    }
  }

  void finish(ElementResult<Dim>& out) {
    out.force = force;
    if (!with_tangent) return;
    const Eigen::Index n = geometric.rows();
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index a = b; a < n; ++a)
        for (Eigen::Index i = 0; i < Dim; ++i) tangent(Dim * a + i, Dim * b + i) += geometric(a, b);
    tangent.template triangularView<Eigen::StrictlyUpper>() = tangent.transpose();
    out.tangent = tangent;
  }
};

/// quad4 and hex8, whose points some formulations couple: as many of them as nodes.
template <int Dim>
inline constexpr int corners = 1 << Dim;
template <int Dim>
inline constexpr cell::CellType corner_cell =
    Dim == 2 ? cell::CellType::quad4 : cell::CellType::hex8;
template <int Dim>
using CornerPoint = Point<Dim, corners<Dim>>;
template <int Dim>
using CornerPoints = std::array<CornerPoint<Dim>, corners<Dim>>;
template <int Dim>
using CornerSizes = Sizes<Dim, corners<Dim>>;

/// Fills all points; false if det F is not positive somewhere (finite kinematics).
template <int Dim>
[[nodiscard]] bool fill_points(const Section<Dim>& section, const Coordinates<Dim>& reference,
                               const Coordinates<Dim>& displacement, CornerPoints<Dim>& points) {
  const Rule<Dim>& rule = rule_of(section, corner_cell<Dim>);
  const typename CornerSizes<Dim>::Nodal x = reference, u = displacement;
  bool one_to_one = true;
  for (std::size_t q = 0; q < points.size(); ++q)
    one_to_one =
        fill_point<Dim, corners<Dim>>(section, rule.shape[q], rule.weights[q], x, u, points[q]) &&
        one_to_one;
  return one_to_one;
}

/// Values at the nodes from those at the points, by least squares: one row a node.
///
/// Input      basis(xi): the terms of a polynomial, as a row
template <int Dim, class Basis>
[[nodiscard]] Eigen::MatrixXd extrapolation(cell::CellType type,
                                            const std::vector<Vec<Dim>>& points,
                                            const Basis& basis) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index nodes = cell::info(type).nodes, terms = basis(points[0]).size();
  Eigen::MatrixXd sample(count, terms), to(nodes, terms);
  for (Eigen::Index q = 0; q < count; ++q)
    sample.row(q) = basis(points[static_cast<std::size_t>(q)]);
  for (Eigen::Index k = 0; k < nodes; ++k)
    to.row(k) = basis(node_at<Dim>(type, static_cast<int>(k)));
  return to * core::least_squares(sample, Eigen::MatrixXd::Identity(count, count));
}

}  // namespace osculate::solid
