#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "osculate/core/dense.hpp"
#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/point_axes.hpp"
#include "osculate/solid/points.hpp"
#include "osculate/solid/reduced.hpp"
#include "osculate/solid/solid_shell.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;

template <int Dim>
void see_full(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, Seen<Dim>& out) {
  if (type == corner_cell<Dim>) {
    CornerPoints<Dim> points;
    if (!fill_points<Dim>(section, reference, displacement, points)) out.status = Status::inverted;
    for (std::size_t q = 0; q < points.size(); ++q) out.set(q, points[q]);
    return;
  }
  const Rule<Dim>& rule = rule_of(section, type);
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    Point<Dim, Eigen::Dynamic> p;
    if (!fill_point<Dim, Eigen::Dynamic>(section, rule.shape[q], rule.weights[q], reference,
                                         displacement, p))
      out.status = Status::inverted;
    out.set(q, p);
  }
}

template <int Dim>
void see_one_point(const Section<Dim>& section, const Coordinates<Dim>& reference,
                   const Coordinates<Dim>& displacement, Seen<Dim>& out) {
  CornerPoint<Dim> p;
  if (!fill_mean_point<Dim>(section, reference, displacement, p)) out.status = Status::inverted;
  out.set(0, p);
}

template <int Count, int Dim>
void enhance(const Section<Dim>& section, const Coordinates<Dim>& reference,
             const material::Memory& memory, CornerPoints<Dim>& points, Status& status) {
  const auto e = enhanced_modes<Count>(section, reference, points, memory);
  if (!e.ok) status = Status::material_failed;
  for (std::size_t q = 0; q < points.size(); ++q) points[q].strain += e.matrix[q] * e.alpha;
}

