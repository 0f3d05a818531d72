// The stress is the derivative of the stored energy.
#include "osculate/material/energy.hpp"

#include <gtest/gtest.h>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"
#include "sample_laws.hpp"

namespace osculate::material {
namespace {

template <class StrainType>
void expect_potential(const Law& law, const StrainType& at, const StrainType& along) {
  const Eigen::VectorXd slope = Eigen::VectorXd::Constant(1, response(law, at).stress.dot(along));
  const auto energy = [&](const StrainType& e) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, stored_energy(law, e));
  };
  const auto r = osculate::testing::check_derivative(energy, slope, at, along);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
}

TEST(StoredEnergy, HasTheStressAsItsDerivative) {
  for_each_law([](auto law) {
    osculate::testing::set_elastic(law, 7, 0.3);
    const Strain at(0.1, -0.05, 0.07, 0.2), along(0.3, 0.8, -0.4, 0.5);
    expect_potential(law, at, along);
    Strain3 at3, along3;
    at3 << 0.1, -0.05, 0.07, 0.2, -0.1, 0.05;
    along3 << 0.3, 0.8, -0.4, 0.5, 0.2, -0.6;
    expect_potential(law, at3, along3);
    EXPECT_EQ(stored_energy(law, Strain(Strain::Zero())), 0.0);
  });
}

}  // namespace
}  // namespace osculate::material
