#pragma once
// A contact pair whose tractions are unknowns: forces and constraints, and their dense tangent.
#include "osculate/pairing/point_penalty.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {

/// Positions, then (lambda / eps_N, t / eps_T) of every slave point.
template <int Dim>
struct MultiplierSample {
  pairing::PairDefinition<Dim> pair;
  pairing::PairState<Dim> committed;
  std::vector<Vec<Dim>> x;
  std::vector<contact::Multiplier<Dim>> multipliers;
  double duration = 0;                                   ///< of the increment
  std::vector<pairing::ActiveBranch<Dim>> active_set{};  ///< of the last iteration

  [[nodiscard]] Eigen::Index nodes() const { return static_cast<Eigen::Index>(x.size()); }
  [[nodiscard]] Eigen::Index points() const {
    return static_cast<Eigen::Index>(multipliers.size());
  }
  [[nodiscard]] pairing::PointPenalty penalty_at(Eigen::Index i) const {
    return pairing::point_penalty(pair, static_cast<std::size_t>(i));
  }
  [[nodiscard]] Eigen::Index per_point() const { return pairing::has_shear(pair) ? Dim + 1 : 1; }
  [[nodiscard]] Eigen::Index size() const { return Dim * nodes() + per_point() * points(); }

  [[nodiscard]] Eigen::VectorXd packed() const {
    Eigen::VectorXd v(size());
    for (Eigen::Index n = 0; n < nodes(); ++n)
      v.segment<Dim>(Dim * n) = x[static_cast<std::size_t>(n)];
    for (Eigen::Index i = 0; i < points(); ++i) {
      const contact::Multiplier<Dim>& m = multipliers[static_cast<std::size_t>(i)];
      const Eigen::Index at = Dim * nodes() + per_point() * i;
      const pairing::PointPenalty penalty = penalty_at(i);
      v[at] = m.normal / penalty.normal;
      if (pairing::has_shear(pair)) v.segment<Dim>(at + 1) = m.shear / penalty.shear;
    }
    return v;
  }

  [[nodiscard]] pairing::PairEvaluation<Dim> evaluation(const Eigen::VectorXd& v,
                                                        bool tangent) const {
    std::vector<Vec<Dim>> at(x.size());
    for (Eigen::Index n = 0; n < nodes(); ++n)
      at[static_cast<std::size_t>(n)] = v.segment<Dim>(Dim * n);
    pairing::PairMultipliers<Dim> multipliers;
    for (Eigen::Index i = 0; i < points(); ++i) {
      const Eigen::Index first = Dim * nodes() + per_point() * i;
      multipliers.points.emplace_back();
      const pairing::PointPenalty penalty = penalty_at(i);
      multipliers.points.back().normal = penalty.normal * v[first];
      if (pairing::has_shear(pair))
        multipliers.points.back().shear = penalty.shear * v.segment<Dim>(first + 1);
    }
    pairing::PairEvaluation<Dim> e;
    pairing::ActiveSet<Dim> last;
    last.branch = active_set;
    last.duration = duration;
    pairing::evaluate<Dim>(pair, at, committed, tangent, e, last, &multipliers);
    return e;
  }

  [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd& v) const {
    const pairing::PairEvaluation<Dim> e = evaluation(v, false);
    Eigen::VectorXd r = assembled_force(e, size());
    for (std::size_t b = 0; b < e.blocks.size(); ++b) {
      const pairing::ConstraintBlock<Dim>& constraint = e.blocks[b].constraint;
      if (!constraint.on) continue;
      const Eigen::Index at = Dim * nodes() + per_point() * static_cast<Eigen::Index>(b);
      r[at] = constraint.normal;
      if (pairing::has_shear(pair)) r.segment<Dim>(at + 1) = constraint.shear;
    }
    return r;
  }

  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::VectorXd& v) const {
    const pairing::PairEvaluation<Dim> e = evaluation(v, true);
    Eigen::MatrixXd k = assembled_tangent(e, size());
    for (std::size_t b = 0; b < e.blocks.size(); ++b)
      if (e.blocks[b].constraint.on)
        add_constraint(e.blocks[b], Dim * nodes() + per_point() * static_cast<Eigen::Index>(b), k);
    return k;
  }

 private:
  void add_constraint(const pairing::ContactBlock<Dim>& b, Eigen::Index at,
                      Eigen::MatrixXd& k) const {
    const pairing::ConstraintBlock<Dim>& c = b.constraint;
    const Eigen::Index count = per_point();
    k.block(at, at, count, count) += c.own.topLeftCorner(count, count);
    for (const pairing::NodeGradient<Dim>& g : c.normal_row)
      k.block<1, Dim>(at, Dim * g.node) += g.value.transpose();
    for (const pairing::NodeMatrix<Dim>& g : c.shear_row)
      k.block<Dim, Dim>(at + 1, Dim * g.node) += g.value;
    for (int n = 0; n < b.count; ++n)
      k.block(Dim * b.nodes[static_cast<std::size_t>(n)], at, Dim, count) +=
          c.columns.middleRows(Dim * n, Dim).leftCols(count);
  }
};

/// A shear in the plane of the master that leans out of it a little, as it does between iterations.
template <int Dim>
Vec<Dim> shear_of(double size) {
  Vec<Dim> t = Vec<Dim>::Constant(0.1 * size);
  t[0] = size;
  return t;
}

template <int Dim>
MultiplierSample<Dim> unknown_tractions(const ContactSample<Dim>& s, double lambda, double shear) {
  MultiplierSample<Dim> m;
  m.pair = s.pair;
  m.pair.enforcement = pairing::ByMultipliers{};
  m.committed = s.committed;
  m.x = s.x;
  m.multipliers.assign(s.committed.points.size(), contact::Multiplier<Dim>{});
  for (contact::Multiplier<Dim>& point : m.multipliers) {
    point.normal = lambda;
    point.shear = shear_of<Dim>(shear);
  }
  return m;
}

template <int Dim>
std::vector<contact::Status> states(const pairing::PairEvaluation<Dim>& e) {
  std::vector<contact::Status> out;
  for (const auto& point : e.points) out.push_back(point.status);
  return out;
}

}  // namespace osculate::testing
