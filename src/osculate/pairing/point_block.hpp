#pragma once
// From the terms of one contact sample to the forces, tangent and constraint of its nodes; for
// sources of this layer. Weights are functions w(slot, node of the block): how the sample depends
// on its nodes (contact::PointTerms).
#include <algorithm>
#include <array>
#include <span>

#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

/// The block of a sample that is not in contact.
template <int Dim>
void clear_block(ContactBlock<Dim>& block) {
  block.count = 0;
  block.branched = false;
  block.elsewhere = false;
  block.behind.path.clear();
  block.area.clear();
  block.constraint.on = false;
}

/// The nodes of a block: the slave's, then the master's.
template <int Dim>
void set_nodes(std::span<const Index> slave, std::span<const Index> master,
               ContactBlock<Dim>& block) {
  block.slave_count = static_cast<int>(slave.size());
  block.count = static_cast<int>(slave.size() + master.size());
  std::copy(master.begin(), master.end(),
            std::copy(slave.begin(), slave.end(), block.nodes.begin()));
}

/// force_k = area sum_a w(a, k) f[a]
template <int Dim, class WeightOf>
void scatter_forces(std::span<const Vec<Dim>> f, int count, const WeightOf& w, double area,
                    Eigen::VectorXd& force) {
  for (int k = 0; k < count; ++k) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t a = 0; a < f.size(); ++a) sum += w(a, k) * f[a];
    force.template segment<Dim>(Dim * k) = area * sum;
  }
}

/// The same with matrices: what the path behind the sample is multiplied by.
template <int Dim, class WeightOf>
void scatter_path(std::span<const Mat<Dim, Dim>> s, const WeightOf& w, double area,
                  ContactBlock<Dim>& block) {
  for (int k = 0; k < block.count; ++k) {
    Mat<Dim, Dim> behind = Mat<Dim, Dim>::Zero();
    for (std::size_t a = 0; a < s.size(); ++a) behind += w(a, k) * s[a];
    block.path_rows.template middleRows<Dim>(Dim * k) = area * behind;
  }
}

/// Adds to the rows of some of the nodes, at most `most` of them; `into(c)` is where their part of
/// column c stands.
template <int Dim, int most, class WeightOf, class Into>
void scatter_rows(const contact::PointTerms<Dim>& terms, std::array<int, 2> nodes, int count,
                  const WeightOf& w, double area, const Into& into) {
  constexpr int width = Dim * static_cast<int>(contact::slots<Dim>);
  const Eigen::Index n = Dim * (nodes[1] - nodes[0]);
  Eigen::Matrix<double, Eigen::Dynamic, width, 0, Dim * most, width> rows(n, width);
  for (int k = nodes[0]; k < nodes[1]; ++k)
    for (std::size_t b = 0; b < terms.used; ++b) {
      Mat<Dim, Dim> sum = Mat<Dim, Dim>::Zero();
      for (std::size_t a = 0; a < terms.used; ++a) {
        const double weight = w(a, k);
        if (weight != 0.0) sum += (area * weight) * terms.m[a][b];
      }
      rows.template block<Dim, Dim>(Dim * (k - nodes[0]), Dim * static_cast<Eigen::Index>(b)) = sum;
    }
  for (int l = 0; l < count; ++l)
    for (int d = 0; d < Dim; ++d) {
      Eigen::Map<Eigen::VectorXd> column(into(Dim * l + d), n);
      const auto part = [&](std::size_t b) {
        return w(b, l) * rows.col(Dim * static_cast<Eigen::Index>(b) + d);
      };
      bool moves = false;  // with the place on the master: not of a slave's node
      for (std::size_t b = 1; b < terms.used; ++b) moves = moves || w(b, l) != 0.0;
      if (!moves) {
        column += part(0);
        continue;
      }
      if constexpr (Dim == 3)
        column += part(0) + part(1) + part(2);
      else
        column += part(0) + part(1);
      for (std::size_t b = Dim; b < terms.used; ++b) column += part(b);
    }
}

/// Sets the first Dim * count rows and columns of `tangent`, or adds to them. Blocks of ties may
/// have any number of nodes: their rows come in bands.
///
/// Formula    K = sum_b rows_b w_b ,  rows_b = area sum_a w_a m[a][b]: column by column
template <int Dim, class WeightOf>
void scatter_tangent(const contact::PointTerms<Dim>& terms, int count, const WeightOf& w,
                     double area, Eigen::MatrixXd& tangent, bool add = false) {
  constexpr int band = max_slave_nodes<Dim> + 2 * max_master_nodes<Dim>;
  if (!add) tangent.topLeftCorner(Dim * count, Dim * count).setZero();
  for (int first = 0; first < count; first += band)
    scatter_rows<Dim, band>(terms, {first, std::min(count, first + band)}, count, w, area,
                            [&](int c) { return &tangent(Dim * first, c); });
}

