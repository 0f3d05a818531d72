#include <Eigen/Eigenvalues>
#include <limits>

#include "derivative_check.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

using osculate::testing::check_derivative;

void expect_tangent_is_derivative(const VolumeCase& c, const Coordinates3& x,
                                  const Coordinates3& u) {
  const Eigen::VectorXd along = flat(sample_motion(c.type, 0.3, 5));
  const VolumeResult at = evaluated(c, x, u);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    VolumeResult r;
    evaluate(c.section, c.type, x, unflat3(v), false, r);
    EXPECT_EQ(r.status, Status::ok);
    return r.force;
  };
  const auto r = check_derivative(force, at.tangent * along, flat(u), along);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
      << "order " << r.order << " error " << r.error;
  EXPECT_TRUE(c.finite() || r.exact) << r.error;
}

TEST(Volume, TangentIsTheDerivativeOfTheForce) {
  for_each_volume([](const VolumeCase& c) {
    expect_tangent_is_derivative(c, sample_volume(c.type, 0.08, true), sample_motion(c.type, 0.04));
  });
}

TEST(Volume, TangentIsTheDerivativeOfTheForceWhenNearlyIncompressible) {
  for_each_volume([](VolumeCase c) {
    std::visit([](auto& law) { law.poisson = 0.49; }, c.section.law);
    expect_tangent_is_derivative(c, sample_volume(c.type, 0.08, true), sample_motion(c.type, 0.02));
  });
}

TEST(Volume, TangentIsTheDerivativeOfTheForceAfterALargeRotation) {
  for_each_volume([](const VolumeCase& c) {
    if (!c.finite()) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true);
    const Coordinates3 u = (x + sample_motion(c.type, 0.04)) * turn3(2.5).transpose() - x;
    expect_tangent_is_derivative(c, x, u);
  });
}

TEST(Volume, TangentIsSymmetricAndTheForceDoesNotDependOnIt) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const VolumeResult with = evaluated(c, x, u);
    EXPECT_EQ((with.tangent - with.tangent.transpose()).norm(), 0.0);
    VolumeResult without;
    evaluate(c.section, c.type, x, u, false, without);
    EXPECT_EQ(without.force, with.force);
    EXPECT_EQ(without.tangent.norm(), 0.0);
  });
}

// The limit of finite kinematics at no displacement is small kinematics, formulation by
// formulation: two codes, one stiffness.
TEST(Volume, FiniteKinematicsStartAsSmallOnes) {
  for_each_volume([](const VolumeCase& c) {
    if (!c.finite()) return;
    VolumeCase small = c;
    small.section.kinematics = Kinematics::small;
    small.section.law = material::LinearElastic{7, 0.3, 0};
    const Coordinates3 x = sample_volume(c.type, 0.08, true);
    const Coordinates3 none = Coordinates3::Zero(x.rows(), 3);
    const VolumeResult a = evaluated(c, x, none), b = evaluated(small, x, none);
    EXPECT_LT((a.tangent - b.tangent).norm(), 1e-14 * b.tangent.norm());
    EXPECT_EQ(a.force.norm(), 0.0);
  });
}

// Six rigid motions and no mode of zero energy (hourglass) beside them.
TEST(Volume, HasNoZeroEnergyModesButRigidMotions) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true);
    const Eigen::MatrixXd k = evaluated(c, x, Coordinates3::Zero(x.rows(), 3)).tangent;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    const double largest = values[values.size() - 1];
    for (Eigen::Index i = 0; i < 6; ++i) EXPECT_LT(std::abs(values[i]), 1e-14 * largest) << i;
    EXPECT_GT(values[6], 1e-3 * largest) << values[6] / largest;
  });
}

/// Sum of the forces, and of their moments about the origin.
std::pair<Vec3, Vec3> resultant(const VolumeVector& force, const Coordinates3& places) {
  std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    const Vec3 f = force.segment<3>(3 * k), x = places.row(k);
    sum.first += f;
    sum.second += x.cross(f);
  }
  return sum;
}

TEST(Volume, ForcesBalanceAndTheirMomentsToo) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const Coordinates3 places = c.finite() ? Coordinates3(x + u) : x;
    const auto [force, moment] = resultant(evaluated(c, x, u).force, places);
    const double rounding = 1e-14 * stiffness_scale(c, x);
    EXPECT_LT(force.norm(), rounding);
    EXPECT_LT(moment.norm(), 4 * rounding);
  });
}

TEST(Volume, RigidMotionGivesNoForce) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true);
    Coordinates3 u = x * turn3(2.1).transpose() - x;
    if (!c.finite())  // the linearised rotation
      for (Eigen::Index k = 0; k < x.rows(); ++k)
        u.row(k) = Vec3(0.3, -0.2, 0.5).cross(Vec3(x.row(k)));
    u.rowwise() += Vec3(0.7, -0.4, 0.2).transpose();
    EXPECT_LT(evaluated(c, x, u).force.norm(), 2e-14 * stiffness_scale(c, x));
  });
}

