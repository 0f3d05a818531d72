#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../run_space.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {
namespace {

constexpr double side = 0.6, length = 4, penalty = 1000;
constexpr int along = 7, across = 2;
const double ridge = side / std::numbers::sqrt2;  // height of the upper edge over the rod's axis

/// Two square rods with an edge up: the lower one lies along x, the upper one is turned and lifted.
struct Rods {
  double angle = 90, tilt = 0;  ///< of the upper rod, about z and before that about y [degrees]
  double depth = 0.02;  ///< that its lower edge is below the upper edge of the other, at x = 0
  Mat<3, 3> turn = Mat<3, 3>::Identity();  ///< of everything
  bool edges = true, elastic = false;
};

Mat<3, 3> pose(const Rods& r) {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(r.angle * degree, Vec3::UnitZ()) *
          Eigen::AngleAxisd(r.tilt * degree, Vec3::UnitY()))
      .toRotationMatrix();
}

std::string model_text(const Rods& r) {
  const std::string box = fmt::format(
      "{{box: {{x: [-2, 2], y: [-0.3, 0.3], z: [-0.3, 0.3], elements: [{0}, {1}, {1}], angle: 45, "
      "axis: [1, 0, 0], about: [0, 0, 0]}}}}",
      along, across);
  std::string held;
  for (const char* body : {"low", "up"})
    for (const char* set : {"bottom", "top", "front", "back"})
      held += fmt::format("{{on: {}.{}, ux: 0, uy: 0, uz: 0}}, ", body, set);
  const std::string ends =
      "{on: low.left, ux: 0, uy: 0, uz: 0}, {on: low.right, ux: 0, uy: 0, uz: 0}, {on: up.left, "
      "ux: 0, uy: 0, uz: -0.05}, {on: up.right, ux: 0, uy: 0, uz: -0.05}, ";
  return fmt::format(R"(osculate: 1
title: Two rods edge_contact on their edges
mesh: {{generate: {{low: {0}, up: {0}}}}}
materials: {{s: {{linear_elastic: {{E: 1000, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: solid}}, {{on: up, material: s, element: solid}}]
contact: [{{name: c, master: low, slave: up, normal: {{penalty: {1}}}, edges: {2}, search: {{depth: 0.3}}}}]
steps: [{{name: s, increments: 1, prescribe: [{3}]}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                     box, penalty, r.edges ? "true" : "false",
                     (r.elastic ? ends : held).substr(0, (r.elastic ? ends : held).size() - 2));
}

struct Found {
  bool converged = false;
  Vec3 force = Vec3::Zero();  ///< on the upper rod
  double support = 0;         ///< vertical force of the lower rod's supports
  double law = 0;             ///< penalty times area times penetration of the crossing
  double normal_force = 0;
};

Found solve_rods(const Rods& r, const Workers& workers) {
  Found out;
  const auto place = [&](mesh::Mesh& m) {
    std::vector<bool> upper(m.nodes.size(), false);
    for (const Index n : m.find_set("up")->nodes) upper[static_cast<std::size_t>(n)] = true;
    const Vec3 lift(0, 0, 2 * ridge - r.depth);
    for (std::size_t n = 0; n < m.nodes.size(); ++n) {
      if (upper[n]) {
        const Vec3 below(0, 0, -ridge);  // the upper rod turns about a point of its lower edge
        m.nodes[n] = below + pose(r) * (m.nodes[n] - below) + lift;
      }
      m.nodes[n] = r.turn * m.nodes[n];
    }
  };
  const auto look = [&](const Snapshot3& s) {
    if (!s.record) return;
    using Kind = model::HistoryRequest::Kind;
    const auto value = [&](Kind kind, const std::vector<Index>& nodes, const char* quantity) {
      return model::history_value(s.system, s.model, s.state, {"", kind, 0, nodes, quantity});
    };
    out.force = {value(Kind::pair, {}, "force_x"), value(Kind::pair, {}, "force_y"),
                 value(Kind::pair, {}, "force_z")};
    out.normal_force = value(Kind::pair, {}, "normal_force");
    for (const char* set : {"low.left", "low.right"})
      out.support += value(Kind::nodes, s.model.mesh.find_set(set)->nodes, "rfz");
    for (const auto& point : s.system.contact()[0].points)
      if (point.history.edge >= 0) out.law -= penalty * point.weight * point.gap;
  };
  const model::AnalysisResult3 result = run_text3(model_text(r), workers, look, {place, {}});
  out.converged = result.outcome == solve::Outcome::converged;
  return out;
}

/// Penalty times area times distance of the two edges, along their common perpendicular. The area
/// is that of a node on the edge: a quarter of each of the four faces around it.
Vec3 closed_form(const Rods& r) {
  const Vec3 lower = Vec3::UnitX(), upper = pose(r) * Vec3::UnitX();
  Vec3 normal = lower.cross(upper).normalized();
  if (normal.z() < 0) normal = -normal;
  const double gap = -r.depth * normal.z();
  const double area = length / along * side / across;
  return -penalty * area * gap * (r.turn * normal);
}

}  // namespace

CaseResult crossed_edges(const CaseContext& context) {
  CaseResult out;
  const Mat<3, 3> turn = Eigen::AngleAxisd(2.1, Vec3(1, -0.4, 0.7).normalized()).toRotationMatrix();
  const auto held_rods = {Rods{90, 0}, Rods{60, 10}, Rods{30, -15}};
  for (const Rods& upright : held_rods)
    for (const bool turned : {false, true}) {
      Rods r = upright;
      if (turned) r.turn = turn;
      const Found found = solve_rods(r, context.workers);
      const Vec3 expected = closed_form(r);
      const double error = found.converged ? (found.force - expected).norm() / expected.norm() : 1;
      out.rows.push_back(
          {fmt::format("rods at {:g} degrees, tilt {:g}{}: error of the force vector", r.angle,
                       r.tilt, turned ? ", everything turned" : ""),
           error, 1e-10, Relation::at_most, 0, "closed form"});
    }
  Rods elastic;
  elastic.elastic = true;
  elastic.depth = 0;
  const Found found = solve_rods(elastic, context.workers);
  const double force = found.converged ? found.force.z() : 0;
  out.rows.push_back({"elastic rods bent over each other: force on the supports / contact force",
                      found.support / force, 1, Relation::equal, 1e-8, "equilibrium"});
  out.rows.push_back({"elastic rods: penalty times area times penetration / contact force",
                      found.law / found.normal_force, 1, Relation::equal, 1e-10, "closed form"});
  out.rows.push_back({"elastic rods: contact force", force, 0, Relation::info, 0, ""});
  elastic.edges = false;
  const Found nodes = solve_rods(elastic, context.workers);
  out.rows.push_back({"elastic rods without edges: contact force (the nodes see nothing)",
                      nodes.converged ? nodes.force.norm() : 1, 0, Relation::info, 0, ""});
  return out;
}

}  // namespace osculate::verification