/// The same of a point on a smooth facet of the master, whose own nodes' part goes into the block
/// of that facet.
template <int Dim, class WeightOf>
void scatter_tangent(const contact::PointTerms<Dim>& terms, const WeightOf& w, double area,
                     const ContactBlock<Dim>& block, Eigen::MatrixXd& tangent,
                     Eigen::MatrixXd& of_facet) {
  const int slave = block.slave_count, count = block.count;
  scatter_rows<Dim, max_slave_nodes<Dim>>(terms, {0, slave}, count, w, area,
                                          [&](int c) { return &tangent(0, c); });
  scatter_rows<Dim, max_master_nodes<Dim>>(terms, {slave, count}, count, w, area, [&](int c) {
    return c < Dim * slave ? &tangent(Dim * slave, c) : &of_facet(0, c - Dim * slave);
  });
}

/// Readies the tangent of a point's block that has no part of the master's nodes alone.
template <int Dim>
void start_without_master(ContactBlock<Dim>& block) {
  const Eigen::Index slave = Dim * block.slave_count, rest = block.tangent.rows() - slave;
  if (!block.without_master) block.tangent.bottomRightCorner(rest, rest).setZero();
  block.without_master = true;  // nobody else writes there
  block.tangent.topRows(slave).setZero();
  block.tangent.leftCols(slave).setZero();
}

/// The block of the master's facet that `block` is on.
template <int Dim>
ContactBlock<Dim>& facet_block(const ContactBlock<Dim>& block, ContactBlock<Dim>& facet) {
  if (facet.active()) return facet;
  const int count = block.count - block.slave_count;
  facet.reserve(count);
  facet.reserve_tangent(count);
  set_nodes<Dim>(
      {},
      std::span(block.nodes)
          .subspan(static_cast<std::size_t>(block.slave_count), static_cast<std::size_t>(count)),
      facet);
  facet.force.setZero();
  facet.branch_force.setZero();
  facet.tangent.setZero();
  return facet;
}

/// A path over the block's own master nodes, as that of a point which is on the facet of its
/// history, goes into the tangent. With `of_facet` that takes the rows of the master's nodes.
template <int Dim>
void fold_path(ContactBlock<Dim>& block, Eigen::MatrixXd& tangent,
               Eigen::MatrixXd* of_facet = nullptr) {
  std::vector<NodeMatrix<Dim>>& path = block.behind.path;
  const auto first = static_cast<std::size_t>(block.slave_count);
  if (path.size() + first != static_cast<std::size_t>(block.count)) return;
  for (std::size_t k = 0; k < path.size(); ++k)
    if (path[k].node != block.nodes[first + k]) return;
  const Eigen::Index all = Dim * block.count, slave = Dim * block.slave_count;
  const auto fold = [&](Eigen::Index from, Eigen::Index n, Eigen::MatrixXd& to, Eigen::Index row,
                        Eigen::Index column) {
    const auto rows = block.path_rows.middleRows(from, n);
    for (const NodeMatrix<Dim>& g : path)
      for (Eigen::Index d = 0; d < Dim; ++d) {
        auto sum = to.col(column++).segment(row, n);
        if constexpr (Dim == 3)
          sum += g.value(0, d) * rows.col(0) + g.value(1, d) * rows.col(1) +
                 g.value(2, d) * rows.col(2);
        else
          sum += g.value(0, d) * rows.col(0) + g.value(1, d) * rows.col(1);
      }
  };
  fold(0, of_facet ? slave : all, tangent, 0, slave);
  if (of_facet) fold(slave, all - slave, *of_facet, 0, 0);
  path.clear();
}

/// The block that holds the tangent of block i: the first one over the same nodes among those of
/// its slave facet, whose points stand behind each other.
template <int Dim>
[[nodiscard]] ContactBlock<Dim>& tangent_holder(std::size_t i,
                                                std::vector<ContactBlock<Dim>>& blocks) {
  constexpr std::size_t farthest = 16;
  ContactBlock<Dim>& own = blocks[i];
  const auto same = [&](const ContactBlock<Dim>& other, int count) {
    return std::equal(own.nodes.begin(), own.nodes.begin() + count, other.nodes.begin());
  };
  for (std::size_t j = i; j-- > 0 && i - j <= farthest;) {
    ContactBlock<Dim>& other = blocks[j];
    if (!other.active()) continue;
    if (other.slave_count != own.slave_count || !same(other, own.slave_count)) break;
    if (!other.elsewhere && other.count == own.count && same(other, own.count)) return other;
  }
  return own;
}

