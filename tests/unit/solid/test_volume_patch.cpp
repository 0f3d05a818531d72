#include "volume_cases.hpp"

// Patch tests: under a linear displacement the stress is constant, and the nodal forces are those
// of the constant traction on the faces, none inside. A patch of cells then is in equilibrium
// whatever its mesh.

namespace osculate::solid::testing {
namespace {

/// f_k = int N_k P n dA over the undeformed boundary. The quadrature of the faces is exact for the
/// normal times the area element, so that faces may be warped.
VolumeVector boundary_forces(const VolumeCase& c, const Coordinates3& x, const Mat<3, 3>& stress) {
  const cell::CellInfo& info = cell::info(c.type);
  const VolumeSection reference{Kinematics::small, VolumeFormulation::full, c.section.law};
  VolumeVector force = VolumeVector::Zero(3 * x.rows());
  for (std::size_t f = 0; f < static_cast<std::size_t>(info.face_count); ++f) {
    const cell::CellFace& face = info.faces[f];
    const Coordinates3 nodes = face_of(face, x);
    const Coordinates3 none = Coordinates3::Zero(nodes.rows(), 3);
    const FaceVector areas = face_pressure(reference, face.type, nodes, none, -1).force;
    for (Eigen::Index k = 0; k < nodes.rows(); ++k)
      force.segment<3>(3 * face.nodes[static_cast<std::size_t>(k)]) +=
          stress * areas.segment<3>(3 * k);
  }
  return force;
}

/// First Piola-Kirchhoff stress of the displacement u = H X, from the law alone.
Mat<3, 3> exact_stress(const VolumeCase& c, const Mat<3, 3>& h) {
  Mat<3, 3> e = 0.5 * (h + h.transpose());
  if (c.finite()) e += 0.5 * h.transpose() * h;
  material::Strain3 strain;
  strain << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(0, 2);
  const Mat<3, 3> s = tensor(material::response(c.section.law, strain).stress);
  return c.finite() ? Mat<3, 3>((Mat<3, 3>::Identity() + h) * s) : s;
}

Mat<3, 3> gradient() {
  Mat<3, 3> h;
  h << 0.3, -0.2, 0.1, 0.5, 0.1, -0.3, 0.2, -0.1, 0.25;
  return h;
}

// The sides of shell18 are listed through their corners only: its forces are compared in total.
TEST(VolumePatch, LinearDisplacementGivesTheForcesOfAConstantStress) {
  for_each_volume([&](const VolumeCase& c) {
    if (c.type == cell::CellType::shell18) return;
    const Coordinates3 x = sample_volume(c.type, 0.1, false);
    for (const double size : {1e-9, 1e-6, 1e-3, 0.1, 0.6}) {
      const Mat<3, 3> h = size * gradient();
      const VolumeVector exact = boundary_forces(c, x, exact_stress(c, h));
      const VolumeVector found = evaluated(c, x, x * h.transpose()).force;
      EXPECT_LT((found - exact).norm(), 2e-14 * size * stiffness_scale(c, x)) << size;
      if (c.type == cell::CellType::hex27) {
        EXPECT_LT(found.tail<3>().norm(), 1e-14 * size * stiffness_scale(c, x)) << size;
      }
    }
  });
}

/// Seven cells: a distorted one inside a unit cube, MacNeal and Harder's places of its corners.
struct CubePatch {
  std::array<Vec3, 16> nodes;
  std::vector<std::array<int, 8>> cells;
  CubePatch() {
    for (int k = 0; k < 8; ++k)
      nodes[static_cast<std::size_t>(k)] =
          0.5 * (cell::volume_node(cell::CellType::hex8, k) + Vec3::Ones());
    nodes[8] = {0.249, 0.342, 0.192};
    nodes[9] = {0.826, 0.288, 0.288};
    nodes[10] = {0.850, 0.649, 0.263};
    nodes[11] = {0.273, 0.750, 0.230};
    nodes[12] = {0.320, 0.186, 0.643};
    nodes[13] = {0.677, 0.305, 0.683};
    nodes[14] = {0.788, 0.693, 0.644};
    nodes[15] = {0.165, 0.745, 0.702};
    cells.push_back({8, 9, 10, 11, 12, 13, 14, 15});
    const cell::CellInfo& info = cell::info(cell::CellType::hex8);
    for (std::size_t f = 0; f < 6; ++f) {
      std::array<int, 8> c{};  // from the outer face inwards
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t from = 3 - k;  // walked so that the inner face lies above
        c[k] = info.faces[f].nodes[from];
        c[k + 4] = c[k] + 8;
      }
      cells.push_back(c);
    }
  }
};

TEST(VolumePatch, SevenHexahedraOfMacNealAndHarder) {
  const CubePatch patch;
  Mat<3, 3> h;
  h << 1e-3, 0.5e-3, 0.5e-3, 0.5e-3, 1e-3, 0.5e-3, 0.5e-3, 0.5e-3, 1e-3;
  for_each_volume([&](const VolumeCase& c) {
    if (c.type != cell::CellType::hex8) return;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(48);
    double volume = 0;
    for (const auto& nodes : patch.cells) {
      Coordinates3 at(8, 3);
      for (std::size_t k = 0; k < 8; ++k)
        at.row(static_cast<Eigen::Index>(k)) = patch.nodes[static_cast<std::size_t>(nodes[k])];
      const CellStress3 points = stress_at_points(c.section, c.type, at, Coordinates3::Zero(8, 3));
      for (std::size_t q = 0; q < 8; ++q) EXPECT_GT(points.point[q].volume, 0);
      volume += volume_weights(c.type, at).sum();
      const VolumeVector f = evaluated(c, at, at * h.transpose()).force;
      for (std::size_t k = 0; k < 8; ++k)
        force.segment<3>(3 * nodes[k]) += f.segment<3>(3 * static_cast<Eigen::Index>(k));
    }
    EXPECT_NEAR(volume, 1, 4e-15);
    EXPECT_LT(force.tail<24>().norm(), 1e-14 * force.head<24>().norm());
  });
}

// Two curved neighbours share one displacement: the middle nodes of the face between them are in
// equilibrium for shell18 as well, above and below each other.
TEST(VolumePatch, ShellHasTheResultantsOfAConstantStress) {
  for_each_volume([&](const VolumeCase& c) {
    if (c.type != cell::CellType::shell18) return;
    const Coordinates3 x = sample_volume(c.type, 0.1, false);
    const Mat<3, 3> h = 0.1 * gradient(), stress = exact_stress(c, h);
    const VolumeVector f = evaluated(c, x, x * h.transpose()).force;
    Mat<3, 3> virial = Mat<3, 3>::Zero();  // int P dV
    for (Eigen::Index k = 0; k < 18; ++k) virial += f.segment<3>(3 * k) * x.row(k);
    const double volume = volume_weights(c.type, x).sum();
    EXPECT_LT((virial - volume * stress).norm(), 1e-13 * volume * stress.norm());
  });
}

}  // namespace
}  // namespace osculate::solid::testing
