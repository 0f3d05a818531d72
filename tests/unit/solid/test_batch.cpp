// Cells four at a time say what they say one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "osculate/cell/shape.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/solid/batch.hpp"
#include "osculate/solid/corner_modes.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;
using core::Pack;

template <int Dim>
Vec<Dim> place_of(CellType type, int node) {
  if constexpr (Dim == 2)
    return cell::area_node(type, node);
  else
    return cell::volume_node(type, node);
}

/// A distorted cell far from the origin, another one for each `number`, `flat` times as thin.
template <int Dim>
Coordinates<Dim> cell_number(CellType type, int number, double flat) {
  const int n = cell::info(type).nodes;
  Coordinates<Dim> x(n, Dim);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < Dim; ++i)
      x(k, i) = 3 + (place_of<Dim>(type, k)[i] + 0.2 * std::sin(3.1 * k + 1.7 * i + number)) /
                        (i == 1 ? flat : 1);
  return x;
}
template <int Dim>
Coordinates<Dim> displacement_number(CellType type, int number, double size) {
  const int n = cell::info(type).nodes;
  Coordinates<Dim> u(n, Dim);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < Dim; ++i) u(k, i) = size * std::sin(2.3 * k + 0.9 * i + 5 + number);
  return u;
}

/// Largest difference of forces over their largest, of four cells.
template <int Dim>
double difference(const Section<Dim>& section, CellType type, double size, double flat = 1) {
  const auto batch = batch_of<Dim>(section, type, cell_number<Dim>(type, 0, flat));
  if (!batch) return 1;
  std::vector<Pack> numbers(batch->kept), u, force;
  const int n = cell::info(type).nodes;
  u.resize(static_cast<std::size_t>(Dim * n));
  force.resize(u.size());
  std::array<ElementVector<Dim>, Pack::count> want;
  for (int lane = 0; lane < Pack::count; ++lane) {
    const Coordinates<Dim> x = cell_number<Dim>(type, lane, flat),
                           v = displacement_number<Dim>(type, lane, size);
    EXPECT_TRUE(keep_in<Dim>(*batch, x, lane, numbers.data()));
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < Dim; ++i) u[static_cast<std::size_t>(Dim * k + i)].set(lane, v(k, i));
    ElementResult<Dim> result;
    evaluate<Dim>(section, type, x, v, false, result);
    EXPECT_EQ(result.status, Status::ok);
    want[static_cast<std::size_t>(lane)] = result.force;
  }
  EXPECT_TRUE(batch_forces<Dim>(*batch, numbers.data(), u.data(), force.data()));
  Pack energy;
  EXPECT_TRUE(batch_energy<Dim>(*batch, numbers.data(), u.data(), energy));
  double worst = 0;
  for (int lane = 0; lane < Pack::count; ++lane) {
    const auto& of_cell = want[static_cast<std::size_t>(lane)];
    for (int d = 0; d < Dim * n; ++d)
      worst = std::max(worst, std::abs(force[static_cast<std::size_t>(d)][lane] - of_cell[d]) /
                                  of_cell.template lpNorm<Eigen::Infinity>());
    const double stored = strain_energy<Dim>(section, type, cell_number<Dim>(type, lane, flat),
                                             displacement_number<Dim>(type, lane, size));
    // ln J and tr E cancel in neo-Hooke's energy
    EXPECT_NEAR(energy[lane], stored, 1e-12 * stored + 1e-13);
  }
  return worst;
}

const material::NeoHooke soft{100, 0.45, 0};
const material::StVenantKirchhoff stiff{100, 0.3, 0};
const material::LinearElastic elastic{100, 0.3, 0};
material::Rubber rubber() {
  material::Rubber law;
  law.c10 = 0.5;
  law.c01 = 0.1;
  law.d1 = 0.02;
  return law;
}

template <int Dim>
Section<Dim> section_of(Kinematics kinematics, Formulation formulation, const material::Law& law) {
  Section<Dim> section;
  section.kinematics = kinematics;
  section.formulation = formulation;
  section.law = law;
  if constexpr (Dim == 2) section.thickness = 0.7;
  return section;
}

