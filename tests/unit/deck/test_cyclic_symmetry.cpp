#include <fmt/format.h>
#include <cmath>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// Sectors of a ring whose inside is held and whose outside is turned and pulled along the axis.
std::string ring(double angle, int elements, int sectors, const std::string& type = "hex8") {
  return fmt::format(
      "osculate: 1\n"
      "mesh: {{generate: {{r: {{ring: {{radius: [1, 2], angle: [10, {}], z: [0, 0.5], elements: "
      "[3, {}, 1], type: {}}}}}}}}}\n"
      "materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}\n"
      "sections: [{{on: r, material: m, element: solid, kinematics: small}}]\n"
      "axes: [{{on: r.outer, cylindrical: {{from: [0, 0, 0], to: [0, 0, 1]}}}}]\n"
      "{}"
      "steps:\n"
      "  - name: s\n"
      "    increments: 1\n"
      "    prescribe: [{{on: r.inner, ux: 0, uy: 0, uz: 0}}, {{on: r.outer, uy: 0.01, uz: "
      "0.02}}]\n",
      10 + angle, elements, type,
      sectors > 0 ? fmt::format("cyclic_symmetry: [{{dependent: r.from, independent: r.to, "
                                "sectors: {}}}]\n",
                                sectors)
                  : std::string());
}

struct Field {
  std::vector<Vec3> x, u;
};
Field solved(const std::string& text) {
  const Built3 built = built_from(text);
  Field field;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3&, const model::State3& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    field.u.clear();
    for (std::size_t n = 0; n < built.model.mesh.nodes.size(); ++n)
      field.u.emplace_back(state.u.segment<3>(3 * static_cast<Eigen::Index>(n)));
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  field.x = built.model.mesh.nodes;
  return field;
}
/// Radial, around, axial.
Vec3 local(const Vec3& x, const Vec3& u) {
  const double r = std::hypot(x.x(), x.y());
  return {(x.x() * u.x() + x.y() * u.y()) / r, (x.x() * u.y() - x.y() * u.x()) / r, u.z()};
}

/// One, two and three sectors of twelve are the same, everywhere round the axis.
TEST(CyclicSymmetry, SectorsOfAnyNumberAreTheSame) {
  const Field one = solved(ring(30, 2, 12)), three = solved(ring(90, 6, 4));
  ASSERT_LT(one.x.size(), three.x.size());
  int compared = 0;
  for (std::size_t i = 0; i < one.x.size(); ++i)
    for (std::size_t j = 0; j < three.x.size(); ++j) {
      const Vec3 &a = one.x[i], &b = three.x[j];
      if (std::abs(a.head<2>().norm() - b.head<2>().norm()) > 1e-9 ||
          std::abs(a.z() - b.z()) > 1e-9)
        continue;
      EXPECT_LT((local(a, one.u[i]) - local(b, three.u[j])).norm(), 1e-12);
      ++compared;
    }
  EXPECT_EQ(compared, 8 * 3 * 7);
  // without it the faces are free, and not the same
  const Field open = solved(ring(30, 2, 0));
  double most = 0;
  for (std::size_t i = 0; i < one.u.size(); ++i)
    most = std::max(most, (open.u[i] - one.u[i]).norm());
  EXPECT_GT(most, 1e-4);
}

TEST(CyclicSymmetry, CellsOfSecondOrder) {
  const Field one = solved(ring(30, 1, 12, "hex20")), two = solved(ring(60, 2, 6, "hex20"));
  for (std::size_t i = 0; i < one.x.size(); ++i)
    for (std::size_t j = 0; j < two.x.size(); ++j)
      if ((one.x[i] - two.x[j]).norm() < 1e-9) {
        EXPECT_LT((one.u[i] - two.u[j]).norm(), 1e-11);
      }
}

TEST(CyclicSymmetry, FacesThatAreNoSector) {
  EXPECT_EQ(any_refusal(ring(30, 2, 11)),
            "model.yaml:6: cyclic_symmetry[0]: turned by 360/11 degrees, 'r.to' does not lie on "
            "'r.from': a node is 0.0951638 away from it");
}

TEST(CyclicSymmetry, SaysNothingOfVibrations) {
  const std::string still = edited(ring(30, 2, 12), "uy: 0.01, uz: 0.02", "uy: 0, uz: 0");
  EXPECT_NE(any_refusal(edited(still, "increments: 1", "modes: 3"))
                .find("has not the free vibrations of the whole"),
            std::string::npos);
}

}  // namespace
}  // namespace osculate::deck