template <int Dim>
void see_enhanced(const Section<Dim>& section, const Coordinates<Dim>& reference,
                  const Coordinates<Dim>& displacement, const material::Memory& memory,
                  Seen<Dim>& out) {
  CornerPoints<Dim> points;
  if (!fill_points<Dim>(section, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if constexpr (Dim == 3)
    enhance<space_modes>(section, reference, memory, points, out.status);
  else if (is_ring(section))
    enhance<ring_modes>(section, reference, memory, points, out.status);
  else
    enhance<plane_modes>(section, reference, memory, points, out.status);
  for (std::size_t q = 0; q < points.size(); ++q) out.set(q, points[q]);
}

/// Cauchy stress from the second Piola-Kirchhoff stress.
Vec<4> cauchy(const Mat<2, 2>& f, double f33, const material::Stress& s) {
  const double j = f.determinant() * f33;
  const Mat<2, 2> sigma = f * stress_tensor(s) * f.transpose() / j;
  return {sigma(0, 0), sigma(1, 1), f33 * f33 * s[2] / j, sigma(0, 1)};
}
Vec<6> cauchy(const Mat<3, 3>& f, double, const material::Stress3& s) {
  const Mat<3, 3> t = f * stress_tensor(s) * f.transpose() / f.determinant();
  Vec<6> out;
  out << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
  return out;
}

/// Stress and strain of one point; false where the law has no answer.
template <int Dim>
bool fill_stress(const Section<Dim>& section, const Seen<Dim>& seen, std::size_t q,
                 const material::Memory& memory, PointStress<Dim>& out) {
  const bool finite = section.kinematics == Kinematics::finite;
  double f33 = seen.f33[q];
  out.strain = seen.strain[q];
  material::ResponseOf<components<Dim>> r;
  if constexpr (Dim == 2) {
    r = point_response(section, seen.strain[q], memory, &out.strain[2]);
    if (section.assumption == Assumption::plane_stress)
      f33 = std::sqrt(std::max(0.0, 1 + 2 * out.strain[2]));
  } else {
    r = point_response(section, seen.strain[q], memory);
  }
  out.strain.template tail<components<Dim> - 3>() *= 0.5;
  out.stress = finite && r.ok ? cauchy(seen.f[q], f33, r.stress) : r.stress;
  return r.ok;
}

/// Polynomial basis for the extrapolation: as many terms as the points of the cell can carry.
Eigen::RowVectorXd basis(CellType, std::size_t points, const Vec2& xi) {
  Eigen::RowVectorXd b(points == 1 ? 1 : points < 6 ? 3 : 6);
  b[0] = 1;
  if (b.size() >= 3) b.segment<2>(1) << xi.x(), xi.y();
  if (b.size() >= 6) b.segment<3>(3) << xi.x() * xi.y(), xi.x() * xi.x(), xi.y() * xi.y();
  return b;
}
Eigen::RowVectorXd basis(CellType type, std::size_t points, const Vec3& xi) {
  const bool flat = type == CellType::shell18;  // two points along zeta
  Eigen::RowVectorXd b(points == 1 ? 1 : points < 18 ? 4 : flat ? 9 : 10);
  b[0] = 1;
  if (b.size() >= 4) b.segment<3>(1) = xi.transpose();
  if (b.size() >= 9)
    b.segment<5>(4) << xi.x() * xi.y(), xi.y() * xi.z(), xi.z() * xi.x(), xi.x() * xi.x(),
        xi.y() * xi.y();
  if (b.size() >= 10) b[9] = xi.z() * xi.z();
  return b;
}

/// As many terms as there are points along the axes.
Eigen::RowVectorXd product_basis(std::size_t points, const Vec2& xi) {
  if (points == 1) return Eigen::RowVectorXd::Ones(1);
  return Eigen::RowVector4d(1, xi.x(), xi.y(), xi.prod());
}
Eigen::RowVectorXd product_basis(std::size_t points, const Vec3& xi) {
  if (points == 1) return Eigen::RowVectorXd::Ones(1);
  if (points == 2) return Eigen::RowVector2d(1, xi.z());  // wedge6
  Eigen::RowVectorXd b(8);
  b << product_basis(4, Vec2(xi.head<2>())), xi.z() * product_basis(4, Vec2(xi.head<2>()));
  return b;
}

template <int Dim>
Eigen::MatrixXd make_reduced_extrapolation(CellType type) {
  const std::vector<Vec<Dim>>& points = reduced_rule_of<Dim>(type).points;
  return extrapolation<Dim>(type, points,
                            [&](const Vec<Dim>& xi) { return product_basis(points.size(), xi); });
}
/// Linear along the beam, quadratic across.
const Eigen::MatrixXd& beam_extrapolation() {
  static const Eigen::MatrixXd all =
      extrapolation<3>(CellType::hex20, beam_rule().points, [](const Vec3& xi) {
        const double y = xi.y(), z = xi.z();
        Eigen::RowVectorXd b(12);
        b.head<6>() << 1, y, z, y * z, y * y, z * z;
        b.tail<6>() = xi.x() * b.head<6>();
        return b;
      });
  return all;
}
template <int Dim>
const Eigen::MatrixXd& reduced_extrapolation_of(CellType type) {
  if constexpr (Dim == 3) {
    static const Eigen::MatrixXd wedge = make_reduced_extrapolation<3>(CellType::wedge6);
    if (type == CellType::wedge6) return wedge;
  }
  static const Eigen::MatrixXd one = make_reduced_extrapolation<Dim>(corner_cell<Dim>),
                               two = make_reduced_extrapolation<Dim>(Dim == 2 ? CellType::quad8
                                                                              : CellType::hex20);
  return type == corner_cell<Dim> ? one : two;
}

template <int Dim>
Eigen::MatrixXd make_extrapolation(CellType type, bool ring = false) {
  const std::vector<Vec<Dim>>& points = rule_of<Dim>(type, ring).points;
  return extrapolation<Dim>(type, points, [&](const Vec<Dim>& xi) -> Eigen::RowVectorXd {
    if (type == corner_cell<Dim>)
      return product_basis(points.size(), xi);  // the points' own values
    return basis(type, points.size(), xi);
  });
}

/// Values at the nodes from those at the points.
const Eigen::MatrixXd& extrapolation_of(const Section<2>& section, CellType type) {
  if (section.formulation == Formulation::reduced) return reduced_extrapolation_of<2>(type);
  using enum CellType;
  static const std::array<Eigen::MatrixXd, 5> all{
      make_extrapolation<2>(tri3), make_extrapolation<2>(tri6), make_extrapolation<2>(quad4),
      make_extrapolation<2>(quad8), make_extrapolation<2>(quad9)};
  static const Eigen::MatrixXd ring = make_extrapolation<2>(tri3, true);
  if (is_ring(section) && type == tri3) return ring;
  return all[static_cast<std::size_t>(type) - static_cast<std::size_t>(tri3)];
}
const Eigen::MatrixXd& extrapolation_of(const Section<3>& section, CellType type) {
  if (section.formulation == Formulation::reduced) return reduced_extrapolation_of<3>(type);
  if (section.formulation == Formulation::beam) return beam_extrapolation();
  using enum CellType;
  static const std::array<Eigen::MatrixXd, 8> all{
      make_extrapolation<3>(tet4),    make_extrapolation<3>(tet10),  make_extrapolation<3>(wedge6),
      make_extrapolation<3>(wedge15), make_extrapolation<3>(hex8),   make_extrapolation<3>(hex20),
      make_extrapolation<3>(hex27),   make_extrapolation<3>(shell18)};
  if (section.formulation == Formulation::solid_shell) return solid_shell_extrapolation(type);
  return all[static_cast<std::size_t>(type) - static_cast<std::size_t>(tet4)];
}

/// Whether nothing strains a cell whose material has neither a past nor a stress of its own.
template <int Dim>
bool is_at_rest(const Section<Dim>& section, const Coordinates<Dim>& displacement,
                const material::Memory& memory) {
  if (!displacement.isZero(0) || memory.committed || memory.next || memory.expansion ||
      memory.initial || memory.temperature)
    return false;
  const auto at_once = point_response(section, Vec<components<Dim>>::Zero(), memory);
  return at_once.ok && at_once.stress.isZero(0);
}

}  // namespace

template <int Dim>
std::vector<std::size_t> in_order(const CellStress<Dim>& stress) {
  std::vector<std::size_t> order(static_cast<std::size_t>(stress.count));
  std::iota(order.begin(), order.end(), 0U);
  constexpr double same = 1e-6;
  std::ranges::sort(order, [&](std::size_t p, std::size_t q) {
    for (Eigen::Index i = Dim; i-- > 0;) {
      const double difference = stress.point[p].xi[i] - stress.point[q].xi[i];
      if (std::abs(difference) > same) return difference < 0;
    }
    return false;
  });
  return order;
}

template <int Dim>
CellStress<Dim> stress_at_points(const Section<Dim>& section, CellType type,
                                 const Coordinates<Dim>& reference,
                                 const Coordinates<Dim>& displacement,
                                 const material::Memory& remembered) {
  const PointAxes<Dim> placed(section, type, reference);
  const material::Memory memory = placed.in(remembered);
  if constexpr (Dim == 3) {
    if (section.formulation == Formulation::solid_shell)
      return solid_shell_stress_at_points(section, type, reference, displacement, memory);
  }
  const Rule<Dim>& rule = rule_of(section, type);
  Seen<Dim> seen;
  const bool rests = is_at_rest(section, displacement, remembered);
  const bool reduced = section.formulation == Formulation::reduced,
             one = reduced && type == corner_cell<Dim>,
             plain = section.formulation == Formulation::full ||
                     section.formulation == Formulation::beam;
  if (rests)
    seen.status = Status::ok;
  else if (one)
    see_one_point(section, reference, displacement, seen);
  else if (reduced || plain)
    see_full(section, type, reference, displacement, seen);
  else if (section.formulation == Formulation::bbar)
    see_bbar(section, type, reference, displacement, seen);
  else
    see_enhanced(section, reference, displacement, memory, seen);
  CellStress<Dim> out;
  out.status = seen.status;
  out.count = static_cast<int>(rule.points.size());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    PointStress<Dim>& p = out.point[q];
    const Shape<Dim>& s = rule.shape[q];
    p.xi = rule.points[q];
    p.position = reference.transpose() * s.n.head(s.count);
    p.volume = volume_at(section, s, rule.weights[q], reference);
    if (one) {
      const ElementVector<Dim> share = volume_weights(section, type, reference);
      p.volume = share.sum();
      p.position = reference.transpose() * share / p.volume;
    }
    p.stress.setZero();
    p.strain.setZero();
    if (!rests && seen.status != Status::inverted &&
        !fill_stress(section, seen, q, memory.at(q), p))
      out.status = Status::material_failed;
  }
  return out;
}

