// Explicit time integration: how fast the springs and dampers of contacts swing.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "osculate/contact/law/law.hpp"
#include "osculate/core/dense.hpp"
#include "osculate/model/system_explicit.hpp"
#include "osculate/pairing/point_penalty.hpp"
#include "osculate/pairing/point_weight.hpp"

namespace osculate::model {
namespace {

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
  return pair.damping ? contact::damper(*pair.damping) : 0.0;
}

/// What the stiffness of a slave point is its law's slope times.
template <int Dim>
double spring_weight(const pairing::PairDefinition<Dim>& pair, std::size_t point) {
  const double share = pairing::pass_factor(pair);
  const bool by_area = pair.weight != pairing::Weight::node && point < pair.reference_areas.size();
  return by_area ? share * pair.reference_areas[point] : share;
}

template <int Dim>
std::vector<double> areas_of(const BasicModel<Dim>& model, const pairing::PairDefinition<Dim>& pair,
                             const pairing::SlaveSide<Dim>& side) {
  std::vector<double> areas;
  pairing::nodal_areas(side, std::span<const Vec<Dim>>(model.reference), pair.area, areas, nullptr);
  return areas;
}

/// Slave points per area of the master, by which its nodes get springs.
template <int Dim>
double density_of(const pairing::PairDefinition<Dim>& pair) {
  if (pair.weight != pairing::Weight::node) return 1;
  const std::vector<double>& areas = pair.reference_areas;
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  return sum > 0 ? static_cast<double>(pair.slave.points.size()) / sum : 0;
}

/// Farthest place of a body from its centre, sampled; infinity: it has no end.
template <int Dim>
double reach_of(const BasicModel<Dim>& model, const BasicRigidBody<Dim>& body) {
  constexpr int samples = 24;
  double reach = 0;
  const auto add = [&](const Vec<Dim>& place) {
    const double arm = (place - body.reference).norm();
    reach = std::isfinite(arm) ? std::max(reach, arm) : std::numeric_limits<double>::infinity();
  };
  const auto see = [&](const RigidShape<Dim>& shape) {
    const auto from = geometry::lo(shape), to = geometry::hi(shape);
    for (int i = 0; i <= samples; ++i) {
      const double a = static_cast<double>(i) / samples;
      if constexpr (Dim == 2)
        add(geometry::jet(shape, (1 - a) * from + a * to).r);
      else
        for (int j = 0; j <= samples; ++j) {
          const double b = static_cast<double>(j) / samples;
          add(geometry::jet(shape,
                            Vec2((1 - a) * from.x() + a * to.x(), (1 - b) * from.y() + b * to.y()))
                  .r);
        }
    }
  };
  if (body.shape) see(*body.shape);
  for (const RigidShape<Dim>& part : body.parts) see(part);
  if (!body.shape && body.parts.empty())
    for (const Index n : body.nodes) add(model.reference[static_cast<std::size_t>(n)]);
  return reach;
}

}  // namespace

/// Adds those of a pair, as if all its points were in contact. A node of the master gets its share
/// of the master's area with the largest slope of any point, or one point at least.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_springs(const pairing::PairDefinition<Dim>& pair,
                                                   const std::vector<double>& slopes,
                                                   Springs& slave, Springs& master) const {
  const double slope = slopes.empty() ? 0 : *std::max_element(slopes.begin(), slopes.end());
  if (!(slope > 0)) return;
  double all = 0, largest = 0, largest_edge = 0;
  const auto add = [](Springs& side, Index node, double spring) {
    side.nodes[static_cast<std::size_t>(node)] += spring;
  };
  const auto add_edge = [&](Springs& side, const pairing::SharpEdge& edge, double spring) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
      add(side, edge.nodes[k], spring);
  };
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const pairing::SlavePoint<Dim>& point = pair.slave.points[i];
    const double spring = slopes[i] * spring_weight(pair, i);
    all += spring;
    largest = std::max(largest, spring);
    for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
      add(slave, point.nodes[k], spring * std::abs(point.shape[k]));
  }
  const pairing::EdgeContact* const edges = pairing::edges_of(pair);
  for (std::size_t e = 0; edges && e < edges->slave.size(); ++e) {
    const bool by_area = pair.weight != pairing::Weight::node;
    const double spring = slope * pairing::pass_factor(pair) * (by_area ? edges->areas[e] : 1.0);
    all += spring;
    largest_edge = std::max(largest_edge, spring);
    add_edge(slave, edges->slave[e], spring);
  }
  if (pair.master.facets.empty()) return;
  const Index body = system.dofs.body_of(pair.master.facets.front().nodes[0]);
  if (body >= 0) {
    master.bodies[static_cast<std::size_t>(body)] += all;
    return;
  }
  const pairing::SlaveSide<Dim> side = pairing::make_slave_side(pair.master);
  const std::vector<double> areas = areas_of(system.model, pair, side);
  const double by_area = slope * pairing::pass_factor(pair) * density_of(pair);
  for (std::size_t i = 0; i < side.nodes.size(); ++i)
    add(master, side.nodes[i], std::max(largest, i < areas.size() ? by_area * areas[i] : 0.0));
  if (!edges) return;
  for (const pairing::SharpEdge& edge : edges->master) add_edge(master, edge, largest_edge);
}

