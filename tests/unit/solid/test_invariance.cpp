// What no section may depend on, what it refuses, and what it answers when it cannot.
#include <limits>
#include <span>

#include "cell_cases.hpp"

namespace osculate::solid::testing {
namespace {

class Invariance : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Of, Invariance, ::testing::Values(Kind::plane, Kind::space), kind_name);

TEST_P(Invariance, ForcesBalanceAndTheirMomentsToo) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c), u = motion(c);
    const Eigen::MatrixXd places = c.finite() ? Eigen::MatrixXd(x + u) : x;
    const auto [force, moment] = resultant(evaluated(c, x, u).force, places);
    const double rounding = 1e-14 * stiffness_scale(c, x);
    EXPECT_NEAR(force[1], 0, rounding);
    if (c.axisymmetric()) return;  // the rest of the ring balances the radial forces
    EXPECT_LT(force.norm(), rounding);
    EXPECT_LT(moment.norm(), 4 * rounding);
  });
}

TEST_P(Invariance, TranslationGivesNoForce) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    const Eigen::MatrixXd x = curved(c);
    Eigen::MatrixXd u = 0 * x;
    u.col(1).setConstant(0.7);
    if (!c.axisymmetric()) u.col(0).setConstant(-0.4);
    EXPECT_LT(evaluated(c, x, u).force.norm(), 1e-14 * stiffness_scale(c, x));
  });
}

TEST_P(Invariance, RotationGivesNoForce) {
  Mat<3, 3> spin;  // (0.3, -0.2, 0.5) x, of which the plane has the last
  spin << 0, -0.5, -0.2, 0.5, 0, -0.3, 0.2, 0.3, 0;
  for_each_cell(GetParam(), [&](const CellCase& c) {
    if (c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(c);
    Eigen::MatrixXd u = x * rotation(c, 2.1).transpose() - x;
    if (!c.finite()) u = x * spin.topLeftCorner(c.dim(), c.dim()).transpose();
    const double rounding = 2e-14 * stiffness_scale(c, x);
    EXPECT_LT(evaluated(c, x, u).force.norm(), rounding);
    u.rowwise() += Vec3(0.7, -0.4, 0.2).head(c.dim()).transpose();
    EXPECT_LT(evaluated(c, x, u).force.norm(), rounding);
  });
}

// Frame indifference: a rotation on top of a deformation rotates forces and tangent.
TEST_P(Invariance, ForcesAndTangentTurnWithTheBody) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.axisymmetric() || !c.finite()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c), q = rotation(c, -1.2);
    const Eigen::MatrixXd turned = (x + u) * q.transpose() - x;
    const CellResult a = evaluated(c, x, u), b = evaluated(c, x, turned);
    Eigen::MatrixXd all = 0 * a.tangent;
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      all.block(c.dim() * k, c.dim() * k, c.dim(), c.dim()) = q;
    const double scale = stiffness_scale(c, x);
    EXPECT_LT((b.force - all * a.force).norm(), 1e-14 * scale);
    // laws of principal stretches find these by an iteration, which rounds once more
    EXPECT_LT((b.tangent - all * a.tangent * all.transpose()).norm(), 2e-13 * scale);
  });
}

// Isotropy: the same body drawn elsewhere and turned has the same, turned, forces. The incompatible
// modes must not prefer directions.
TEST_P(Invariance, ForcesDoNotDependOnTheAxes) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (c.axisymmetric()) return;
    const Eigen::MatrixXd x = curved(c), u = motion(c), q = rotation(c, 0.7);
    Eigen::MatrixXd moved = x * q.transpose();
    moved.col(0).array() += 5;
    const Eigen::MatrixXd a = unflat(evaluated(c, x, u).force, c.dim());
    const Eigen::MatrixXd b = unflat(evaluated(c, moved, u * q.transpose()).force, c.dim());
    EXPECT_LT((b - a * q.transpose()).rowwise().norm().maxCoeff(), 4e-14 * stiffness_scale(c, x));
  });
}

// Nor the numbering: the corner that is called first has no privilege.
TEST(VolumeInvariance, ForcesDoNotDependOnTheFirstCorner) {
  constexpr std::array<Eigen::Index, 8> turned{1, 2, 3, 0, 5, 6, 7, 4},
      tipped{3, 2, 6, 7, 0, 1, 5, 4};
  for_each_volume([&](const VolumeCase& c) {
    if (c.type != cell::CellType::hex8) return;
    const Coordinates<3> x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const ElementResult<3> a = evaluated(c, x, u);
    for (const auto& order : {turned, tipped}) {
      Coordinates<3> xs(8, 3), us(8, 3);
      for (std::size_t k = 0; k < 8; ++k) {
        xs.row(static_cast<Eigen::Index>(k)) = x.row(order[k]);
        us.row(static_cast<Eigen::Index>(k)) = u.row(order[k]);
      }
      const ElementResult<3> b = evaluated(c, xs, us);
      for (std::size_t k = 0; k < 8; ++k)
        EXPECT_LT((b.force.segment<3>(3 * static_cast<Eigen::Index>(k)) -
                   a.force.segment<3>(3 * order[k]))
                      .norm(),
                  1e-14 * stiffness_scale(c, x));
    }
  });
}

