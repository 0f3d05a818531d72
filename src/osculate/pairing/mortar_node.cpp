#include "osculate/pairing/mortar_node.hpp"

#include <algorithm>

#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {

using contact::PointHistory;

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
NodeRates<Dim> node_rates(const NodeContact<Dim>& c, double area,
                          const typename MortarNode<Dim>::Rate& r) {
  const Mat<Dim, Dim> unit = Mat<Dim, Dim>::Identity();
  const ContactSample<Dim>& s = c.sample;
  const contact::Traction<Dim>& t = c.response.traction;
  const Mat<Dim, Dim> d_foot = (r.other - s.foot * r.area.transpose()) / area;
  const Mat<Dim, Dim> d_apart = (r.own - r.other - c.apart * r.area.transpose()) / area;
  NodeRates<Dim> out;
  out.gap = s.normal.transpose() * d_apart + c.apart.transpose() * r.normal;
  out.shear.setZero();
  if (!c.response.has_shear) return out;
  Mat<Dim - 1, Dim> d_predictor = Mat<Dim - 1, Dim>::Zero();
  for (int i = 0; i < Dim - 1; ++i) {
    const Mat<Dim, Dim>& turning = r.frame[static_cast<std::size_t>(i)];
    d_predictor.row(i) = c.shear_multiplier.transpose() * turning;
    if (!c.sliding) continue;
    const Vec<Dim> e = s.frame.col(i);
    d_predictor.row(i) +=
        t.stiffness * (c.time_fraction.value *
                           (e.transpose() * (d_foot - r.old * unit) + c.way.transpose() * turning) +
                       c.time_fraction.d_gap * e.dot(c.way) * out.gap);
  }
  out.shear = s.frame * (t.tangential.d_predictor * d_predictor +
                         t.tangential.d_normal * (t.normal.d_traction * out.gap));
  for (int i = 0; i < Dim - 1; ++i)
    out.shear += t.tangential.traction[i] * r.frame[static_cast<std::size_t>(i)];
  return out;
}

/// The elastic predictor since the last place.
template <int Dim>
ElasticPredictor<Dim> predictor(const PointHistory<Dim>& history, const MortarPlace& last,
                                Points<Dim> x, const contact::Multiplier<Dim>* multiplier,
                                double stiffness, const ContactTimeFraction& time_fraction,
                                NodeContact<Dim>& c) {
  ElasticPredictor<Dim> tr;
  if (multiplier) {
    c.shear_multiplier = multiplier->shear;
    tr.value = c.sample.frame.transpose() * c.shear_multiplier;
  } else if (history.active) {
    tr.value = history.traction;
  }
  c.sliding = !last.nodes.empty();
  if (!c.sliding) return tr;
  c.time_fraction = time_fraction;
  c.way = c.sample.foot - place_in_space<Dim>(last, x);
  const Vec<Dim - 1> along = c.sample.frame.transpose() * c.way;
  tr.slip = time_fraction.value * along;
  tr.value += stiffness * time_fraction.value * along;
  return tr;
}

template <int Dim>
double weight_in(const MortarNode<Dim>& node, int k) {
  const auto n = static_cast<std::size_t>(k);
  const std::size_t own = node.slaves.nodes.size();
  return n < own ? node.slaves.weights[n] : -node.masters.weights[n - own];
}

