#include "osculate/pairing/mortar_node.hpp"

#include <algorithm>

namespace osculate::pairing {

using contact::PointHistory;
using contact::Status;

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <int Dim>
Vec<Dim> place_in_space(const MortarPlace& place, Points<Dim> x) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t l = 0; l < place.nodes.size(); ++l)
    sum += place.weights[l] * x[at(place.nodes[l])];
  return sum;
}

template <int Dim>
typename MortarNode<Dim>::Rate& rate_of(MortarNode<Dim>& node, Index by) {
  for (typename MortarNode<Dim>::Rate& r : node.rates)
    if (r.node == by) return r;
  node.rates.emplace_back();
  node.rates.back().node = by;
  for (Mat<Dim, Dim>& m : node.rates.back().frame) m.setZero();
  return node.rates.back();
}

template <int Dim>
void complete_rates(const MortarPlace& last, const NodalNormal<Dim>& normal,
                    MortarNode<Dim>& node) {
  const auto at_fixed = [&](const MortarPlace& place, auto member) {
    for (std::size_t k = 0; k < place.nodes.size(); ++k)
      (rate_of(node, place.nodes[k]).*member).diagonal().array() += place.weights[k];
  };
  at_fixed(node.slaves, &MortarNode<Dim>::Rate::own);
  at_fixed(node.masters, &MortarNode<Dim>::Rate::other);
  for (std::size_t l = 0; l < last.nodes.size(); ++l)
    rate_of(node, last.nodes[l]).old += last.weights[l];
  for (const NodeMatrix<Dim>& g : normal.gradient) rate_of(node, g.node).normal -= g.value;
  for (std::size_t i = 0; i < normal.frame_gradient.size(); ++i)
    for (const NodeMatrix<Dim>& g : normal.frame_gradient[i])
      rate_of(node, g.node).frame[i] += g.value;
}

/// Makes room; memory is never given back.
template <class Matrix>
void grow(Matrix& m, Eigen::Index rows, Eigen::Index columns = 1) {
  if (m.rows() < rows || m.cols() < columns)
    m.resize(std::max(m.rows(), rows), std::max(m.cols(), columns));
}

/// Derivatives of a node's gap and shear by the position of one node.
template <int Dim>
struct NodeRates {
  Eigen::Matrix<double, 1, Dim> gap;
  Mat<Dim, Dim> shear;  ///< of E t
};

template <int Dim>
NodeRates<Dim> node_rates(const PairDefinition<Dim>& pair, const NodeContact<Dim>& c, double area,
                          const typename MortarNode<Dim>::Rate& r) {
  const Mat<Dim, Dim> unit = Mat<Dim, Dim>::Identity();
  const Mat<Dim, Dim> d_foot = (r.other - c.foot * r.area.transpose()) / area;
  const Mat<Dim, Dim> d_apart = (r.own - r.other - c.apart * r.area.transpose()) / area;
  NodeRates<Dim> out;
  out.gap = c.normal.transpose() * d_apart + c.apart.transpose() * r.normal;
  out.shear.setZero();
  if (!pair.friction) return out;
  Mat<Dim - 1, Dim> d_trial = Mat<Dim - 1, Dim>::Zero();
  for (int i = 0; i < Dim - 1; ++i) {
    const Mat<Dim, Dim>& turning = r.frame[static_cast<std::size_t>(i)];
    d_trial.row(i) = c.around.transpose() * turning;
    if (!c.sliding) continue;
    const Vec<Dim> e = c.frame.col(i);
    d_trial.row(i) +=
        c.stiffness *
        (c.share.value * (e.transpose() * (d_foot - r.old * unit) + c.way.transpose() * turning) +
         c.share.d_gap * e.dot(c.way) * out.gap);
  }
  out.shear = c.frame * (c.linearised.d_trial * d_trial +
                         c.linearised.d_normal * (c.normal_law.d_traction * out.gap));
  for (int i = 0; i < Dim - 1; ++i)
    out.shear += c.linearised.traction[i] * r.frame[static_cast<std::size_t>(i)];
  return out;
}

}  // namespace

