// A stranger's program: plain arrays in, plain numbers out, nothing but the public headers.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "osculate/contact.hpp"

namespace {

using namespace osculate;

/// A slave facet from (1, -0.01) to (2, -0.01) has sunk 0.01 into a master from (0, 0) to (4, 0)
/// and is dragged by 0.001 in stick.
bool contact_in_the_plane_is_right() {
  Contact<2> c;
  c.normal = Penalty{1000};
  c.friction = Coulomb{.mu = 0.5, .stiffness = 1000};
  c.master.facets = {{FacetType::line2, {0, 1}}};  // body on the right of travel: below
  c.slave.emplace().facets = {{FacetType::line2, {3, 2}}};
  std::vector<double> x{0, 0, 4, 0, 1, -0.01, 2, -0.01};
  const Evaluator<2> contact(c, x);
  const History<2> history = contact.initial_history(x);
  for (const std::size_t node : {2u, 3u}) x[2 * node] += 0.001;
  Result<2> r;
  contact.evaluate(x, history, {}, r);
  double sum_y = 0, slave_x = 0, slave_y = 0;
  for (std::size_t n = 0; n < 4; ++n) sum_y += r.force()[2 * n + 1];
  for (const std::size_t n : {2u, 3u}) {
    slave_x += r.force()[2 * n];
    slave_y += r.force()[2 * n + 1];
  }
  // pressure 10 on length 1 pushes the slave up (internal force down), friction 1 holds it back
  return std::abs(sum_y) < 1e-12 && std::abs(slave_y + 10.0) < 1e-12 &&
         std::abs(slave_x - 1.0) < 1e-12 && !r.tangent().empty() &&
         r.points().front().status == Status::stick &&
         contact.history(r.committed().bytes()).size() == 2;
}

/// A square facet of area 1 has sunk 0.01 into the middle of a larger one; at nodes, at Gauss
/// points and by mortar integrals the forces on the master are the same.
bool contact_in_space_is_right() {
  bool good = true;
  for (const Sampling::Rule rule :
       {Sampling::Rule::nodes, Sampling::Rule::gauss, Sampling::Rule::mortar}) {
    Contact<3> c;
    c.normal = Penalty{1000};
    c.sampling.rule = rule;
    c.master.facets = {{FacetType::quad4, {0, 1, 2, 3}}};
    c.slave.emplace().facets = {{FacetType::quad4, {7, 6, 5, 4}}};
    const std::vector<double> x{0, 0, 0,     3, 0, 0,     3, 3, 0,     0, 3, 0,
                                1, 1, -0.01, 2, 1, -0.01, 2, 2, -0.01, 1, 2, -0.01};
    const Evaluator<3> contact(c, x);
    Result<3> r;
    contact.evaluate(x, contact.initial_history(x), {}, r);
    double master_z = 0, slave_z = 0;
    for (std::size_t n = 0; n < 8; ++n) (n < 4 ? master_z : slave_z) += r.force()[3 * n + 2];
    good = good && std::abs(master_z - 10.0) < 1e-12 && std::abs(slave_z + 10.0) < 1e-12;
    const DerivativeCheck check = check_derivative<3>(contact, x, contact.initial_history(x), {},
                                                      contact.initial_multipliers(), 1e-3);
    good = good && check.passed();
  }
  return good;
}

/// A node on top of a rigid ball of radius 2 about the origin of its frame; force and moment on the
/// ball from the forces of the frame's nodes.
bool shape_on_a_frame_is_right() {
  Contact<3> c;
  c.normal = Penalty{50};
  c.weight = Weight::node;
  c.master.framed = {{Sphere{{0, 0, 0}, 2}}, false, {0, 1, 2, 3}};
  c.slave.emplace().points = {4};
  const std::vector<double> x{5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1, 5, 0, 1.9};
  const Evaluator<3> contact(c, x);
  Result<3> r;
  contact.evaluate(x, contact.initial_history(x), {}, r);
  double force_z = 0, moment_y = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    force_z += r.force()[3 * n + 2];
    moment_y += x[3 * n + 2] * r.force()[3 * n] - x[3 * n] * r.force()[3 * n + 2];
  }
  return std::abs(force_z - 5) < 1e-12 && std::abs(moment_y + 25) < 1e-11 &&
         std::abs(r.points()[0].gap + 0.1) < 1e-14;
}

