// The strain energy of a cell is the potential of its internal force.
#include "osculate/solid/energy.hpp"

#include "derivative_check.hpp"
#include "section_cases.hpp"
#include "volume_cases.hpp"

namespace osculate::solid::testing {
namespace {

using osculate::testing::check_derivative;

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

TEST(StrainEnergy, OfAreaCellsHasTheForceAsItsDerivative) {
  for_each_section([](const SectionCase& c) {
    const Coordinates x = sample_cell(c.type, 0.12, true), u = sample_displacement(c.type, 0.06);
    const Eigen::VectorXd along = flat(sample_displacement(c.type, 0.3, 5));
    const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return one(strain_energy(c.section, c.type, x, unflat(v)));
    };
    const auto r =
        check_derivative(energy, one(evaluated(c, x, u).force.dot(along)), flat(u), along);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
        << "order " << r.order << " error " << r.error;
    EXPECT_TRUE(c.finite() || r.exact) << r.error;
  });
}

TEST(StrainEnergy, OfVolumeCellsHasTheForceAsItsDerivative) {
  for_each_volume([](const VolumeCase& c) {
    const Coordinates3 x = sample_volume(c.type, 0.08, true), u = sample_motion(c.type, 0.04);
    const Coordinates3 direction = sample_motion(c.type, 0.3, 5);
    const VolumeVector force = evaluated(c, x, u).force;
    double work = 0;
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      work += force.segment<3>(3 * k).dot(direction.row(k).transpose());
    const auto energy = [&](const Eigen::VectorXd& s) -> Eigen::VectorXd {
      return one(strain_energy(c.section, c.type, x, Coordinates3(u + s[0] * direction)));
    };
    const auto r = check_derivative(energy, one(work), one(0), one(1));
    EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
        << "order " << r.order << " error " << r.error;
    EXPECT_TRUE(c.finite() || r.exact) << r.error;
  });
}

TEST(StrainEnergy, OfAnInvertedCellIsInfinite) {
  Section section;
  section.kinematics = Kinematics::finite;
  section.law = material::NeoHooke{1, 0.3, 0};
  const Coordinates x = sample_cell(cell::CellType::quad4, 0, false);
  Coordinates folded = -2 * x;
  folded.col(1).setZero();  // mirrored in one direction
  EXPECT_TRUE(std::isinf(strain_energy(section, cell::CellType::quad4, x, folded)));
}

}  // namespace
}  // namespace osculate::solid::testing
