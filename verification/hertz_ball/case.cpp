#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../cases.hpp"
#include "../graded.hpp"
#include "../run_space.hpp"
#include "disc_mesh.hpp"
#include "osculate/cell/quadrature.hpp"

namespace osculate::verification {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double young = 1.0, poisson = 0.3, radius = 1000.0, contact_radius = 1.0;
constexpr double modulus = young / (1 - poisson * poisson);
constexpr double approach = contact_radius * contact_radius / radius;
constexpr double far = 6.0;  ///< size of the quarter block in contact radii
/// Hertz's force of the whole contact at that approach.
const double hertz_force = 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(approach, 1.5);

/// How the block is meshed: `fine` cells over the contact radius, then growing. With radii, the
/// layers of cells follow circles of these radii up to the contact radius; without, it is a box.
struct Mesh {
  std::string name;
  int fine = 3;
  std::string type = "hex27";
  std::vector<double> radii;
  int around = 1;

  [[nodiscard]] double first() const {  ///< size of the cells at the edge of the contact
    const std::size_t n = radii.size();
    return n < 2 ? contact_radius / fine : radii[n - 1] - radii[n - 2];
  }
  [[nodiscard]] bool at_far_side(const Vec3& x) const {
    const double across = radii.empty() ? std::max(x.x(), x.y()) : std::hypot(x.x(), x.y());
    return std::max(across, -x.z()) > far * (1 - 1e-9);
  }
};

constexpr double growth = 1.6;

/// The block of a box of cells (a disc takes its place, see `disc_of`).
std::string model_text(const Mesh& m) {
  const double h = contact_radius / m.fine, wide = (1 + 1.0 / 3) * contact_radius;
  const GradedRow r = graded_row(h, far - wide, growth);
  const GradedRow z = graded_row(h, far - contact_radius / 3, growth);
  const int across = m.fine + m.fine / 3, down = m.fine / 3;
  return fmt::format(R"(osculate: 1
title: A rigid ball on a quarter of a half-space
mesh: {{generate: {{body: {{box: {{x: [0, {0}, {1}], y: [0, {0}, {1}], z: [-{1}, -{2}, 0],
  elements: [[{3}, {4}], [{3}, {4}], [{5}, {6}]], bias: [[1, {7:.15g}], [1, {7:.15g}], [{8:.15g}, 1]],
  type: {9}}}}}}}}}
materials: {{s: {{linear_elastic: {{E: {10}, nu: {11}}}}}}}
sections: [{{on: body, material: s, element: solid}}]
rigid: {{ball: {{sphere: {{center: [0, 0, {14}], radius: {14}}}}}}}
contact: [{{name: c, master: ball, slave: body.top, normal: {{penalty: {12}}}}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: ball, uz: {13:.15g}}},
  {{on: body.left, ux: 0}}, {{on: body.front, uy: 0}}]}}]
)",
                     wide, far, contact_radius / 3, across, r.elements, z.elements, down, r.bias,
                     1 / z.bias, m.type, young, poisson, 1e3 * young / m.first(), -approach,
                     radius);
}

/// Appends lengths that grow from `first` until `far` is reached.
void grow(std::vector<double>& to, double first) {
  const GradedRow row = graded_row(first, far - to.back(), growth);
  const double ratio = row.elements > 1 ? std::pow(row.bias, 1.0 / (row.elements - 1)) : 1.0;
  const double begin = to.back();
  double sum = 0, all = 0, length = 1;
  for (int i = 0; i < row.elements; ++i, length *= ratio) all += length;
  length = 1;
  for (int i = 0; i < row.elements; ++i, length *= ratio) {
    sum += length;
    to.push_back(begin + (far - begin) * sum / all);
  }
}

Disc disc_of(const Mesh& m) {
  Disc disc{m.radii, m.around, {0}};
  grow(disc.radii, m.first() * growth);
  grow(disc.depths, m.first());
  return disc;
}

/// Displacement of the half-space z < 0 under the force P at the origin towards -z: what Hertz's
/// solution tends to far away (Boussinesq; Johnson 1985, 3.4).
Vec3 far_displacement(const Vec3& x, double force) {
  const double distance = x.norm(), depth = -x.z(), r = std::hypot(x.x(), x.y());
  const double scale = (1 + poisson) * force / (2 * pi * young);
  const double radial = scale * (r * depth / std::pow(distance, 3) -
                                 (1 - 2 * poisson) * r / (distance * (distance + depth)));
  const double down =
      scale * (depth * depth / std::pow(distance, 3) + 2 * (1 - poisson) / distance);
  return {r > 0 ? radial * x.x() / r : 0.0, r > 0 ? radial * x.y() / r : 0.0, -down};
}

