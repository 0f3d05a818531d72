// What stresses do to the stiffness of small strains, in every cell and formulation.
#include "cell_cases.hpp"
#include "derivative_check.hpp"
#include "osculate/solid/reduced.hpp"
#include "osculate/solid/stress_stiffness.hpp"

namespace osculate::solid::testing {
namespace {

class StressedCell : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, StressedCell, ::testing::Values(Kind::plane, Kind::space, Kind::shell),
                         kind_name);

/// Of the stresses of small strain at displacements.
Eigen::MatrixXd stressed(const CellCase& c, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
  return std::visit(
      [&](const auto& of) {
        const auto stress = stress_at_points(of.section, of.type, x, u);
        EXPECT_EQ(stress.status, Status::ok);
        return Eigen::MatrixXd(stress_stiffness(of.section, of.type, x, stress));
      },
      c.of);
}

/// Its stress is linear in the strain of finite kinematics.
bool is_hookes(const CellCase& c) {
  return std::visit(
      [](const auto& of) {
        return std::visit(
            [](const auto& law) {
              return std::is_same_v<std::decay_t<decltype(law)>, material::StVenantKirchhoff>;
            },
            static_cast<const material::Law::variant&>(of.section.law));
      },
      c.of);
}

/// Random displacements; of one point, which has another stiffness against its other modes,
/// linear ones.
Eigen::MatrixXd field(const CellCase& c, const Eigen::MatrixXd& x, int seed) {
  const bool corners = c.type() == cell::CellType::quad4 || c.type() == cell::CellType::hex8;
  if (!c.reduced() || !corners) return motion(c, 1, seed);
  Eigen::MatrixXd slope(c.dim(), c.dim());
  for (Eigen::Index i = 0; i < c.dim(); ++i)
    for (Eigen::Index j = 0; j < c.dim(); ++j) slope(i, j) = noise(i, j, seed);
  if (c.axisymmetric()) slope(1, 0) = 0;  // the other stiffness is against a change of u_r / R
  return x * slope;
}

// W = E : C : E / 2 , E = e + q / 2 with e linear and q quadratic: the third derivative of W at no
// displacement is e(u) : C q(a, b) + e(a) : C q(u, b) + e(b) : C q(u, a), and each of the three is
// a stress stiffness, of the stresses of u, a and b.
TEST_P(StressedCell, IsWhatTheTangentOfFiniteStrainBeginsWith) {
  int visited = 0;
  for_each_cell(GetParam(), [&](const CellCase& c) {
    if (!c.finite() || !is_hookes(c)) return;
    ++visited;
    const Eigen::MatrixXd x = curved(c);
    const Eigen::MatrixXd u = field(c, x, 2), a = field(c, x, 3), b = field(c, x, 4);
    const CellCase small = c.as_small();
    const double expected = flat(a).dot(stressed(small, x, u) * flat(b)) +
                            flat(u).dot(stressed(small, x, a) * flat(b)) +
                            flat(u).dot(stressed(small, x, b) * flat(a));
    const auto tangent = [&](const Eigen::VectorXd& t) -> Eigen::VectorXd {
      const CellResult at = evaluated(c, x, t[0] * u);
      return Eigen::VectorXd::Constant(1, flat(a).dot(at.tangent * flat(b)));
    };
    const auto r = osculate::testing::check_derivative(
        tangent, Eigen::VectorXd::Constant(1, expected), Eigen::VectorXd::Zero(1).eval(),
        Eigen::VectorXd::Ones(1).eval(), 2e-3);
    EXPECT_TRUE(r.error < 1e-10 || std::abs(r.order - 2) < 0.1)
        << "order " << r.order << " error " << r.error << " expected " << expected;
  });
  EXPECT_GT(visited, 1);
}

// The forces of the stresses turn with the cell: K_G W X = W f for every small rotation W.
TEST_P(StressedCell, TurnsTheForcesOfItsStresses) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.finite() || c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(c), u = 1e-3 * field(c, x, 5);
    const Eigen::MatrixXd k = stressed(c, x, u);
    EXPECT_LT((k - k.transpose()).norm(), 1e-15 * k.norm());
    EXPECT_GT(k.norm(), 0.0);
    const CellResult at = evaluated(c, x, u);
    Eigen::MatrixXd f = unflat(at.force, c.dim());
    if (const auto* const of = std::get_if<VolumeCase>(&c.of);
        of && has_faint_stiffness(of->section, of->type))  // which is of no stress
      f -= faint_stiffness(of->section, of->type, Coordinates<3>(x)) * u;
    for (int axis = c.dim() == 2 ? 2 : 0; axis < 3; ++axis) {
      Mat<3, 3> whole = Mat<3, 3>::Zero();
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      whole(i, j) = -1, whole(j, i) = 1;
      const Eigen::MatrixXd w = whole.topLeftCorner(c.dim(), c.dim());
      EXPECT_LT((k * flat(x * w.transpose()) - flat(f * w.transpose())).norm(),
                1e-12 * k.norm() * x.norm());
    }
  });
}

