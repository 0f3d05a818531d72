#include "derivative_check.hpp"
#include "osculate/cell/shape.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

using enum cell::CellType;
constexpr std::array<cell::CellType, 5> face_types{tri3, tri6, quad4, quad8, quad9};

VolumeSection with(Kinematics k) {
  return {k, VolumeFormulation::full, material::NeoHooke{7, 0.3, 0}};
}

/// A face in space, bent unless flat.
Coordinates3 sample_face(cell::CellType type, bool bent) {
  Coordinates3 x(cell::info(type).nodes, 3);
  const Mat<3, 3> q = turn3(0.8);
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 xi = cell::area_node(type, k);
    const double out = bent ? 0.2 * xi.x() * xi.x() - 0.3 * xi.x() * xi.y() + 0.1 * xi.y() : 0;
    x.row(k) = q * Vec3(1.2 * xi.x() + 0.3 * xi.y(), 0.8 * xi.y(), out) + Vec3(1, 2, 3);
  }
  return x;
}

TEST(VolumeLoads, VolumeWeightsSumToTheVolume) {
  for (const cell::CellType type : volume_types) {
    if (type == shell18) continue;
    // the rules of tet10 and wedge15 are exact for straight edges only
    const Coordinates3 x = sample_volume(type, 0.08, type != tet10 && type != wedge15);
    // Gauss: the volume is the flux of x/3 through the faces
    double volume = 0;
    const cell::CellInfo& info = cell::info(type);
    for (std::size_t f = 0; f < static_cast<std::size_t>(info.face_count); ++f) {
      const Coordinates3 face = face_of(info.faces[f], x), none = face * 0;
      const FaceVector areas =
          face_pressure(with(Kinematics::small), info.faces[f].type, face, none, -1).force;
      for (Eigen::Index k = 0; k < face.rows(); ++k)
        volume += face.row(k).dot(areas.segment<3>(3 * k)) / 3;
    }
    const double found = volume_weights(type, x).sum();
    EXPECT_NEAR(found, volume, 1e-14 * volume) << info.name;
    const Coordinates3 straight = sample_volume(type, 0, false);
    const double size = info.corners == 4 ? 1.0 / 6 : info.corners == 6 ? 0.5 : 1.0;
    EXPECT_NEAR(volume_weights(type, straight).sum(), size, 4e-15) << info.name;
  }
}

TEST(VolumeLoads, FaceWeightsSumToTheArea) {
  for (const cell::CellType type : face_types) {
    const Coordinates3 x = sample_face(type, false);
    const double area = 1.2 * 0.8 * (cell::info(type).corners == 3 ? 0.5 : 4.0);
    const FaceVector w = face_weights(type, x);
    EXPECT_NEAR(w.sum(), area, 2e-15 * area) << cell::info(type).name;
    if (type == tri6) {  // all of it on the middles of the edges
      EXPECT_LT(w.head<3>().norm(), 1e-15);
      EXPECT_LT((w.tail<3>() - Vec3::Constant(area / 3)).norm(), 1e-15);
    }
    if (type == quad9) {
      EXPECT_NEAR(w[8], 4.0 / 9 * area, 1e-15 * area);
    }
  }
}

TEST(VolumeLoads, PressurePushesIntoTheBody) {
  for (const cell::CellType type : {tet4, tet10, wedge6, hex8, hex27}) {
    const Coordinates3 x = sample_volume(type, 0, false);
    const cell::CellInfo& info = cell::info(type);
    const Vec3 middle = x.colwise().mean();
    for (std::size_t f = 0; f < static_cast<std::size_t>(info.face_count); ++f) {
      const Coordinates3 face = face_of(info.faces[f], x);
      const FacePressure r = face_pressure(with(Kinematics::small), info.faces[f].type, face,
                                           Coordinates3::Zero(face.rows(), 3), 5);
      Vec3 sum = Vec3::Zero();
      for (Eigen::Index k = 0; k < face.rows(); ++k) sum += r.force.segment<3>(3 * k);
      EXPECT_LT(sum.dot(Vec3(face.colwise().mean()) - middle), 0) << info.name << f;
      EXPECT_NEAR(sum.norm(), 5 * face_weights(info.faces[f].type, face).sum(), 1e-14);
      EXPECT_EQ(r.tangent.norm(), 0.0);
    }
  }
}

TEST(VolumeLoads, TangentOfPressureIsTheDerivative) {
  for (const cell::CellType type : face_types)
    for (const Kinematics k : {Kinematics::small, Kinematics::finite}) {
      const Coordinates3 x = sample_face(type, true);
      const Coordinates3 u = sample_motion(type, 0.1, 3), d = sample_motion(type, 1, 4);
      const VolumeSection s = with(k);
      const FacePressure r = face_pressure(s, type, x, u, 2.5);
      if (k == Kinematics::small) {
        EXPECT_EQ(r.tangent.norm(), 0.0);
        EXPECT_EQ(r.force, face_pressure(s, type, x, Coordinates3(x * 0), 2.5).force);
        continue;
      }
      const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return face_pressure(s, type, x, unflat(v, 3), 2.5).force;
      };
      const auto report =
          osculate::testing::check_derivative(force, r.tangent * flat(d), flat(u), flat(d));
      // quadratic in the displacements: central differences are exact
      EXPECT_TRUE(report.exact) << report.error << " order " << report.order;
    }
}

// A pressure all around a body has no resultant and no moment, however it is deformed.
TEST(VolumeLoads, PressureAllAroundBalances) {
  for (const cell::CellType type : volume_types) {
    if (type == shell18) continue;
    const Coordinates3 x = sample_volume(type, 0.08, true), u = sample_motion(type, 0.06);
    const cell::CellInfo& info = cell::info(type);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t f = 0; f < static_cast<std::size_t>(info.face_count); ++f) {
      const Coordinates3 face = face_of(info.faces[f], x), moved = face_of(info.faces[f], u);
      const FaceVector force =
          face_pressure(with(Kinematics::finite), info.faces[f].type, face, moved, 3).force;
      for (Eigen::Index k = 0; k < face.rows(); ++k) {
        const Vec3 p = (face + moved).row(k), g = force.segment<3>(3 * k);
        sum += g;
        moment += p.cross(g);
      }
    }
    EXPECT_LT(sum.norm(), 1e-14) << info.name;
    EXPECT_LT(moment.norm(), 1e-13) << info.name;
  }
}

TEST(VolumeJacobian, FindsTheWorstPlace) {
  Coordinates3 x = sample_volume(hex8, 0, false);
  EXPECT_NEAR(smallest_jacobian(hex8, x), 0.125, 1e-15);
  x.row(6) = 0.75 * x.row(0) + 0.25 * x.row(6);  // a corner pushed beyond its neighbours' plane
  EXPECT_LT(smallest_jacobian(hex8, x), 0);
  x = sample_volume(hex8, 0, false);
  for (Eigen::Index k = 0; k < 4; ++k) x.row(k).swap(x.row(k + 4));  // top and bottom exchanged
  EXPECT_NEAR(smallest_jacobian(hex8, x), -0.125, 1e-15);
  Coordinates3 q = sample_volume(hex20, 0, false);
  EXPECT_NEAR(smallest_jacobian(hex20, q), 0.125, 1e-14);
  q(8, 2) += 1.1;  // the middle of an edge pushed in so far that only there the cell overlaps
  EXPECT_LT(smallest_jacobian(hex20, q), 0);
}

}  // namespace
}  // namespace osculate::solid::testing
