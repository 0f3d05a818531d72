#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../cases.hpp"
#include "../run_space.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::verification {
namespace {

constexpr double width = 3, penalty = 1000;
constexpr const char* source = "uniform stress";

/// Two blocks on a common square under the pressure 1, their sides held by rollers or free.
struct Patch {
  std::string lower_type = "hex8", upper_type = "hex8", formulation = "full";
  int lower = 3, upper = 3;                     ///< cells along each side of the square
  double lower_swirl = 0.4, upper_swirl = 0.4;  ///< how far the meshes are turned in the middle
  bool upper_is_slave = true, confined = false;
  std::string sampling = "nodes";
};

std::string model_text(const Patch& p) {
  const auto formulation = [&](const std::string& type) {
    return type == "hex8" ? p.formulation : std::string("full");
  };
  return fmt::format(R"(osculate: 1
title: Contact patch test in space
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [0, 3], z: [0, 1], elements: [{0}, {0}, 2], type: {1}}}}}
    up: {{box: {{x: [0, 3], y: [0, 3], z: [1, 2], elements: [{2}, {2}, 2], type: {3}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: solid, formulation: {4}}},
  {{on: up, material: s, element: solid, formulation: {5}}}]
contact: [{{name: c, master: {6}, slave: {7}, sampling: {10}, normal: {{penalty: {8}}}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: up.top, value: 1}}],
  prescribe: [{{on: low.bottom, uz: 0}}, {{on: low.left, ux: 0}}, {{on: up.left, ux: 0}},
  {{on: low.front, uy: 0}}, {{on: up.front, uy: 0}}{9}]}}]
solver: {{tolerance: {{residual: 1.0e-13}}}}
)",
                     p.lower, p.lower_type, p.upper, p.upper_type, formulation(p.lower_type),
                     formulation(p.upper_type), p.upper_is_slave ? "low.top" : "up.bottom",
                     p.upper_is_slave ? "up.bottom" : "low.top", penalty,
                     p.confined ? ", {on: low.right, ux: 0}, {on: up.right, ux: 0}, {on: low.back, "
                                  "uy: 0}, {on: up.back, uy: 0}"
                                : "",
                     p.sampling);
}

/// Turns the square's inside about its centre by an angle that vanishes on the sides.
Vec3 swirled(const Vec3& x, double angle) {
  const double a = 2 * x.x() / width - 1, b = 2 * x.y() / width - 1;
  const double turn = angle * (1 - a * a) * (1 - b * b), c = std::cos(turn), s = std::sin(turn);
  return {0.5 * width * (1 + c * a - s * b), 0.5 * width * (1 + s * a + c * b), x.z()};
}

cell::CellType straight_type(cell::CellType type) {
  switch (type) {
    case cell::CellType::hex20:
    case cell::CellType::hex27:
      return cell::CellType::hex8;
    case cell::CellType::tet10:
      return cell::CellType::tet4;
    case cell::CellType::wedge15:
      return cell::CellType::wedge6;
    default:
      return type;
  }
}

/// Makes the meshes irregular; edges stay straight, with further nodes in their middles.
void distort(const Patch& p, mesh::Mesh& m) {
  std::vector<bool> upper(m.nodes.size(), false);
  for (const Index n : m.find_set("up")->nodes) upper[static_cast<std::size_t>(n)] = true;
  for (std::size_t n = 0; n < m.nodes.size(); ++n)
    m.nodes[n] = swirled(m.nodes[n], upper[n] ? p.upper_swirl : p.lower_swirl);
  for (const mesh::Block& block : m.blocks) {
    const cell::CellInfo& info = cell::info(block.type);
    if (info.dimension != 3) continue;
    const cell::CellType straight = straight_type(block.type);
    for (Index c = 0; c < block.size(); ++c)
      for (int k = info.corners; k < info.nodes; ++k) {
        const cell::VolumeShape shape =
            cell::volume_shape(straight, cell::volume_node(block.type, k));
        Vec3 x = Vec3::Zero();
        for (int l = 0; l < info.corners; ++l)
          x += shape.n[l] * m.nodes[static_cast<std::size_t>(block.cell(c)[l])];
        m.nodes[static_cast<std::size_t>(block.cell(c)[k])] = x;
      }
  }
}

