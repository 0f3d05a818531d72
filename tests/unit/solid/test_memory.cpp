// What material points remember, in every cell and formulation.
#include "cell_cases.hpp"
#include "derivative_check.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::solid::testing {
namespace {

class RememberingCell : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, RememberingCell,
                         ::testing::Values(Kind::plane, Kind::space, Kind::shell), kind_name);

/// A cell whose points yield, and what they remember.
struct Yielding {
  CellCase c;
  std::size_t size = 0, points = 0;
  std::vector<double> now;

  CellResult at(const Eigen::MatrixXd& x, const Eigen::MatrixXd& u, std::vector<double>& next,
                bool with_tangent = true) const {
    next.assign(now.size(), std::nan(""));
    const CellResult r = answer(c, x, u, with_tangent, {now.data(), next.data(), size});
    EXPECT_EQ(r.status, Status::ok);
    return r;
  }
  void commit(const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
    std::vector<double> next;
    (void)at(x, u, next);
    now = next;
  }
  /// Which points flow on the way to `next`.
  [[nodiscard]] std::vector<bool> flows(const std::vector<double>& next) const {
    std::vector<bool> out;
    for (std::size_t q = 0; q < points; ++q) out.push_back(next[q * size] > now[q * size]);
    return out;
  }
};

std::size_t count_of(const CellCase& c) {
  return std::visit([&](const auto& of) { return point_count(of.section, of.type); }, c.of);
}

/// All cells with laws that remember, made to yield.
void for_each_yielding(Kind kind, const std::function<void(Yielding&)>& visit) {
  int visited = 0;
  for_each_cell(kind, [&](CellCase c) {
    std::size_t size = 0;
    const auto yields = [&](auto& law) {
      if constexpr (requires { constants(law).kinematic; }) {
        constants(law).yield = 0.1;
        constants(law).isotropic = 0.5;
        constants(law).kinematic = 0.3;
        size = remembered_by(constants(law)).size();
      }
    };
    std::visit([&](auto& of) { std::visit(yields, of.section.law); }, c.of);
    if (size == 0) return;
    Yielding y{c, size, count_of(c), {}};
    y.now.assign(y.size * y.points, 0.0);
    ++visited;
    visit(y);
  });
  EXPECT_EQ(visited, kind == Kind::plane ? 64 : kind == Kind::space ? 36 : 4);
}

void expect_consistent(const Yielding& y, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
  std::vector<double> next;
  const Eigen::VectorXd along = flat(motion(y.c, y.c.kind == Kind::shell ? 0.06 : 0.3, 5));
  const CellResult here = y.at(x, u, next);
  const std::vector<bool> flows = y.flows(next);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    const CellResult r = y.at(x, unflat(v, y.c.dim()), next, false);
    EXPECT_EQ(y.flows(next), flows);  // both probes are in the same branch
    return r.force;
  };
  const auto r =
      osculate::testing::check_derivative(force, here.tangent * along, flat(u), along, 1e-4);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
  EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-13 * here.tangent.norm());
}

TEST_P(RememberingCell, TangentIsTheDerivativeOfTheForceWhileItFlows) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c);
    y.commit(x, u);
    const Eigen::MatrixXd on = 2 * u;
    std::vector<double> next;
    (void)y.at(x, on, next);
    const std::vector<bool> flows = y.flows(next);
    EXPECT_TRUE(std::ranges::any_of(flows, [](bool of) { return of; }));
    expect_consistent(y, x, on);
  });
}

TEST_P(RememberingCell, TangentIsTheDerivativeOfTheForceWhenUnloaded) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c);
    y.commit(x, u);
    const Eigen::MatrixXd back = 0.98 * u;
    std::vector<double> next;
    (void)y.at(x, back, next);
    EXPECT_EQ(next, y.now);  // elastic: nothing new to remember
    expect_consistent(y, x, back);
  });
}