// Frame indifference: a rotation on top of a deformation rotates forces and tangent.
TEST(Volume, ForcesAndTangentTurnWithTheBody) {
  for_each_volume([](const VolumeCase& c) {
    if (!c.finite()) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const Mat<3, 3> q = turn3(-1.2);
    const Coordinates3 turned = (x + u) * q.transpose() - x;
    const VolumeResult a = evaluated(c, x, u), b = evaluated(c, x, turned);
    VolumeMatrix all = VolumeMatrix::Zero(3 * x.rows(), 3 * x.rows());
    for (Eigen::Index k = 0; k < x.rows(); ++k) all.block<3, 3>(3 * k, 3 * k) = q;
    const double scale = stiffness_scale(c, x);
    EXPECT_LT((b.force - all * a.force).norm(), 1e-14 * scale);
    EXPECT_LT((b.tangent - all * a.tangent * all.transpose()).norm(), 1e-13 * scale);
  });
}

// Isotropy: the same body drawn elsewhere and turned has the same, turned, forces. The incompatible
// modes must not prefer directions.
TEST(Volume, ForcesDoNotDependOnTheAxes) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const Mat<3, 3> q = turn3(0.7);
    Coordinates3 moved = x * q.transpose();
    moved.col(0).array() += 5;
    const VolumeResult a = evaluated(c, x, u), b = evaluated(c, moved, u * q.transpose());
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      EXPECT_LT((b.force.segment<3>(3 * k) - q * a.force.segment<3>(3 * k)).norm(),
                4e-14 * stiffness_scale(c, x));
  });
}

// Nor the numbering: the corner that is called first has no privilege.
TEST(Volume, ForcesDoNotDependOnTheFirstCorner) {
  constexpr std::array<Eigen::Index, 8> turned{1, 2, 3, 0, 5, 6, 7, 4},
      tipped{3, 2, 6, 7, 0, 1, 5, 4};
  for_each_volume([&](const VolumeCase& c) {
    if (c.type != cell::CellType::hex8) return;
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const VolumeResult a = evaluated(c, x, u);
    for (const auto& order : {turned, tipped}) {
      Coordinates3 xs(8, 3), us(8, 3);
      for (std::size_t k = 0; k < 8; ++k) {
        xs.row(static_cast<Eigen::Index>(k)) = x.row(order[k]);
        us.row(static_cast<Eigen::Index>(k)) = u.row(order[k]);
      }
      const VolumeResult b = evaluated(c, xs, us);
      for (std::size_t k = 0; k < 8; ++k)
        EXPECT_LT((b.force.segment<3>(3 * static_cast<Eigen::Index>(k)) -
                   a.force.segment<3>(3 * order[k]))
                      .norm(),
                  1e-14 * stiffness_scale(c, x));
    }
  });
}

TEST(Volume, SaysInvertedWhenACellTurnsInsideOut) {
  for_each_volume([](const VolumeCase& c) {
    if (!c.finite()) return;
    const Coordinates3 x = sample_volume(c.type, 0, false);
    Coordinates3 u = Coordinates3::Zero(x.rows(), 3);
    u.col(2) = -2 * x.col(2);
    VolumeResult r;
    evaluate(c.section, c.type, x, u, true, r);
    EXPECT_EQ(r.status, Status::inverted);
    EXPECT_EQ(stress_at_points(c.section, c.type, x, u).status, Status::inverted);
    u(0, 0) = std::numeric_limits<double>::quiet_NaN();
    evaluate(c.section, c.type, x, u, true, r);
    EXPECT_EQ(r.status, Status::inverted);
  });
}

TEST(Volume, UnsupportedNamesTheReason) {
  VolumeSection s;
  s.law = material::LinearElastic{7, 0.3, 0};
  EXPECT_NE(unsupported(s, cell::CellType::quad4), "");
  EXPECT_NE(unsupported(s, cell::CellType::point1), "");
  for (const cell::CellType type : volume_types) EXPECT_EQ(unsupported(s, type), "");
  s.kinematics = Kinematics::finite;
  EXPECT_NE(unsupported(s, cell::CellType::hex8), "");
  s.law = material::NeoHooke{7, 0.3, 0};
  for (const VolumeFormulation f : {VolumeFormulation::bbar, VolumeFormulation::enhanced}) {
    s.formulation = f;
    EXPECT_EQ(unsupported(s, cell::CellType::hex8), "");
    EXPECT_NE(unsupported(s, cell::CellType::hex20), "");
    EXPECT_NE(unsupported(s, cell::CellType::tet4), "");
  }
  s.kinematics = Kinematics::small;
  EXPECT_NE(unsupported(s, cell::CellType::hex8), "");
}

}  // namespace
}  // namespace osculate::solid::testing
