// Explicit time integration: the longest stable time step.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/model/system_explicit.hpp"
#include "osculate/pairing/point_penalty.hpp"
#include "osculate/pairing/point_weight.hpp"

namespace osculate::model {
namespace {

constexpr int known_for = 100;  ///< time steps until what changes is measured again

/// Largest slope of the pair's normal law over what its points see.
template <int Dim>
double steepest(const pairing::PairDefinition<Dim>& pair, const pairing::PairState<Dim>& state) {
  double slope = std::abs(contact::response(pair.normal, 0.0).d_traction);
  for (const contact::PointHistory<Dim>& h : state.points)
    if (h.active)
      slope = std::max(
          slope, std::abs(contact::response(pair.normal, h.gap - pair.offset, true).d_traction));
  return slope;
}

/// Largest slope of the laws of one point, where `slope` is that of the pair's normal law: only a
/// penalty, whose slope it is, has factors of its own.
template <int Dim>
double stiffest(const pairing::PairDefinition<Dim>& pair, double slope, std::size_t point) {
  double own = pairing::relative_stiffness(pair, point).normal * slope;
  if (pair.damping) own = contact::stiffest(*pair.damping, own, 0);
  return std::max(own, pairing::point_penalty(pair, point).shear);
}

/// Coefficient of the dampers beside the springs, which see the way of the time step before.
template <int Dim>
double damper(const pairing::PairDefinition<Dim>& pair) {
  const auto* const viscous =
      pair.damping ? std::get_if<contact::Viscous>(&*pair.damping) : nullptr;
  return viscous ? viscous->coefficient : 0.0;
}

/// What the stiffness of a slave point is its law's slope times.
template <int Dim>
double spring_weight(const pairing::PairDefinition<Dim>& pair, std::size_t point) {
  const double share = pairing::side_share(pair);
  const bool by_area = pair.weight != pairing::Weight::node && point < pair.reference_areas.size();
  return by_area ? share * pair.reference_areas[point] : share;
}

}  // namespace

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::moves(Index node) const {
  for (int i = 0; i < Dim; ++i)
    if (inverse[Dim * node + i] > 0) return true;
  return false;
}

template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::cell_frequency(std::size_t cell, BulkBlock& block) const {
  constexpr int most = Dim * BulkTraits<Dim>::max_nodes;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  const CellJob& job = system.jobs[cell];
  evaluate_cell(system.model, *job.section, job.cell, motion.position, true, block);
  if (!block.ok) return 0;  // the next time step says so
  const Eigen::MatrixXd& mass_of = system.motion->inertia->cells()[cell].mass;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> root(block.dof_count);
  for (Eigen::Index d = 0; d < root.size(); ++d) root[d] = 1 / std::sqrt(mass_of(d / Dim, d / Dim));
  const Matrix scaled = root.asDiagonal() * block.result.tangent * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Bound of the largest eigenvalue of M^-1 K of all springs of contacts, as if every point were in
/// contact. The mass of a node on the master is shared among the points around it in proportion to
/// their springs.
///
/// Formula    k (1/m_s + sum_l N_l^2/m_l') <= k/m_s + max_l S_l/m_l ,  S_l = sum over points k N_l,
///            m_l' = m_l k N_l / S_l ; S_l: the slope times the area of the master at l, at least
///            one spring, with the largest slope of any point; of rigid bodies all springs, with
///            arms of at most the body's
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::contact_frequency(bool dampers) const {
  const BasicModel<Dim>& whole = system.model;
  std::vector<double> on_slave(x.size(), 0.0), on_master(x.size(), 0.0);
  std::vector<double> slave_body(whole.rigid.size(), 0.0), master_body(whole.rigid.size(), 0.0);
  for (std::size_t p = 0; p < whole.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = whole.pairs[p].definition;
    const double of_pair = dampers ? damper(pair) : steepest(pair, now.pairs[p]);
    if (!(of_pair > 0) && (dampers || !pair.friction)) continue;
    double all = 0, largest = 0, slope = 0;
    for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
      const pairing::SlavePoint<Dim>& point = pair.slave.points[i];
      const double own = dampers ? of_pair : stiffest(pair, of_pair, i);
      const double spring = own * spring_weight(pair, i);
      slope = std::max(slope, own);
      all += spring;
      largest = std::max(largest, spring);
      for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
        on_slave[static_cast<std::size_t>(point.nodes[k])] += spring * std::abs(point.shape[k]);
    }
    const auto add_body = [&](Index node, std::vector<double>& sums) {
      const Index b = system.dofs.body_of(node);
      if (b >= 0) sums[static_cast<std::size_t>(b)] += all;
      return b >= 0;
    };
    if (!pair.slave.points.empty()) add_body(pair.slave.points.front().nodes[0], slave_body);
    if (pair.master.facets.empty() || add_body(pair.master.facets.front().nodes[0], master_body))
      continue;
    const pairing::SlaveSide<Dim> side = pairing::make_slave_side(pair.master);
    std::vector<double> areas;
    if (pair.weight != pairing::Weight::node)
      pairing::nodal_areas(side, std::span<const Vec<Dim>>(whole.reference), pair.area, areas,
                           nullptr);
    for (std::size_t i = 0; i < side.nodes.size(); ++i)
      on_master[static_cast<std::size_t>(side.nodes[i])] += std::max(
          largest, i < areas.size() ? pairing::side_share(pair) * slope * areas[i] : largest);
  }
  // A node, or a body, that is slave here and master there shares its mass among both.
  const auto side_of = [&](const std::vector<double>& nodes, const std::vector<double>& bodies) {
    double most = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (nodes[n] > 0 && node_mass[n] > 0 && moves(static_cast<Index>(n)))
        most = std::max(most, (on_slave[n] + on_master[n]) / node_mass[n]);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const BasicRigidBody<Dim>& body = whole.rigid[b];
      if (!(bodies[b] > 0) || !(body.mass > 0)) continue;
      double arm = 0;
      for (const Index n : body.nodes)
        arm = std::max(arm, (whole.reference[static_cast<std::size_t>(n)] - body.reference).norm());
      constexpr double of_compact_bodies = 3;  // arm^2 mass / inertia: 2 disc, 2.5 ball, 3 rod
      double turning_of = of_compact_bodies / body.mass;
      if (!body.shape && body.parts.empty())
        turning_of = arm * arm / body.inertia.diagonal().minCoeff();
      most = std::max(most, (slave_body[b] + master_body[b]) * (1 / body.mass + turning_of));
    }
    return most;
  };
  return side_of(on_slave, slave_body) + side_of(on_master, master_body);
}