template <int Dim>
Eigen::MatrixXd at_nodes(const Section<Dim>& section, CellType type,
                         const Eigen::MatrixXd& of_points) {
  return extrapolation_of(section, type) * of_points;
}

template <int Dim>
NodalStress<Dim> nodal_stress(const Section<Dim>& section, CellType type,
                              const Coordinates<Dim>& reference,
                              const Coordinates<Dim>& displacement,
                              const material::Memory& memory) {
  const CellStress<Dim> at = stress_at_points(section, type, reference, displacement, memory);
  const Eigen::MatrixXd& factor = extrapolation_of(section, type);
  NodalStress<Dim> out;
  out.count = cell::info(type).nodes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(out.count); ++k) {
    out.stress[k].setZero();
    out.strain[k].setZero();
    for (std::size_t q = 0; q < static_cast<std::size_t>(at.count); ++q) {
      const double share = factor(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q));
      out.stress[k] += share * at.point[q].stress;
      out.strain[k] += share * at.point[q].strain;
    }
  }
  return out;
}

template std::vector<std::size_t> in_order(const CellStress<2>&);
template std::vector<std::size_t> in_order(const CellStress<3>&);
template CellStress<2> stress_at_points(const Section<2>&, CellType, const Coordinates<2>&,
                                        const Coordinates<2>&, const material::Memory&);
template CellStress<3> stress_at_points(const Section<3>&, CellType, const Coordinates<3>&,
                                        const Coordinates<3>&, const material::Memory&);
template Eigen::MatrixXd at_nodes(const Section<2>&, CellType, const Eigen::MatrixXd&);
template Eigen::MatrixXd at_nodes(const Section<3>&, CellType, const Eigen::MatrixXd&);
template NodalStress<2> nodal_stress(const Section<2>&, CellType, const Coordinates<2>&,
                                     const Coordinates<2>&, const material::Memory&);
template NodalStress<3> nodal_stress(const Section<3>&, CellType, const Coordinates<3>&,
                                     const Coordinates<3>&, const material::Memory&);

}  // namespace osculate::solid
