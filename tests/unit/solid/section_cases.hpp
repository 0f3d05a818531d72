#pragma once
// Every section the solid layer supports, on every cell of the plane, for conformance tests.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

#include "osculate/cell/shape.hpp"
#include "osculate/solid/element.hpp"
#include "sample_laws.hpp"

namespace osculate::solid::testing {

/// The law itself, or the one that is used in a finite strain.
template <class T>
T& constants(T& law) {
  return law;
}
template <class T>
T& constants(material::Logarithmic<T>& form) {
  return form.law;
}
template <class T>
T& constants(material::GreenLagrange<T>& form) {
  return form.law;
}
template <class T>
T& constants(material::Relaxing<T>& form) {
  return form.law;
}

/// Every law, and every form of one for finite strains or with relaxation. Those that yield do so
/// where they are made to: here they are elastic.
template <class Visit>
void for_each_form(const Visit& visit) {
  material::for_each_law([&](auto law) {
    osculate::testing::set_elastic(law, 7, 0.3);
    visit(law);
    if (material::has_finite_form(law)) visit(material::in_finite_strain(law));
    const material::Relaxation alike{{{0.3, 1}, {0.2, 5}}, {{0.3, 1}, {0.2, 5}}};
    if (const auto relaxing = material::relaxing(law, alike)) visit(*relaxing);
  });
}

inline constexpr int form_count = std::variant_size_v<material::Law::variant>;

constexpr std::array<cell::CellType, 5> area_types{cell::CellType::tri3, cell::CellType::tri6,
                                                   cell::CellType::quad4, cell::CellType::quad8,
                                                   cell::CellType::quad9};

struct SectionCase {
  using Places = Coordinates<2>;
  using Result = ElementResult<2>;
  Section<2> section;
  cell::CellType type;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool axisymmetric() const { return section.assumption == Assumption::axisymmetric; }
  [[nodiscard]] bool finite() const { return section.kinematics == Kinematics::finite; }
};

/// Visits all supported combinations of cell, assumption, kinematics, formulation and law.
void for_each_section(const std::function<void(const SectionCase&)>& visit);

/// Number in -1..1 that only depends on its arguments.
double noise(Eigen::Index i, Eigen::Index j, int seed = 0);

/// A cell of size about 1 at radius about 3. Corners are displaced by `distortion`; nodes on edges
/// stay in the middle unless `curved`.
Coordinates<2> sample_cell(cell::CellType type, double distortion, bool curved);

Coordinates<2> sample_displacement(cell::CellType type, double size, int seed = 1);

/// A row per node in one column, and back.
Eigen::VectorXd flat(const Eigen::MatrixXd& u);
Eigen::MatrixXd unflat(const Eigen::VectorXd& v, int dim);

template <class Case>
typename Case::Result evaluated(const Case& c, const typename Case::Places& x,
                                const typename Case::Places& u) {
  typename Case::Result r;
  evaluate(c.section, c.type, x, u, true, r);
  EXPECT_EQ(r.status, Status::ok);
  return r;
}

/// Size of the forces of a strain of one: what rounding is relative to.
template <class Case>
double stiffness_scale(const Case& c, const typename Case::Places& x) {
  return evaluated(c, x, Case::Places::Zero(x.rows(), x.cols())).tangent.norm();
}

}  // namespace osculate::solid::testing
