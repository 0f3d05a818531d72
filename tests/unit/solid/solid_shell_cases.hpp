#pragma once
// Every law on both solid-shell cells, for conformance tests.
#include "osculate/solid/solid_shell.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {

template <class Visit>
void for_each_shell(const Visit& visit) {
  int visited = 0;
  for (const cell::CellType type : {cell::CellType::hex8, cell::CellType::shell18})
    material::for_each_law([&](auto law) {
      law.young = 7;
      law.poisson = 0.3;
      const bool finite = material::finite_strain(law);
      const VolumeCase c{
          {finite ? Kinematics::finite : Kinematics::small, VolumeFormulation::solid_shell, law},
          type};
      const ::testing::ScopedTrace trace(__FILE__, __LINE__, c.name());
      EXPECT_EQ(unsupported(c.section, type), "");
      ++visited;
      visit(c);
    });
  EXPECT_EQ(visited, 6);
}

/// A cell of length 1 and the given thickness. `distortion` moves nodes in all directions, up to
/// that share of the cell's size along each axis.
inline Coordinates3 sample_shell(cell::CellType type, double thickness, double distortion) {
  Coordinates3 x(cell::info(type).nodes, 3);
  for (int k = 0; k < x.rows(); ++k) {
    const Vec3 at = 0.5 * cell::volume_node(type, k);
    for (int i = 0; i < 3; ++i) x(k, i) = at[i] + distortion * volume_noise(k, i);
    x(k, 2) *= thickness;
  }
  return x;
}

}  // namespace osculate::solid::testing
