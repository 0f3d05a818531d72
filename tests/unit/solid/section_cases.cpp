#include "section_cases.hpp"

#include <cmath>

namespace osculate::solid::testing {

std::string SectionCase::name() const {
  constexpr std::array assumptions{"plane strain", "plane stress", "axisymmetric"};
  constexpr std::array kinds{"small", "finite"};
  constexpr std::array formulations{"full", "bbar", "enhanced", "solid_shell", "reduced"};
  return std::string(cell::info(type).name) + " " +
         assumptions[static_cast<std::size_t>(section.assumption)] + " " +
         kinds[static_cast<std::size_t>(section.kinematics)] + " " +
         formulations[static_cast<std::size_t>(section.formulation)] + " " +
         std::string(material::key_of(section.law));
}

void for_each_section(const std::function<void(const SectionCase&)>& visit) {
  using enum Assumption;
  using enum Formulation;
  int visited = 0;
  for (const cell::CellType type : area_types)
    for (const Assumption assumption : {plane_strain, plane_stress, axisymmetric})
      for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
        for (const Formulation formulation : {full, bbar, enhanced, reduced})
          for_each_form([&](const material::Law& law) {
            const SectionCase c{{assumption, kinematics, formulation, 1.7, law}, type};
            if (!unsupported(c.section, type).empty()) return;
            const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
            ++visited;
            visit(c);
          });
  EXPECT_EQ(visited, 32 * form_count);  // 5 cells x 3 assumptions, bbar 8, enhanced 3, reduced 6
}

double noise(Eigen::Index i, Eigen::Index j, int seed) {
  const double x = std::sin(12.9898 * static_cast<double>(i + 1) +
                            78.233 * static_cast<double>(j + 1) + 37.719 * seed) *
                   43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

Coordinates<2> sample_cell(cell::CellType type, double distortion, bool curved) {
  const cell::CellInfo& info = cell::info(type);
  const double scale = info.corners == 3 ? 1.0 : 0.5;
  Coordinates<2> x(info.nodes, 2);
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

Coordinates<2> sample_displacement(cell::CellType type, double size, int seed) {
  return Coordinates<2>::NullaryExpr(
      cell::info(type).nodes, 2,
      [&](Eigen::Index k, Eigen::Index i) { return size * noise(k, i, seed); });
}

Eigen::VectorXd flat(const Eigen::MatrixXd& u) { return u.transpose().reshaped(); }

Eigen::MatrixXd unflat(const Eigen::VectorXd& v, int dim) {
  return v.reshaped(dim, v.size() / dim).transpose();
}

}  // namespace osculate::solid::testing