template <int Dim>
NodeContact<Dim> place_node(const MortarNode<Dim>& node, const NodalNormal<Dim>& normal) {
  NodeContact<Dim> c;
  c.foot = node.other / node.area;
  c.apart = node.own / node.area - c.foot;
  c.normal = -normal.value;
  c.frame = normal.frame;
  c.gap = c.normal.dot(c.apart);
  // Sides that touch without a gap are in contact; the sums leave some rounding of it.
  constexpr double rounding = 1e-13;
  if (c.gap > 0 && c.gap <= rounding * (node.own.norm() + node.other.norm()) / node.area) c.gap = 0;
  return c;
}

template <int Dim>
void set_friction(const PairDefinition<Dim>& pair, const PointHistory<Dim>& history,
                  const MortarPlace& last, Points<Dim> x, const BranchHint<Dim>& hint,
                  NodeContact<Dim>& c) {
  const double normal = c.normal_law.traction;
  const contact::FrictionLaw law = friction_law(pair, normal, hint);
  const contact::Sliding sliding = sliding_of(history, hint);
  c.stiffness = contact::stiffness(law);
  if (hint.multiplier) {
    c.around = hint.multiplier->shear;
    c.trial = c.frame.transpose() * c.around;
  } else if (history.active) {
    c.trial = history.traction;
  }
  c.sliding = !last.nodes.empty();
  if (c.sliding) {
    if (!hint.multiplier) c.share = contact_share(pair, history, c.gap, hint);
    c.way = c.foot - place_in_space<Dim>(last, x);
    c.trial += c.stiffness * c.share.value * (c.frame.transpose() * c.way);
  }
  c.law = contact::response<Dim>(law, c.trial, normal, sliding);
  c.linearised = linearised_branch<Dim>(law, c.law, c.trial, normal, c.frame, sliding, hint);
}

template <int Dim>
void report(const PairDefinition<Dim>& pair, const PointHistory<Dim>& old,
            const MortarNode<Dim>& node, const NodeContact<Dim>& c, PointResult<Dim>& result) {
  result.gap = c.gap - pair.offset;
  result.foot = c.foot;
  result.normal = c.normal;
  result.frame = c.frame;
  PointHistory<Dim>& h = result.history;
  h.facet = node.facet;
  h.feature = projection::Feature::face;
  h.gap = c.gap;
  h.active = c.normal_law.active;
  report_normal(c.normal_law, old.damping_work, result);
  if (!h.active) return;
  result.status = pair.friction ? c.law.status : Status::slip;
  result.normal_traction = c.normal_law.traction;
  if (!pair.friction) return;
  result.branch = branch_of<Dim>(c.linearised, c.frame);
  result.shear_traction = c.law.traction;
  result.slip_increment = c.share.value * (c.frame.transpose() * c.way);
  h.traction = c.law.traction;
  h.slipping = c.law.status == Status::slip;
  h.slip = result.slip_increment;
  h.slid = contact::slid<Dim>(c.trial, c.law, c.stiffness);
  if (old.active) {
    h.slip += old.slip;
    h.slid += old.slid;
  }
  if (pair.enforcement == contact::Enforcement::penalty)
    result.stored += 0.5 * c.law.traction.squaredNorm() / c.stiffness;
  h.friction_work += node.area * contact::dissipated<Dim>(c.trial, c.law, c.stiffness);
}

