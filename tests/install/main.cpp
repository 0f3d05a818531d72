// The consumer's program: plain arrays in, plain numbers out.
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "osculate/api/closest_points.hpp"
#include "osculate/api/contact_evaluator.hpp"
#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/curve_jet.hpp"
#include "osculate/la/mumps.hpp"
#include "osculate/projection/point_to_curve.hpp"

namespace {

/// A unit circle walked clockwise has the disc on its right: the normal points outwards and the
/// curvature is -1. Values cross the library border in small fixed-size matrices.
bool frame_of_a_circle_is_right() {
  osculate::geometry::CurveJet<2> jet;
  jet.r = {0.0, 1.0};
  jet.r1 = {1.0, 0.0};
  jet.r2 = {0.0, -1.0};
  const osculate::geometry::CurveFrame frame = osculate::geometry::curve_frame(jet);
  return frame.valid && frame.kappa == -1.0 && frame.normal.x() == 0.0 && frame.normal.y() == 1.0;
}

/// Compiled code of a static layer: the foot of (3, 1) on the segment from (0, 0) to (4, 0).
bool closest_point_is_right() {
  const osculate::projection::CurveFoot foot =
      osculate::projection::closest_on_line2({0.0, 0.0}, {4.0, 0.0}, {3.0, 1.0});
  return std::abs(foot.xi - 0.5) < 1e-15;
}

/// The shared layer brings its own third-party libraries: 2 x + y = 5, x + 3 y = 10.
bool linear_solver_is_right() {
  osculate::la::SparseMatrix k;
  k.n = 2;
  k.row_start = {0, 2, 4};
  k.column = {0, 1, 0, 1};
  k.value = {2.0, 1.0, 1.0, 3.0};
  osculate::la::Mumps solver;
  const bool factored = solver.factor(k, 1, osculate::la::Symmetry::unsymmetric).status ==
                        osculate::la::SolveStatus::ok;
  Eigen::VectorXd x(2);
  x << 5.0, 10.0;
  return factored && solver.solve(x) == osculate::la::SolveStatus::ok &&
         (x - Eigen::Vector2d(1.0, 3.0)).norm() < 1e-14;
}

/// The library may use AVX where this program does not: the layout of values must not depend on it.
bool alignment_is_the_same_everywhere() { return alignof(osculate::Mat<2, 2>) == 32; }

/// The contact kernel with plain arrays: a slave facet from (1, -0.01) to (2, -0.01) has sunk 0.01
/// into a master from (0, 0) to (4, 0) and is dragged by 0.001 in stick.
bool contact_evaluator_is_right() {
  using namespace osculate;
  api::ContactOptions options;
  options.normal_penalty = 1000.0;
  options.friction = contact::coulomb(0.5, 1000.0);
  const std::vector<Index> master{0, 1}, slave{3, 2};  // body on the right of travel: above
  std::vector<double> x{0, 0, 4, 0, 1, -0.01, 2, -0.01};
  api::ContactEvaluator contact(options, {2, master}, {2, slave}, x);
  for (const std::size_t node : {2u, 3u}) x[2 * node] += 0.001;
  const api::ContactResult result = contact.evaluate(x, true);
  contact.commit();
  double sum_y = 0, slave_x = 0, slave_y = 0;
  for (std::size_t n = 0; n < 4; ++n) sum_y += result.force[2 * n + 1];
  for (const std::size_t n : {2u, 3u}) {
    slave_x += result.force[2 * n];
    slave_y += result.force[2 * n + 1];
  }
  // pressure 10 on length 1 pushes the slave up (internal force down), friction 1 holds it back
  return std::abs(sum_y) < 1e-12 && std::abs(slave_y + 10.0) < 1e-12 &&
         std::abs(slave_x - 1.0) < 1e-12 && !result.tangent.empty() &&
         result.points.front().status == contact::Status::stick;
}

/// The same in space: a square facet of area 1 has sunk 0.01 into the middle of a larger one.
bool contact_in_space_is_right() {
  using namespace osculate;
  api::ContactOptions options;
  options.normal_penalty = 1000.0;
  const std::vector<Index> master{0, 1, 2, 3}, slave{7, 6, 5, 4};  // normals up and down
  std::vector<double> x{0, 0, 0, 3, 0, 0, 3, 3, 0, 0, 3, 0};
  for (const double v : {1, 1, 2, 1, 2, 2, 1, 2}) {
    x.push_back(v);
    if (x.size() % 3 == 2) x.push_back(-0.01);
  }
  api::ContactEvaluator3 contact(options, {cell::CellType::quad4, master},
                                 {cell::CellType::quad4, slave}, x);
  const api::ContactResult3 result = contact.evaluate(x, true);
  contact.commit();
  double master_z = 0, slave_z = 0;
  for (std::size_t n = 0; n < 8; ++n) (n < 4 ? master_z : slave_z) += result.force[3 * n + 2];
  return std::abs(master_z - 10.0) < 1e-12 && std::abs(slave_z + 10.0) < 1e-12 &&
         result.points.size() == 4 && !result.tangent.empty();
}

/// A host that corrects multipliers around its own solutions: a facet on springs (100 a node) that
/// is pressed by 5 a node into a wall, with a penalty much softer than the springs.
bool host_corrects_multipliers() {
  using namespace osculate;
  api::ContactOptions options;
  options.normal_penalty = 10.0;
  options.enforcement = contact::Enforcement::augmented_lagrange;
  const std::vector<Index> master{0, 1}, slave{3, 2};
  std::vector<double> x{0, 0, 4, 0, 1, 0, 2, 0};
  api::ContactEvaluator contact(options, {2, master}, {2, slave}, x);
  pairing::PairMultipliers<2> multipliers = contact.multipliers();
  double y = 0, force = 0;
  for (int corrections = 0; corrections < 40 && multipliers.violation > 1e-10; ++corrections) {
    for (int i = 0; i < 3; ++i) {  // its Newton iterations; the area of a node is 1/2
      x[5] = x[7] = y;
      force = contact.evaluate(x, false, multipliers).force[5];
      y -= (100.0 * y + 5.0 + force) / (100.0 + 0.5 * 10.0 * multipliers.stiffening);
    }
    multipliers = contact.corrected(multipliers);
  }
  multipliers = contact.commit(multipliers);
  return std::abs(y) < 1e-9 && std::abs(force + 5.0) < 1e-7 &&
         std::abs(multipliers.points[0].normal + 10.0) < 1e-6;
}

/// Closest points with plain arrays, on two threads: above a square and beyond its edge.
bool closest_points_are_right() {
  using namespace osculate;
  const std::vector<Index> square{0, 1, 2, 3};
  const std::vector<double> nodes{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
  const std::vector<api::FacetList3> lists{{cell::CellType::quad4, square}};
  const api::ClosestPoints3 surface(lists, nodes);
  const std::vector<double> points{1, 0.5, 3, 5, 1, 4};
  const api::ClosestPointArrays<3> a = surface.find(points, {projection::Mode::certified, 2});
  return a.feature[0] == projection::Feature::face && std::abs(a.distance[0] - 3.0) < 1e-12 &&
         std::abs(a.xi[1] + 0.5) < 1e-12 && a.feature[1] == projection::Feature::edge &&
         std::abs(a.distance[1] - 5.0) < 1e-12 && std::abs(a.point[3] - 2.0) < 1e-12;
}

}  // namespace

int main() {
  int failed = 0;
  const auto check = [&failed](bool good, const char* what) {
    std::printf("%s: %s\n", good ? "ok" : "FAILED", what);
    failed += good ? 0 : 1;
  };
  check(frame_of_a_circle_is_right(), "frame of a circle");
  check(closest_point_is_right(), "closest point on a segment");
  check(linear_solver_is_right(), "linear solver");
  check(contact_evaluator_is_right(), "contact evaluator");
  check(contact_in_space_is_right(), "contact evaluator in space");
  check(host_corrects_multipliers(), "multipliers that a host corrects");
  check(closest_points_are_right(), "closest points of a surface");
  check(alignment_is_the_same_everywhere(), "alignment of small matrices");
  return failed == 0 ? 0 : 1;
}