/// The far field on the far sides.
void add_far_field(const Mesh& mesh, deck::Built3& built) {
  model::Model3& m = built.model;
  for (Index n = 0; n < static_cast<Index>(m.mesh.nodes.size()); ++n) {
    const Vec3& x = m.reference[static_cast<std::size_t>(n)];
    if (!mesh.at_far_side(x)) continue;
    const Vec3 u = far_displacement(x, hertz_force);
    for (int d = 0; d < 3; ++d) {
      if (d < 2 && x[d] < 1e-9) continue;  // held by symmetry
      m.steps[0].prescribed.push_back({3 * n + d, {0, u[d], {}}, false});
    }
  }
}

/// What one mesh gives, against the profile that belongs to the computed force.
struct Hertz {
  double l2 = 0, nodal = 0, sampled = 0, peak = 0, force = 0, radius = 0;
  Curve curve;
};

double hertz_pressure(double r, double a, double p0) {
  return r < a ? p0 * std::sqrt(1 - r * r / (a * a)) : 0.0;
}

/// int (p_h - p)^2 and int p^2 over the slave faces near the contact, p_h = sum N_k p_k; each face
/// is cut in 10 x 10 pieces, for the profile has a root at the edge.
struct Norms {
  double error = 0, size = 0;
};
template <class Pressure>
Norms norms(const Snapshot3& s, double a, double p0, const Pressure& nodal) {
  const pairing::SlaveSide<3>& slave = s.model.pairs[0].definition.slave;
  const cell::Quadrature1D gauss = cell::gauss_legendre(3);
  constexpr int cuts = 10;
  Norms out;
  for (const pairing::SurfaceFacet& facet : slave.boundary.facets) {
    if (s.model.reference[static_cast<std::size_t>(facet.nodes[0])].norm() > 2 * a) continue;
    for (int q = 0; q < cuts * cuts * 9; ++q) {
      const int i = q % 9, cut = q / 9;
      const auto u = static_cast<std::size_t>(i % 3), v = static_cast<std::size_t>(i / 3);
      const Vec2 xi((2 * (cut % cuts) + 1 + gauss.points[u]) / cuts - 1,
                    (2 * (cut / cuts) + 1 + gauss.points[v]) / cuts - 1);
      const cell::FacetShape shape = cell::facet_shape(facet.type, xi);
      const geometry::SurfaceJet jet = pairing::facet_jet(facet, shape, s.model.reference);
      const double weight = gauss.weights[u] * gauss.weights[v] * jet.r1[0].cross(jet.r1[1]).norm();
      double p = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k)
        p += shape.n[0][k] * nodal(facet.nodes[k]);
      const double exact = hertz_pressure(std::hypot(jet.r.x(), jet.r.y()), a, p0);
      out.error += weight * (p - exact) * (p - exact);
      out.size += weight * exact * exact;
    }
  }
  return out;
}

/// Where the straight line through the points by least squares meets zero.
double zero_of_line(const std::vector<Vec2>& points) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / static_cast<double>(points.size());
  double slope = 0, spread = 0;
  for (const Vec2& p : points) {
    slope += (p.x() - mean.x()) * (p.y() - mean.y());
    spread += (p.x() - mean.x()) * (p.x() - mean.x());
  }
  return mean.x() - mean.y() * spread / slope;
}

Hertz run_mesh(const Mesh& mesh, const Workers& workers) {
  Hertz out;
  out.curve = {mesh.name, {"r", "pressure", "hertz"}, {}};
  const auto look = [&](const Snapshot3& s) {
    if (!s.record) return;
    const auto& points = s.system.contact()[0].points;
    const auto& nodes = s.model.pairs[0].definition.slave.nodes;
    std::vector<double> pressure(s.model.reference.size(), 0.0);
    double force = 0, peak = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      force -= 4 * points[k].weight * points[k].normal_traction;
      pressure[static_cast<std::size_t>(nodes[k])] = -points[k].normal_traction;
      peak = std::max(peak, -points[k].normal_traction);
    }
    const double a = std::cbrt(3 * force * radius / (4 * modulus));
    const double p0 = 3 * force / (2 * pi * a * a);
    const Norms computed =
        norms(s, a, p0, [&](Index n) { return pressure[static_cast<std::size_t>(n)]; });
    const Norms sampled = norms(s, a, p0, [&](Index n) {
      return hertz_pressure(s.model.reference[static_cast<std::size_t>(n)].norm(), a, p0);
    });
    double difference = 0, square = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double r = s.model.reference[static_cast<std::size_t>(nodes[k])].norm();
      const double exact = hertz_pressure(r, a, p0);
      difference += points[k].weight * std::pow(-points[k].normal_traction - exact, 2);
      square += points[k].weight * exact * exact;
    }
    out.nodal = std::sqrt(difference / square);
    out.l2 = std::sqrt(computed.error / computed.size);
    out.sampled = std::sqrt(sampled.error / sampled.size);
    out.peak = peak / p0;
    out.force = force / hertz_force;
    std::vector<Vec2> line;  // p^2 is a straight line in r^2, with the zero at a
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double r = s.model.reference[static_cast<std::size_t>(nodes[k])].norm();
      const double p = -points[k].normal_traction;
      if (r < 0.9 * a) line.emplace_back(r * r, p * p);
      if (r < 1.5 * a) out.curve.rows.push_back({r / a, p / p0, hertz_pressure(r, a, p0) / p0});
    }
    out.radius = std::sqrt(zero_of_line(line)) / a;
    std::sort(out.curve.rows.begin(), out.curve.rows.end());
  };
  Edits3 edits;
  edits.model = [&](deck::Built3& built) { add_far_field(mesh, built); };
  if (!mesh.radii.empty()) edits.mesh = [&](mesh::Mesh& m) { m = DiscMesh(disc_of(mesh)).take(); };
  const model::AnalysisResult3 result = run_text3(model_text(mesh), workers, look, edits);
  if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
  return out;
}

