#include "osculate/solid/element.hpp"

#include <algorithm>
#include <limits>

#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/finite_forces.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/point_axes.hpp"
#include "osculate/solid/points.hpp"
#include "osculate/solid/reduced.hpp"
#include "osculate/solid/solid_shell.hpp"
#include "osculate/solid/solid_shell_strain.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;

template <int N, int Dim>
void evaluate_full(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
                   const Coordinates<Dim>& displacement, const material::Memory& memory,
                   bool with_tangent, ElementResult<Dim>& out) {
  const Rule<Dim>& rule = rule_of(section, type);
  const typename Sizes<Dim, N>::Nodal x = reference, u = displacement;
  CellSum<Dim, N> sum(section, x.rows(), with_tangent);
  Point<Dim, N> p;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    if (!fill_point<Dim, N>(section, rule.shape[q], rule.weights[q], x, u, p)) {
      out.status = Status::inverted;
      return;
    }
    const auto r = point_response(section, p.strain, memory.at(q));
    if (!r.ok) {
      out.status = Status::material_failed;
      return;
    }
    sum.add(p, r);
  }
  if constexpr (Dim == 3 && N == Eigen::Dynamic) {
    if (has_faint_stiffness(section, type))
      add_faint_stiffness(faint_stiffness(section, type, reference), displacement, sum);
  }
  sum.finish(out);
}

/// One point, and the energy of the modes that it does not see.
template <int Dim>
void evaluate_one_point(const Section<Dim>& section, const Coordinates<Dim>& reference,
                        const Coordinates<Dim>& displacement, const material::Memory& memory,
                        bool with_tangent, ElementResult<Dim>& out) {
  CornerPoint<Dim> p;
  if (!fill_mean_point<Dim>(section, reference, displacement, p)) {
    out.status = Status::inverted;
    return;
  }
  const auto r = point_response(section, p.strain, memory);
  if (!r.ok) {
    out.status = Status::material_failed;
    return;
  }
  const Hourglass<Dim> rest = hourglass<Dim>(section, reference, displacement, p, with_tangent);
  CellSum<Dim, corners<Dim>> sum(section, corners<Dim>, with_tangent);
  sum.add(p, r);
  sum.force += rest.force;
  if (with_tangent) sum.tangent += rest.tangent;
  sum.finish(out);
}

/// Enhanced strains: the mode parameters are condensed out of force and tangent.
template <int Count, int Dim>
void evaluate_enhanced(const Section<Dim>& section, const Coordinates<Dim>& reference,
                       const material::Memory& memory, bool with_tangent,
                       const CornerPoints<Dim>& points, ElementResult<Dim>& out) {
  constexpr int rows = components<Dim>, dofs = CornerSizes<Dim>::dofs;
  const EnhancedModes<Count> e = enhanced_modes<Count>(section, reference, points, memory);
  if (!e.ok) {
    out.status = Status::material_failed;
    return;
  }
  CellSum<Dim, corners<Dim>> sum(section, corners<Dim>, with_tangent);
  Mat<Count, dofs> coupling = Mat<Count, dofs>::Zero();
  for (std::size_t q = 0; q < points.size(); ++q) {
    const CornerPoint<Dim>& p = points[q];
    sum.add(p, e.response[q]);
    if (!with_tangent) continue;
    const Mat<rows, rows> d = p.volume * e.response[q].tangent;
    const Mat<Count, rows> weighted = e.matrix[q].transpose() * d;
    coupling.noalias() += weighted * p.b;
  }
  if (with_tangent) {
    const Mat<Count, dofs> modes = e.stiffness.partialPivLu().solve(coupling);
    sum.tangent.noalias() -= coupling.transpose() * modes;
  }
  sum.finish(out);
}

