// What solid shells do beside what every cell does (test_derivatives.cpp).
#include <Eigen/Eigenvalues>
#include <limits>

#include "osculate/solid/solid_shell.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

constexpr double thickness = 0.2;

TEST(SolidShell, ForcesAndMomentsBalance) {
  for_each_shell([](const VolumeCase& c) {
    const Coordinates<3> x = sample_shell(c.type, thickness, 0.06);
    const Coordinates<3> u = sample_motion(c.type, 0.1 * thickness);
    const Coordinates<3> force = unflat(evaluated(c, x, u).force, 3);
    const Coordinates<3> arm = c.finite() ? Coordinates<3>(x + u) : x;
    Vec3 moment = Vec3::Zero();
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      moment += Vec3(arm.row(k)).cross(Vec3(force.row(k)));
    EXPECT_LT(force.colwise().sum().norm(), 1e-14 * force.norm());
    EXPECT_LT(moment.norm(), 1e-14 * force.norm());
  });
}

TEST(SolidShell, ForceTurnsWithTheBody) {
  for_each_shell([](const VolumeCase& c) {
    const Coordinates<3> x = sample_shell(c.type, thickness, 0.06);
    const Coordinates<3> u = sample_motion(c.type, 0.1 * thickness);
    const ElementResult<3> before = evaluated(c, x, u);
    const Mat<3, 3> turn = turn3(2.8);
    Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(3 * x.rows(), 3 * x.rows());
    for (Eigen::Index k = 0; k < x.rows(); ++k) turns.block<3, 3>(3 * k, 3 * k) = turn;
    const auto expect_turned = [&](const ElementResult<3>& after) {
      EXPECT_LT((after.force - turns * before.force).norm(), 1e-12 * before.force.norm());
      EXPECT_LT((after.tangent - turns * before.tangent * turns.transpose()).norm(),
                1e-13 * before.tangent.norm());
    };
    expect_turned(evaluated(c, x * turn.transpose(), u * turn.transpose()));
    if (!c.finite()) return;
    const Coordinates<3> moved = (x + u) * turn.transpose() - x;
    expect_turned(evaluated(c, x, moved.rowwise() + Vec3(3, -2, 5).transpose()));
    const Coordinates<3> rigid = x * turn.transpose() - x;
    EXPECT_LT(evaluated(c, x, rigid).force.norm(), 1e-14 * before.tangent.norm());
  });
}

/// The cell's nodes in the order seen after the reference axes were mapped to `axes` (columns).
std::vector<Eigen::Index> renumbered(cell::CellType type, const Mat<3, 3>& axes) {
  const int nodes = cell::info(type).nodes;
  std::vector<Eigen::Index> order;
  for (int k = 0; k < nodes; ++k)
    for (int l = 0; l < nodes; ++l)
      if ((axes * cell::volume_node(type, k) - cell::volume_node(type, l)).norm() < 1e-9)
        order.push_back(l);
  return order;
}

// Eight turns keep the thickness direction: four about it, and those after turning the cell over.
TEST(SolidShell, AnyNumberingWithTheSameThicknessDirectionGivesTheSame) {
  Mat<3, 3> quarter, over;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  over << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  for_each_shell([&](const VolumeCase& c) {
    const Coordinates<3> x = sample_shell(c.type, thickness, 0.06);
    const Coordinates<3> u = sample_motion(c.type, 0.1 * thickness);
    const ElementResult<3> one = evaluated(c, x, u);
    Mat<3, 3> axes = Mat<3, 3>::Identity();
    for (int turn = 0; turn < 8; ++turn) {
      const std::vector<Eigen::Index> order = renumbered(c.type, axes);
      ASSERT_EQ(order.size(), static_cast<std::size_t>(x.rows()));
      const ElementResult<3> other = evaluated(c, x(order, Eigen::all), u(order, Eigen::all));
      for (std::size_t k = 0; k < order.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        EXPECT_LT((other.force.segment<3>(3 * at) - one.force.segment<3>(3 * order[k])).norm(),
                  1e-14 * one.tangent.norm() * u.norm());
      }
      axes = (turn == 3 ? over : quarter) * axes;
    }
  });
}

// No mode without energy but the six rigid motions, thick or thin, regular or distorted.
TEST(SolidShell, HasNoZeroEnergyModesButRigidMotions) {
  for_each_shell([](const VolumeCase& c) {
    for (const double height : {1.0, 0.1})
      for (const double distortion : {0.0, 0.06}) {
        const Coordinates<3> x = sample_shell(c.type, height, distortion);
        const Eigen::MatrixXd k = evaluated(c, x, Coordinates<3>::Zero(x.rows(), 3)).tangent;
        const Eigen::VectorXd values =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
        const double largest = values[values.size() - 1];
        for (int i = 0; i < values.size(); ++i) {
          EXPECT_TRUE(i < 6 ? std::abs(values[i]) < 1e-14 * largest
                            : values[i] > 1e-3 * height * height * height * largest)
              << height << " " << distortion << " " << i << ": " << values[i] / largest;
        }
      }
  });
}

TEST(SolidShell, MirroredFlatAndInvertedCellsAreRefused) {
  for_each_shell([](const VolumeCase& c) {
    const Coordinates<3> x = sample_shell(c.type, thickness, 0.06);
    const Coordinates<3> none = Coordinates<3>::Zero(x.rows(), 3);
    const auto status = [&](const Coordinates<3>& at, const Coordinates<3>& u) {
      ElementResult<3> r;
      evaluate(c.section, c.type, at, u, true, r);
      return r.status;
    };
    Coordinates<3> mirrored = x, flattened = x, wrong = none;
    mirrored.col(2) *= -1;
    flattened.col(2).setZero();
    EXPECT_EQ(status(mirrored, none), Status::inverted);
    EXPECT_EQ(status(flattened, none), Status::inverted);
    wrong.setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_NE(status(x, wrong), Status::ok);
    if (c.finite()) {
      EXPECT_EQ(status(x, mirrored - x), Status::inverted);
    }
  });
}

}  // namespace
}  // namespace osculate::solid::testing