template <int Dim>
void set_forces(const MortarNode<Dim>& node, const NodeContact<Dim>& c, ContactBlock<Dim>& block) {
  const std::size_t own = node.slaves.nodes.size();
  block.slave_count = static_cast<int>(own);
  // Weights that are zero but for rounding come and go: room for more than is needed just now.
  const std::size_t room = 2 * (own + node.masters.nodes.size());
  if (block.nodes.capacity() < room / 2) block.nodes.reserve(room);
  block.nodes = node.slaves.nodes;
  block.nodes.insert(block.nodes.end(), node.masters.nodes.begin(), node.masters.nodes.end());
  const auto rows = Dim * static_cast<Eigen::Index>(block.nodes.size());
  const Vec<Dim> push = c.normal_law.traction * c.normal;
  const Vec<Dim> lawful = push + c.frame * c.law.traction,
                 linear = push + c.frame * c.linearised.traction;
  block.count = static_cast<int>(block.nodes.size());
  block.branched = c.law.traction != c.linearised.traction;
  if (block.force.size() < rows) {
    grow(block.force, 2 * rows);
    grow(block.branch_force, 2 * rows);
    grow(block.path_rows, 2 * rows, Dim);
  }
  for (std::size_t k = 0; k < block.nodes.size(); ++k) {
    const double weight = k < own ? node.slaves.weights[k] : -node.masters.weights[k - own];
    const auto row = Dim * static_cast<Eigen::Index>(k);
    block.force.template segment<Dim>(row) = weight * lawful;
    block.branch_force.template segment<Dim>(row) = weight * linear;
    block.path_rows.template middleRows<Dim>(row) = weight * Mat<Dim, Dim>::Identity();
  }
}

template <int Dim>
void add_rates(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
               std::span<const std::size_t> local, Points<Dim> x,
               std::vector<MortarNode<Dim>>& nodes) {
  const Eigen::Index n = matrices.d.size();
  const Sheet::ConstView dd = matrices.dd.view(), ds = matrices.ds.view(), dm = matrices.dm.view();
  for (Eigen::Index j = 0; j < n; ++j) {
    MortarNode<Dim>& node = nodes[local[static_cast<std::size_t>(j)]];
    for (std::size_t c = 0; c < matrices.nodes.size(); ++c) {
      const auto column = Dim * static_cast<Eigen::Index>(c);
      typename MortarNode<Dim>::Rate& rate = rate_of(node, matrices.nodes[c]);
      rate.area += dd.template block<1, Dim>(j, column).transpose();
      Eigen::Index row = j;
      for (const Index k : slaves) {
        rate.own += x[at(k)] * ds.template block<1, Dim>(row, column);
        row += n;
      }
      row = j;
      for (const Index l : matrices.masters) {
        rate.other += x[at(l)] * dm.template block<1, Dim>(row, column);
        row += n;
      }
    }
  }
}

template <int Dim>
void set_facet_tangent(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
                       std::span<const std::size_t> local,
                       std::type_identity_t<std::span<const Vec<Dim>>> tractions,
                       ContactBlock<Dim>& block) {
  block.nodes = matrices.nodes;
  block.count = static_cast<int>(block.nodes.size());
  block.slave_count = 0;
  block.branched = false;
  block.behind.path.clear();
  const auto size = Dim * static_cast<Eigen::Index>(block.nodes.size());
  const Eigen::Index n = matrices.d.size();
  grow(block.force, size);
  grow(block.branch_force, size);
  grow(block.tangent, size, size);
  grow(block.path_rows, size, Dim);
  block.force.head(size).setZero();
  block.branch_force.head(size).setZero();
  block.tangent.topLeftCorner(size, size).setZero();
  block.path_rows.topRows(size).setZero();
  const Sheet::ConstView ds = matrices.ds.view(), dm = matrices.dm.view();
  const auto row_of = [&](Index node) {
    return Dim * static_cast<Eigen::Index>(slot_of(block.nodes, node));
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vec<Dim>& t = tractions[local[static_cast<std::size_t>(j)]];
    if (t.squaredNorm() == 0) continue;
    Eigen::Index row = j;
    for (const Index k : slaves) {
      block.tangent.template block<Dim, Eigen::Dynamic>(row_of(k), 0, Dim, size) +=
          t.lazyProduct(ds.row(row));
      row += n;
    }
    row = j;
    for (const Index l : matrices.masters) {
      block.tangent.template block<Dim, Eigen::Dynamic>(row_of(l), 0, Dim, size) -=
          t.lazyProduct(dm.row(row));
      row += n;
    }
  }
}