template <int Dim>
void evaluate_modes(const Section<Dim>& section, const Coordinates<Dim>& reference,
                    const Coordinates<Dim>& displacement, const material::Memory& memory,
                    bool with_tangent, ElementResult<Dim>& out) {
  CornerPoints<Dim> points;
  if (!fill_points<Dim>(section, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if constexpr (Dim == 3)
    evaluate_enhanced<space_modes>(section, reference, memory, with_tangent, points, out);
  else if (is_ring(section))
    evaluate_enhanced<ring_modes>(section, reference, memory, with_tangent, points, out);
  else
    evaluate_enhanced<plane_modes>(section, reference, memory, with_tangent, points, out);
}

template <int Dim>
void evaluate_whole(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
                    const Coordinates<Dim>& displacement, const material::Memory& memory,
                    bool with_tangent, ElementResult<Dim>& out) {
  constexpr CellType simplex = Dim == 2 ? CellType::tri3 : CellType::tet4;
  if constexpr (Dim == 3) {
    if (section.formulation == Formulation::solid_shell) {
      evaluate_solid_shell(section, type, reference, displacement, with_tangent, out, memory);
      return;
    }
  }
  const auto evaluate_full_of = [&]<int N>() {
    evaluate_full<N>(section, type, reference, displacement, memory, with_tangent, out);
  };
  out.status = Status::ok;
  const bool reduced = section.formulation == Formulation::reduced;
  if (reduced && type == corner_cell<Dim>)
    evaluate_one_point<Dim>(section, reference, displacement, memory, with_tangent, out);
  else if (section.formulation == Formulation::bbar)
    evaluate_bbar(section, type, reference, displacement, memory, with_tangent, out);
  else if (section.formulation == Formulation::enhanced)
    evaluate_modes(section, reference, displacement, memory, with_tangent, out);
  else if (type == corner_cell<Dim>)
    evaluate_full_of.template operator()<corners<Dim>>();
  else if (type == simplex)
    evaluate_full_of.template operator()<Dim + 1>();
  else
    evaluate_full_of.template operator()<Eigen::Dynamic>();
}

bool full_or_bbar(Formulation formulation) {
  return formulation == Formulation::full || formulation == Formulation::bbar;
}
/// The cells that explicit analyses have by the thousand.
bool has_forces_alone(const Section<2>& section, CellType type) {
  return section.kinematics == Kinematics::finite &&
         section.assumption == Assumption::plane_strain && full_or_bbar(section.formulation) &&
         type == CellType::quad4;
}
bool has_forces_alone(const Section<3>& section, CellType type) {
  if (section.kinematics != Kinematics::finite) return false;
  if (type == CellType::tet4) return section.formulation == Formulation::full;
  return type == CellType::hex8 && full_or_bbar(section.formulation);
}

template <int Dim>
void evaluate_forces(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
                     const Coordinates<Dim>& displacement, const material::Memory& memory,
                     ElementResult<Dim>& out) {
  const auto set = [&](const auto& table) {
    out.status = finite_forces(table, section.law, depth_at(section, 0),
                               section.formulation == Formulation::bbar, reference, displacement,
                               memory, out.force);
  };
  static const PointTable<Dim, corners<Dim>, corners<Dim>> corner(rule_of<Dim>(corner_cell<Dim>));
  if constexpr (Dim == 3) {
    static const PointTable<3, 4, 1> tet(rule_of<3>(CellType::tet4));
    if (type == CellType::tet4) {
      set(tet);
      return;
    }
  }
  set(corner);
}

}  // namespace

template <int Dim>
std::string_view unsupported(const Section<Dim>& section, CellType type) {
  if (cell::info(type).dimension != Dim)
    return Dim == 2 ? "only area cells can be bodies in 2D"
                    : "only volume cells can be bodies in 3D";
  const bool finite = section.kinematics == Kinematics::finite;
  if (finite && !material::finite_strain(section.law))
    return "linear_elastic is a law of small strains; use st_venant_kirchhoff or neo_hooke with "
           "finite kinematics";
  if (!finite && material::finite_strain(section.law))
    return "the law is one of finite strains; use linear_elastic with small kinematics";
  if (section.formulation == Formulation::full) return {};
  if (section.formulation == Formulation::solid_shell) {
    if (type == CellType::hex8 || type == CellType::shell18) return {};
    return "formulation solid_shell exists for hex8 and shell18 cells only; use full";
  }
  if (section.formulation == Formulation::reduced) {
    if (type == corner_cell<Dim> || type == CellType::quad8 || type == CellType::hex20 ||
        type == CellType::wedge6)
      return {};
    return Dim == 2 ? "formulation reduced exists for quad4 and quad8 cells only; use auto"
                    : "formulation reduced exists for hex8, hex20 and wedge6 cells only; use auto";
  }
  if (section.formulation == Formulation::beam)
    return type == CellType::hex20 ? "" : "formulation beam exists for hex20 cells only; use auto";
  if (section.formulation == Formulation::enhanced) {
    if (type == corner_cell<Dim>) return {};
    return Dim == 2 ? "formulation enhanced exists for quad4 cells only; use auto"
                    : "formulation enhanced exists for hex8 cells only; use auto";
  }
  if (volume_terms<Dim>(type) == 0)
    return Dim == 2 ? "formulation bbar exists for quad4 and second-order cells; use auto"
                    : "formulation bbar exists for hex8 and second-order cells; use auto";
  if constexpr (Dim == 2) {
    if (section.assumption == Assumption::plane_stress)
      return "formulation bbar has no use in plane stress; use full or enhanced";
  }
  return {};
}

template <int Dim>
void evaluate(const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, bool with_tangent, ElementResult<Dim>& out,
              const material::Memory& memory) {
  const bool alone = has_forces_alone(section, type);
  const PointAxes<Dim> placed(section, type, reference);
  const material::Memory here = placed.in(memory);
  if (with_tangent || !alone)
    evaluate_whole(section, type, reference, displacement, here, with_tangent, out);
  if (!alone || (with_tangent && out.status != Status::ok)) return;
  evaluate_forces(section, type, reference, displacement, here,
                  out);  // the same bits in both ways
}

template <int Dim>
std::size_t point_count(const Section<Dim>& section, CellType type) {
  if (section.formulation == Formulation::solid_shell) return shell_rule(type).points.size();
  return rule_of(section, type).points.size();
}

template <int Dim>
ElementVector<Dim> volume_weights(const Section<Dim>& section, CellType type,
                                  const Coordinates<Dim>& reference) {
  const Rule<Dim>& rule = rule_of<Dim>(type, is_ring(section));
  const Eigen::Index n = reference.rows();
  ElementVector<Dim> weights = ElementVector<Dim>::Zero(n);
  for (std::size_t q = 0; q < rule.weights.size(); ++q)
    weights +=
        volume_at(section, rule.shape[q], rule.weights[q], reference) * rule.shape[q].n.head(n);
  return weights;
}

template <int Dim>
double smallest_jacobian(CellType type, const Coordinates<Dim>& reference, bool collapsed) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto visit = [&](const Shape<Dim>& s) {
    const Mat<Dim, Dim> j = reference.transpose() * s.d.topRows(s.count);
    smallest = std::min(smallest, j.determinant());
  };
  for (const bool ring : {false, true})
    for (const Shape<Dim>& s : rule_of<Dim>(type, ring).shape) visit(s);
  if (collapsed || cell::info(type).nodes > cell::info(type).corners) return smallest;
  for (int k = 0; k < cell::info(type).nodes; ++k)
    visit(shape_at<Dim>(type, node_at<Dim>(type, k)));
  return smallest;
}

template std::string_view unsupported(const Section<2>&, CellType);
template std::string_view unsupported(const Section<3>&, CellType);
template void evaluate(const Section<2>&, CellType, const Coordinates<2>&, const Coordinates<2>&,
                       bool, ElementResult<2>&, const material::Memory&);
template void evaluate(const Section<3>&, CellType, const Coordinates<3>&, const Coordinates<3>&,
                       bool, ElementResult<3>&, const material::Memory&);
template std::size_t point_count(const Section<2>&, CellType);
template std::size_t point_count(const Section<3>&, CellType);
template ElementVector<2> volume_weights(const Section<2>&, CellType, const Coordinates<2>&);
template ElementVector<3> volume_weights(const Section<3>&, CellType, const Coordinates<3>&);
template double smallest_jacobian<2>(CellType, const Coordinates<2>&, bool);
template double smallest_jacobian<3>(CellType, const Coordinates<3>&, bool);

}  // namespace osculate::solid
