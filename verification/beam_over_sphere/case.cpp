#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../model3.hpp"
#include "../scene3.hpp"
#include "osculate/pairing/tangent_parts.hpp"

namespace osculate::verification {
namespace {

constexpr double length = 24, height = 0.25, width = 4, radius = 4;
constexpr double small_force = 0.175, large_force = 0.70;  ///< 17.5 N and 70 N in MPa cm^2
constexpr int increments = 100, elements = 12, around = 32, between_poles = 16;

struct Choice {
  contact::TangentForm tangent;
  double penalty = 5e2;
  bool limited = true;  ///< line search and cut-backs; else full Newton steps only
  bool defaults = false;
};

/// The beam: bottom at z = 0, one element through the thickness and across the width. Returns the
/// bottom faces, seen from below.
std::vector<pairing::SurfaceFacet> add_beam(Builder3& b) {
  constexpr double step = length / elements;
  constexpr cell::CellType face = cell::CellType::quad9;
  std::vector<pairing::SurfaceFacet> bottom;
  for (int e = 0; e < elements; ++e) {
    std::vector<Index> nodes, turned;
    for (const double z : {0.0, height})
      for (int k = 0; k < 9; ++k) {
        const Vec2 xi = cell::area_node(face, k);
        nodes.push_back(b.node({(e + 0.5 + 0.5 * xi.x()) * step, 0.5 * width * (1 + xi.y()), z}));
      }
    b.cell(cell::CellType::shell18, nodes, 0);
    for (const std::size_t k : {0, 3, 2, 1, 7, 6, 5, 4, 8}) turned.push_back(nodes[k]);
    bottom.push_back(pairing::surface_facet(face, turned));
  }
  return bottom;
}

struct Sphere {
  pairing::FacetSurface all, upper;
};

/// The sphere, rigid body 0: 16 x 32 facets with poles at its sides, two nodes of each ring at the
/// same height beside its top.
Sphere add_sphere(Builder3& b) {
  const Vec3 centre(12, 0.5, -radius);
  const auto at = [&](int i, int j) {
    const double theta = std::numbers::pi * j / between_poles;
    const double phi = 2 * std::numbers::pi * (i % around + 0.5) / around;
    const double ring = j == 0 || j == between_poles ? 0 : std::sin(theta);
    return b.node(
        centre + radius * Vec3(ring * std::sin(phi), std::cos(theta), ring * std::cos(phi)), 0);
  };
  Sphere sphere;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < between_poles; ++j) {
      std::vector<Index> nodes;
      for (const Index n : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)})
        if (std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
      const pairing::SurfaceFacet facet = pairing::surface_facet(
          nodes.size() == 4 ? cell::CellType::quad4 : cell::CellType::tri3, nodes);
      sphere.all.facets.push_back(facet);
      if (std::cos(2 * std::numbers::pi * (i + 1) / around) > 1e-9)
        sphere.upper.facets.push_back(facet);
    }
  model::RigidBody3 body;
  body.name = "sphere";
  body.reference = centre;
  for (std::size_t n = 0; n < b.model.reference.size(); ++n)
    if (b.model.body_of_node[n] == 0) body.nodes.push_back(static_cast<Index>(n));
  b.model.rigid.push_back(std::move(body));
  return sphere;
}

model::Step make_step(const Builder3& b) {
  model::Step step;
  step.name = "bend";
  step.increments = increments;
  model::DeadLoad load;
  load.ramp = {0, 1, {}};
  for (std::size_t n = 0; n < b.model.reference.size(); ++n) {
    if (b.model.body_of_node[n] >= 0) continue;
    const Vec3& x = b.model.reference[n];
    const auto node = static_cast<Index>(n);
    if (x.x() == 0) Builder3::fix(step, node);
    if (std::abs(x.x() - length) > 1e-9 || x.z() != 0) continue;
    if (x.y() == 0) load.unit.emplace_back(3 * node + 2, -small_force);
    if (x.y() == width) load.unit.emplace_back(3 * node + 2, -large_force);
  }
  step.dead.push_back(load);
  b.hold(step, 0);
  return step;
}

struct Problem {
  model::Model3 model;
  pairing::FacetSurface sphere;  ///< all its facets
};