TEST_P(RememberingCell, EvaluationChangesNothingThatIsCommitted) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c);
    std::vector<double> first, far, again;
    const CellResult here = y.at(x, u, first);
    (void)y.at(x, 2 * u, far);
    EXPECT_NE(first, far);
    EXPECT_EQ(y.now, std::vector<double>(y.now.size(), 0.0));
    EXPECT_EQ(y.at(x, u, again).force, here.force);
    EXPECT_EQ(again, first);
    EXPECT_EQ(y.at(x, u, again, false).force, here.force);  // forces alone
    EXPECT_EQ(again, first);
  });
}

// Fields and energies are evaluated after the commit: the same forces, and nothing flows again.
TEST_P(RememberingCell, CommittedStateIsItsOwnAnswer) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c);
    std::vector<double> next;
    const CellResult before = y.at(x, u, next);
    const CellValues flowing = point_values(y.c, x, u, {y.now.data(), nullptr, y.size});
    y.now = next;
    const CellResult after = y.at(x, u, next);
    EXPECT_LT((after.force - before.force).norm(), 1e-11 * before.force.norm());
    const CellValues kept = point_values(y.c, x, u, {y.now.data(), nullptr, y.size});
    for (std::size_t q = 0; q < y.points; ++q)
      EXPECT_LT((kept.at[q].stress - flowing.at[q].stress).norm(), 1e-11);
  });
}

TEST_P(RememberingCell, ForceIsTheDerivativeOfTheStoredEnergyWhenUnloaded) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c);
    y.commit(x, u);
    std::vector<double> next;
    const Eigen::MatrixXd back = 0.98 * u;
    const double work = y.at(x, back, next).force.dot(flat(motion(y.c, 0.02, 5)));
    const auto stored = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      const Eigen::MatrixXd at = unflat(v, y.c.dim());
      const CellEnergy e = std::visit(
          [&](const auto& of) {
            return cell_energy(of.section, of.type, x, at, {y.now.data(), nullptr, y.size});
          },
          y.c.of);
      EXPECT_GT(e.dissipated, 0);
      return Eigen::VectorXd::Constant(1, e.stored);
    };
    const auto r = osculate::testing::check_derivative(
        stored, Eigen::VectorXd::Constant(1, work), flat(back), flat(motion(y.c, 0.02, 5)), 1e-2);
    EXPECT_TRUE(r.order > 1.9 || r.error < 1e-8) << r.order << " " << r.error;
  });
}

// A rotation of the whole turns the forces and changes nothing that is remembered.
TEST_P(RememberingCell, RotationTurnsTheForces) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    if (!y.c.finite() || y.c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(y.c), u = motion(y.c), turn = rotation(y.c, 2.5);
    const Eigen::MatrixXd turned = (x + u) * turn.transpose() - x;
    std::vector<double> plain, moved;
    const CellResult a = y.at(x, u, plain), b = y.at(x, turned, moved);
    const Eigen::VectorXd expected = flat(unflat(a.force, y.c.dim()) * turn.transpose());
    EXPECT_LT((b.force - expected).norm(), 1e-11 * a.force.norm());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(plain[i], moved[i], 1e-12);
  });
}

TEST_P(RememberingCell, ValuesOfPointsGoToTheNodesAsALinearField) {
  for_each_yielding(GetParam(), [](Yielding& y) {
    const Eigen::MatrixXd x = regular(y.c), u = 0 * x;
    const auto field = [](const Eigen::VectorXd& at) {
      return Eigen::RowVector2d(3, 1 + 2 * at[0] - at[1]);
    };
    const CellValues points = point_values(y.c, x, u);
    Eigen::MatrixXd values(static_cast<Eigen::Index>(y.points), 2);
    for (std::size_t q = 0; q < y.points; ++q)
      values.row(static_cast<Eigen::Index>(q)) = field(points.at[q].position);
    const Eigen::MatrixXd nodal =
        std::visit([&](const auto& of) { return at_nodes(of.section, of.type, values); }, y.c.of);
    ASSERT_EQ(nodal.rows(), x.rows());
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      const Eigen::RowVector2d exact = field(x.row(k).transpose());
      EXPECT_NEAR(nodal(k, 0), 3, 1e-12);
      EXPECT_TRUE(y.points <= 2 || std::abs(nodal(k, 1) - exact[1]) < 1e-11) << nodal(k, 1);
    }
  });
}

}  // namespace
}  // namespace osculate::solid::testing