/// A host that corrects multipliers around its own solutions: a facet on springs (100 a node) that
/// is pressed by 5 a node into a wall, with a penalty much softer than the springs.
bool host_corrects_multipliers() {
  Contact<2> c;
  c.normal = Penalty{10};
  c.enforcement = Enforcement::augmented_lagrange;
  c.master.facets = {{FacetType::line2, {0, 1}}};
  c.slave.emplace().facets = {{FacetType::line2, {3, 2}}};
  std::vector<double> x{0, 0, 4, 0, 1, 0, 2, 0};
  const Evaluator<2> contact(c, x);
  const History<2> history = contact.initial_history(x);
  Multipliers<2> m = contact.initial_multipliers();
  Result<2> r;
  double y = 0;
  for (int corrections = 0; corrections < 40 && m.violation > 1e-10; ++corrections) {
    for (int i = 0; i < 3; ++i) {  // its Newton iterations; the area of a node is 1/2
      x[5] = x[7] = y;
      contact.evaluate(x, history, {}, m, r);
      y -= (100.0 * y + 5.0 + r.force()[5]) / (100.0 + 0.5 * 10.0 * m.stiffening);
    }
    m = r.corrected_multipliers();
  }
  m = r.committed_multipliers();
  return std::abs(y) < 1e-9 && std::abs(r.force()[5] + 5.0) < 1e-7 &&
         std::abs(contact.multipliers(contact.bytes(m)).points[0].normal + 10.0) < 1e-6;
}

/// Closest points on two threads: above a square and beyond its edge.
bool closest_points_are_right() {
  const std::vector<Facets> square{{FacetType::quad4, {0, 1, 2, 3}}};
  const std::vector<double> nodes{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
  const ClosestPoints<3> surface(square, nodes);
  const std::vector<double> points{1, 0.5, 3, 5, 1, 4};
  const ClosestPointArrays<3> a = surface.find(points, {ClosestMode::certified, 2});
  return a.feature[0] == Feature::face && std::abs(a.distance[0] - 3.0) < 1e-12 &&
         std::abs(a.xi[1] + 0.5) < 1e-12 && a.feature[1] == Feature::edge &&
         std::abs(a.distance[1] - 5.0) < 1e-12 && std::abs(a.point[3] - 2.0) < 1e-12;
}

bool penalties_are_right() {
  const Layer steel{.young = 210000, .poisson = 0.3, .height = 2};
  return std::abs(automatic_penalties({&steel, 1}, {}).normal - 1050000) < 1e-6;
}

/// What is wrong comes over the library's border as one kind of exception.
bool refusals_are_caught() {
  try {
    (void)Evaluator<2>(Contact<2>{}, std::vector<double>{0, 0});
  } catch (const Refused& error) {
    return std::string(error.what()) == "normal_penalty must be > 0, got 0";
  }
  return false;
}

}  // namespace

int main() {
  int failed = 0;
  const auto check = [&failed](bool good, const char* what) {
    std::printf("%s: %s\n", good ? "ok" : "FAILED", what);
    failed += good ? 0 : 1;
  };
  std::printf("Osculate %s\n", std::string(library_version()).c_str());
  check(contact_in_the_plane_is_right(), "contact in the plane");
  check(contact_in_space_is_right(), "contact in space at nodes, at Gauss points, by mortar");
  check(shape_on_a_frame_is_right(), "a shape on a frame");
  check(host_corrects_multipliers(), "multipliers that a host corrects");
  check(closest_points_are_right(), "closest points of a surface");
  check(penalties_are_right(), "automatic penalties");
  check(refusals_are_caught(), "refusals");
  return failed == 0 ? 0 : 1;
}
