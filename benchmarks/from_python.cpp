// The calls of from_python.py in C++: prints seconds of the processor for each, and a sum of what
// came out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <vector>

#include "osculate/contact.hpp"

namespace {

using namespace osculate;  // NOLINT(google-build-using-namespace)

double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void evaluate(int side, int times) {
  std::vector<double> x{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double a = -0.5 + i / (side - 1.0), b = -0.5 + j / (side - 1.0);
      x.insert(x.end(), {a, b, std::sqrt(4 - a * a - b * b) - 0.001});
    }
  Contact<3> c;
  c.master.framed = {{Sphere{{0, 0, 0}, 2}}, false, {0, 1, 2, 3}};
  c.slave.emplace();
  std::vector<Index> nodes;
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      const int n = 4 + i * side + j;
      nodes.insert(nodes.end(), {n, n + 1, n + side + 1, n + side});
    }
  c.slave->facets = {{FacetType::quad4, nodes}};
  c.normal = NamedLaw{"penalty", {{"penalty", 1e4}}};
  c.friction = NamedLaw{"coulomb", {{"mu", 0.3}, {"penalty", 1e4}}};
  const Evaluator<3> contact(c, x);
  const History<3> history = contact.initial_history(x);
  for (std::size_t i = 12; i < x.size(); i += 3) x[i] += 1e-4;
  for (int k = 0; k < times; ++k) {
    const double began = now();
    Result<3> result;
    contact.evaluate(x, history, {}, result);
    const auto points = result.points();
    const ActiveSet<3> next = result.next_active_set();
    const double seconds = now() - began;
    const auto force = result.force();
    std::printf("evaluate %.9f %.17g %zu\n", seconds,
                std::accumulate(force.begin(), force.end(), 0.0),
                points.size() + result.tangent().size());
  }
}

void closest(std::size_t count, int times) {
  std::vector<double> points(3 * count);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = 6 * std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) - 3;
  const ClosestPoints<3> torus(Torus{{0, 0, 0}, {0, 0, 1}, 2, 0.5});
  for (int k = 0; k < times; ++k) {
    const double began = now();
    const ClosestPointArrays<3> found = torus.find(points);
    const double seconds = now() - began;
    std::printf("closest %.9f %.17g %zu\n", seconds,
                std::accumulate(found.distance.begin(), found.distance.end(), 0.0),
                found.status.size());
  }
}

}  // namespace

int main(int, char** argv) {
  evaluate(std::atoi(argv[1]), std::atoi(argv[2]));
  closest(
      static_cast<std::size_t>(std::atoi(argv[1])) * static_cast<std::size_t>(std::atoi(argv[1])),
      std::atoi(argv[2]));
}
