#pragma once
// From the terms of one contact sample to the forces, tangent and constraint of its nodes; for
// sources of this layer. Weights are functions w(slot, node of the block): how the sample depends
// on its nodes (contact::PointTerms).
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

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
  block.reserve_path();
  for (int k = 0; k < block.count; ++k) {
    Mat<Dim, Dim> behind = Mat<Dim, Dim>::Zero();
    for (std::size_t a = 0; a < s.size(); ++a) behind += w(a, k) * s[a];
    block.path_rows.template middleRows<Dim>(Dim * k) = area * behind;
  }
}

/// Calls f(0), ... f(count - 1) with constants: a loop without one at run time.
template <std::size_t count, class F>
void for_each_of(const F& f) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (f(std::integral_constant<std::size_t, k>{}), ...);
  }
  (std::make_index_sequence<count>{});
}

/// Rows of a tangent that belong to some of the nodes, by what they are the sum of.
///
/// Formula    rows_k = sum_a w_a,k form_a ,  form_a = sum_b m[a][b] w_b
template <int Dim, std::size_t used, int most>
struct TangentRows {
  std::array<std::array<double, Dim * most>, used> weights;  ///< by slot, of each node Dim times
  int nodes = 0;

  template <class WeightOf>
  TangentRows(std::array<int, 2> range, const WeightOf& w, double area)
      : nodes(range[1] - range[0]) {
    for (std::size_t a = 0; a < used; ++a)
      for (int k = 0; k < nodes; ++k)
        std::fill_n(&weights[a][static_cast<std::size_t>(Dim * k)], Dim, area * w(a, range[0] + k));
  }
  /// Sets a column of these rows, or adds to it; four nodes at a time.
  void put(const std::array<Eigen::Array4d, used>& form, bool add, double* column) const {
    using Four = Eigen::Array4d;
    constexpr auto d = static_cast<std::size_t>(Dim);
    std::array<std::array<Four, d>, used> v;  // the column of each form, four times over
    for_each_of<used>([&](auto a) {
      for_each_of<d>([&](auto i) {
        v[a][i] = Four(form[a][4 * i % d], form[a][(4 * i + 1) % d], form[a][(4 * i + 2) % d],
                       form[a][(4 * i + 3) % d]);
      });
    });
    const auto whole = d * (static_cast<std::size_t>(nodes) & ~std::size_t{3});
    for (std::size_t row = 0; row < whole; row += 4 * d)
      for_each_of<d>([&](auto i) {
        Eigen::Map<Four> part(column + row + 4 * i);
        Four sum = Four::Zero();
        if (add) sum = part;
        for_each_of<used>(
            [&](auto a) { sum += v[a][i] * Eigen::Map<const Four>(&weights[a][row + 4 * i]); });
        part = sum;
      });
    for (std::size_t row = whole; row < d * static_cast<std::size_t>(nodes); ++row) {
      double sum = add ? column[row] : 0;
      for (std::size_t a = 0; a < used; ++a)
        sum += form[a][static_cast<Eigen::Index>(row % d)] * weights[a][row];
      column[row] = sum;
    }
  }
};

/// put(c, columns of the forms) for each column c of the tangent of a sample. `path`: derivatives
/// of the trial by the last nodes of the block, where they are not terms of other nodes.
template <int Dim, std::size_t used, class WeightOf, class Put>
void for_each_column(const contact::PointTerms<Dim>& terms, int count, const WeightOf& w,
                     std::span<const NodeMatrix<Dim>> path, const Put& put) {
  using Four = Eigen::Array4d;
  constexpr std::size_t driven = used > Dim ? Dim : 1;  // forms with a part s[a] of the trial
  const auto padded = [](const Mat<Dim, Dim>& m, int c) {
    Four v = Four::Zero();
    v.head<Dim>() = m.col(c);
    return v;
  };
  std::array<std::array<std::array<Four, Dim>, used>, used> m;
  std::array<std::array<Four, Dim>, driven> s;
  for (int c = 0; c < Dim; ++c) {
    const auto at = static_cast<std::size_t>(c);
    for (std::size_t a = 0; a < used; ++a)
      for (std::size_t b = 0; b < used; ++b) m[a][b][at] = padded(terms.m[a][b], c);
    if (!path.empty())
      for (std::size_t a = 0; a < driven; ++a) s[a][at] = padded(terms.s[a], c);
  }
  const int first = count - static_cast<int>(path.size());
  for (int l = 0; l < count; ++l) {
    bool moves = false;  // with the place on the master: not of a slave's node
    for (std::size_t b = 1; b < used; ++b) moves = moves || w(b, l) != 0.0;
    for (int c = 0; c < Dim; ++c) {
      const auto at = static_cast<std::size_t>(c);
      std::array<Four, used> form;
      for (std::size_t a = 0; a < used; ++a) form[a] = w(0, l) * m[a][0][at];
      if (moves)
        for (std::size_t b = 1; b < used; ++b)
          for (std::size_t a = 0; a < used; ++a) form[a] += w(b, l) * m[a][b][at];
      if (l >= first) {
        const Mat<Dim, Dim>& g = path[static_cast<std::size_t>(l - first)].value;
        for (std::size_t a = 0; a < driven; ++a)
          for (int j = 0; j < Dim; ++j) form[a] += g(j, c) * s[a][static_cast<std::size_t>(j)];
      }
      put(Dim * l + c, form);
    }
  }
}