template <int Dim>
void set_block(const PairDefinition<Dim>& pair, const MortarNode<Dim>& node,
               const NodeContact<Dim>& c, const PointContext<Dim>& context, std::size_t i,
               ContactBlock<Dim>& block) {
  // Weights that are zero but for rounding come and go: room for more than is needed just now.
  const std::size_t count = node.slaves.nodes.size() + node.masters.nodes.size();
  const auto rows = Dim * static_cast<Eigen::Index>(count);
  if (block.nodes.capacity() < count) block.nodes.reserve(2 * count);
  if (block.force.size() < rows) {
    grow(block.force, 2 * rows);
    grow(block.branch_force, 2 * rows);
    grow(block.path_rows, 2 * rows, Dim);
  }
  block.nodes.resize(count);
  set_nodes<Dim>(node.slaves.nodes, node.masters.nodes, block);
  const auto w = [&](std::size_t, int k) { return weight_in(node, k); };
  const auto forces_of = [&](const contact::Traction<Dim>& t) {
    return std::array<Vec<Dim>, 1>{c.traction(t)};
  };
  set_forces<Dim>(c.response, context.kept, forces_of(c.response.traction), forces_of, w, 1.0,
                  block);
  const std::array<Mat<Dim, Dim>, 1> unit{Mat<Dim, Dim>::Identity()};
  scatter_path<Dim>(unit, w, 1.0, block);
  if (!block.constraint.on) return;
  const double area = constraint_weight(pair, i);
  const contact::TangentialResponse<Dim>& shear = c.response.traction.tangential;
  const Mat<Dim, Dim - 1>& frame = c.sample.frame;
  set_constraint_values(area, c.response, frame, context, block.constraint);
  set_multiplier_terms<Dim>(
      point_penalty(pair, i), area, c.sample.normal, frame * shear.d_predictor * frame.transpose(),
      frame * shear.d_normal, [&](int k) { return weight_in(node, k); }, block);
}

}  // namespace

template <int Dim>
NodeContact<Dim> project_node(const MortarNode<Dim>& node, const NodalNormal<Dim>& normal) {
  NodeContact<Dim> c;
  ContactSample<Dim>& s = c.sample;
  s.facet = node.facet;
  s.feature = projection::Feature::face;
  s.foot = node.other / node.area;
  c.apart = node.own / node.area - s.foot;
  s.normal = -normal.value;
  s.frame = normal.frame;
  s.gap = s.normal.dot(c.apart);
  // Sides that touch without a gap are in contact; the sums leave some rounding of it.
  constexpr double rounding = 1e-13;
  if (s.gap > 0 && s.gap <= rounding * (node.own.norm() + node.other.norm()) / node.area) s.gap = 0;
  return c;
}

template <int Dim>
bool evaluate_node(const PairDefinition<Dim>& pair, Points<Dim> x, const PointHistory<Dim>& history,
                   const MortarPlace& last, const MortarNode<Dim>& node,
                   const PointContext<Dim>& context, std::size_t i, NodeContact<Dim>& c,
                   PairEvaluation<Dim>& out) {
  PointResult<Dim>& result = out.points[i];
  const contact::NormalResponse normal = normal_response(pair, history, c.sample.gap, context);
  report_sample(c.sample, pair.offset, result);
  report_normal(normal, history.damping_work, result);
  if (!normal.active) return false;
  c.response = respond<Dim>(pair, history, c.sample.gap, c.sample.frame, context, normal,
                            [&](double stiffness, const ContactTimeFraction& time_fraction) {
                              return predictor<Dim>(history, last, x, context.multiplier, stiffness,
                                                    time_fraction, c);
                            });
  report_contact<Dim>(c.response, c.response.law.traction, history, result);
  set_block(pair, node, c, context, i, out.blocks[i]);
  return true;
}