Problem make_problem(const Choice& c) {
  Builder3 b;
  b.model.title = "Beam bent over a rigid sphere";
  model::BulkSection3 section;
  section.name = "beam";
  section.section = {solid::Kinematics::finite, solid::Formulation::solid_shell,
                     material::StVenantKirchhoff{1e4, 0.3, 0}};
  b.model.sections.push_back(section);
  model::ContactPair3 pair;
  pair.name = "contact";
  pair.definition.master.facets = add_beam(b);
  pairing::connect(pair.definition.master);
  Sphere sphere = add_sphere(b);
  pairing::connect(sphere.upper);
  pair.definition.slave = pairing::make_slave_side(std::move(sphere.upper));
  pair.definition.normal = contact::penalty(c.penalty);
  pair.definition.tangent = c.tangent;
  pairing::prepare(pair.definition, b.model.reference);
  b.model.pairs.push_back(std::move(pair));
  b.model.steps.push_back(make_step(b));
  return {std::move(b.model), std::move(sphere.all)};
}

model::AnalysisOptions options_of(const Choice& c, const Workers& workers) {
  model::AnalysisOptions options;
  workers.work_on(options);
  if (c.defaults) return options;
  options.increments.newton.energy = 1e-10;
  options.increments.newton.residual = 0;
  options.increments.newton.predictor = solve::Predictor::tangent;
  if (c.limited) return options;
  options.increments.newton.line_search = solve::LineSearch::off;
  options.increments.newton.max_iterations = 60;
  options.increments.max_cutbacks = 0;
  return options;
}

struct Outcome {
  bool converged = false;
  int iterations = 0, cutbacks = 0;
  std::vector<int> per_increment;
  double penetration = 0, first_share = 0, last_share = 0;        ///< eq. (60)
  Vec3 light_corner = Vec3::Zero(), heavy_corner = Vec3::Zero();  ///< of the free end, at the end
  std::vector<io::ScenePanel> panels;
};

void note(const Problem& problem, model::System3& system, const model::BasicState<3>& state,
          const solve::IncrementRecord& record, Outcome& out) {
  const int used = static_cast<int>(record.iterations.size()) + record.wasted_iterations;
  out.iterations += used;
  out.cutbacks += record.cutbacks;
  // sub-increments count for the increment they are part of
  const double at = std::ceil(record.fraction * increments - 1e-6);
  out.per_increment.resize(static_cast<std::size_t>(at));
  out.per_increment.back() += used;
  for (const auto& p : system.contact()[0].points)
    if (p.status != contact::Status::open) out.penetration = std::max(out.penetration, -p.gap);
  const bool first = std::abs(record.fraction * increments - 1) < 1e-6, last = record.fraction == 1;
  if (!first && !last) return;
  const std::vector<Vec3> x = system.positions(state);
  const pairing::PairDefinition<3>& pair = problem.model.pairs[0].definition;
  const double share = pairing::curvature_share<3>(pair, x, system.contact()[0], pair.tangent);
  (first ? out.first_share : out.last_share) = share;
  const auto& load = problem.model.steps[0].dead[0].unit;
  const bool light_first = std::abs(load[0].second) < std::abs(load[1].second);
  out.light_corner = x[static_cast<std::size_t>(load[light_first ? 0 : 1].first / 3)];
  out.heavy_corner = x[static_cast<std::size_t>(load[light_first ? 1 : 0].first / 3)];
}

Outcome run_case(const Choice& choice, const Workers& workers, bool draw = false) {
  const Problem problem = make_problem(choice);
  Outcome out;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::BasicState<3>& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    if (record) note(problem, system, state, *record, out);
    const double step = progress.fraction * increments;
    if (draw && std::abs(step - 20 * std::round(step / 20)) < 1e-6)
      out.panels.push_back(shell_panel(problem.model, problem.sphere, false,
                                       system.positions(state),
                                       fmt::format("increment {:.0f}", step)));
    return true;
  };
  const model::AnalysisResult3 result =
      model::run(problem.model, options_of(choice, workers), observer);
  out.converged = result.outcome == solve::Outcome::converged;
  return out;
}

constexpr contact::TangentForm form_a{false, true, true, true}, form_b{false, true, true, false},
    form_c{false, true, false, true}, form_d{false, true, false, false};

void add_row(CaseResult& result, const std::string& quantity, double computed, double reference,
             Relation relation, double tolerance, const char* source) {
  result.rows.push_back({quantity, computed, reference, relation, tolerance, source});
}

struct Published {
  const char* name;
  contact::TangentForm tangent;
  double penalty;
  int total, first;
};