TEST(Batch, FiniteStrainsSayTheSame) {
  using enum Formulation;
  for (const material::Law& law :
       {material::Law(soft), material::Law(stiff), material::Law(rubber())})
    for (const double size : {0.1, 1e-3, 1e-6}) {
      for (const Formulation formulation : {full, bbar, reduced}) {
        SCOPED_TRACE(size);
        const auto plane = section_of<2>(Kinematics::finite, formulation, law);
        const auto space = section_of<3>(Kinematics::finite, formulation, law);
        EXPECT_LT(difference(plane, CellType::quad4, size), 1e-12);
        EXPECT_LT(difference(space, CellType::hex8, size), 1e-12);
      }
      EXPECT_LT(difference(section_of<2>(Kinematics::finite, full, law), CellType::tri3, size),
                1e-12);
      EXPECT_LT(difference(section_of<3>(Kinematics::finite, full, law), CellType::tet4, size),
                1e-12);
    }
}

TEST(Batch, SmallStrainsSayTheSame) {
  using enum Formulation;
  for (const double flat : {1.0, 20.0}) {
    for (const Formulation formulation : {full, bbar, enhanced, reduced}) {
      SCOPED_TRACE(static_cast<int>(formulation));
      auto plane = section_of<2>(Kinematics::small, formulation, elastic);
      EXPECT_LT(difference(plane, CellType::quad4, 0.01, flat), 1e-12);
      EXPECT_LT(difference(section_of<3>(Kinematics::small, formulation, elastic), CellType::hex8,
                           0.01, flat),
                1e-12);
      if (formulation == bbar) continue;
      plane.assumption = Assumption::plane_stress;
      EXPECT_LT(difference(plane, CellType::quad4, 0.01, flat), 1e-12);
    }
    EXPECT_LT(difference(section_of<2>(Kinematics::small, full, elastic), CellType::tri3, 0.01),
              1e-12);
    EXPECT_LT(difference(section_of<3>(Kinematics::small, full, elastic), CellType::tet4, 0.01),
              1e-12);
  }
}

/// Axes that turn within a cell make a stiffness that the kept numbers cannot have.
TEST(Batch, WhatItCannotSayItDoesNotTake) {
  const auto refuses = [](const auto& section, CellType type) {
    constexpr int dim = std::is_same_v<std::decay_t<decltype(section)>, Section<2>> ? 2 : 3;
    return !batch_of<dim>(section, type, cell_number<dim>(type, 0, 1)).has_value();
  };
  auto ring = section_of<2>(Kinematics::small, Formulation::full, elastic);
  ring.assumption = Assumption::axisymmetric;
  EXPECT_TRUE(refuses(ring, CellType::quad4));
  auto sheet = section_of<2>(Kinematics::finite, Formulation::full, stiff);
  sheet.assumption = Assumption::plane_stress;
  EXPECT_TRUE(refuses(sheet, CellType::quad4));
  EXPECT_TRUE(
      refuses(section_of<3>(Kinematics::small, Formulation::full, elastic), CellType::hex20));
  EXPECT_TRUE(
      refuses(section_of<3>(Kinematics::finite, Formulation::enhanced, stiff), CellType::hex8));
  material::J2Plasticity flows;
  flows.young = 100;
  flows.poisson = 0.3;
  EXPECT_TRUE(refuses(section_of<3>(Kinematics::small, Formulation::full, flows), CellType::hex8));
}

TEST(Batch, ACellTurnedInsideOutIsTold) {
  for (const Formulation formulation :
       {Formulation::full, Formulation::bbar, Formulation::reduced}) {
    const auto section = section_of<3>(Kinematics::finite, formulation, soft);
    const auto x = cell_number<3>(CellType::hex8, 0, 1);
    const auto batch = batch_of<3>(section, CellType::hex8, x);
    ASSERT_TRUE(batch);
    std::vector<Pack> numbers(batch->kept), u(24, Pack(0.0)), force(24);
    for (int lane = 0; lane < Pack::count; ++lane)
      ASSERT_TRUE(keep_in<3>(*batch, x, lane, numbers.data()));
    EXPECT_TRUE(batch_forces<3>(*batch, numbers.data(), u.data(), force.data()));
    for (std::size_t k = 0; k < 8; ++k) u[3 * k].set(2, -2 * x(static_cast<Eigen::Index>(k), 0));
    EXPECT_FALSE(batch_forces<3>(*batch, numbers.data(), u.data(), force.data()));
  }
}

