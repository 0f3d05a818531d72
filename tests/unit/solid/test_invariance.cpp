#include <limits>

#include "section_cases.hpp"

namespace osculate::solid::testing {
namespace {

Mat<2, 2> turn_by(double angle) {
  Mat<2, 2> q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

/// Sum of the forces and their moment about the origin.
Vec3 resultant(const ElementVector& force, const Coordinates& places) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    const Vec2 f = force.segment<2>(2 * k);
    sum += Vec3(f.x(), f.y(), places(k, 0) * f.y() - places(k, 1) * f.x());
  }
  return sum;
}

TEST(Invariance, ForcesBalanceAndTheirMomentsToo) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const ElementResult r = evaluated(c, x, u);
    const Coordinates places = c.finite() ? Coordinates(x + u) : x;
    const Vec3 sum = resultant(r.force, places);
    const double rounding = 1e-14 * stiffness_scale(c, x);
    EXPECT_NEAR(sum[1], 0, rounding);
    if (c.axisymmetric()) return;  // the rest of the ring balances the radial forces
    EXPECT_NEAR(sum[0], 0, rounding);
    EXPECT_NEAR(sum[2], 0, 4 * rounding);
  });
}

TEST(Invariance, TranslationGivesNoForce) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true);
    Coordinates u = Coordinates::Zero(x.rows(), 2);
    u.col(1).setConstant(0.7);
    if (!c.axisymmetric()) u.col(0).setConstant(-0.4);
    EXPECT_LT(evaluated(c, x, u).force.norm(), 1e-14 * stiffness_scale(c, x));
  });
}

TEST(Invariance, RotationGivesNoForce) {
  for_each_section([](const SectionCase& c) {
    if (c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.12, true);
    Coordinates u = x * turn_by(2.1).transpose() - x;
    if (!c.finite())  // the linearised rotation
      for (Eigen::Index k = 0; k < x.rows(); ++k) u.row(k) << -0.3 * x(k, 1), 0.3 * x(k, 0);
    EXPECT_LT(evaluated(c, x, u).force.norm(), 2e-14 * stiffness_scale(c, x));
  });
}

TEST(Invariance, ForcesAndTangentTurnWithTheBody) {
  for_each_section([](const SectionCase& c) {
    if (c.axisymmetric() || !c.finite()) return;
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const Mat<2, 2> q = turn_by(-1.2);
    const Coordinates turned = (x + u) * q.transpose() - x;
    const ElementResult a = evaluated(c, x, u), b = evaluated(c, x, turned);
    ElementMatrix all = ElementMatrix::Zero(2 * x.rows(), 2 * x.rows());
    for (Eigen::Index k = 0; k < x.rows(); ++k) all.block<2, 2>(2 * k, 2 * k) = q;
    const double scale = stiffness_scale(c, x);
    EXPECT_LT((b.force - all * a.force).norm(), 1e-14 * scale);
    EXPECT_LT((b.tangent - all * a.tangent * all.transpose()).norm(), 1e-13 * scale);
  });
}

// Isotropy: the same body drawn elsewhere and turned has the same, turned, forces. The incompatible
// modes must not prefer directions.
TEST(Invariance, ForcesDoNotDependOnTheAxes) {
  for_each_section([](const SectionCase& c) {
    if (c.axisymmetric()) return;
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const Mat<2, 2> q = turn_by(0.7);
    Coordinates moved = x * q.transpose();
    moved.col(0).array() += 5;
    const ElementResult a = evaluated(c, x, u), b = evaluated(c, moved, u * q.transpose());
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      EXPECT_LT((b.force.segment<2>(2 * k) - q * a.force.segment<2>(2 * k)).norm(),
                4e-14 * stiffness_scale(c, x));
  });
}

TEST(Invariance, ForcesAreProportionalToThicknessAndModulus) {
  for_each_section([](SectionCase c) {
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const ElementVector before = evaluated(c, x, u).force;
    std::visit([](auto& law) { law.young *= 4; }, c.section.law);
    c.section.thickness *= 2;
    const double factor = c.axisymmetric() ? 4 : 8;
    EXPECT_LT((evaluated(c, x, u).force - factor * before).norm(), 1e-12 * before.norm());
  });
}

TEST(Status, SaysInvertedWhenACellTurnsInsideOut) {
  for_each_section([](const SectionCase& c) {
    if (!c.finite()) return;
    const Coordinates x = sample_cell(c.type, 0, false);
    Coordinates u = Coordinates::Zero(x.rows(), 2);
    u.col(1) = -2 * x.col(1);
    ElementResult r;
    evaluate(c.section, c.type, x, u, true, r);
    EXPECT_EQ(r.status, Status::inverted);
    EXPECT_EQ(stress_at_points(c.section, c.type, x, u).status, Status::inverted);
    u(0, 0) = std::numeric_limits<double>::quiet_NaN();
    evaluate(c.section, c.type, x, u, true, r);
    EXPECT_EQ(r.status, Status::inverted);
  });
}

TEST(Status, SaysWhenTheMaterialHasNoAnswer) {
  Section s{Assumption::plane_stress, Kinematics::finite, Formulation::full, 1,
            material::StVenantKirchhoff{7, 0.3, 0}};
  const Coordinates x = sample_cell(cell::CellType::quad4, 0, false);
  for (const Formulation f : {Formulation::full, Formulation::enhanced}) {
    s.formulation = f;
    ElementResult r;
    evaluate(s, cell::CellType::quad4, x, x, true, r);  // twice as large: no thickness is left
    EXPECT_EQ(r.status, Status::material_failed);
    EXPECT_EQ(stress_at_points(s, cell::CellType::quad4, x, x).status, Status::material_failed);
  }
}

TEST(Unsupported, NamesTheReason) {
  Section s;
  s.law = material::LinearElastic{7, 0.3, 0};
  EXPECT_NE(unsupported(s, cell::CellType::line2), "");
  EXPECT_NE(unsupported(s, cell::CellType::point1), "");
  for (const cell::CellType type : area_types) EXPECT_EQ(unsupported(s, type), "");
  s.kinematics = Kinematics::finite;
  EXPECT_NE(unsupported(s, cell::CellType::quad4), "");
  s.law = material::NeoHooke{7, 0.3, 0};
  EXPECT_EQ(unsupported(s, cell::CellType::quad4), "");
  for (const Formulation f : {Formulation::bbar, Formulation::enhanced}) {
    s.formulation = f;
    EXPECT_EQ(unsupported(s, cell::CellType::quad4), "");
    EXPECT_NE(unsupported(s, cell::CellType::quad8), "");
    s.assumption = f == Formulation::bbar ? Assumption::plane_stress : Assumption::axisymmetric;
    EXPECT_NE(unsupported(s, cell::CellType::quad4), "");
    s.assumption = Assumption::plane_strain;
  }
  s.kinematics = Kinematics::small;
  EXPECT_NE(unsupported(s, cell::CellType::quad4), "");
}

}  // namespace
}  // namespace osculate::solid::testing