template <int Dim>
void set_path(const PairDefinition<Dim>& pair, double constraint_area, const NodeContact<Dim>& c,
              const MortarPlace& last, const NodalNormal<Dim>& normal, MortarNode<Dim>& node,
              ContactBlock<Dim>& block) {
  complete_rates<Dim>(last, normal, node);
  for (const typename MortarNode<Dim>::Rate& r : node.rates) {
    const NodeRates<Dim> rate = node_rates<Dim>(pair, c, node.area, r);
    const auto d_push = c.normal_law.d_traction * rate.gap;
    block.behind.path.push_back(
        {r.node, c.normal * d_push + c.normal_law.traction * r.normal + rate.shear});
    if (!block.constraint.on) continue;
    block.constraint.normal_row.push_back({r.node, constraint_area * d_push.transpose()});
    if (pair.friction) block.constraint.shear_row.push_back({r.node, constraint_area * rate.shear});
  }
}

template <int Dim>
void set_constraint(const PointPenalty& penalty, const NodeContact<Dim>& c,
                    const MortarNode<Dim>& node, double area,
                    const contact::Multiplier<Dim>& multiplier, ContactBlock<Dim>& block) {
  set_constraint_values<Dim>(area, c.normal_law.traction, c.frame * c.law.traction,
                             c.frame * c.linearised.traction, multiplier, block.constraint);
  const std::size_t own = node.slaves.nodes.size();
  set_multiplier_terms<Dim>(
      penalty, area, c.normal, c.frame * c.linearised.d_trial * c.frame.transpose(),
      c.frame * c.linearised.d_normal,
      [&](int n) {
        const auto k = static_cast<std::size_t>(n);
        return k < own ? node.slaves.weights[k] : -node.masters.weights[k - own];
      },
      block);
}

template NodeContact<2> place_node<2>(const MortarNode<2>&, const NodalNormal<2>&);
template void set_friction<2>(const PairDefinition<2>&, const PointHistory<2>&, const MortarPlace&,
                              Points<2>, const BranchHint<2>&, NodeContact<2>&);
template void report<2>(const PairDefinition<2>&, const PointHistory<2>&, const MortarNode<2>&,
                        const NodeContact<2>&, PointResult<2>&);
template void set_forces<2>(const MortarNode<2>&, const NodeContact<2>&, ContactBlock<2>&);
template void add_rates<2>(const MortarFacet<2>&, std::span<const Index>,
                           std::span<const std::size_t>, Points<2>, std::vector<MortarNode<2>>&);
template void set_facet_tangent<2>(const MortarFacet<2>&, std::span<const Index>,
                                   std::span<const std::size_t>, std::span<const Vec<2>>,
                                   ContactBlock<2>&);
template void set_path<2>(const PairDefinition<2>&, double, const NodeContact<2>&,
                          const MortarPlace&, const NodalNormal<2>&, MortarNode<2>&,
                          ContactBlock<2>&);
template void set_constraint<2>(const PointPenalty&, const NodeContact<2>&, const MortarNode<2>&,
                                double, const contact::Multiplier<2>&, ContactBlock<2>&);
template NodeContact<3> place_node<3>(const MortarNode<3>&, const NodalNormal<3>&);
template void set_friction<3>(const PairDefinition<3>&, const PointHistory<3>&, const MortarPlace&,
                              Points<3>, const BranchHint<3>&, NodeContact<3>&);
template void report<3>(const PairDefinition<3>&, const PointHistory<3>&, const MortarNode<3>&,
                        const NodeContact<3>&, PointResult<3>&);
template void set_forces<3>(const MortarNode<3>&, const NodeContact<3>&, ContactBlock<3>&);
template void add_rates<3>(const MortarFacet<3>&, std::span<const Index>,
                           std::span<const std::size_t>, Points<3>, std::vector<MortarNode<3>>&);
template void set_facet_tangent<3>(const MortarFacet<3>&, std::span<const Index>,
                                   std::span<const std::size_t>, std::span<const Vec<3>>,
                                   ContactBlock<3>&);
template void set_path<3>(const PairDefinition<3>&, double, const NodeContact<3>&,
                          const MortarPlace&, const NodalNormal<3>&, MortarNode<3>&,
                          ContactBlock<3>&);
template void set_constraint<3>(const PointPenalty&, const NodeContact<3>&, const MortarNode<3>&,
                                double, const contact::Multiplier<3>&, ContactBlock<3>&);

}  // namespace osculate::pairing