/// Forces of a sample in contact, and those of the branch that it is linearised in; of an open one
/// that is kept in contact the latter alone. `forces_of(traction)` are its terms f, `linear` those
/// of the traction that is linearised.
template <int Dim, class WeightOf, class ForcesOf>
void set_forces(const Response<Dim>& r, const std::optional<KeptContact>& kept,
                std::span<const Vec<Dim>> linear, const ForcesOf& forces_of, const WeightOf& w,
                double area, ContactBlock<Dim>& block) {
  const auto scatter = [&](const auto& f, Eigen::VectorXd& force) {
    scatter_forces<Dim>(f, block.count, w, area, force);
  };
  const Eigen::Index rows = Dim * block.count;
  block.branched = kept || r.branched();
  if (kept) {
    block.force.head(rows).setZero();
    scatter(forces_of(pulled(r.traction, *kept)), block.branch_force);
    return;
  }
  scatter(linear, block.branch_force);
  if (!block.branched) {
    block.force.head(rows) = block.branch_force.head(rows);
    return;
  }
  contact::Traction<Dim> lawful = r.traction;
  lawful.tangential = r.law;
  scatter(forces_of(lawful), block.force);
}

/// What a constraint is multiplied by: it does not change with the deformation.
template <int Dim>
[[nodiscard]] double constraint_weight(const PairDefinition<Dim>& pair, std::size_t i) {
  return pair.weight == Weight::node ? 1.0 : pair.reference_areas[i];
}

/// Whether the tractions of the point are unknowns; if so its constraint starts as that of an open
/// point.
template <int Dim>
bool start_constraint(const PairDefinition<Dim>& pair, const PointContext<Dim>& context,
                      std::size_t i, ContactBlock<Dim>& block) {
  if (!by_multipliers(pair) || !context.multiplier) return false;
  const PointPenalty penalty = point_penalty(pair, i);
  set_open(constraint_weight(pair, i), penalty.normal, penalty.shear, context.multiplier->normal,
           context.multiplier->shear, block.constraint);
  return true;
}

/// Values of the constraint of a sample in contact, or of an open one that is linearised as if it
/// were: see ConstraintBlock.
template <int Dim>
void set_constraint_values(double area, const Response<Dim>& r, const Mat<Dim, Dim - 1>& frame,
                           const PointContext<Dim>& context, ConstraintBlock<Dim>& c) {
  const contact::Multiplier<Dim>& multiplier = *context.multiplier;
  const contact::Traction<Dim> linear =
      context.kept ? pulled(r.traction, *context.kept) : r.traction;
  c.branch_normal = area * (linear.normal.traction - multiplier.normal);
  c.branch_shear = area * (frame * linear.tangential.traction - multiplier.shear);
  c.normal = context.kept ? -area * multiplier.normal : c.branch_normal;
  c.shear = context.kept ? Vec<Dim>(-area * multiplier.shear)
                         : Vec<Dim>(area * (frame * r.law.traction - multiplier.shear));
}

/// Derivatives by the multipliers of a point in contact: of its forces, with `weight(n)` of node n
/// of the block, and of its constraint. dt = d_predictor dLambda + d_push dlambda.
template <int Dim, class WeightOf>
void set_multiplier_terms(const PointPenalty& penalty, double area, const Vec<Dim>& normal,
                          const Mat<Dim, Dim>& d_predictor, const Vec<Dim>& d_push,
                          const WeightOf& weight, ContactBlock<Dim>& block) {
  ConstraintBlock<Dim>& c = block.constraint;
  const double push = penalty.normal, shear = penalty.shear;
  if (c.columns.rows() < Dim * block.count) c.columns.resize(Dim * block.count, Dim + 1);
  for (int n = 0; n < block.count; ++n) {
    auto rows = c.columns.template middleRows<Dim>(Dim * n);
    rows.col(0) = (weight(n) * push) * (normal + d_push);
    rows.template rightCols<Dim>() = (weight(n) * shear) * d_predictor;
  }
  c.own.setZero();
  c.own.template block<Dim, 1>(1, 0) = area * push * d_push;
  c.own.template bottomRightCorner<Dim, Dim>() =
      (area * shear) * (d_predictor - Mat<Dim, Dim>::Identity());
}

}  // namespace osculate::pairing