// Nothing of a motion of the whole, in a ring along its axis; linear in the stresses.
TEST_P(StressedCell, HasNoForcesWhereAllNodesMoveAlike) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.finite()) return;
    const Eigen::MatrixXd x = curved(c), u = 1e-3 * motion(c, 1, 6);
    const Eigen::MatrixXd k = stressed(c, x, u);
    for (Eigen::Index i = c.axisymmetric() ? 1 : 0; i < c.dim(); ++i) {
      Eigen::MatrixXd along = 0 * x;
      along.col(i).setOnes();
      EXPECT_LT((k * flat(along)).norm(), 1e-12 * k.norm()) << i;
    }
    EXPECT_LT((stressed(c, x, 2 * u) - 2 * k).norm(), 1e-12 * k.norm());
  });
}

// A cube under tension s along x: gradients of a linear displacement do the work s h_ix h_ix V.
TEST(StressStiffness, OfAUniformTensionDoesTheWorkOfTheGradients) {
  const Section<3> section{Kinematics::small, Formulation::full,
                           material::LinearElastic{100, 0.3, 0}};
  const Coordinates<3> x = sample_volume(cell::CellType::hex8, 0, false);
  CellStress<3> stress =
      stress_at_points(section, cell::CellType::hex8, x, Coordinates<3>::Zero(8, 3));
  double volume = 0;
  for (int q = 0; q < stress.count; ++q) {
    stress.point[static_cast<std::size_t>(q)].stress << 3, 0, 0, 0, 0, 0;
    volume += stress.point[static_cast<std::size_t>(q)].volume;
  }
  const Eigen::MatrixXd k = stress_stiffness(section, cell::CellType::hex8, x, stress);
  Mat<3, 3> h;
  h << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9;
  const Eigen::VectorXd v = flat(Eigen::MatrixXd(x * h.transpose()));
  EXPECT_NEAR(v.dot(k * v), 3 * h.col(0).squaredNorm() * volume, 1e-13);
}

// Hoop tension s of a ring holds radial displacements: s (u / R)^2 over its volume.
TEST(StressStiffness, OfAHoopTensionHoldsTheRadius) {
  Section<2> section;
  section.assumption = Assumption::axisymmetric;
  section.law = material::LinearElastic{100, 0.3, 0};
  const Coordinates<2> x = sample_cell(cell::CellType::quad8, 0, false);
  CellStress<2> stress =
      stress_at_points(section, cell::CellType::quad8, x, Coordinates<2>::Zero(8, 2));
  double expected = 0;
  for (int q = 0; q < stress.count; ++q) {
    PointStress<2>& p = stress.point[static_cast<std::size_t>(q)];
    p.stress << 0, 0, 5, 0;
    expected += 5 * p.volume / (p.position.x() * p.position.x());
  }
  Eigen::MatrixXd radial = 0 * x;
  radial.col(0).setOnes();
  const Eigen::VectorXd v = flat(radial);
  const Eigen::MatrixXd k = stress_stiffness(section, cell::CellType::quad8, x, stress);
  EXPECT_NEAR(v.dot(k * v), expected, 1e-13 * expected);
}

}  // namespace
}  // namespace osculate::solid::testing
