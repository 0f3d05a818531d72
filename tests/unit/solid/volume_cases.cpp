#include "volume_cases.hpp"

#include "osculate/solid/solid_shell.hpp"

namespace osculate::solid::testing {
namespace {

/// Position at xi of the cell with the same corners, linear between them.
Vec3 between_corners(cell::CellType type, const Coordinates<3>& x, const Vec3& xi) {
  using enum cell::CellType;
  const int corners = cell::info(type).corners;
  const cell::VolumeShape s = cell::volume_shape(corners == 4   ? tet4
                                                 : corners == 6 ? wedge6
                                                                : hex8,
                                                 xi);
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < corners; ++k)
    at += s.n[k] * x.row(type == shell18 && k >= 4 ? k + 5 : k).transpose();
  return at;
}

}  // namespace

std::string VolumeCase::name() const {
  constexpr std::array kinds{"small", "finite"};
  constexpr std::array formulations{"full", "bbar", "enhanced", "solid_shell", "reduced", "beam"};
  return std::string(cell::info(type).name) + " " +
         kinds[static_cast<std::size_t>(section.kinematics)] + " " +
         formulations[static_cast<std::size_t>(section.formulation)] + " " +
         std::string(material::key_of(section.law));
}

void for_each_volume(const std::function<void(const VolumeCase&)>& visit) {
  using enum Formulation;
  int visited = 0;
  for (const cell::CellType type : volume_types)
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
      for (const Formulation formulation : {full, bbar, enhanced, reduced, beam})
        for_each_form([&](const material::Law& law) {
          const VolumeCase c{{kinematics, formulation, law}, type};
          if (!unsupported(c.section, type).empty()) return;
          const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
          ++visited;
          visit(c);
        });
  EXPECT_EQ(visited,
            18 * form_count);  // 8 cells, bbar of hex8 and four of second order, enhanced and
                               // reduced of hex8, reduced of hex20 and wedge6, beam of hex20
}

void for_each_shell(const std::function<void(const VolumeCase&)>& visit) {
  int visited = 0;
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    for_each_form([&](const material::Law& law) {
      const bool finite = material::finite_strain(law);
      const VolumeCase c{
          {finite ? Kinematics::finite : Kinematics::small, Formulation::solid_shell, law}, type};
      const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
      EXPECT_EQ(unsupported(c.section, type), "");
      ++visited;
      visit(c);
    });
  EXPECT_EQ(visited, 2 * form_count);
}

Coordinates<3> sample_volume(cell::CellType type, double distortion, bool curved) {
  const cell::CellInfo& info = cell::info(type);
  Coordinates<3> x(info.nodes, 3);
  for (int k = 0; k < info.nodes; ++k) {
    const Vec3 xi = cell::volume_node(type, k);
    const double across = info.corners == 6 ? 0.5 : 1;  // wedges are two high
    x.row(k) =
        (info.corners == 8 ? 0.5 : 1.0) * Vec3(xi.x(), xi.y(), across * xi.z()) + Vec3(3, 0.4, -1);
    for (Eigen::Index i = 0; i < 3; ++i) x(k, i) += distortion * noise(k, i);
  }
  if (curved) return x;
  const Coordinates<3> corners = x;
  for (int k = 0; k < info.nodes; ++k)
    x.row(k) = between_corners(type, corners, cell::volume_node(type, k));
  return x;
}

Coordinates<3> sample_shell(cell::CellType type, double thickness, double distortion) {
  Coordinates<3> x(cell::info(type).nodes, 3);
  for (int k = 0; k < x.rows(); ++k) {
    const Vec3 at = 0.5 * cell::volume_node(type, k);
    for (int i = 0; i < 3; ++i) x(k, i) = at[i] + distortion * noise(k, i);
    x(k, 2) *= thickness;
  }
  return x;
}

Coordinates<3> sample_motion(cell::CellType type, double size, int seed) {
  return Coordinates<3>::NullaryExpr(
      cell::info(type).nodes, 3,
      [&](Eigen::Index k, Eigen::Index i) { return size * noise(k, i, seed); });
}

Mat<3, 3> turn3(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}

Mat<3, 3> tensor(const Vec<6>& s) {
  Mat<3, 3> t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

Coordinates<3> face_of(const cell::CellFace& face, const Coordinates<3>& x) {
  Coordinates<3> nodes(cell::info(face.type).nodes, 3);
  for (Eigen::Index k = 0; k < nodes.rows(); ++k)
    nodes.row(k) = x.row(face.nodes[static_cast<std::size_t>(k)]);
  return nodes;
}

}  // namespace osculate::solid::testing
