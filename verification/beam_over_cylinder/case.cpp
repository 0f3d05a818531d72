#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../model3.hpp"
#include "osculate/pairing/tangent_parts.hpp"

namespace osculate::verification {
namespace {

constexpr double length = 24, height = 0.25, width = 1, radius = 2, pull = 9;
constexpr int increments = 90, chords = 49;

struct Choice {
  bool quadratic = false;
  contact::TangentForm tangent;
  double penalty = 1e4;
  double energy = 1e-12, residual = 0;
  solve::LineSearch line_search = solve::LineSearch::off;
  int refine = 1;  ///< of the beam's length
};

/// The beam: bottom at z = 0, one element through the thickness and across the width.
std::vector<pairing::SurfaceFacet> add_beam(Builder3& b, const Choice& c) {
  const int elements = (c.quadratic ? 12 : 24) * c.refine;
  const double step = length / elements;
  std::vector<pairing::SurfaceFacet> bottom;
  for (int e = 0; e < elements; ++e) {
    const auto at = [&](const Vec2& xi, double z) {
      return b.node({(e + 0.5 + 0.5 * xi.x()) * step, 0.5 * width * (1 + xi.y()), z});
    };
    const cell::CellType face = c.quadratic ? cell::CellType::quad9 : cell::CellType::quad4;
    std::vector<Index> nodes;
    for (const double z : {0.0, height})
      for (int k = 0; k < cell::info(face).nodes; ++k) nodes.push_back(at(cell::area_node(face, k), z));
    b.cell(c.quadratic ? cell::CellType::shell18 : cell::CellType::hex8, nodes, 0);
    // the bottom face seen from below: corners 0 3 2 1, so edges 3 2 1 0
    constexpr std::array<std::size_t, 9> below{0, 3, 2, 1, 7, 6, 5, 4, 8};
    std::vector<Index> turned;
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell::info(face).nodes); ++k)
      turned.push_back(nodes[below[k]]);
    bottom.push_back(pairing::surface_facet(face, turned));
  }
  return bottom;
}

/// The cylinder: chords on the full circumference, one node at the top; rigid body 0.
pairing::SlaveSide<3> add_cylinder(Builder3& b) {
  pairing::FacetSurface ring;
  const auto at = [&](int k, double y) {
    const double angle = 0.5 * std::numbers::pi - 2 * std::numbers::pi * k / chords;
    return b.node({12 + radius * std::cos(angle), y, -radius + radius * std::sin(angle)}, 0);
  };
  for (int k = 0; k < chords; ++k)
    ring.facets.push_back(pairing::surface_facet(
        cell::CellType::quad4,
        std::array<Index, 4>{at(k, 0), at((k + 1) % chords, 0), at((k + 1) % chords, width),
                             at(k, width)}));
  model::RigidBody3 body;
  body.name = "cylinder";
  body.reference = {12, 0.5 * width, -radius};
  for (std::size_t n = 0; n < b.model.reference.size(); ++n)
    if (b.model.body_of_node[n] == 0) body.nodes.push_back(static_cast<Index>(n));
  b.model.rigid.push_back(std::move(body));
  pairing::connect(ring);
  return pairing::make_slave_side(std::move(ring));
}

model::Model3 make_model(const Choice& c) {
  Builder3 b;
  b.model.title = "Beam bent over a rigid cylinder";
  model::BulkSection3 section;
  section.name = "beam";
  section.section = {solid::Kinematics::finite, solid::VolumeFormulation::solid_shell,
                     material::StVenantKirchhoff{1e4, 0.3, 0}};
  b.model.sections.push_back(section);
  model::ContactPair3 pair;
  pair.name = "contact";
  pair.definition.master.facets = add_beam(b, c);
  pairing::connect(pair.definition.master);
  pair.definition.slave = add_cylinder(b);
  pair.definition.normal.stiffness = c.penalty;
  pair.definition.tangent = c.tangent;
  pairing::prepare(pair.definition, b.model.reference);
  b.model.pairs.push_back(std::move(pair));
  model::Step step;
  step.name = "bend";
  step.increments = increments;
  for (std::size_t n = 0; n < b.model.reference.size(); ++n) {
    if (b.model.body_of_node[n] >= 0) continue;
    const Vec3& x = b.model.reference[n];
    const auto node = static_cast<Index>(n);
    if (x.x() == 0) Builder3::fix(step, node);
    if (std::abs(x.x() - length) < 1e-9 && x.z() == 0)
      step.prescribed.push_back({3 * node + 2, {0, -pull, {}}, false});
  }
  b.hold(step, 0);
  b.model.steps.push_back(step);
  return std::move(b.model);
}

struct Outcome {
  bool converged = false;
  std::string message;
  int iterations = 0, cutbacks = 0;
  std::vector<int> per_increment;
  std::vector<double> share;  ///< eq. (60)
  double penetration = 0, tip_force = 0;
};

Outcome run_case(const Choice& choice, int threads) {
  const model::Model3 m = make_model(choice);
  model::AnalysisOptions options;
  options.threads = threads;
  options.increments.newton.energy = choice.energy;
  options.increments.newton.residual = choice.residual;
  options.increments.newton.line_search = choice.line_search;
  Outcome out;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::BasicState<3>& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    if (!record) return true;
    out.iterations += static_cast<int>(record->iterations.size()) + record->wasted_iterations;
    out.cutbacks += record->cutbacks;
    out.per_increment.push_back(static_cast<int>(record->iterations.size()));
    out.share.push_back(pairing::curvature_share<3>(m.pairs[0].definition, system.positions(state),
                                                    state.pairs[0]));
    for (const auto& p : system.contact()[0].points)
      if (p.status != contact::Status::open) out.penetration = std::max(out.penetration, -p.gap);
    out.tip_force = 0;
    const model::Forces& f = system.forces();
    for (const model::PrescribedDof& p : m.steps[0].prescribed)
      if (p.ramp.target != 0) out.tip_force += f.internal[p.dof] + f.contact[p.dof];
    return true;
  };
  const model::AnalysisResult3 result = model::run(m, options, observer);
  out.converged = result.outcome == solve::Outcome::converged;
  out.message = result.message;
  return out;
}

}  // namespace

CaseResult beam_over_cylinder(const CaseContext& context) {
  CaseResult result;
  struct Published {
    const char* name;
    contact::TangentForm tangent;
    int total, independent;
  };
  const std::array<Published, 4> cases{{{"a", {false, true, true, true}, 319, 323},
                                        {"b", {false, true, true, false}, 319, 323},
                                        {"c", {false, true, false, true}, 345, 351},
                                        {"d", {false, true, false, false}, 345, 351}}};
  for (const Published& p : cases) {
    Choice choice;
    choice.tangent = p.tangent;
    const Outcome o = run_case(choice, context.threads);
    fmt::print(stderr, "{} {} {} cutbacks {} pen {} tip {} {}\n", p.name, o.converged, o.iterations,
               o.cutbacks, o.penetration / height, o.tip_force, o.message);
    for (const int n : o.per_increment) fmt::print(stderr, "{} ", n);
    fmt::print(stderr, "\n");
    result.rows.push_back({fmt::format("linear, case {}: iterations", p.name),
                           static_cast<double>(o.iterations), static_cast<double>(p.total),
                           Relation::equal, 10.0 / p.total, "KSVD Table 1"});
  }
  return result;
}

}  // namespace osculate::verification