/// What these springs make of every dof that moves by itself, and of the bodies, as squared
/// frequencies.
///
/// Formula    S_d / m_d , S_d with f^2 times that of a dof that follows by the factor f;
///            of bodies sum k (1/m + arm^2/I), I the smallest moment of inertia
template <int Dim>
typename BasicSystem<Dim>::Impl::Explicit::Swing BasicSystem<Dim>::Impl::Explicit::swing_of(
    const Springs& springs) const {
  const BasicModel<Dim>& whole = system.model;
  Swing out{Vector::Zero(mass.size()), std::vector<double>(whole.rigid.size(), 0.0)};
  std::vector<double> turning_of(whole.rigid.size(), 0.0);
  for (std::size_t n = 0; n < springs.nodes.size(); ++n) {
    if (!(springs.nodes[n] > 0)) continue;
    const Index b = system.dofs.body_of(static_cast<Index>(n));
    if (b < 0) {
      out.dofs.template segment<Dim>(Dim * static_cast<Eigen::Index>(n)).array() +=
          springs.nodes[n];
      continue;
    }
    const auto body = static_cast<std::size_t>(b);
    const Vec<Dim> arm = whole.reference[n] - whole.rigid[body].reference;
    out.bodies[body] += springs.nodes[n];
    turning_of[body] += springs.nodes[n] * arm.squaredNorm();
  }
  for (const Follower& f : followers) {
    if (f.lead >= 0) out.dofs[f.lead] += f.factor * f.factor * out.dofs[f.dof];
    out.dofs[f.dof] = 0;
  }
  out.dofs = out.dofs.cwiseProduct(inverse).eval();
  for (std::size_t b = 0; b < out.bodies.size(); ++b) {
    if (springs.bodies[b] > 0) {
      const double reach = std::min(reach_of(whole, whole.rigid[b]), farthest_from(b));
      out.bodies[b] += springs.bodies[b];
      turning_of[b] += springs.bodies[b] * reach * reach;
    }
    const Dof first = system.dofs.body_dof(static_cast<Index>(b), 0);
    const double moves = inverse.template segment<Dim>(first).maxCoeff();
    double turns_by = Dim == 2 ? inverse[first + Dim] : 0;
    if (turns[b]) turns_by = 1 / core::eigenvalues(whole.rigid[b].inertia).minCoeff();
    out.bodies[b] = out.bodies[b] * moves + turning_of[b] * turns_by;
  }
  return out;
}

/// The farthest slave point from the centre of a body.
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::farthest_from(std::size_t body) const {
  const Vec<Dim> center = now.rigid[body].center();
  double most = 0;
  for (const BasicContactPair<Dim>& pair : system.model.pairs) {
    const auto& facets = pair.definition.master.facets;
    if (facets.empty() || system.dofs.body_of(facets.front().nodes[0]) != static_cast<Index>(body))
      continue;
    for (const Index n : pair.definition.slave.nodes)
      most = std::max(most, (x[static_cast<std::size_t>(n)] - center).norm());
  }
  return most;
}

template <int Dim>
typename BasicSystem<Dim>::Impl::Explicit::Springs BasicSystem<Dim>::Impl::Explicit::no_springs()
    const {
  return {std::vector<double>(system.model.reference.size(), 0.0),
          std::vector<double>(system.model.rigid.size(), 0.0)};
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::collect_springs(
    bool dampers, const std::vector<pairing::PairState<Dim>>& states, Springs& slave,
    Springs& master) const {
  const pairing::PairState<Dim> none;
  for (std::size_t p = 0; p < system.model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = system.model.pairs[p].definition;
    std::vector<double> slopes(pair.slave.points.size(), dampers ? damper(pair) : 0.0);
    if (!dampers) {
      const double steep = steepest(pair, p < states.size() ? states[p] : none);
      for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = stiffest(pair, steep, i);
    }
    add_springs(pair, slopes, slave, master);
  }
}

template <int Dim>
typename BasicSystem<Dim>::Impl::Explicit::Bound BasicSystem<Dim>::Impl::Explicit::bound_of(
    const Swing& here, const Swing& there) {
  Bound most;
  for (Eigen::Index d = 0; d < here.dofs.size(); ++d)
    if (here.dofs[d] > 0) most.nodes = std::max(most.nodes, here.dofs[d] + there.dofs[d]);
  for (std::size_t i = 0; i < here.bodies.size(); ++i)
    if (here.bodies[i] > 0) most.bodies = std::max(most.bodies, here.bodies[i] + there.bodies[i]);
  return most;
}

/// Bound of the largest eigenvalue of M^-1 K of all springs of contacts, as if every point were in
/// contact. The mass of a node on the master is shared among the points around it in proportion to
/// their springs; a node, or a body, that is slave here and master there has the springs of both.
///
/// Formula    k (1/m_s + sum_l N_l^2/m_l') <= k/m_s + max_l S_l/m_l ,  S_l = sum over points k N_l,
///            m_l' = m_l k N_l / S_l ; S_l: the slope times the area of the master at l, at least
///            one spring
/// Tested by  tests/unit/deck/test_explicit_contact_step.cpp
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::contact_frequency(bool dampers) const {
  Springs slave = no_springs(), master = slave;
  collect_springs(dampers, now.pairs, slave, master);
  const Swing a = swing_of(slave), b = swing_of(master);
  return bound_of(a, b).most() + bound_of(b, a).most();
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
