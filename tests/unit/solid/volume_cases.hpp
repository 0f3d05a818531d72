#pragma once
// Every section in space, on every volume cell, for conformance tests.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "osculate/solid/volume.hpp"

namespace osculate::solid::testing {

constexpr std::array<cell::CellType, 8> volume_types{
    cell::CellType::tet4, cell::CellType::tet10, cell::CellType::wedge6, cell::CellType::wedge15,
    cell::CellType::hex8, cell::CellType::hex20, cell::CellType::hex27,  cell::CellType::shell18};

struct VolumeCase {
  VolumeSection section;
  cell::CellType type;

  [[nodiscard]] std::string name() const {
    constexpr std::array kinds{"small", "finite"};
    constexpr std::array formulations{"full", "bbar", "enhanced", "solid_shell"};
    return std::string(cell::info(type).name) + " " +
           kinds[static_cast<std::size_t>(section.kinematics)] + " " +
           formulations[static_cast<std::size_t>(section.formulation)] + " " +
           std::string(material::key_of(section.law));
  }
  [[nodiscard]] bool finite() const { return section.kinematics == Kinematics::finite; }
};

/// Visits all supported combinations of cell, kinematics, displacement formulation and law.
template <class Visit>
void for_each_volume(const Visit& visit) {
  using enum VolumeFormulation;
  int visited = 0;
  for (const cell::CellType type : volume_types)
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
      for (const VolumeFormulation formulation : {full, bbar, enhanced})
        material::for_each_law([&](auto law) {
          law.young = 7;
          law.poisson = 0.3;
          const VolumeCase c{{kinematics, formulation, law}, type};
          if (!unsupported(c.section, type).empty()) return;
          const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
          ++visited;
          visit(c);
        });
  EXPECT_EQ(visited, 30);  // 8 cells x 3 laws, bbar and enhanced of hex8 x 3 laws
}

/// Number in -1..1 that only depends on its arguments.
inline double volume_noise(Eigen::Index i, Eigen::Index j, int seed = 0) {
  const double x = std::sin(12.9898 * static_cast<double>(i + 1) +
                            78.233 * static_cast<double>(j + 1) + 37.719 * seed) *
                   43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

/// Position at xi of the cell with the same corners, linear between them.
inline Vec3 between_corners(cell::CellType type, const Coordinates3& x, const Vec3& xi) {
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

/// A cell of size about 1. Corners are displaced by `distortion`; nodes on edges and faces stay in
/// the middle unless `curved`.
inline Coordinates3 sample_volume(cell::CellType type, double distortion, bool curved) {
  const cell::CellInfo& info = cell::info(type);
  Coordinates3 x(info.nodes, 3);
  for (int k = 0; k < info.nodes; ++k) {
    const Vec3 xi = cell::volume_node(type, k);
    const double across = info.corners == 6 ? 0.5 : 1;  // wedges are two high
    x.row(k) =
        (info.corners == 8 ? 0.5 : 1.0) * Vec3(xi.x(), xi.y(), across * xi.z()) + Vec3(3, 0.4, -1);
    for (Eigen::Index i = 0; i < 3; ++i) x(k, i) += distortion * volume_noise(k, i);
  }
  if (curved) return x;
  const Coordinates3 corners = x;
  for (int k = 0; k < info.nodes; ++k)
    x.row(k) = between_corners(type, corners, cell::volume_node(type, k));
  return x;
}

inline Coordinates3 sample_motion(cell::CellType type, double size, int seed = 1) {
  Coordinates3 u(cell::info(type).nodes, 3);
  for (Eigen::Index k = 0; k < u.rows(); ++k)
    for (Eigen::Index i = 0; i < 3; ++i) u(k, i) = size * volume_noise(k, i, seed);
  return u;
}

inline Eigen::VectorXd flat(const Coordinates3& u) {
  Eigen::VectorXd v(3 * u.rows());
  for (Eigen::Index k = 0; k < u.rows(); ++k) v.segment<3>(3 * k) = u.row(k);
  return v;
}
inline Coordinates3 unflat3(const Eigen::VectorXd& v) {
  Coordinates3 u(v.size() / 3, 3);
  for (Eigen::Index k = 0; k < u.rows(); ++k) u.row(k) = v.segment<3>(3 * k);
  return u;
}

inline VolumeResult evaluated(const VolumeCase& c, const Coordinates3& x, const Coordinates3& u) {
  VolumeResult r;
  evaluate(c.section, c.type, x, u, true, r);
  EXPECT_EQ(r.status, Status::ok);
  return r;
}

/// Size of the forces of a strain of one: what rounding is relative to.
inline double stiffness_scale(const VolumeCase& c, const Coordinates3& x) {
  return evaluated(c, x, Coordinates3::Zero(x.rows(), 3)).tangent.norm();
}

inline Mat<3, 3> turn3(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}

inline Mat<3, 3> tensor(const Vec<6>& s) {
  Mat<3, 3> t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

inline Coordinates3 face_of(const cell::CellFace& face, const Coordinates3& x) {
  Coordinates3 nodes(cell::info(face.type).nodes, 3);
  for (Eigen::Index k = 0; k < nodes.rows(); ++k)
    nodes.row(k) = x.row(face.nodes[static_cast<std::size_t>(k)]);
  return nodes;
}

}  // namespace osculate::solid::testing