struct Errors {
  bool converged = false;
  double pressure = 1;  ///< largest deviation of a contact pressure from 1
  double stress = 1;    ///< largest deviation of a nodal stress from the uniform state
  double balance = 1;   ///< forces of the pair and of the support against the load
};

Errors patch_errors(const Patch& p, const Workers& workers) {
  Errors out;
  const auto look = [&](const Snapshot3& s) {
    if (!s.record) return;
    out = {true, 0, 0, 0};
    for (const auto& point : s.system.contact()[0].points)
      out.pressure = std::max(out.pressure, std::abs(-point.normal_traction - 1));
    const double lateral = p.confined ? -0.3 / 0.7 : 0;
    const model::NodalFields3 f = model::nodal_fields(s.system, s.model, s.state);
    for (const auto& stress : f.stress)
      for (std::size_t i = 0; i < stress.size(); ++i)
        out.stress = std::max(out.stress, std::abs(stress[i] - (i == 2  ? -1.0
                                                                : i < 2 ? lateral
                                                                        : 0.0)));
    using Kind = model::HistoryRequest::Kind;
    const double load = width * width;
    const auto value = [&](Kind kind, const std::vector<Index>& nodes, const char* quantity) {
      return model::history_value(s.system, s.model, s.state, {"", kind, 0, nodes, quantity});
    };
    const double on_upper = (p.upper_is_slave ? 1 : -1) * value(Kind::pair, {}, "force_z");
    const double support = value(Kind::nodes, s.model.mesh.find_set("low.bottom")->nodes, "rfz");
    out.balance = std::max(std::abs(on_upper - load), std::abs(support - load)) / load;
    for (int d = 0; d < 3; ++d) {
      double sum = 0;
      for (std::size_t n = 0; n < s.model.reference.size(); ++n)
        sum += s.system.forces().contact[3 * static_cast<Index>(n) + d];
      out.balance = std::max(out.balance, std::abs(sum) / load);
    }
  };
  const Edits3 edits{[&](mesh::Mesh& m) { distort(p, m); }, {}};
  const model::AnalysisResult3 result = run_text3(model_text(p), workers, look, edits);
  if (result.outcome != solve::Outcome::converged) return {};
  return out;
}

const char* role(bool upper) { return upper ? "upper slave" : "lower slave"; }

/// The same mesh on both sides: exact where the areas of the slave's nodes are the nodal forces of
/// a uniform pressure.
void add_matching(const std::string& type, const char* face, bool exact, CaseResult& out,
                  double& balance, const Workers& workers) {
  for (const bool upper : {true, false}) {
    Patch p;
    p.lower_type = p.upper_type = type;
    p.upper_is_slave = upper;
    const Errors e = patch_errors(p, workers);
    if (e.converged) balance = std::max(balance, e.balance);
    const std::string name = fmt::format("{} ({}), matching, {}: ", type, face, role(upper));
    if (exact) {
      out.rows.push_back({name + "largest error of pressure and stress",
                          std::max(e.pressure, e.stress), 1e-10, Relation::at_most, 0, source});
    } else if (!e.converged) {
      out.rows.push_back({name + "converges", 0, 1, Relation::info, 0, source});
    } else {
      out.rows.push_back({name + "pressure error", e.pressure, 0, Relation::info, 0, source});
      out.rows.push_back({name + "stress error", e.stress, 0, Relation::info, 0, source});
    }
  }
}

/// The same mesh on both sides, Gauss points that integrate the slave's shape functions exactly:
/// every face type passes.
void add_matching_gauss(const std::string& type, const char* face, CaseResult& out, double& balance,
                        const Workers& workers) {
  Patch p;
  p.lower_type = p.upper_type = type;
  p.sampling = "{gauss: 2}";
  const Errors e = patch_errors(p, workers);
  balance = std::max(balance, e.balance);
  out.rows.push_back({fmt::format("{} ({}), matching, {}: largest error of pressure and stress",
                                  type, face, p.sampling),
                      std::max(e.pressure, e.stress), 1e-10, Relation::at_most, 0, source});
}