constexpr const char* source = "Johnson 1985, 4.2(a)";

void add(CaseResult& out, std::string quantity, double computed, double reference,
         Relation relation, double tolerance) {
  out.rows.push_back({std::move(quantity), computed, reference, relation, tolerance, source});
}

/// What must hold with three cells over the radius.
void add_checks(const Mesh& mesh, const Hertz& h, CaseResult& out) {
  using enum Relation;
  add(out, mesh.name + ": force / (4/3 E* sqrt(R) d^1.5)", h.force, 1, equal, 0.01);
  add(out, mesh.name + ": peak pressure / (3F / 2 pi a^2)", h.peak, 1, equal, 0.03);
  add(out, mesh.name + ": contact radius / a", h.radius, 1, equal, 0.03);
}

void add_numbers(const Mesh& mesh, const Hertz& h, CaseResult& out) {
  using enum Relation;
  add(out, mesh.name + ": pressure L2 error, faces", h.l2, 0, info, 0);
  add(out, mesh.name + ": pressure L2 error, Hertz's values at the nodes", h.sampled, 0, info, 0);
  add(out, mesh.name + ": pressure L2 error, nodes", h.nodal, 0, info, 0);
}

Picture profile(const std::vector<Curve>& curves) {
  Picture picture{"pressure", {}};
  io::LinePlot& plot = picture.plot;
  plot.title = "Ball on a half-space, 3 cells over the contact radius";
  plot.x = {"r / a", false, {}};
  plot.y = {"p / p0", false, {}};
  plot.curves.push_back({"Hertz", {}, {}, io::PlotStyle::line});
  for (int i = 0; i <= 150; ++i) {
    plot.curves[0].x.push_back(0.01 * i);
    plot.curves[0].y.push_back(hertz_pressure(0.01 * i, 1, 1));
  }
  for (const Curve& curve : curves) {
    plot.curves.push_back({curve.name, {}, {}, io::PlotStyle::marks});
    for (const std::vector<double>& row : curve.rows) {
      plot.curves.back().x.push_back(row[0]);
      plot.curves.back().y.push_back(row[1]);
    }
  }
  return picture;
}

}  // namespace

CaseResult hertz_ball(const CaseContext& context) {
  using enum Relation;
  CaseResult out;
  const Mesh equal_cells{"hex27, 3 equal cells", 3, "hex27", {}};
  const Mesh graded{"hex27, 3 cells to 0.55, 0.88, 1", 3, "hex27", {0.55, 0.88, 1}};
  const Mesh halved{"hex27, 6 cells, those halved", 6, "hex27", {0.55, 0.715, 0.88, 0.94, 1}, 2};

  const Hertz h = run_mesh(equal_cells, context.workers);
  add(out, equal_cells.name + ": pressure L2 error, nodes", h.nodal, 0.035, at_most, 0);
  add(out, equal_cells.name + ": pressure L2 error, faces, against Hertz's values at the nodes",
      h.l2, h.sampled, at_most, 0);
  add_checks(equal_cells, h, out);

  const Hertz g = run_mesh(graded, context.workers);
  add(out, graded.name + ": pressure L2 error, faces", g.l2, 0.035, at_most, 0);
  add(out, graded.name + ": pressure L2 error, nodes", g.nodal, 0.035, at_most, 0);
  add_checks(graded, g, out);

  const Hertz f = run_mesh(halved, context.workers);
  add_numbers(halved, f, out);
  add(out, "graded: convergence rate from 3 to 6 cells, faces", std::log2(g.l2 / f.l2), 1, info, 0);
  for (const Mesh& mesh :
       {Mesh{"hex8, 3 equal cells", 3, "hex8", {}}, Mesh{"hex8, 6 equal cells", 6, "hex8", {}},
        Mesh{"hex20, 3 equal cells", 3, "hex20", {}},
        Mesh{"hex27, 3 equal rings", 3, "hex27", {1.0 / 3, 2.0 / 3, 1}}})
    add_numbers(mesh, run_mesh(mesh, context.workers), out);
  out.curves = {h.curve, g.curve};
  out.pictures.push_back(profile(out.curves));
  out.curves[0].name = "pressure_equal";
  out.curves[1].name = "pressure_graded";
  return out;
}

}  // namespace osculate::verification
