#pragma once
// Every law on both solid-shell cells, for conformance tests.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "osculate/solid/solid_shell.hpp"
#include "section_cases.hpp"

namespace osculate::solid::testing {

struct ShellCase {
  VolumeSection section;
  cell::CellType type;
  [[nodiscard]] bool finite() const { return section.kinematics == Kinematics::finite; }
};

template <class Visit>
void for_each_shell(const Visit& visit) {
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    material::for_each_law([&](auto law) {
      law.young = 7;
      law.poisson = 0.3;
      const bool finite = material::finite_strain(law);
      const ShellCase c{
          {finite ? Kinematics::finite : Kinematics::small, VolumeFormulation::solid_shell, law},
          type};
      const ::testing::ScopedTrace trace(
          __FILE__, __LINE__,
          std::string(cell::info(type).name) + " " + std::string(material::key_of(c.section.law)));
      visit(c);
    });
}

/// A cell of length 1 and the given thickness. `distortion` moves nodes in all directions, up to
/// that share of the cell's size along each axis.
inline Coordinates3 sample_shell(cell::CellType type, double thickness, double distortion) {
  Coordinates3 x(cell::info(type).nodes, 3);
  for (int k = 0; k < x.rows(); ++k) {
    const Vec3 at = 0.5 * cell::volume_node(type, k);
    for (int i = 0; i < 3; ++i) x(k, i) = at[i] + distortion * noise(k, i);
    x(k, 2) *= thickness;
  }
  return x;
}

inline Coordinates3 sample_shell_displacement(cell::CellType type, double size, int seed = 1) {
  Coordinates3 u(cell::info(type).nodes, 3);
  for (int k = 0; k < u.rows(); ++k)
    for (int i = 0; i < 3; ++i) u(k, i) = size * noise(k, i, seed);
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

inline VolumeResult evaluated(const ShellCase& c, const Coordinates3& x, const Coordinates3& u) {
  VolumeResult r;
  evaluate_solid_shell(c.section, c.type, x, u, true, r);
  EXPECT_EQ(r.status, Status::ok);
  return r;
}

inline Mat<3, 3> sample_turn(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(0.3, -0.7, 0.5).normalized()).toRotationMatrix();
}

}  // namespace osculate::solid::testing