TEST(SectionInvariance, ForcesAreProportionalToThicknessAndModulus) {
  for_each_section([](const SectionCase& given) {
    SectionCase c = given;
    const Coordinates<2> x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const ElementVector<2> before = evaluated(c, x, u).force;
    std::visit([](auto& law) { osculate::testing::set_elastic(law, 28, 0.3); }, c.section.law);
    c.section.thickness *= 2;
    const double factor = c.axisymmetric() ? 4 : 8;
    EXPECT_LT((evaluated(c, x, u).force - factor * before).norm(), 1e-12 * before.norm());
  });
}

TEST_P(Invariance, SaysInvertedWhenACellTurnsInsideOut) {
  for_each_cell(GetParam(), [](const CellCase& c) {
    if (!c.finite()) return;
    const Eigen::MatrixXd x = regular(c);
    Eigen::MatrixXd u = 0 * x;
    u.rightCols<1>() = -2 * x.rightCols<1>();
    EXPECT_EQ(answer(c, x, u, true).status, Status::inverted);
    EXPECT_EQ(point_values(c, x, u).status, Status::inverted);
    u(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(answer(c, x, u, true).status, Status::inverted);
  });
}

TEST(Status, SaysWhenTheMaterialHasNoAnswer) {
  Section<2> s{Assumption::plane_stress, Kinematics::finite, Formulation::full, 1,
               material::StVenantKirchhoff{7, 0.3, 0}};
  const Coordinates<2> x = sample_cell(cell::CellType::quad4, 0, false);
  for (const Formulation f : {Formulation::full, Formulation::enhanced}) {
    s.formulation = f;
    ElementResult<2> r;
    evaluate(s, cell::CellType::quad4, x, x, true, r);  // twice as large: no thickness is left
    EXPECT_EQ(r.status, Status::material_failed);
    EXPECT_EQ(stress_at_points(s, cell::CellType::quad4, x, x).status, Status::material_failed);
  }
}

/// Of a section with the formulations besides the full one, which `linear` has; `quadratic` has no
/// enhanced strains. `other` is of another dimension; `spoil` makes a formulation impossible.
template <class SectionType, class Names, class Spoil>
void expect_reasons(SectionType s, cell::CellType linear, cell::CellType quadratic,
                    cell::CellType other, std::span<const cell::CellType> types,
                    const Names& formulations, const Spoil& spoil) {
  s.law = material::LinearElastic{7, 0.3, 0};
  EXPECT_NE(unsupported(s, other), "");
  EXPECT_NE(unsupported(s, cell::CellType::point1), "");
  for (const cell::CellType type : types) EXPECT_EQ(unsupported(s, type), "");
  s.kinematics = Kinematics::finite;
  EXPECT_NE(unsupported(s, linear), "");
  s.law = material::NeoHooke{7, 0.3, 0};
  EXPECT_EQ(unsupported(s, linear), "");
  for (const auto f : formulations) {
    s.formulation = f;
    EXPECT_EQ(unsupported(s, linear), "");
    EXPECT_EQ(unsupported(s, quadratic) == "", f == Formulation::bbar);
    SectionType spoilt = s;
    cell::CellType type = linear;
    spoil(spoilt, type);
    EXPECT_NE(unsupported(spoilt, type), "");
  }
  s.kinematics = Kinematics::small;
  EXPECT_NE(unsupported(s, linear), "");
}

TEST(Unsupported, NamesTheReasonInThePlane) {
  expect_reasons(Section<2>{}, cell::CellType::quad4, cell::CellType::quad8, cell::CellType::line2,
                 area_types, std::array{Formulation::bbar, Formulation::enhanced},
                 [](Section<2>& s, cell::CellType& type) {
                   if (s.formulation == Formulation::bbar)
                     s.assumption = Assumption::plane_stress;
                   else
                     type = cell::CellType::tri3;
                 });
}

TEST(Unsupported, NamesTheReasonInSpace) {
  expect_reasons(Section<3>{}, cell::CellType::hex8, cell::CellType::hex20, cell::CellType::quad4,
                 volume_types, std::array{Formulation::bbar, Formulation::enhanced},
                 [](auto&, cell::CellType& type) { type = cell::CellType::tet4; });
}

}  // namespace
}  // namespace osculate::solid::testing
