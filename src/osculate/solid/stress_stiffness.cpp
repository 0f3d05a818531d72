#include "osculate/solid/stress_stiffness.hpp"

#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/points.hpp"
#include "osculate/solid/reduced.hpp"
#include "osculate/solid/solid_shell.hpp"

namespace osculate::solid {
namespace {

/// Adds what the stress of one point gives, as lower triangles.
template <int Dim, int N>
void add_stressed_point(const Point<Dim, N>& p, const Vec<components<Dim>>& of_point,
                        typename Sizes<Dim, Eigen::Dynamic>::NodeMatrix& each,
                        ElementMatrix<Dim>& whole) {
  const Vec<components<Dim>> stress = p.volume * of_point;
  add_geometric<Dim>(p.gradient, stress_tensor(stress), each);
  if constexpr (Dim == 2) {
    if (!p.ring) return;
    for (Eigen::Index b = 0; b < p.hoop.size(); ++b)
      for (Eigen::Index a = b; a < p.hoop.size(); ++a)
        whole(2 * a, 2 * b) += stress[2] * p.hoop[a] * p.hoop[b];
  }
}

}  // namespace

template <int Dim>
ElementMatrix<Dim> stress_stiffness(const Section<Dim>& section, cell::CellType type,
                                    const Coordinates<Dim>& reference,
                                    const CellStress<Dim>& stress) {
  const Eigen::Index n = reference.rows();
  ElementMatrix<Dim> whole = ElementMatrix<Dim>::Zero(Dim * n, Dim * n);
  if constexpr (Dim == 3) {
    if (section.formulation == Formulation::solid_shell) {
      add_solid_shell_stress_stiffness(section, type, reference, stress, whole);
      return whole;
    }
  }
  typename Sizes<Dim, Eigen::Dynamic>::NodeMatrix each;
  each.setZero(n, n);
  const Coordinates<Dim> none = Coordinates<Dim>::Zero(n, Dim);
  if (section.formulation == Formulation::reduced && type == corner_cell<Dim>) {
    CornerPoint<Dim> p;
    (void)fill_mean_point<Dim>(section, reference, none, p);
    add_stressed_point<Dim>(p, stress.point[0].stress, each, whole);
  } else {
    const Rule<Dim>& rule = rule_of(section, type);
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      Point<Dim, Eigen::Dynamic> p;
      (void)fill_point<Dim, Eigen::Dynamic>(section, rule.shape[q], rule.weights[q], reference,
                                            none, p);
      add_stressed_point<Dim>(p, stress.point[q].stress, each, whole);
    }
  }
  if (section.formulation == Formulation::bbar)
    add_bbar_stress_stiffness(section, type, reference, stress, whole);
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = b; a < n; ++a)
      for (Eigen::Index i = 0; i < Dim; ++i) whole(Dim * a + i, Dim * b + i) += each(a, b);
  whole.template triangularView<Eigen::StrictlyUpper>() = whole.transpose();
  return whole;
}

template ElementMatrix<2> stress_stiffness(const Section<2>&, cell::CellType, const Coordinates<2>&,
                                           const CellStress<2>&);
template ElementMatrix<3> stress_stiffness(const Section<3>&, cell::CellType, const Coordinates<3>&,
                                           const CellStress<3>&);

}  // namespace osculate::solid