namespace {

/// Derivatives of sum_k W_jk x_k, j = 0..N-1, by one variable: W's stand in `rates`, k by k.
template <int Dim, int N>
auto rates_of_sum(const double* rates, std::span<const Index> by, Points<Dim> x, Eigen::Index n) {
  Eigen::Matrix<double, N, Dim, 0, N == Eigen::Dynamic ? cell::max_facet_nodes : N, Dim> sum;
  sum.setZero(n, Dim);
  for (const Index k : by) {
    sum += Eigen::Map<const Vec<N>>(rates, n).lazyProduct(x[at(k)].transpose());
    rates += n;
  }
  return sum;
}

/// N: multipliers of the facet (Eigen::Dynamic: any number).
template <int Dim, int N>
void add_rates_of(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
                  std::span<const std::size_t> local, Points<Dim> x,
                  std::vector<MortarNode<Dim>>& nodes) {
  const Eigen::Index n = matrices.d.size();
  const Sheet::ConstView dd = matrices.dd.view(), ds = matrices.ds.view(), dm = matrices.dm.view();
  Eigen::Index column = 0;
  for (const Index by : matrices.nodes) {
    std::array<typename MortarNode<Dim>::Rate*, cell::max_facet_nodes> rate;
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j)
      rate[j] = &rate_of(nodes[local[j]], by);
    for (int i = 0; i < Dim; ++i, ++column) {
      const auto own = rates_of_sum<Dim, N>(ds.col(column).data(), slaves, x, n);
      const auto other = rates_of_sum<Dim, N>(dm.col(column).data(), matrices.masters, x, n);
      for (Eigen::Index j = 0; j < n; ++j) {
        typename MortarNode<Dim>::Rate& to = *rate[static_cast<std::size_t>(j)];
        to.area[i] += dd(j, column);
        to.own.col(i) += own.row(j).transpose();
        to.other.col(i) += other.row(j).transpose();
      }
    }
  }
}

}  // namespace

template <int Dim>
void add_rates(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
               std::span<const std::size_t> local, Points<Dim> x,
               std::vector<MortarNode<Dim>>& nodes) {
  if (matrices.d.size() == 4)
    add_rates_of<Dim, 4>(matrices, slaves, local, x, nodes);
  else
    add_rates_of<Dim, Eigen::Dynamic>(matrices, slaves, local, x, nodes);
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
  block.elsewhere = false;
  block.behind.path.clear();
  block.area.clear();
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
    const NodeRates<Dim> rate = node_rates<Dim>(c, node.area, r);
    const contact::NormalResponse& push = c.response.traction.normal;
    const auto d_push = push.d_traction * rate.gap;
    block.behind.path.push_back(
        {r.node, c.sample.normal * d_push + push.traction * r.normal + rate.shear});
    if (!block.constraint.on) continue;
    block.constraint.normal_row.push_back({r.node, constraint_area * d_push.transpose()});
    if (pair.friction) block.constraint.shear_row.push_back({r.node, constraint_area * rate.shear});
  }
}

template bool evaluate_node<2>(const PairDefinition<2>&, Points<2>, const PointHistory<2>&,
                               const MortarPlace&, const MortarNode<2>&, const PointContext<2>&,
                               std::size_t, NodeContact<2>&, PairEvaluation<2>&);
template NodeContact<2> project_node<2>(const MortarNode<2>&, const NodalNormal<2>&);
template void add_rates<2>(const MortarFacet<2>&, std::span<const Index>,
                           std::span<const std::size_t>, Points<2>, std::vector<MortarNode<2>>&);
template void set_facet_tangent<2>(const MortarFacet<2>&, std::span<const Index>,
                                   std::span<const std::size_t>, std::span<const Vec<2>>,
                                   ContactBlock<2>&);
template void set_path<2>(const PairDefinition<2>&, double, const NodeContact<2>&,
                          const MortarPlace&, const NodalNormal<2>&, MortarNode<2>&,
                          ContactBlock<2>&);
template bool evaluate_node<3>(const PairDefinition<3>&, Points<3>, const PointHistory<3>&,
                               const MortarPlace&, const MortarNode<3>&, const PointContext<3>&,
                               std::size_t, NodeContact<3>&, PairEvaluation<3>&);
template NodeContact<3> project_node<3>(const MortarNode<3>&, const NodalNormal<3>&);
template void add_rates<3>(const MortarFacet<3>&, std::span<const Index>,
                           std::span<const std::size_t>, Points<3>, std::vector<MortarNode<3>>&);
template void set_facet_tangent<3>(const MortarFacet<3>&, std::span<const Index>,
                                   std::span<const std::size_t>, std::span<const Vec<3>>,
                                   ContactBlock<3>&);
template void set_path<3>(const PairDefinition<3>&, double, const NodeContact<3>&,
                          const MortarPlace&, const NodalNormal<3>&, MortarNode<3>&,
                          ContactBlock<3>&);

}  // namespace osculate::pairing
