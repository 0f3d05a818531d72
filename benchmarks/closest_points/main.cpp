// Closest points of the same queries by Osculate, OpenCASCADE (NURBS patches) and CGAL (triangle
// meshes), one thread each, in one run. Prints microseconds a query and the ratios.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <string>

#include "../../tests/support/sample_targets.hpp"
#include "osculate/projection/projector.hpp"
#include "peers.hpp"

double benchmark::now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

namespace {

using benchmark::Answers;
using osculate::Vec2;
using osculate::Vec3;
using osculate::geometry::NurbsPatch;
using osculate::projection::FacetMesh;
using osculate::projection::Mode;
using osculate::projection::Projector;

/// Wavy patch over the unit square.
NurbsPatch wavy(int degree, int spans, bool rational) {
  NurbsPatch patch;
  patch.degree = {degree, degree};
  std::vector<double> knots(static_cast<std::size_t>(degree + 1), 0.0);
  for (int k = 1; k < spans; ++k) knots.push_back(static_cast<double>(k) / spans);
  knots.insert(knots.end(), static_cast<std::size_t>(degree + 1), 1.0);
  patch.knots = {knots, knots};
  const int n = degree + spans;
  patch.count = {n, n};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = static_cast<double>(i) / (n - 1), y = static_cast<double>(j) / (n - 1);
      patch.control.push_back({x, y, 0.15 * std::sin(7 * x + 1) * std::cos(5 * y)});
      patch.weights.push_back(rational ? 1 + 0.3 * std::sin(3.0 * i + 5.0 * j) : 1.0);
    }
  return patch;
}

/// Points over the inside of the patch, up to `height` off it along its normal.
std::vector<Vec3> near_patch(const NurbsPatch& patch, int count, double height) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> inside(0.02, 0.98), off(-height, height);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const auto j = patch.jet(Vec2(inside(generator), inside(generator)));
    const Vec3 a = j.r1[0], b = j.r1[1];
    const Vec3 n(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    points.push_back(j.r + off(generator) * n.normalized());
  }
  return points;
}

/// The unit sphere with bumps.
FacetMesh<3> sphere(int n) {
  FacetMesh<3> mesh = osculate::testing::sphere_mesh(n);
  for (Vec3& p : mesh.nodes) p *= 1 + 0.05 * std::sin(9 * p[0] + 2) * std::cos(8 * p[1]);
  return mesh;
}

/// Points in the shell between radius lo and hi.
std::vector<Vec3> in_shell(int count, double lo, double hi) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> u(-1, 1), radius(lo, hi);
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec3 p(u(generator), u(generator), u(generator));
    if (p.norm() > 1 || p.norm() < 0.1) continue;
    points.push_back(radius(generator) * p.normalized());
  }
  return points;
}

Answers with_osculate(const Projector<3>& projector, std::span<const Vec3> points, Mode mode) {
  Answers out;
  const double start = benchmark::now();
  for (const Vec3& p : points)
    out.distance.push_back(std::abs(projector.closest(p, mode).distance));
  out.seconds = benchmark::now() - start;
  return out;
}

/// Answers of `a` that are farther than those of `b` by more than 1e-9, or missing.
int worse(const Answers& a, const Answers& b) {
  int count = 0;
  for (std::size_t k = 0; k < a.distance.size(); ++k)
    if (!(a.distance[k] <= b.distance[k] + 1e-9)) ++count;
  return count;
}

/// Runs every program three times in turn; the median of each.
template <class Run>
std::vector<Answers> in_turn(const std::vector<Run>& runs) {
  std::vector<std::vector<Answers>> all(runs.size());
  for (int turn = 0; turn < 3; ++turn)
    for (std::size_t k = 0; k < runs.size(); ++k) all[k].push_back(runs[k]());
  std::vector<Answers> median;
  for (auto& of_one : all) {
    std::sort(of_one.begin(), of_one.end(),
              [](const Answers& a, const Answers& b) { return a.seconds < b.seconds; });
    median.push_back(of_one[1]);
  }
  return median;
}

void print_row(const char* name, const std::vector<Answers>& a, std::size_t queries) {
  const auto us = [&](std::size_t k) { return 1e6 * a[k].seconds / static_cast<double>(queries); };
  std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.1f | %.1f | %.1f | %d | %d | %d |\n", name,
              us(0), us(1), us(2), us(3), us(3) / us(0), us(3) / us(1), us(3) / us(2),
              worse(a[0], a[2]), worse(a[3], a[2]), worse(a[2], a[3]));
  std::fflush(stdout);
}

constexpr const char* header =
    "| %s | fast | nearest | certified | %s | ratio fast | nearest | certified | fast worse | peer "
    "worse | certified worse |\n|---|---|---|---|---|---|---|---|---|---|---|\n";

void patches(int count) {
  std::printf(header, "NURBS patch", "OpenCASCADE");
  struct Sample {
    const char* name;
    int degree, spans;
    bool rational;
    double height;
  };
  for (const Sample& s : {Sample{"bicubic, 4 x 4 spans", 3, 4, false, 0.05},
                          Sample{"bicubic, 10 x 10 spans", 3, 10, false, 0.05},
                          Sample{"bicubic, 10 x 10 spans, far points", 3, 10, false, 0.5},
                          Sample{"rational biquadratic, 8 x 8 spans", 2, 8, true, 0.05},
                          Sample{"rational bicubic, 40 x 40 spans", 3, 40, true, 0.02}}) {
    const NurbsPatch patch = wavy(s.degree, s.spans, s.rational);
    const std::vector<Vec3> points = near_patch(patch, count, s.height);
    const Projector<3> projector{
        osculate::projection::Target<3>(osculate::projection::Shape<3>(patch))};
    const std::vector<std::function<Answers()>> runs{
        [&] { return with_osculate(projector, points, Mode::fast); },
        [&] { return with_osculate(projector, points, Mode::nearest); },
        [&] { return with_osculate(projector, points, Mode::certified); },
        [&] { return benchmark::with_opencascade(patch, points); }};
    print_row(s.name, in_turn(runs), points.size());
  }
}

void meshes(int count) {
  std::printf(header, "triangles", "CGAL");
  for (const int n : {11, 35, 112, 354}) {
    const FacetMesh<3> mesh = sphere(n);
    const Projector<3> projector{osculate::projection::Target<3>(mesh)};
    for (const bool close : {true, false}) {
      const std::vector<Vec3> points = close ? in_shell(count, 0.9, 1.1) : in_shell(count, 0.2, 2);
      const std::vector<std::function<Answers()>> runs{
          [&] { return with_osculate(projector, points, Mode::fast); },
          [&] { return with_osculate(projector, points, Mode::nearest); },
          [&] { return with_osculate(projector, points, Mode::certified); },
          [&] { return benchmark::with_cgal(mesh, points); }};
      const std::string name = std::to_string(mesh.facets.size()) +
                               (close ? ", within 10 % of the surface" : ", radius 0.2 to 2");
      print_row(name.c_str(), in_turn(runs), points.size());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 20000;
  std::printf(
      "Microseconds of processor time a query, %d queries, one thread; ratios above 1: Osculate is "
      "faster.\n",
      count);
  patches(count);
  meshes(count);
  return 0;
}