/// Two batches at once, where the processor has 512 bits: not a bit differs, and what has no answer
/// there has none here.
TEST(Batch, EightAtOnceHaveTheBitsOfFour) {
  if (!has_eight_lanes()) GTEST_SKIP() << "no AVX-512 here";
  for (const Formulation formulation : {Formulation::full, Formulation::bbar, Formulation::reduced})
    for (const double size : {0.1, 1e-3, 1e-7}) {
      const auto section = section_of<3>(Kinematics::finite, formulation, soft);
      const auto batch = batch_of<3>(section, CellType::hex8, cell_number<3>(CellType::hex8, 0, 1));
      ASSERT_TRUE(batch);
      const std::optional<EightCells> eight = eight_cells<3>(*batch);
      ASSERT_TRUE(eight);
      std::array<std::vector<Pack>, 2> numbers, u, four, wide;
      for (std::size_t half = 0; half < 2; ++half) {
        numbers[half].resize(batch->kept);
        for (auto* const values : {&u[half], &four[half], &wide[half]}) values->resize(24);
        for (int lane = 0; lane < Pack::count; ++lane) {
          const int number = lane + 4 * static_cast<int>(half);
          const auto v = displacement_number<3>(CellType::hex8, number, size);
          ASSERT_TRUE(keep_in<3>(*batch, cell_number<3>(CellType::hex8, number, 1), lane,
                                 numbers[half].data()));
          for (int d = 0; d < 24; ++d)
            u[half][static_cast<std::size_t>(d)].set(lane, v(d / 3, d % 3));
        }
        ASSERT_TRUE(
            batch_forces<3>(*batch, numbers[half].data(), u[half].data(), four[half].data()));
      }
      const auto at_once = [&] {
        return forces_of_eight(*eight, {numbers[0].data(), numbers[1].data()},
                               {u[0].data(), u[1].data()}, {wide[0].data(), wide[1].data()});
      };
      EXPECT_TRUE(at_once());
      for (std::size_t half = 0; half < 2; ++half)
        for (std::size_t d = 0; d < 24; ++d)
          for (int lane = 0; lane < Pack::count; ++lane) {
            EXPECT_NE(four[half][d][lane], 0);
            EXPECT_EQ(four[half][d][lane], wide[half][d][lane]);
          }
      const auto x = cell_number<3>(CellType::hex8, 6, 1);  // is turned inside out
      for (std::size_t k = 0; k < 8; ++k)
        u[1][3 * k].set(2, -2 * x(static_cast<Eigen::Index>(k), 0));
      EXPECT_FALSE(at_once());
      EXPECT_FALSE(batch_forces<3>(*batch, numbers[1].data(), u[1].data(), wide[1].data()));
    }
}
TEST(Batch, EightOfOtherLawsAreNotTaken) {
  const auto batch_with = [](const Section<3>& section) {
    return *batch_of<3>(section, CellType::hex8, cell_number<3>(CellType::hex8, 0, 1));
  };
  EXPECT_FALSE(
      eight_cells(batch_with(section_of<3>(Kinematics::finite, Formulation::full, stiff))));
  EXPECT_FALSE(
      eight_cells(batch_with(section_of<3>(Kinematics::small, Formulation::full, elastic))));
}

/// The slopes axis by axis are those of the shape functions, and their transposed is that.
TEST(Batch, SlopesAreThoseOfTheShapeFunctions) {
  OfCorners<3, double> v{}, w{};
  for (std::size_t c = 0; c < 8; ++c) {
    v[c] = std::sin(1.0 + 2.0 * static_cast<double>(c));
    const Vec3 xi = cell::volume_node(CellType::hex8, corner_node<3>[c]);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(xi[j] > 0, (c >> j & 1U) != 0);
  }
  OfCorners<3, double> factor = v;
  to_products(factor);
  for (double& f : factor) f /= 8;
  PointSlopes<3, double> slopes, work{};
  set_slopes<3>(factor, slopes);
  double both = 0;
  for (std::size_t q = 0; q < 8; ++q) {
    Vec3 xi;
    for (int j = 0; j < 3; ++j) xi[j] = ((q >> j & 1U) != 0 ? 1 : -1) / std::sqrt(3.0);
    const cell::VolumeShape shape = cell::volume_shape(CellType::hex8, xi);
    for (int j = 0; j < 3; ++j) {
      double expected = 0;
      for (std::size_t c = 0; c < 8; ++c) expected += v[c] * shape.d(corner_node<3>[c], j);
      EXPECT_NEAR(slopes.at(j, q), expected, 1e-15);
      const double weight = std::cos(static_cast<double>(q) + j);
      both += weight * expected;
      work.at(j, q) += weight;
    }
  }
  add_transposed<3>(work, w);
  double same = 0;
  for (std::size_t m = 0; m < 8; ++m) same += w[m] * factor[m];
  EXPECT_NEAR(same, both, 1e-14);
}

}  // namespace
}  // namespace osculate::solid