/// Calls `scatter` with the number of slots that the terms use.
template <int Dim, class Scatter>
void with_used_slots(const contact::PointTerms<Dim>& terms, const Scatter& scatter) {
  if (terms.used == 1)
    scatter(std::integral_constant<std::size_t, 1>{});
  else if (terms.used == static_cast<std::size_t>(Dim))
    scatter(std::integral_constant<std::size_t, static_cast<std::size_t>(Dim)>{});
  else
    scatter(std::integral_constant<std::size_t, contact::slots<Dim>>{});
}

/// Sets the first Dim * count rows and columns of `tangent`, or adds to them. Blocks of ties may
/// have any number of nodes: their rows come in bands.
///
/// Formula    K_kl = sum_a w_a,k (sum_b area m[a][b] w_b,l + s[a] path_l)
template <int Dim, class WeightOf>
void scatter_tangent(const contact::PointTerms<Dim>& terms, int count, const WeightOf& w,
                     double area, Eigen::MatrixXd& tangent, bool add = false,
                     std::span<const NodeMatrix<Dim>> path = {}) {
  constexpr int band = max_slave_nodes<Dim> + 2 * max_master_nodes<Dim>;
  with_used_slots(terms, [&](auto used) {
    for (int first = 0; first < count; first += band) {
      const TangentRows<Dim, used, band> rows({first, std::min(count, first + band)}, w, area);
      for_each_column<Dim, used>(terms, count, w, path, [&](int c, const auto& form) {
        rows.put(form, add, &tangent(Dim * first, c));
      });
    }
  });
}

/// The same of a point on a smooth facet of the master, whose own nodes' part is added to the block
/// of that facet.
template <int Dim, class WeightOf>
void scatter_tangent(const contact::PointTerms<Dim>& terms, const WeightOf& w, double area,
                     const ContactBlock<Dim>& block, Eigen::MatrixXd& tangent, bool add,
                     Eigen::MatrixXd& of_facet, std::span<const NodeMatrix<Dim>> path) {
  const int slave = block.slave_count, count = block.count;
  with_used_slots(terms, [&](auto used) {
    const TangentRows<Dim, used, max_slave_nodes<Dim>> of_slave({0, slave}, w, area);
    const TangentRows<Dim, used, max_master_nodes<Dim>> of_master({slave, count}, w, area);
    for_each_column<Dim, used>(terms, count, w, path, [&](int c, const auto& form) {
      of_slave.put(form, add, &tangent(0, c));
      if (c < Dim * slave)
        of_master.put(form, add, &tangent(Dim * slave, c));
      else
        of_master.put(form, true, &of_facet(0, c - Dim * slave));
    });
  });
}

/// Readies the tangent of a point's block that has no part of the master's nodes alone.
template <int Dim>
void start_without_master(ContactBlock<Dim>& block) {
  const Eigen::Index slave = Dim * block.slave_count, rest = block.tangent.rows() - slave;
  if (!block.without_master) block.tangent.bottomRightCorner(rest, rest).setZero();
  block.without_master = true;  // nobody else writes there
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

/// Whether the path is over the block's own master nodes, as that of a point which is on the facet
/// of its history: then it belongs into the tangent.
template <int Dim>
[[nodiscard]] bool path_is_own(const ContactBlock<Dim>& block) {
  const std::vector<NodeMatrix<Dim>>& path = block.behind.path;
  const auto first = static_cast<std::size_t>(block.slave_count);
  if (path.size() + first != static_cast<std::size_t>(block.count)) return false;
  for (std::size_t k = 0; k < path.size(); ++k)
    if (path[k].node != block.nodes[first + k]) return false;
  return true;
}

/// The block that holds the tangent of block i: the first one over the same nodes among those of
/// its slave facet, which begin with `first`.
template <int Dim>
[[nodiscard]] ContactBlock<Dim>& tangent_holder(std::size_t i, std::size_t first,
                                                std::vector<ContactBlock<Dim>>& blocks) {
  ContactBlock<Dim>& own = blocks[i];
  for (std::size_t j = i; j-- > first;) {
    ContactBlock<Dim>& other = blocks[j];
    if (other.active() && !other.elsewhere && other.count == own.count &&
        other.slave_count == own.slave_count &&
        std::equal(own.nodes.begin(), own.nodes.begin() + own.count, other.nodes.begin()))
      return other;
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