/// Full Newton steps as in the paper, beside its Table 3.
void add_published(const CaseContext& context, CaseResult& result) {
  for (const Published& p :
       {Published{"a", form_a, 5e2, 426, 27}, Published{"b", form_b, 5e2, 427, 27},
        Published{"c", form_c, 5e3, 609, 0}, Published{"d", form_d, 5e3, 613, 20}}) {
    Choice choice;
    choice.tangent = p.tangent;
    choice.penalty = p.penalty;
    choice.limited = false;
    const Outcome o = run_case(choice, context.workers);
    const std::string kind = fmt::format("full steps, case {}, penalty {:g}", p.name, p.penalty);
    add_row(result, kind + ": iterations", o.converged ? o.iterations : -1, p.total, Relation::info,
            0, "KSVD Table 3");
    if (p.first > 0)
      add_row(result, kind + ": increment 1", o.per_increment.empty() ? -1 : o.per_increment[0],
              p.first, Relation::info, 0, "KSVD Table 3");
    if (p.name[0] != 'a') continue;
    add_row(result, kind + ": penetration / height in percent", 100 * o.penetration / height, 0.75,
            Relation::info, 0, "KSVD 5.2");
    add_row(result, kind + ": eq. (60) in percent, increment 1", 100 * o.first_share, 0.731e-2,
            Relation::info, 0, "KSVD Table 3");
    add_row(result, kind + ": eq. (60) in percent, increment 100", 100 * o.last_share, 17.32e-2,
            Relation::info, 0, "KSVD Table 3");
  }
}

/// All cases at one penalty with step limiting: they finish, at the same place, and the rotational
/// part saves iterations.
void add_limited(const CaseContext& context, double penalty, CaseResult& result) {
  constexpr double fewer = 0.85, same = 1e-6;
  const std::array<contact::TangentForm, 4> forms{form_a, form_b, form_c, form_d};
  constexpr std::array<const char*, 4> names{"a", "b", "c", "d"};
  std::array<Outcome, 4> o;
  Curve curve{fmt::format("iterations_{:g}", penalty), {"increment", "a", "b", "c", "d"}, {}};
  for (int i = 1; i <= increments; ++i) curve.rows.push_back({static_cast<double>(i), 0, 0, 0, 0});
  for (std::size_t k = 0; k < 4; ++k) {
    o[k] = run_case({forms[k], penalty}, context.workers, k == 0 && penalty == 5e2);
    const std::string kind = fmt::format("limited, case {}, penalty {:g}", names[k], penalty);
    add_row(result, kind + ": end of the load reached", o[k].converged ? 1 : 0, 1, Relation::equal,
            0, "requirement");
    add_row(result, kind + ": iterations", o[k].iterations, std::array{426, 427, 609, 613}[k],
            Relation::info, 0,
            (k < 2) == (penalty < 1e3) ? "KSVD Table 3" : "KSVD Table 3, other penalty");
    add_row(result, kind + ": cut-backs", o[k].cutbacks, 0, Relation::info, 0, "");
    const double deviation = std::max((o[k].light_corner - o[0].light_corner).norm(),
                                      (o[k].heavy_corner - o[0].heavy_corner).norm()) /
                             length;
    if (k > 0)
      add_row(result, kind + ": free end beside that of case a, / length", deviation, same,
              Relation::at_most, 0, "requirement");
    for (std::size_t i = 0; i < std::min(o[k].per_increment.size(), curve.rows.size()); ++i)
      curve.rows[i][k + 1] = o[k].per_increment[i];
  }
  for (const std::size_t few : {0u, 1u})
    for (const std::size_t many : {2u, 3u})
      add_row(result,
              fmt::format("limited, penalty {:g}: iterations of {} / of {}", penalty, names[few],
                          names[many]),
              static_cast<double>(o[few].iterations) / std::max(o[many].iterations, 1), fewer,
              Relation::at_most, 0, "requirement");
  result.curves.push_back(std::move(curve));
  if (o[0].panels.empty()) return;
  result.drawings.push_back({"deformation",
                             {"Beam bent over a rigid sphere",
                              "displacement",
                              {0.8, -1.3, 0.8},
                              {0, 0, 1},
                              2,
                              std::move(o[0].panels)}});
}

}  // namespace

CaseResult beam_over_sphere(const CaseContext& context) {
  CaseResult result;
  add_published(context, result);
  for (const double penalty : {5e2, 5e3}) add_limited(context, penalty, result);
  for (const double penalty : {5e2, 5e3}) {
    Choice choice;
    choice.penalty = penalty;
    choice.defaults = true;
    const Outcome o = run_case(choice, context.workers);
    const std::string kind = fmt::format("defaults, penalty {:g}", penalty);
    add_row(result, kind + ": end of the load reached", o.converged ? 1 : 0, 1, Relation::equal, 0,
            "requirement");
    add_row(result, kind + ": iterations", o.iterations, 426, Relation::info, 0,
            "KSVD Table 3, case a");
  }
  return result;
}

}  // namespace osculate::verification