/// Formula    h^2 omega^2 + 2 h B <= 4 , B of the dampers of contacts as omega^2 of their springs:
/// they
///            act on u_n - u_n-1 ,
///            omega^2 <= max(omega_cells^2, omega_touching^2 + omega_contact^2) ,
///            no system is faster than its fastest cell by itself, and nodes in
///            contact give one share of their mass to their cells and the rest to the springs
/// Source     Belytschko2014, section 6.2: element eigenvalue inequality
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::measure_stable_step() {
  const auto count = static_cast<std::ptrdiff_t>(system.jobs.size());
  std::vector<double> of_cell(system.jobs.size());
#pragma omp parallel num_threads(system.threads)
  {
    BulkBlock block;
#pragma omp for schedule(static)
    for (std::ptrdiff_t c = 0; c < count; ++c)
      of_cell[static_cast<std::size_t>(c)] = cell_frequency(static_cast<std::size_t>(c), block);
  }
  double cells = 0, beside = 0;
  stable = {};
  for (std::size_t c = 0; c < of_cell.size(); ++c) {
    if (of_cell[c] > cells) {
      cells = of_cell[c];
      stable.cell = static_cast<Index>(c);
    }
    if (touching[c]) beside = std::max(beside, of_cell[c]);
  }
  const double springs = contact_frequency(false), damped = contact_frequency(true);
  stable.contact = (springs > 0 && beside + springs > cells) || damped * damped > 4 * cells;
  const double most = std::max(cells, springs > 0 ? beside + springs : 0.0);
  stable.step = most > 0 ? 4 / (damped + std::sqrt(damped * damped + 4 * most))
                         : std::numeric_limits<double>::infinity();
}

template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::stable_step(const solve::ExplicitMotion&) {
  if (!(stable.step > 0) || (changes && stable.since >= known_for)) measure_stable_step();
  return stable.step;
}

template <int Dim>
std::string BasicSystem<Dim>::Impl::Explicit::governed() const {
  if (stable.contact) return "the springs of the contacts";
  if (stable.cell < 0) return "nothing";
  const CellJob& job = system.jobs[static_cast<std::size_t>(stable.cell)];
  const CellNodes cell = cell_nodes(system.model.mesh, job.cell);
  return fmt::format("{} cell {} of '{}'", cell::info(cell.type).name, job.cell.cell + 1,
                     job.section->name);
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