/// 3 x 3 cells against 4 x 4, turned against each other.
void add_other_mesh(const std::string& type, const char* face, const std::string& sampling,
                    CaseResult& out, double& balance, const Workers& workers) {
  for (const bool upper : {true, false}) {
    Patch p;
    p.lower_type = p.upper_type = type;
    p.upper = 4;
    p.upper_swirl = -p.lower_swirl;
    p.confined = true;
    p.upper_is_slave = upper;
    p.sampling = sampling;
    const Errors e = patch_errors(p, workers);
    if (e.converged) balance = std::max(balance, e.balance);
    const std::string name =
        fmt::format("{} ({}), 3 x 3 against 4 x 4, {}, {}: ", type, face, sampling, role(upper));
    if (sampling == "mortar") {
      out.rows.push_back({name + "largest error of pressure and stress",
                          std::max(e.pressure, e.stress), 1e-10, Relation::at_most, 0, source});
      continue;
    }
    if (!e.converged) {
      out.rows.push_back({name + "converges", 0, 1, Relation::info, 0, source});
      continue;
    }
    out.rows.push_back({name + "pressure error", e.pressure, 0, Relation::info, 0, source});
    out.rows.push_back({name + "stress error", e.stress, 0, Relation::info, 0, source});
  }
}

struct Kind {
  const char *type, *face;
  bool exact;
};

/// The same for different faces on both sides: one row with the largest error of pressure and
/// stress.
void add_other_faces(const Kind& lower, const Kind& upper, const std::string& sampling,
                     CaseResult& out, double& balance, const Workers& workers) {
  for (const bool upper_is_slave : {true, false}) {
    Patch p;
    p.lower_type = lower.type;
    p.upper_type = upper.type;
    p.upper = 4;
    p.upper_swirl = -p.lower_swirl;
    p.confined = true;
    p.upper_is_slave = upper_is_slave;
    p.sampling = sampling;
    const Errors e = patch_errors(p, workers);
    if (e.converged) balance = std::max(balance, e.balance);
    const bool mortar = sampling == "mortar";
    const std::string name = fmt::format("{} under {}, 3 x 3 against 4 x 4, {}, {}: ", lower.face,
                                         upper.face, sampling, role(upper_is_slave));
    if (!e.converged && !mortar)
      out.rows.push_back({name + "converges", 0, 1, Relation::info, 0, source});
    else
      out.rows.push_back({name + "largest error of pressure and stress",
                          std::max(e.pressure, e.stress), mortar ? 1e-10 : 0.0,
                          mortar ? Relation::at_most : Relation::info, 0, source});
  }
}

}  // namespace

CaseResult contact_patch_space(const CaseContext& context) {
  constexpr std::array<Kind, 7> kinds{{{"hex8", "quad4", true},
                                       {"hex27", "quad9", true},
                                       {"tet4", "tri3", true},
                                       {"wedge6", "tri3", true},
                                       {"hex20", "quad8", false},
                                       {"tet10", "tri6", false},
                                       {"wedge15", "tri6", false}}};
  CaseResult out;
  double balance = 0;
  for (const Kind& k : kinds) add_matching(k.type, k.face, k.exact, out, balance, context.workers);
  for (const Kind& k : kinds) add_matching_gauss(k.type, k.face, out, balance, context.workers);
  for (const Kind& k : kinds)
    for (const char* const sampling :
         {"nodes", "{gauss: 2}", "{gauss: 4}", "{lobatto: 3}", "{gauss: 2, segments: true}",
          "{gauss: 3, segments: true}", "mortar"})
      add_other_mesh(k.type, k.face, sampling, out, balance, context.workers);
  for (const std::size_t lower : {0, 1, 2, 4, 5})
    for (const std::size_t upper : {0, 1, 2, 4, 5})
      for (const char* const sampling :
           {"nodes", "{gauss: 2}", "{lobatto: 3}", "{gauss: 3, segments: true}", "mortar"})
        if (lower < upper)
          add_other_faces(kinds[lower], kinds[upper], sampling, out, balance, context.workers);
  out.rows.push_back({"largest unbalance of forces / load, all of the above", balance, 1e-11,
                      Relation::at_most, 0, "equilibrium"});
  return out;
}

}  // namespace osculate::verification
