// Forces alone, beside test_derivatives.cpp: there they are those that the tangents belong to.
#include <gtest/gtest.h>

#include <random>

#include "osculate/cell/shape.hpp"
#include "osculate/solid/element.hpp"
#include "osculate/solid/volume.hpp"

namespace osculate::solid {
namespace {

const material::NeoHooke rubber{100, 0.45, 0};
const material::StVenantKirchhoff steel{100, 0.3, 0};

/// A cell that is turned inside out is told of in both ways.
TEST(FiniteForces, SayWhereACellIsInverted) {
  Section section;
  section.kinematics = Kinematics::finite;
  section.law = rubber;
  Coordinates x(4, 2), u(4, 2);
  for (int i = 0; i < 4; ++i) x.row(i) = cell::area_node(cell::CellType::quad4, i);
  u.setZero();
  u.row(0) << 3, 3;
  for (const bool with_tangent : {false, true}) {
    ElementResult out;
    evaluate(section, cell::CellType::quad4, x, u, with_tangent, out);
    EXPECT_EQ(out.status, Status::inverted);
  }
}

TEST(FiniteForces, StressesAreThoseOfTheResponse) {
  std::mt19937 generator{5};
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  for (const material::Law& law : {material::Law(rubber), material::Law(steel)}) {
    material::Strain plane;
    material::Strain3 space;
    for (double& e : plane) e = uniform(generator);
    for (double& e : space) e = uniform(generator);
    EXPECT_EQ(material::stress(law, plane).stress, material::response(law, plane).stress);
    EXPECT_EQ(material::stress(law, space).stress, material::response(law, space).stress);
  }
  EXPECT_FALSE(material::stress(rubber, material::Strain(-0.6, 0, 0, 0)).ok);
  material::Strain3 crushed = material::Strain3::Zero();
  crushed[1] = -0.6;
  EXPECT_FALSE(material::stress(rubber, crushed).ok);
}

}  // namespace
}  // namespace osculate::solid
