#pragma once
// Every section the solid layer supports, on every cell, for conformance tests.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "osculate/cell/shape.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid::testing {

constexpr std::array<cell::CellType, 5> area_types{cell::CellType::tri3, cell::CellType::tri6,
                                                   cell::CellType::quad4, cell::CellType::quad8,
                                                   cell::CellType::quad9};

struct SectionCase {
  Section section;
  cell::CellType type;

  [[nodiscard]] std::string name() const {
    constexpr std::array assumptions{"plane strain", "plane stress", "axisymmetric"};
    constexpr std::array kinds{"small", "finite"};
    constexpr std::array formulations{"full", "bbar", "enhanced"};
    return std::string(cell::info(type).name) + " " +
           assumptions[static_cast<std::size_t>(section.assumption)] + " " +
           kinds[static_cast<std::size_t>(section.kinematics)] + " " +
           formulations[static_cast<std::size_t>(section.formulation)] + " " +
           std::string(material::key_of(section.law));
  }
  [[nodiscard]] bool axisymmetric() const { return section.assumption == Assumption::axisymmetric; }
  [[nodiscard]] bool finite() const { return section.kinematics == Kinematics::finite; }
};

/// Visits all supported combinations of cell, assumption, kinematics, formulation and law.
template <class Visit>
void for_each_section(const Visit& visit) {
  using enum Assumption;
  using enum Formulation;
  int visited = 0;
  for (const cell::CellType type : area_types)
    for (const Assumption assumption : {plane_strain, plane_stress, axisymmetric})
      for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
        for (const Formulation formulation : {full, bbar, enhanced})
          material::for_each_law([&](auto law) {
            law.young = 7;
            law.poisson = 0.3;
            const SectionCase c{{assumption, kinematics, formulation, 1.7, law}, type};
            if (!unsupported(c.section, type).empty()) return;
            const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
            ++visited;
            visit(c);
          });
  EXPECT_EQ(visited, 57);  // 5 cells x 3 assumptions x 3 laws, bbar 2 x 3, enhanced 2 x 3
}

/// Number in -1..1 that only depends on its arguments.
inline double noise(int i, int j, int seed = 0) {
  const double x = std::sin(12.9898 * (i + 1) + 78.233 * (j + 1) + 37.719 * seed) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

/// A cell of size about 1 at radius about 3. Corners are displaced by `distortion`; nodes on edges
/// stay in the middle unless `curved`.
inline Coordinates sample_cell(cell::CellType type, double distortion, bool curved) {
  const cell::CellInfo& info = cell::info(type);
  const double scale = info.corners == 3 ? 1.0 : 0.5;
  Coordinates x(info.nodes, 2);
  for (int k = 0; k < info.nodes; ++k) {
    x.row(k) = scale * cell::area_node(type, k) + Vec2(3, 0.4);
    const bool moves = curved || k < info.corners;
    for (int i = 0; i < 2 && moves; ++i) x(k, i) += distortion * noise(k, i);
  }
  if (curved) return x;
  for (int e = 0; e < info.edge_count && info.order == 2; ++e) {
    const auto& edge = info.edges[static_cast<std::size_t>(e)];
    x.row(edge[2]) = 0.5 * (x.row(edge[0]) + x.row(edge[1]));
  }
  if (type == cell::CellType::quad9) x.row(8) = 0.25 * x.topRows<4>().colwise().sum();
  return x;
}

inline Coordinates sample_displacement(cell::CellType type, double size, int seed = 1) {
  Coordinates u(cell::info(type).nodes, 2);
  for (Eigen::Index k = 0; k < u.rows(); ++k)
    for (Eigen::Index i = 0; i < 2; ++i)
      u(k, i) = size * noise(static_cast<int>(k), static_cast<int>(i), seed);
  return u;
}

inline Eigen::VectorXd flat(const Coordinates& u) {
  Eigen::VectorXd v(2 * u.rows());
  for (Eigen::Index k = 0; k < u.rows(); ++k) v.segment<2>(2 * k) = u.row(k);
  return v;
}
inline Coordinates unflat(const Eigen::VectorXd& v) {
  Coordinates u(v.size() / 2, 2);
  for (Eigen::Index k = 0; k < u.rows(); ++k) u.row(k) = v.segment<2>(2 * k);
  return u;
}

inline ElementResult evaluated(const SectionCase& c, const Coordinates& x, const Coordinates& u) {
  ElementResult r;
  evaluate(c.section, c.type, x, u, true, r);
  EXPECT_EQ(r.status, Status::ok);
  return r;
}

/// Size of the forces of a strain of one: what rounding is relative to.
inline double stiffness_scale(const SectionCase& c, const Coordinates& x) {
  return evaluated(c, x, Coordinates::Zero(x.rows(), 2)).tangent.norm();
}

inline Coordinates edge_of(const cell::CellInfo& info, int edge, const Coordinates& x) {
  Coordinates nodes(cell::info(info.edge_type).nodes, 2);
  for (Eigen::Index k = 0; k < nodes.rows(); ++k)
    nodes.row(k) = x.row(info.edges[static_cast<std::size_t>(edge)][static_cast<std::size_t>(k)]);
  return nodes;
}

}  // namespace osculate::solid::testing
