#pragma once
// Every section in space, on every volume cell, for conformance tests.
#include <Eigen/Geometry>

#include "osculate/solid/element.hpp"
#include "section_cases.hpp"

namespace osculate::solid::testing {

constexpr std::array<cell::CellType, 8> volume_types{
    cell::CellType::tet4, cell::CellType::tet10, cell::CellType::wedge6, cell::CellType::wedge15,
    cell::CellType::hex8, cell::CellType::hex20, cell::CellType::hex27,  cell::CellType::shell18};

struct VolumeCase {
  using Places = Coordinates<3>;
  using Result = ElementResult<3>;
  Section<3> section;
  cell::CellType type;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool finite() const { return section.kinematics == Kinematics::finite; }
};

/// Visits all supported combinations of cell, kinematics, displacement formulation and law.
void for_each_volume(const std::function<void(const VolumeCase&)>& visit);

/// Visits every law on both solid-shell cells.
void for_each_shell(const std::function<void(const VolumeCase&)>& visit);

/// A cell of size about 1. Corners are displaced by `distortion`; nodes on edges and faces stay in
/// the middle unless `curved`.
Coordinates<3> sample_volume(cell::CellType type, double distortion, bool curved);

/// A cell of length 1 and the given thickness. `distortion` moves nodes in all directions, up to
/// that share of the cell's size along each axis.
Coordinates<3> sample_shell(cell::CellType type, double thickness, double distortion);

Coordinates<3> sample_motion(cell::CellType type, double size, int seed = 1);

Mat<3, 3> turn3(double angle);

Mat<3, 3> tensor(const Vec<6>& s);

Coordinates<3> face_of(const cell::CellFace& face, const Coordinates<3>& x);

}  // namespace osculate::solid::testing
