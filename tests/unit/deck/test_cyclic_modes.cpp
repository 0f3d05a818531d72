// Free vibrations of a ring by one of its sectors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// A ring of 6 sectors, each of two elements, that is softer at one place of each sector; or one of
/// them. Its inside is held or free.
std::string blisk(bool whole, bool held, const std::string& modes) {
  return fmt::format(
      "osculate: 1\n"
      "mesh: {{generate: {{r: {{ring: {{radius: [1, 2], angle: [10, {}], z: [0, 0.3], elements: "
      "[1, {}, 1]}}}}}}}}\n"
      "materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3, density: 1}}}}}}\n"
      "sections: [{{on: r, material: m, element: solid, kinematics: small}}]\n"
      "{}"
      "steps:\n"
      "  - {{name: hold, increments: 1, prescribe: [{{on: r.inner, uz: 0{}}}]}}\n"
      "  - {{name: free, modes: {}}}\n",
      whole ? 370 : 70, whole ? 12 : 2,
      whole ? "" : "cyclic_symmetry: [{dependent: r.from, independent: r.to, sectors: 6}]\n",
      held ? ", ux: 0, uy: 0" : "", modes);
}

model::Vibrations found(const std::string& text) {
  const Built3 built = built_from(text);
  const model::AnalysisResult3 result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  if (result.steps.size() < 2 || !result.steps[1].vibrations) return {};
  EXPECT_EQ(result.steps[1].vibrations->missing, 0);
  return *result.steps[1].vibrations;
}

/// All numbers of diameters together have the vibrations of the whole ring, each as often.
TEST(CyclicModes, AreThoseOfTheRing) {
  for (const bool held : {true, false}) {
    const model::Vibrations ring = found(blisk(true, held, "24"));
    const model::Vibrations sector =
        found(blisk(false, held, "{count: 10, diameters: [0, 1, 2, 3]}"));
    ASSERT_EQ(sector.omega_squared.size(), 40);
    std::vector<double> all(sector.omega_squared.begin(), sector.omega_squared.end());
    double known = 1e300;  // all below it are there
    for (std::size_t i = 9; i < all.size(); i += 10) known = std::min(known, all[i]);
    std::sort(all.begin(), all.end());
    const double scale = ring.omega_squared.tail<1>()[0];
    int compared = 0;
    for (std::size_t i = 0; i < 24 && all[i] < known; ++i, ++compared)
      EXPECT_NEAR(all[i], ring.omega_squared[static_cast<Eigen::Index>(i)], 1e-9 * scale) << i;
    EXPECT_GE(compared, 15);
  }
}

/// One face follows the other with the phase, by both of a pair; what is held stays.
TEST(CyclicModes, FacesFollowEachOther) {
  const std::string text = blisk(false, true, "{count: 4, diameters: [0, 1, 3]}");
  const Built3 built = built_from(text);
  const model::Vibrations modes = found(text);
  ASSERT_EQ(modes.diameters, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, 3, 3, 3, 3}));
  const mesh::Set &from = *built.model.mesh.find_set("r.from"),
                  &to = *built.model.mesh.find_set("r.to");
  Mat<3, 3> turn = Mat<3, 3>::Identity();
  turn.topLeftCorner<2, 2>() << 0.5, -std::sqrt(0.75), std::sqrt(0.75), 0.5;  // by 60 degrees
  int compared = 0;
  for (Eigen::Index i = 0; i < 12; ++i) {
    double forwards = 0, backwards = 0;
    const double angle = modes.diameters[static_cast<std::size_t>(i)] * std::numbers::pi / 3;
    const auto at = [&](Index n) -> Eigen::Vector3cd {
      Eigen::Vector3cd u;
      u.real() = modes.shapes.col(i).segment<3>(3 * n);
      u.imag() = modes.imaginary.col(i).segment<3>(3 * n);
      return u;
    };
    for (const Index a : from.nodes)
      for (const Index b : to.nodes) {
        const Vec3 &x = built.model.mesh.nodes[static_cast<std::size_t>(a)],
                   &y = built.model.mesh.nodes[static_cast<std::size_t>(b)];
        if ((turn * x - y).norm() > 1e-9) continue;
        ++compared;
        const Eigen::Vector3cd ahead = turn * at(a);
        forwards += (at(b) - std::polar(1.0, angle) * ahead).norm();
        backwards += (at(b) - std::polar(1.0, -angle) * ahead).norm();
      }
    EXPECT_LT(std::min(forwards, backwards), 1e-10) << i;
    EXPECT_GT(modes.shapes.col(i).norm() + modes.imaginary.col(i).norm(), 0.1);
    for (const Index n : built.model.mesh.find_set("r.inner")->nodes) EXPECT_EQ(at(n).norm(), 0);
  }
  EXPECT_EQ(compared, 12 * 4);
  EXPECT_TRUE(modes.imaginary.leftCols(4).isZero(0));
  EXPECT_FALSE(modes.imaginary.middleCols(4, 4).isZero(1e-3));
  EXPECT_NEAR(modes.omega_squared[4], modes.omega_squared[5], 1e-9 * modes.omega_squared[5]);
}

TEST(CyclicModes, Refusals) {
  const auto message = [](const std::string& text) {
    try {
      (void)built_from(text);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
  };
  EXPECT_EQ(message(blisk(false, true, "{count: 2, diameters: [3]}")), "none");
  expect(blisk(false, true, "2"), "say which nodal `diameters` they have");
  expect(blisk(false, true, "{count: 2, diameters: [4]}"), "6 sectors have at most 3");
  expect(blisk(false, true, "{count: 2, diameters: [1, 1]}"), "1 is given twice");
  expect(blisk(true, true, "{count: 2, diameters: [1]}"), "only a sector with `cyclic_symmetry`");
  expect(blisk(false, true, "{count: 2, diameters: [1]}") +
             "  - {name: ring, increments: 1, duration: 1, modal: {}}\n",
         "vibrations of a sector of a ring are not moved by loads");
  expect(blisk(false, true, "{count: 2, diameters: [1]}") +
             "  - {name: swing, harmonic: {from: 1, to: 2}}\n",
         "vibrations of a sector of a ring are not moved by loads");
}

/// What only one face holds would hold both.
TEST(CyclicModes, FacesAreHeldAlike) {
  std::string text = blisk(false, false, "{count: 2, diameters: [1]}");
  text = edited(text, "on: r.inner, uz: 0}", "on: r.inner, uz: 0}, {on: r.from, ux: 0}");
  const Built3 built = built_from(text);
  const auto result = model::run(built.model, built.options, {});
  EXPECT_NE(result.message.find("holds one face of the cyclic symmetry"), std::string::npos)
      << result.message;
}

}  // namespace
}  // namespace osculate::deck
